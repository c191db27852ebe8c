import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { JointSpline } from "./joint-spline.ts";
import { timeOptimal, type JointTorques } from "./time-optimal.ts";

interface Golden {
  readonly certificate: { readonly places: number };
  readonly cases: readonly {
    readonly waypoints: number[][];
    readonly speed: number[];
    readonly acceleration: number[];
    readonly torque_Nm: number[] | null;
    readonly duration_s: number;
  }[];
}
const golden = JSON.parse(
  readFileSync(new URL("../../../../fixtures/motion/timing.json", import.meta.url), "utf8"),
) as Golden;

/** Two links of 8 kg and 4 kg, 0.5 m and 0.4 m, point masses at their ends, hanging plane, joint inertia 0.2 kg m². */
const pendulum: JointTorques = (q, qd, qdd, out) => {
  const m1 = 8;
  const m2 = 4;
  const l1 = 0.5;
  const l2 = 0.4;
  const g = 9.81;
  const c2 = Math.cos(q[1]!);
  const k = m2 * l1 * l2 * Math.sin(q[1]!);
  const m11 = m1 * l1 * l1 + m2 * (l1 * l1 + 2 * l1 * l2 * c2 + l2 * l2) + 0.2;
  const m12 = m2 * (l1 * l2 * c2 + l2 * l2);
  const m22 = m2 * l2 * l2 + 0.2;
  const lower = m2 * g * l2 * Math.sin(q[0]! + q[1]!);
  out[0] =
    m11 * qdd[0]! +
    m12 * qdd[1]! -
    k * (2 * qd[0]! * qd[1]! + qd[1]! * qd[1]!) +
    (m1 + m2) * g * l1 * Math.sin(q[0]!) +
    lower;
  out[1] = m12 * qdd[0]! + m22 * qdd[1]! + k * qd[0]! * qd[0]! + lower;
};

describe("time-optimal timing", () => {
  test("takes as long as TOPP-RA says, with speeds, accelerations and torques", () => {
    expect(golden.cases.filter(({ torque_Nm }) => torque_Nm !== null).length).toBeGreaterThan(2);
    for (const { waypoints, speed, acceleration, torque_Nm, duration_s } of golden.cases) {
      const knots = waypoints.map((_, i) => i / (waypoints.length - 1));
      const answer = timeOptimal(
        new JointSpline(waypoints, knots),
        { speed_rad_s: Float64Array.from(speed), acceleration_rad_s2: Float64Array.from(acceleration) },
        {
          places: golden.certificate.places,
          ...(torque_Nm === null ? {} : { dynamics: { torques: pendulum, limit_Nm: torque_Nm } }),
        },
      );
      expect(answer.kind).toBe("timed");
      if (answer.kind === "timed") expect(Math.abs(answer.timing.duration_s / duration_s - 1)).toBeLessThan(1e-5);
    }
  });

  test("speeds and accelerations hold at every place, and one of them is always at its limit", () => {
    const { waypoints, speed, acceleration } = golden.cases[0]!;
    const path = new JointSpline(waypoints);
    const n = path.joints;
    const answer = timeOptimal(path, {
      speed_rad_s: Float64Array.from(speed),
      acceleration_rad_s2: Float64Array.from(acceleration),
    });
    if (answer.kind !== "timed") throw new Error(answer.kind);
    const { s, rate } = answer.timing;
    const q = new Float64Array(n);
    const q1 = new Float64Array(n);
    const q2 = new Float64Array(n);
    let idle = 0;
    for (let i = 0; i + 1 < s.length; i++) {
      path.evaluate(s[i]!, 0, q, q1, q2);
      const x = rate[i]! ** 2;
      const u = (rate[i + 1]! ** 2 - x) / (2 * (s[i + 1]! - s[i]!));
      let load = 0;
      for (let j = 0; j < n; j++)
        load = Math.max(
          load,
          Math.abs(q1[j]! * rate[i]!) / speed[j]!,
          Math.abs(q1[j]! * u + q2[j]! * x) / acceleration[j]!,
        );
      expect(load).toBeLessThan(1 + 1e-6);
      if (load < 0.95) idle++;
    }
    expect(idle / s.length).toBeLessThan(0.05);
  });

  test("an arm too weak for its own weight is told which joint, and by how much", () => {
    const path = new JointSpline([
      [0, 0],
      [1.5, 0.2],
    ]);
    const answer = timeOptimal(
      path,
      { speed_rad_s: Float64Array.of(2, 2), acceleration_rad_s2: Float64Array.of(9, 9) },
      { dynamics: { torques: pendulum, limit_Nm: [50, 40] } },
    );
    expect(answer).toMatchObject({ kind: "too-heavy", joint: 1, limit_Nm: 50 });
    if (answer.kind === "too-heavy") expect(answer.weight_Nm).toBeGreaterThan(50);
  });

  test("a start too fast for the path is told the most it may be", () => {
    const path = new JointSpline([[0], [1]]);
    const answer = timeOptimal(
      path,
      { speed_rad_s: Float64Array.of(3), acceleration_rad_s2: Float64Array.of(2) },
      { startRate: 2.5 },
    );
    expect(answer).toMatchObject({ kind: "start-too-fast" });
    // √(2 a s)
    if (answer.kind === "start-too-fast") expect(answer.most).toBeCloseTo(2, 6);
  });
});

describe("the spline through waypoints", () => {
  test("meets them, is smooth there, and its slopes are its differences", () => {
    const points = golden.cases[1]!.waypoints;
    const path = new JointSpline(points);
    const n = path.joints;
    const make = (): Float64Array => new Float64Array(n);
    const q = make();
    const d = make();
    const b = make();
    const q2 = make();
    const d2 = make();
    const b2 = make();
    path.evaluate(0, 0, q, d, b);
    q.forEach((angle, j) => {
      expect(angle).toBe(points[0]![j]);
      expect(b[j]).toBe(0);
    });
    let s = 0;
    for (let i = 1; i + 1 < points.length; i++) {
      s += Math.hypot(...points[i]!.map((angle, j) => angle - points[i - 1]![j]!));
      path.evaluate(s - 1e-9, 0, q, d, b);
      path.evaluate(s + 1e-9, 0, q2, d2, b2);
      for (let j = 0; j < n; j++) {
        expect(q[j]).toBeCloseTo(points[i]![j]!, 7);
        expect(d[j]).toBeCloseTo(d2[j]!, 6);
        expect(b[j]).toBeCloseTo(b2[j]!, 5);
      }
    }
    path.evaluate(0.4 - 1e-5, 0, q, d, b);
    path.evaluate(0.4 + 1e-5, 0, q2, d2, b2);
    for (let j = 0; j < n; j++) {
      expect((q2[j]! - q[j]!) / 2e-5).toBeCloseTo((d[j]! + d2[j]!) / 2, 7);
      expect((d2[j]! - d[j]!) / 2e-5).toBeCloseTo((b[j]! + b2[j]!) / 2, 5);
    }
  });
});
