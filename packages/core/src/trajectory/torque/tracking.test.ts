import { describe, expect, test } from "vitest";
import {
  parseProgram,
  planProgram,
  pose,
  robotById,
  robotFromArm,
  slideLimits,
  trackingError,
  type Control,
  type Program,
  type Robot,
  type TrackingOptions,
  type TrackingRow,
} from "../../index.ts";

function programOf(robot: Robot, steps: readonly object[]): Program {
  const answer = parseProgram({
    format: "twincell.program",
    version: 1,
    robot: robot.id,
    tools: {},
    frames: {},
    steps,
  });
  if (answer.kind !== "program") throw new Error(answer.faults[0]!.sentence);
  return answer.program;
}
function rowsOf(robot: Robot, program: Program, options: TrackingOptions): readonly TrackingRow[] {
  const planned = planProgram(program, robot);
  const answer = trackingError(planned.plan, robot, program, options);
  if (answer.kind === "unknown") throw new Error(answer.sentence);
  return answer.rows;
}

describe("accuracy over speed", () => {
  const ur10e = robotById("ur10e")!;
  const drives: Control = { kind: "drives", bandwidth_rad_s: 60 };
  const reach = (kg: number): Program =>
    programOf(ur10e, [
      { id: "load", type: "payload", mass_kg: kg, center_m: [0, 0, 0.1] },
      {
        id: "a",
        type: "move",
        path: "ptp",
        target: { q: [0.8, -1.2, 1.9, -1.8, -1.4, 0.5] },
        speed: { ratio: 0.5 },
        blend_m: 0,
        acceleration: { ratio: 0.3 },
      },
    ]);

  test("drives are off by more, the faster they go; computed torque by far less; a load it does not know shows", () => {
    const overrides = [0.25, 0.5, 1];
    const rows = rowsOf(ur10e, reach(3), { control: drives, overrides, step_s: 1e-3 });
    expect(rows.map(({ override }) => override)).toEqual(overrides);
    expect(rows[1]!.worst_m).toBeGreaterThan(2 * rows[0]!.worst_m);
    expect(rows[2]!.worst_m).toBeGreaterThan(2 * rows[1]!.worst_m);
    expect(rows[2]!.rms_m).toBeLessThan(rows[2]!.worst_m);
    expect(rows[0]!.duration_s).toBeCloseTo(4 * rows[2]!.duration_s, 12);
    const law: Control = { kind: "computed-torque", bandwidth_rad_s: 60 };
    const [known] = rowsOf(ur10e, reach(3), { control: law, overrides: [1], step_s: 1e-3 });
    const [unknown] = rowsOf(ur10e, reach(3), { control: law, overrides: [1], step_s: 1e-3, loadUnknown: true });
    expect(known!.worst_m).toBeLessThan(0.2 * rows[2]!.worst_m);
    expect(unknown!.worst_m).toBeGreaterThan(5 * known!.worst_m);
  });

  test("what is asked beyond the torque limits is lost, and said", () => {
    const [free, full] = [0.5, 5].map(
      override => rowsOf(ur10e, reach(10), { control: drives, overrides: [override], step_s: 1e-3 })[0]!,
    );
    expect(free!.saturated_s).toBe(0);
    expect(full!.saturated_s).toBeGreaterThan(0);
    expect(full!.worst_m).toBeGreaterThan(0.02);
  });

  test("a weight on a level slide lags by a / ω² while it accelerates, at override s by s² as much", () => {
    const slide = robotFromArm(
      {
        name: "slide",
        joints: [
          {
            name: "x",
            kind: "prismatic",
            axis: [1, 0, 0],
            parentFromJoint: pose(),
            limits: slideLimits({
              lower_m: -1,
              upper_m: 3,
              speed_mps: 1,
              acceleration_mps2: 2,
              jerk_mps3: 100,
              force_N: 1e4,
            }),
          },
        ],
        lastJointFromFlange: pose(),
      },
      { masses: [{ mass_kg: 7, linkFromCentre: pose<"link", "centre">(), inertia_kgm2: [0, 0, 0, 0, 0, 0] }] },
    );
    const program = programOf(slide, [
      { id: "a", type: "move", path: "ptp", target: { q: [2] }, speed: { ratio: 1 }, blend_m: 0 },
    ]);
    const omega = 100;
    for (const row of rowsOf(slide, program, {
      control: { kind: "drives", bandwidth_rad_s: omega },
      overrides: [1, 0.5],
    })) {
      expect(row.worst_m / ((2 * row.override ** 2) / omega ** 2)).toBeCloseTo(1, 1);
      expect(row.worstJoint_rad).toBeCloseTo(row.worst_m, 12);
    }
    // Gains of one's own: the same spring and damper, a level slide has no weight to hold.
    const own: Control = {
      kind: "gains",
      gains: [{ stiffness: 7 * omega ** 2, damping: 14 * omega, torqueMax_Nm: 1e4 }],
    };
    expect(rowsOf(slide, program, { control: own, overrides: [1] })[0]!.worst_m).toBeCloseTo(
      rowsOf(slide, program, { control: { kind: "drives", bandwidth_rad_s: omega }, overrides: [1] })[0]!.worst_m,
      12,
    );
  });

  test("unknown where masses are", () => {
    const rx90l = robotById("staubli_rx90l")!;
    const program = programOf(rx90l, [{ id: "w", type: "wait", s: 1 }]);
    expect(
      trackingError(planProgram(program, rx90l).plan, rx90l, program, { control: drives, overrides: [1] }).kind,
    ).toBe("unknown");
  });
});
