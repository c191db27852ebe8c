import { keptApart, TOUCH_M, type CellCollider, type SolidPair } from "../collision/cell-collider.ts";
import type { CellGeometry } from "../collision/cell.ts";
import { flangePose } from "../kinematics/forward.ts";
import { PARALLEL_GRIPPER } from "../physical/scene.ts";
import type { SerialArm } from "../model/arm.ts";
import { compose, inverse, transformPoint, type Pose } from "../spatial/pose.ts";
import type { MotionSegment, Segment } from "../trajectory/plan.ts";
import { sampleSegment } from "../trajectory/sample.ts";
import type { Program, Step } from "../program/program.ts";
import { predicateLines } from "../program/predicate.ts";
import { everyIn, everyStep, listsOf } from "../program/walk.ts";

/** The gripper takes the part that holds its grip point, else the nearest within this (row M-20) [m]. */
export const GRIP_REACH_M = 0.02;
/** What a part rests on may touch it while no point of the part is farther than this from where it rested [m]. */
export const SEAT_M = 0.003;
/** How often the way out of a seat is looked at [s]: at 1 m/s every millimetre. */
const LOOK_S = 0.001;

/** A piece of a motion over which the same pairs are watched; t in seconds after the motion's start. */
export interface Stretch {
  readonly from: number;
  readonly to: number;
  /** Pairs that must not touch here. */
  readonly watched: (pair: SolidPair) => boolean;
  /** Pairs that must keep the margin here. */
  readonly keepsMargin: (pair: SolidPair) => boolean;
}

/** A part that a program carries: how the gripper holds it, where it is taken, and where it is put down if it is. */
export interface CarriedPart {
  readonly id: string;
  readonly flangeFromObject: Pose<"flange", "object">;
  readonly taken: Seat;
  readonly put: Seat | undefined;
  /** When the gripper closes on it, in seconds of the plan; 0 for what is held from the start. */
  readonly taken_s: number;
  /** When it is let go; undefined when it is held to the end. */
  readonly put_s: number | undefined;
}
/** A part on its way from one grasp to its release. */
interface Hold extends CarriedPart {
  readonly radius_m: number;
  put: Seat | undefined;
  put_s: number | undefined;
  /** The motions in between, in order. */
  readonly motions: MotionSegment[];
}
/** Where a part rests, and the objects it touches there. */
export interface Seat {
  readonly worldFromObject: Pose<"world", "object">;
  readonly on: ReadonlySet<string>;
}
/** Seconds of a motion within which a seat counts: [0, first] and [last, duration]. */
interface Bounds {
  first: number;
  last: number;
}

/**
 * Whether held parts can be followed through a program: not where a decision leads to other motions or grips, because
 * then a part may be held on one side and stand on the other.
 */
export function partsAreFollowed(program: Pick<Program, "steps" | "routines">): boolean {
  const acts = (steps: readonly Step[], inside: readonly string[]): boolean =>
    [...everyIn(steps)].some(
      step =>
        step.type === "move" ||
        step.type === "gripper" ||
        (step.type === "call" &&
          !inside.includes(step.routine) &&
          acts(program.routines[step.routine] ?? [], [...inside, step.routine])),
    );
  const decides = (step: Step): boolean =>
    step.type === "if" || step.type === "wait-for" || (step.type === "while" && predicateLines(step.when).length > 0);
  return ![...everyStep(program)].some(step => decides(step) && listsOf(step).some(list => acts(list, [])));
}

/**
 * Where the fingers meet: the TCP of the first tool that a move names, else of the cell's tool, else that of a gripper
 * on the bare flange.
 */
function gripOf(program: Program, cell: CellGeometry): Pose<"flange", "grip"> {
  const named = [...everyStep(program)].find(step => step.type === "move" && step.target.tool !== undefined);
  const tool = named?.type === "move" ? program.tools[named.target.tool!] : undefined;
  return (
    (tool as Pose | undefined as Pose<"flange", "grip"> | undefined) ??
    cell.flangeFromGrip ??
    PARALLEL_GRIPPER.flangeFromGrip
  );
}

/**
 * The parts that a laid-out program takes, carries and puts down, played on a collider: `rewind`, then `enter` every
 * segment in order.
 *
 * A part is taken where the gripper closes: it moves with the flange as it stood then, does not count as an obstacle
 * for the last link and the tool, and where the gripper opens it stays. One part is held at a time, and it takes
 * nothing along that lies on it. A part may touch what it rests on (all that is nearer than `TOUCH_M`) for `SEAT_M` of
 * its way, and be nearer than the margin for so much more; beyond that it is watched like any other solid of the robot.
 * What the cell says is held is carried from the start.
 */
export class GraspedParts {
  /** Times the gripper closed on a part, and on nothing. */
  taken = 0;
  missed = 0;
  readonly #collider: CellCollider;
  readonly #cell: CellGeometry;
  readonly #arm: SerialArm;
  readonly #margin_m: number;
  readonly #changes = new Map<Segment, () => void>();
  readonly #stretches = new Map<Segment, readonly Stretch[]>();
  readonly #q: Float64Array;
  readonly #holds: Hold[] = [];
  #held: string | undefined = undefined;

  /** @param collider  stands as the cell does, and again afterwards; lent. */
  constructor(
    collider: CellCollider,
    cell: CellGeometry,
    program: Program,
    arm: SerialArm,
    segments: readonly Segment[],
    margin_m: number,
  ) {
    this.#collider = collider;
    this.#cell = cell;
    this.#arm = arm;
    this.#margin_m = margin_m;
    this.#q = new Float64Array(arm.joints.length);
    if (!partsAreFollowed(program)) {
      // Nobody knows when it lets go: what is held is carried all the way.
      this.rewind();
      return;
    }
    const parts = new Set(cell.objects.filter(({ graspable }) => graspable === true).map(({ id }) => id));
    const grip = gripOf(program, cell);
    const holds = this.#holds;
    const stands = new Map(cell.objects.map(({ id, worldFromObject }) => [id, worldFromObject]));
    let hold = this.#heldFromTheStart(segments);
    let closed = hold !== undefined;
    for (const segment of segments) {
      if (segment.kind === "motion") {
        if (segment.times_s.length > 1) hold?.motions.push(segment);
        continue;
      }
      if (segment.gripperClosed === closed) continue;
      closed = segment.gripperClosed;
      const worldFromFlange = this.#flangeAt(segment.q_rad);
      if (closed) {
        const id = collider.nearestObject(transformPoint(worldFromFlange, grip.position), GRIP_REACH_M, each =>
          parts.has(each),
        );
        if (id === undefined) {
          this.missed++;
          continue;
        }
        const worldFromObject = stands.get(id)!;
        const flangeFromObject = compose(inverse(worldFromFlange), worldFromObject);
        const taken = { worldFromObject, on: new Set(collider.standingNear(id, TOUCH_M)) };
        hold = {
          id,
          radius_m: radiusOf(cell, id),
          flangeFromObject,
          taken,
          taken_s: segment.start_s,
          put: undefined,
          put_s: undefined,
          motions: [],
        };
        holds.push(hold);
        this.taken++;
        this.#change(segment, () => {
          this.#held = id;
          collider.attach(id, flangeFromObject);
        });
      } else if (hold !== undefined) {
        const { id } = hold;
        const worldFromObject = compose(worldFromFlange, hold.flangeFromObject);
        stands.set(id, worldFromObject);
        this.#change(segment, () => {
          this.#held = undefined;
          collider.detach(id, worldFromObject);
        });
        hold.put_s = segment.start_s;
        hold.put = { worldFromObject, on: new Set(collider.standingNear(id, TOUCH_M)) };
        hold = undefined;
      }
    }
    for (const each of holds) this.#cut(each);
    this.rewind();
  }

  /** The parts that are carried, in the order they are taken. */
  get carried(): readonly CarriedPart[] {
    return this.#holds.map(({ id, flangeFromObject, taken, put, taken_s, put_s }) => ({
      id,
      flangeFromObject,
      taken,
      put,
      taken_s,
      put_s,
    }));
  }

  /** Id of the part that is held in the segment entered last. */
  get held(): string | undefined {
    return this.#held;
  }

  /** All parts stand where the cell has them. */
  rewind(): void {
    const { held } = this.#cell;
    this.#held = held?.id;
    if (this.taken > 0 || held)
      for (const { id, worldFromObject, graspable } of this.#cell.objects)
        if (graspable === true) this.#collider.detach(id, worldFromObject);
    if (held) this.#collider.attach(held.id, held.flangeFromObject);
  }

  /** What is held already, which may rest on something where the program begins. */
  #heldFromTheStart(segments: readonly Segment[]): Hold | undefined {
    const { held } = this.#cell;
    const [first] = segments;
    if (!held || !first) return undefined;
    const { id, flangeFromObject } = held;
    const worldFromObject = compose(
      this.#flangeAt(first.q_rad.slice(0, this.#arm.joints.length)),
      flangeFromObject,
    ) as Pose as Pose<"world", "object">;
    this.#collider.detach(id, worldFromObject);
    const taken = { worldFromObject, on: new Set(this.#collider.standingNear(id, TOUCH_M)) };
    this.#collider.attach(id, flangeFromObject);
    const hold: Hold = {
      id,
      radius_m: radiusOf(this.#cell, id),
      flangeFromObject,
      taken,
      taken_s: 0,
      put: undefined,
      put_s: undefined,
      motions: [],
    };
    this.#holds.push(hold);
    return hold;
  }

  /** Takes or puts down what the gripper does in this segment, and says what is to be watched through it. */
  enter(segment: Segment): readonly Stretch[] {
    this.#changes.get(segment)?.();
    return this.#stretches.get(segment) ?? [wholeOf(segment)];
  }

  #change(segment: Segment, happen: () => void): void {
    this.#changes.set(segment, happen);
    happen();
  }

  #flangeAt(q: ArrayLike<number>): Pose<"world", "flange"> {
    return compose(this.#cell.worldFromBase, flangePose(this.#arm, q));
  }

  /** Cuts the motions of a hold where the part leaves its seat and where it comes to the next one. */
  #cut(hold: Hold): void {
    const { id, motions, taken, put } = hold;
    const none = (): Map<MotionSegment, Bounds> =>
      new Map(motions.map(motion => [motion, { first: 0, last: motion.duration_s }]));
    const touch = none();
    const near = none();
    const reaches = [
      [touch, SEAT_M],
      [near, SEAT_M + this.#margin_m],
    ] as const;
    for (const [bounds, reach_m] of reaches) {
      for (const motion of motions) {
        const until = (bounds.get(motion)!.first = this.#within(hold, motion, taken, reach_m, false));
        if (until < motion.duration_s) break;
      }
      if (put !== undefined)
        for (const motion of [...motions].reverse()) {
          const since = (bounds.get(motion)!.last = this.#within(hold, motion, put, reach_m, true));
          if (since > 0) break;
        }
    }
    for (const motion of motions) {
      const free = touch.get(motion)!;
      const beside = near.get(motion)!;
      const end = motion.duration_s;
      const marks =
        end > 0
          ? [...new Set([0, free.first, free.last, beside.first, beside.last, end])].sort((a, b) => a - b)
          : [0, 0];
      const commanders = (bounds: Bounds, from: number, to: number): ReadonlySet<string> =>
        new Set([...(to <= bounds.first ? taken.on : []), ...(put !== undefined && from >= bounds.last ? put.on : [])]);
      this.#stretches.set(
        motion,
        marks.slice(1).map((to, i): Stretch => {
          const from = marks[i]!;
          const may = commanders(free, from, to);
          const lies = commanders(beside, from, to);
          return {
            from,
            to,
            watched: pair => !joins(pair, id, may),
            keepsMargin: pair => keptApart(pair) && !joins(pair, id, lies),
          };
        }),
      );
    }
  }

  /** The time until which, or `back` since which, the part stays within `reach_m` of its seat. */
  #within(
    { flangeFromObject, radius_m }: Hold,
    motion: MotionSegment,
    { worldFromObject }: Seat,
    reach_m: number,
    back: boolean,
  ): number {
    const end = motion.duration_s;
    const looks = Math.max(1, Math.ceil(end / LOOK_S));
    const timeOf = (i: number): number => (back ? end - (end * i) / looks : (end * i) / looks);
    for (let i = 0; i <= looks; i++) {
      sampleSegment(motion, timeOf(i), this.#q);
      if (movedBy(worldFromObject, compose(this.#flangeAt(this.#q), flangeFromObject), radius_m) > reach_m)
        return timeOf(Math.max(0, i - 1));
    }
    return timeOf(looks);
  }
}

const ALL = (): boolean => true;
const wholeOf = ({ duration_s }: Segment): Stretch => ({
  from: 0,
  to: duration_s,
  watched: ALL,
  keepsMargin: keptApart,
});

/** Whether the pair is this part and one of those objects. */
const joins = ({ contact: { a, b } }: SolidPair, id: string, others: ReadonlySet<string>): boolean =>
  (a === id && others.has(b)) || (b === id && others.has(a));

/** No point of a body of this radius lies farther from where it was [m]:  |Δp| + 2 r |sin(φ/2)|. */
export function movedBy(from: Pose, to: Pose, radius_m: number): number {
  const [x, y, z] = compose(inverse(from), to).quaternion;
  return Math.hypot(...from.position.map((at, k) => to.position[k]! - at)) + 2 * radius_m * Math.hypot(x, y, z);
}

export function radiusOf(cell: Pick<CellGeometry, "objects">, id: string): number {
  const { positions } = cell.objects.find(object => object.id === id)!.mesh;
  let most_m = 0;
  for (let i = 0; i < positions.length; i += 3)
    most_m = Math.max(most_m, Math.hypot(positions[i]!, positions[i + 1]!, positions[i + 2]!));
  return most_m;
}
