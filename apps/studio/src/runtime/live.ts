import { copyPose, identity, type Pose, type Robot } from "@twincell/core";

/**
 * The fast state of the robot on screen: written in place many times a second, read by the frame loop, never by React.
 * Whoever is in charge (jog, play, twin, history) writes through `showJoints`; the scene and the read-outs only read.
 */
export interface Live {
  /**
   * Joint angles shown now, as many as the robot has joints [rad]. Written in place; another array after another robot
   * came.
   */
  q_rad: Float64Array;
  readonly baseFromFlange: Pose<"base", "flange">;
  readonly worldFromTcp: Pose<"world", "tcp">;
  /** Counts up with every change, so that readers can skip work. */
  revision: number;
}

const live: Live = { q_rad: new Float64Array(6), baseFromFlange: identity(), worldFromTcp: identity(), revision: 0 };
export const theLive = (): Readonly<Live> => live;

/** Names of solids in contact now; the scene paints them red. Replaced whole, compared by identity. */
let touching: ReadonlySet<string> = new Set();
const touchListeners = new Set<(touching: ReadonlySet<string>) => void>();
export const touchingNow = (): ReadonlySet<string> => touching;
export function setTouching(names: ReadonlySet<string>): void {
  if (names.size === touching.size && [...names].every(name => touching.has(name))) return;
  touching = names;
  for (const listen of touchListeners) listen(names);
}
export function onTouching(listen: (touching: ReadonlySet<string>) => void): () => void {
  touchListeners.add(listen);
  return () => touchListeners.delete(listen);
}

export interface LivePoses {
  flange(q_rad: ArrayLike<number>, out: Pose<"base", "flange">): void;
  tcp(baseFromFlange: Pose<"base", "flange">, out: Pose<"world", "tcp">): void;
}
let poses: LivePoses | undefined;
/**
 * Called once per robot and tool by whoever owns the cell document. `atHome`: the robot begins at its home position.
 */
export function followPoses(robot: Robot, how: LivePoses, atHome = false): void {
  poses = how;
  if (live.q_rad.length !== robot.arm.joints.length) live.q_rad = Float64Array.from(robot.home_rad);
  showJoints(atHome ? robot.home_rad : live.q_rad);
}

/** Shows these joint angles from the next frame on. */
export function showJoints(q_rad: ArrayLike<number>): void {
  for (let i = 0; i < live.q_rad.length; i++) live.q_rad[i] = q_rad[i]!;
  if (poses) {
    poses.flange(live.q_rad, live.baseFromFlange);
    poses.tcp(live.baseFromFlange, live.worldFromTcp);
  }
  live.revision++;
}
export const tcpNow = (out: Pose<"world", "tcp"> = identity()): Pose<"world", "tcp"> =>
  copyPose(live.worldFromTcp, out);
