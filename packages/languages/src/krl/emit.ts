import {
  everyStep,
  type Capability,
  type Dialect,
  type EmittedFile,
  type MoveStep,
  type Program,
  type Robot,
  type Step,
} from "@twincell/core";
import {
  KRL_LINES,
  arcWithoutVia,
  counted,
  firstFlaw,
  lacking,
  tellsRobot,
  unresolved,
  wholeEmitterOf,
  type Cannot,
  type NumberedLines,
} from "../emitter/index.ts";
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

const LINES: NumberedLines = { language: "KRL", ranges: KRL_LINES, counting: "$IN and $OUT count from 1" };

/** The module (.src) and its data list (.dat), or the step that stands in the way: never a part of a program. */
export const emitKrl = wholeEmitterOf({
  id: "krl",
  cannot: CANNOT,
  idioms: IDIOMS,
  strange: robot => `How KRL counts the axes of the ${robot.name} is not known.`,
  write: ({ place, section }) => {
    const { program, robot } = place;
    const steps = [...everyStep(program)];
    const refusal =
      firstFlaw(steps, step => lacking(step, { language: "KRL", cannot: CANNOT, hints: HINTS })) ??
      firstFlaw(steps, step => unresolved(program, step, LINES) ?? arcWithoutVia(step));
    if (refusal !== undefined) return refusal;
    const configurations = configurationsOf(place, section);
    if (configurations.kind === "cannot") return configurations;
    const gripper = gripperOutput(program);
    const files = new ModuleWriter(place, section, configurations.of, gripper).write();
    return tooLong(files) ?? { kind: "emitted", files, warnings: warnings(program, robot, steps, gripper) };
  },
});

function tooLong(files: readonly EmittedFile[]): Cannot | undefined {
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
  const said = tellsRobot(program, robot);
  const moves = steps.filter((step): step is MoveStep => step.type === "move");
  const max = robot.maxTcpSpeed_mps;
  const joint = moves.filter(({ path }) => path === "ptp");
  const paths = moves.filter(({ path }) => path !== "ptp");
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
