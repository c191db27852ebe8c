import {
  CellCollider,
  copyPose,
  hardBrakingTime_s,
  linkSolids,
  OtherArm,
  robotAndCell,
  SolidCache,
  type CellObject,
  type LinkSolid,
  type Pose,
  type Refusal,
  type Robot,
  type SolidPair,
} from "@twincell/core";
import { cameNearRobot, wouldStandNear } from "./words.ts";

/** Kept between two robots, the errors of both drawn shapes on top [m]. */
export const BETWEEN_ROBOTS_M = 0.05;
/** Kept on top by the one who yields, from a robot that moves [m]. */
export const YIELDED_M = 0.05;
/** Who stands too near already may go away from there, and no nearer than by this [m]. */
const NO_NEARER_M = 0.002;
/** Looks at the way of a robot that goes first, over the time in which the one who yields comes to rest. */
const LOOKS = 3;

export interface SharedCellOptions {
  readonly between_m?: number;
  readonly yielded_m?: number;
}
export interface PlaceOptions {
  readonly id: string;
  readonly name: string;
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  /** Longest time from the word to stop to standstill [s]; its hard braking time when left out. */
  readonly brakingTime_s?: number;
}

/** One robot's place among the others. */
export interface CellMember {
  readonly id: string;
  /** Where it is, and where it would stand if it were stopped now. Copied. */
  tell(q_rad: ArrayLike<number>, ahead_rad: ArrayLike<number>): void;
  /**
   * Whether its guard moves it now, and could stop it: only then does it have others to go before it, or go before
   * others.
   */
  guarded: boolean;
  /** Where its plan has it so many seconds from now; false where nobody knows. Set while a plan is carried out. */
  path: ((in_s: number, out: Float64Array) => boolean) | null;
  /** A motion begins: from where it stands too near it may go away. */
  begin(): void;
  /** Why it must stop, by what it and the others last told; null when it may go on. Allocates nothing while it may. */
  tooNear(): Refusal | null;
  /** Why it may not be sent to stand there; robots that move are not counted. */
  targetRefusal(q_rad: ArrayLike<number>): Refusal | null;
  /** Stays out of the way of nobody any more. */
  leave(): void;
  /** The others, for who looks farther ahead. */
  readonly others: readonly Seen[];
}
/** Another robot, seen from one place. */
export interface Seen {
  readonly id: string;
  readonly name: string;
  readonly joints: number;
  /** It moves, or its plan is under way. */
  readonly moving: boolean;
  /** Where it will be in so many seconds: by its plan, else where it would come to rest, else where it stands. */
  expected(in_s: number, out: Float64Array): void;
  /** Distance to it with both in those postures, if it is below `cutoff_m`, else Infinity [m]. */
  distance(q_rad: ArrayLike<number>, other_rad: ArrayLike<number>, cutoff_m: number): number;
  /** What is kept from it when it stands [m], errors of both shapes apart. */
  readonly kept_m: number;
  /** Errors of both drawn shapes; on top of what is kept [m]. */
  readonly error_m: number;
}
export interface SharedCell {
  join(options: PlaceOptions): CellMember;
}

interface Member extends CellMember {
  readonly options: PlaceOptions;
  readonly rank: number;
  readonly q_rad: Float64Array;
  readonly ahead_rad: Float64Array;
  moving: boolean;
  meet(other: Member): void;
  forget(other: Member): void;
}
interface Neighbour extends Seen {
  readonly member: Member;
  readonly arm: OtherArm;
  readonly scratch: Float64Array;
  /** Pairs of this robot's links with the other's, of the list of the collider that they were picked from. */
  pairs: readonly SolidPair[];
  picked: readonly SolidPair[] | null;
  /** Never nearer than this while it leaves a place that is too near [m]. */
  floor_m: number;
}

/**
 * Robots that stand in one cell, each an obstacle to the others: where they are, where they would come to rest if they
 * were stopped now, and, to the one who yields, where their plans take them meanwhile.
 *
 * Who yields: a robot that moves keeps `between_m` from one that stands. Of two that are moved by their guards the one
 * that was opened later yields: it keeps `yielded_m` more, so that it stops first and the other need not. To a robot
 * that nobody here could stop, because it is only watched or jogged at its pendant, everyone yields. Both look at both
 * braking ways, so that who goes first is safe as well.
 */
export function createSharedCell({
  between_m = BETWEEN_ROBOTS_M,
  yielded_m = YIELDED_M,
}: SharedCellOptions = {}): SharedCell {
  return sharedCellOf(new SharedCellState({ between_m, yielded_m }));
}

class SharedCellState {
  readonly between_m: number;
  readonly yielded_m: number;
  readonly members = new Set<Member>();
  readonly solidCache = new SolidCache();
  readonly solids = new Map<string, readonly LinkSolid[]>();
  opened = 0;

  constructor({ between_m = BETWEEN_ROBOTS_M, yielded_m = YIELDED_M }: SharedCellOptions = {}) {
    this.between_m = between_m;
    this.yielded_m = yielded_m;
  }

  solidsOf(robot: Robot): readonly LinkSolid[] {
    const known = this.solids.get(robot.id) ?? linkSolids(robot);
    this.solids.set(robot.id, known);
    return known;
  }

  readonly join = (options: PlaceOptions): CellMember => {
    const { robot, name, id } = options;
    const n = robot.arm.joints.length;
    const stand = copyPose(options.worldFromBase);
    const neighbours: Neighbour[] = [];
    const q_rad = Float64Array.from(robot.home_rad);
    const ahead_rad = Float64Array.from(robot.home_rad);
    const collider = new CellCollider(
      {
        worldFromBase: stand,
        links: this.solidsOf(robot),
        objects: [],
        allowedPairs: [],
        shapeError_m: robot.shapeError_m,
      },
      robot.arm,
      this.solidCache,
    );
    const braking_s = options.brakingTime_s ?? hardBrakingTime_s(robot);

    /** Distance below what must be kept, with both where they are put; Infinity when it is not below. */
    function below(
      to: Neighbour,
      mine_rad: ArrayLike<number>,
      its_rad: ArrayLike<number>,
      kept_m: number,
      exactly: boolean,
    ): number {
      if (to.picked !== collider.pairs) {
        to.picked = collider.pairs;
        to.pairs = collider.pairs.filter(
          pair => robotAndCell(pair) && (pair.a.name.startsWith(`${to.id}/`) || pair.b.name.startsWith(`${to.id}/`)),
        );
      }
      to.arm.place(its_rad, collider);
      collider.place(mine_rad);
      let least_m = Infinity;
      let limit_m = kept_m;
      for (const pair of to.pairs) {
        const distance_m = collider.distanceOf(pair, limit_m, exactly ? 0 : limit_m);
        if (distance_m >= limit_m) continue;
        least_m = distance_m;
        if (!exactly) return least_m;
        limit_m = distance_m;
      }
      return least_m;
    }
    const yields = (to: Neighbour): boolean => to.member.moving && !(to.member.guarded && to.member.rank > member.rank);
    /** What must be left between, errors of both shapes in it. */
    const wanted = (to: Neighbour): number => this.between_m + (yields(to) ? this.yielded_m : 0) + to.error_m;

    /** The nearest of what both may come to within the time they need to stop, below what is kept; else Infinity. */
    function onTheWay(to: Neighbour, kept_m: number, exactly: boolean): number {
      const its = to.member;
      let least_m = below(to, q_rad, its.q_rad, kept_m, exactly);
      const take = (distance_m: number): void => {
        least_m = Math.min(least_m, distance_m);
      };
      if (least_m < kept_m && !exactly) return least_m;
      take(below(to, ahead_rad, its.q_rad, kept_m, exactly));
      if (!its.moving || (least_m < kept_m && !exactly)) return least_m;
      take(below(to, ahead_rad, its.ahead_rad, kept_m, exactly));
      take(below(to, q_rad, its.ahead_rad, kept_m, exactly));
      if (!yields(to) || !its.path) return least_m;
      for (let k = 1; k <= LOOKS; k++)
        if (its.path((k / LOOKS) * braking_s, to.scratch)) take(below(to, ahead_rad, to.scratch, kept_m, exactly));
      return least_m;
    }

    const member: Member = {
      id,
      options,
      rank: this.opened++,
      q_rad,
      ahead_rad,
      moving: false,
      guarded: false,
      path: null,
      get others() {
        return neighbours;
      },
      tell(now_rad, stop_rad) {
        let apart_rad = 0;
        for (let i = 0; i < n; i++) {
          q_rad[i] = now_rad[i]!;
          ahead_rad[i] = stop_rad[i]!;
          apart_rad = Math.max(apart_rad, Math.abs(ahead_rad[i]! - q_rad[i]!));
        }
        member.moving = apart_rad > STILL_RAD;
      },
      begin: () => {
        for (const to of neighbours) {
          const kept_m = this.between_m + this.yielded_m + to.error_m;
          const here_m = below(to, q_rad, to.member.q_rad, kept_m, true);
          to.floor_m = here_m < kept_m ? here_m - NO_NEARER_M : Infinity;
        }
      },
      tooNear() {
        for (const to of neighbours) {
          const kept_m = wanted(to);
          const limit_m = Math.min(kept_m, to.floor_m);
          if (to.floor_m !== Infinity && below(to, q_rad, to.member.q_rad, kept_m, false) >= kept_m)
            to.floor_m = Infinity;
          if (limit_m <= 0 || onTheWay(to, limit_m, false) >= limit_m) continue;
          return cameNearRobot(
            name,
            to.name,
            Math.max(0, onTheWay(to, limit_m, true) - to.error_m),
            limit_m - to.error_m,
            yields(to),
          );
        }
        return null;
      },
      targetRefusal: target_rad => {
        for (const to of neighbours) {
          if (to.member.moving) continue;
          const kept_m = this.between_m + to.error_m;
          const there_m = below(to, target_rad, to.member.q_rad, kept_m, true);
          // Away from where it stands too near already, it may go in small steps.
          if (there_m < kept_m && there_m < below(to, q_rad, to.member.q_rad, kept_m, true))
            return wouldStandNear(name, to.name, Math.max(0, there_m - to.error_m), this.between_m);
        }
        return null;
      },
      leave: () => {
        this.members.delete(member);
        for (const each of this.members) each.forget(member);
      },
      meet: other => {
        const arm = new OtherArm(
          other.id,
          other.options.name,
          other.options.robot,
          this.solidsOf(other.options.robot),
          other.options.worldFromBase,
          other.q_rad,
        );
        const neighbour: Neighbour = {
          id: other.id,
          name: other.options.name,
          joints: other.q_rad.length,
          member: other,
          arm,
          scratch: new Float64Array(other.q_rad.length),
          pairs: [],
          picked: null,
          floor_m: Infinity,
          get moving() {
            return other.moving || other.path !== null;
          },
          kept_m: this.between_m,
          error_m: marginToLinks(robot, other.options.robot),
          expected(in_s, out) {
            if (other.path?.(in_s, out) !== true) out.set(in_s > 0 ? other.ahead_rad : other.q_rad);
          },
          distance: (mine_rad, its_rad, cutoff_m) => below(neighbour, mine_rad, its_rad, cutoff_m, true),
        };
        neighbours.push(neighbour);
        for (const object of arm.objects) collider.setObject(object satisfies CellObject);
      },
      forget(other) {
        const at = neighbours.findIndex(each => each.member === other);
        if (at < 0) return;
        for (const object of neighbours[at]!.arm.objects) collider.removeObject(object.id);
        neighbours.splice(at, 1);
      },
    };
    for (const each of this.members) {
      each.meet(member);
      member.meet(each);
    }
    this.members.add(member);
    return member;
  };
}

function sharedCellOf(own: SharedCellState): SharedCell {
  return { join: own.join };
}

/** A robot whose joints would come to rest within this stands [rad]. */
const STILL_RAD = 1e-4;
/** Both robots are drawn: what each drawing may be off comes on top. */
const marginToLinks = (a: Robot, b: Robot): number => a.shapeError_m + b.shapeError_m;
