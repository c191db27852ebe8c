import { armScratch, chainOf, walk, type ArmScratch } from "../kinematics/chain.ts";
import { identity, type Pose } from "../spatial/pose.ts";
import { BODY, type DynamicsModel } from "./model.ts";

/** Working memory of the algorithms of this folder: one per caller, made for its model. */
export interface DynamicsScratch {
  readonly arm: ArmScratch;
  readonly links: readonly Pose<"base", "link">[];
  /** Motion axes of the joints as six numbers each: z and o × z. */
  readonly axes: Float64Array;
  /** Bodies seen from the base: mass, first moment, inertia about the base's origin. */
  readonly placed: Float64Array;
  /** Six numbers per joint. */
  readonly speeds: Float64Array;
  readonly accelerations: Float64Array;
  readonly forces: Float64Array;
  readonly steps: Float64Array;
  /** Articulated inertias, 36 numbers per joint. */
  readonly articulated: Float64Array;
  readonly loads: Float64Array;
  readonly divisors: Float64Array;
  readonly rest: Float64Array;
  /** Two spatial vectors on the way. */
  readonly one: Float64Array;
  readonly two: Float64Array;
}

export function dynamicsScratch(model: DynamicsModel): DynamicsScratch {
  const n = model.robot.arm.joints.length;
  const six = (): Float64Array => new Float64Array(6 * n);
  return {
    arm: armScratch(),
    links: Array.from({ length: n + 1 }, () => identity<"base", "link">()),
    axes: six(),
    placed: new Float64Array(BODY * n),
    speeds: six(),
    accelerations: six(),
    forces: six(),
    steps: six(),
    articulated: new Float64Array(36 * n),
    loads: six(),
    divisors: new Float64Array(n),
    rest: new Float64Array(n),
    one: new Float64Array(6),
    two: new Float64Array(6),
  };
}

/**
 * Places axes and bodies in the base, where they simply add up: no transform between links is left in the recursions.
 *
 *   S_i = ( z_i ; o_i × z_i ),  ( 0 ; z_i ) of a slide,   h = m p + R h_l,   I_o = R I_l Rᵀ + m-terms of the shift p
 */
export function placeBodies(
  model: DynamicsModel,
  q: ArrayLike<number>,
  { arm, links, axes, placed }: DynamicsScratch,
): void {
  const n = model.robot.arm.joints.length;
  const { bodies } = model;
  walk(chainOf(model.robot.arm, q, arm), q, null, links, axes);
  for (let i = 0; i < n; i++) {
    const a = 6 * i;
    const zx = axes[a]!;
    const zy = axes[a + 1]!;
    const zz = axes[a + 2]!;
    const ox = axes[a + 3]!;
    const oy = axes[a + 4]!;
    const oz = axes[a + 5]!;
    axes[a + 3] = oy * zz - oz * zy;
    axes[a + 4] = oz * zx - ox * zz;
    axes[a + 5] = ox * zy - oy * zx;
    if (model.slides[i] === 1) {
      axes[a] = 0;
      axes[a + 1] = 0;
      axes[a + 2] = 0;
      axes[a + 3] = zx;
      axes[a + 4] = zy;
      axes[a + 5] = zz;
    }

    const b = BODY * i;
    const { position, quaternion } = links[i + 1]!;
    const px = position[0];
    const py = position[1];
    const pz = position[2];
    const x = quaternion[0];
    const y = quaternion[1];
    const z = quaternion[2];
    const w = quaternion[3];
    const r00 = 1 - 2 * (y * y + z * z);
    const r01 = 2 * (x * y - w * z);
    const r02 = 2 * (x * z + w * y);
    const r10 = 2 * (x * y + w * z);
    const r11 = 1 - 2 * (x * x + z * z);
    const r12 = 2 * (y * z - w * x);
    const r20 = 2 * (x * z - w * y);
    const r21 = 2 * (y * z + w * x);
    const r22 = 1 - 2 * (x * x + y * y);
    const m = bodies[b]!;
    const lx = bodies[b + 1]!;
    const ly = bodies[b + 2]!;
    const lz = bodies[b + 3]!;
    const jx = r00 * lx + r01 * ly + r02 * lz;
    const jy = r10 * lx + r11 * ly + r12 * lz;
    const jz = r20 * lx + r21 * ly + r22 * lz;
    const xx = bodies[b + 4]!;
    const yy = bodies[b + 5]!;
    const zz_ = bodies[b + 6]!;
    const xy = bodies[b + 7]!;
    const xz = bodies[b + 8]!;
    const yz = bodies[b + 9]!;
    const a0 = r00 * xx + r01 * xy + r02 * xz;
    const a1 = r00 * xy + r01 * yy + r02 * yz;
    const a2 = r00 * xz + r01 * yz + r02 * zz_;
    const b0 = r10 * xx + r11 * xy + r12 * xz;
    const b1 = r10 * xy + r11 * yy + r12 * yz;
    const b2 = r10 * xz + r11 * yz + r12 * zz_;
    const c0 = r20 * xx + r21 * xy + r22 * xz;
    const c1 = r20 * xy + r21 * yy + r22 * yz;
    const c2 = r20 * xz + r21 * yz + r22 * zz_;
    // Moving the reference by p:
    //   I_o += 2 (j·p) 1 − (j pᵀ + p jᵀ) + m (p·p 1 − p pᵀ),  with j the first moment about the link's origin.
    const jp = 2 * (jx * px + jy * py + jz * pz);
    const pp = m * (px * px + py * py + pz * pz);
    placed[b] = m;
    placed[b + 1] = jx + m * px;
    placed[b + 2] = jy + m * py;
    placed[b + 3] = jz + m * pz;
    placed[b + 4] = a0 * r00 + a1 * r01 + a2 * r02 + jp - 2 * jx * px + pp - m * px * px;
    placed[b + 5] = b0 * r10 + b1 * r11 + b2 * r12 + jp - 2 * jy * py + pp - m * py * py;
    placed[b + 6] = c0 * r20 + c1 * r21 + c2 * r22 + jp - 2 * jz * pz + pp - m * pz * pz;
    placed[b + 7] = a0 * r10 + a1 * r11 + a2 * r12 - jx * py - px * jy - m * px * py;
    placed[b + 8] = a0 * r20 + a1 * r21 + a2 * r22 - jx * pz - px * jz - m * px * pz;
    placed[b + 9] = b0 * r20 + b1 * r21 + b2 * r22 - jy * pz - py * jz - m * py * pz;
  }
}

/**
 * Momentum of a body that moves with the spatial speed v = (ω ; speed of what passes the base's origin):
 *
 *   ( I_o ω + h × v_o ;  m v_o + ω × h )
 */
export function momentum(
  placed: Float64Array,
  body: number,
  v: Float64Array,
  at: number,
  out: Float64Array,
  to: number,
): void {
  const b = BODY * body;
  const m = placed[b]!;
  const hx = placed[b + 1]!;
  const hy = placed[b + 2]!;
  const hz = placed[b + 3]!;
  const xx = placed[b + 4]!;
  const yy = placed[b + 5]!;
  const zz = placed[b + 6]!;
  const xy = placed[b + 7]!;
  const xz = placed[b + 8]!;
  const yz = placed[b + 9]!;
  const wx = v[at]!;
  const wy = v[at + 1]!;
  const wz = v[at + 2]!;
  const vx = v[at + 3]!;
  const vy = v[at + 4]!;
  const vz = v[at + 5]!;
  out[to] = xx * wx + xy * wy + xz * wz + hy * vz - hz * vy;
  out[to + 1] = xy * wx + yy * wy + yz * wz + hz * vx - hx * vz;
  out[to + 2] = xz * wx + yz * wy + zz * wz + hx * vy - hy * vx;
  out[to + 3] = m * vx + wy * hz - wz * hy;
  out[to + 4] = m * vy + wz * hx - wx * hz;
  out[to + 5] = m * vz + wx * hy - wy * hx;
}

/** out += v × s, both motions: ( ω × s_ω ; ω × s_v + v_o × s_ω ), s taken `by` times. */
export function addCrossMotion(
  v: Float64Array,
  s: Float64Array,
  at: number,
  by: number,
  out: Float64Array,
  to: number,
): void {
  const wx = v[at]!;
  const wy = v[at + 1]!;
  const wz = v[at + 2]!;
  const vx = v[at + 3]!;
  const vy = v[at + 4]!;
  const vz = v[at + 5]!;
  const ax = s[at]! * by;
  const ay = s[at + 1]! * by;
  const az = s[at + 2]! * by;
  const bx = s[at + 3]! * by;
  const by_ = s[at + 4]! * by;
  const bz = s[at + 5]! * by;
  out[to]! += wy * az - wz * ay;
  out[to + 1]! += wz * ax - wx * az;
  out[to + 2]! += wx * ay - wy * ax;
  out[to + 3]! += wy * bz - wz * by_ + vy * az - vz * ay;
  out[to + 4]! += wz * bx - wx * bz + vz * ax - vx * az;
  out[to + 5]! += wx * by_ - wy * bx + vx * ay - vy * ax;
}

/** out += v × f, a motion on a momentum: ( ω × f_ω + v_o × f_v ; ω × f_v ). */
export function addCrossForce(v: Float64Array, at: number, f: Float64Array, out: Float64Array, to: number): void {
  const wx = v[at]!;
  const wy = v[at + 1]!;
  const wz = v[at + 2]!;
  const vx = v[at + 3]!;
  const vy = v[at + 4]!;
  const vz = v[at + 5]!;
  out[to]! += wy * f[2]! - wz * f[1]! + vy * f[5]! - vz * f[4]!;
  out[to + 1]! += wz * f[0]! - wx * f[2]! + vz * f[3]! - vx * f[5]!;
  out[to + 2]! += wx * f[1]! - wy * f[0]! + vx * f[4]! - vy * f[3]!;
  out[to + 3]! += wy * f[5]! - wz * f[4]!;
  out[to + 4]! += wz * f[3]! - wx * f[5]!;
  out[to + 5]! += wx * f[4]! - wy * f[3]!;
}

/** Σ a_k b_k over six numbers. */
export const dot6 = (a: Float64Array, at: number, b: Float64Array, bt: number): number =>
  a[at]! * b[bt]! +
  a[at + 1]! * b[bt + 1]! +
  a[at + 2]! * b[bt + 2]! +
  a[at + 3]! * b[bt + 3]! +
  a[at + 4]! * b[bt + 4]! +
  a[at + 5]! * b[bt + 5]!;
