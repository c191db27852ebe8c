import { armScratch, compose, flangePose, identity, type Pose, type Robot, type Vector3 } from "@twincell/core";
import type { Trace } from "@twincell/recording";

/** Where the robot stands and what it carries, for drawing where its tool went. */
export interface PathWorld {
  readonly worldFromBase: Pose<"world", "base">;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
}

/** A shorter step is not drawn. */
const LEAST_STEP_M = 0.001;

/** The way of the tool in the world along a trace. */
export function wayOf(trace: Trace, robot: Robot, { worldFromBase, flangeFromTcp }: PathWorld): Vector3[] {
  const scratch = armScratch();
  const flange = identity<"base", "flange">();
  const worldFromFlange = identity<"world", "flange">();
  const tcp = identity<"world", "tcp">();
  const way: Vector3[] = [];
  for (let row = 0; row < trace.rows; row++) {
    flangePose(robot.arm, trace.q_rad.subarray(row * trace.joints, (row + 1) * trace.joints), flange, scratch);
    compose(compose(worldFromBase, flange, worldFromFlange), flangeFromTcp, tcp);
    const [x, y, z] = tcp.position;
    const last = way.at(-1);
    if (!last || Math.hypot(x - last[0], y - last[1], z - last[2]) >= LEAST_STEP_M) way.push([x, y, z]);
  }
  return way;
}
