import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { flangePose } from "../kinematics/forward.ts";
import { seededRandom } from "../random.ts";
import { compose, pose, type Pose } from "../spatial/pose.ts";
import { angleBetween, fromAxisAngle, fromMatrix, normalizeQuaternion } from "../spatial/quaternion.ts";
import { degrees } from "../spatial/units.ts";
import { distance, normalize } from "../spatial/vector.ts";
import type { Joint, SerialArm } from "../model/arm.ts";
import { armFromDh, dhFromArm, type DhConvention, type DhTable } from "./dh.ts";
import { LIBRARY, robotById } from "./library/index.ts";

const CONVENTIONS: readonly DhConvention[] = ["standard", "modified"];

function worstGap(a: SerialArm, b: SerialArm, seed: number): number {
  const random = seededRandom(seed);
  const q = new Float64Array(a.joints.length);
  let worst = 0;
  for (let n = 0; n < 100; n++) {
    for (let j = 0; j < q.length; j++) q[j] = 2 * Math.PI * (random() - 0.5);
    const one = flangePose(a, q);
    const other = flangePose(b, q);
    worst = Math.max(worst, distance(one.position, other.position), angleBetween(one.quaternion, other.quaternion));
  }
  return worst;
}

describe("arm to table and back, both conventions, to 1e-12 m and rad", () => {
  test.each(LIBRARY.map(robot => [robot.id, robot.arm] as const))("%s", (_, arm) => {
    for (const convention of CONVENTIONS) {
      const table = dhFromArm(arm, convention);
      const back = armFromDh(arm.name, table, arm.joints);
      expect(table.rows.length).toBe(arm.joints.length);
      expect(worstGap(arm, back, 8)).toBeLessThan(1e-12);
      expect(worstGap(arm, armFromDh(arm.name, dhFromArm(back, convention), arm.joints), 8)).toBeLessThan(1e-12);
    }
  });

  test("arms with axes anywhere, parallel, meeting and on one line (300 seeded)", () => {
    const random = seededRandom(81);
    const limits = LIBRARY[0]!.arm.joints[0]!.limits;
    const any = (): number => random() * 2 - 1;
    for (let n = 0; n < 300; n++) {
      const joints = Array.from({ length: 1 + Math.floor(random() * 7) }, (_, i): Joint => {
        const kind = random();
        const square = [0, 0, 0, 1].map((_, k) =>
          fromAxisAngle([k === 0 ? 1 : 0, k === 1 ? 1 : 0, k === 2 ? 1 : 0], (Math.PI / 2) * Math.floor(random() * 4)),
        )[Math.floor(random() * 3)]!;
        const turned =
          kind < 0.4
            ? square
            : kind < 0.5
              ? fromAxisAngle([0, 0, 1], any())
              : normalizeQuaternion([any(), any(), any(), any()]);
        const origin =
          random() < 0.3
            ? ([0, 0, 0] as const)
            : random() < 0.3
              ? ([0, 0, any()] as const)
              : ([any(), any(), any()] as const);
        return {
          name: `j${i}`,
          limits,
          parentFromJoint: pose([...origin], turned),
          axis: random() < 0.5 ? [0, 0, random() < 0.5 ? 1 : -1] : normalize([any(), any(), any()]),
        };
      });
      const arm: SerialArm = {
        name: "any",
        joints,
        lastJointFromFlange: pose(
          [0, 0, random() < 0.5 ? 0 : any()],
          random() < 0.5 ? [0, 0, 0, 1] : normalizeQuaternion([any(), any(), any(), any()]),
        ),
      };
      for (const convention of CONVENTIONS)
        expect(worstGap(arm, armFromDh("any", dhFromArm(arm, convention), joints), n)).toBeLessThan(1e-11);
    }
  });
});

interface WitnessRow {
  readonly alpha_prev?: number;
  readonly a_prev?: number;
  readonly alpha?: number;
  readonly a?: number;
  readonly d: number;
  readonly theta_offset: number;
}
interface WitnessTable {
  readonly base: number[][];
  readonly tool: number[][];
  readonly rows: readonly WitnessRow[];
  readonly max_abs_error_vs_pinocchio: number;
}
const witness = (
  JSON.parse(readFileSync(new URL("../../../../fixtures/kinematics/dh.json", import.meta.url), "utf8")) as {
    robots: Record<string, { modified_craig: WitnessTable; standard: WitnessTable }>;
  }
).robots;
const poseOf = (m: number[][]): Pose =>
  pose([m[0]![3]!, m[1]![3]!, m[2]![3]!], fromMatrix(m.slice(0, 3).flatMap(row => row.slice(0, 3))));
const tableOf = ({ base, tool, rows }: WitnessTable, convention: DhConvention): DhTable => ({
  convention,
  baseFromFirst: poseOf(base) as Pose<"base", "first">,
  lastFromFlange: poseOf(tool) as Pose<"last", "flange">,
  rows: rows.map(row => ({
    a_m: row.a ?? row.a_prev ?? 0,
    alpha_rad: row.alpha ?? row.alpha_prev ?? 0,
    d_m: row.d,
    thetaOffset_rad: row.theta_offset,
    sense: 1,
  })),
});

describe("tables of an independent witness are the library's arms", () => {
  test.each(Object.keys(witness))("%s", id => {
    const robot = robotById(id);
    const given = witness[id]!;
    if (!robot) throw new Error(id);
    const stated = 1e-9 + 2 * given.modified_craig.max_abs_error_vs_pinocchio;
    expect(
      worstGap(robot.arm, armFromDh(id, tableOf(given.modified_craig, "modified"), robot.arm.joints), 3),
    ).toBeLessThan(stated);
    expect(worstGap(robot.arm, armFromDh(id, tableOf(given.standard, "standard"), robot.arm.joints), 3)).toBeLessThan(
      stated,
    );
  });
});

test("N-08 the RX90L's modified D-H table is the printed one: α 0, −90, 0, 90, −90, 90; a3 = 450 mm, d4 = 650 mm", () => {
  const { rows, baseFromFirst, lastFromFlange } = dhFromArm(robotById("staubli_rx90l")!.arm, "modified");
  expect(rows.map(({ alpha_rad }) => Math.round(degrees(alpha_rad) * 1e9) / 1e9)).toEqual([0, -90, 0, 90, -90, 90]);
  const expected = { a: [0, 0, 0.45, 0, 0, 0], d: [0.42, 0, 0, 0.65, 0, 0.085], theta: [0, 0, 0, 0, 0, 0] };
  rows.forEach((row, i) => {
    expect(row.a_m).toBeCloseTo(expected.a[i]!, 12);
    expect(row.d_m).toBeCloseTo(expected.d[i]!, 12);
    expect(row.thetaOffset_rad).toBeCloseTo(expected.theta[i]!, 12);
  });
  for (const rest of [baseFromFirst, lastFromFlange] as Pose[]) {
    expect(distance(rest.position, [0, 0, 0])).toBeLessThan(1e-12);
    expect(angleBetween(rest.quaternion, [0, 0, 0, 1])).toBeLessThan(1e-12);
  }
});

test("a row of sense −1 turns the other way", () => {
  const limits = LIBRARY[0]!.arm.joints[0]!.limits;
  const row = { a_m: 0.3, alpha_rad: 0.4, d_m: 0.2, thetaOffset_rad: 0.5 };
  const table = (sense: 1 | -1): DhTable => ({
    convention: "standard",
    baseFromFirst: pose(),
    lastFromFlange: pose(),
    rows: [
      { ...row, sense },
      { ...row, sense: 1 },
    ],
  });
  const joints = ["a", "b"].map(name => ({ name, limits }));
  const left = armFromDh("l", table(-1), joints);
  const right = armFromDh("r", table(1), joints);
  expect(distance(flangePose(left, [0.7, 0.1]).position, flangePose(right, [-0.7, 0.1]).position)).toBeLessThan(1e-15);
  const turned = compose(pose([0, 0, 0], fromAxisAngle([0, 0, 1], -0.7)), flangePose(right, [0, 0.1]) as Pose);
  expect(distance(flangePose(left, [0.7, 0.1]).position, turned.position)).toBeLessThan(1e-12);
});
