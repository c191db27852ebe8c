import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  allBranches,
  angleBetween,
  compose,
  distance,
  flangePose,
  fromAxisAngle,
  fromMatrix,
  fromEulerAngles,
  identity,
  orthoParallelFlange,
  orthoParallelFromArm,
  pose,
  robotById,
  robotFromArm,
  seededRandom,
  solveAll,
  wrapAngle,
  type Joint,
  type OrthoParallelGeometry,
  type Pose,
  type SerialArm,
  type Vector3,
} from "../index.ts";

interface ArmFile {
  id: string;
  name: string;
  joints: {
    name: string;
    type: string;
    xyz: Vector3;
    rpy: Vector3;
    axis?: Vector3;
    limits?: [number, number];
    speed?: number;
  }[];
  opw: {
    parameters: Record<"a1" | "a2" | "b" | "c1" | "c2" | "c3" | "c4", number>;
    offsets: number[];
    sign_corrections: number[];
  } | null;
  forward: { q: number[]; T: number[][] }[];
}
const { robots } = JSON.parse(
  readFileSync(new URL("../../../../fixtures/kinematics/arms.json", import.meta.url), "utf8"),
) as { robots: ArmFile[] };

function armOf(file: ArmFile): SerialArm {
  const joints: Joint[] = [];
  let running: Pose = identity();
  for (const { name, type, xyz, rpy, axis, limits, speed } of file.joints) {
    running = compose(running, pose(xyz, fromEulerAngles("zyx", rpy[2], rpy[1], rpy[0])));
    if (type === "fixed" || !axis || !limits) continue;
    joints.push({
      name,
      axis,
      parentFromJoint: running as Pose<"parent", "joint">,
      limits: { lower_rad: limits[0], upper_rad: limits[1], speed_rad_s: speed ?? 1, acceleration_rad_s2: 4 },
    });
    running = identity();
  }
  return { name: file.name, joints, lastJointFromFlange: running as Pose<"joint", "flange"> };
}
const poseOf = (T: number[][]): Pose<"base", "flange"> =>
  pose([T[0]![3]!, T[1]![3]!, T[2]![3]!], fromMatrix(T.flatMap(row => row.slice(0, 3))));
const gap = (a: Pose, b: Pose): number =>
  Math.max(distance(a.position, b.position), angleBetween(a.quaternion, b.quaternion));
const OTHERS = ["ur10e", "abb_crb15000_5_95"];

describe("N-66 arms of the family are recognised by their axes alone", () => {
  for (const file of robots) {
    const arm = armOf(file);
    const geometry = orthoParallelFromArm(arm);
    test(`${file.name}: forward kinematics of the numbers is the reference's`, () => {
      for (const { q, T } of file.forward) expect(gap(flangePose(arm, q), poseOf(T))).toBeLessThan(3e-8); // quaternion of a matrix near half a turn
    });
    if (OTHERS.includes(file.id)) {
      test(`${file.name} is of another family`, () => {
        expect(geometry).toBeNull();
      });
      continue;
    }
    test(`${file.name}: lengths are the fitted ones, and the closed form solves it`, () => {
      if (geometry === null || file.opw === null) throw new Error(`${file.name} was not recognised.`);
      const { a1, a2, b, c1, c2, c3, c4 } = file.opw.parameters;
      const got = [
        geometry.a1_m,
        geometry.a2_m,
        geometry.b_m,
        geometry.c1_m,
        geometry.c2_m,
        geometry.c3_m,
        geometry.c4_m,
      ];
      [a1, a2, b, c1, c2, c3, c4].forEach((wanted, i) => {
        expect(Math.abs(got[i]! - wanted)).toBeLessThan(1e-9);
      });
      const robot = robotFromArm(arm);
      const random = seededRandom(66);
      for (let n = 0; n < 200; n++) {
        const q = Float64Array.from({ length: 6 }, () => (random() - 0.5) * 6);
        const wanted = flangePose(arm, q);
        expect(gap(orthoParallelFlange(geometry, q), wanted)).toBeLessThan(1e-9);
        const found = allBranches(robot, wanted);
        expect(found.some(solution => solution.every((angle, j) => Math.abs(wrapAngle(angle - q[j]!)) < 1e-6))).toBe(
          true,
        );
      }
    });
  }
});

test("any sign, zero and flange of the family is recognised, seed 9", () => {
  const random = seededRandom(9);
  const any = (): number => (random() - 0.5) * 2;
  const sign = (): number => (random() < 0.5 ? -1 : 1);
  for (let n = 0; n < 100; n++) {
    const [a1, b, c1, c2, a2, c3, c4] = [
      random() * 0.3,
      any() * 0.1,
      random(),
      0.2 + random(),
      any() * 0.1,
      0.2 + random(),
      random() * 0.2,
    ] as const;
    const turns: readonly [Vector3, Vector3][] = [
      [
        [0, 0, 0],
        [0, 0, sign()],
      ],
      [
        [a1, b, c1],
        [0, sign(), 0],
      ],
      [
        [0, 0, c2],
        [0, sign(), 0],
      ],
      [
        [a2, 0, c3],
        [0, 0, sign()],
      ],
      [
        [0, 0, 0],
        [0, sign(), 0],
      ],
      [
        [0, 0, 0],
        [0, 0, sign()],
      ],
    ];
    const arm: SerialArm = {
      name: "made up",
      joints: turns.map(([at, axis], j) => ({
        name: `${j + 1}`,
        axis,
        parentFromJoint: compose(
          pose<"parent", "turn">(at),
          pose<"turn", "joint">([0, 0, 0], fromAxisAngle(axis, 3 * any())),
        ),
        limits: { lower_rad: -3, upper_rad: 3, speed_rad_s: 1, acceleration_rad_s2: 4 },
      })),
      lastJointFromFlange: pose([0.02 * any(), 0.02 * any(), c4], fromEulerAngles("zyx", 3 * any(), any(), any())),
    };
    const geometry = orthoParallelFromArm(arm);
    if (geometry === null) throw new Error(`Arm ${n} was not recognised.`);
    const q = Float64Array.from({ length: 6 }, () => 3 * any());
    expect(gap(orthoParallelFlange(geometry, q), flangePose(arm, q))).toBeLessThan(1e-9);
  }
});

test("arms that only look alike are not taken for one: an axis off by 0.1 mm, a wrist that does not meet, a base turned away", () => {
  const arm = robotById("staubli_rx90l")!.arm;
  const changed = (joint: number, position: Vector3, turn = 0): SerialArm => ({
    ...arm,
    joints: arm.joints.map((each, j) =>
      j === joint ? { ...each, parentFromJoint: pose(position, fromAxisAngle([1, 0, 0], turn)) } : each,
    ),
  });
  expect(orthoParallelFromArm(arm)).not.toBeNull();
  expect(orthoParallelFromArm(changed(5, [1e-4, 0, 0]))).toBeNull();
  expect(orthoParallelFromArm(changed(4, [0, 1e-4, 0.65]))).toBeNull();
  expect(orthoParallelFromArm(changed(2, [0.45, 0, 0], 1e-4))).toBeNull();
  expect(orthoParallelFromArm(changed(0, [0, 0, 0.42], 0.3))).toBeNull();
  expect(orthoParallelFromArm({ ...arm, joints: arm.joints.slice(1) })).toBeNull();
});

test("the library's own geometry of the RX90L is what its axes say", () => {
  const robot = robotById("staubli_rx90l")!;
  const derived = orthoParallelFromArm(robot.arm)!;
  const own = robot.family as OrthoParallelGeometry;
  for (const key of ["a1_m", "a2_m", "b_m", "c1_m", "c2_m", "c3_m", "c4_m"] as const)
    expect(derived[key]).toBeCloseTo(own[key], 12);
  own.offsets_rad.forEach((offset, j) => {
    expect(derived.offsets_rad[j]).toBeCloseTo(offset, 12);
  });
  expect(derived.signs).toEqual(own.signs);
});

test("a robot made of an arm says what was assumed and solves its own poses", () => {
  const kr6 = robotFromArm(armOf(robots.find(({ id }) => id === "kuka_kr6r900sixx")!), { id: "kr6", payload_kg: 6 });
  expect(kr6.reach_m).toBeCloseTo(0.9015, 4);
  expect(kr6.assumptions.some(sentence => sentence.includes("902 mm") || sentence.includes("901 mm"))).toBe(true);
  expect(kr6.assumptions.some(sentence => sentence.includes("payload"))).toBe(false);
  expect(solveAll(kr6, flangePose(kr6.arm, [0.3, -1, 1.2, 0.4, 0.8, -0.2])).kind).toBe("reached");
  const ur10e = robotFromArm(armOf(robots.find(({ id }) => id === "ur10e")!));
  expect(ur10e.family.kind).toBe("three-parallel");
  expect(ur10e.reach_m).toBeCloseTo(1.304, 3);
  expect(robotFromArm({ ...ur10e.arm, joints: ur10e.arm.joints.slice(0, 5) }).family.kind).toBe("general");
  expect(ur10e.home_rad).toEqual([0, 0, 0, 0, 0, 0]);
});
