import { JointCountFault } from "../../fault.ts";
import type { SerialArm } from "../../model/arm.ts";
import { isSlide } from "../../model/slide.ts";
import { compose, identity, inverse, type Pose } from "../../spatial/pose.ts";
import { armScratch, chainOf, walk } from "../chain.ts";
import { flangePose } from "../forward.ts";
import { apart, fabrikBackward } from "./fabrik-points.ts";
import { flawOfPose, lengthAt, lengthOfArm, poseError } from "./pose-error.ts";

export interface FabrikOptions {
  /** Rounds of both passes; 200 unless said. */
  readonly rounds?: number;
  /** An improvement below this is none (row X-21): 1e-6 m unless said. */
  readonly insignificant_m?: number;
}

/**
 * Where FABRIK ended. `miss_m` is the distance of the flange plus that of a point beside it, before and after each
 * round.
 */
export type FabrikAnswer =
  | {
      readonly kind: "settled" | "out-of-rounds";
      readonly q_rad: Float64Array;
      readonly iterations: number;
      readonly position_m: number;
      readonly angle_rad: number;
      readonly miss_m: readonly number[];
    }
  | { readonly kind: "not-a-pose"; readonly because: string };

/** Distance of the point beside the flange that carries its turn, as a share of the arm's length. */
const BESIDE = 0.3;
/** Rounds that lead away before the best posture is kept. */
const PATIENCE = 20;
/** Points that lie on the axis do not say how far to turn [m²]. */
const UNDECIDED_M2 = 1e-12;

/**
 * FABRIK on a real arm (rows X-19 … X-22). Points are the joint origins, the flange and one point beside it.
 *
 * Backward: the last joint, the flange and the point beside it are put where the target wants them, and every joint
 * before is drawn after at its link length, as if all joints were balls. Forward, always last, so that the base stays:
 * every joint, base first, turns about its real axis and within its limits until the points beyond it are as near as
 * they get to where the backward pass put them. The two disagree wherever a hinge is no ball; the flaws of row X-22
 * come from there.
 *
 * @param q0  n start angles [rad]. Read only.
 * @throws {JointCountFault} when `q0` does not hold n angles.
 */
export function solveFabrik(
  arm: SerialArm,
  baseFromFlange: Pose<"base", "flange">,
  q0: ArrayLike<number>,
  options: FabrikOptions = {},
): FabrikAnswer {
  const n = arm.joints.length;
  if (q0.length !== n) throw new JointCountFault(arm.name, n, q0.length);
  const because =
    flawOfPose(baseFromFlange) ??
    (Array.from(q0).every(Number.isFinite) ? undefined : "A start angle is not a finite number.") ??
    (arm.joints.some(isSlide)
      ? `Joint ${arm.joints.findIndex(isSlide) + 1} of ${arm.name} slides; FABRIK keeps links at their lengths.`
      : undefined);
  if (because !== undefined) return { kind: "not-a-pose", because };
  const { rounds = 200, insignificant_m = 1e-6 } = options;
  const beside_m = BESIDE * lengthOfArm(arm);
  const q = Float64Array.from(q0, (angle, j) => clamp(angle, arm, j));
  const best = q.slice();
  const scratch = armScratch();
  const flange = identity<"base", "flange">();
  const axes = new Float64Array(6 * n);
  const present = new Float64Array(3 * (n + 2));
  const wanted = new Float64Array(3 * (n + 2));
  const lengths = new Float64Array(n + 1);
  const error = new Float64Array(6);
  const goal = new Float64Array(9);
  const beside: Pose<"flange", "beside"> = { position: [beside_m, 0, 0], quaternion: [0, 0, 0, 1] };
  goal.set(compose(baseFromFlange, inverse(arm.lastJointFromFlange)).position, 0);
  goal.set(baseFromFlange.position, 3);
  goal.set(compose(baseFromFlange, beside).position, 6);
  const look = (): number => {
    walk(chainOf(arm, q, scratch), q, flange, null, axes);
    for (let j = 0; j < n; j++) for (let axis = 0; axis < 3; axis++) present[3 * j + axis] = axes[6 * j + 3 + axis]!;
    present.set(flange.position, 3 * n);
    present.set(compose(flange, beside).position, 3 * n + 3);
    wanted.set(goal, 3 * (n - 1));
    return apartFrom(present, goal, n, 1) + apartFrom(present, goal, n + 1, 2);
  };
  const miss_m = [look()];
  for (let k = 0; k <= n; k++) lengths[k] = apart(present, k, k + 1);
  let least = miss_m[0]!;
  let since = 0;
  let kind: "settled" | "out-of-rounds" = "out-of-rounds";
  for (let round = 0; round < rounds; round++) {
    wanted.set(present.subarray(0, 3 * (n - 1)));
    fabrikBackward(wanted, lengths, n - 1);
    for (let j = 0; j < n; j++) turnTowards(arm, j, q, axes, present, wanted);
    const miss = look();
    miss_m.push(miss);
    since = miss < least ? 0 : since + 1;
    if (miss < least) {
      least = miss;
      best.set(q);
    }
    if (Math.abs(miss_m[round]! - miss) < insignificant_m || since >= PATIENCE) {
      kind = "settled";
      break;
    }
  }
  poseError(baseFromFlange, flangePose(arm, best, flange, scratch), error);
  return {
    kind,
    q_rad: best,
    iterations: miss_m.length - 1,
    position_m: lengthAt(error, 0),
    angle_rad: lengthAt(error, 3),
    miss_m,
  };
}

const clamp = (angle: number, arm: SerialArm, j: number): number =>
  Math.min(arm.joints[j]!.limits.upper_rad, Math.max(arm.joints[j]!.limits.lower_rad, angle));

const apartFrom = (points: Float64Array, goal: Float64Array, point: number, at: number): number =>
  Math.hypot(
    points[3 * point]! - goal[3 * at]!,
    points[3 * point + 1]! - goal[3 * at + 1]!,
    points[3 * point + 2]! - goal[3 * at + 2]!,
  );

/**
 * Turns joint j so that the points beyond it come nearest to where they are wanted, in the sum of squares:
 * angle = atan2( Σ (z × u)·w, Σ u·w ), u and w from the joint to each point and to its wanted place, u square to the
 * axis z.
 */
function turnTowards(
  arm: SerialArm,
  j: number,
  q: Float64Array,
  axes: Float64Array,
  present: Float64Array,
  wanted: Float64Array,
): void {
  const at = 6 * j;
  const zx = axes[at]!;
  const zy = axes[at + 1]!;
  const zz = axes[at + 2]!;
  const ox = present[3 * j]!;
  const oy = present[3 * j + 1]!;
  const oz = present[3 * j + 2]!;
  let cosine = 0;
  let sine = 0;
  for (let k = j + 1; k < present.length / 3; k++) {
    const px = present[3 * k]! - ox;
    const py = present[3 * k + 1]! - oy;
    const pz = present[3 * k + 2]! - oz;
    const along = px * zx + py * zy + pz * zz;
    const ux = px - along * zx;
    const uy = py - along * zy;
    const uz = pz - along * zz;
    const wx = wanted[3 * k]! - ox;
    const wy = wanted[3 * k + 1]! - oy;
    const wz = wanted[3 * k + 2]! - oz;
    cosine += ux * wx + uy * wy + uz * wz;
    sine += (zy * uz - zz * uy) * wx + (zz * ux - zx * uz) * wy + (zx * uy - zy * ux) * wz;
  }
  if (Math.hypot(cosine, sine) < UNDECIDED_M2) return;
  const before = q[j]!;
  q[j] = clamp(before + Math.atan2(sine, cosine), arm, j);
  turnBeyond(j, q[j]! - before, axes, present);
}

/** Turns all points and axes beyond joint j about its axis (Rodrigues). */
function turnBeyond(j: number, angle: number, axes: Float64Array, present: Float64Array): void {
  const x = axes[6 * j]!;
  const y = axes[6 * j + 1]!;
  const z = axes[6 * j + 2]!;
  const s = Math.sin(angle);
  const c = Math.cos(angle);
  const turn = (v: Float64Array, at: number, ox: number, oy: number, oz: number): void => {
    const a = v[at]! - ox;
    const b = v[at + 1]! - oy;
    const d = v[at + 2]! - oz;
    const along = (a * x + b * y + d * z) * (1 - c);
    v[at] = ox + a * c + (y * d - z * b) * s + x * along;
    v[at + 1] = oy + b * c + (z * a - x * d) * s + y * along;
    v[at + 2] = oz + d * c + (x * b - y * a) * s + z * along;
  };
  const ox = present[3 * j]!;
  const oy = present[3 * j + 1]!;
  const oz = present[3 * j + 2]!;
  for (let k = j + 1; k < present.length / 3; k++) turn(present, 3 * k, ox, oy, oz);
  for (let k = j + 1; k < axes.length / 6; k++) turn(axes, 6 * k, 0, 0, 0);
}
