import { describe, expect, test } from "vitest";
import {
  checkProgram,
  dynamicsModel,
  inverseDynamics,
  judgePlan,
  LIBRARY,
  loadsAlong,
  parseProgram,
  planProgram,
  robotById,
  samplePlan,
  shareWithin,
  torqueProfile,
  type Plan,
  type Program,
  type Robot,
} from "../../index.ts";

const ur10e = robotById("ur10e")!;
const gp8 = robotById("yaskawa_gp8")!;
const OUT = [0.2, -0.15, 0.1, -1.5, -1.5, 0];
const UP = [0.2, -1.6, 0.1, -1.5, -1.5, 0];
interface Case {
  readonly kg: number;
  readonly ratio?: number;
  readonly acceleration?: number;
  readonly robot?: Robot;
  readonly steps?: readonly object[];
}

/** A stretched arm swung up and down with a load 0.1 m in front of the flange. */
function swing({ kg, ratio = 1, acceleration, robot = ur10e, steps }: Case): Program {
  const move = (id: string, q: readonly number[], more: object = {}): object => ({
    id,
    type: "move",
    path: "ptp",
    target: { q },
    speed: { ratio },
    blend_m: 0,
    ...(acceleration === undefined ? {} : { acceleration: { ratio: acceleration } }),
    ...more,
  });
  const answer = parseProgram({
    format: "twincell.program",
    version: 1,
    robot: robot.id,
    tools: {},
    frames: {},
    steps: steps ?? [
      { id: "load", type: "payload", mass_kg: kg, center_m: [0, 0, 0.1] },
      move("up", UP),
      move("out", OUT),
      move("back", UP),
    ],
  });
  if (answer.kind !== "program") throw new Error(answer.faults[0]!.sentence);
  return answer.program;
}
const START = { start_rad: UP };
const gentle = (each: Case) => planProgram(swing(each), ur10e, { ...START, withinTorque: {} });

/** Greatest |torque| / limit by plain differences of the sampled plan: another way than the cubics'. */
function loadOf(plan: Plan, kg: number): number {
  const answer = dynamicsModel(ur10e, { payload: { mass_kg: kg, center_m: [0, 0, 0.1] } });
  if (answer.kind === "unknown") throw new Error(answer.sentence);
  const h = 1e-4;
  const q = new Float64Array(6);
  const qd = q.slice();
  const ahead = q.slice();
  const behind = q.slice();
  const none = q.slice();
  let most = 0;
  for (let t = 0.002; t < plan.duration_s - 0.002; t += 0.005) {
    samplePlan(plan, t + h, none, ahead);
    samplePlan(plan, t - h, none, behind);
    samplePlan(plan, t, q, qd);
    inverseDynamics(
      answer.model,
      q,
      qd,
      ahead.map((v, j) => (v - behind[j]!) / (2 * h)),
    ).forEach((torque, j) => {
      most = Math.max(most, Math.abs(torque) / ur10e.arm.joints[j]!.limits.torque_Nm!);
    });
  }
  return most;
}

describe("X-10, M-48 speed reflects joint torque limits", () => {
  test("a heavier load is flagged with the joint and its torque, and the repair holds", () => {
    const free = checkProgram(swing({ kg: 0 }), ur10e, { start_rad: UP });
    const heavy = checkProgram(swing({ kg: 10 }), ur10e, { start_rad: UP });
    if (free.verdict.torque.kind === "unknown" || heavy.verdict.torque.kind === "unknown")
      throw new Error("The masses of the UR10e are published.");
    expect(free.verdict.torque.joints).toHaveLength(6);
    expect(heavy.verdict.torque.sentence).toMatch(/^Joint 3 is asked most: 229\.3 of 150\.0 N m at \d\.\d\d s\.$/);
    const found = heavy.verdict.steps
      .flatMap(step => step.findings.map(finding => ({ step: step.id, ...finding })))
      .filter(({ code }) => code === "torque.joint");
    expect(found.length).toBeGreaterThan(0);
    const finding = found[0]!;
    const joint = heavy.verdict.torque.joints[finding.joint! - 1]!;
    expect(finding.unit).toBe("Nm");
    expect(finding.value).toBeGreaterThan(finding.limit);
    expect(finding.limit).toBe(ur10e.arm.joints[finding.joint! - 1]!.limits.torque_Nm);
    expect(Math.abs(joint.torque_Nm)).toBeGreaterThan(
      Math.abs(free.verdict.torque.joints[finding.joint! - 1]!.torque_Nm),
    );
    expect(finding.sentence).toMatch(/^Joint \d would need [\d.]+ N m with 10 kg; its limit is [\d.]+ N m\.$/);
    // Every repair that changes the step makes the torque finding go away.
    const program = swing({ kg: 10 });
    const mended: Program = {
      ...program,
      steps: program.steps.map(
        step => found.find(each => each.step === step.id)?.repairs.find(repair => repair.replace)?.replace ?? step,
      ),
    };
    expect(
      checkProgram(mended, ur10e, { start_rad: UP })
        .verdict.steps.flatMap(step => step.findings)
        .filter(({ code }) => code.startsWith("torque")),
    ).toEqual([]);
    const lighter = finding.repairs
      .map(({ sentence }) => /^Carry at most ([\d.]+) kg/.exec(sentence)?.[1])
      .find(kg => kg !== undefined);
    expect(Number(lighter)).toBeGreaterThan(0);
    const least = Math.min(
      ...found.map(({ repairs }) =>
        Number(
          repairs.map(({ sentence }) => /^Carry at most ([\d.]+) kg/.exec(sentence)?.[1]).find(kg => kg !== undefined),
        ),
      ),
    );
    expect(
      checkProgram(swing({ kg: least }), ur10e, { start_rad: UP })
        .verdict.steps.flatMap(step => step.findings)
        .filter(({ code }) => code.startsWith("torque")),
    ).toEqual([]);
  });

  test("planned within torques, 10 kg takes longer than nothing, and every torque fits", () => {
    const empty = gentle({ kg: 0 });
    const heavy = gentle({ kg: 10 });
    const asTaught = planProgram(swing({ kg: 10 }), ur10e, START);
    expect([empty.kind, heavy.kind]).toEqual(["planned", "planned"]);
    expect(heavy.plan.duration_s).toBeGreaterThan(1.02 * empty.plan.duration_s);
    expect(loadOf(asTaught.plan, 10)).toBeGreaterThan(1);
    expect(loadOf(heavy.plan, 10)).toBeLessThanOrEqual(1);
    expect(judgePlan(heavy.plan, ur10e)).toEqual([]);
    expect(
      heavy.gentled.every(({ share, peak }) => share > 0 && share < 1 && Math.abs(peak.torque_Nm) > peak.limit_Nm),
    ).toBe(true);
    expect(empty.plan.duration_s).toBeGreaterThanOrEqual(planProgram(swing({ kg: 0 }), ur10e, START).plan.duration_s);
  });

  test("what is not published is unknown, and never ok", () => {
    for (const robot of LIBRARY) {
      const program = swing({ kg: 0, robot, steps: [{ id: "stay", type: "wait", s: 0.1 }] });
      const { torque } = checkProgram(program, robot).verdict;
      const known =
        robot.masses !== undefined &&
        robot.arm.joints.some(({ limits }) => limits.torque_Nm !== undefined) &&
        robot.masses.every(({ inertia_kgm2 }) => inertia_kgm2 !== undefined);
      expect(torque.kind, robot.id).toBe(known ? "known" : "unknown");
      if (torque.kind === "unknown")
        expect(torque.sentence).toMatch(/^The torques of .* (are unknown|cannot be judged): .*\.$/);
    }
    const bare: Robot = {
      ...ur10e,
      arm: {
        ...ur10e.arm,
        joints: ur10e.arm.joints.map(({ limits: { torque_Nm: _, ...limits }, ...joint }) => ({ ...joint, limits })),
      },
    };
    expect(checkProgram(swing({ kg: 5 }), bare, { start_rad: UP }).verdict.torque).toEqual({
      kind: "unknown",
      sentence: "The torques of Universal Robots UR10e cannot be judged: what its joints can give is not published.",
    });
  });

  test("a load whose weight alone is too much cannot be slowed away", () => {
    const stuck = gentle({ kg: 60 });
    if (stuck.kind !== "stuck") throw new Error("60 kg were carried.");
    expect(stuck.stuck).toMatchObject({ code: "torque.weight" });
    expect(stuck.stuck.sentence).toMatch(
      /the weight of the arm with 60 kg asks [\d.]+ N m of joint 3; its limit is 150\.0 N m\.$/,
    );
    const finding = checkProgram(swing({ kg: 60 }), ur10e, { start_rad: UP })
      .verdict.steps.flatMap(step => step.findings)
      .find(({ code }) => code === "torque.weight");
    expect(finding).toMatchObject({ joint: 3, limit: 150, unit: "Nm" });
  });
});

describe("X-46 the programmed speed is adjusted so that the robot can hold it", () => {
  test("what is slow enough stays as it was programmed, to the bit", () => {
    const slow = { kg: 10, ratio: 0.1, acceleration: 0.05 };
    const held = gentle(slow);
    expect(held.gentled).toEqual([]);
    expect(held.plan).toEqual(planProgram(swing(slow), ur10e, START).plan);
  });
  test("what is too fast is slowed by no more than it must: one joint comes to its limit", () => {
    const heavy = gentle({ kg: 10 });
    expect(heavy.gentled.length).toBeGreaterThan(0);
    expect(loadOf(heavy.plan, 10)).toBeGreaterThan(0.97);
  });
  test("the load counts from its step on", () => {
    const late = (kg: number) =>
      gentle({
        kg,
        steps: [
          { id: "a", type: "move", path: "ptp", target: { q: OUT }, speed: { ratio: 1 }, blend_m: 0 },
          { id: "load", type: "payload", mass_kg: kg, center_m: [0, 0, 0.1] },
          { id: "b", type: "move", path: "ptp", target: { q: UP }, speed: { ratio: 1 }, blend_m: 0 },
        ],
      }).plan;
    expect(late(10).segments[0]!.duration_s).toBe(late(0).segments[0]!.duration_s);
    expect(late(10).segments[2]!.duration_s).toBeGreaterThan(late(0).segments[2]!.duration_s);
    const program = swing({ kg: 4 });
    const { plan } = planProgram(program, ur10e, START);
    expect(loadsAlong(plan, program).map(load => load?.mass_kg)).toEqual([4, 4, 4, 4]);
  });
});

test("torques along a plan for a plot: standing still they are those of inverse dynamics, with the limits beside them", () => {
  const program = swing({ kg: 3 });
  const { plan } = planProgram(program, ur10e, START);
  const profile = torqueProfile(plan, ur10e, program);
  if (profile.kind === "unknown") throw new Error(profile.sentence);
  expect(Array.from(profile.limits_Nm)).toEqual([330, 330, 150, 54, 54, 54]);
  expect(profile.torque_Nm.length).toBe(6 * profile.times_s.length);
  for (let i = 1; i < profile.times_s.length; i++)
    expect(profile.times_s[i]!).toBeGreaterThanOrEqual(profile.times_s[i - 1]!);
  // Standing still at the start: the weight of arm and load, from statics.
  const answer = dynamicsModel(ur10e, { payload: { mass_kg: 3, center_m: [0, 0, 0.1] } });
  if (answer.kind === "unknown") throw new Error(answer.sentence);
  inverseDynamics(answer.model, UP, new Float64Array(6), new Float64Array(6)).forEach((torque, j) => {
    expect(profile.torque_Nm[j]!).toBeCloseTo(torque, 9);
  });
  expect(torqueProfile(plan, gp8, program).kind).toBe("unknown");
});

test("a share of speed that fits, by the equation it stands for", () => {
  for (const [torque, weight, limit] of [
    [100, 20, 60],
    [-100, 20, 60],
    [80, -50, 60],
    [-61, -59, 60],
  ] as const) {
    const s = shareWithin(torque, weight, limit);
    expect(Math.abs(weight + (torque - weight) * s * s)).toBeCloseTo(limit, 9);
  }
  expect(shareWithin(59, 0, 60)).toBe(1);
  expect(shareWithin(70, 61, 60)).toBe(0);
});
