import { nearestSolution, solveAll, solverScratch, type SolverScratch } from "../../kinematics/inverse.ts";
import { PoseFit, withRoom } from "../../kinematics/pose-fit.ts";
import type { Robot } from "../../model/robot.ts";
import { compose, identity, type Pose } from "../../spatial/pose.ts";
import { arcPath, geometryScratch, linePath, posePoint, type PosePath } from "../../trajectory/geometry.ts";
import type { Layout } from "../../trajectory/layout.ts";
import type { Move } from "../../trajectory/moves.ts";
import { changedPose, type PoseChange } from "./change.ts";
import { REPAIR_ROOM_RAD } from "./pose-repair.ts";

/** Poses looked at on the way of a straight or circular move. */
const LOOKS = 13;
/** A joint that goes further than this from one look to the next has jumped [rad, m]. */
const JUMP_RAD = 1.2;

/** A move of the plan, where its path begins, and the written step it belongs to. */
export interface PlacedMove {
  readonly written: string;
  readonly move: Move;
  /** The tool where the move begins, seen from the base. */
  readonly from: Pose<"base", "tcp"> | undefined;
  /** The move before it in the plan. */
  readonly before: PlacedMove | undefined;
}

/** Every carrying out of every move of a plan, in its order. */
export function placedMoves(layout: Layout): readonly PlacedMove[] {
  const all: PlacedMove[] = [];
  let before: PlacedMove | undefined;
  for (const [id, move] of layout.moves) {
    const written = layout.turns.get(id)?.written.id ?? id;
    const from = before && withToolOf(before.move, move);
    before = { written, move, before, from };
    all.push(before);
  }
  return all;
}

/** Where the tool of `move` is when the robot stands at the target of the move before. */
const withToolOf = (before: Move, move: Move): Pose<"base", "tcp"> =>
  compose(before.baseFromFlange, move.flangeFromTcp);

/**
 * Says whether moves could be carried out if some of their poses were changed: every look on the way inside the limits
 * with room to spare, and one posture that goes all along it without a jump. Quick and not final: what it lets through
 * is proven by the program's check.
 */
export class PathFit {
  private readonly fit: PoseFit;
  private readonly robot: Robot;
  private readonly scratch: SolverScratch = solverScratch();
  private readonly geometry = geometryScratch();
  private readonly at: Pose = identity();
  private readonly flange = identity<"base", "flange">();

  constructor(robot: Robot, accepts?: (q_rad: Float64Array) => boolean) {
    this.robot = withRoom(robot, REPAIR_ROOM_RAD);
    this.fit = new PoseFit(robot, { room_rad: REPAIR_ROOM_RAD, ...(accepts === undefined ? {} : { accepts }) });
  }

  /**
   * @param change  made to the poses of a move whose step `has` says it has, and to where moves after it begin.
   */
  fits({ move, from, before, written }: PlacedMove, change: PoseChange, has: (step: string) => boolean): boolean {
    const own = has(written);
    const end = own ? changedPose(move.baseFromTcp, change) : move.baseFromTcp;
    if (!this.reaches(end, move)) return false;
    if (move.step.path === "ptp" || from === undefined) return true;
    const start = before !== undefined && has(before.written) ? changedPose(from, change) : from;
    const path = this.pathOf(move, start, end, own ? change : undefined);
    return path === undefined || this.follows(path, move);
  }

  private pathOf(
    { step, via }: Move,
    start: Pose<"base", "tcp">,
    end: Pose<"base", "tcp">,
    change: PoseChange | undefined,
  ): PosePath | undefined {
    if (step.path === "circ" && via !== undefined)
      return arcPath(start, (change === undefined ? via : changedPose(via, change)).position, end);
    return linePath(start, end);
  }

  private reaches(baseFromTcp: Pose, { tcpFromFlange }: Move): boolean {
    return this.fit.fits(compose(baseFromTcp as Pose<"base", "tcp">, tcpFromFlange, this.flange));
  }

  private follows(path: PosePath, move: Move): boolean {
    const { at, flange, geometry, robot, scratch } = this;
    const poses: Pose<"base", "flange">[] = [];
    for (let k = 0; k < LOOKS; k++) {
      posePoint(path, (path.length * k) / (LOOKS - 1), at, geometry);
      // A start that is no worse than it was is not the business of this move.
      if (k > 0 && !this.reaches(at, move)) return false;
      poses.push(compose(at as Pose<"base", "tcp">, move.tcpFromFlange));
    }
    const first = solveAll(robot, poses[0]!, {}, scratch);
    if (first.kind !== "reached") return poses.slice(1).every(pose => this.fit.fits(compose(pose, identity(), flange)));
    const q = new Float64Array(robot.arm.joints.length);
    const next = new Float64Array(q.length);
    start: for (const { q_rad } of first.solutions) {
      q.set(q_rad);
      for (let k = 1; k < poses.length; k++) {
        if (!nearestSolution(robot, poses[k]!, q, next, scratch)) continue start;
        if (next.some((angle, j) => Math.abs(angle - q[j]!) > JUMP_RAD)) continue start;
        q.set(next);
      }
      return true;
    }
    return false;
  }
}
