import {
  compose,
  flangePose,
  GRIP_REACH_M,
  inverse,
  movedBy,
  PARALLEL_GRIPPER,
  radiusOf,
  SEAT_M,
  TOUCH_M,
  transformPoint,
  type CarriedPart,
  type CellCollider,
  type CellGeometry,
  type Pose,
  type Robot,
  type Seat,
  type SolidPair,
} from "@twincell/core";

/**
 * Where a checked program puts a part down, the guard, which looks ahead of a motion that brakes there, lets it come
 * near [m].
 */
const LANDING_M = 0.02;

interface Held {
  readonly id: string;
  readonly radius_m: number;
  readonly flangeFromObject: Pose<"flange", "object">;
  /** Where it rested when the gripper closed. */
  readonly from: Seat;
}

/**
 * The part in the gripper of a robot that is guarded. It is taken where the gripper closes on a work piece of the cell
 * (row M-20), moves with the flange from then on, and stays where the gripper opens. It may touch what it rested on
 * while it leaves it, and what a checked program puts it down on while it arrives there; everything else it is kept
 * from like the tool.
 */
export class PartInGripper {
  readonly #collider: CellCollider;
  readonly #cell: CellGeometry;
  readonly #robot: Robot;
  readonly #reach_m: number;
  readonly #parts: ReadonlySet<string>;
  #held: Held | null = null;
  #carried: readonly CarriedPart[] = [];

  /**
   * @param collider  of that cell; it is changed when parts are taken and let go.
   * @param margin_m  room that is kept, errors of place in it: a part that leaves its seat is within it for so long.
   */
  constructor(collider: CellCollider, cell: CellGeometry, robot: Robot, margin_m: number) {
    this.#collider = collider;
    this.#cell = cell;
    this.#robot = robot;
    this.#reach_m = SEAT_M + margin_m;
    this.#parts = new Set(cell.objects.filter(({ graspable }) => graspable === true).map(({ id }) => id));
  }

  /** What is held, and how. */
  get held(): CellGeometry["held"] | null {
    return this.#held && { id: this.#held.id, flangeFromObject: this.#held.flangeFromObject };
  }

  /** Goes on with what another held, where that is a part of this cell too. */
  goOnFrom(before: PartInGripper): void {
    this.#carried = before.#carried;
    const held = before.#held;
    if (!held || !this.#parts.has(held.id)) return;
    this.#held = held;
    this.#collider.attach(held.id, held.flangeFromObject);
  }

  /**
   * A checked program begins, which carries these. It counts on parts that stand where the cell has them: they are put
   * back there, but for the one that is held. One that carries nothing, a step by hand for instance, leaves them where
   * they were let go.
   */
  begin(carried: readonly CarriedPart[]): void {
    this.#carried = carried;
    if (carried.length === 0) return;
    for (const { id, worldFromObject } of this.#cell.objects)
      if (this.#parts.has(id) && id !== this.#held?.id) this.#collider.detach(id, worldFromObject);
  }
  end(): void {
    this.#carried = [];
  }

  /** The gripper closed or opened at that posture. */
  gripper(closed: boolean, q_rad: ArrayLike<number>): void {
    const worldFromFlange = compose(this.#cell.worldFromBase, flangePose(this.#robot.arm, q_rad));
    if (!closed) {
      if (!this.#held) return;
      const { id, flangeFromObject } = this.#held;
      this.#held = null;
      this.#collider.detach(id, compose(worldFromFlange, flangeFromObject) as Pose as Pose<"world", "object">);
      return;
    }
    if (this.#held) return;
    const id = this.#partAt(worldFromFlange);
    if (id === undefined) return;
    const worldFromObject = this.#collider.standsAt(id)!;
    const from = { worldFromObject, on: new Set(this.#collider.standingNear(id, TOUCH_M)) };
    const flangeFromObject = compose(inverse(worldFromFlange), worldFromObject);
    this.#held = { id, radius_m: radiusOf(this.#cell, id), flangeFromObject, from };
    this.#collider.attach(id, flangeFromObject);
  }

  /** Whether that pair is the part in the gripper and what it leaves or arrives at, in that posture. */
  excuses({ contact: { a, b } }: SolidPair, q_rad: ArrayLike<number>): boolean {
    const held = this.#held;
    if (!held || (a !== held.id && b !== held.id)) return false;
    const other = a === held.id ? b : a;
    const seats: (readonly [Seat, number])[] = [[held.from, this.#reach_m]];
    for (const { id, taken, put } of this.#carried) {
      if (id !== held.id) continue;
      seats.push([taken, this.#reach_m]);
      if (put) seats.push([put, this.#reach_m + LANDING_M]);
    }
    if (!seats.some(([{ on }]) => on.has(other))) return false;
    const here = compose(compose(this.#cell.worldFromBase, flangePose(this.#robot.arm, q_rad)), held.flangeFromObject);
    return seats.some(
      ([{ worldFromObject, on }, reach_m]) => on.has(other) && movedBy(worldFromObject, here, held.radius_m) <= reach_m,
    );
  }

  /** The part that a checked program takes there, else the one at the grip point. */
  #partAt(worldFromFlange: Pose<"world", "flange">): string | undefined {
    const planned = this.#carried.find(
      ({ id, flangeFromObject, taken }) =>
        this.#parts.has(id) &&
        movedBy(taken.worldFromObject, compose(worldFromFlange, flangeFromObject), radiusOf(this.#cell, id)) <=
          GRIP_REACH_M,
    );
    if (planned) return planned.id;
    const grip = this.#cell.flangeFromGrip ?? PARALLEL_GRIPPER.flangeFromGrip;
    return this.#collider.nearestObject(transformPoint(worldFromFlange, grip.position), GRIP_REACH_M, id =>
      this.#parts.has(id),
    );
  }
}
