import {
  bestAttempt,
  emptyProgram,
  filterDemonstration,
  FILTER_DEFAULTS,
  judgeAttempt,
  parseHandProfile,
  planProgram,
  pose,
  readDemonstration,
  readRawHand,
  repeatOnPallet,
  sampleRate_Hz,
  serializeProgram,
  stepsOfDemonstration,
  writeDemonstration,
  type Demonstration,
  type FilterOptions,
  type Pose,
  type Program,
  type Vector3,
} from "@twincell/core";
import { given, type Given } from "../io/arguments.ts";
import { readText } from "../io/files.ts";
import { writeOne } from "../io/output.ts";
import { readCell } from "../io/program.ts";
import { robotOf, ROBOT_HELP, ROBOT_OPTIONS } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const demonstrateCommand: Command = {
  name: "demonstrate",
  summary: "a recorded hand filtered into a program, or attempts compared with an expert's",
  usage: `twincell demonstrate FILE --robot R -o PROGRAM [--cell CELL --tool NAME] [filter options] [--pallet CORNERS --rows N --columns N]
twincell demonstrate raw FILE --hand PROFILE --start x,y,z -o TABLE
twincell demonstrate score EXPERT ATTEMPT… [--within-mm MM] [--within-s S] [--path-ratio N]

FILE is a table, one line a sample: t_s (or t_ms), x_m y_m z_m (or x_mm …), qx qy qz qw or rx_deg ry_deg rz_deg (fixed axes), closed 0 or 1;
the first line names the columns. "-" is standard input.

Filters: samples of a hand that stands become their mean; of a straight only start and end are kept; the rest becomes Bézier curves.
Writes PROGRAM and one JSON object: samples, rate, what the filters made of them, and how far the hand lies from it in millimetres.
Ends with 1 where the program cannot be planned on the robot; "sentence" says what stops it.

  --cell CELL       where the robot stands, with its tools; --tool NAME is the tool that was shown (default: the flange)
  --rest-mm 3       samples this near to each other for --rest-s 0.2 seconds are one stop
  --straight-mm 2   a stretch this near to its chord is straight
  --curves WAY      fitted (least squares, default) or averaged (every 5 to 10 samples one control point, as published)
  --waits-s S       rests of at least S seconds become waits (default: none)
  --durations       straights take exactly as long as the hand took, where the language has durations (default: its mean speed)
  --filtered FILE   also writes the filtered way as a table x_m,y_m,z_m, to lay over the original
  --pallet x,y,z;x,y,z;x,y,z   place 1, the end of the first row and of the first column [m]: the shown pick-and-place is done at all
                    places of --rows N by --columns N

raw     a glove with a tracker: lines t_s,ax_V,ay_V,az_V,qx,qy,qz,qw,f1,f2,f3,f4,f5 (volts 0…5 along the tracker's axes without gravity, fingers
        0…4095). PROFILE is written by "twincell calibrate hand". Writes TABLE with positions, velocities and accelerations.
score   accuracy, time and path length of each attempt against the expert's, 0 … 100; ends with 1 when none is accepted

${ROBOT_HELP}`,
  async run(args) {
    const options = given(args, {
      ...ROBOT_OPTIONS,
      out: { type: "string", short: "o" },
      cell: { type: "string" },
      tool: { type: "string" },
      "rest-mm": { type: "string" },
      "rest-s": { type: "string" },
      "straight-mm": { type: "string" },
      curves: { type: "string" },
      "waits-s": { type: "string" },
      durations: { type: "boolean" },
      filtered: { type: "string" },
      pallet: { type: "string" },
      rows: { type: "string" },
      columns: { type: "string" },
      hand: { type: "string" },
      start: { type: "string" },
      "within-mm": { type: "string" },
      "within-s": { type: "string" },
      "path-ratio": { type: "string" },
      json: { type: "boolean" },
    });
    const [first, ...rest] = options.positionals;
    if (first === undefined) throw new UseFault("FILE is missing.", 'Give the path of a table, or "-".');
    if (first === "raw") return fromRaw(options, rest);
    if (first === "score") return score(options, rest);
    return toProgram(options, first);
  },
};

const say = (answer: Record<string, unknown>): void => {
  process.stdout.write(`${JSON.stringify(answer)}\n`);
};

async function demonstrationOf(path: string): Promise<{ demonstration: Demonstration; dropped: number }> {
  const answer = readDemonstration(await readText(path));
  if (answer.kind === "unreadable") throw new UseFault(`${path}: line ${answer.line}: ${answer.sentence}`);
  return answer;
}

function outOf(options: Given): string {
  const out = options.text("out");
  if (out === undefined) throw new UseFault("-o FILE is missing.", "Give the path to write to.");
  return out;
}

function filterOptions(options: Given): FilterOptions {
  const curves = options.text("curves") ?? "fitted";
  if (curves !== "fitted" && curves !== "averaged")
    throw new UseFault(`There are no "${curves}" curves.`, "Give fitted or averaged.");
  return {
    ...FILTER_DEFAULTS,
    rest_m: (options.number("rest-mm") ?? 1000 * FILTER_DEFAULTS.rest_m) / 1000,
    rest_s: options.number("rest-s") ?? FILTER_DEFAULTS.rest_s,
    straight_m: (options.number("straight-mm") ?? 1000 * FILTER_DEFAULTS.straight_m) / 1000,
    curves,
  };
}

async function toProgram(options: Given, path: string): Promise<number> {
  const out = outOf(options);
  const { robot } = await robotOf(options);
  const { demonstration, dropped } = await demonstrationOf(path);
  const cellPath = options.text("cell");
  const cell = cellPath === undefined ? undefined : await readCell(cellPath);
  const toolName = options.text("tool") ?? "flange";
  const tool = cell?.tools.find(({ name }) => name === toolName);
  if (toolName !== "flange" && !tool)
    throw new UseFault(
      `There is no tool "${toolName}".`,
      cell ? `Tools of the cell: ${cell.tools.map(({ name }) => name).join(", ")}.` : "Name its cell with --cell.",
    );
  const filtered = filterDemonstration(demonstration, filterOptions(options));
  const steps = stepsOfDemonstration(demonstration, filtered, {
    frame: "world",
    worldFromFrame: pose(),
    tool: tool?.name ?? "flange",
    approach: { ratio: 0.3 },
    waitsFrom_s: options.number("waits-s") ?? Infinity,
    exactDurations: options.flag("durations"),
  });
  const shown: Program = {
    ...emptyProgram(robot.id, "Demonstration"),
    tools: tool ? { [tool.name]: tool.flangeFromTcp } : {},
    steps,
  };
  const { program, places } = onPallet(options, shown);
  await writeOne(out, serializeProgram(program));
  const overlay = options.text("filtered");
  if (overlay !== undefined) await writeOne(overlay, tableOf(filtered.polyline));
  const worldFromBase = cell?.robot.worldFromBase ?? pose<"world", "base">();
  const planned = planProgram(program, robot, { worldFromBase });
  const { max_m, rms_m, at } = filtered.deviation;
  const count = (kind: string): number => filtered.parts.filter(part => part.kind === kind).length;
  say({
    kind: planned.kind,
    program: out,
    samples: demonstration.times_s.length,
    dropped,
    rate_Hz: sampleRate_Hz(demonstration),
    stops: count("stop"),
    straights: count("straight"),
    curves: count("curve"),
    points: filtered.points,
    deviation: { max_mm: 1000 * max_m, rms_mm: 1000 * rms_m, at_s: demonstration.times_s[at] },
    shown_s: demonstration.times_s.at(-1)! - demonstration.times_s[0]!,
    planned_s: planned.plan.duration_s,
    places,
    ...(planned.kind === "planned" ? {} : { step: planned.stuck.step, sentence: planned.stuck.sentence }),
  });
  return planned.kind === "planned" ? 0 : 1;
}

const tableOf = (points: readonly Vector3[]): string =>
  `x_m,y_m,z_m\n${points.map(point => point.map(v => v.toFixed(6)).join(",")).join("\n")}\n`;

function onPallet(options: Given, program: Program): { readonly program: Program; readonly places: number } {
  const text = options.text("pallet");
  if (text === undefined) return { program, places: 1 };
  const corners = text.split(";").map(corner => vectorOf("pallet", corner));
  if (corners.length !== 3)
    throw new UseFault(`--pallet has ${corners.length} corners; three are needed: place 1, end of row, end of column.`);
  const count = (name: "rows" | "columns"): number => {
    const value = options.number(name) ?? NaN;
    if (!Number.isInteger(value) || value < 1 || value > 1000) throw new UseFault(`--${name} wants 1 to 1000.`);
    return value;
  };
  const answer = repeatOnPallet(program, "pallet", {
    frame: "world",
    origin: pose(corners[0]),
    rowEnd: corners[1]!,
    columnEnd: corners[2]!,
    rows: count("rows"),
    columns: count("columns"),
    layers: 1,
    layer_m: 0,
  });
  if (answer.kind === "refused") throw new UseFault(answer.sentence);
  return answer;
}

function vectorOf(name: string, text: string): Vector3 {
  const values = text.split(",").map(part => (part.trim() === "" ? NaN : Number(part)));
  if (values.length !== 3 || !values.every(Number.isFinite))
    throw new UseFault(`--${name} wants x,y,z in metres, not "${text}".`);
  return values as Vector3;
}

async function fromRaw(options: Given, [path]: readonly string[]): Promise<number> {
  if (path === undefined) throw new UseFault("FILE is missing.", 'Give the path of a table, or "-".');
  const out = outOf(options);
  const profilePath = options.text("hand");
  if (profilePath === undefined)
    throw new UseFault("--hand PROFILE is missing.", "twincell calibrate hand writes one for a person.");
  const profile = parseHandProfile(await readText(profilePath));
  if (!profile) throw new UseFault(`${profilePath} is no hand profile.`, "twincell calibrate hand writes one.");
  const start: Pose<"world", "tcp"> = pose(vectorOf("start", options.text("start") ?? "0,0,0"), [1, 0, 0, 0]);
  const answer = readRawHand(await readText(path), profile, start);
  if (answer.kind === "unreadable") throw new UseFault(`${path}: line ${answer.line}: ${answer.sentence}`);
  await writeOne(out, writeDemonstration(answer.demonstration));
  const { times_s, closed } = answer.demonstration;
  say({
    kind: "demonstration",
    hand: profile.name,
    samples: times_s.length,
    dropped: answer.dropped,
    rate_Hz: sampleRate_Hz(answer.demonstration),
    grips: closed.filter((each, i) => i > 0 && each !== closed[i - 1]).length,
  });
  return 0;
}

async function score(options: Given, [expertPath, ...paths]: readonly string[]): Promise<number> {
  if (expertPath === undefined || paths.length === 0)
    throw new UseFault("An expert's table and at least one attempt are needed.");
  const within_mm = options.number("within-mm");
  const within_s = options.number("within-s");
  const pathRatio = options.number("path-ratio");
  const { demonstration: expert } = await demonstrationOf(expertPath);
  const attempts = [];
  for (const path of paths)
    attempts.push(
      judgeAttempt((await demonstrationOf(path)).demonstration, expert, {
        within_m: within_mm === undefined ? undefined : within_mm / 1000,
        within_s,
        pathRatio,
      }),
    );
  attempts.forEach(({ deviation, ...attempt }, i) => {
    say({ attempt: paths[i], ...attempt, max_mm: 1000 * deviation.max_m, rms_mm: 1000 * deviation.rms_m });
  });
  const best = bestAttempt(attempts);
  say({ kind: "best", attempt: paths[best], score: attempts[best]!.score, accepted: attempts[best]!.accepted });
  return attempts.some(({ accepted }) => accepted) ? 0 : 1;
}
