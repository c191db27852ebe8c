import {
  armScratch,
  compose,
  flangePose,
  identity,
  samplePlan,
  type CarriedPart,
  type Plan,
  type Pose,
  type Robot,
  type Vector3,
} from "@twincell/core";
import { carriedPose } from "./carried.ts";

/** One moment of a work piece in the program: its frame in the world. */
export interface PathMoment {
  readonly t_s: number;
  readonly at_m: Vector3;
}

/** Simulation interval of the drawn path [s]. */
const STEP_S = 0.01;

/**
 * The complete path of one work piece through a program (row M-66): from where the cell has it, along with the gripper
 * each time it is taken, to where it is put last. One moment every 10 ms while it is carried, and those in which it is
 * taken and put; between holds it lies still.
 *
 * @param carried  of the plan's check. @param id  of the work piece.
 * @returns nothing for a part that the program does not take.
 */
export function workPiecePath(
  carried: readonly CarriedPart[],
  id: string,
  plan: Plan,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
): readonly PathMoment[] {
  const scratch = armScratch();
  const q = new Float64Array(robot.arm.joints.length);
  const flange = identity<"base", "flange">();
  const worldFromFlange = identity<"world", "flange">();
  const place = identity<"world", "object">();
  const moments: PathMoment[] = [];
  const add = (t_s: number, at: Pose<"world", "object">): void => {
    moments.push({ t_s, at_m: [...at.position] as Vector3 });
  };
  for (const hold of carried.filter(part => part.id === id)) {
    const end_s = hold.put_s ?? plan.duration_s;
    add(hold.taken_s, hold.taken.worldFromObject);
    const steps = Math.max(1, Math.ceil((end_s - hold.taken_s) / STEP_S));
    for (let i = 1; i < steps + (hold.put_s === undefined ? 1 : 0); i++) {
      const t_s = Math.min(end_s, hold.taken_s + i * STEP_S);
      samplePlan(plan, t_s, q);
      flangePose(robot.arm, q, flange, scratch);
      compose(worldFromBase, flange, worldFromFlange);
      const at = carriedPose(carried, id, t_s, worldFromFlange, place);
      if (at) add(t_s, at);
    }
    if (hold.put_s !== undefined && hold.put) add(hold.put_s, hold.put.worldFromObject);
  }
  return moments;
}

/** Along all of its moments [m]. */
export const pathLength = (moments: readonly PathMoment[]): number =>
  moments.reduce((sum, { at_m: [x, y, z] }, i) => {
    const before = moments[i - 1]?.at_m;
    return before ? sum + Math.hypot(x - before[0], y - before[1], z - before[2]) : sum;
  }, 0);

/** Seconds and millimetres, one line a moment. */
export const pathText = (moments: readonly PathMoment[]): string =>
  [
    "t_s,x_mm,y_mm,z_mm",
    ...moments.map(({ t_s, at_m }) => [t_s, ...at_m.map(value => value * 1000)].map(value => value.toFixed(4)).join()),
  ].join("\n");
