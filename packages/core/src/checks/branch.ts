import { branchOf, sameBranch, type Branch } from "../kinematics/branch.ts";
import type { Lost } from "../trajectory/continuity/index.ts";
import { blends, type Move } from "../trajectory/moves.ts";
import { isSlide, jointText } from "../model/slide.ts";
import { LIMIT_SLACK_RAD } from "../trajectory/run.ts";
import { radians } from "../spatial/units.ts";
import type { Repair } from "./verdict.ts";
import { jointMove, configurationRepairs } from "./repairs.ts";
import { deg, motions, startOf, type CheckScene } from "./scene.ts";

/** A joint move to a pose that turns a joint further than this has turned the arm over [rad]. */
const BIG_TURN_RAD = radians(150);
/** Joint angles this near to the taught ones are the taught ones [rad]. */
const SAME_RAD = 1e-4;

/**
 * Postures that are not the taught ones, or that no path leads through, at the end of a path, and joint moves that turn
 * the arm over on the way to a pose.
 */
export function checkBranch(scene: CheckScene): void {
  const n = scene.robot.arm.joints.length;
  for (const segment of scene.layout.plan.segments) {
    // A move of no length counts as well: its taught posture may still be another one.
    if (segment.kind === "rest") continue;
    const move = scene.layout.moves.get(segment.step);
    const rows = segment.times_s.length;
    if (move === undefined) continue;
    const last = segment.q_rad.subarray((rows - 1) * n);
    const at_s = segment.start_s + segment.duration_s;
    if (move.step.path === "ptp") {
      if (move.q_rad === undefined) checkTurnOver(scene, move, segment.q_rad.subarray(0, n), last, at_s);
      continue;
    }
    // A straight or circular path keeps its posture; where it blends on, the end is not the taught point.
    if (blends(move.step)) continue;
    const taught = move.q_rad;
    const arrived = branchOf(scene.robot, last);
    if (taught !== undefined) {
      const off = farthestJoint(taught, last);
      if (Math.abs(last[off]! - taught[off]!) > SAME_RAD) {
        scene.add(segment.step, "bad", {
          code: "branch.other",
          joint: off + 1,
          value: last[off]!,
          limit: taught[off]!,
          unit: isSlide(scene.robot.arm.joints[off]!) ? "m" : "rad",
          at_s,
          sentence: `Joint ${off + 1} would be at ${jointText(scene.robot.arm.joints[off]!, last[off]!)} at the end of the path; it was taught at ${jointText(scene.robot.arm.joints[off]!, taught[off]!)}.`,
          repairs: asJointMove(scene, segment.step),
        });
      }
    } else if (move.branch !== undefined && arrived !== undefined && !sameBranch(arrived, move.branch)) {
      scene.add(segment.step, "bad", {
        code: "branch.other",
        value: 1,
        limit: 0,
        unit: "1",
        at_s,
        sentence: `The path ends with ${words(arrived)}; it was taught with ${words(move.branch)}.`,
        repairs: asJointMove(scene, segment.step),
      });
    }
  }
}

/** The joint, from 0, whose values in two postures differ most. */
function farthestJoint(from: ArrayLike<number>, to: ArrayLike<number>): number {
  let farthest = 0;
  for (let j = 1; j < to.length; j++)
    if (Math.abs(to[j]! - from[j]!) > Math.abs(to[farthest]! - from[farthest]!)) farthest = j;
  return farthest;
}

/** A joint move to a pose that turns one joint far while the arm changes its configuration. */
function checkTurnOver(scene: CheckScene, move: Move, first: Float64Array, last: Float64Array, at_s: number): void {
  const joint = farthestJoint(first, last);
  const turn_rad = Math.abs(last[joint]! - first[joint]!);
  const before = branchOf(scene.robot, first);
  const after = branchOf(scene.robot, last);
  if (turn_rad <= BIG_TURN_RAD || before === undefined || after === undefined || sameBranch(before, after)) return;
  scene.add(move.step.id, "warn", {
    code: "branch.turn-over",
    joint: joint + 1,
    value: turn_rad,
    limit: BIG_TURN_RAD,
    unit: "rad",
    at_s,
    sentence: `Joint ${joint + 1} turns by ${deg(turn_rad)} while the arm changes from ${words(before)} to ${words(after)}.`,
    repairs: configurationRepairs(scene, move),
  });
}

/**
 * Where a path over its whole length has no posture, in numbers: how far the best one gets and why, or before which
 * step the arm would have to turn over. Only where the plan itself is in trouble, since a blend may pass beside what
 * stops the taught path.
 */
export function checkImpasses(scene: CheckScene): void {
  const { layout, robot } = scene;
  const joints = robot.arm.joints;
  const n = joints.length;
  if (layout.impasses.length === 0) return;
  const troubled = new Set(layout.obstacles.map(({ move }) => move.step.id));
  for (const { step, q_rad } of motions(scene)) {
    if (
      q_rad.some(
        (q, i) =>
          q < joints[i % n]!.limits.lower_rad - LIMIT_SLACK_RAD ||
          q > joints[i % n]!.limits.upper_rad + LIMIT_SLACK_RAD,
      )
    )
      troubled.add(step);
  }
  let stuck = false;
  for (const impasse of layout.impasses) {
    const id = impasse.move.step.id;
    const at_s = startOf(scene, id);
    if ("broken" in impasse) {
      const { best, tried, share } = impasse.broken;
      // What cannot be reached at all is said by `checkReach`.
      if (best === undefined || best.lost.kind === "out-of-reach" || !troubled.has(id)) continue;
      stuck = true;
      const how =
        tried.length === 1
          ? "The arm gets"
          : `Of ${tried.length} postures of the arm none gets through; the best${best.branch === undefined ? "" : `, ${words(best.branch)},`} gets`;
      scene.add(id, "bad", {
        code: "branch.no-way",
        ...("joint" in best.lost ? { joint: best.lost.joint } : {}),
        value: share,
        limit: 1,
        unit: "1",
        at_s,
        sentence: `${how} to ${(100 * share).toFixed(0)} % of the path, ${because(best.lost)}`,
        repairs: asJointMove(scene, id),
      });
    } else if (stuck || troubled.has(id)) {
      const { joint, way_rad, from, to } = impasse.flip;
      scene.add(id, "bad", {
        code: "branch.flip",
        joint,
        value: way_rad,
        limit: 0,
        unit: "rad",
        at_s,
        repairs: asJointMove(scene, id),
        sentence: `The path can only go on if the arm turns over before this step${from === undefined || to === undefined || sameBranch(from, to) ? "" : ` from ${words(from)} to ${words(to)}`}: joint ${joint} by ${deg(way_rad)} where it stands.`,
      });
    }
  }
}

function because(lost: Lost): string {
  switch (lost.kind) {
    case "limit":
      return `where joint ${lost.joint} would turn to ${deg(lost.wanted_rad)}; its limit is ${deg(lost.limit_rad)}.`;
    case "out-of-reach":
      return "where the arm does not reach.";
    case "singular":
      return `where joints would have to jump.${lost.near === undefined ? "" : ` ${lost.near}`}`;
  }
}

const words = (branch: Branch): string => `shoulder ${branch.shoulder}, elbow ${branch.elbow}, wrist ${branch.wrist}`;

function asJointMove(scene: CheckScene, id: string): Repair[] {
  const step = scene.layout.moves.get(id)?.step;
  return step === undefined
    ? []
    : [{ kind: "joint-move", sentence: "Make it a joint move.", replace: jointMove(step, step.target) }];
}
