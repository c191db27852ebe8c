import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import {
  allBranches,
  angleBetween,
  compose,
  distance,
  flangePose,
  fromAxisAngle,
  fromMatrix,
  pose,
  robotById,
  seededRandom,
  toMatrix,
  wrapAngle,
  type Pose,
  type Vector3,
} from "../index.ts";

/**
 * The glove-teaching paper prints its D-H rules and no lengths. These stand in for them: a KUKA KR 6/2, the arm of
 * those years whose joint ranges hold the paper's own program, with its D-H table in Craig's (modified) form.
 */
const L = { a2: 0.26, a3: 0.68, a4: -0.035, d12: 0.675, d4: 0.67, d6: 0.115 } as const;
const TABLE: readonly { readonly alpha_deg: number; readonly a: number; readonly d: number }[] = [
  { alpha_deg: 0, a: 0, d: L.d12 },
  { alpha_deg: -90, a: L.a2, d: 0 },
  { alpha_deg: 0, a: L.a3, d: 0 },
  { alpha_deg: -90, a: L.a4, d: L.d4 },
  { alpha_deg: 90, a: 0, d: 0 },
  { alpha_deg: -90, a: 0, d: L.d6 },
];
const robot = robotById("kuka_kr6_2")!;
/** KUKA's A1 … A6 to the paper's θ, and the flange turned half round about z. */
const thetaOf = (A: ArrayLike<number>): number[] => [-A[0]!, A[1]!, A[2]! - Math.PI / 2, -A[3]!, A[4]!, -A[5]!];
const halfTurn = pose<"paper", "flange">([0, 0, 0], fromAxisAngle([0, 0, 1], Math.PI));
const random = seededRandom(43);
const anyTheta = (): number[] => Array.from({ length: 6 }, () => 2 * Math.PI * (random() - 0.5));
const SAMPLES = 400;

/** T = Π Rot(x, α) Trans(x, a) Rot(z, θ) Trans(z, d) of the first `links` rows. */
function product(theta: readonly number[], links = 6): Pose {
  let T: Pose = pose();
  TABLE.slice(0, links).forEach(({ alpha_deg, a, d }, i) => {
    T = compose(T, pose([a, 0, 0], fromAxisAngle([1, 0, 0], (alpha_deg * Math.PI) / 180)));
    T = compose(T, pose([0, 0, d], fromAxisAngle([0, 0, 1], theta[i]!)));
  });
  return T;
}
const sines = (theta: readonly number[]): { s: number[]; c: number[]; s23: number; c23: number } => ({
  s: theta.map(Math.sin),
  c: theta.map(Math.cos),
  s23: Math.sin(theta[1]! + theta[2]!),
  c23: Math.cos(theta[1]! + theta[2]!),
});
/** Wrist centre: the pose moved back by d6 along its z. */
const wristOf = (T: Pose): Vector3 => compose(T, pose([0, 0, -L.d6])).position;

test("M-42 the three entries the paper prints (r11, r21, Pz) are those of the D-H product", () => {
  for (let n = 0; n < SAMPLES; n++) {
    const theta = anyTheta();
    const T = product(theta);
    const R = toMatrix(T.quaternion);
    const { s, c, s23, c23 } = sines(theta);
    const [s1, , , s4, s5, s6] = s as [number, number, number, number, number, number];
    const [c1, , , c4, c5, c6] = c as [number, number, number, number, number, number];
    const along = c23 * (c4 * c5 * c6 - s4 * s6) - s23 * s5 * c6;
    const across = s4 * c5 * c6 + c4 * s6;
    expect(R[0]).toBeCloseTo(c1 * along + s1 * across, 12);
    expect(R[3]).toBeCloseTo(s1 * along - c1 * across, 12);
    expect(T.position[2]).toBeCloseTo(
      L.d12 - L.a3 * s[1]! - L.a4 * s23 - L.d4 * c23 + L.d6 * (s23 * c4 * s5 - c23 * c5),
      12,
    );
  }
});

test("M-42 forward kinematics of the library's KR 6/2 is that product, and both are the reference's", () => {
  const { samples } = JSON.parse(
    readFileSync(new URL("../../../../fixtures/kinematics/kuka_kr6_2.forward.json", import.meta.url), "utf8"),
  ) as { samples: { q: number[]; T: number[][] }[] };
  expect(samples.length).toBe(200);
  for (const { q, T } of samples) {
    const paper = compose(product(thetaOf(q)), halfTurn);
    const ours = flangePose(robot.arm, q);
    const reference = pose(
      [T[0]![3]!, T[1]![3]!, T[2]![3]!],
      fromMatrix(T.slice(0, 3).flatMap(row => row.slice(0, 3))),
    );
    for (const got of [paper, ours]) {
      expect(distance(got.position, reference.position)).toBeLessThan(1e-9);
      expect(angleBetween(got.quaternion, reference.quaternion)).toBeLessThan(1e-8);
    }
  }
});

/**
 * What of Eq 10 is put right: sign of the angle φ = atan2(d4, a4), the root's constant, and the cross term of a2 in B.
 */
interface Corrections {
  readonly phi: boolean;
  readonly root: boolean;
  readonly cross: boolean;
}
const ALL: Corrections = { phi: true, root: true, cross: true };

/**
 * Eq 10: θ3 = −atan2(d4, a4) + atan2(±√(4 a3² (a4² + d4²) − B²), B),
 *   B = (C1 Pxw + S1 Pyw − a2)² + (d1 + d2 − Pzw)² − a3² − a4² − d4².
 */
function theta3(wrist: Vector3, theta1: number, sign: 1 | -1, { phi, root, cross }: Corrections): number {
  const ahead = Math.cos(theta1) * wrist[0] + Math.sin(theta1) * wrist[1];
  const up = L.d12 - wrist[2];
  const B = (cross ? (ahead - L.a2) ** 2 : ahead ** 2 + L.a2 ** 2) + up ** 2 - L.a3 ** 2 - L.a4 ** 2 - L.d4 ** 2;
  const inside = root
    ? 4 * L.a3 ** 2 * (L.a4 ** 2 + L.d4 ** 2) - B * B
    : 4 * L.a3 ** 2 * (L.a3 ** 2 + L.d4 ** 2) - B * B;
  return (phi ? -1 : 1) * Math.atan2(L.d4, L.a4) + Math.atan2(sign * Math.sqrt(inside), B);
}

/** All eight solutions, position first, wrist after (Eqs 8 … 13). */
function inversePaper(T: Pose): number[][] {
  const wrist = wristOf(T);
  const solutions: number[][] = [];
  for (const turn of [0, Math.PI]) {
    const t1 = Math.atan2(wrist[1], wrist[0]) + turn;
    for (const sign of [1, -1] as const) {
      const t3 = theta3(wrist, t1, sign, ALL);
      const ahead = Math.cos(t1) * wrist[0] + Math.sin(t1) * wrist[1] - L.a2;
      const down = L.d12 - wrist[2];
      if (Number.isNaN(t3)) continue;
      const t2 =
        Math.atan2(down, ahead) -
        Math.atan2(L.a4 * Math.sin(t3) + L.d4 * Math.cos(t3), L.a3 + L.a4 * Math.cos(t3) - L.d4 * Math.sin(t3));
      const [x, y, z, w] = product([t1, t2, t3], 3).quaternion;
      const M = toMatrix(compose(pose([0, 0, 0], [-x, -y, -z, w]), pose([0, 0, 0], T.quaternion)).quaternion);
      const t4 = Math.atan2(M[8], -M[2]);
      const t5 = Math.atan2(Math.hypot(M[2], M[8]), M[5]);
      const t6 = Math.atan2(-M[4], M[3]);
      solutions.push([t1, t2, t3, t4, t5, t6], [t1, t2, t3, t4 + Math.PI, -t5, t6 + Math.PI]);
    }
  }
  return solutions;
}
const nearestOf = (solutions: readonly (readonly number[])[], theta: readonly number[]): number =>
  Math.min(
    ...solutions.map(solution => Math.max(...solution.map((angle, j) => Math.abs(wrapAngle(angle - theta[j]!))))),
  );

test("M-43, E-14 Eq 10 as corrected finds θ3 in 400 of 400 poses; as printed in none, and in none with any one of the three corrections left out", () => {
  const found = (corrections: Corrections): number => {
    let hits = 0;
    for (let n = 0; n < SAMPLES; n++) {
      const theta = anyTheta();
      const wrist = wristOf(product(theta));
      if (
        ([1, -1] as const).some(
          sign => Math.abs(wrapAngle(theta3(wrist, theta[0]!, sign, corrections) - theta[2]!)) < 1e-7,
        )
      )
        hits++;
    }
    return hits;
  };
  expect(found(ALL)).toBe(SAMPLES);
  expect(found({ phi: false, root: false, cross: false })).toBe(0);
  for (const missing of ["phi", "root", "cross"] as const) expect(found({ ...ALL, [missing]: false })).toBe(0);
});

test("M-43 position and wrist split: every solution returns to its pose, the posture it came from among them, θ1, θ4 and θ6 with their ±180° second branches", () => {
  for (let n = 0; n < SAMPLES; n++) {
    const theta = anyTheta();
    const T = product(theta);
    const solutions = inversePaper(T);
    expect(nearestOf(solutions, theta)).toBeLessThan(1e-6);
    for (const solution of solutions) {
      const back = product(solution);
      expect(distance(back.position, T.position)).toBeLessThan(1e-9);
      expect(angleBetween(back.quaternion, T.quaternion)).toBeLessThan(1e-8);
    }
  }
});

test("M-43 the library's closed form finds the same solutions and no others", () => {
  for (let n = 0; n < 200; n++) {
    const A = anyTheta();
    const baseFromFlange = flangePose(robot.arm, A);
    const ours = allBranches(robot, baseFromFlange);
    const paper = inversePaper(product(thetaOf(A)));
    expect(ours.length).toBe(paper.length);
    for (const solution of ours) expect(nearestOf(paper, thetaOf(solution))).toBeLessThan(1e-6);
  }
});
