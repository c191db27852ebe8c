import { describe, expect, test } from "vitest";
import {
  dynamicsModel,
  dynamicsScratch,
  forwardDynamics,
  inverseDynamics,
  pose,
  robotById,
  seededRandom,
  fromAxisAngle,
  type DynamicsModel,
  type Payload,
  type PhysicalScene,
  type Robot,
} from "@twincell/core";
import { createWorld } from "./index.ts";
import { at, bareScene, box, engine, ready, reaching } from "./testing/cells.ts";

/** Gears and rotors made up for the test: nobody publishes them for these arms. */
const withRotors = (robot: Robot): Robot => ({
  ...robot,
  arm: {
    ...robot.arm,
    joints: robot.arm.joints.map((joint, i) => ({
      ...joint,
      drive: { motorTorque_Nm: 1, motorSpeed_rpm: 3000, gear: 100 + i, rotorInertia_kgm2: 1e-4 },
    })),
  },
});
const CARRIED: Payload = {
  mass_kg: 7,
  center_m: [0.02, -0.03, 0.11],
  inertia_kgm2: [0.05, 0.06, 0.04, 0.003, -0.002, 0.001],
};

describe.each(["ur10e", "abb_irb120"])("%s", id => {
  test.each([
    ["bare", {}],
    [
      "with rotors by gear², a payload, and tilted",
      {
        payload: CARRIED,
        rotors: true,
        worldFromBase: pose<"world", "base">([0.2, 0, 0.5], fromAxisAngle([0.6, 0.8, 0], 0.7)),
      },
    ],
  ] as const)("L-11 accelerations and torques agree with our own ABA and RNEA to 1e-6, %s", (_, more) => {
    const { rotors, ...rest_ } = { rotors: false, ...more };
    const robot = rotors ? withRotors(robotById(id)!) : robotById(id)!;
    const scene: PhysicalScene = bareScene({ robot, control: { kind: "drives", bandwidth_rad_s: 60 }, ...rest_ });
    const world = ready(scene);
    const answer = dynamicsModel(robot, {
      worldFromBase: scene.worldFromBase,
      ...(scene.payload ? { payload: scene.payload } : {}),
    });
    const model: DynamicsModel = answer.kind === "known" ? answer.model : expect.fail(answer.sentence);
    const scratch = dynamicsScratch(model);
    const next = seededRandom(11);
    const some = (scale: number): number => (2 * next() - 1) * scale;
    let worst = 0;
    for (let k = 0; k < 100; k++) {
      const q = robot.arm.joints.map(
        ({ limits }) => limits.lower_rad + (0.02 + 0.96 * next()) * (limits.upper_rad - limits.lower_rad),
      );
      const qd = q.map(() => some(2));
      const torque = q.map(() => some(50));
      world.data.qpos.set(q);
      world.data.qvel.set(qd);
      world.data.qfrc_applied.set(torque);
      engine.mj_forward(world.model, world.data);
      forwardDynamics(model, q, qd, torque, undefined, scratch).forEach((ours, j) => {
        worst = Math.max(worst, Math.abs(ours - world.data.qacc[j]) / Math.max(1, Math.abs(ours)));
      });
      const qdd = q.map(() => some(10));
      world.data.qacc.set(qdd);
      engine.mj_inverse(world.model, world.data);
      inverseDynamics(model, q, qd, qdd, undefined, scratch).forEach((ours, j) => {
        worst = Math.max(worst, Math.abs(ours - world.data.qfrc_inverse[j]) / Math.max(1, Math.abs(ours)));
      });
    }
    expect(worst).toBeLessThan(1e-6);
    world.close();
  });
});

test("L-71 one body each link, with the masses of Table A2; L-18", () => {
  const world = ready(bareScene({ robot: robotById("lola_rl15_placeholder")! }));
  const first = engine.mj_name2id(world.model, engine.mjtObj.mjOBJ_BODY.value, "link1");
  expect([0, 1, 2, 3, 4, 5].map(i => world.model.body_mass[first + i])).toEqual([
    347.95, 75.17, 82.34, 46.3, 2.37, 0.9,
  ]);
  expect(world.model.njnt).toBe(6);
  world.close();
});

test("an arm whose masses nobody publishes is not driven on a guess, and is moved all the same", () => {
  const robot = robotById("staubli_rx90l")!;
  const answer = createWorld(engine, bareScene({ robot, control: { kind: "drives", bandwidth_rad_s: 60 } }));
  expect(answer.kind === "refused" && answer.why.sentence).toContain("are unknown");
  const moved = createWorld(engine, bareScene({ robot }));
  expect(moved.kind === "ready" && moved.assumptions).toContain(
    "The arm is moved as told, whatever it touches: its torques are unknown.",
  );
  if (moved.kind === "ready") moved.world.close();
});

/** A step of the target of one joint; how the arm answers. */
function step(
  control: PhysicalScene["control"],
  joint: number,
  by_rad: number,
  payload?: Payload,
): { readonly overshoot: number; readonly most_Nm: number; readonly limit_Nm: number; readonly end: number } {
  const start = [0, -1.2, 1.4, -1.5, -1.5, 0];
  const world = ready(bareScene({ control, q_rad: start, ...(payload ? { payload } : {}) }));
  const q = start.map((angle, j) => (j === joint ? angle + by_rad : angle));
  const none = new Float64Array(6);
  let most_Nm = 0;
  let highest = -1;
  for (let i = 0; i < 1500; i++) {
    world.step({ q_rad: q, qd_rad_s: none, qdd_rad_s2: none, gripperClosed: false });
    most_Nm = Math.max(most_Nm, Math.abs(world.state.torque_Nm[joint]!));
    highest = Math.max(highest, (world.state.q_rad[joint]! - start[joint]!) / by_rad);
  }
  const end = (world.state.q_rad[joint]! - start[joint]!) / by_rad;
  const limit_Nm = world.scene.robot.arm.joints[joint]!.limits.torque_Nm!;
  world.close();
  return { overshoot: highest - 1, most_Nm, limit_Nm, end };
}

describe("drives on the whole arm", () => {
  test.each([0, 1, 2])(
    "L-13 joint %d of the UR10e, critically damped for the inertia that is there, does not overshoot a small step",
    joint => {
      const { overshoot, end, most_Nm, limit_Nm } = step({ kind: "drives", bandwidth_rad_s: 20 }, joint, 0.005);
      expect(most_Nm).toBeLessThan(limit_Nm);
      expect(overshoot).toBeLessThan(0.02);
      expect(Math.abs(end - 1)).toBeLessThan(0.02);
    },
  );
  test.each(["drives", "computed-torque"] as const)(
    "L-70 a large step saturates the drive of joint 1 at 330 N m and never passes it: %s",
    kind => {
      const { most_Nm, limit_Nm, end } = step({ kind, bandwidth_rad_s: 60 }, 0, 0.4);
      expect(limit_Nm).toBe(330);
      expect(most_Nm).toBe(330);
      expect(Math.abs(end - 1)).toBeLessThan(0.02);
    },
  );
  test("L-68 under computed torque every joint answers alike, with 7 kg on the flange as without", () => {
    const control = { kind: "computed-torque", bandwidth_rad_s: 20 } as const;
    for (const joint of [0, 1, 2])
      for (const payload of [undefined, CARRIED]) {
        const { overshoot, end } = step(control, joint, 0.005, payload);
        expect(overshoot).toBeLessThan(1e-3);
        expect(Math.abs(end - 1)).toBeLessThan(1e-3);
      }
  });
});

test("X-15 the arm pushes a box: it moves with the arm, and stays where it was left", () => {
  const scene = bareScene({
    floor_m: 0,
    objects: [box("box", [0.1, 0.1, 0.3], [0.8, 0.25, 0.15], { mass_kg: 2, friction: 0.4 })],
  });
  // The flange, pointing down, sweeps along y through where the box stands.
  const down = fromAxisAngle([1, 0, 0], Math.PI);
  const path = (y: number): number[] => reaching(scene, pose([0.8, y, 0.2], down));
  const from = path(0);
  const to = path(0.3);
  const world = ready({ ...scene, q_rad: from });
  const none = new Float64Array(6);
  const seconds = 2;
  const steps = seconds / world.step_s;
  for (let i = 1; i <= steps; i++) {
    const s = i / steps;
    const q = from.map((angle, j) => angle + (to[j]! - angle) * s);
    const qd = from.map((angle, j) => (to[j]! - angle) / seconds);
    expect(world.step({ q_rad: q, qd_rad_s: qd, qdd_rad_s2: none, gripperClosed: false }).kind).toBe("running");
  }
  const pushed = at(world, 0);
  expect(pushed[1]).toBeGreaterThan(0.35);
  // The arm goes back without it.
  for (let i = 1; i <= steps; i++) {
    const s = 1 - i / steps;
    const q = from.map((angle, j) => angle + (to[j]! - angle) * s);
    const qd = from.map((angle, j) => (angle - to[j]!) / seconds);
    expect(world.step({ q_rad: q, qd_rad_s: qd, qdd_rad_s2: none, gripperClosed: false }).kind).toBe("running");
  }
  const left = at(world, 0);
  // It slid on by no more than friction lets it: v²/(2 μ g) = 0.15²/(2 · 0.4 · 9.81) = 2.9 mm.
  for (let k = 0; k < 3; k++) expect(Math.abs(left[k]! - pushed[k]!)).toBeLessThan(0.005);
  world.close();
});
