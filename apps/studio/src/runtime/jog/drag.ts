import {
  allBranches,
  angleBetween,
  type Branch,
  branchOf,
  compose,
  copyPose,
  degrees,
  distance,
  explainReach,
  identity,
  inverse,
  lerp,
  nearestSolution,
  outOfReach,
  slerp,
  solverScratch,
  travel,
  wrapAngle,
  type Pose,
  type Robot,
} from "@twincell/core";
import { jogStore } from "../../stores/jog.ts";
import { sound } from "../../stores/sound.ts";
import { onStop } from "../../stores/stop.ts";
import { moveByHand } from "./hand-motion.ts";
import { theLive } from "../live.ts";
import { leaveRobot, takeRobot } from "../robot/motion-owner.ts";

/** Where a drag got to: all the way, or as far as the robot can, with the reason. */
export type DragOutcome =
  | { readonly kind: "moved" }
  | { readonly kind: "on-the-way" }
  | { readonly kind: "blocked"; readonly sentence: string; readonly joint?: number };
type Blocked = Extract<DragOutcome, { readonly kind: "blocked" }>;
const MOVED: DragOutcome = { kind: "moved" };
const ON_THE_WAY: DragOutcome = { kind: "on-the-way" };

/** A hand that jumps (tracking lost, two pointers taken for one) moves the robot by no more than this in one call. */
const LONGEST_STEP_M = 0.08;
/** Per coordinate, so that the three together keep to it too. */
const LONGEST_SIDE_M = LONGEST_STEP_M / Math.sqrt(3);
const LONGEST_TURN_RAD = 0.3;
/** Near a singularity a small step of the tool would throw a joint round: then the drag is blocked instead. */
const LONGEST_JOINT_STEP_RAD = 0.6;
const HALVINGS = 7;
/** The coordinate that meets a limit rests this long, so that the person notices (row N-40). */
const PAUSE_MS = 500;
/** Numbers in a sentence change with every movement: they are read this often. */
const TELL_EVERY_MS = 150;
const REFUSED_MS = 3000;
let met = false;
let told_ms = 0;

interface Followed {
  readonly robot: Robot;
  readonly baseFromWorld: Pose<"base", "world">;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
}
let followed: Followed | null = null;

/** Whose tool is dragged. Called whenever robot, place or tool change. */
export function dragFollows(
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  flangeFromTcp: Pose<"flange", "tcp">,
): void {
  const joints = robot.arm.joints.length;
  if (q.length !== joints) {
    q = new Float64Array(joints);
    best = new Float64Array(joints);
  }
  followed = { robot, baseFromWorld: inverse(worldFromBase), flangeFromTcp };
}

const scratch = solverScratch();
let q = new Float64Array(6);
let best = new Float64Array(6);
const baseFromTcp: Pose<"base", "tcp"> = identity();
const baseFromFlange: Pose<"base", "flange"> = identity();
const tcpFromFlange: Pose<"tcp", "flange"> = identity();
const from: Pose<"world", "tcp"> = identity();
const step: Pose<"world", "tcp"> = identity();
const trial: Pose<"world", "tcp"> = identity();

/** Solves for the tool tip at `worldFromTcp`, continuing from `near`; q is written when it can be reached. */
function reaches(
  { robot, baseFromWorld, flangeFromTcp }: Followed,
  worldFromTcp: Pose<"world", "tcp">,
  near: Float64Array,
): boolean {
  compose(baseFromWorld, worldFromTcp, baseFromTcp);
  compose(baseFromTcp, inverse(flangeFromTcp, tcpFromFlange), baseFromFlange);
  if (!nearestSolution(robot, baseFromFlange, near, q, scratch)) return false;
  for (let i = 0; i < q.length; i++) if (Math.abs(q[i]! - near[i]!) > LONGEST_JOINT_STEP_RAD) return false;
  return true;
}

/**
 * Why the posture of `near` cannot be kept at that pose: out of reach, a joint at its limit, or axes in line.
 * Allocates: only called while a drag is blocked.
 */
function reason(
  { robot, baseFromWorld, flangeFromTcp }: Followed,
  worldFromTcp: Pose<"world", "tcp">,
  near: Float64Array,
): Blocked {
  const pose = compose(compose(baseFromWorld, worldFromTcp), inverse(flangeFromTcp));
  const copies = allBranches(robot, pose, near).map(branch =>
    branch.map((angle, i) => near[i]! + wrapAngle(angle - near[i]!)),
  );
  const nearest = copies.toSorted((a, b) => travel(a, near) - travel(b, near))[0];
  if (!nearest) return { kind: "blocked", sentence: explainReach(outOfReach(robot, pose)) };
  for (const [i, { limits }] of robot.arm.joints.entries()) {
    const wanted_rad = nearest[i]!;
    const limit_rad = wanted_rad > limits.upper_rad ? limits.upper_rad : limits.lower_rad;
    if (wanted_rad >= limits.lower_rad && wanted_rad <= limits.upper_rad) continue;
    return {
      kind: "blocked",
      joint: i + 1,
      sentence: explainReach({
        kind: "outside-limits",
        joint: i + 1,
        wanted_rad,
        limit_rad,
        branch: branchOf(robot, near) ?? ANY_BRANCH,
      }),
    };
  }
  let joint = 0;
  for (let i = 1; i < near.length; i++)
    if (Math.abs(nearest[i]! - near[i]!) > Math.abs(nearest[joint]! - near[joint]!)) joint = i;
  return {
    kind: "blocked",
    joint: joint + 1,
    sentence: `Joint ${joint + 1} would have to turn by ${degrees(Math.abs(nearest[joint]! - near[joint]!)).toFixed(0)}° at once: ${robot.family.kind === "ortho-parallel" ? "axes 4 and 6 are almost in line" : "the arm is almost singular here"}.`,
  };
}
const ANY_BRANCH: Branch = { shoulder: "front", elbow: "up", wrist: "positive" };

/** Goes from `from` towards `to` as far as it can in one direction; `from` and `best` hold where it got to. */
function advance(robot: Followed, to: Pose<"world", "tcp">): boolean {
  if (reaches(robot, to, best)) {
    copyPose(to, from);
    best.set(q);
    return true;
  }
  let low = 0;
  let high = 1;
  for (let i = 0; i < HALVINGS; i++) {
    const middle = (low + high) / 2;
    lerp(from.position, to.position, middle, trial.position);
    slerp(from.quaternion, to.quaternion, middle, trial.quaternion);
    if (reaches(robot, trial, best)) low = middle;
    else high = middle;
  }
  lerp(from.position, to.position, low, trial.position);
  slerp(from.quaternion, to.quaternion, low, trial.quaternion);
  if (low > 0 && reaches(robot, trial, best)) {
    copyPose(trial, from);
    best.set(q);
  }
  return false;
}

/**
 * Brings the tool tip towards a pose, at most one clamped step per call. Where the robot cannot follow, each coordinate
 * goes as far as it can for itself: at the edge of reach one is blocked and the others stay free (rows N-39, N-41).
 * Allocates nothing while it moves freely.
 */
export function dragTcp(worldFromTcp: Pose<"world", "tcp">): DragOutcome {
  if (!followed) return { kind: "blocked", sentence: "There is no robot in the cell." };
  const live = theLive();
  copyPose(live.worldFromTcp, from);
  best.set(live.q_rad);
  const length = distance(from.position, worldFromTcp.position);
  const turn = angleBetween(from.quaternion, worldFromTcp.quaternion);
  const share = Math.min(1, LONGEST_STEP_M / Math.max(length, 1e-12), LONGEST_TURN_RAD / Math.max(turn, 1e-12));
  lerp(from.position, worldFromTcp.position, share, step.position);
  slerp(from.quaternion, worldFromTcp.quaternion, share, step.quaternion);
  if (reaches(followed, step, best)) {
    const met = moveByHand(q);
    if (met.kind === "stopped") {
      const contact: Blocked = { kind: "blocked", sentence: met.sentence };
      block(contact);
      return contact;
    }
    free();
    return share < 1 ? ON_THE_WAY : MOVED;
  }

  const why = reason(followed, step, live.q_rad);
  const target: Pose<"world", "tcp"> = {
    position: [from.position[0], from.position[1], from.position[2]],
    quaternion: [from.quaternion[0], from.quaternion[1], from.quaternion[2], from.quaternion[3]],
  };
  // Each for itself: one that is pulled far beyond its limit does not slow the others down.
  for (let k = 0; k < 3; k++) {
    target.position[k] =
      from.position[k]! +
      Math.max(-LONGEST_SIDE_M, Math.min(LONGEST_SIDE_M, worldFromTcp.position[k]! - from.position[k]!));
    advance(followed, target);
    copyPose(from, target);
  }
  slerp(
    from.quaternion,
    worldFromTcp.quaternion,
    Math.min(1, LONGEST_TURN_RAD / Math.max(turn, 1e-12)),
    target.quaternion,
  );
  advance(followed, target);
  moveByHand(best);
  block(why);
  return why;
}

/** Sounds once when a limit is met, and keeps the reason in sight as long as the hand pulls against it. */
function block(why: Blocked): void {
  const now_ms = performance.now();
  const { blocked } = jogStore.getState();
  if (!met) sound("limit");
  else if (blocked && now_ms - told_ms < TELL_EVERY_MS) return;
  met = true;
  told_ms = now_ms;
  const until_ms = now_ms + PAUSE_MS;
  jogStore.setState({
    blocked:
      why.joint === undefined
        ? { sentence: why.sentence, until_ms }
        : { sentence: why.sentence, joint: why.joint, until_ms },
  });
}
function free(): void {
  met = false;
  if (jogStore.getState().blocked) jogStore.setState({ blocked: null });
}

/** Says why a drag was ended by itself. */
export function refuseDrag(sentence: string): void {
  sound("limit");
  jogStore.setState({ blocked: { sentence, until_ms: performance.now() + REFUSED_MS } });
}

/**
 * The hand takes the tool. @param onLost  called when the drag must end: STOP, or somebody else moves the robot.
 * Returns what ends it.
 */
export function beginDrag(onLost: () => void): () => void {
  takeRobot("drag", onLost);
  const stopListening = onStop(onLost);
  return () => {
    stopListening();
    leaveRobot("drag");
    free();
  };
}
