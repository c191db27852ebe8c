import { explainReach } from "../kinematics/explain.ts";
import { branchOf } from "../kinematics/branch.ts";
import type { Reach } from "../kinematics/reach.ts";
import { isSlide } from "../model/slide.ts";
import type { Robot } from "../model/robot.ts";
import type { Jogged, JogBlock } from "./jogged.ts";

/**
 * One step of each joint at its own speed. Where one is asked for more than it can do, all are slowed by the same
 * share; a joint at its limit stops there and the others go on. A joint that stands outside its limits can only come
 * back.
 */
export function jogJoints(
  robot: Robot,
  q: ArrayLike<number>,
  speed_rad_s: ArrayLike<number>,
  dt_s: number,
  out: Float64Array,
): Jogged {
  const joints = robot.arm.joints;
  const blocked: JogBlock[] = [];
  let load = 1;
  for (let j = 0; j < joints.length; j++) {
    const speed = speed_rad_s[j]!;
    if (!Number.isFinite(speed) || !Number.isFinite(q[j]!) || !(dt_s > 0)) {
      for (let k = 0; k < joints.length; k++) out[k] = q[k]!;
      const reach: Reach = {
        kind: "not-a-pose",
        because: `The jog speed of joint ${j + 1}, its angle or the duration is not a finite number.`,
      };
      return { kind: "blocked", blocked: [{ coordinate: j + 1, reach, sentence: explainReach(reach) }] };
    }
    load = Math.max(load, Math.abs(speed) / joints[j]!.limits.speed_rad_s);
  }
  let asked = false;
  let moved = false;
  for (let j = 0; j < joints.length; j++) {
    const { lower_rad, upper_rad } = joints[j]!.limits;
    const from = q[j]!;
    const wanted_rad = from + (speed_rad_s[j]! * dt_s) / load;
    const to =
      wanted_rad > from
        ? Math.min(wanted_rad, Math.max(upper_rad, from))
        : Math.max(wanted_rad, Math.min(lower_rad, from));
    asked ||= wanted_rad !== from;
    moved ||= to !== from;
    out[j] = to;
    if (to !== wanted_rad) blocked.push(stopAt(robot, q, j, wanted_rad, wanted_rad > from ? upper_rad : lower_rad));
  }
  return moved || !asked ? { kind: "moved", fraction: 1 / load, blocked } : { kind: "blocked", blocked };
}

function stopAt(robot: Robot, q: ArrayLike<number>, j: number, wanted_rad: number, limit_rad: number): JogBlock {
  const branch = branchOf(robot, q) ?? { shoulder: "front", elbow: "up", wrist: "positive" };
  const reach: Reach = {
    kind: "outside-limits",
    joint: j + 1,
    wanted_rad,
    limit_rad,
    branch,
    ...(isSlide(robot.arm.joints[j]!) ? { slides: true } : {}),
  };
  return { coordinate: j + 1, reach, sentence: explainReach(reach) };
}
