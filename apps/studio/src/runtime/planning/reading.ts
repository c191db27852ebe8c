import { type Dialect, type Parsed, type Pose, type Robot } from "@twincell/core";
import { DIALECTS } from "@twincell/languages";
import { languagesOf } from "../../stores/languages.ts";

/** A text as one language reads it. */
export interface Reading {
  readonly dialect: Dialect;
  readonly parsed: Parsed;
}

/** What only texts of that language begin with. */
const SIGNS: Readonly<Record<string, RegExp>> = {
  "v-plus": /^\s*\.PROGRAM\b/im,
  "kawasaki-as": /^\s*\.(PROGRAM|TRANS|JOINTS)\b/im,
  krl: /^\s*(&ACCESS\b|DEFDAT\b|(GLOBAL\s+)?DEF\s+\w+\s*\([^)]*\)\s*$)/im,
  rapid: /^\s*(%%%|MODULE|PROC)\b/im,
  urscript: /^\s*def\s+\w+\s*\(|\bmove[jlpc]\s*\(/m,
  inform: /^\s*\/JOB\b/m,
  "fanuc-ls": /^\s*\/PROG\b/m,
  val3: /^\s*(begin\b|<\?xml)/im,
  "l-irl": /^\s*POSES\s+\d/m,
  spel: /^\s*Function\s+\w+[\s\S]*^\s*Fend\b/im,
  "melfa-basic": /^\s*(\d+\s+)?(Mov|Mvs|Mvr|JOvrd|HOpen|HClose)\s+\S/im,
  pacscript: /^\s*('!TITLE|TakeArm\b|Move\s+[PLC]\s*,)/im,
};

/** How much speaks for a language: the ending of the file, how its texts begin, and the robot's own. */
function weigh(text: string, robot: Robot, name: string): (dialect: Dialect) => number {
  const ending = /\.[^.]+$/.exec(name)?.[0]?.toLowerCase() ?? "";
  const own = new Set(languagesOf(robot).flatMap(({ dialect, why }) => (why === null ? [dialect] : [])));
  return dialect =>
    (own.has(dialect) ? 0.5 : 0) +
    (dialect.extensions.some(each => each.toLowerCase() === ending) ? 2 : 0) +
    (SIGNS[dialect.id]?.test(text) ? 1 : 0);
}

/** The language that a text is of by its ending and how it begins; undefined when neither says anything. */
export function languageOfText(text: string, name: string, robot: Robot): string | undefined {
  const weight = weigh(text, robot, name);
  const [best] = DIALECTS.toSorted((a, b) => weight(b) - weight(a));
  return best !== undefined && weight(best) >= 1 ? best.id : undefined;
}

/**
 * Which language a text is of, and what it says: the first that reads steps out of it, asked in the order of the file's
 * ending, of how texts of the language begin, and of the robot's own. Where none does, the one with the fewest faults.
 *
 * @param skipUnknown  what that one does not understand is left out and told.
 */
export function readText(
  text: string,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  name = "",
  wanted?: string,
  skipUnknown = false,
): Reading | undefined {
  const weight = weigh(text, robot, name);
  const asked =
    wanted === undefined
      ? DIALECTS.toSorted((a, b) => weight(b) - weight(a))
      : DIALECTS.filter(dialect => dialect.id === wanted);
  let best: Reading | undefined;
  let fewest = Infinity;
  for (const dialect of asked) {
    const parsed = dialect.parse(text, robot, worldFromBase);
    if (parsed.kind === "parsed" && parsed.program.steps.length > 0) return { dialect, parsed };
    const faults = parsed.kind === "parsed" ? 1 : Math.max(1, parsed.faults.length);
    // The language whose sign the text carries is the one whose faults a person wants to read.
    const counted = faults - 1000 * weight(dialect);
    if (counted < fewest) {
      fewest = counted;
      best = { dialect, parsed };
    }
  }
  return best === undefined || !skipUnknown
    ? best
    : { dialect: best.dialect, parsed: best.dialect.parse(text, robot, worldFromBase, { skipUnknown }) };
}
