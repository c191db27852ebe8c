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
    const member = memberOf(this, options);
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

/** One robot of a cell among the others. */
function memberOf(cell: SharedCellState, options: PlaceOptions): Member {
  return memberOfOf(new CellMemberState(cell, options));
}

class CellMemberState {
  readonly cell: SharedCellState;
  readonly options: PlaceOptions;
  readonly robot: Robot;
  readonly name: string;
  readonly id: string;
  readonly n: number;
  readonly stand: Pose<"world", "base">;
  readonly neighbours: Neighbour[] = [];
  readonly q_rad: Float64Array;
  readonly ahead_rad: Float64Array;
  readonly collider: CellCollider;
  readonly rank: number;
  readonly braking_s: number;

  constructor(cell: SharedCellState, options: PlaceOptions) {
    this.cell = cell;
    this.options = options;
    this.robot = this.options.robot;
    this.name = this.options.name;
    this.id = this.options.id;
    this.n = this.robot.arm.joints.length;
    this.stand = copyPose(this.options.worldFromBase);
    this.q_rad = Float64Array.from(this.robot.home_rad);
    this.ahead_rad = Float64Array.from(this.robot.home_rad);
    this.collider = new CellCollider(
      {
        worldFromBase: this.stand,
        links: this.cell.solidsOf(this.robot),
        objects: [],
        allowedPairs: [],
        shapeError_m: this.robot.shapeError_m,
      },
      this.robot.arm,
      this.cell.solidCache,
    );
    this.rank = this.cell.opened++;
    this.braking_s = this.options.brakingTime_s ?? hardBrakingTime_s(this.robot);
  }

  /** Distance below what must be kept, with both where they are put; Infinity when it is not below. */
  below(
    to: Neighbour,
    mine_rad: ArrayLike<number>,
    its_rad: ArrayLike<number>,
    kept_m: number,
    exactly: boolean,
  ): number {
    if (to.picked !== this.collider.pairs) {
      to.picked = this.collider.pairs;
      to.pairs = this.collider.pairs.filter(
        pair => robotAndCell(pair) && (pair.a.name.startsWith(`${to.id}/`) || pair.b.name.startsWith(`${to.id}/`)),
      );
    }
    to.arm.place(its_rad, this.collider);
    this.collider.place(mine_rad);
    let least_m = Infinity;
    let limit_m = kept_m;
    for (const pair of to.pairs) {
      const distance_m = this.collider.distanceOf(pair, limit_m, exactly ? 0 : limit_m);
      if (distance_m >= limit_m) continue;
      least_m = distance_m;
      if (!exactly) return least_m;
      limit_m = distance_m;
    }
    return least_m;
  }

  yields(to: Neighbour): boolean {
    return to.member.moving && !(to.member.guarded && to.member.rank > this.rank);
  }

  /** What must be left between, errors of both shapes in it. */
  wanted(to: Neighbour): number {
    return this.cell.between_m + (this.yields(to) ? this.cell.yielded_m : 0) + to.error_m;
  }

  /** The nearest of what both may come to within the time they need to stop, below what is kept; else Infinity. */
  onTheWay(to: Neighbour, kept_m: number, exactly: boolean): number {
    const its = to.member;
    let least_m = this.below(to, this.q_rad, its.q_rad, kept_m, exactly);
    const take = (distance_m: number): void => {
      least_m = Math.min(least_m, distance_m);
    };
    if (least_m < kept_m && !exactly) return least_m;
    take(this.below(to, this.ahead_rad, its.q_rad, kept_m, exactly));
    if (!its.moving || (least_m < kept_m && !exactly)) return least_m;
    take(this.below(to, this.ahead_rad, its.ahead_rad, kept_m, exactly));
    take(this.below(to, this.q_rad, its.ahead_rad, kept_m, exactly));
    if (!this.yields(to) || !its.path) return least_m;
    for (let k = 1; k <= LOOKS; k++)
      if (its.path((k / LOOKS) * this.braking_s, to.scratch))
        take(this.below(to, this.ahead_rad, to.scratch, kept_m, exactly));
    return least_m;
  }
}

function memberOfOf(own: CellMemberState): Member {
  const member: Member = {
    id: own.id,
    options: own.options,
    rank: own.rank,
    q_rad: own.q_rad,
    ahead_rad: own.ahead_rad,
    moving: false,
    guarded: false,
    path: null,
    get others() {
      return own.neighbours;
    },
    tell(now_rad, stop_rad) {
      let apart_rad = 0;
      for (let i = 0; i < own.n; i++) {
        own.q_rad[i] = now_rad[i]!;
        own.ahead_rad[i] = stop_rad[i]!;
        apart_rad = Math.max(apart_rad, Math.abs(own.ahead_rad[i]! - own.q_rad[i]!));
      }
      member.moving = apart_rad > STILL_RAD;
    },
    begin: () => {
      for (const to of own.neighbours) {
        const kept_m = own.cell.between_m + own.cell.yielded_m + to.error_m;
        const here_m = own.below(to, own.q_rad, to.member.q_rad, kept_m, true);
        to.floor_m = here_m < kept_m ? here_m - NO_NEARER_M : Infinity;
      }
    },
    tooNear() {
      for (const to of own.neighbours) {
        const kept_m = own.wanted(to);
        const limit_m = Math.min(kept_m, to.floor_m);
        if (to.floor_m !== Infinity && own.below(to, own.q_rad, to.member.q_rad, kept_m, false) >= kept_m)
          to.floor_m = Infinity;
        if (limit_m <= 0 || own.onTheWay(to, limit_m, false) >= limit_m) continue;
        return cameNearRobot(
          own.name,
          to.name,
          Math.max(0, own.onTheWay(to, limit_m, true) - to.error_m),
          limit_m - to.error_m,
          own.yields(to),
        );
      }
      return null;
    },
    targetRefusal: target_rad => {
      for (const to of own.neighbours) {
        if (to.member.moving) continue;
        const kept_m = own.cell.between_m + to.error_m;
        const there_m = own.below(to, target_rad, to.member.q_rad, kept_m, true);
        // Away from where it stands too near already, it may go in small steps.
        if (there_m < kept_m && there_m < own.below(to, own.q_rad, to.member.q_rad, kept_m, true))
          return wouldStandNear(own.name, to.name, Math.max(0, there_m - to.error_m), own.cell.between_m);
      }
      return null;
    },
    leave: () => {
      own.cell.members.delete(member);
      for (const each of own.cell.members) each.forget(member);
    },
    meet: other => {
      const arm = new OtherArm(
        other.id,
        other.options.name,
        other.options.robot,
        own.cell.solidsOf(other.options.robot),
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
        kept_m: own.cell.between_m,
        error_m: marginToLinks(own.robot, other.options.robot),
        expected(in_s, out) {
          if (other.path?.(in_s, out) !== true) out.set(in_s > 0 ? other.ahead_rad : other.q_rad);
        },
        distance: (mine_rad, its_rad, cutoff_m) => own.below(neighbour, mine_rad, its_rad, cutoff_m, true),
      };
      own.neighbours.push(neighbour);
      for (const object of arm.objects) own.collider.setObject(object satisfies CellObject);
    },
    forget(other) {
      const at = own.neighbours.findIndex(each => each.member === other);
      if (at < 0) return;
      for (const object of own.neighbours[at]!.arm.objects) own.collider.removeObject(object.id);
      own.neighbours.splice(at, 1);
    },
  };
  return member;
}
