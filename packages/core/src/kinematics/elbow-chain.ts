import type { SerialArm } from "../robots/arm.ts";
import { isSlide } from "../robots/slide.ts";
import { compose, identity, inverse, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, rotate } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** Axes are built at right angles when they miss one by no more than this. */
const ALIGNED = 4e-16;
/** Where the numbers of an elbow chain begin: turning senses, the angle added to θ2 + θ3, p1 … p6 and the flange, the flange's turn. */
const SENSE = 0, BEND = 6, PLACE = 7, TURNED = 28;

/**
 * Most six-joint arms at their zero, in one row of numbers: axis 1 upright, 2, 3 and 5 level, 4 and 6 along the forearm, all
 * at right angles in the base. Forward kinematics is then one line of arithmetic without a choice in it:
 *
 *   p = p1 + Rz(θ1) ( p2 + Ry(θ2) p3 + Ry(θ2 + θ3 + bend) ( p4 + Rx(θ4) ( p5 + Ry(θ5) ( p6 + Rx(θ6) pf ))))
 *
 * An upright forearm is laid along x by `bend`.
 *
 * @returns null for an arm that is built otherwise.
 */
export function elbowChainOf(arm: SerialArm): Float64Array | null {
  if (arm.joints.length !== 6 || arm.joints.some(isSlide)) return null;
  const row = new Float64Array(32), axes: Vector3[] = [], places: Vector3[] = [];
  let running: Pose = identity();
  for (const { parentFromJoint, axis } of arm.joints) {
    running = compose(running, parentFromJoint as Pose);
    axes.push(rotate(running.quaternion, axis));
    places.push([...running.position]);
  }
  running = compose(running, arm.lastJointFromFlange as Pose);
  places.push([...running.position]);
  const forearm = Math.abs(axes[3]![0]) > 0.5 ? 0 : 2, wanted = [2, 1, 1, forearm, 1, forearm];
  for (const [j, axis] of axes.entries()) {
    const sense = Math.sign(axis[wanted[j]!]!), off = axis.map((value, k) => Math.abs(value - (k === wanted[j] ? sense : 0)));
    if (Math.max(...off) > ALIGNED) return null;
    row[SENSE + j] = sense;
  }
  // Ry(−90°) takes x to z: an arm with an upright forearm is one with a level forearm, bent.
  const bent = fromAxisAngle([0, 1, 0], forearm === 0 ? 0 : -Math.PI / 2), back = inverse({ position: [0, 0, 0], quaternion: bent }).quaternion;
  row[BEND] = forearm === 0 ? 0 : -Math.PI / 2;
  places.forEach((place, j) => {
    const before = places[j - 1] ?? [0, 0, 0], step: Vector3 = [place[0] - before[0], place[1] - before[1], place[2] - before[2]];
    row.set(j < 3 ? step : rotate(back, step), PLACE + 3 * j);
  });
  row.set(multiply(back, running.quaternion), TURNED);
  return row;
}

const TURNS_PER_RAD = 1 / (2 * Math.PI);
/** 2π in two parts: whole multiples of the first are exact. */
const TURN_HIGH = 4 * 1.57079632673412561417, TURN_LOW = 4 * 6.07710050650619224932e-11;
/** Sine and cosine up to π/4 (fdlibm, kernels k_sin and k_cos). */
const S1 = -1.66666666666666324348e-1, S2 = 8.33333333332248946124e-3, S3 = -1.98412698298579493134e-4, S4 = 2.75573137070700676789e-6, S5 = -2.50507602534068634195e-8, S6 = 1.58969099521155010221e-10;
const C1 = 4.16666666666666019037e-2, C2 = -1.38888888888741095749e-3, C3 = 2.48015872894767294178e-5, C4 = -2.75573143513906633035e-7, C5 = 2.08757232129817482790e-9, C6 = -1.13596475577881948265e-11;

/**
 * The flange of an elbow chain.
 *
 * @param trig  receives sine and cosine of the six half angles: twelve numbers of working memory.
 */
export function elbowFlange(row: Float64Array, q: ArrayLike<number>, out: Pose<"base", "flange">, trig: Float64Array): void {
  const t2 = row[1]! * q[1]!;
  for (let i = 0; i < 6; i++) {
    // Half turns are taken off the half angle, and a fourth of the turn goes through the polynomials: no branch to mispredict.
    const own = row[i]! * q[i]!, angle = i === 2 ? t2 + own + row[BEND]! : own;
    const n = Math.floor(angle * TURNS_PER_RAD + 0.5), r = 0.25 * (angle - n * TURN_HIGH - n * TURN_LOW), r2 = r * r, r4 = r2 * r2;
    const sr = r + r * r2 * (S1 + r2 * S2 + r4 * (S3 + r2 * S4 + r4 * (S5 + r2 * S6)));
    const cr = 1 - 0.5 * r2 + r4 * (C1 + r2 * C2 + r4 * (C3 + r2 * C4 + r4 * (C5 + r2 * C6)));
    const sign = 1 - 2 * (n & 1);
    trig[2 * i] = sign * 2 * sr * cr; trig[2 * i + 1] = sign * (1 - 2 * sr * sr);
  }
  const s1 = trig[0]!, c1 = trig[1]!, s2 = trig[2]!, c2 = trig[3]!, s3 = trig[4]!, c3 = trig[5]!, s4 = trig[6]!, c4 = trig[7]!, s5 = trig[8]!, c5 = trig[9]!, s6 = trig[10]!, c6 = trig[11]!;

  // From the flange inwards; each turn is one of a plane, by the whole angle: sin = 2 s c, cos = 1 − 2 s².
  const sin6 = 2 * s6 * c6, cos6 = 1 - 2 * s6 * s6, fx = row[25]!, fy = row[26]!, fz = row[27]!;
  const ax = row[22]! + fx, ay = row[23]! + cos6 * fy - sin6 * fz, az = row[24]! + sin6 * fy + cos6 * fz;
  const sin5 = 2 * s5 * c5, cos5 = 1 - 2 * s5 * s5;
  const bx = row[19]! + cos5 * ax + sin5 * az, by = row[20]! + ay, bz = row[21]! + cos5 * az - sin5 * ax;
  const sin4 = 2 * s4 * c4, cos4 = 1 - 2 * s4 * s4;
  const dx = row[16]! + bx, dy = row[17]! + cos4 * by - sin4 * bz, dz = row[18]! + sin4 * by + cos4 * bz;
  const sin3 = 2 * s3 * c3, cos3 = 1 - 2 * s3 * s3, sin2 = 2 * s2 * c2, cos2 = 1 - 2 * s2 * s2, ux = row[13]!, uz = row[15]!;
  const ex = row[10]! + cos2 * ux + sin2 * uz + cos3 * dx + sin3 * dz, ey = row[11]! + row[14]! + dy, ez = row[12]! + cos2 * uz - sin2 * ux + cos3 * dz - sin3 * dx;
  const sin1 = 2 * s1 * c1, cos1 = 1 - 2 * s1 * s1, position = out.position;
  position[0] = row[7]! + cos1 * ex - sin1 * ey; position[1] = row[8]! + sin1 * ex + cos1 * ey; position[2] = row[9]! + ez;

  // Rz Ry, then Rx, Ry, Rx, then the flange's own turn.
  const x1 = -s1 * s3, y1 = c1 * s3, z1 = s1 * c3, w1 = c1 * c3;
  const x2 = x1 * c4 + w1 * s4, y2 = y1 * c4 + z1 * s4, z2 = z1 * c4 - y1 * s4, w2 = w1 * c4 - x1 * s4;
  const x3 = x2 * c5 - z2 * s5, y3 = y2 * c5 + w2 * s5, z3 = z2 * c5 + x2 * s5, w3 = w2 * c5 - y2 * s5;
  const x4 = x3 * c6 + w3 * s6, y4 = y3 * c6 + z3 * s6, z4 = z3 * c6 - y3 * s6, w4 = w3 * c6 - x3 * s6;
  const gx = row[28]!, gy = row[29]!, gz = row[30]!, gw = row[31]!, quaternion = out.quaternion;
  quaternion[0] = w4 * gx + x4 * gw + y4 * gz - z4 * gy; quaternion[1] = w4 * gy - x4 * gz + y4 * gw + z4 * gx;
  quaternion[2] = w4 * gz + x4 * gy - y4 * gx + z4 * gw; quaternion[3] = w4 * gw - x4 * gx - y4 * gy - z4 * gz;
}
