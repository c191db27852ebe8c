import type { GeneralSixGeometry } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { wantedWrist, WRIST_NUMBERS } from "./wrist.ts";

/**
 * Numbers that pass between the steps of the search: kept in an array, since those handed to a function would be
 * allocated.
 */
export const THETA6 = 0;
export const CONDITION = 1;
export const THETA1 = 2;
export const THETA2 = 3;
export const THETA3 = 4;
export const MARGIN = 5;

/** Working memory of `solveGeneralSix`: one per caller. */
export interface GeneralSixScratch {
  /** Wanted wrist in the formula frame: position, then its x, y and z axis. */
  readonly wanted: Float64Array;
  readonly at: Float64Array;
  /** cos and sin of θ1 and of θ2 + θ3; axis 5 in link 5 and axis 4 in link 5 at θ4 = θ5 = 0. */
  readonly turned: Float64Array;
  /** Stretches of θ6 in which the arm reaches: start and end by turns. */
  readonly stretches: Float64Array;
  readonly samples: Float64Array;
}
export const generalSixScratch = (): GeneralSixScratch => ({
  wanted: new Float64Array(WRIST_NUMBERS),
  at: new Float64Array(6),
  turned: new Float64Array(10),
  stretches: new Float64Array(64),
  samples: new Float64Array(256),
});

/** Puts the wanted wrist into the scratch: baseFromFormula⁻¹ · baseFromFlange · wristFromFlange⁻¹. */
export function wantWrist(
  geometry: GeneralSixGeometry,
  baseFromFlange: Pose,
  { wanted, turned }: GeneralSixScratch,
): void {
  const { turn, axis4, axis5 } = geometry;
  wantedWrist(geometry, baseFromFlange, wanted);
  // turn⁻¹ · axis: 4 → at 4 … 6, 5 → at 7 … 9.
  for (let k = 0; k < 2; k++) {
    const axis = k === 0 ? axis4 : axis5;
    const tx = -turn[0];
    const ty = -turn[1];
    const tz = -turn[2];
    const tw = turn[3];
    const cx = 2 * (ty * axis[2] - tz * axis[1]);
    const cy = 2 * (tz * axis[0] - tx * axis[2]);
    const cz = 2 * (tx * axis[1] - ty * axis[0]);
    turned[4 + 3 * k] = axis[0] + tw * cx + ty * cz - tz * cy;
    turned[5 + 3 * k] = axis[1] + tw * cy + tz * cx - tx * cz;
    turned[6 + 3 * k] = axis[2] + tw * cz + tx * cy - ty * cx;
  }
}

/** Nearer than this to axis 1 the centre leaves θ1 free to choose [m]. */
const SINGULAR_RADIUS_M = 4e-10;

/**
 * The arm's posture for one θ6, and how far it misses:
 *   condition = axis4 · axis5 (both as turned) − axis4 · axis5 (as built).
 *
 *   centre = p − e R (cos θ6, −sin θ6, 0)                        where axes 4 and 5 would meet
 *   θ1, θ2, θ3 as in an ortho-parallel arm with its wrist there
 *
 * The least of the distances to the borders of the reach [m², signed] goes to MARGIN; outside it the nearest posture is
 * taken.
 *
 * @param shoulder  1 front, −1 back.
 * @param elbow     1 or −1: the sign of θ3 + atan2(centre).
 */
export function evaluate(
  geometry: GeneralSixGeometry,
  shoulder: number,
  elbow: number,
  { wanted, at, turned }: GeneralSixScratch,
): void {
  const { a1_m: a1, b_m: b, c2_m: c2, e_m: e, centre_m, axis4, axis5 } = geometry;
  const k6 = Math.cos(at[THETA6]!);
  const s6 = Math.sin(at[THETA6]!);
  const ek = e * k6;
  const es = e * s6;
  const cx = wanted[0]! - ek * wanted[3]! + es * wanted[6]!;
  const cy = wanted[1]! - ek * wanted[4]! + es * wanted[7]!;
  const cz = wanted[2]! - ek * wanted[5]! + es * wanted[8]!;
  const radius2 = cx * cx + cy * cy;
  const aside = radius2 - b * b;
  const u = aside > 0 ? Math.sqrt(aside) : 0;
  const ahead = shoulder * u;
  const onAxis = radius2 < SINGULAR_RADIUS_M * SINGULAR_RADIUS_M;
  const k1 = onAxis ? 1 : (cx * ahead + cy * b) / radius2;
  const s1 = onAxis ? 0 : (cy * ahead - cx * b) / radius2;
  const fx = centre_m[0];
  const fz = centre_m[1];
  const k2 = fx * fx + fz * fz;
  const k = Math.sqrt(k2);
  const x = ahead - a1;
  const s2 = x * x + cz * cz;
  const longest = c2 + k;
  const shortest = c2 - k;
  const reach = Math.min(longest * longest - s2, s2 - shortest * shortest);
  at[MARGIN] = b === 0 ? reach : Math.min(aside, reach);
  const cosine = (s2 - c2 * c2 - k2) / (2 * c2 * k);
  const cosPhi = cosine > 1 ? 1 : cosine < -1 ? -1 : cosine;
  const sinPhi = elbow * Math.sqrt((1 - cosPhi) * (1 + cosPhi));
  const t2 = Math.atan2(x, cz) - Math.atan2(k * sinPhi, c2 + k * cosPhi);
  const t3 = Math.atan2(sinPhi, cosPhi) - Math.atan2(fx, fz);
  const k23 = Math.cos(t2 + t3);
  const s23 = Math.sin(t2 + t3);
  // Axis 4 as turned by θ1, θ2 + θ3, and axis 5 as the wanted wrist has it.
  const vx = k23 * axis4[0] + s23 * axis4[2];
  const vy = axis4[1];
  const vz = k23 * axis4[2] - s23 * axis4[0];
  const hx = k6 * turned[7]! + s6 * turned[8]!;
  const hy = k6 * turned[8]! - s6 * turned[7]!;
  const hz = turned[9]!;
  const wx = wanted[3]! * hx + wanted[6]! * hy + wanted[9]! * hz;
  const wy = wanted[4]! * hx + wanted[7]! * hy + wanted[10]! * hz;
  const wz = wanted[5]! * hx + wanted[8]! * hy + wanted[11]! * hz;
  at[CONDITION] =
    (k1 * vx - s1 * vy) * wx +
    (s1 * vx + k1 * vy) * wy +
    vz * wz -
    (axis4[0] * axis5[0] + axis4[1] * axis5[1] + axis4[2] * axis5[2]);
  at[THETA1] = Math.atan2(s1, k1);
  at[THETA2] = t2;
  at[THETA3] = t3;
  turned[0] = k1;
  turned[1] = s1;
  turned[2] = k23;
  turned[3] = s23;
}

/**
 * The rest of the posture last evaluated, where its condition holds: θ4 about axis 4 brings axis 5 to where it is
 * wanted, and θ5 about axis 5 the rest. Writes six joint angles of the robot, in (−π, π], to `out` from `into`.
 */
export function complete(
  { axis4: u, axis5: h, signs, offsets_rad }: GeneralSixGeometry,
  { wanted, at, turned }: GeneralSixScratch,
  out: Float64Array,
  into: number,
): void {
  const k6 = Math.cos(at[THETA6]!);
  const s6 = Math.sin(at[THETA6]!);
  const cosine = u[0] * h[0] + u[1] * h[1] + u[2] * h[2];
  let t4 = 0;
  let t5 = 0;
  let k4 = 1;
  let s4 = 0;
  for (let k = 1; k >= 0; k--) {
    // First axis 5, then axis 4, from link 5 to the frame of link 3.
    const ax = turned[4 + 3 * k]!;
    const ay = turned[5 + 3 * k]!;
    const az = turned[6 + 3 * k]!;
    const bx = k6 * ax + s6 * ay;
    const by = k6 * ay - s6 * ax;
    const wx = wanted[3]! * bx + wanted[6]! * by + wanted[9]! * az;
    const wy = wanted[4]! * bx + wanted[7]! * by + wanted[10]! * az;
    const wz = wanted[5]! * bx + wanted[8]! * by + wanted[11]! * az;
    const mx = turned[0]! * wx + turned[1]! * wy;
    const gy = turned[0]! * wy - turned[1]! * wx;
    const gx = turned[2]! * mx - turned[3]! * wz;
    const gz = turned[3]! * mx + turned[2]! * wz;
    if (k === 1) {
      const sine = u[0] * (h[1] * gz - h[2] * gy) + u[1] * (h[2] * gx - h[0] * gz) + u[2] * (h[0] * gy - h[1] * gx);
      t4 = Math.atan2(sine, h[0] * gx + h[1] * gy + h[2] * gz - cosine * (u[0] * gx + u[1] * gy + u[2] * gz));
      k4 = Math.cos(t4);
      s4 = Math.sin(t4);
    } else {
      // Turned back by θ4 about axis 4 (Rodrigues), then the turn about axis 5 that leads from axis 4 there.
      const along = (u[0] * gx + u[1] * gy + u[2] * gz) * (1 - k4);
      const nx = gx * k4 - (u[1] * gz - u[2] * gy) * s4 + u[0] * along;
      const ny = gy * k4 - (u[2] * gx - u[0] * gz) * s4 + u[1] * along;
      const nz = gz * k4 - (u[0] * gy - u[1] * gx) * s4 + u[2] * along;
      const sine = h[0] * (u[1] * nz - u[2] * ny) + h[1] * (u[2] * nx - u[0] * nz) + h[2] * (u[0] * ny - u[1] * nx);
      t5 = Math.atan2(sine, u[0] * nx + u[1] * ny + u[2] * nz - cosine * (h[0] * nx + h[1] * ny + h[2] * nz));
    }
  }
  out[into] = at[THETA1]!;
  out[into + 1] = at[THETA2]!;
  out[into + 2] = at[THETA3]!;
  out[into + 3] = t4;
  out[into + 4] = t5;
  out[into + 5] = at[THETA6]!;
  for (let j = 0; j < 6; j++) {
    const angle = signs[j]! * (out[into + j]! + offsets_rad[j]!);
    const turns = Math.ceil((angle - Math.PI) / (2 * Math.PI));
    out[into + j] = angle - 2 * Math.PI * turns;
  }
}
