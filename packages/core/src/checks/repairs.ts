import type { Reach } from "../kinematics/reach.ts";
import { nearestSolution, solveAll, solverScratch } from "../kinematics/inverse.ts";
import { isInsideWorkspace } from "../kinematics/workspace.ts";
import { branchOf, sameBranch } from "../kinematics/branch.ts";
import { compose, copyPose, inverse, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply } from "../spatial/quaternion.ts";
import { radians } from "../spatial/units.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { poseTarget, type Move } from "../trajectory/moves.ts";
import type { MoveStep, Target } from "../program/program.ts";
import type { Repair, RepairKind } from "./verdict.ts";
import type { CheckScene } from "./scene.ts";

const TILTS_DEG = [5, 10, 15, 20, 30, 45];
const SPINS_DEG = [15, 30, 45, 90, 135, 180];
const SHIFTS_M = [0.01, 0.02, 0.05, 0.1, 0.2];
const MOST_REPAIRS = 3;
type PoseTarget = Extract<Target, { pose: unknown }>;

/**
 * Steps like this one that can be reached, three at most: another posture, the tool tilted, turned about itself, the
 * target shifted; the least change of each kind.
 */
export function reachRepairs(scene: CheckScene, move: Move, reach?: Reach): Repair[] {
  const target = move.step.target;
  if (!("pose" in target)) return [];
  const near = scene.layout.starts.get(move.step.id) ?? Float64Array.from(scene.robot.home_rad);
  const out = new Float64Array(near.length);
  const scratch = solverScratch();
  const reachable = (baseFromTcp: Pose<"base", "tcp">): boolean =>
    nearestSolution(scene.robot, compose(baseFromTcp, move.tcpFromFlange), near, out, scratch) &&
    isInsideWorkspace(scene.robot, out);
  const found: Repair[] = [];
  const offer = (baseFromTcp: Pose<"base", "tcp">, kind: RepairKind, sentence: string): boolean => {
    if (!reachable(baseFromTcp)) return false;
    found.push({
      sentence,
      kind,
      replace: withTarget(move.step, withoutBranch(poseTarget(baseFromTcp, target, scene.context))),
    });
    return true;
  };
  const base = move.baseFromTcp;
  if (target.branch !== undefined && reachable(base)) {
    const other = branchOf(scene.robot, out);
    if (other !== undefined)
      found.push({
        kind: "branch",
        sentence: `Take the posture with shoulder ${other.shoulder}, elbow ${other.elbow}, wrist ${other.wrist}.`,
        replace: withTarget(move.step, { ...withoutBranch(target), branch: other }),
      });
  }
  offerTurns(base, offer);
  // A shift by what is missing first, rounded up to whole millimetres.
  const shifts = SHIFTS_M.map(shift => Math.ceil((missingOf(reach) + shift) * 1000) / 1000);
  const millimetres = (shift_m: number): string => `${Math.round(shift_m * 1000)} mm`;
  shifts.some(shift =>
    offer(towardsBase(base, shift), "target", `Move the target ${millimetres(shift)} towards the robot.`),
  );
  shifts.some(shift =>
    offer(towardsBase(base, -shift), "target", `Move the target ${millimetres(shift)} away from the robot.`),
  );
  return found.slice(0, MOST_REPAIRS);
}

/** Takes a pose as a repair when it can be reached, and says whether it can. */
type Offer = (baseFromTcp: Pose<"base", "tcp">, kind: RepairKind, sentence: string) => boolean;

/** The least tilt of the tool about its x or y axis, and the least turn about its own axis, that can be reached. */
function offerTurns(base: Pose<"base", "tcp">, offer: Offer): void {
  const both = (angles_deg: readonly number[]): number[] => angles_deg.flatMap(angle => [angle, -angle]);
  const tilt = (name: string, axis: Vector3, angle: number): boolean =>
    offer(turnTool(base, axis, radians(angle)), "tilt", `Tilt the tool by ${angle}° about its ${name} axis.`);
  TILTS_DEG.some(
    angle =>
      both([angle]).some(signed => tilt("x", [1, 0, 0], signed)) ||
      both([angle]).some(signed => tilt("y", [0, 1, 0], signed)),
  );
  both(SPINS_DEG).some(angle =>
    offer(turnTool(base, [0, 0, 1], radians(angle)), "spin", `Turn the tool by ${angle}° about its own axis.`),
  );
}

/** How far the target is outside what the arm reaches [m]; 0 where distance is not the reason. */
function missingOf(reach: Reach | undefined): number {
  switch (reach?.kind) {
    case "too-far":
      return reach.beyond_m;
    case "too-near":
      return reach.inside_m;
    case "beyond-workspace":
      return reach.distance_m - reach.declared_m;
    default:
      return 0;
  }
}

/** The same pose in other postures, as joint moves to them. */
export function configurationRepairs(scene: CheckScene, move: Move, most = 2): Repair[] {
  const near = scene.layout.starts.get(move.step.id) ?? Float64Array.from(scene.robot.home_rad);
  const reach = solveAll(scene.robot, move.baseFromFlange, { near });
  if (reach.kind !== "reached") return [];
  const found: Repair[] = [];
  const target = move.step.target;
  for (const solution of reach.solutions) {
    if (found.length >= most) break;
    const { branch, q_rad } = solution;
    if (
      branch === undefined ||
      found.some(
        repair =>
          "pose" in (repair.replace?.type === "move" ? repair.replace.target : target) && sameAs(repair, branch),
      )
    )
      continue;
    const next: Target = "pose" in target ? { ...target, branch } : { ...target, q: [...q_rad] };
    found.push({
      kind: "branch",
      sentence: `Go there by a joint move with shoulder ${branch.shoulder}, elbow ${branch.elbow}, wrist ${branch.wrist}.`,
      replace: jointMove(move.step, next),
    });
  }
  return found;
}

function sameAs(repair: Repair, branch: NonNullable<Move["branch"]>): boolean {
  const target = repair.replace?.type === "move" ? repair.replace.target : undefined;
  return target !== undefined && "pose" in target && target.branch !== undefined && sameBranch(target.branch, branch);
}

/** A quarter of full joint speed, where a step's own speed means nothing to a joint move. */
const CAREFUL = { ratio: 0.25 };

/** The step as a joint move to that target. */
export function jointMove(step: MoveStep, target: Target): MoveStep {
  const { id, name, group, speed, acceleration, blend_m, blend_ratio, until } = step;
  return {
    id,
    type: "move",
    path: "ptp",
    target,
    speed: "ratio" in speed ? speed : CAREFUL,
    blend_m,
    ...(name === undefined ? {} : { name }),
    ...(group === undefined ? {} : { group }),
    ...(acceleration === undefined ? {} : { acceleration }),
    ...(blend_ratio === undefined ? {} : { blend_ratio }),
    ...(until === undefined ? {} : { until }),
  };
}

const withTarget = (step: MoveStep, target: Target): MoveStep => ({ ...step, target });

function withoutBranch(target: PoseTarget): PoseTarget {
  return { pose: target.pose, frame: target.frame, tool: target.tool };
}

function turnTool(baseFromTcp: Pose<"base", "tcp">, axis: Vector3, angle_rad: number): Pose<"base", "tcp"> {
  return {
    position: [...baseFromTcp.position],
    quaternion: multiply(baseFromTcp.quaternion, fromAxisAngle(axis, angle_rad)),
  };
}

/** Along the line to the base's upright axis. */
function towardsBase(baseFromTcp: Pose<"base", "tcp">, shift_m: number): Pose<"base", "tcp"> {
  const [x, y, z] = baseFromTcp.position;
  const far = Math.max(Math.hypot(x, y), 1e-9);
  return { position: [x - (x / far) * shift_m, y - (y / far) * shift_m, z], quaternion: [...baseFromTcp.quaternion] };
}

/** The target higher by so much in the world; undefined for a target taught as joint angles. */
export function raised(
  scene: CheckScene,
  move: Move,
  height_m: number,
): { readonly baseFromTcp: Pose<"base", "tcp">; readonly target: PoseTarget } | undefined {
  const target = move.step.target;
  if (!("pose" in target)) return undefined;
  const worldFromBase = scene.context.worldFromBase;
  const worldFromTcp =
    worldFromBase === undefined
      ? copyPose(move.baseFromTcp as Pose)
      : compose(worldFromBase as Pose, move.baseFromTcp as Pose);
  worldFromTcp.position[2] += height_m;
  const baseFromTcp = (
    worldFromBase === undefined ? worldFromTcp : compose(inverse(worldFromBase as Pose), worldFromTcp)
  ) as Pose<"base", "tcp">;
  return { baseFromTcp, target: poseTarget(baseFromTcp, target, scene.context) };
}
