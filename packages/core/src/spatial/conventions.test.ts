import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  angleBetween,
  degrees,
  fromAbbQuaternion,
  fromFanucWpr,
  fromKukaAbc,
  fromMatrix,
  fromPaperXyz,
  fromEulerAngles,
  fromUnity,
  fromUnityAngles,
  fromUrVector,
  fromVal3,
  fromVplusYpr,
  fromYaskawaRxyz,
  identity,
  multiply,
  normalizeQuaternion,
  pose,
  seededRandom,
  toAbbQuaternion,
  toFanucWpr,
  toKukaAbc,
  toMatrix,
  toEulerAngles,
  toUnity,
  toUrVector,
  toVal3,
  toVplusYpr,
  toYaskawaRxyz,
  type Matrix3,
  type Quaternion,
  type EulerSequence,
  type Vector3,
} from "../index.ts";

interface Case {
  matrix: number[][];
  singular: boolean;
  abb_q1234: [number, number, number, number];
  ur_rotvec_rad: Vector3;
  kuka_ABC_deg: Vector3;
  fanuc_WPR_yaskawa_RxRyRz_deg: Vector3;
  vplus_ypr_deg: Vector3;
  val3_rxryrz_deg: Vector3;
}
const golden = JSON.parse(
  readFileSync(new URL("../../../../fixtures/conventions/orientations.json", import.meta.url), "utf8"),
) as { cases: Case[] };
const rotationOf = ({ matrix }: Case): Quaternion => fromMatrix(matrix.slice(0, 3).flatMap(row => row.slice(0, 3)));
/** Angles are printed to nine digits. */
const PRINTED_RAD = 2e-9;

const formats: readonly {
  name: string;
  printed: (c: Case) => Vector3;
  from: (a: number, b: number, c: number) => Quaternion;
  to: (q: Quaternion) => Vector3;
}[] = [
  { name: "KUKA A, B, C", printed: c => c.kuka_ABC_deg, from: fromKukaAbc, to: toKukaAbc },
  { name: "FANUC W, P, R", printed: c => c.fanuc_WPR_yaskawa_RxRyRz_deg, from: fromFanucWpr, to: toFanucWpr },
  {
    name: "Yaskawa Rx, Ry, Rz",
    printed: c => c.fanuc_WPR_yaskawa_RxRyRz_deg,
    from: fromYaskawaRxyz,
    to: toYaskawaRxyz,
  },
  { name: "V+ yaw, pitch, roll", printed: c => c.vplus_ypr_deg, from: fromVplusYpr, to: toVplusYpr },
  { name: "VAL 3 rx, ry, rz", printed: c => c.val3_rxryrz_deg, from: fromVal3, to: toVal3 },
  { name: "UR rotation vector", printed: c => c.ur_rotvec_rad, from: fromUrVector, to: toUrVector },
];

describe("47 poses printed in every vendor's format", () => {
  for (const { name, printed, from, to } of formats) {
    test(name, () => {
      expect(golden.cases.length).toBe(47);
      for (const c of golden.cases) {
        const q = rotationOf(c);
        const [a, b, d] = printed(c);
        expect(angleBetween(from(a, b, d), q)).toBeLessThan(PRINTED_RAD);
        expect(angleBetween(from(...to(q)), q)).toBeLessThan(1e-9);
        if (!c.singular)
          to(q).forEach((value, i) => {
            expect(value).toBeCloseTo(printed(c)[i]!, 7);
          });
      }
    });
  }
  test("ABB q1 … q4", () => {
    for (const c of golden.cases) {
      expect(angleBetween(fromAbbQuaternion(...c.abb_q1234), rotationOf(c))).toBeLessThan(PRINTED_RAD);
      const printed = toAbbQuaternion(rotationOf(c));
      expect(printed[0]).toBeGreaterThanOrEqual(0);
      if (!c.singular)
        printed.forEach((value, i) => {
          expect(value).toBeCloseTo(c.abb_q1234[i]!, 8);
        });
    }
  });
});

const elementary: Readonly<Record<string, (a: number) => Matrix3>> = {
  x: a => [1, 0, 0, 0, Math.cos(a), -Math.sin(a), 0, Math.sin(a), Math.cos(a)],
  y: a => [Math.cos(a), 0, Math.sin(a), 0, 1, 0, -Math.sin(a), 0, Math.cos(a)],
  z: a => [Math.cos(a), -Math.sin(a), 0, Math.sin(a), Math.cos(a), 0, 0, 0, 1],
};
const times = (a: Matrix3, b: Matrix3): Matrix3 =>
  a.map((_, n) =>
    [0, 1, 2].reduce((sum, k) => sum + a[3 * Math.trunc(n / 3) + k]! * b[3 * k + (n % 3)]!, 0),
  ) as Matrix3;
const largestGap = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (value, i) => Math.abs(value - b[i]!)));

test("L-24 all twelve sequences are the product of their three matrices, and come back, also at the borders", () => {
  const random = seededRandom(24);
  const any = (): number => (random() - 0.5) * 4 * Math.PI;
  for (const sequence of [
    "xyz",
    "xzy",
    "yxz",
    "yzx",
    "zxy",
    "zyx",
    "xyx",
    "xzx",
    "yxy",
    "yzy",
    "zxz",
    "zyz",
  ] as const satisfies readonly EulerSequence[]) {
    for (let n = 0; n < 300; n++) {
      const b = n < 200 ? any() : [0, Math.PI / 2, -Math.PI / 2, Math.PI, 1e-8, Math.PI / 2 - 1e-8][n % 6]!;
      const a = any();
      const c = any();
      const q = fromEulerAngles(sequence, a, b, c);
      const product = times(
        times(elementary[sequence[0]!]!(a), elementary[sequence[1]!]!(b)),
        elementary[sequence[2]!]!(c),
      );
      expect(largestGap(toMatrix(q), product)).toBeLessThan(1e-14);
      const back = toEulerAngles(sequence, q);
      expect(back.every(Number.isFinite)).toBe(true);
      expect(angleBetween(fromEulerAngles(sequence, ...back), q)).toBeLessThan(3e-9);
      if (n < 200) expect(angleBetween(fromEulerAngles(sequence, ...back), q)).toBeLessThan(1e-12);
    }
  }
});

test("N-12 the paper's orientation is Rz · Ry · Rx", () => {
  const [x, y, z] = [12, -34, 56];
  const rad = (angle: number): number => (angle * Math.PI) / 180;
  const product = times(times(elementary["z"]!(rad(z)), elementary["y"]!(rad(y))), elementary["x"]!(rad(x)));
  expect(largestGap(toMatrix(fromPaperXyz(x, y, z)), product)).toBeLessThan(1e-15);
});

test("N-22, G-12 Unity (1, 2, 3) is (−1, −3, 2) to the robot, and back", () => {
  expect(fromUnity(pose([1, 2, 3]), identity()).position).toEqual([-1, -3, 2]);
  expect(toUnity(pose([-1, -3, 2]), identity()).position).toEqual([1, 2, 3]);
});

test("N-20 the mapping has determinant −1; orientations map by S R Sᵀ and stay rotations", () => {
  const S = [-1, 0, 0, 0, 0, -1, 0, 1, 0] as Matrix3;
  expect(
    S[0] * (S[4] * S[8] - S[5] * S[7]) - S[1] * (S[3] * S[8] - S[5] * S[6]) + S[2] * (S[3] * S[7] - S[4] * S[6]),
  ).toBe(-1);
  const transposed: Matrix3 = [S[0], S[3], S[6], S[1], S[4], S[7], S[2], S[5], S[8]];
  const random = seededRandom(20);
  for (let n = 0; n < 100; n++) {
    const q: Quaternion = normalizeQuaternion([random() - 0.5, random() - 0.5, random() - 0.5, random() - 0.5]);
    const mapped = fromUnity(pose([0, 0, 0], q), identity()).quaternion;
    expect(largestGap(toMatrix(mapped), times(times(S, toMatrix(q)), transposed))).toBeLessThan(1e-14);
    expect(largestGap(toUnity(pose([0, 0, 0], mapped), identity()).quaternion, q)).toBe(0);
  }
});

test("L-23, N-20 a turn Unity calls positive about its own up axis is clockwise from above to the robot", () => {
  const up = fromUnity(pose([0, 0, 0], fromUnityAngles(0, 10, 0)), identity()).quaternion;
  expect(degrees(toEulerAngles("zyx", up)[0])).toBeCloseTo(-10, 12);
  expect(
    largestGap(
      fromUnityAngles(10, 20, 30),
      multiply(
        multiply(fromEulerAngles("yxz", Math.PI / 9, 0, 0), fromEulerAngles("xyz", Math.PI / 18, 0, 0)),
        fromEulerAngles("zyx", Math.PI / 6, 0, 0),
      ),
    ),
  ).toBeLessThan(1e-15);
});
