import type { Pose } from "../spatial/pose.ts";

/** Where the formula of a closed form stands in the arm, and its wrist on the flange. */
export interface FormulaFrames {
  readonly baseFromFormula: Pose;
  readonly wristFromFlange: Pose;
}

/** Numbers of a wanted wrist: its position, then its x, y and z axis. */
export const WRIST_NUMBERS = 12;

/**
 * The wanted wrist in the frame of the formula: baseFromFormula⁻¹ · baseFromFlange · wristFromFlange⁻¹.
 *
 * @param out  receives twelve numbers: position [m], x axis, y axis, z axis. Allocates nothing.
 */
export function wantedWrist(
  { baseFromFormula, wristFromFlange }: FormulaFrames,
  baseFromFlange: Pose,
  out: Float64Array,
): void {
  const q = baseFromFlange.quaternion;
  const f = wristFromFlange.quaternion;
  const g = baseFromFormula.quaternion;
  const fx = -f[0];
  const fy = -f[1];
  const fz = -f[2];
  const fw = f[3];
  const hx = q[3] * fx + q[0] * fw + q[1] * fz - q[2] * fy;
  const hy = q[3] * fy - q[0] * fz + q[1] * fw + q[2] * fx;
  const hz = q[3] * fz + q[0] * fy - q[1] * fx + q[2] * fw;
  const hw = q[3] * fw - q[0] * fx - q[1] * fy - q[2] * fz;
  const gx = -g[0];
  const gy = -g[1];
  const gz = -g[2];
  const gw = g[3];
  const x = gw * hx + gx * hw + gy * hz - gz * hy;
  const y = gw * hy - gx * hz + gy * hw + gz * hx;
  const z = gw * hz + gx * hy - gy * hx + gz * hw;
  const w = gw * hw - gx * hx - gy * hy - gz * hz;
  out[3] = 1 - 2 * (y * y + z * z);
  out[6] = 2 * (x * y - z * w);
  out[9] = 2 * (x * z + y * w);
  out[4] = 2 * (x * y + z * w);
  out[7] = 1 - 2 * (x * x + z * z);
  out[10] = 2 * (y * z - x * w);
  out[5] = 2 * (x * z - y * w);
  out[8] = 2 * (y * z + x * w);
  out[11] = 1 - 2 * (x * x + y * y);
  const o = baseFromFormula.position;
  const p = baseFromFlange.position;
  const s = wristFromFlange.position;
  const ax = p[0] - o[0];
  const ay = p[1] - o[1];
  const az = p[2] - o[2];
  const bx = 2 * (gy * az - gz * ay);
  const by = 2 * (gz * ax - gx * az);
  const bz = 2 * (gx * ay - gy * ax);
  out[0] = ax + gw * bx + gy * bz - gz * by - out[3]! * s[0] - out[6]! * s[1] - out[9]! * s[2];
  out[1] = ay + gw * by + gz * bx - gx * bz - out[4]! * s[0] - out[7]! * s[1] - out[10]! * s[2];
  out[2] = az + gw * bz + gx * by - gy * bx - out[5]! * s[0] - out[8]! * s[1] - out[11]! * s[2];
}

/** Signs and zeros of a formula's angles in the robot's own: robot angle = sign · (formula angle + offset). */
export interface FormulaZeros {
  readonly signs: readonly number[];
  readonly offsets_rad: readonly number[];
}

/** The formula angle [rad] of a joint that is free to choose: the one of `near`, or of 0; `joint` counts from 0. */
export const freeAngle = (
  { signs, offsets_rad }: FormulaZeros,
  near: ArrayLike<number> | undefined,
  joint: number,
): number => signs[joint]! * (near === undefined ? 0 : near[joint]!) - offsets_rad[joint]!;

const TURN = 2 * Math.PI;
const TURNS_PER_RAD = 1 / TURN;

/**
 * Turns the angles of a formula into the robot's own, in place: sign · (θ + offset), in (−π, π].
 *
 * @param count  numbers in `out` that are angles: solutions one behind the other, as many joints each as there are
 *   signs.
 */
export function formulaToJoints(
  out: Float64Array,
  count: number,
  signs: readonly number[],
  offsets_rad: readonly number[],
): void {
  const joints = signs.length;
  for (let joint = 0; joint < joints; joint++) {
    const sign = signs[joint]!;
    const offset = offsets_rad[joint]!;
    for (let i = joint; i < count; i += joints) {
      let angle = sign * (out[i]! + offset);
      // Whole turns without asking whether there are any: half of the branches of an arm have them, half have not.
      angle -= TURN * Math.floor((angle + Math.PI) * TURNS_PER_RAD);
      if (angle <= -Math.PI) angle += TURN;
      else if (angle > Math.PI) angle -= TURN;
      out[i] = angle;
    }
  }
}
