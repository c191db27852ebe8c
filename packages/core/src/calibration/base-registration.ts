import { compose, inverse, pose, transformPoint, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, rotate, toMatrix, type Matrix3, type Quaternion } from "../spatial/quaternion.ts";
import { symmetricEigen } from "../spatial/eigen.ts";
import { solveFactored, solveSymmetric } from "../spatial/symmetric.ts";
import { add, norm, subtract, type Vector3 } from "../spatial/vector.ts";
import { lengthBound95 } from "./confidence.ts";
import { hornRotation, registerPoints } from "./register.ts";
import { isFinitePoint } from "./residual.ts";

/** A point that the robot's controller knows and that was touched where it really is. */
export interface Touch {
  /** In the robot's base, from the controller. */
  readonly base: Vector3;
  /** In the world, as it was measured. */
  readonly world: Vector3;
  readonly at_s: number;
}
/** The tool where the controller says it is, and a tracked device that is fixed to it where the tracking says it is. */
export interface DrivenSample {
  readonly baseFromTool: Pose<"base", "tool">;
  readonly worldFromDevice: Pose<"world", "device">;
  readonly at_s: number;
}
/** How a tracked device errs: standard deviations along an axis, and how fast its world wanders. */
export interface TrackingNoise {
  readonly position_m: number;
  readonly rotation_rad: number;
  readonly drift_mps: number;
  /** From the device's middle to the point that touches: a turn moves it by so much more. */
  readonly tip_m: number;
}
/** A headset's controllers: 3 mm, 0.5°, 2 mm a minute, touching with a tip at 100 mm. */
export const HEADSET_NOISE: TrackingNoise = {
  position_m: 0.003,
  rotation_rad: (0.5 * Math.PI) / 180,
  drift_mps: 0.002 / 60,
  tip_m: 0.1,
};
/** A robot's own tip that is driven to points of the cell: 0.3 mm by eye, no drift. */
export const TIP_NOISE: TrackingNoise = { position_m: 0.0003, rotation_rad: 0, drift_mps: 0, tip_m: 0 };

export type BaseRegistration =
  | RegisteredBase
  | { readonly kind: "too-few"; readonly sentence: string }
  | { readonly kind: "in-line"; readonly sentence: string }
  | { readonly kind: "not-a-point"; readonly sentence: string }
  /** The measurements disagree with one another by more than their noise allows. */
  | { readonly kind: "disagree"; readonly rms_m: number; readonly sentence: string };

export interface RegisteredBase {
  readonly kind: "registered";
  readonly worldFromBase: Pose<"world", "base">;
  /**
   * Covariance, 6 × 6 row by row: turn about the base's origin in world axes [rad], then shift [m]. Already scaled by
   * what the residuals say of the noise.
   */
  readonly covariance: Float64Array;
  /** Degrees of freedom behind the scale of the covariance. */
  readonly freedom: number;
  /** Root mean square distance of measured positions from where the answer puts them. */
  readonly rms_m: number;
  /** 95 % of registrations like this one are off by less at the base's origin, when the last sample was taken. */
  readonly bound_m: number;
  readonly at_s: number;
  readonly drift_mps: number;
  readonly sentence: string;
}

const MIN_TOUCHES = 3;
const MIN_DRIVEN = 4;
/** The assumed noise counts as much as so many degrees of freedom against what the residuals show. */
const TRUST = 20;
const STEPS = 12;
/** A step this small, in metres and radians, is the last. */
const CONVERGED = 1e-11;
/** Noise so many times the assumed one is no noise any more. */
const MAX_NOISE_RATIO = 3;
/** A device must have been turned by so much between samples, about more than one axis. */
const MIN_TURN_RAD = 0.2;

/**
 * Where a robot's base stands in the world, by touched points, by a device that the robot drives round, or by both:
 *
 *   touch:  m = R b + t + e,   driven: worldFromDevice = worldFromBase · baseFromTool · toolFromDevice, with errors
 *
 * The weighted least squares of all of them (Gauss–Newton), started by Horn's closed form. The covariance is that of
 * the fit; its scale joins the assumed noise with the residuals (scaled inverse χ² prior of 20 degrees of freedom).
 *
 * @returns the pose with its covariance and 95 % bound, or why there is none
 */
export function registerBase(
  touches: readonly Touch[],
  driven: readonly DrivenSample[],
  noise: TrackingNoise = HEADSET_NOISE,
): BaseRegistration {
  const flawed = touches.findIndex(({ base, world }) => !isFinitePoint(base) || !isFinitePoint(world));
  if (flawed >= 0)
    return { kind: "not-a-point", sentence: `A coordinate of point ${flawed + 1} is not a finite number.` };
  if (touches.length < MIN_TOUCHES && driven.length < MIN_DRIVEN)
    return {
      kind: "too-few",
      sentence:
        driven.length === 0
          ? `${MIN_TOUCHES} touched points are the least; ${touches.length} were given.`
          : `${MIN_TOUCHES} touched points or ${MIN_DRIVEN} driven poses are the least; ` +
            `${touches.length} and ${driven.length} were given.`,
    };
  const start = touches.length >= MIN_TOUCHES ? registerPoints(touches.map(pairOf)) : startFromDriven(driven);
  if (start.kind === "too-few" || start.kind === "not-a-point") return { kind: start.kind, sentence: start.sentence };
  if (start.kind === "in-line") return { kind: "in-line", sentence: start.sentence };
  const first = pose<"world", "base">(start.intoFromFrame.position, start.intoFromFrame.quaternion);
  return new Fit(touches, driven, noise, first).solve();
}

const pairOf = ({ base, world }: Touch) => ({ known: base, measured: world });

type Start =
  | { readonly kind: "registered"; readonly intoFromFrame: Pose }
  | { readonly kind: "in-line"; readonly sentence: string };

/** Turns between samples, seen in the world and in the base, are the same but for the base's rotation (hand–eye). */
function startFromDriven(driven: readonly DrivenSample[]): Start {
  const H = new Float64Array(9);
  const scatter = new Float64Array(9);
  for (let i = 1; i < driven.length; i++) {
    const inBase = rotationVector(turnBetween(driven[0]!.baseFromTool, driven[i]!.baseFromTool));
    const inWorld = rotationVector(turnBetween(driven[0]!.worldFromDevice, driven[i]!.worldFromDevice));
    for (let row = 0; row < 3; row++)
      for (let column = 0; column < 3; column++) {
        H[3 * row + column]! += inBase[row]! * inWorld[column]!;
        scatter[3 * row + column]! += inBase[row]! * inBase[column]!;
      }
  }
  if (Math.sqrt(Math.max(0, symmetricEigen(scatter).values[1]!)) < MIN_TURN_RAD)
    return {
      kind: "in-line",
      sentence: "The tool was not turned enough: turn it by 30° or more about two different axes.",
    };
  const turned = hornRotation(H);
  const worldFromBase = pose<"world", "base">([0, 0, 0], turned);
  return { kind: "registered", intoFromFrame: pose(deviceOffset(driven, worldFromBase).shift, turned) };
}

const turnBetween = (a: Pose, b: Pose): Quaternion =>
  multiply(b.quaternion, [-a.quaternion[0], -a.quaternion[1], -a.quaternion[2], a.quaternion[3]]);

function rotationVector(q: Quaternion): Vector3 {
  const sign = q[3] < 0 ? -1 : 1;
  const s = Math.hypot(q[0], q[1], q[2]);
  const k = s < 1e-12 ? 2 * sign : (2 * sign * Math.atan2(s, Math.abs(q[3]))) / s;
  return [k * q[0], k * q[1], k * q[2]];
}

/** For a known rotation of the base: where on the tool the device sits, and the base's position, by least squares. */
function deviceOffset(
  driven: readonly DrivenSample[],
  worldFromBase: Pose<"world", "base">,
): { readonly offset: Vector3; readonly shift: Vector3 } {
  const A = new Float64Array(36);
  const b = new Float64Array(6);
  for (const { baseFromTool, worldFromDevice } of driven) {
    const M = toMatrix(multiply(worldFromBase.quaternion, baseFromTool.quaternion));
    const wanted = subtract(worldFromDevice.position, rotate(worldFromBase.quaternion, baseFromTool.position));
    for (let k = 0; k < 3; k++) {
      const row = [M[3 * k]!, M[3 * k + 1]!, M[3 * k + 2]!, k === 0 ? 1 : 0, k === 1 ? 1 : 0, k === 2 ? 1 : 0];
      for (let i = 0; i < 6; i++) {
        b[i]! += row[i]! * wanted[k]!;
        for (let j = 0; j <= i; j++) A[6 * i + j]! += row[i]! * row[j]!;
      }
    }
  }
  for (let i = 0; i < 6; i++) A[7 * i]! += 1e-9;
  solveSymmetric(A, b, 6);
  return { offset: [b[0]!, b[1]!, b[2]!], shift: [b[3]!, b[4]!, b[5]!] };
}

class Fit {
  readonly #touches: readonly Touch[];
  readonly #driven: readonly DrivenSample[];
  readonly #noise: TrackingNoise;
  /** Touching tip and device middle are known differently well. */
  readonly #touch_m: number;
  readonly #n: number;
  readonly #A: Float64Array;
  readonly #b: Float64Array;
  readonly #row: Float64Array;
  #worldFromBase: Pose<"world", "base">;
  #toolFromDevice: Pose<"tool", "device"> = pose<"tool", "device">([0, 0, 0], [0, 0, 0, 1]);
  #rows = 0;
  #squares = 0;

  constructor(
    touches: readonly Touch[],
    driven: readonly DrivenSample[],
    noise: TrackingNoise,
    first: Pose<"world", "base">,
  ) {
    this.#touches = touches;
    this.#driven = driven;
    this.#noise = noise;
    // A turn moves a tip across its lever alone: two of three axes.
    this.#touch_m = Math.sqrt(noise.position_m ** 2 + (2 / 3) * (noise.rotation_rad * noise.tip_m) ** 2);
    this.#n = driven.length > 0 ? 12 : 6;
    this.#A = new Float64Array(this.#n * this.#n);
    this.#b = new Float64Array(this.#n);
    this.#row = new Float64Array(this.#n);
    this.#worldFromBase = first;
    const sample = driven[0];
    if (sample) {
      const device = compose(inverse(compose(first, sample.baseFromTool)), sample.worldFromDevice);
      this.#toolFromDevice = pose<"tool", "device">(deviceOffset(driven, first).offset, device.quaternion);
    }
  }

  solve(): BaseRegistration {
    for (let step = 0; step < STEPS; step++) {
      this.#gather();
      if (!solveSymmetric(this.#A, this.#b, this.#n))
        return { kind: "in-line", sentence: "The samples do not tell how the base is turned: spread them farther." };
      this.#move();
      if (this.#b.every(value => Math.abs(value) < CONVERGED)) break;
    }
    this.#gather();
    const rms_m = this.#rms();
    const freedom = TRUST + this.#rows - this.#n;
    const scale = (TRUST + this.#squares) / freedom;
    const ratio = Math.sqrt(this.#squares / Math.max(1, this.#rows - this.#n));
    if (ratio > MAX_NOISE_RATIO)
      return {
        kind: "disagree",
        rms_m,
        sentence: `The points disagree by ${(1000 * rms_m).toFixed(1)} mm (root mean square), ${ratio.toFixed(1)} times what the tracking's noise explains. Take them again.`,
      };
    const covariance = this.#covariance(scale);
    const times = [...this.#touches, ...this.#driven].map(({ at_s }) => at_s);
    const at_s = Math.max(...times);
    // The answer belongs to the middle of the time in which the samples were taken.
    const wandered_m = (this.#noise.drift_mps * (at_s - Math.min(...times))) / 2;
    for (let i = 3; i < 6; i++) covariance[7 * i]! += (wandered_m * wandered_m) / 3;
    const registered: RegisteredBase = {
      kind: "registered",
      worldFromBase: this.#worldFromBase,
      covariance,
      freedom,
      rms_m,
      bound_m: 0,
      at_s,
      drift_mps: this.#noise.drift_mps,
      sentence: "",
    };
    const bound_m = registrationBound(registered, [0, 0, 0], at_s);
    const [bound, rms] = [bound_m, rms_m].map(value => (1000 * value).toFixed(1));
    const touched = `${this.#touches.length} touched points`;
    const from = this.#driven.length === 0 ? touched : `${touched} and ${this.#driven.length} driven poses`;
    const sentence = `The base is known to ${bound} mm (95 %), from ${from}; they are met to ${rms} mm (root mean square).`;
    return { ...registered, bound_m, sentence };
  }

  /** Writes JᵀJ and Jᵀr of the whitened errors at the present answer. */
  #gather(): void {
    this.#A.fill(0);
    this.#b.fill(0);
    this.#rows = 0;
    this.#squares = 0;
    const W = this.#worldFromBase;
    for (const { base, world } of this.#touches) {
      const arm = rotate(W.quaternion, base);
      this.#position(arm, subtract(world, add(arm, W.position)), this.#touch_m, null);
    }
    for (const { baseFromTool, worldFromDevice } of this.#driven) {
      const inBase = transformPoint(baseFromTool, this.#toolFromDevice.position);
      const arm = rotate(W.quaternion, inBase);
      const worldFromTool = toMatrix(multiply(W.quaternion, baseFromTool.quaternion));
      const off = subtract(worldFromDevice.position, add(arm, W.position));
      this.#position(arm, off, this.#noise.position_m, worldFromTool);
      const computed = compose(compose(W, baseFromTool), this.#toolFromDevice);
      this.#turn(rotationVector(turnBetween(computed, worldFromDevice)), worldFromTool);
    }
  }

  /** A position: d = turn × arm + shift (+ the tool's rotation · the device's shift). */
  #position([x, y, z]: Vector3, off: Vector3, sigma_m: number, worldFromTool: Matrix3 | null): void {
    const cross = [
      [0, z, -y],
      [-z, 0, x],
      [y, -x, 0],
    ];
    for (let k = 0; k < 3; k++) {
      this.#row.fill(0);
      for (let i = 0; i < 3; i++) this.#row[i] = cross[k]![i]!;
      this.#row[3 + k] = 1;
      if (worldFromTool) for (let i = 0; i < 3; i++) this.#row[9 + i] = worldFromTool[3 * k + i]!;
      this.#add(off[k]!, sigma_m);
    }
  }

  #turn(off: Vector3, worldFromTool: Matrix3): void {
    for (let k = 0; k < 3; k++) {
      this.#row.fill(0);
      this.#row[k] = 1;
      for (let i = 0; i < 3; i++) this.#row[6 + i] = worldFromTool[3 * k + i]!;
      this.#add(off[k]!, this.#noise.rotation_rad);
    }
  }

  #add(residual: number, sigma: number): void {
    const n = this.#n;
    const weight = 1 / (sigma * sigma);
    for (let i = 0; i < n; i++) {
      this.#b[i]! += weight * this.#row[i]! * residual;
      for (let j = 0; j <= i; j++) this.#A[n * i + j]! += weight * this.#row[i]! * this.#row[j]!;
    }
    this.#squares += weight * residual * residual;
    this.#rows++;
  }

  #move(): void {
    const by = this.#b;
    const W = this.#worldFromBase;
    this.#worldFromBase = pose<"world", "base">(
      add(W.position, [by[3]!, by[4]!, by[5]!]),
      multiply(turnOf(by, 0), W.quaternion),
    );
    if (this.#n < 12) return;
    const X = this.#toolFromDevice;
    this.#toolFromDevice = pose<"tool", "device">(
      add(X.position, [by[9]!, by[10]!, by[11]!]),
      multiply(turnOf(by, 6), X.quaternion),
    );
  }

  #covariance(scale: number): Float64Array {
    const n = this.#n;
    const out = new Float64Array(36);
    const column = new Float64Array(n);
    for (let i = 0; i < 6; i++) {
      column.fill(0);
      column[i] = scale;
      if (i === 0) solveSymmetric(this.#A, column, n);
      else solveFactored(this.#A, column, n);
      for (let j = 0; j < 6; j++) out[6 * j + i] = column[j]!;
    }
    return out;
  }

  #rms(): number {
    const W = this.#worldFromBase;
    const off = [
      ...this.#touches.map(({ base, world }) => norm(subtract(world, transformPoint(W, base)))),
      ...this.#driven.map(({ baseFromTool, worldFromDevice }) =>
        norm(
          subtract(worldFromDevice.position, transformPoint(compose(W, baseFromTool), this.#toolFromDevice.position)),
        ),
      ),
    ];
    return Math.sqrt(off.reduce((sum, d) => sum + d * d, 0) / off.length);
  }
}

function turnOf(by: Float64Array, at: number): Quaternion {
  const [x, y, z] = [by[at]!, by[at + 1]!, by[at + 2]!];
  const angle = Math.hypot(x, y, z);
  return angle < 1e-15 ? [0, 0, 0, 1] : fromAxisAngle([x / angle, y / angle, z / angle], angle);
}

/**
 * The distance that 95 % of registrations like this one stay below at a point of the robot, at a time: the covariance
 * carried to that point (a turn moves what is far from the base by more), and what the world may have wandered since.
 *
 * @param base  the point in the robot's base [m]
 * @param now_s by the clock of the samples
 */
export function registrationBound(registered: RegisteredBase, base: Vector3, now_s: number): number {
  const [x, y, z] = rotate(registered.worldFromBase.quaternion, base);
  const J = [0, z, -y, 1, 0, 0, -z, 0, x, 0, 1, 0, y, -x, 0, 0, 0, 1];
  const C = registered.covariance;
  const at = new Float64Array(9);
  for (let row = 0; row < 3; row++)
    for (let column = 0; column < 3; column++) {
      let sum = 0;
      for (let i = 0; i < 6; i++)
        for (let j = 0; j < 6; j++) sum += J[6 * row + i]! * C[6 * i + j]! * J[6 * column + j]!;
      at[3 * row + column] = sum;
    }
  const wandered_m = registered.drift_mps * Math.max(0, now_s - registered.at_s);
  return lengthBound95([...symmetricEigen(at).values], registered.freedom) + wandered_m;
}

/** What a point says that is touched again later. */
export type DriftVerdict = {
  readonly kind: "holds" | "drifted";
  /** How far the point is from where the registration puts it, and how far it may be (95 %). */
  readonly off_m: number;
  readonly allowed_m: number;
  readonly sentence: string;
};

/**
 * Whether a registration still holds, by one known point that is touched again.
 *
 * @param noise of that touch
 */
export function watchDrift(
  registered: RegisteredBase,
  touch: Touch,
  noise: TrackingNoise = HEADSET_NOISE,
): DriftVerdict {
  const off_m = norm(subtract(touch.world, transformPoint(registered.worldFromBase, touch.base)));
  const touch_m = noise.position_m ** 2 + (2 / 3) * (noise.rotation_rad * noise.tip_m) ** 2;
  const known_m = registrationBound(registered, touch.base, touch.at_s);
  const allowed_m = Math.hypot(known_m, lengthBound95([touch_m, touch_m, touch_m], Infinity));
  const [off, allowed] = [off_m, allowed_m].map(value => (1000 * value).toFixed(1));
  return off_m <= allowed_m
    ? {
        kind: "holds",
        off_m,
        allowed_m,
        sentence: `The registration holds: ${off} mm off, ${allowed} mm allowed (95 %).`,
      }
    : {
        kind: "drifted",
        off_m,
        allowed_m,
        sentence: `The registration has drifted: ${off} mm off, ${allowed} mm allowed (95 %). Register again.`,
      };
}
