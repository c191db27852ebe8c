import {
  everyStep,
  type Interpreted,
  type Parsed,
  type Pose,
  type Program,
  type Robot,
  type Step,
  type TextFault,
  identity,
} from "@twincell/core";
import { textFault } from "../parser/faults.ts";
import { checkImport, type ImportDifference } from "./import-check.ts";
import { numberedSteps, writtenOut } from "./written-out.ts";

/** A text read as steps, with the ids of the steps that wait where the text goes round until an input changes. */
export type ReadSteps = Parsed & {
  readonly waits?: ReadonlySet<string>;
  /** Executes the same text, where it need not be read again for that. */
  readonly executable?: () => Interpreted;
};

/** What the check needs of a language. */
export interface CheckedReader {
  parse(text: string, robot: Robot, worldFromBase?: Pose<"world", "base">): ReadSteps;
  interpret(text: string, robot: Robot, worldFromBase?: Pose<"world", "base">): Interpreted;
  /** A text that names places and moves to none of them: its steps are not what it does, and a warning says so. */
  isPlaces?(text: string): boolean;
}

/**
 * Reads a text as steps and compares them with interpreting the same text. Steps that do something else are never
 * returned: what the text does is written out instead, with decisions where inputs are asked, and compared again; where
 * that is not possible the text is refused with the line and both values.
 */
export function checkedImport(
  reader: CheckedReader,
  text: string,
  robot: Robot,
  worldFromBase?: Pose<"world", "base">,
): Parsed {
  const { waits, executable, ...parsed } = reader.parse(text, robot, worldFromBase);
  if (parsed.kind === "not-understood" || reader.isPlaces?.(text) === true) return parsed;
  const interpreted = executable?.() ?? reader.interpret(text, robot, worldFromBase);
  if (interpreted.kind === "not-understood") return interpreted;
  const base = worldFromBase ?? identity<"world", "base">();
  const { differs } = checkImport(parsed.program, interpreted, robot, base, waits);
  if (differs === undefined) return { ...parsed, program: withUniqueIds(parsed.program) };
  return writtenImport(parsed, interpreted, robot, base, differs);
}

/** The program as what its text does, where that can be said. */
function writtenImport(
  parsed: Extract<Parsed, { kind: "parsed" }>,
  interpreted: Extract<Interpreted, { kind: "ready" }>,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  differs: ImportDifference,
): Parsed {
  const { tools, frames, signals = {} } = interpreted.context;
  let why: TextFault | undefined;
  for (const merged of [true, false]) {
    const written = writtenOut(interpreted.run, signals, { merged, called: "program" });
    if (written.kind === "cannot") {
      why ??= written.fault;
      continue;
    }
    const waits = new Set<string>();
    const program: Program = {
      ...parsed.program,
      groups: {},
      routines: {},
      pallets: {},
      tools: { ...parsed.program.tools, ...tools },
      frames: { ...frames },
      signals: { ...parsed.program.signals, ...signals },
      steps: numberedSteps(written.steps, new Map(), waits),
    };
    if (checkImport(program, interpreted, robot, worldFromBase, waits).differs !== undefined) continue;
    const told = textFault(
      { line: differs.line, column: 1 },
      "loops and routines that do the same each time",
      `The program was written out as what it does, ${written.steps.length} steps: kept as loops and routines it would do something else. ${differs.sentence}`,
    );
    return { kind: "parsed", program, warnings: [told, ...parsed.warnings.filter(keepsItsSense)] };
  }
  return {
    kind: "not-understood",
    faults: [
      textFault(
        { line: differs.line, column: 1 },
        "a program whose steps do what its text does",
        `As steps the program would do something else than its text. ${differs.sentence}${why === undefined ? "" : ` It cannot be written out either: ${why.sentence}`} \`run\` executes the text as it stands.`.replace(
          TWICE,
          "$1",
        ),
      ),
    ],
  };
}

/** The way out is said once. */
const TWICE = /( `run` executes the text as it stands\.)\1/;

/** What was said of loops that were written out no longer holds. */
const keepsItsSense = ({ expected }: TextFault): boolean => expected !== "a loop that does the same each time";

/** The program with each id once: steps that were written out more than once get ids of their own. */
export function withUniqueIds(program: Program): Program {
  const all = new Set<string>();
  let isDouble = false;
  for (const { id } of everyStep(program)) {
    isDouble ||= all.has(id);
    all.add(id);
  }
  if (!isDouble) return program;
  const used = new Set<string>();
  let count = 0;
  const fresh = (id: string): string => {
    if (!used.has(id)) {
      used.add(id);
      return id;
    }
    let free = `s${++count}`;
    while (all.has(free)) free = `s${++count}`;
    all.add(free);
    return free;
  };
  const list = (steps: readonly Step[]): Step[] => steps.map(renamed);
  const renamed = (step: Step): Step => {
    const own = { ...step, id: fresh(step.id) };
    if (own.type === "repeat" || own.type === "pallet") return { ...own, steps: list(own.steps) };
    if (own.type !== "if") return own;
    const then = list(own.then);
    return { ...own, then, ...(own.else === undefined ? {} : { else: list(own.else) }) };
  };
  return {
    ...program,
    steps: list(program.steps),
    routines: Object.fromEntries(Object.entries(program.routines).map(([name, steps]) => [name, list(steps)])),
  };
}
