import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  angleBetween,
  compose,
  degrees,
  fromAxisAngle,
  fromMatrix,
  fromEulerAngles,
  fromUnity,
  fromUnityAngles,
  fromPaperXyz,
  fromKukaAbc,
  identity,
  normalizeQuaternion,
  pose,
  seededRandom,
  toMatrix,
  toOtherHand,
  toEulerAngles,
  transformPoint,
  type FlippedAxis,
  type Matrix3,
  type Quaternion,
  type EulerSequence,
  type Vector3,
} from "../index.ts";

const AXES = ["x", "y", "z"] as const;
const UNIT: Readonly<Record<FlippedAxis, Vector3>> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const random = seededRandom(73);
const anyTurn = (): Quaternion => normalizeQuaternion([random() - 0.5, random() - 0.5, random() - 0.5, random() - 0.5]);
const times = (a: Matrix3, b: Matrix3): Matrix3 =>
  a.map((_, n) =>
    [0, 1, 2].reduce((sum, k) => sum + a[3 * Math.trunc(n / 3) + k]! * b[3 * k + (n % 3)]!, 0),
  ) as Matrix3;
const determinant = ([a, b, c, d, e, f, g, h, i]: Matrix3): number =>
  a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
const largestGap = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (value, i) => Math.abs(value - b[i]!)));
const diagonal = (flipped: FlippedAxis): Matrix3 => {
  const [x, y, z] = AXES.map(axis => (axis === flipped ? -1 : 1)) as Vector3;
  return [x, 0, 0, 0, y, 0, 0, 0, z];
};

describe.each(AXES)("L-22 left and right hand, %s flipped", flipped => {
  const S = diagonal(flipped);
  test("the mapping mirrors: det S = −1; orientations go by S R Sᵀ and stay rotations", () => {
    expect(determinant(S)).toBe(-1);
    for (let n = 0; n < 100; n++) {
      const seen = pose([random(), random(), random()], anyTurn());
      const other = toOtherHand(flipped, seen);
      const R = times(times(S, toMatrix(seen.quaternion)), S);
      expect(largestGap(toMatrix(other.quaternion), R)).toBeLessThan(1e-14);
      expect(determinant(toMatrix(other.quaternion))).toBeCloseTo(1, 12);
      expect(other.position).toEqual(seen.position.map((value, i) => value * S[4 * i]!));
    }
  });
  test("a chain of poses mapped is the chain of the mapped poses, and mapping twice changes nothing", () => {
    for (let n = 0; n < 50; n++) {
      const a = pose([random(), random(), random()], anyTurn());
      const b = pose([random(), random(), random()], anyTurn());
      const p: Vector3 = [random(), random(), random()];
      const whole = toOtherHand(flipped, compose(a, b));
      const parts = compose(toOtherHand(flipped, a), toOtherHand(flipped, b));
      expect(
        largestGap(whole.position, parts.position) + angleBetween(whole.quaternion, parts.quaternion),
      ).toBeLessThan(1e-12);
      expect(toOtherHand(flipped, toOtherHand(flipped, a))).toEqual(a);
      const mirrored = (v: Vector3): Vector3 => v.map((value, i) => value * S[4 * i]!) as Vector3;
      expect(
        largestGap(transformPoint(toOtherHand(flipped, a), mirrored(p)), mirrored(transformPoint(a, p))),
      ).toBeLessThan(1e-12);
    }
  });
});

test("L-73 sign table: +10° about each axis of the left-handed frame, seen in the right-handed one", () => {
  const seen = (map: (q: Quaternion) => Quaternion): number[][] =>
    AXES.map(axis => {
      const q = map(fromAxisAngle(UNIT[axis], Math.PI / 18));
      const angle_deg = degrees(2 * Math.atan2(Math.hypot(q[0], q[1], q[2]), q[3]));
      return [0, 1, 2].map(i => Math.round((q[i]! / Math.hypot(q[0], q[1], q[2])) * angle_deg * 1e9) / 1e9 + 0);
    });
  const flipping =
    (flipped: FlippedAxis) =>
    (q: Quaternion): Quaternion =>
      toOtherHand(flipped, pose([0, 0, 0], q)).quaternion;
  // Rows: about x, y, z of the left-handed frame. Columns: x, y, z of the right-handed one [deg].
  expect(seen(flipping("x"))).toEqual([
    [10, 0, 0],
    [0, -10, 0],
    [0, 0, -10],
  ]);
  expect(seen(flipping("y"))).toEqual([
    [-10, 0, 0],
    [0, 10, 0],
    [0, 0, -10],
  ]);
  expect(seen(flipping("z"))).toEqual([
    [-10, 0, 0],
    [0, -10, 0],
    [0, 0, 10],
  ]);
  // N-22's mapping, where Unity's up axis y becomes z and its z becomes −y.
  expect(seen(q => fromUnity(pose([0, 0, 0], q), identity()).quaternion)).toEqual([
    [10, 0, 0],
    [0, 0, -10],
    [0, 10, 0],
  ]);
});

test("L-23 the nine entries of Rot(y, B) Rot(x, A) Rot(z, C)", () => {
  for (let n = 0; n < 200; n++) {
    const [A, B, C] = [0, 0, 0].map(() => 2 * Math.PI * (random() - 0.5)) as Vector3;
    const [sA, cA, sB, cB, sC, cC] = [Math.sin(A), Math.cos(A), Math.sin(B), Math.cos(B), Math.sin(C), Math.cos(C)];
    const entries = [
      cB * cC + sB * sA * sC,
      -cB * sC + sB * sA * cC,
      sB * cA,
      cA * sC,
      cA * cC,
      -sA,
      -sB * cC + cB * sA * sC,
      sB * sC + cB * sA * cC,
      cB * cA,
    ];
    expect(largestGap(toMatrix(fromEulerAngles("yxz", B, A, C)), entries)).toBeLessThan(1e-14);
    expect(largestGap(toMatrix(fromUnityAngles(degrees(A), degrees(B), degrees(C))), entries)).toBeLessThan(1e-14);
  }
});

/** Witness: SciPy's intrinsic sequences. */
const golden = JSON.parse(
  readFileSync(new URL("../../../../fixtures/conventions/sequences.json", import.meta.url), "utf8"),
) as { cases: { sequence: EulerSequence; turns_rad: Vector3; matrix: Matrix3 }[] };

test("L-24 all twelve sequences agree with SciPy, there and back", () => {
  expect(new Set(golden.cases.map(({ sequence }) => sequence)).size).toBe(12);
  for (const { sequence, turns_rad, matrix } of golden.cases) {
    expect(largestGap(toMatrix(fromEulerAngles(sequence, ...turns_rad)), matrix)).toBeLessThan(1e-14);
    expect(largestGap(toEulerAngles(sequence, fromMatrix(matrix)), turns_rad)).toBeLessThan(1e-7);
  }
});

test("N-12 the paper's a_x, a_y, a_z agree with SciPy's z-y-x and are KUKA's C, B, A", () => {
  for (const {
    sequence,
    turns_rad: [z, y, x],
    matrix,
  } of golden.cases) {
    if (sequence !== "zyx") continue;
    expect(largestGap(toMatrix(fromPaperXyz(degrees(x), degrees(y), degrees(z))), matrix)).toBeLessThan(1e-14);
    expect(largestGap(fromPaperXyz(10, 20, 30), fromKukaAbc(30, 20, 10))).toBe(0);
  }
});
