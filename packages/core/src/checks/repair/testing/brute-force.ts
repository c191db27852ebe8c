import { flangePose, linkPoses } from "../../../kinematics/forward.ts";
import { allBranches, solveAll } from "../../../kinematics/inverse.ts";
import { withRoom } from "../../../kinematics/pose-fit.ts";
import type { Robot } from "../../../model/robot.ts";
import { compose, identity, inverse, type Pose } from "../../../spatial/pose.ts";
import { distance, type Vector3 } from "../../../spatial/vector.ts";
import type { Random } from "../../../random.ts";
import { changedPose, type PoseChange } from "../change.ts";
import { levelShift, LIFT, SPIN, TILT, type ChangeSearch } from "../least-change.ts";
import { REPAIR_ROOM_RAD } from "../pose-repair.ts";

/*
 * What binds a pose and what the least repair is, found by trying everything: slow, simple, and without the searches of
 * the code under test.
 */

const TURN = 2 * Math.PI;
export const TOOL: Pose<"flange", "tcp"> = { position: [0.05, 0, 0.15], quaternion: [0, 0, 0, 1] };
export const FLANGE_IN_TOOL = inverse(TOOL);

/** Poses of a tool that the robot cannot reach: postures beyond its limits, and 2 of 5 of them moved outwards. */
export function* infeasiblePoses(robot: Robot, random: Random): Generator<Pose<"base", "tcp">, never> {
  for (;;) {
    const q = robot.arm.joints.map(({ limits: { lower_rad, upper_rad } }) => {
      const half = Math.min(1.3 * ((upper_rad - lower_rad) / 2), 6);
      return (lower_rad + upper_rad) / 2 + (2 * random() - 1) * half;
    });
    const pose = compose(flangePose(robot.arm, q), TOOL);
    const outwards = random() < 0.4 ? 1 + random() * 0.5 : 1;
    for (let i = 0; i < 3; i++) pose.position[i]! *= outwards;
    if (solveAll(robot, compose(pose, FLANGE_IN_TOOL)).kind !== "reached") yield pose;
  }
}

/** Of all branches and whole turns the posture whose worst joint is least beyond its limit; how far that is [rad]. */
export function leastBeyond(robot: Robot, baseFromFlange: Pose<"base", "flange">): { joint: number; over: number } {
  let least = { joint: 0, over: Infinity };
  for (const q of allBranches(robot, baseFromFlange)) {
    const overs = robot.arm.joints.map(({ limits: { lower_rad, upper_rad } }, j) =>
      Math.min(...[-2, -1, 0, 1, 2].map(k => Math.max(0, lower_rad - q[j]! - TURN * k, q[j]! + TURN * k - upper_rad))),
    );
    const over = Math.max(...overs);
    if (over < least.over) least = { joint: overs.indexOf(over) + 1, over };
  }
  return least;
}

/**
 * By how much the wrist would be too far from the shoulder or too near to it [m], from forward kinematics alone: the
 * lengths by turning joint 3 all the way, the distance by turning joint 1 all the way.
 */
export class WristDistance {
  private readonly robot: Robot;
  private readonly flangeFromWrist: Vector3;
  private readonly shoulders: readonly Vector3[];
  readonly farthest_m: number;
  readonly nearest_m: number;

  constructor(robot: Robot) {
    this.robot = robot;
    const zero = new Float64Array(6);
    this.flangeFromWrist = compose(inverse(flangePose(robot.arm, zero)) as Pose, this.links(zero)[5]! as Pose).position;
    const lengths = Array.from({ length: 20_000 }, (_, k) => {
      const links = this.links([0, 0, (TURN * k) / 20_000, 0, 0, 0]);
      return distance(links[2]!.position, links[5]!.position);
    });
    this.farthest_m = Math.max(...lengths);
    this.nearest_m = Math.min(...lengths);
    this.shoulders = Array.from(
      { length: 4_000 },
      (_, k) => this.links([(TURN * k) / 4_000, 0, 0, 0, 0, 0])[2]!.position,
    );
  }

  /** More than 0: too far by so much; less: too near. */
  miss(baseFromFlange: Pose<"base", "flange">): number {
    const wrist = compose(baseFromFlange as Pose, {
      position: this.flangeFromWrist,
      quaternion: [0, 0, 0, 1],
    }).position;
    let far = Infinity;
    let near = Infinity;
    for (const shoulder of this.shoulders) {
      // The arm's plane holds axis 1 and the wrist: only there is the shoulder as near or as far as it gets.
      const d = distance(shoulder, wrist);
      far = Math.min(far, d - this.farthest_m);
      near = Math.min(near, this.nearest_m - d);
    }
    return far > 0 ? far : -near;
  }

  private links(q: ArrayLike<number>): Pose<"base", "link">[] {
    const links = Array.from({ length: 7 }, () => identity<"base", "link">());
    linkPoses(this.robot.arm, q, links);
    return links;
  }
}

/** Whether a pose of the tool can be reached with the room that repairs leave: every branch, every whole turn. */
export function reachable(robot: Robot): (baseFromTcp: Pose<"base", "tcp">) => boolean {
  const narrow = withRoom(robot, REPAIR_ROOM_RAD);
  return pose => leastBeyond(narrow, compose(pose, FLANGE_IN_TOOL)).over === 0;
}

/** The least amounts of spin, tilt and shift, on grids finer than those of the search. */
export function bruteRepairs(
  pose: Pose<"base", "tcp">,
  fits: (pose: Pose<"base", "tcp">) => boolean,
): Readonly<Record<PoseChange["kind"], number | undefined>> {
  const least = (search: ChangeSearch, directions: number, step: number, most = search.most): number | undefined => {
    for (let amount = step; amount < most + 1e-9; amount += step)
      for (let k = 0; k < directions; k++)
        if (fits(changedPose(pose, search.change((k * search.directions) / directions, amount)))) return amount;
    return undefined;
  };
  const level = least(levelShift(Math.atan2(pose.position[1], pose.position[0])), 48, GRID.shift);
  const lift = least(LIFT, 2, GRID.shift, Math.min(LIFT.most, level ?? LIFT.most));
  return {
    spin: least(SPIN, 2, GRID.spin),
    tilt: least(TILT, 48, GRID.tilt),
    shift: lift ?? level,
  };
}
/** Steps of the brute force [rad, m]. */
export const GRID = { spin: Math.PI / 720, tilt: Math.PI / 360, shift: 0.005 } as const;
