import type { Emitted, MoveStep, Pose, Program, Robot } from "@twincell/core";
import { jointConvention } from "./robots.ts";
import { MOST_POINTS, pointList } from "./write/point-list.ts";
import { posturesOf, type Place } from "./write/postures.ts";
import { ProgramWriter } from "./write/program.ts";

/** The paths that V+ has no standard instruction for. */
export const CANNOT = [
  { what: "circ", because: "Arcs are an option of the controller that standard V+ does not have." },
  { what: "spline", because: "V+ moves on joint-interpolated and straight paths only." },
] as const;

/** The point list of the paper and the runnable program, or the step that stands in the way: never a part of a program. */
export function emitVPlus(program: Program, robot: Robot, worldFromBase: Pose<"world", "base">): Emitted {
  const convention = jointConvention(robot);
  if (convention === undefined) {
    return { kind: "cannot", step: "", sentence: `How V+ counts the joints of the ${robot.name} is not known.`, hint: "Export in the language of this robot's own controller." };
  }
  const moves = program.steps.filter((step): step is MoveStep => step.type === "move");
  const curved = moves.find(step => step.path === "circ" || step.path === "spline");
  if (curved !== undefined) {
    const because = CANNOT.find(({ what }) => what === curved.path)!.because;
    return { kind: "cannot", step: curved.id, sentence: `Step ${curved.name ?? curved.id} is a ${curved.path} move. ${because}`, hint: "Replace it by straight moves through points on the curve." };
  }
  const unsaid = program.steps.find(step => step.type !== "move" && step.type !== "wait" && step.type !== "gripper");
  if (unsaid !== undefined) return { kind: "cannot", step: unsaid.id, sentence: `Step ${unsaid.name ?? unsaid.id} is a ${unsaid.type} step, which is not written in V+ yet.`, hint: "Take the step out." };
  if (moves.length > MOST_POINTS) {
    return { kind: "cannot", step: moves[MOST_POINTS]!.id, sentence: `The program has ${moves.length} points; the array of the point list ends after ${MOST_POINTS}.`, hint: "Export it in parts." };
  }
  const place: Place = { robot, worldFromBase, tools: program.tools, frames: program.frames };
  const postures = posturesOf(moves, place);
  if (postures.kind === "cannot") return postures;
  return {
    kind: "emitted",
    files: [new ProgramWriter(program, place, convention, postures.q_rad).write(), pointList(moves, postures.q_rad, convention)],
    warnings: warnings(program, robot, moves),
  };
}

function warnings(program: Program, robot: Robot, moves: readonly MoveStep[]): string[] {
  const said: string[] = [];
  const blended = moves.filter(step => step.blend_m > 0);
  if (program.robot !== robot.id) said.push(`The program was taught on ${program.robot} and is written for ${robot.id}.`);
  if (blended.length > 0) said.push(`V+ has no blend radius: ${counted(blended.length, "step passes", "steps pass")} its point on a continuous path whose corner depends on the speed.`);
  const paced = moves.filter(step => step.path === "ptp" && "mps" in step.speed);
  if (paced.length > 0) said.push(`V+ holds a speed in mm/s on straight paths: on ${counted(paced.length, "joint motion", "joint motions")} it is a guide only.`);
  if (moves.some(({ target }) => "pose" in target)) said.push("RIGHTY is taken for a wrist in front of the shoulder axis and LEFTY for one behind it; try the first motion slowly.");
  return said;
}

const counted = (count: number, one: string, more: string): string => `${count} ${count === 1 ? one : more}`;
