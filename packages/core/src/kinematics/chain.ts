import { JointCountFault } from "../fault.ts";
import type { SerialArm } from "../model/arm.ts";
import { isSlide } from "../model/slide.ts";
import type { Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { elbowChainOf } from "./elbow-chain.ts";

/** Working memory of `flangePose` and its kin: one per caller, never shared between workers. */
export interface ArmScratch {
  /** The arm last asked for, laid out flat. */
  arm: SerialArm | null;
  chain: Float64Array;
  /** The same as an elbow chain, where the arm is one. */
  elbow: Float64Array | null;
  /** Joints of the arm that slide, from 0. */
  slides: readonly number[];
  readonly trig: Float64Array;
}
export const armScratch = (): ArmScratch => ({
  arm: null,
  chain: new Float64Array(0),
  elbow: null,
  slides: [],
  trig: new Float64Array(12),
});

const KEPT = new WeakMap<SerialArm, ArmScratch>();
/** Working memory for callers that bring none: one an arm, since laying an arm out costs more than a pose of it. */
export function keptScratch(arm: SerialArm): ArmScratch {
  const kept = KEPT.get(arm);
  if (kept !== undefined) return kept;
  const made = armScratch();
  KEPT.set(arm, made);
  return made;
}

/**
 * Numbers per joint of a flat chain: position, quaternion, axis, which axis, along which axis it is moved, whether
 * turned.
 */
const STRIDE = 13;
const X = 0;
const Y = 1;
const Z = 2;
const ANY = 3;
const NONE = 4;
const SLIDE = 5;

/**
 * The arm as one row of numbers, laid out when the scratch first sees it: a joint is then one line of memory.
 *
 * @throws {JointCountFault} when q does not hold one value per joint.
 */
export function chainOf(arm: SerialArm, q: ArrayLike<number>, scratch: ArmScratch): Float64Array {
  if (q.length !== arm.joints.length) throw new JointCountFault(arm.name, arm.joints.length, q.length);
  return scratch.arm === arm ? scratch.chain : layOutArm(arm, scratch);
}

/** Apart from `chainOf`: what a closure keeps is allocated on entry, used or not. */
function layOutArm(arm: SerialArm, scratch: ArmScratch): Float64Array {
  const rows = [
    ...arm.joints.map(joint => ({
      fixed: joint.parentFromJoint as Pose,
      axis: joint.axis,
      kind: isSlide(joint) ? SLIDE : directionOf(joint.axis),
    })),
    { fixed: arm.lastJointFromFlange as Pose, axis: null, kind: NONE },
  ];
  const chain = new Float64Array(rows.length * STRIDE);
  if (halves.length < 2 * rows.length) halves = new Float64Array(2 * rows.length);
  rows.forEach(({ fixed, axis, kind }, i) => {
    const { position, quaternion } = fixed;
    const turned = quaternion[0] !== 0 || quaternion[1] !== 0 || quaternion[2] !== 0 || quaternion[3] !== 1;
    chain.set(
      [...position, ...quaternion, ...(axis ?? [0, 0, 0]), kind, directionOf(position), turned ? 1 : 0],
      i * STRIDE,
    );
  });
  scratch.arm = arm;
  scratch.chain = chain;
  scratch.elbow = elbowChainOf(arm);
  scratch.slides = arm.joints.flatMap((joint, i) => (isSlide(joint) ? [i] : []));
  return chain;
}

/** Along one axis of its frame, none or any: most arms are built at right angles, and that halves the work. */
function directionOf(vector: Vector3): number {
  const along = vector.findIndex(value => value !== 0);
  return along < 0 ? NONE : vector.every((value, i) => i === along || value === 0) ? along : ANY;
}

const TURNS_PER_RAD = 1 / (2 * Math.PI);
/** 2π in two parts: whole multiples of the first are exact. */
const TURN_HIGH = 4 * 1.57079632673412561417;
const TURN_LOW = 4 * 6.07710050650619224932e-11;
/** Sine and cosine up to π/4 (fdlibm, kernels k_sin and k_cos). */
const S1 = -1.66666666666666324348e-1;
const S2 = 8.33333333332248946124e-3;
const S3 = -1.98412698298579493134e-4;
const S4 = 2.75573137070700676789e-6;
const S5 = -2.50507602534068634195e-8;
const S6 = 1.58969099521155010221e-10;
const C1 = 4.16666666666666019037e-2;
const C2 = -1.38888888888741095749e-3;
const C3 = 2.48015872894767294178e-5;
const C4 = -2.75573143513906633035e-7;
const C5 = 2.0875723212981748279e-9;
const C6 = -1.13596475577881948265e-11;

/** Sine and cosine of half the angle of every joint of the chain being walked; grown when an arm is laid out. */
let halves = new Float64Array(2 * 16);

/**
 * Sines and cosines of half of all angles, before the walk: they do not wait for each other there.
 *
 * Half turns are taken off the half angle, and a fourth of the turn goes through the polynomials: no branch to
 * mispredict.
 */
function takeHalves(q: ArrayLike<number>): void {
  for (let joint = 0; joint < q.length; joint++) {
    const angle = q[joint]!;
    const n = Math.floor(angle * TURNS_PER_RAD + 0.5);
    const r = 0.25 * (angle - n * TURN_HIGH - n * TURN_LOW);
    const r2 = r * r;
    const r4 = r2 * r2;
    const sr = r + r * r2 * (S1 + r2 * S2 + r4 * (S3 + r2 * S4 + r4 * (S5 + r2 * S6)));
    const cr = 1 - 0.5 * r2 + r4 * (C1 + r2 * C2 + r4 * (C3 + r2 * C4 + r4 * (C5 + r2 * C6)));
    const sign = 1 - 2 * (n & 1);
    halves[2 * joint] = sign * 2 * sr * cr;
    halves[2 * joint + 1] = sign * (1 - 2 * sr * sr);
  }
}

/**
 * Forward kinematics of a laid-out arm, row after row of `chain`:
 *
 *   running ← running · fixed · Rot(axis, q),   of a slide   running · fixed · Trans(axis q)
 *
 * The running pose stays in local numbers: what is stored and loaded again between two joints costs as much as the
 * sines. Allocates nothing.
 *
 * @param q       one value per joint [rad, of a slide m], checked by `chainOf`.
 * @param flange  receives the end of the chain, or null.
 * @param links   receive the base and every joint's frame after its motion, or null.
 * @param axes    receives six numbers per joint: its axis and its origin in the base, of a slide where q = 0; or null.
 */
export function walk(
  chain: Float64Array,
  q: ArrayLike<number>,
  flange: Pose | null,
  links: readonly Pose[] | null,
  axes: Float64Array | null,
): void {
  takeHalves(q);
  let x = 0;
  let y = 0;
  let z = 0;
  let w = 1;
  let ox = 0;
  let oy = 0;
  let oz = 0;
  if (links !== null) store(links[0]!, x, y, z, w, ox, oy, oz);
  for (let at = 0, joint = 0; ; at += STRIDE, joint++) {
    const move = chain[at + 11]!;
    if (move === Z) {
      const dd = 2 * chain[at + 2]!;
      ox += (x * z + w * y) * dd;
      oy += (y * z - w * x) * dd;
      oz += chain[at + 2]! - (x * x + y * y) * dd;
    } else if (move === X) {
      const dd = 2 * chain[at]!;
      ox += chain[at]! - (y * y + z * z) * dd;
      oy += (x * y + w * z) * dd;
      oz += (x * z - w * y) * dd;
    } else if (move === Y || move === ANY) {
      const px = chain[at]!;
      const py = chain[at + 1]!;
      const pz = chain[at + 2]!;
      const tx = 2 * (y * pz - z * py);
      const ty = 2 * (z * px - x * pz);
      const tz = 2 * (x * py - y * px);
      ox += px + w * tx + y * tz - z * ty;
      oy += py + w * ty + z * tx - x * tz;
      oz += pz + w * tz + x * ty - y * tx;
    }
    if (chain[at + 12] === 1) {
      const bx = chain[at + 3]!;
      const by = chain[at + 4]!;
      const bz = chain[at + 5]!;
      const bw = chain[at + 6]!;
      const nx = w * bx + x * bw + y * bz - z * by;
      const ny = w * by - x * bz + y * bw + z * bx;
      const nz = w * bz + x * by - y * bx + z * bw;
      w = w * bw - x * bx - y * by - z * bz;
      x = nx;
      y = ny;
      z = nz;
    }
    const kind = chain[at + 10]!;
    if (kind === NONE) break;
    if (axes !== null) storeAxis(axes, 6 * joint, chain, at + 7, x, y, z, w, ox, oy, oz);
    const s = halves[2 * joint]!;
    const c = halves[2 * joint + 1]!;
    if (kind === Z) {
      const b = chain[at + 9]! * s;
      const nx = x * c + y * b;
      const nz = z * c + w * b;
      y = y * c - x * b;
      w = w * c - z * b;
      x = nx;
      z = nz;
    } else if (kind === Y) {
      const b = chain[at + 8]! * s;
      const nx = x * c - z * b;
      const ny = y * c + w * b;
      z = z * c + x * b;
      w = w * c - y * b;
      x = nx;
      y = ny;
    } else if (kind === SLIDE) {
      const px = chain[at + 7]! * q[joint]!;
      const py = chain[at + 8]! * q[joint]!;
      const pz = chain[at + 9]! * q[joint]!;
      const tx = 2 * (y * pz - z * py);
      const ty = 2 * (z * px - x * pz);
      const tz = 2 * (x * py - y * px);
      ox += px + w * tx + y * tz - z * ty;
      oy += py + w * ty + z * tx - x * tz;
      oz += pz + w * tz + x * ty - y * tx;
    } else {
      const bx = chain[at + 7]! * s;
      const by = chain[at + 8]! * s;
      const bz = chain[at + 9]! * s;
      const nx = w * bx + x * c + y * bz - z * by;
      const ny = w * by - x * bz + y * c + z * bx;
      const nz = w * bz + x * by - y * bx + z * c;
      w = w * c - x * bx - y * by - z * bz;
      x = nx;
      y = ny;
      z = nz;
    }
    if (links !== null) store(links[joint + 1]!, x, y, z, w, ox, oy, oz);
  }
  if (flange !== null) store(flange, x, y, z, w, ox, oy, oz);
}

function store(out: Pose, x: number, y: number, z: number, w: number, ox: number, oy: number, oz: number): void {
  const quaternion = out.quaternion;
  const position = out.position;
  quaternion[0] = x;
  quaternion[1] = y;
  quaternion[2] = z;
  quaternion[3] = w;
  position[0] = ox;
  position[1] = oy;
  position[2] = oz;
}

/** The axis at chain[a … a + 2], turned as its frame is, and the origin of that frame. */
function storeAxis(
  out: Float64Array,
  to: number,
  chain: Float64Array,
  a: number,
  x: number,
  y: number,
  z: number,
  w: number,
  ox: number,
  oy: number,
  oz: number,
): void {
  const ax = chain[a]!;
  const ay = chain[a + 1]!;
  const az = chain[a + 2]!;
  const tx = 2 * (y * az - z * ay);
  const ty = 2 * (z * ax - x * az);
  const tz = 2 * (x * ay - y * ax);
  out[to] = ax + w * tx + y * tz - z * ty;
  out[to + 1] = ay + w * ty + z * tx - x * tz;
  out[to + 2] = az + w * tz + x * ty - y * tx;
  out[to + 3] = ox;
  out[to + 4] = oy;
  out[to + 5] = oz;
}
