import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import {
  angleBetween,
  compose,
  degrees,
  distance,
  explainReach,
  flangePose,
  fromMatrix,
  fromVplusYpr,
  inverse,
  pose,
  radians,
  rotate,
  robotById,
  seededRandom,
  solveAll,
  toMatrix,
  type Matrix3,
  type Pose,
  type Robot,
  type Vector3,
} from "../index.ts";

interface Paper {
  joint_limits_deg: [number, number][];
  range_deg: number[];
  dh_modified: { a: number | "a3"; alpha_deg: number; d: number | "d4" }[];
  lengths_m: Record<"a3" | "d4" | "flange" | "shoulder_height", number>;
  home_deg: number[];
  home_printed_deg: number[];
  ppoints: { q_deg: number[]; wrist_mm: Vector3; rotation: number[][]; vplus_ypr_deg: Vector3 }[];
  step: { wrist_mm: number; turn_deg: number };
}
const paper = JSON.parse(
  readFileSync(new URL("../../../../fixtures/kinematics/staubli_rx90l.paper.json", import.meta.url), "utf8"),
) as Paper;
const robot = robotById("staubli_rx90l")!;
const flangeFromWrist = pose<"flange", "wrist">([0, 0, -0.085]);
/** The wrist in the frame the paper and V+ count from. */
const wristOf = (q_rad: ArrayLike<number>): Pose<"vendor-world", "wrist"> =>
  compose(compose(inverse(robot.baseFromVendorWorld), flangePose(robot.arm, q_rad)), flangeFromWrist);
const rad = (q_deg: readonly number[]): Float64Array => Float64Array.from(q_deg, radians);
const random = seededRandom(1703);
const anyAngles = (): Float64Array =>
  Float64Array.from(
    robot.arm.joints,
    ({ limits }) => limits.lower_rad + (limits.upper_rad - limits.lower_rad) * random(),
  );
const largestGap = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (value, i) => Math.abs(value - b[i]!)));

test("G-03 the two #PPOINT lines are one vertical move of −80.003 mm at 45°, turned by 0.025°", () => {
  const [from, to] = paper.ppoints.map(({ q_deg }) => wristOf(rad(q_deg))) as [Pose, Pose];
  for (const [i, got] of [from, to].entries()) {
    const { wrist_mm, rotation, vplus_ypr_deg } = paper.ppoints[i]!;
    got.position.forEach((value, axis) => {
      expect(Math.abs(value * 1000 - wrist_mm[axis]!)).toBeLessThan(1e-3);
    });
    expect(angleBetween(got.quaternion, fromMatrix(rotation.flat()))).toBeLessThan(1e-8);
    expect(angleBetween(got.quaternion, fromVplusYpr(...vplus_ypr_deg))).toBeLessThan(1e-7);
    const tilt_deg = degrees(Math.acos(-rotate(got.quaternion, [0, 0, 1])[2]));
    expect(Math.abs(tilt_deg - [45.02, 44.99][i]!)).toBeLessThan(0.005);
  }
  expect((to.position[2] - from.position[2]) * 1000).toBeCloseTo(-80.003, 3);
  expect(Math.hypot(to.position[0] - from.position[0], to.position[1] - from.position[1]) * 1000).toBeLessThan(0.01);
  expect(distance(from.position, to.position) * 1000).toBeCloseTo(paper.step.wrist_mm, 4);
  expect(degrees(angleBetween(from.quaternion, to.quaternion))).toBeCloseTo(0.025, 3);
});

test("G-04, N-07, E-01 home stands straight up with the wrist at 1.1 m; the printed −90 is outside its own limits", () => {
  const home = wristOf(robot.home_rad);
  expect(largestGap(home.position, [0, 0, 1.1])).toBeLessThan(1e-12);
  expect(largestGap(toMatrix(home.quaternion), [1, 0, 0, 0, 1, 0, 0, 0, 1])).toBeLessThan(1e-12);
  expect(largestGap(robot.home_rad, rad(paper.home_deg))).toBeLessThan(1e-12);
  expect(wristOf(rad(paper.home_printed_deg)).position[2]).toBeCloseTo(-0.2, 12);
  expect(paper.home_printed_deg[2]!).toBeLessThan(paper.joint_limits_deg[2]![0]);
});

test("G-05 θ3 of home follows from sin θ3 = (1.21 − 0.625) / 0.585 = 1", () => {
  const { a3, d4 } = paper.lengths_m;
  const sine = (1.1 ** 2 - (a3 ** 2 + d4 ** 2)) / (2 * a3 * d4);
  expect(sine).toBeCloseTo(1, 12);
  expect(robot.home_rad[2]).toBeCloseTo(Math.PI / 2, 12);
});

test("N-06, N-09 joint ranges and robot data are the printed ones", () => {
  robot.arm.joints.forEach(({ limits }, j) => {
    expect(degrees(limits.lower_rad)).toBeCloseTo(paper.joint_limits_deg[j]![0], 9);
    expect(degrees(limits.upper_rad)).toBeCloseTo(paper.joint_limits_deg[j]![1], 9);
    expect(degrees(limits.upper_rad - limits.lower_rad)).toBeCloseTo(paper.range_deg[j]!, 9);
  });
  expect([robot.payload_kg, robot.payloadMax_kg, robot.maxTcpSpeed_mps, robot.repeatability_m]).toEqual([
    3.5, 6, 12.6, 25e-6,
  ]);
});

test("N-08 the D-H table gives the same wrist", () => {
  for (let n = 0; n < 100; n++) {
    const q = anyAngles();
    let product: Pose = pose();
    paper.dh_modified.forEach(({ a, alpha_deg, d }, i) => {
      const s = Math.sin(radians(alpha_deg) / 2);
      const c = Math.cos(radians(alpha_deg) / 2);
      product = compose(product, pose([a === "a3" ? paper.lengths_m.a3 : a, 0, 0], [s, 0, 0, c]));
      product = compose(
        product,
        pose([0, 0, d === "d4" ? paper.lengths_m.d4 : d], [0, 0, Math.sin(q[i]! / 2), Math.cos(q[i]! / 2)]),
      );
    });
    const wrist = wristOf(q);
    expect(distance(product.position, wrist.position)).toBeLessThan(1e-12);
    expect(angleBetween(product.quaternion, wrist.quaternion)).toBeLessThan(1e-12);
  }
});

/** The closed entries of ⁰T₆; `printed` puts the four misprints back. */
function closedForm(q: ArrayLike<number>, printed: boolean): { rotation: Matrix3; position: Vector3 } {
  const [s1, s2, s4, s5, s6] = [0, 1, 3, 4, 5].map(i => Math.sin(q[i]!)) as [number, number, number, number, number];
  const [c1, c2, c4, c5, c6] = [0, 1, 3, 4, 5].map(i => Math.cos(q[i]!)) as [number, number, number, number, number];
  const s23 = Math.sin(q[1]! + q[2]!);
  const c23 = Math.cos(q[1]! + q[2]!);
  const { a3, d4 } = paper.lengths_m;
  const r31 = -s23 * (c4 * c5 * c6 - s4 * s6) - c23 * s5 * c6;
  return {
    position: [c1 * (a3 * c2 + d4 * s23), s1 * (a3 * c2 + d4 * s23), -a3 * s2 + d4 * c23],
    rotation: [
      c1 * (c23 * (c4 * c5 * c6 - s4 * s6) - s23 * s5 * (printed ? s6 : c6)) - s1 * (c4 * s6 + s4 * c5 * c6), // E-02
      c1 * (c23 * (-c4 * c5 * s6 - s4 * (printed ? s6 : c6)) + s23 * s5 * s6) + s1 * (s4 * c5 * s6 - c4 * c6), // E-03
      c1 * (c23 * c4 * s5 + s23 * c5) - s1 * s4 * s5,
      s1 * (c23 * (c4 * c5 * c6 - s4 * s6) - s23 * s5 * c6) + c1 * (c4 * s6 + s4 * c5 * c6),
      s1 * (c23 * (-c4 * c5 * s6 - s4 * c6) + s23 * s5 * s6) + c1 * (c4 * c6 - s4 * c5 * s6),
      printed ? r31 : s1 * (c23 * c4 * s5 + s23 * c5) + c1 * s4 * s5, // E-04
      r31,
      s23 * (c4 * c5 * s6 + s4 * c6) + (printed ? -c23 * s5 * c6 : c23 * s5 * s6), // E-05
      -s23 * c4 * s5 + c23 * c5,
    ],
  };
}

test("N-10, E-02 … E-05 forward kinematics equals the closed entries as corrected, and exactly four of the printed ones are wrong", () => {
  const worst = new Array<number>(9).fill(0);
  for (let n = 0; n < 200; n++) {
    const q = anyAngles();
    const wrist = wristOf(q);
    const R = toMatrix(wrist.quaternion);
    const right = closedForm(q, false);
    const printed = closedForm(q, true);
    expect(largestGap(wrist.position, right.position)).toBeLessThan(1e-12);
    expect(largestGap(R, right.rotation)).toBeLessThan(1e-12);
    printed.rotation.forEach((value, i) => {
      worst[i] = Math.max(worst[i]!, Math.abs(value - R[i]!));
    });
  }
  expect(worst.map(gap => gap > 0.5)).toEqual([true, true, false, false, false, true, false, true, false]);
});

test("N-14, E-06 of the paper's four values of θ3 two reach the wrist; all of ours reach the pose", () => {
  const { a3, d4 } = paper.lengths_m;
  for (let n = 0; n < 200; n++) {
    const q = anyAngles();
    const { position } = wristOf(q);
    const radius2 = position[0] ** 2 + position[1] ** 2 + position[2] ** 2;
    const first = Math.asin((radius2 - a3 * a3 - d4 * d4) / (2 * a3 * d4));
    const reached = [first, -first, Math.PI + first, Math.PI - first].map(
      theta3 => Math.abs(a3 * a3 + d4 * d4 + 2 * a3 * d4 * Math.sin(theta3) - radius2) < 1e-9,
    );
    expect(reached).toEqual([true, false, false, true]);
    const baseFromFlange = flangePose(robot.arm, q);
    const reach = solveAll(robot, baseFromFlange, { near: q });
    if (reach.kind !== "reached") throw new Error(explainReach(reach));
    expect(largestGap(reach.solutions[0]!.q_rad, q)).toBeLessThan(1e-8);
    for (const { q_rad } of reach.solutions) {
      const back = flangePose(robot.arm, q_rad);
      expect(distance(back.position, baseFromFlange.position)).toBeLessThan(1e-9);
      expect(angleBetween(back.quaternion, baseFromFlange.quaternion)).toBeLessThan(1e-9);
    }
  }
});

test("N-13, N-67 joints belong to the wrist: a longer flange changes nothing for the same wrist, a longer tool does for the same tip", () => {
  const q = rad([25, -50, 70, 30, 55, -80]);
  const baseFromFlange = flangePose(robot.arm, q);
  const family = robot.family;
  if (family.kind !== "ortho-parallel") throw new Error("The RX90L is of the ortho-parallel family.");
  const longer: Robot = {
    ...robot,
    arm: { ...robot.arm, lastJointFromFlange: pose([0, 0, 0.285]) },
    family: { ...family, c4_m: 0.285 },
  };
  const sameWrist = solveAll(longer, compose(baseFromFlange, pose<"flange", "flange">([0, 0, 0.2])), { near: q });
  if (sameWrist.kind !== "reached") throw new Error(explainReach(sameWrist));
  expect(largestGap(sameWrist.solutions[0]!.q_rad, q)).toBeLessThan(1e-9);

  const short = pose<"flange", "tcp">([0, 0, 0.1]);
  const long = pose<"flange", "tcp">([0, 0, 0.15]);
  const baseFromTcp = compose(baseFromFlange, short);
  const withLong = solveAll(robot, compose(baseFromTcp, inverse(long)), { near: q });
  if (withLong.kind !== "reached") throw new Error(explainReach(withLong));
  const other = withLong.solutions[0]!.q_rad;
  expect(largestGap(other, q)).toBeGreaterThan(0.01);
  expect(distance(compose(flangePose(robot.arm, other), long).position, baseFromTcp.position)).toBeLessThan(1e-9);
});
