import { branchOf, sameBranch, type Branch } from "../../kinematics/branch.ts";
import { armScratch, flangePose } from "../../kinematics/forward.ts";
import type { Reach } from "../../kinematics/reach.ts";
import { turns } from "../../kinematics/turns.ts";
import type { Robot } from "../../model/robot.ts";
import { identity, type Pose } from "../../spatial/pose.ts";
import { radians, wrapAngle } from "../../spatial/units.ts";
import { Follower } from "../follow.ts";
import type { PosePath } from "../geometry.ts";
import { GoalFinder } from "../goal.ts";
import { blends, type Move } from "../moves.ts";
import { posePathOf } from "../pose-paths.ts";
import { BROKEN, CandidatePool, FLIPPED, NO_CODE, OTHERWISE, PLAIN, STOOD } from "./pool.ts";
import { codeOf, ConfigurationFinder, type Configurations } from "./postures.ts";
import { StretchFollower, type Lost } from "./stretch.ts";

/** A joint move that turns a joint further than this and changes the branch turns the arm over [rad]. */
export const FLIP_RAD = radians(150);
/**
 * Penalties [s]: a flip is worth a detour of a thousand seconds; what cannot be driven as taught, any number of flips.
 */
export const FLIP_S = 1e3;
export const OTHERWISE_S = 1e6;
export const STANDSTILL_S = 1e6;
export const BREAK_S = 1e9;
/** Joint angles this near to the taught ones are the taught ones [rad]. */
const TAUGHT_RAD = 1e-4;
/** Two postures this near are one [rad]. */
const SAME_RAD = 1e-6;

/**
 * The arm turns over: on a joint move, or, before a move that allows no other way, at a standstill that no step asks
 * for. Joint counts from 1.
 */
export interface Flip {
  readonly kind: "joint-move" | "standstill";
  /** Counts from 0 over all moves. */
  readonly move: number;
  readonly joint: number;
  readonly way_rad: number;
  readonly from: Branch | undefined;
  readonly to: Branch | undefined;
}

/** A posture that was tried, and where it was lost. */
export interface Tried {
  readonly q_rad: Float64Array;
  readonly branch: Branch | undefined;
  readonly lost: Lost;
}

/** A move that no posture gets through. */
export interface Break {
  readonly move: number;
  /** How far the best got. */
  readonly share: number;
  /** The one that gets farthest; undefined where the target itself has no posture. */
  readonly best: Tried | undefined;
  readonly tried: readonly Tried[];
  /** Why, where the target has no posture. */
  readonly reach?: Reach;
}

/** How an arm goes through a whole path. */
export interface Continuity {
  /** Time that joints at full speed need for all of it, with penalties [s]. */
  readonly cost_s: number;
  /** Posture at the end of each move; undefined where there is none. */
  readonly ends: readonly (Float64Array | undefined)[];
  readonly flips: readonly Flip[];
  readonly breaks: readonly Break[];
  /** Moves along a path that end in another posture than taught. */
  readonly otherwise: readonly number[];
}

export interface ContinuityOptions {
  /** Takes the nearest posture at every target, as a controller does that is told no posture. */
  readonly nearest?: boolean;
  /** Lets the arm turn over where it stands before a straight, circular or spline path. */
  readonly standstill?: boolean;
}

interface RunContext {
  readonly first: number;
  readonly count: number /** No posture is at the target. */;
  readonly nowhere: boolean;
}

/**
 * The least costly postures over a whole path, by dynamic programming (Viterbi) over the postures of every target:
 *
 *   C_i(t) = min over p of C_{i−1}(p) + τ(p, t),   τ = max_j |t_j − p_j| / v_j  (+ penalty of a flip)
 *
 * A joint move to a pose may take any posture inside the limits, copies by whole turns included. Taught joints are one
 * posture; a taught branch is taken as every controller takes it, the nearest copy to where the arm comes from. A
 * straight, circular or spline path keeps the posture it begins with; a posture that runs into a limit, out of reach or
 * would jump is dropped. O(moves · postures²); arms without closed form go to the nearest posture.
 */
export class ContinuitySolver {
  private readonly robot: Robot;
  private readonly pool: CandidatePool;
  private readonly follower: StretchFollower;
  private readonly goals: GoalFinder;
  private readonly postures: ConfigurationFinder;
  private readonly q: Float64Array;
  private readonly arm = armScratch();
  private stages: RunContext[] = [];
  /** Stage in which each move ends. */
  private endOf: number[] = [];
  private breaks: Break[] = [];
  private fault = PLAIN;
  private readonly asked = new Map<
    Move,
    readonly { readonly q_rad: Float64Array; readonly lost: Lost | undefined }[]
  >();

  constructor(robot: Robot) {
    const newton = new Follower(robot.arm);
    this.robot = robot;
    this.pool = new CandidatePool(robot.arm.joints.length);
    this.follower = new StretchFollower(robot, newton);
    this.goals = new GoalFinder(robot, newton);
    this.postures = new ConfigurationFinder(robot);
    this.q = new Float64Array(robot.arm.joints.length);
  }

  /** @param runs  moves, together where they are passed without a stop. */
  solve(runs: readonly (readonly Move[])[], start_rad: Float64Array, options: ContinuityOptions = {}): Continuity {
    const { pool } = this;
    pool.clear();
    this.stages = [];
    this.endOf = [];
    this.breaks = [];
    pool.add(start_rad, 0, 0, -1, 0, this.code(start_rad), PLAIN);
    let stage = this.close(0, false);
    for (const run of runs) {
      const begin = flangePose(this.robot.arm, pool.posture(stage.first), identity(), this.arm);
      for (let i = 0; i < run.length; i++) {
        const move = run[i]!;
        if (move.step.path === "ptp" || stage.nowhere) stage = this.arrive(stage, move, options.nearest === true);
        else {
          if (i === 0 && options.standstill === true) stage = this.stand(stage, begin);
          stage = this.keep(stage, move, posePathOf(run, i, begin));
        }
        this.endOf.push(this.stages.length - 1);
      }
    }
    return this.answer();
  }

  /** The candidates from `first` on become a stage. */
  private close(first: number, nowhere: boolean): RunContext {
    const stage = { first, count: this.pool.count - first, nowhere };
    this.stages.push(stage);
    return stage;
  }

  private arrive(before: RunContext, move: Move, nearest: boolean): RunContext {
    const { pool } = this;
    const first = pool.count;
    if (move.q_rad !== undefined) {
      this.offer(before, move.q_rad, 0, 0, this.code(move.q_rad), 0, PLAIN);
      return this.close(first, false);
    }
    if (nearest || move.branch !== undefined || this.robot.family.kind === "general") return this.follow(before, move);
    const { q, groups, codes } = this.postures.at(
      move.baseFromFlange,
      pool.posture(this.best(before)),
      move.step.target,
    );
    for (let t = 0; t < groups.length; t++) this.offer(before, q, t * pool.joints, groups[t]!, codes[t]!, 0, PLAIN);
    return pool.count > first ? this.close(first, false) : this.nowhere(before, move);
  }

  /** From every candidate to the nearest posture, as it is done without looking ahead. */
  private follow(before: RunContext, move: Move): RunContext {
    const { pool } = this;
    const first = pool.count;
    for (let p = before.first; p < before.first + before.count; p++) {
      const goal = this.goals.find(move, pool.posture(p));
      if (goal.kind === "none") continue;
      const code = this.code(goal.q_rad);
      const step = this.cost(p, goal.q_rad, 0, code, Number.POSITIVE_INFINITY);
      const known = this.sameIn(first, pool.count, goal.q_rad, 0);
      const cost = pool.cost[p]! + step;
      if (known < 0) pool.add(goal.q_rad, 0, cost, p, pool.count - first, code, this.fault);
      else if (cost < pool.cost[known]!) {
        pool.cost[known] = cost;
        pool.from[known] = p;
        pool.fault[known] = this.fault;
      }
    }
    return pool.count > first ? this.close(first, false) : this.nowhere(before, move);
  }

  /** No posture is at the target: the arm stays where it is, in thought. */
  private nowhere(before: RunContext, move: Move): RunContext {
    const { pool } = this;
    const first = pool.count;
    const p = this.best(before);
    const at = pool.posture(p);
    const goal = this.goals.find(move, at);
    this.breaks.push({
      move: this.endOf.length,
      share: 1,
      best: undefined,
      tried: [],
      ...(goal.kind === "none" ? { reach: goal.reach } : {}),
    });
    pool.add(at, 0, pool.cost[p]! + BREAK_S, p, 0, pool.code[p]!, BROKEN);
    return this.close(first, true);
  }

  /** Every candidate along the path, or as far as it gets. */
  private keep(before: RunContext, move: Move, path: PosePath | undefined): RunContext {
    const { pool, follower, q } = this;
    const first = pool.count;
    const n = pool.joints;
    const moved = new Float64Array(n);
    const last = before.first + before.count;
    for (let p = before.first; p < last && path !== undefined; p++) {
      // Candidates of one group move alike: the first of them is followed for all.
      const leader = pool.group[p]!;
      if (this.metBefore(before.first, p, leader)) continue;
      this.load(p, q);
      if (
        follower.follow(path, move.tcpFromFlange, q, false) !== undefined ||
        this.refused(move, path, p) !== undefined
      )
        continue;
      for (let j = 0; j < n; j++) moved[j] = q[j]! - pool.q[p * n + j]!;
      const code = this.code(q);
      const { seconds } = follower;
      for (let c = p; c < last; c++) {
        if (pool.group[c] !== leader || !follower.fits(pool.q, c * n)) continue;
        this.load(c, q);
        for (let j = 0; j < n; j++) q[j]! += moved[j]!;
        const other = this.arrivesOtherwise(move, q);
        pool.add(
          q,
          0,
          pool.cost[c]! + (seconds + (other ? OTHERWISE_S : 0)),
          c,
          leader,
          code,
          other ? OTHERWISE : PLAIN,
        );
      }
    }
    return pool.count > first ? this.close(first, false) : this.broken(before, move, path);
  }

  /** Whether the planner itself does not get along where the follower did; asked once for each posture. */
  private refused(move: Move, path: PosePath, p: number): Lost | undefined {
    if (!this.follower.doubtful) return undefined;
    const q_rad = this.pool.posture(p);
    const asked = this.asked.get(move) ?? [];
    const known = asked.find(one => one.q_rad.every((angle, j) => Math.abs(wrapAngle(angle - q_rad[j]!)) < SAME_RAD));
    if (known !== undefined) return known.lost;
    const lost = this.follower.confirm(path, move.tcpFromFlange, q_rad);
    this.asked.set(move, [...asked, { q_rad, lost }]);
    return lost;
  }

  private metBefore(first: number, p: number, group: number): boolean {
    for (let c = first; c < p; c++) if (this.pool.group[c] === group) return true;
    return false;
  }

  /** No candidate got through: the path goes on behind this move from any posture of its target. */
  private broken(before: RunContext, move: Move, path: PosePath | undefined): RunContext {
    const { pool } = this;
    const first = pool.count;
    const tried: Tried[] = [];
    let best = this.best(before);
    let farthest: Tried | undefined;
    for (let p = before.first; p < before.first + before.count && path !== undefined; p++) {
      const q_rad = pool.posture(p);
      const lost = this.follower.follow(path, move.tcpFromFlange, q_rad.slice(), true) ?? this.refused(move, path, p);
      if (lost === undefined) continue;
      const one = { q_rad, branch: branchOf(this.robot, q_rad), lost };
      tried.push(one);
      if (farthest === undefined || lost.share > farthest.lost.share) {
        farthest = one;
        best = p;
      }
    }
    this.breaks.push({ move: this.endOf.length, share: farthest?.lost.share ?? 0, best: farthest, tried });
    const { q, groups, codes } = this.postures.at(move.baseFromFlange, pool.posture(best));
    for (let t = 0; t < groups.length; t++)
      pool.add(q, t * pool.joints, pool.cost[best]! + BREAK_S, best, groups[t]!, codes[t]!, BROKEN);
    if (groups.length > 0) return this.close(first, false);
    pool.add(pool.posture(best), 0, pool.cost[best]! + BREAK_S, best, 0, pool.code[best]!, BROKEN);
    return this.close(first, true);
  }

  /** The same place once more, with the postures that could be had there by turning over. */
  private stand(before: RunContext, baseFromFlange: Pose<"base", "flange">): RunContext {
    const { pool } = this;
    const first = pool.count;
    const n = pool.joints;
    if (this.robot.family.kind === "general") return before;
    const { q, groups, codes }: Configurations = this.postures.at(baseFromFlange, pool.posture(this.best(before)));
    let next = 0;
    for (let p = before.first; p < before.first + before.count; p++) next = Math.max(next, pool.group[p]! + 1);
    for (let p = before.first; p < before.first + before.count; p++)
      pool.add(pool.posture(p), 0, pool.cost[p]!, p, pool.group[p]!, pool.code[p]!, PLAIN);
    const own = pool.count;
    for (let t = 0; t < groups.length; t++)
      if (this.sameIn(first, own, q, t * n) < 0)
        this.offer(before, q, t * n, next + groups[t]!, codes[t]!, STANDSTILL_S, STOOD);
    return this.close(first, false);
  }

  /** Adds a candidate with the least costly way to it. */
  private offer(
    before: RunContext,
    q: Float64Array,
    at: number,
    group: number,
    code: number,
    penalty_s: number,
    fault: number,
  ): void {
    const { pool } = this;
    let least = Number.POSITIVE_INFINITY;
    let from = before.first;
    let kind = PLAIN;
    for (let p = before.first; p < before.first + before.count; p++) {
      const here = pool.cost[p]!;
      if (!(here < least)) continue;
      const total = here + (this.cost(p, q, at, penalty_s > 0 ? NO_CODE : code, least - here) + penalty_s);
      if (total < least) {
        least = total;
        from = p;
        kind = this.fault;
      }
    }
    pool.add(q, at, least, from, group, code, kind | fault);
  }

  /** τ(p, t) [s]; whether it is a flip is left in `fault`. Gives up at `most`. */
  private cost(p: number, q: Float64Array, at: number, code: number, most: number): number {
    const {
      pool,
      robot: {
        arm: { joints },
      },
    } = this;
    const n = pool.joints;
    const base = p * n;
    let seconds = 0;
    let way = 0;
    this.fault = PLAIN;
    for (let j = 0; j < n; j++) {
      const joint = joints[j]!;
      const gone = Math.abs(q[at + j]! - pool.q[base + j]!);
      const time_s = gone / joint.limits.speed_rad_s;
      if (gone > way && turns(joint)) way = gone;
      if (time_s > seconds) {
        seconds = time_s;
        if (seconds >= most) return seconds;
      }
    }
    const own = pool.code[p]!;
    if (way <= FLIP_RAD || code === own || code === NO_CODE || own === NO_CODE) return seconds;
    this.fault = FLIPPED;
    return seconds + FLIP_S;
  }

  private arrivesOtherwise(move: Move, q: Float64Array): boolean {
    if (blends(move.step)) return false;
    if (move.q_rad !== undefined) return move.q_rad.some((taught, j) => Math.abs(taught - q[j]!) > TAUGHT_RAD);
    const arrived = move.branch === undefined ? undefined : branchOf(this.robot, q);
    return arrived !== undefined && !sameBranch(arrived, move.branch!);
  }

  private code(q: Float64Array): number {
    return codeOf(branchOf(this.robot, q));
  }

  private load(index: number, out: Float64Array): void {
    const n = this.pool.joints;
    for (let j = 0; j < n; j++) out[j] = this.pool.q[index * n + j]!;
  }

  private sameIn(first: number, end: number, q: Float64Array, at: number): number {
    const n = this.pool.joints;
    for (let c = first; c < end; c++) {
      let j = 0;
      while (j < n && Math.abs(this.pool.q[c * n + j]! - q[at + j]!) <= SAME_RAD) j++;
      if (j === n) return c;
    }
    return -1;
  }

  private best({ first, count }: RunContext): number {
    let best = first;
    for (let c = first + 1; c < first + count; c++) if (this.pool.cost[c]! < this.pool.cost[best]!) best = c;
    return best;
  }

  private answer(): Continuity {
    const { pool, stages } = this;
    const chain = new Int32Array(stages.length);
    const flips: Flip[] = [];
    const otherwise: number[] = [];
    const last = this.best(stages.at(-1)!);
    for (let s = stages.length - 1, c = last; s >= 0; s--) {
      chain[s] = c;
      c = pool.from[c]!;
    }
    let seen = 0;
    const ends = this.endOf.map((stage, move) => {
      for (let s = seen + 1; s <= stage; s++) {
        const fault = pool.fault[chain[s]!]!;
        if ((fault & (FLIPPED | STOOD)) !== 0)
          flips.push(this.flip(chain[s - 1]!, chain[s]!, move, (fault & STOOD) === 0 ? "joint-move" : "standstill"));
        if ((fault & OTHERWISE) !== 0) otherwise.push(move);
      }
      seen = stage;
      return stages[stage]!.nowhere ? undefined : pool.posture(chain[stage]!);
    });
    return { cost_s: pool.cost[last]!, ends, flips, breaks: this.breaks, otherwise };
  }

  private flip(from: number, to: number, move: number, kind: Flip["kind"]): Flip {
    const a = this.pool.posture(from);
    const b = this.pool.posture(to);
    let joint = 0;
    for (let j = 1; j < a.length; j++) if (Math.abs(b[j]! - a[j]!) > Math.abs(b[joint]! - a[joint]!)) joint = j;
    return {
      kind,
      move,
      joint: joint + 1,
      way_rad: Math.abs(b[joint]! - a[joint]!),
      from: branchOf(this.robot, a),
      to: branchOf(this.robot, b),
    };
  }
}
