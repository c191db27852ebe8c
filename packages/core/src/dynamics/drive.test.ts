import { describe, expect, test } from "vitest";
import {
  armDriveGains,
  criticalDamping,
  dampingRatio,
  driveGains,
  driveTorque,
  dynamicsModel,
  massMatrix,
  robotById,
  type DriveGains,
} from "../index.ts";

/** Table A2: mass and joint torque. Table 1: EP = EV, stiffness, damping, as printed. */
const TABLE = [
  { joint: 1, m: 347.95, tau: 2136, e: 0.02, k: 95283.3, b: 11516.7 },
  { joint: 2, m: 75.17, tau: 4593.4, e: 0.02, k: 221489, b: 8160.72 },
  { joint: 3, m: 82.34, tau: 2118.2, e: 0.02, k: 100166, b: 5734.75 },
  { joint: 4, m: 46.3, tau: 462.9, e: 0.02, k: 21165, b: 1979.84 },
  { joint: 5, m: 2.37, tau: 761.32, e: 0.01, k: 75287.2, b: 844.82 },
  { joint: 6, m: 0.9, tau: 184.95, e: 0.005, k: 36626.9, b: 363.121 },
] as const;
const gainsOf = ({ m, tau, e }: (typeof TABLE)[number]): DriveGains =>
  driveGains({ inertia: m, torqueMax_Nm: tau, errorMax_rad: e, speedErrorMax_rad_s: e });

test.each(TABLE)(
  "L-17 G-01 joint $joint: Table 1 from Table A2 (E-09: what is printed for joints 1 to 3 is off by up to 0.2 %)",
  row => {
    const { stiffness, damping } = gainsOf(row);
    const within = row.joint > 3 ? 1e-4 : 2e-3;
    expect(Math.abs(stiffness / row.k - 1)).toBeLessThan(within);
    expect(Math.abs(damping / row.b - 1)).toBeLessThan(within);
  },
);
test("E-09 joint 3 has a damping of 5743.76; the printed 5734.75 has two digits swapped", () => {
  expect(gainsOf(TABLE[2]).damping).toBeCloseTo(5743.757789, 5);
});
test("L-14 L-15 the closed form meets its own conditions", () => {
  for (const row of TABLE) {
    const { stiffness, damping } = gainsOf(row);
    expect(damping).toBeCloseTo(criticalDamping(stiffness, row.m), 9);
    expect(stiffness * row.e + damping * row.e).toBeCloseTo(row.tau, 6);
  }
});
test("L-16 the closed form solves its quadratic:  EP x² + 2 EV √m x − τ = 0", () => {
  for (const { m, tau, e } of TABLE) {
    const x = Math.sqrt(
      driveGains({ inertia: m, torqueMax_Nm: tau, errorMax_rad: e, speedErrorMax_rad_s: 3 * e }).stiffness,
    );
    expect(e * x * x + 2 * 3 * e * Math.sqrt(m) * x - tau).toBeCloseTo(0, 8);
  }
});

/** One joint of inertia m, a step of the target; angle and torque over time (midpoint rule). */
function step(
  gains: DriveGains,
  inertia: number,
  target_rad: number,
  seconds: number,
): {
  readonly highest_rad: number;
  readonly end_rad: number;
  readonly most_Nm: number;
  readonly at: (t_s: number) => number;
} {
  const h = seconds / 20_000;
  const angles: number[] = [];
  let q = 0;
  let qd = 0;
  let highest_rad = 0;
  let most_Nm = 0;
  for (let i = 0; i < 20_000; i++) {
    const torque = driveTorque(gains, target_rad, q, 0, qd);
    most_Nm = Math.max(most_Nm, Math.abs(torque));
    const qm = q + 0.5 * h * qd;
    const qdm = qd + (0.5 * h * torque) / inertia;
    const middle = driveTorque(gains, target_rad, qm, 0, qdm);
    q += h * qdm;
    qd += (h * middle) / inertia;
    highest_rad = Math.max(highest_rad, q);
    angles.push(q);
  }
  return { highest_rad, end_rad: q, most_Nm, at: t_s => angles[Math.round(t_s / h) - 1]! };
}

describe.each(TABLE)("joint $joint as a single mass", row => {
  const gains = gainsOf(row);
  test("L-12 a step answers as the equation of motion says:  q = r (1 − e^{−ω t} (1 + ω t))", () => {
    const target = row.e * 0.1;
    const omega = Math.sqrt(gains.stiffness / row.m);
    const response = step(gains, row.m, target, 12 / omega);
    for (const turns of [0.5, 1, 2, 4, 8]) {
      const t = turns / omega;
      expect(Math.abs(response.at(t) / target - (1 - Math.exp(-turns) * (1 + turns)))).toBeLessThan(1e-3);
    }
  });
  test("L-13 a step below the largest error never overshoots; with half the damping it does", () => {
    const target = row.e * 0.9;
    const omega = Math.sqrt(gains.stiffness / row.m);
    expect(step(gains, row.m, target, 20 / omega).highest_rad).toBeLessThanOrEqual(target * (1 + 1e-9));
    expect(step({ ...gains, damping: gains.damping / 2 }, row.m, target, 20 / omega).highest_rad).toBeGreaterThan(
      target * 1.05,
    );
  });
  test("L-70 a step of ten times the largest error saturates the drive and never exceeds its torque", () => {
    const omega = Math.sqrt(gains.stiffness / row.m);
    const { most_Nm, end_rad } = step(gains, row.m, 10 * row.e, 60 / omega);
    expect(most_Nm).toBe(row.tau);
    expect(end_rad).toBeCloseTo(10 * row.e, 4);
  });
});

test("L-12 with the signs the paper's text has lost the joint would run away (E-23)", () => {
  const gains = gainsOf(TABLE[0]);
  const wrong = (q: number, qd: number): number => -driveTorque(gains, 0, q, 0, qd);
  let q = 0.001;
  let qd = 0;
  for (let i = 0; i < 2000; i++) {
    qd += (1e-4 * wrong(q, qd)) / TABLE[0].m;
    q += 1e-4 * qd;
  }
  expect(Math.abs(q)).toBeGreaterThan(0.001);
});

test("L-13 on a whole arm the paper's damping rings; with the inertia that is really there it does not", () => {
  const robot = robotById("ur10e")!;
  const answer = dynamicsModel(robot);
  if (answer.kind === "unknown") throw new Error(answer.sentence);
  const mass = massMatrix(answer.model, [0, -0.5, 0.3, 0, 0, 0]);
  const shoulder = mass[7]!;
  const link_kg = robot.masses![1]!.mass_kg;
  const k = 20_000;
  expect(dampingRatio(k, criticalDamping(k, link_kg), shoulder)).not.toBeCloseTo(1, 1);
  expect(dampingRatio(k, armDriveGains(k, shoulder, 330).damping, shoulder)).toBeCloseTo(1, 12);
});

test("L-13 J5 of the RL15: with its own rotor the printed damping gives ζ = 0.22", () => {
  const { drive } = robotById("lola_rl15_placeholder")!.arm.joints[4]!;
  const rotor = drive!.rotorInertia_kgm2 * drive!.gear ** 2;
  const { stiffness, damping } = gainsOf(TABLE[4]);
  expect(dampingRatio(stiffness, damping, rotor)).toBeCloseTo(0.22, 2);
});
