import { armScratch, linkPoses } from "../kinematics/forward.ts";
import type { SerialArm } from "../model/arm.ts";
import { compose, copyPose, identity, type Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { bodiesOf, farApart, objectBody, placeBody, reachesOf, SolidCache, WORLD, type Body } from "./bodies.ts";
import type { CellGeometry, CellObject, Contact } from "./cell.ts";
import { pairScratch } from "./intersect.ts";
import { between, movePoints, rigidFromPose } from "./relative.ts";
import { solidDistance, solidKeepsApart, solidsTouch } from "./solid.ts";
import { POINT_MESH } from "./contact-probe.ts";

/** The tool touches a work piece when it is nearer than this (row N-51) [m]. */
export const TOUCH_M = 0.0005;

/**
 * The trees of this thread, by their meshes, for as long as the meshes are in use: a cell that is built again after an
 * edit finds those of its robot and of everything that stayed.
 */
const BUILT_SOLIDS = new SolidCache();

/** The two solids that are nearest to each other, and where. Points are in the world [m]. */
export interface Clearance {
  /** Infinity when nothing is nearer than the cut-off. */
  distance_m: number;
  a: string;
  b: string;
  readonly pointA: Vector3;
  readonly pointB: Vector3;
}
export const clearance = (): Clearance => ({
  distance_m: Infinity,
  a: "",
  b: "",
  pointA: [0, 0, 0],
  pointB: [0, 0, 0],
});

/** Two solids that must not meet, the one nearer to the base first. */
export interface SolidPair {
  readonly a: Body;
  readonly b: Body;
  readonly contact: Contact;
  /** Nearest triangles last time, where the next search begins. */
  readonly witness: Int32Array;
  /** Triangles that were too near in a motion last time, the outer solid's first. */
  readonly tooNear: Int32Array;
  /** Grows each time the pair is in contact; pairs that meet often are asked first. */
  hits: number;
  /**
   * Of two parts of the robot: the distance they may be asked to keep at most [m], since they are nearer by design than
   * anybody may ask for; undefined while no posture known to be free was learnt.
   */
  room_m: number | undefined;
}

/** Of the distance that two parts of a robot have where it is known to be free, this much may be asked for. */
const OWN_SHARE = 0.5;
/** Parts of a robot that are farther apart there may be asked to keep whatever is wanted [m]. */
const OWN_FAR_M = 0.5;

/**
 * Answers questions about contact and clearance in one cell. It owns its working memory: one collider a worker.
 * After construction `check`, `collides`, `near`, `touches` and `clearance` allocate nothing (but what they push to
 * `out`).
 *
 * Checked are: every moving link, the tool and what it holds against every object, and parts of the robot at least two
 * links apart against each other. Parts that follow each other along the arm touch by design and are left out, and so
 * are the pairs of `allowedPairs`. The tool counts as the link after the last, and what it holds as part of the tool.
 */
export class CellCollider {
  readonly shapeError_m: number;
  readonly placeError_m: number;
  readonly #arm: SerialArm;
  readonly #solidCache: SolidCache;
  readonly #bodies: Body[];
  readonly #allowed = new Set<string>();
  readonly #decided = new Set<string>();
  readonly #rooms = new Map<string, number>();
  readonly #worldFromBase: Pose<"world", "base">;
  readonly #baseFromLinks: Pose<"base", "link">[];
  readonly #worldFromLink: Pose = identity();
  readonly #turn: Pose = identity();
  readonly #armScratch = armScratch();
  readonly #scratch = pairScratch();
  readonly #points = new Float64Array(6);
  #pairs: SolidPair[] = [];
  #edition = 0;

  /** @param solidCache  where built trees are kept; the one of this thread when left out. */
  constructor(cell: CellGeometry, arm: SerialArm, solidCache = BUILT_SOLIDS) {
    this.shapeError_m = cell.shapeError_m;
    this.placeError_m = cell.placeError_m ?? 0;
    this.#arm = arm;
    this.#solidCache = solidCache;
    this.#worldFromBase = copyPose(cell.worldFromBase);
    this.#baseFromLinks = Array.from({ length: arm.joints.length + 1 }, () => identity<"base", "link">());
    this.#bodies = bodiesOf(cell, arm, solidCache);
    for (const [a, b] of cell.allowedPairs) this.#allowed.add(keyOf(a, b));
    for (const { a, b, watched } of cell.pairs?.entries ?? []) {
      this.#decided.add(keyOf(a, b));
      if (!watched) this.#allowed.add(keyOf(a, b));
    }
    this.#arrange();
  }

  /** Every pair that is watched. The list is replaced when objects come, go or change hands. */
  get pairs(): readonly SolidPair[] {
    return this.#pairs;
  }

  /**
   * Grows whenever an object comes, goes, moves or changes hands, or pairs become allowed: what was proven before may
   * be wrong then.
   */
  get edition(): number {
    return this.#edition;
  }

  /**
   * Puts the robot in this posture. The queries below do it themselves; `distanceOf` answers for the last one placed.
   */
  place(q: ArrayLike<number>): void {
    linkPoses(this.#arm, q, this.#baseFromLinks, this.#armScratch);
    for (const body of this.#bodies) if (body.carrier !== WORLD) this.#placeOnLink(body);
  }

  /** All pairs in contact at q, appended to an emptied `out`. */
  check(q: ArrayLike<number>, out: Contact[] = []): Contact[] {
    this.place(q);
    out.length = 0;
    for (const pair of this.#pairs) if (this.touchOf(pair)) out.push(pair.contact);
    return out;
  }

  /**
   * Whether anything is in contact at q: like `check`, but stops at the first pair found and asks frequent ones first.
   */
  collides(q: ArrayLike<number>): boolean {
    this.place(q);
    const pairs = this.#pairs;
    for (let i = 0; i < pairs.length; i++) {
      const pair = pairs[i]!;
      if (!this.touchOf(pair)) continue;
      pair.hits++;
      if (i > 0 && pairs[i - 1]!.hits < pair.hits) {
        pairs[i] = pairs[i - 1]!;
        pairs[i - 1] = pair;
      }
      return true;
    }
    return false;
  }

  /** All watched pairs nearer than `within_m` at q. */
  near(q: ArrayLike<number>, within_m: number, out: Contact[] = []): Contact[] {
    this.place(q);
    out.length = 0;
    for (const pair of this.#pairs) if (this.distanceOf(pair, within_m, within_m) < within_m) out.push(pair.contact);
    return out;
  }

  /** What the tool touches at q: objects nearer than `within_m`, allowed ones included. For teaching by touch. */
  touches(q: ArrayLike<number>, within_m = TOUCH_M, out: string[] = []): string[] {
    this.place(q);
    out.length = 0;
    for (const tool of this.#bodies) {
      if (tool.kind !== "tool") continue;
      for (const object of this.#bodies) {
        if (object.carrier !== WORLD || object.kind !== "object" || farApart(tool.box, object.box, within_m)) continue;
        this.#scratch.witness.fill(-1);
        const relative = between(tool.worldFromBody, object.worldFromBody, this.#scratch.relative);
        if (solidDistance(tool.solid, object.solid, relative, within_m, this.#scratch, this.#points) < within_m)
          out.push(object.name);
      }
    }
    return out;
  }

  /**
   * The standing object nearest to a point of the world, if nearer than `within_m`: 0 for one that holds it. Of several
   * as near the first.
   *
   * @param counts  which objects are looked at.
   */
  nearestObject(point_m: Vector3, within_m: number, counts: (id: string) => boolean): string | undefined {
    const point = this.#solidCache.of(POINT_MESH);
    const worldFromPoint = rigidFromPose({ position: point_m, quaternion: [0, 0, 0, 1] });
    let nearest: string | undefined;
    let limit = within_m;
    for (const { kind, carrier, name, solid, worldFromBody } of this.#bodies) {
      if (kind !== "object" || carrier !== WORLD || !counts(name)) continue;
      this.#scratch.witness.fill(-1);
      const distance = solidDistance(
        point,
        solid,
        between(worldFromPoint, worldFromBody, this.#scratch.relative),
        limit,
        this.#scratch,
        this.#points,
      );
      if (distance < limit) {
        limit = distance;
        nearest = name;
      }
    }
    return nearest;
  }

  /** Where the standing object of this id stands; undefined for one that is held or not there. */
  standsAt(id: string): Pose<"world", "object"> | undefined {
    const body = this.#object(id);
    if (body?.carrier !== WORLD) return undefined;
    return copyPose(body.carrierFromBody) as Pose as Pose<"world", "object">;
  }

  /** Standing objects nearer than `within_m` to the standing object of this id. */
  standingNear(id: string, within_m: number): string[] {
    const body = this.#object(id);
    if (body?.carrier !== WORLD) return [];
    return this.#bodies
      .filter(other => {
        if (
          other === body ||
          other.kind !== "object" ||
          other.carrier !== WORLD ||
          farApart(body.box, other.box, within_m)
        )
          return false;
        this.#scratch.witness.fill(-1);
        return (
          solidDistance(
            body.solid,
            other.solid,
            between(body.worldFromBody, other.worldFromBody, this.#scratch.relative),
            within_m,
            this.#scratch,
            this.#points,
          ) < within_m
        );
      })
      .map(({ name }) => name);
  }

  /**
   * The smallest distance between watched solids at q, if it is below `cutoff_m`: a tighter cut-off answers faster.
   *
   * @param counts  pairs to look at; all without it. `robotAndCell` leaves out the robot's distance from itself.
   */
  clearance(
    q: ArrayLike<number>,
    cutoff_m: number,
    out: Clearance = clearance(),
    counts?: (pair: SolidPair) => boolean,
  ): Clearance {
    this.place(q);
    out.distance_m = Infinity;
    out.a = out.b = "";
    let limit = cutoff_m;
    for (const pair of this.#pairs) {
      if (counts?.(pair) === false) continue;
      const distance = this.distanceOf(pair, limit);
      if (distance >= limit) continue;
      limit = out.distance_m = distance;
      out.a = pair.contact.a;
      out.b = pair.contact.b;
      this.#pointsInto(pair, out);
      if (distance === 0) break;
    }
    return out;
  }

  /**
   * Distance of one pair [m] in the posture last placed, if below `cutoff_m`, else Infinity.
   *
   * @param enough_m  a first find nearer than this ends the search, and the answer is then only a bound from above.
   */
  distanceOf(pair: SolidPair, cutoff_m: number, enough_m = 0): number {
    const { a, b, witness } = pair;
    if (farApart(a.box, b.box, cutoff_m)) return Infinity;
    const relative = between(a.worldFromBody, b.worldFromBody, this.#scratch.relative);
    this.#scratch.witness.set(witness);
    const distance = solidDistance(a.solid, b.solid, relative, cutoff_m, this.#scratch, this.#points, enough_m);
    if (distance < cutoff_m) witness.set(this.#scratch.witness);
    return distance;
  }

  /**
   * Whether, in the posture last placed, every point of the pair's outer solid (the one farther along the arm) is more
   * than `near_m` + `perMetre` r from the other, where r is the point's distance from the origin of its own frame.
   */
  keepsApart(pair: SolidPair, near_m: number, perMetre: number): boolean {
    const outer = pair.a.carrier > pair.b.carrier ? pair.a : pair.b;
    const inner = outer === pair.a ? pair.b : pair.a;
    if (farApart(outer.box, inner.box, near_m + perMetre * outer.solid.radius_m)) return true;
    const relative = between(outer.worldFromBody, inner.worldFromBody, this.#scratch.relative);
    this.#scratch.witness.set(pair.tooNear);
    const apart = solidKeepsApart(outer.solid, inner.solid, relative, near_m, perMetre, this.#scratch, this.#points);
    if (!apart) pair.tooNear.set(this.#scratch.witness);
    return apart;
  }

  /** Whether one pair is in contact in the posture last placed. */
  touchOf({ a, b }: SolidPair): boolean {
    if (farApart(a.box, b.box, 0)) return false;
    return solidsTouch(
      a.solid,
      b.solid,
      between(a.worldFromBody, b.worldFromBody, this.#scratch.relative),
      this.#scratch,
    );
  }

  /**
   * Contacts of the robot with itself at q from now on count as part of the design: drawn shapes overlap in joints;
   * and no two parts of it are asked to keep more than half the distance that they have there. Call it at a posture
   * known to be free, such as home. Pairs that the cell's matrix speaks of stay as it says.
   *
   * @returns the pairs that were learnt.
   */
  allowContactsAt(q: ArrayLike<number>): readonly Contact[] {
    const learnt = this.check(q).filter(
      ({ a, b }) => this.#isRobot(a) && this.#isRobot(b) && !this.#decided.has(keyOf(a, b)),
    );
    for (const { a, b } of learnt) this.#allowed.add(keyOf(a, b));
    for (const pair of this.#pairs) {
      if (pair.contact.between !== "self") continue;
      const key = keyOf(pair.contact.a, pair.contact.b);
      const far_m = this.distanceOf(pair, OWN_FAR_M);
      const room_m = far_m === Infinity ? Infinity : OWN_SHARE * far_m;
      this.#rooms.set(key, Math.min(room_m, this.#rooms.get(key) ?? Infinity));
    }
    this.#arrange();
    return learnt;
  }

  /** Adds an object, or puts it in the place of the one with the same id. */
  setObject(object: CellObject): void {
    const at = this.#bodies.findIndex(body => body.name === object.id);
    const body = objectBody(object, this.#solidCache);
    if (at >= 0) this.#bodies[at] = body;
    else this.#bodies.push(body);
    this.#arrange();
  }

  removeObject(id: string): void {
    const at = this.#bodies.findIndex(body => body.kind === "object" && body.name === id);
    if (at < 0) return;
    this.#bodies.splice(at, 1);
    this.#arrange();
  }

  /** Moves an object that stands in the world. Cheap: call it every frame while one is dragged. */
  moveObject(id: string, worldFromObject: Pose<"world", "object">): void {
    const body = this.#object(id);
    if (body?.carrier !== WORLD) return;
    copyPose(worldFromObject as Pose, body.carrierFromBody);
    placeBody(body, HERE, this.#turn);
    this.#edition++;
  }

  /** From now on the object moves with the flange, as gripped things do. */
  attach(id: string, flangeFromObject: Pose<"flange", "object">): void {
    const body = this.#object(id);
    if (!body) return;
    body.carrier = this.#arm.joints.length;
    compose(this.#arm.lastJointFromFlange as Pose, flangeFromObject as Pose, body.carrierFromBody);
    body.reach_m = reachesOf(body, this.#arm);
    this.#arrange();
  }

  /** Lets go of the object: it stays in the world where it is put. */
  detach(id: string, worldFromObject: Pose<"world", "object">): void {
    const body = this.#object(id);
    if (!body) return;
    body.carrier = WORLD;
    body.reach_m = [];
    copyPose(worldFromObject as Pose, body.carrierFromBody);
    this.#arrange();
  }

  #object(id: string): Body | undefined {
    return this.#bodies.find(body => body.kind === "object" && body.name === id);
  }
  #isRobot(name: string): boolean {
    return this.#bodies.some(body => body.name === name && body.kind !== "object");
  }

  #placeOnLink(body: Body): void {
    compose(this.#worldFromBase as Pose, this.#baseFromLinks[body.carrier] as Pose, this.#worldFromLink);
    placeBody(body, this.#worldFromLink, this.#turn);
  }

  #pointsInto({ a }: SolidPair, out: Clearance): void {
    movePoints(a.worldFromBody, this.#points, 0, 2, this.#points, 0);
    for (let k = 0; k < 3; k++) {
      out.pointA[k] = this.#points[k]!;
      out.pointB[k] = this.#points[3 + k]!;
    }
  }

  /** Places what stands still and lists the pairs to watch. */
  #arrange(): void {
    this.#edition++;
    const known = new Map(this.#pairs.map(pair => [keyOf(pair.contact.a, pair.contact.b), pair]));
    for (const body of this.#bodies) if (body.carrier === WORLD) placeBody(body, HERE, this.#turn);
    this.#pairs = [];
    for (let i = 0; i < this.#bodies.length; i++)
      for (let j = i + 1; j < this.#bodies.length; j++) {
        const [a, b] = [this.#bodies[i]!, this.#bodies[j]!];
        const key = keyOf(a.name, b.name);
        const before = known.get(key);
        if (this.#allowed.has(key) || !mayMeet(a, b)) continue;
        const same = before?.a === a && before.b === b;
        if (same) before.room_m = this.#rooms.get(key);
        this.#pairs.push(
          same
            ? before
            : {
                a,
                b,
                contact: {
                  a: a.name,
                  b: b.name,
                  between: a.kind === "object" || b.kind === "object" ? "other" : "self",
                },
                witness: new Int32Array(2).fill(-1),
                tooNear: new Int32Array(2).fill(-1),
                hits: 0,
                room_m: this.#rooms.get(key),
              },
        );
      }
    this.#pairs.sort((p, q) => q.hits - p.hits);
  }
}

/** Pairs of the robot, its tool or what it holds with what stands around it. */
export const robotAndCell = ({ a, b }: SolidPair): boolean => (a.carrier === WORLD) !== (b.carrier === WORLD);

/** The same, and parts of the robot among each other: what it holds may be near to what holds it. */
export const keptApart = (pair: SolidPair): boolean => robotAndCell(pair) || pair.contact.between === "self";

const HERE: Pose = identity();
const keyOf = (a: string, b: string): string => (a < b ? `${a}\n${b}` : `${b}\n${a}`);

/** Position along the arm: 0 the base, n the last link, n + 1 the tool and what it holds. */
const place = (body: Body): number => (body.kind === "link" ? body.carrier : body.carrier + 1);

function mayMeet(a: Body, b: Body): boolean {
  if (a.carrier === WORLD && b.carrier === WORLD) return false;
  if (a.carrier === WORLD || b.carrier === WORLD) return Math.max(a.carrier, b.carrier) > 0;
  return Math.abs(place(a) - place(b)) >= 2;
}
