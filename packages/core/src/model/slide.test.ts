import { describe, expect, test } from "vitest";
import { massMatrix } from "../dynamics/mass-matrix.ts";
import { forwardDynamics } from "../dynamics/forward-dynamics.ts";
import { inverseDynamics } from "../dynamics/inverse-dynamics.ts";
import { dynamicsModel, GRAVITY_MPS2 } from "../dynamics/model.ts";
import { flangePose, flangePoseBatch, jacobian, jacobianScratch, linkPoses, solveAll } from "../kinematics/index.ts";
import { nearestDamped, solveDamped, solveFabrik, dampedScratch, explainNumeric } from "../kinematics/numeric/index.ts";
import { checkProgram } from "../checks/check.ts";
import { parseProgram } from "../program/parse.ts";
import type { Program } from "../program/program.ts";
import { seededRandom } from "../random.ts";
import { compose, identity, inverse, pose, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle } from "../spatial/quaternion.ts";
import { normalize, type Vector3 } from "../spatial/vector.ts";
import { judgePlan } from "../trajectory/judge.ts";
import { planProgram } from "../trajectory/planner.ts";
import { jogJoints } from "../teach/jog-joints.ts";
import type { Joint, SerialArm } from "./arm.ts";
import { armFromDh, dhFromArm } from "../robots/dh.ts";
import { robotFromArm } from "../robots/foreign.ts";
import { isSlide, slideLimits } from "./slide.ts";

const turning = { lower_rad: -2.5, upper_rad: 2.5, speed_rad_s: 3, acceleration_rad_s2: 10 };
const sliding = slideLimits({ lower_m: -0.1, upper_m: 0.6, speed_mps: 1.2, acceleration_mps2: 5 });
const joint = (name: string, kind: Joint["kind"], axis: Vector3, position: Vector3): Joint => ({
  name,
  ...(kind === "prismatic" ? { kind } : {}),
  axis: normalize(axis),
  parentFromJoint: pose(position, fromAxisAngle(normalize([0.3, -0.4, 0.8]), position[0])),
  limits: kind === "prismatic" ? sliding : turning,
});

/** Slides along an axis of the frame, along none, first, between turns and last. */
const odd: SerialArm = {
  name: "odd",
  lastJointFromFlange: pose([0.05, 0, 0.1], fromAxisAngle([0, 1, 0], 0.4)),
  joints: [
    joint("rail", "prismatic", [0, 1, 0], [0.1, 0, 0]),
    joint("waist", undefined, [0, 0, 1], [0, 0, 0.3]),
    joint("mast", "prismatic", [0.2, -0.1, 1], [0.2, 0, 0.1]),
    joint("elbow", undefined, [0, 1, 0], [0.3, 0.1, 0]),
    joint("roll", undefined, [1, 0.2, 0], [0.2, 0, 0.1]),
    joint("pitch", undefined, [0, 1, 0], [0.1, 0, 0]),
    joint("quill", "prismatic", [0, 0, -1], [0, 0.05, 0]),
  ],
};
const anywhere = (arm: SerialArm, random: () => number): Float64Array =>
  Float64Array.from(arm.joints, ({ limits }) => limits.lower_rad + (limits.upper_rad - limits.lower_rad) * random());

/** The chain step by step, with nothing but `compose`. */
function plain(arm: SerialArm, q: ArrayLike<number>): Pose {
  let at: Pose = identity();
  arm.joints.forEach((each, j) => {
    const moved =
      each.kind === "prismatic"
        ? pose([each.axis[0] * q[j]!, each.axis[1] * q[j]!, each.axis[2] * q[j]!])
        : pose([0, 0, 0], fromAxisAngle(each.axis, q[j]!));
    at = compose(compose(at, each.parentFromJoint as Pose), moved);
  });
  return compose(at, arm.lastJointFromFlange as Pose);
}
function expectSame(a: Pose, b: Pose, digits = 12): void {
  a.position.forEach((v, k) => {
    expect(v).toBeCloseTo(b.position[k]!, digits);
  });
  expect(Math.abs(a.quaternion.reduce((sum, v, k) => sum + v * b.quaternion[k]!, 0))).toBeCloseTo(1, digits);
}

test("forward kinematics of joints that slide: one by one, in a batch, link by link", () => {
  const random = seededRandom(71);
  const links = Array.from({ length: 8 }, () => identity<"base", "link">());
  for (let n = 0; n < 50; n++) {
    const q = anywhere(odd, random);
    expectSame(flangePose(odd, q), plain(odd, q));
    linkPoses(odd, q, links);
    expectSame(compose(links[7]! as Pose, odd.lastJointFromFlange as Pose), plain(odd, q));
    expect(Array.from(flangePoseBatch(odd, q)).slice(0, 3)).toEqual([...flangePose(odd, q).position]);
  }
});

test("the Jacobian is the derivative, and one scratch serves arms of both kinds", () => {
  const random = seededRandom(72);
  const h = 1e-6;
  const turns: SerialArm = {
    ...odd,
    joints: odd.joints.map(each => ({
      name: each.name,
      axis: each.axis,
      parentFromJoint: each.parentFromJoint,
      limits: each.limits,
    })),
  };
  const scratch = jacobianScratch(7);
  for (let n = 0; n < 20; n++) {
    const arm = n % 2 === 0 ? odd : turns;
    const q = anywhere(arm, random);
    const J = jacobian(arm, q, [0.1, 0.2, 0.3], undefined, scratch);
    const tip = pose([0.1, 0.2, 0.3]);
    for (let j = 0; j < 7; j++) {
      const to = (step: number): Pose =>
        compose(
          plain(
            arm,
            q.map((v, k) => (k === j ? v + step : v)),
          ),
          tip,
        );
      const ahead = to(h);
      const behind = to(-h);
      for (let row = 0; row < 3; row++)
        expect(J[row * 7 + j]!).toBeCloseTo((ahead.position[row]! - behind.position[row]!) / (2 * h), 7);
      const turned = compose(ahead, inverse(behind)).quaternion;
      for (let row = 0; row < 3; row++)
        expect(J[(3 + row) * 7 + j]!).toBeCloseTo((Math.sign(turned[3]) * turned[row]!) / h, 7);
    }
  }
});

test("closed forms never see a slide; the numeric method solves it and says limits in millimetres", () => {
  const robot = robotFromArm(odd);
  const random = seededRandom(73);
  const scratch = dampedScratch(7);
  const out = new Float64Array(7);
  expect(robot.family.kind).toBe("general");
  expect(solveAll(robot, flangePose(odd, robot.home_rad))).toMatchObject({ kind: "reached", method: "numeric" });
  for (let n = 0; n < 100; n++) {
    const q = anywhere(odd, random).map(v => 0.9 * v);
    const wanted = flangePose(odd, q);
    expect(
      nearestDamped(
        odd,
        wanted,
        q.map(v => v + 0.02 * (random() - 0.5)),
        out,
        scratch,
      ),
    ).toBe(true);
    expectSame(plain(odd, out), wanted as Pose, 8);
  }
  const gantry = robotFromArm({
    name: "gantry",
    joints: [joint("x", "prismatic", [1, 0, 0], [0, 0, 0]), joint("y", "prismatic", [0, 1, 0], [0, 0, 0])],
    lastJointFromFlange: pose(),
  });
  const stalled = solveDamped(gantry.arm, flangePose(gantry.arm, [0.9, 0.2]), [0, 0]);
  expect(stalled).toMatchObject({ kind: "stalled", because: { kind: "limit", joint: 1, limit_rad: 0.6 } });
  expect(explainNumeric(stalled)).toBe("Joint 1 stands at its limit of 600.0 mm; 300 mm and 0.0° are left.");
  expect(solveFabrik(odd, flangePose(odd, out), out)).toEqual({
    kind: "not-a-pose",
    because: "Joint 1 of odd slides; FABRIK keeps links at their lengths.",
  });
  expect(jogJoints(gantry, [0.595, 0], [1, 0], 0.01, out.subarray(0, 2))).toMatchObject({
    blocked: [{ sentence: "Joint 1 would slide to 605.0 mm; its limit is 600.0 mm." }],
  });
});

describe("dynamics", () => {
  const point = (mass_kg: number) => ({
    mass_kg,
    linkFromCentre: pose<"link", "centre">(),
    inertia_kgm2: [0, 0, 0, 0, 0, 0] as const,
  });
  const still = {
    name: "polar",
    lastJointFromFlange: pose<"joint", "flange">(),
    joints: [
      { ...joint("lift", undefined, [0, -1, 0], [0, 0, 0]) },
      { ...joint("reach", "prismatic", [1, 0, 0], [0, 0, 0]) },
    ],
  };

  test("a weight on a slide on a hinge, in closed form:  τ = m r² θ̈ + 2 m r ṙ θ̇ + m g r cos θ,  F = m r̈ − m r θ̇² + m g sin θ", () => {
    const answer = dynamicsModel(robotFromArm(still, { masses: [point(0), point(3)] }));
    if (answer.kind === "unknown") throw new Error(answer.sentence);
    const random = seededRandom(74);
    const m = 3;
    const g = GRAVITY_MPS2;
    for (let n = 0; n < 50; n++) {
      const [th, r, thd, rd, thdd, rdd] = Array.from({ length: 6 }, () => 2 * (random() - 0.5)) as [
        number,
        number,
        number,
        number,
        number,
        number,
      ];
      const force = inverseDynamics(answer.model, [th, r], [thd, rd], [thdd, rdd]);
      expect(force[0]!).toBeCloseTo(m * r * r * thdd + 2 * m * r * rd * thd + m * g * r * Math.cos(th), 10);
      expect(force[1]!).toBeCloseTo(m * rdd - m * r * thd * thd + m * g * Math.sin(th), 10);
    }
  });

  test("forward undoes inverse on an arm of both kinds, and the mass matrix is what accelerations cost", () => {
    const answer = dynamicsModel(
      robotFromArm(odd, {
        masses: odd.joints.map((_, j) => ({
          mass_kg: 5 - 0.5 * j,
          linkFromCentre: pose<"link", "centre">([0.1, 0.02 * j, 0.05]),
          inertia_kgm2: [0.2, 0.3, 0.25, 0.01, 0, 0.02] as const,
        })),
      }),
    );
    if (answer.kind === "unknown") throw new Error(answer.sentence);
    const random = seededRandom(75);
    const { model } = answer;
    const any = (): Float64Array => Float64Array.from({ length: 7 }, () => 2 * (random() - 0.5));
    for (let n = 0; n < 20; n++) {
      const q = any();
      const qd = any();
      const qdd = any();
      const force = inverseDynamics(model, q, qd, qdd);
      forwardDynamics(model, q, qd, force).forEach((a, j) => {
        expect(a).toBeCloseTo(qdd[j]!, 9);
      });
      const M = massMatrix(model, q);
      const rest = inverseDynamics(model, q, qd, new Float64Array(7));
      for (let j = 0; j < 7; j++)
        expect(force[j]!).toBeCloseTo(rest[j]! + qdd.reduce((sum, a, k) => sum + M[7 * j + k]! * a, 0), 9);
    }
  });
});

test("a D-H table with rows that slide gives the same arm back, in both conventions", () => {
  const random = seededRandom(76);
  for (const convention of ["standard", "modified"] as const) {
    const table = dhFromArm(odd, convention);
    const again = armFromDh("odd", table, odd.joints);
    expect(table.rows.map(row => row.slides === true)).toEqual(odd.joints.map(isSlide));
    for (let n = 0; n < 20; n++) {
      const q = anywhere(odd, random);
      expectSame(flangePose(again, q), flangePose(odd, q), 11);
    }
  }
});

describe("a program on a gantry with a turning wrist", () => {
  const wrist = (name: string, axis: Vector3): Joint => ({ name, axis, parentFromJoint: pose(), limits: turning });
  const slide = (name: string, axis: Vector3): Joint => ({
    name,
    kind: "prismatic",
    axis,
    parentFromJoint: pose(),
    limits: slideLimits({ lower_m: -0.5, upper_m: 2, speed_mps: 1, acceleration_mps2: 4 }),
  });
  const gantry = robotFromArm({
    name: "gantry",
    joints: [
      slide("x", [1, 0, 0]),
      slide("y", [0, 1, 0]),
      slide("z", [0, 0, 1]),
      wrist("a", [0, 0, 1]),
      wrist("b", [0, 1, 0]),
      wrist("c", [1, 0, 0]),
    ],
    lastJointFromFlange: pose(),
  });
  const program = (far_m: number): Program => {
    const answer = parseProgram({
      format: "twincell.program",
      version: 1,
      robot: "gantry",
      tools: { hand: pose() },
      frames: {},
      steps: [
        {
          id: "a",
          type: "move",
          path: "ptp",
          target: { q: [0.5, 0.2, 0.1, 0.3, 0.2, 0.1] },
          speed: { ratio: 0.5 },
          blend_m: 0,
        },
        {
          id: "b",
          type: "move",
          path: "lin",
          target: { pose: pose([far_m, 1, 0.4], fromAxisAngle([0, 0, 1], 0.3)), frame: "world", tool: "hand" },
          speed: { mps: 0.4 },
          blend_m: 0,
        },
      ],
    });
    if (answer.kind !== "program") throw new Error(answer.faults[0]!.sentence);
    return answer.program;
  };

  test("is planned within limits along a straight path", () => {
    const answer = planProgram(program(1.5), gantry);
    expect(answer.kind).toBe("planned");
    expect(judgePlan(answer.plan, gantry)).toEqual([]);
    const line = answer.plan.segments[1]!;
    if (line.kind !== "motion") throw new Error("The second step moves.");
    const end = line.q_rad.subarray(-6);
    expect(end[0]!).toBeCloseTo(1.5, 6);
    expect(end[1]!).toBeCloseTo(1, 6);
    expect(end[2]!).toBeCloseTo(0.4, 6);
  });

  test("limits are said in millimetres", () => {
    const { verdict } = checkProgram(program(2.5), gantry);
    const finding = verdict.steps[1]!.findings.find(({ code }) => code === "limits.joint");
    expect(finding).toMatchObject({ joint: 1, unit: "m", limit: 2 });
    expect(finding!.sentence).toBe("Joint 1 would slide to 2500.0 mm; its limit is 2000.0 mm.");
  });
});
