import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  computedTorque,
  dynamicsModel,
  dynamicsScratch,
  forwardDynamics,
  fromAxisAngle,
  inverseDynamics,
  LIBRARY,
  massMatrix,
  pose,
  robotById,
  seededRandom,
  type DynamicsModel,
  type DynamicsOptions,
  type Payload,
  type Robot,
} from "../index.ts";

/** Witness: pinocchio on the robots' own URDFs. */
interface Case {
  q: number[];
  qd: number[];
  qdd: number[];
  tau: number[];
  payload: (Payload & { frame: string }) | null;
  inverse: number[];
  forward: number[];
  mass: number[][];
}
const { robots } = JSON.parse(
  readFileSync(new URL("../../../../fixtures/dynamics/dynamics.json", import.meta.url), "utf8"),
) as { robots: Record<string, Case[]> };

function known(robot: Robot, options?: DynamicsOptions): DynamicsModel {
  const answer = dynamicsModel(robot, options);
  if (answer.kind === "unknown") throw new Error(answer.sentence);
  return answer.model;
}
const near = (got: ArrayLike<number>, wanted: readonly number[], within: number): void => {
  wanted.forEach((value, i) => {
    expect(Math.abs(got[i]! - value), `number ${i}: ${got[i]} for ${value}`).toBeLessThan(
      within * Math.max(1, Math.abs(value)),
    );
  });
};

describe.each(Object.entries(robots))("%s", (id, cases) => {
  const modelOf = ({ payload }: Case): DynamicsModel => known(robotById(id)!, payload ? { payload } : {});
  test("L-11 torques, accelerations and mass matrix meet pinocchio's, with and without a payload", () => {
    expect(cases.filter(({ payload }) => payload).length).toBe(10);
    for (const each of cases) {
      const model = modelOf(each);
      const scratch = dynamicsScratch(model);
      const n = each.q.length;
      near(inverseDynamics(model, each.q, each.qd, each.qdd, undefined, scratch), each.inverse, 1e-9);
      near(forwardDynamics(model, each.q, each.qd, each.tau, undefined, scratch), each.forward, 1e-7);
      const mass = massMatrix(model, each.q, undefined, scratch);
      for (let i = 0; i < n; i++)
        for (let j = i; j < n; j++)
          near([mass[n * i + j]!, mass[n * j + i]!], [each.mass[i]![j]!, each.mass[i]![j]!], 1e-9);
    }
  });

  test("L-11 what the inverse asks for, the forward answers, rotors included", () => {
    const plain = known(robotById(id)!);
    const next = seededRandom(11);
    const some = (scale: number): number[] => plain.robot.arm.joints.map(() => (2 * next() - 1) * scale);
    const model: DynamicsModel = { ...plain, rotors_kgm2: Float64Array.from(some(1), Math.abs) };
    for (let i = 0; i < 200; i++) {
      const q = some(3);
      const qd = some(3);
      const qdd = some(10);
      near(forwardDynamics(model, q, qd, inverseDynamics(model, q, qd, qdd)), qdd, 1e-9);
    }
  });
});

test("free fall: without torques the energy of an arm is kept", () => {
  const model = known(robotById("ur10e")!);
  const n = 6;
  const q = Float64Array.from([0.3, -1, 0.7, 0.2, -0.4, 0.1]);
  const qd = new Float64Array(n);
  const none = new Float64Array(n);
  const a = new Float64Array(n);
  const h = 1e-4;
  const scratch = dynamicsScratch(model);
  const mass = new Float64Array(n * n);
  const lift = new Float64Array(n);
  let potential_J = 0;
  let worst_J = 0;
  for (let step = 0; step < 5000; step++) {
    // Work done by gravity along the step, from the torques that would hold the arm, taken at its middle.
    forwardDynamics(model, q, qd, none, a, scratch);
    const middle = q.map((value, i) => value + 0.5 * h * qd[i]! + 0.125 * h * h * a[i]!);
    const slow = qd.map((value, i) => value + 0.5 * h * a[i]!);
    inverseDynamics(model, middle, none, none, lift, scratch);
    forwardDynamics(model, middle, slow, none, a, scratch);
    for (let i = 0; i < n; i++) {
      potential_J += lift[i]! * h * slow[i]!;
      q[i]! += h * slow[i]!;
      qd[i]! += h * a[i]!;
    }
    massMatrix(model, q, mass, scratch);
    let kinetic_J = 0;
    for (let i = 0; i < n; i++) for (let j = 0; j < n; j++) kinetic_J += 0.5 * qd[i]! * mass[n * i + j]! * qd[j]!;
    worst_J = Math.max(worst_J, Math.abs(kinetic_J + potential_J));
  }
  expect(Math.max(...qd.map(Math.abs))).toBeGreaterThan(1);
  expect(worst_J).toBeLessThan(0.02);
});

test("on its side or upside down an arm feels gravity from where it comes", () => {
  const robot = robotById("abb_irb120")!;
  const still = [0, 0, 0, 0, 0, 0];
  const q = [0.4, 0.3, -0.2, 0.5, 0.6, 0.1];
  const up = inverseDynamics(known(robot), q, still, still);
  const down = inverseDynamics(
    known(robot, { worldFromBase: pose([0, 0, 2], fromAxisAngle([1, 0, 0], Math.PI)) }),
    q,
    still,
    still,
  );
  near(
    down,
    [...up].map(value => -value),
    1e-12,
  );
  const side = inverseDynamics(
    known(robot, { worldFromBase: pose([0, 0, 0], fromAxisAngle([1, 0, 0], Math.PI / 2)) }),
    q,
    still,
    still,
  );
  expect(Math.abs(up[0]!)).toBeLessThan(1e-12);
  expect(Math.abs(side[0]!)).toBeGreaterThan(1);
});

test("X-10 without published masses the torques are unknown, and the sentence says what is missing", () => {
  const answers = LIBRARY.map(robot => dynamicsModel(robot));
  expect(answers.filter(answer => answer.kind === "known").map(({ kind }) => kind).length).toBeGreaterThanOrEqual(2);
  expect(dynamicsModel(robotById("lola_rl15_placeholder")!)).toEqual({
    kind: "unknown",
    sentence: expect.stringMatching(/centre of mass and inertia of link 1 are not published\.$/),
  });
  expect(dynamicsModel(robotById("staubli_rx90l")!)).toMatchObject({ kind: "unknown" });
});

test("L-68 computed torque follows a motion that leaves a spring behind, and keeps within the torques it is given", () => {
  const robot = robotById("ur10e")!;
  const model = known(robot);
  const n = 6;
  const limits = robot.arm.joints.map(({ limits: { torque_Nm } }) => torque_Nm!);
  const wanted = (t: number) => ({
    q: [0, 1, 2, 3, 4, 5].map(i => -0.8 + 0.4 * Math.sin(1.5 * t + i)),
    qd: [0, 1, 2, 3, 4, 5].map(i => 0.6 * Math.cos(1.5 * t + i)),
    qdd: [0, 1, 2, 3, 4, 5].map(i => -0.9 * Math.sin(1.5 * t + i)),
  });
  const follow = (torque: (t: number, q: Float64Array, qd: Float64Array) => ArrayLike<number>): number => {
    const q = Float64Array.from(wanted(0).q, value => value + 0.05);
    const qd = Float64Array.from(wanted(0).qd);
    const h = 0.001;
    let worst = 0;
    for (let t = 0; t < 3; t += h) {
      const tau = torque(t, q, qd);
      for (let i = 0; i < n; i++) expect(Math.abs(tau[i]!)).toBeLessThanOrEqual(limits[i]!);
      const a = forwardDynamics(model, q, qd, tau);
      for (let i = 0; i < n; i++) {
        qd[i]! += h * a[i]!;
        q[i]! += h * qd[i]!;
      }
      if (t > 2)
        wanted(t + h).q.forEach((value, i) => {
          worst = Math.max(worst, Math.abs(value - q[i]!));
        });
    }
    return worst;
  };
  const exact = follow((t, q, qd) => computedTorque(model, wanted(t), q, qd, 15, limits));
  const springs = follow((t, q, qd) =>
    wanted(t).q.map((value, i) =>
      Math.max(-limits[i]!, Math.min(limits[i]!, 400 * (value - q[i]!) + 40 * (wanted(t).qd[i]! - qd[i]!))),
    ),
  );
  expect(exact).toBeLessThan(0.002);
  expect(springs).toBeGreaterThan(5 * exact);
});
