import {
  capabilitiesOf,
  everyStep,
  lowered,
  type Capability,
  type Dialect,
  type Emitted,
  type EmittedFile,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  type Step,
  sectionForLanguage,
} from "@twincell/core";
import { KRL_LINES, WalkedPlace, linesLookedAt, outOfRange, writtenOr } from "../emitter/index.ts";
import { configurationsOf } from "./write/postures.ts";
import { ModuleWriter } from "./write/program.ts";
import { percentOf } from "./write/settings.ts";

/** What KRL has no statement for. */
export const CANNOT: Dialect["cannot"] = [{ what: "duration", because: "KRL gives a motion a speed and no duration." }];
/** What is written with other statements, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["timeout", "late", "wait-expression", "arguments"];
const HINTS: Readonly<Record<string, string>> = {
  duration: "Give the step a speed instead.",
};

/** Lines of code that every version of the controller takes. */
const LINE_LENGTH = 470;
const FASTEST_MPS = 3;

type Refusal = Extract<Emitted, { kind: "cannot" }>;

/** The module (.src) and its data list (.dat), or the step that stands in the way: never a part of a program. */
export function emitKrl(taught: Program, robot: Robot, worldFromBase: Pose<"world", "base">): Emitted {
  const program = lowered(taught, { idioms: IDIOMS, cannot: CANNOT });
  const convention = sectionForLanguage(robot, "krl");
  if (convention === undefined) {
    return {
      kind: "cannot",
      step: "",
      sentence: `How KRL counts the axes of the ${robot.name} is not known.`,
      hint: "Export in the language of this robot's own controller.",
    };
  }
  const steps = [...everyStep(program)];
  const refusal = refused(steps) ?? unresolved(program, steps);
  if (refusal !== undefined) return refusal;
  const place = new WalkedPlace(program, robot, worldFromBase);
  const configurations = configurationsOf(place, convention);
  if (configurations.kind === "cannot") return configurations;
  const gripper = gripperOutput(program);
  return writtenOr(() => {
    const files = new ModuleWriter(place, convention, configurations.of, gripper).write();
    return tooLong(files) ?? { kind: "emitted", files, warnings: warnings(program, robot, steps, gripper) };
  });
}

function tooLong(files: readonly EmittedFile[]): Refusal | undefined {
  for (const { name, text, lines } of files) {
    const long = text.split("\r\n").findIndex(line => line.length > LINE_LENGTH);
    if (long >= 0)
      return {
        kind: "cannot",
        step: lines[long] ?? "",
        sentence: `Line ${long + 1} of ${name} is longer than the ${LINE_LENGTH} characters that every controller takes.`,
        hint: "Shorten the names in that step.",
      };
  }
  return undefined;
}

function refused(steps: readonly Step[]): Refusal | undefined {
  for (const step of steps) {
    for (const capability of capabilitiesOf(step)) {
      const why = CANNOT.find(({ what }) => what === capability);
      if (why !== undefined)
        return {
          kind: "cannot",
          step: step.id,
          sentence: `Step ${step.name ?? step.id} asks for what KRL lacks. ${why.because}`,
          hint: HINTS[capability]!,
        };
    }
  }
  return undefined;
}

/** Names that lead nowhere: a signal without an address, a routine or a pallet that is not there. */
function unresolved(program: Program, steps: readonly Step[]): Refusal | undefined {
  for (const step of steps) {
    const called = `Step ${step.name ?? step.id}`;
    for (const name of signalsOf(step)) {
      const line = Object.hasOwn(program.signals, name) ? program.signals[name] : undefined;
      if (line === undefined)
        return {
          kind: "cannot",
          step: step.id,
          sentence: `${called} uses the signal "${name}", which the program does not have.`,
          hint: "Add the signal to the program.",
        };
      if (line.address === undefined)
        return {
          kind: "cannot",
          step: step.id,
          sentence: `${called} uses the signal "${name}", whose number on the controller is not given.`,
          hint: "Give the signal the number of its line: $IN and $OUT count from 1.",
        };
      const wrong = outOfRange("KRL", KRL_LINES, step, name, line);
      if (wrong !== undefined) return { kind: "cannot", step: step.id, ...wrong };
    }
    if (step.type === "call" && !Object.hasOwn(program.routines, step.routine))
      return {
        kind: "cannot",
        step: step.id,
        sentence: `${called} calls "${step.routine}", which the program does not have.`,
        hint: "Add the routine to the program.",
      };
    if (step.type === "pallet" && !Object.hasOwn(program.pallets, step.pallet))
      return {
        kind: "cannot",
        step: step.id,
        sentence: `${called} uses the pallet "${step.pallet}", which the program does not have.`,
        hint: "Add the pallet to the program.",
      };
    if (step.type === "move" && step.path === "circ" && step.via === undefined)
      return {
        kind: "cannot",
        step: step.id,
        sentence: `${called} is an arc without a point to pass through.`,
        hint: "Teach the point in the middle of the arc.",
      };
  }
  return undefined;
}

function signalsOf(step: Step): string[] {
  switch (step.type) {
    case "set":
      return [step.signal];
    case "wait-for":
    case "if":
    case "while":
    case "assign":
      return [...linesLookedAt(step)];
    case "move":
      return step.until === undefined ? [] : [step.until.when.signal];
    default:
      return [];
  }
}

/** The first output that no signal of the program has. */
function gripperOutput({ signals }: Program): number {
  const used = new Set(
    Object.values(signals).flatMap(({ kind, address }) =>
      kind === "digital-out" && address !== undefined ? [address] : [],
    ),
  );
  for (let n = 1; ; n++) if (!used.has(n)) return n;
}

function warnings(program: Program, robot: Robot, steps: readonly Step[], gripper: number): string[] {
  const said: string[] = [];
  const moves = steps.filter((step): step is MoveStep => step.type === "move");
  const max = robot.maxTcpSpeed_mps;
  const joint = moves.filter(({ path }) => path === "ptp");
  const paths = moves.filter(({ path }) => path !== "ptp");
  if (program.robot !== robot.id)
    said.push(`The program was taught on ${program.robot} and is written for ${robot.id}.`);
  const rounded = joint.filter(
    ({ speed }) => "ratio" in speed && Math.abs(percentOf(speed, max) - speed.ratio * 100) > 1e-6,
  ).length;
  if (rounded > 0)
    said.push(
      `KRL takes axis speeds in whole percent: ${counted(rounded, "joint motion is", "joint motions are")} rounded.`,
    );
  const paced = joint.filter(({ speed }) => "mps" in speed).length;
  if (paced > 0)
    said.push(
      `KRL gives joint motions a share of the axis speeds: on ${counted(paced, "joint motion", "joint motions")} the speed in mm/s became its share of ${max} m/s.`,
    );
  const fast = paths.filter(
    ({ speed }) => ("mps" in speed ? speed.mps : "ratio" in speed ? speed.ratio * max : 0) > FASTEST_MPS,
  ).length;
  if (fast > 0)
    said.push(`${counted(fast, "path is", "paths are")} faster than ${FASTEST_MPS} m/s, where most controllers end.`);
  if (moves[0] !== undefined && moves[0].path !== "ptp")
    said.push(
      "The first motion is not PTP: the controller asks for a PTP motion first, since only that is the same from wherever the robot stands.",
    );
  if (steps.some(({ type }) => type === "gripper"))
    said.push(
      `The gripper is written to $OUT[${gripper}], TRUE closes: change the number after SIGNAL GRIPPER to that of your cell.`,
    );
  if (moves.some(({ path }) => path === "spline")) said.push("SPLINE blocks need KSS 8 (KR C4 and later).");
  if (steps.some(({ type }) => type === "message")) said.push("MsgNotify needs KSS 8 (KR C4 and later).");
  if (moves.some(({ acceleration, path }) => acceleration !== undefined && path !== "ptp"))
    said.push("Accelerations of paths are written as shares of DEF_ACC_CP, the controller's own value.");
  return said;
}

const counted = (count: number, one: string, more: string): string => `${count} ${count === 1 ? one : more}`;
