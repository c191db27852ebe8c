import type { SerialArm } from "../model/arm.ts";
import { isSlide } from "../model/slide.ts";
import { compose, identity, inverse, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, rotate } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** Axes are built at right angles when they miss one by no more than this. */
const ALIGNED = 4e-16;
/**
 * Where the numbers of an elbow chain begin: turning senses, the angle added to θ2 + θ3, p1 … p6 and the flange, the
 * flange's turn.
 */
const SENSE = 0;
const BEND = 6;
const PLACE = 7;
const TURNED = 28;

/**
 * Most six-joint arms at their zero, in one row of numbers: axis 1 upright, 2, 3 and 5 level, 4 and 6 along the
 * forearm, all at right angles in the base. Forward kinematics is then one line of arithmetic without a choice in it:
 *
 *   p = p1 + Rz(θ1) ( p2 + Ry(θ2) p3 + Ry(θ2 + θ3 + bend) ( p4 + Rx(θ4) ( p5 + Ry(θ5) ( p6 + Rx(θ6) pf ))))
 *
 * An upright forearm is laid along x by `bend`.
 *
 * @returns null for an arm that is built otherwise.
 */
export function elbowChainOf(arm: SerialArm): Float64Array | null {
  if (arm.joints.length !== 6 || arm.joints.some(isSlide)) return null;
  const row = new Float64Array(32);
  const axes: Vector3[] = [];
  const places: Vector3[] = [];
  let running: Pose = identity();
  for (const { parentFromJoint, axis } of arm.joints) {
    running = compose(running, parentFromJoint as Pose);
    axes.push(rotate(running.quaternion, axis));
    places.push([...running.position]);
  }
  running = compose(running, arm.lastJointFromFlange as Pose);
  places.push([...running.position]);
  const forearm = Math.abs(axes[3]![0]) > 0.5 ? 0 : 2;
  const wanted = [2, 1, 1, forearm, 1, forearm];
  for (const [j, axis] of axes.entries()) {
    const sense = Math.sign(axis[wanted[j]!]!);
    const off = axis.map((value, k) => Math.abs(value - (k === wanted[j] ? sense : 0)));
    if (Math.max(...off) > ALIGNED) return null;
    row[SENSE + j] = sense;
  }
  // Ry(−90°) takes x to z: an arm with an upright forearm is one with a level forearm, bent.
  const bent = fromAxisAngle([0, 1, 0], forearm === 0 ? 0 : -Math.PI / 2);
  const back = inverse({ position: [0, 0, 0], quaternion: bent }).quaternion;
  row[BEND] = forearm === 0 ? 0 : -Math.PI / 2;
  places.forEach((place, j) => {
    const before = places[j - 1] ?? [0, 0, 0];
    const step: Vector3 = [place[0] - before[0], place[1] - before[1], place[2] - before[2]];
    row.set(j < 3 ? step : rotate(back, step), PLACE + 3 * j);
  });
  row.set(multiply(back, running.quaternion), TURNED);
  return row;
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

/**
 * The flange of an elbow chain.
 *
 * @param trig  receives sine and cosine of the six half angles: twelve numbers of working memory.
 */
export function elbowFlange(
  row: Float64Array,
  q: ArrayLike<number>,
  out: Pose<"base", "flange">,
  trig: Float64Array,
): void {
  const t2 = row[1]! * q[1]!;
  for (let i = 0; i < 6; i++) {
    // Half turns are taken off the half angle, and a fourth of the turn goes through the polynomials: no branch to
    // mispredict.
    const own = row[i]! * q[i]!;
    const angle = i === 2 ? t2 + own + row[BEND]! : own;
    const n = Math.floor(angle * TURNS_PER_RAD + 0.5);
    const r = 0.25 * (angle - n * TURN_HIGH - n * TURN_LOW);
    const r2 = r * r;
    const r4 = r2 * r2;
    const sr = r + r * r2 * (S1 + r2 * S2 + r4 * (S3 + r2 * S4 + r4 * (S5 + r2 * S6)));
    const cr = 1 - 0.5 * r2 + r4 * (C1 + r2 * C2 + r4 * (C3 + r2 * C4 + r4 * (C5 + r2 * C6)));
    const sign = 1 - 2 * (n & 1);
    trig[2 * i] = sign * 2 * sr * cr;
    trig[2 * i + 1] = sign * (1 - 2 * sr * sr);
  }
  const s1 = trig[0]!;
  const c1 = trig[1]!;
  const s2 = trig[2]!;
  const c2 = trig[3]!;
  const s3 = trig[4]!;
  const c3 = trig[5]!;
  const s4 = trig[6]!;
  const c4 = trig[7]!;
  const s5 = trig[8]!;
  const c5 = trig[9]!;
  const s6 = trig[10]!;
  const c6 = trig[11]!;

  // From the flange inwards; each turn is one of a plane, by the whole angle: sin = 2 s c, cos = 1 − 2 s².
  const sin6 = 2 * s6 * c6;
  const cos6 = 1 - 2 * s6 * s6;
  const fx = row[25]!;
  const fy = row[26]!;
  const fz = row[27]!;
  const ax = row[22]! + fx;
  const ay = row[23]! + cos6 * fy - sin6 * fz;
  const az = row[24]! + sin6 * fy + cos6 * fz;
  const sin5 = 2 * s5 * c5;
  const cos5 = 1 - 2 * s5 * s5;
  const bx = row[19]! + cos5 * ax + sin5 * az;
  const by = row[20]! + ay;
  const bz = row[21]! + cos5 * az - sin5 * ax;
  const sin4 = 2 * s4 * c4;
  const cos4 = 1 - 2 * s4 * s4;
  const dx = row[16]! + bx;
  const dy = row[17]! + cos4 * by - sin4 * bz;
  const dz = row[18]! + sin4 * by + cos4 * bz;
  const sin3 = 2 * s3 * c3;
  const cos3 = 1 - 2 * s3 * s3;
  const sin2 = 2 * s2 * c2;
  const cos2 = 1 - 2 * s2 * s2;
  const ux = row[13]!;
  const uz = row[15]!;
  const ex = row[10]! + cos2 * ux + sin2 * uz + cos3 * dx + sin3 * dz;
  const ey = row[11]! + row[14]! + dy;
  const ez = row[12]! + cos2 * uz - sin2 * ux + cos3 * dz - sin3 * dx;
  const sin1 = 2 * s1 * c1;
  const cos1 = 1 - 2 * s1 * s1;
  const position = out.position;
  position[0] = row[7]! + cos1 * ex - sin1 * ey;
  position[1] = row[8]! + sin1 * ex + cos1 * ey;
  position[2] = row[9]! + ez;

  // Rz Ry, then Rx, Ry, Rx, then the flange's own turn.
  const x1 = -s1 * s3;
  const y1 = c1 * s3;
  const z1 = s1 * c3;
  const w1 = c1 * c3;
  const x2 = x1 * c4 + w1 * s4;
  const y2 = y1 * c4 + z1 * s4;
  const z2 = z1 * c4 - y1 * s4;
  const w2 = w1 * c4 - x1 * s4;
  const x3 = x2 * c5 - z2 * s5;
  const y3 = y2 * c5 + w2 * s5;
  const z3 = z2 * c5 + x2 * s5;
  const w3 = w2 * c5 - y2 * s5;
  const x4 = x3 * c6 + w3 * s6;
  const y4 = y3 * c6 + z3 * s6;
  const z4 = z3 * c6 - y3 * s6;
  const w4 = w3 * c6 - x3 * s6;
  const gx = row[28]!;
  const gy = row[29]!;
  const gz = row[30]!;
  const gw = row[31]!;
  const quaternion = out.quaternion;
  quaternion[0] = w4 * gx + x4 * gw + y4 * gz - z4 * gy;
  quaternion[1] = w4 * gy - x4 * gz + y4 * gw + z4 * gx;
  quaternion[2] = w4 * gz + x4 * gy - y4 * gx + z4 * gw;
  quaternion[3] = w4 * gw - x4 * gx - y4 * gy - z4 * gz;
}
