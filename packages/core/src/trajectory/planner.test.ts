import { describe, expect, test } from "vitest";
import { flangePose } from "../kinematics/forward.ts";
import { seededRandom } from "../random.ts";
import { jerkOf } from "../model/jerk.ts";
import { robotById } from "../robots/library/index.ts";
import { compose, type Pose } from "../spatial/pose.ts";
import { angleBetween, fromAxisAngle, multiply, slerp, type Quaternion } from "../spatial/quaternion.ts";
import { distance, normalize, subtract, type Vector3 } from "../spatial/vector.ts";
import { emptyProgram, type MoveStep, type Program, type Step } from "../program/program.ts";
import { JerkMotion, JerkPlanner } from "./jerk/index.ts";
import { judgePlan } from "./judge.ts";
import { cubicLaw, sCurve, sCurveTime_s, trapezoid, trapezoidTime_s } from "./laws.ts";
import type { MotionSegment, Plan } from "./plan.ts";
import { planProgram } from "./planner.ts";
import { planPath, POINT_BEYOND_LIMIT } from "./plan-path.ts";
import { PlanCursor, samplePlan, segmentAt } from "./sample.ts";

const robot = robotById("staubli_rx90l")!;
const TORCH: Pose<"flange", "tcp"> = { position: [0.02, 0, 0.15], quaternion: fromAxisAngle([0, 1, 0], 0.3) };
const DOWN: Quaternion = [1, 0, 0, 0];

const at = (position: Vector3, quaternion: Quaternion = DOWN): MoveStep["target"] => ({
  pose: { position, quaternion },
  frame: "world",
  tool: "torch",
});
const move = (
  id: string,
  path: MoveStep["path"],
  target: MoveStep["target"],
  speed: MoveStep["speed"],
  blend_m = 0,
  via?: MoveStep["target"],
): MoveStep => ({ id, type: "move", path, target, speed, blend_m, ...(via === undefined ? {} : { via }) });
const programOf = (steps: readonly Step[]): Program => ({ ...emptyProgram(robot.id), tools: { torch: TORCH }, steps });

function planOf(steps: readonly Step[]): Plan {
  const answer = planProgram(programOf(steps), robot);
  if (answer.kind === "stuck") throw new Error(`${answer.stuck.step}: ${answer.stuck.sentence}`);
  return answer.plan;
}
const motionOf = (plan: Plan, step: string): MotionSegment => {
  const found = plan.segments.find(segment => segment.step === step);
  if (found?.kind !== "motion") throw new Error(`${step} does not move.`);
  return found;
};
function tcpAt(plan: Plan, t_s: number): Pose<"base", "tcp"> {
  const q = new Float64Array(6);
  samplePlan(plan, t_s, q);
  return compose(flangePose(robot.arm, q), TORCH);
}
/** The TCP at `looks` + 1 instants of a step. */
const along = (plan: Plan, step: string, looks: number): Pose[] => {
  const { start_s, duration_s } = motionOf(plan, step);
  return Array.from({ length: looks + 1 }, (_, k) => tcpAt(plan, start_s + (duration_s * k * (1 - 1e-12)) / looks));
};

const START = move("start", "ptp", at([0.6, 0, 0.3]), { ratio: 1 });

test("a passed joint move to where the robot already stands takes no time and spoils nothing after it", () => {
  const home = robot.home_rad;
  const next = home.map(angle => angle + 0.1);
  const plan = planOf([
    move("here", "ptp", { q: home }, { mps: 0.1 }, 0.001),
    move("there", "ptp", { q: next }, { mps: 0.1 }, 0.001),
    move("still", "ptp", { q: next }, { mps: 0.1 }, 0.001),
    move("back", "ptp", { q: home }, { mps: 0.1 }),
  ]);
  const straight = planOf([
    move("there", "ptp", { q: next }, { mps: 0.1 }),
    move("back", "ptp", { q: home }, { mps: 0.1 }),
  ]);
  expect(Math.abs(plan.duration_s / straight.duration_s - 1)).toBeLessThan(0.01);
  expect(plan.segments.every(segment => segment.kind === "motion" && segment.q_rad.every(Number.isFinite))).toBe(true);
});

describe("laws of motion", () => {
  test("G-07 L-51 the cubic: π(½) = ½, π̇(½) = 1.5, π̈(0) = 6, at rest at both ends", () => {
    expect(cubicLaw(0.5)).toEqual({ value: 0.5, speed: 1.5, acceleration: 0 });
    expect(cubicLaw(0)).toEqual({ value: 0, speed: 0, acceleration: 6 });
    expect(cubicLaw(1)).toEqual({ value: 1, speed: 0, acceleration: -6 });
  });

  test("the trapezoid meets its limits and its closed-form time", () => {
    const random = seededRandom(5);
    for (let k = 0; k < 200; k++) {
      const way = random() * 3 + 1e-3;
      const v = random() * 4 + 0.1;
      const a = random() * 20 + 0.1;
      const law = trapezoid(way, v, a);
      expect(law.times_s.at(-1)).toBeCloseTo(trapezoidTime_s(way, v, a), 10);
      expect(law.place.at(-1)).toBe(way);
      expect(Math.max(...law.speed)).toBeLessThanOrEqual(v * (1 + 1e-12));
      for (let i = 1; i < law.times_s.length; i++) {
        const dt = law.times_s[i]! - law.times_s[i - 1]!;
        expect(dt).toBeGreaterThan(0);
        expect(Math.abs(law.speed[i]! - law.speed[i - 1]!) / dt).toBeLessThanOrEqual(a * (1 + 1e-9));
        expect(((law.speed[i]! + law.speed[i - 1]!) / 2) * dt).toBeCloseTo(law.place[i]! - law.place[i - 1]!, 10);
      }
    }
  });

  test("the rounded trapezoid meets its limits, and is as fast as the profile planner's", () => {
    const random = seededRandom(6);
    const motion = new JerkMotion(1);
    for (let k = 0; k < 300; k++) {
      const way = random() ** 3 * 3 + 1e-6;
      const v = random() * 4 + 0.1;
      const a = random() * 20 + 0.1;
      const j = random() * 200 + 1;
      const law = sCurve(way, v, a, j);
      new JerkPlanner([{ speed: v, acceleration: a, jerk: j }]).plan({ place: [0] }, { place: [way] }, motion);
      expect(Math.abs(law.times_s.at(-1)! / motion.duration_s - 1)).toBeLessThan(1e-9);
      let before = 0;
      for (let i = 1; i < law.times_s.length; i++) {
        const h = law.times_s[i]! - law.times_s[i - 1]!;
        const rise = (law.place[i]! - law.place[i - 1]!) / h;
        const v0 = law.speed[i - 1]!;
        const v1 = law.speed[i]!;
        const a0 = (6 * rise - 4 * v0 - 2 * v1) / h;
        const a1 = (-6 * rise + 2 * v0 + 4 * v1) / h;
        expect(Math.abs(v1)).toBeLessThan(v * (1 + 1e-9));
        expect(Math.max(Math.abs(a0), Math.abs(a1))).toBeLessThan(a * (1 + 1e-6));
        expect(Math.abs(a1 - a0) / h).toBeLessThan(j * (1 + 1e-5));
        expect(Math.abs(a0 - before)).toBeLessThan(a * 1e-5);
        before = a1;
      }
      expect(law.place.at(-1)).toBe(way);
    }
  });
});

describe("planProgram", () => {
  test("L-50 a straight move stays within 1 µm of its line and turns at an even rate", () => {
    const to = multiply(fromAxisAngle([0, 0, 1], 0.6), DOWN);
    const plan = planOf([START, move("line", "lin", at([0.5, 0.35, 0.45], to), { mps: 0.25 })]);
    const a: Vector3 = [0.6, 0, 0.3];
    const direction = normalize(subtract([0.5, 0.35, 0.45], a));
    const length = distance(a, [0.5, 0.35, 0.45]);
    let worst = 0;
    let twist = 0;
    let before = 0;
    for (const { position, quaternion } of along(plan, "line", 700)) {
      const way = subtract(position, a);
      const s = way[0] * direction[0] + way[1] * direction[1] + way[2] * direction[2];
      worst = Math.max(
        worst,
        distance(position, [a[0] + direction[0] * s, a[1] + direction[1] * s, a[2] + direction[2] * s]),
      );
      twist = Math.max(twist, angleBetween(quaternion, slerp(DOWN, to, Math.min(1, Math.max(0, s / length)))));
      expect(s).toBeGreaterThanOrEqual(before - 1e-9);
      before = s;
    }
    expect(worst).toBeLessThan(1e-6);
    expect(twist).toBeLessThan(1e-5);
    expect(before).toBeCloseTo(length, 9);
  });

  test("N-19 between two poses the tool goes at the given speed and never jumps: no step is longer or turns further than that speed allows", () => {
    const to = multiply(fromAxisAngle([0, 0, 1], 0.6), DOWN);
    const mps = 0.2;
    const plan = planOf([START, move("line", "lin", at([0.5, 0.35, 0.45], to), { mps })]);
    const { duration_s } = motionOf(plan, "line");
    const poses = along(plan, "line", 2000);
    const dt_s = duration_s / 2000;
    const length = distance(poses[0]!.position, poses.at(-1)!.position);
    let fastest = 0;
    let turning = 0;
    for (let i = 1; i < poses.length; i++) {
      fastest = Math.max(fastest, distance(poses[i - 1]!.position, poses[i]!.position) / dt_s);
      turning = Math.max(turning, angleBetween(poses[i - 1]!.quaternion, poses[i]!.quaternion) / dt_s);
    }
    expect(fastest).toBeLessThan(mps * 1.001);
    expect(fastest).toBeGreaterThan(mps * 0.999);
    expect(turning).toBeLessThan((0.6 / length) * mps * 1.01);
    expect(angleBetween(poses.at(-1)!.quaternion, to)).toBeLessThan(1e-6);
  });

  test("a straight move runs at its speed, and its time is distance over speed plus the ramps", () => {
    const plan = planOf([START, move("line", "lin", at([0.6, 0.3, 0.3]), { mps: 0.2 })]);
    const { start_s, duration_s } = motionOf(plan, "line");
    expect(duration_s).toBeGreaterThan(1.5);
    // Two ramps with a jerk limit: about 2 √(v/j) each, half of it on top of the even run.
    expect(duration_s).toBeLessThan(1.6);
    const h = 1e-4;
    const middle = start_s + duration_s / 2;
    expect(distance(tcpAt(plan, middle - h).position, tcpAt(plan, middle + h).position) / (2 * h)).toBeCloseTo(0.2, 5);
  });

  test("a circular move keeps its radius and passes its via point", () => {
    const plan = planOf([START, move("arc", "circ", at([0.4, 0, 0.3]), { mps: 0.2 }, 0, at([0.5, 0.1, 0.3]))]);
    let via = Number.POSITIVE_INFINITY;
    for (const { position } of along(plan, "arc", 600)) {
      expect(Math.abs(distance(position, [0.5, 0, 0.3]) - 0.1)).toBeLessThan(1e-6);
      via = Math.min(via, distance(position, [0.5, 0.1, 0.3]));
    }
    expect(via).toBeLessThan(3e-4);
  });

  test("a spline passes all its points without stopping", () => {
    const points: Vector3[] = [
      [0.55, 0.1, 0.35],
      [0.5, 0.2, 0.3],
      [0.55, 0.3, 0.35],
    ];
    const plan = planOf([START, ...points.map((point, i) => move(`p${i}`, "spline", at(point), { mps: 0.2 }))]);
    for (let i = 0; i < points.length; i++) {
      const { start_s, duration_s } = motionOf(plan, `p${i}`);
      const end = start_s + duration_s;
      expect(distance(tcpAt(plan, end).position, points[i]!)).toBeLessThan(1e-6);
      if (i < 2)
        expect(distance(tcpAt(plan, end - 1e-3).position, tcpAt(plan, end + 1e-3).position) / 2e-3).toBeGreaterThan(
          0.1,
        );
    }
  });

  test("a blend stays within its distance of the corner, keeps the lines outside it, and does not stop", () => {
    const blend = 0.03;
    const corner: Vector3 = [0.6, 0.25, 0.3];
    const plan = planOf([
      START,
      move("a", "lin", at(corner), { mps: 0.2 }, blend),
      move("b", "lin", at([0.45, 0.25, 0.4]), { mps: 0.2 }),
    ]);
    const { start_s, duration_s } = motionOf(plan, "a");
    const corner_s = start_s + duration_s;
    expect(distance(tcpAt(plan, corner_s).position, corner)).toBeLessThan(blend / 2);
    for (const { position } of along(plan, "a", 400)) {
      // Until the blend begins, y alone changes.
      if (distance(position, corner) > blend + 1e-6)
        expect(Math.hypot(position[0] - 0.6, position[2] - 0.3)).toBeLessThan(1e-6);
    }
    let slowest = Number.POSITIVE_INFINITY;
    for (let k = -50; k <= 50; k++)
      slowest = Math.min(
        slowest,
        distance(tcpAt(plan, corner_s + k * 2e-3).position, tcpAt(plan, corner_s + k * 2e-3 + 1e-4).position) / 1e-4,
      );
    expect(slowest).toBeGreaterThan(0.1);
  });

  test("points in line are passed at full speed and are met", () => {
    const steps = [
      START,
      ...Array.from({ length: 20 }, (_, i) =>
        move(`p${i}`, "lin", at([0.6, 0.01 * (i + 1), 0.3]), { mps: 0.1 }, 0.005),
      ),
    ];
    const plan = planOf(steps);
    expect(plan.duration_s - motionOf(plan, "p0").start_s).toBeLessThan(0.2 / 0.1 + 0.065);
    for (let i = 0; i < 20; i++) {
      const { start_s, duration_s } = motionOf(plan, `p${i}`);
      expect(distance(tcpAt(plan, start_s + duration_s).position, [0.6, 0.01 * (i + 1), 0.3])).toBeLessThan(1e-6);
    }
  });

  test("L-53 time_s is the duration, halving it doubles the speed; a time too short is not kept and names the joint", () => {
    for (const path of ["ptp", "lin"] as const) {
      for (const time_s of [4, 2])
        expect(motionOf(planOf([START, move("m", path, at([0.6, 0.3, 0.3]), { time_s })]), "m").duration_s).toBeCloseTo(
          time_s,
          9,
        );
    }
    const answer = planProgram(programOf([START, move("m", "lin", at([0.6, 0.3, 0.3]), { time_s: 0.05 })]), robot);
    expect(answer.notes).toHaveLength(1);
    expect(answer.notes[0]!.slowed).toMatchObject({ unit: "rad/s" });
    expect(answer.notes[0]!.slowed.wanted).toBeGreaterThan(answer.notes[0]!.slowed.limit);
  });

  test("time_s holds inside a blended run as well", () => {
    const plan = planOf([
      START,
      move("a", "lin", at([0.6, 0.2, 0.3]), { time_s: 1.5 }, 0.02),
      move("b", "lin", at([0.6, 0.2, 0.45]), { time_s: 2.5 }),
    ]);
    expect(motionOf(plan, "a").duration_s).toBeCloseTo(1.5, 2);
    expect(motionOf(plan, "b").duration_s).toBeCloseTo(2.5, 2);
  });

  test("a joint move is as fast as its slowest joint, and all joints arrive together", () => {
    const q: number[] = [1, -1, 2, 0.5, 0.6, -2];
    const plan = planOf([move("m", "ptp", { q }, { ratio: 1 })]);
    const { duration_s } = motionOf(plan, "m");
    const alone = robot.arm.joints.map(({ limits }, j) =>
      sCurveTime_s(
        Math.abs(q[j]! - robot.home_rad[j]!),
        limits.speed_rad_s,
        limits.acceleration_rad_s2,
        jerkOf(limits),
      ),
    );
    expect(duration_s).toBeGreaterThanOrEqual(Math.max(...alone));
    expect(duration_s).toBeLessThan(Math.max(...alone) * 1.02);
    const configuration = new Float64Array(6);
    samplePlan(plan, duration_s / 2, configuration);
    for (let j = 0; j < 6; j++) expect(configuration[j]).toBeCloseTo((q[j]! + robot.home_rad[j]!) / 2, 9);
  });

  test("every plan says what its duration rests on", () => {
    const answer = planProgram(programOf([START]), robot);
    expect(answer.assumptions).toEqual(
      expect.arrayContaining([
        ...robot.assumptions,
        "Joint jerks are not published: full joint acceleration is assumed to be reached in 0.1 s.",
      ]),
    );
    const known = {
      ...robot,
      arm: {
        ...robot.arm,
        joints: robot.arm.joints.map(joint => ({ ...joint, limits: { ...joint.limits, jerk_rad_s3: 1000 } })),
      },
    };
    expect(planProgram(programOf([START]), known).assumptions).toEqual(robot.assumptions);
  });

  test.each([
    ["joint move", "ptp", { ratio: 1 }, 1.001],
    ["slow line", "lin", { mps: 0.1 }, 1.05],
    ["fast line", "lin", { mps: 3 }, 1.05],
  ] as const)("a %s keeps the joints' jerk, by third differences of its angles", (_, path, speed, slack) => {
    // Radially outwards, where joint speeds are nearly in proportion to the speed along the path.
    const plan = planOf([START, move("m", path, at([0.5, 0, 0.3]), speed)]);
    const { start_s, duration_s } = motionOf(plan, "m");
    const h = 5e-3;
    const rows = Array.from({ length: Math.floor(duration_s / h) + 1 }, (_row, k) => {
      const q = new Float64Array(6);
      samplePlan(plan, start_s + k * h, q);
      return q;
    });
    let load = 0;
    for (let k = 3; k < rows.length; k++) {
      for (let j = 0; j < 6; j++)
        load = Math.max(
          load,
          Math.abs(rows[k]![j]! - 3 * rows[k - 1]![j]! + 3 * rows[k - 2]![j]! - rows[k - 3]![j]!) /
            h ** 3 /
            jerkOf(robot.arm.joints[j]!.limits),
        );
    }
    expect(load).toBeLessThan(slack);
    expect(load).toBeGreaterThan(0.3);
  });

  test("less acceleration makes a move longer and keeps to it", () => {
    for (const path of ["ptp", "lin"] as const) {
      const full = motionOf(planOf([START, move("m", path, at([0.5, 0.2, 0.3]), { ratio: 1 })]), "m");
      const half = motionOf(
        planOf([START, { ...move("m", path, at([0.5, 0.2, 0.3]), { ratio: 1 }), acceleration: { ratio: 0.3 } }]),
        "m",
      );
      expect(half.duration_s).toBeGreaterThan(full.duration_s * 1.15);
    }
  });

  test("a frame that moves takes the path along", () => {
    const shift: Vector3 = [0.05, 0.1, -0.05];
    const framed = (target: MoveStep["target"]): MoveStep["target"] =>
      "pose" in target ? { ...target, frame: "table" } : target;
    const steps = [
      move("a", "ptp", framed(at([0.55, 0, 0.35])), { ratio: 1 }),
      move("b", "lin", framed(at([0.5, 0.2, 0.4])), { mps: 0.2 }),
    ];
    const answer = planProgram(
      { ...programOf(steps), frames: { table: { position: shift, quaternion: [0, 0, 0, 1] } } },
      robot,
    );
    expect(answer.kind).toBe("planned");
    expect(distance(tcpAt(answer.plan, answer.plan.duration_s).position, [0.55, 0.3, 0.35])).toBeLessThan(1e-6);
    const based = planProgram(programOf([START]), robot, {
      worldFromBase: { position: [0, 0, -0.2], quaternion: [0, 0, 0, 1] },
    });
    expect(distance(tcpAt(based.plan, based.plan.duration_s).position, [0.6, 0, 0.5])).toBeLessThan(1e-6);
  });

  test("a program that cannot go on says which step and why, and has the plan up to there", () => {
    const answer = planProgram(
      programOf([
        START,
        move("far", "lin", at([1.6, 0, 0.3]), { mps: 0.2 }),
        move("after", "ptp", at([0.5, 0, 0.3]), { ratio: 1 }),
      ]),
      robot,
    );
    expect(answer.kind).toBe("stuck");
    if (answer.kind === "stuck") expect(answer.stuck).toMatchObject({ step: "far", code: "reach.path" });
    expect(answer.plan.segments.map(segment => segment.step)).toEqual(["start"]);
    const limit = planProgram(programOf([move("m", "ptp", { q: [0, -1, 2, 0, 2.5, 0] }, { ratio: 1 })]), robot);
    expect(limit).toMatchObject({
      kind: "stuck",
      stuck: {
        code: "limits.joint",
        sentence: expect.stringMatching(/joint 5 would turn to 1.*°; its limit is 120\.0°\.$/) as unknown,
      },
    });
  });

  test("waits and the gripper stand still", () => {
    const plan = planOf([
      START,
      { id: "w", type: "wait", s: 0.7 },
      { id: "g", type: "gripper", closed: true },
      { id: "w2", type: "wait", s: 0.1 },
    ]);
    expect(plan.segments.map(({ kind, duration_s }) => [kind, duration_s])).toEqual([
      ["motion", motionOf(plan, "start").duration_s],
      ["rest", 0.7],
      ["rest", 0.2],
      ["rest", 0.1],
    ]);
    const cursor = new PlanCursor(plan);
    const q = new Float64Array(6);
    expect(cursor.at(motionOf(plan, "start").duration_s + 0.1, q)).toMatchObject({
      step: "w",
      gripperClosed: false,
      moving: false,
    });
    expect(cursor.at(plan.duration_s, q)).toMatchObject({ step: "w2", gripperClosed: true });
  });
});

describe("plans of random programs", () => {
  /** Poses around a free place in front of the arm; joint targets around the same posture. */
  function randomProgram(seed: number): Step[] {
    const random = seededRandom(seed);
    const between = (a: number, b: number): number => a + (b - a) * random();
    const pose = (): MoveStep["target"] =>
      at(
        [between(0.4, 0.65), between(-0.3, 0.3), between(0.25, 0.5)],
        multiply(fromAxisAngle(normalize([between(-1, 1), between(-1, 1), between(-1, 1)]), between(0, 0.4)), DOWN),
      );
    const steps: Step[] = [move("s0", "ptp", pose(), { ratio: 1 })];
    for (let i = 1; i < 14; i++) {
      const pick = random();
      const blend = random() < 0.6 ? between(0.001, 0.05) : 0;
      const speed: MoveStep["speed"] =
        random() < 0.5
          ? { mps: between(0.05, 2) }
          : random() < 0.5
            ? { ratio: between(0.1, 1) }
            : { time_s: between(0.1, 3) };
      if (pick < 0.1) steps.push({ id: `s${i}`, type: "wait", s: between(0, 0.5) });
      else if (pick < 0.4)
        steps.push(
          move(
            `s${i}`,
            "ptp",
            random() < 0.5
              ? pose()
              : {
                  q: [
                    between(-0.5, 0.5),
                    between(-1.2, -0.8),
                    between(1.8, 2.3),
                    between(-0.5, 0.5),
                    between(0.3, 1),
                    between(-1, 1),
                  ],
                },
            speed,
            blend,
          ),
        );
      else if (pick < 0.75) steps.push(move(`s${i}`, "lin", pose(), speed, blend));
      else if (pick < 0.85) steps.push(move(`s${i}`, "circ", pose(), speed, blend, pose()));
      else steps.push(move(`s${i}`, "spline", pose(), speed, blend));
    }
    return steps;
  }

  test("keep every joint within its limits, speed and acceleration at every instant; times never go back; no jumps", () => {
    let planned = 0;
    let moved = 0;
    for (let seed = 1; seed <= 120; seed++) {
      const answer = planProgram(programOf(randomProgram(seed)), robot);
      const flaws = judgePlan(answer.plan, robot, { slack: 2e-3 });
      expect({ seed, flaws }).toEqual({ seed, flaws: [] });
      if (answer.kind === "planned") planned++;
      moved += answer.plan.segments.length;
    }
    expect(planned).toBeGreaterThan(40);
    expect(moved).toBeGreaterThan(1000);
  }, 60_000);

  test("start and end at rest, and the cursor agrees with the sampler whichever way time goes", () => {
    const random = seededRandom(77);
    const a = new Float64Array(6);
    const b = new Float64Array(6);
    const ad = new Float64Array(6);
    const bd = new Float64Array(6);
    for (let seed = 1; seed <= 20; seed++) {
      const { plan } = planProgram(programOf(randomProgram(seed)), robot);
      const cursor = new PlanCursor(plan);
      for (const t of [0, plan.duration_s]) {
        samplePlan(plan, t, a, ad);
        for (const speed of ad) expect(Math.abs(speed)).toBeLessThan(1e-7);
      } // the sum of all durations rounds
      let t = 0;
      for (let k = 0; k < 300; k++) {
        t = random() < 0.05 ? random() * plan.duration_s : t + random() * 0.05;
        const moment = cursor.at(t, a, ad);
        const segment = samplePlan(plan, t, b, bd);
        expect(moment.segment).toBe(segment);
        expect(segmentAt(plan, t)).toBe(segment);
        expect(a).toEqual(b);
        expect(ad).toEqual(bd);
      }
    }
  });

  test("the path for drawing starts and ends where the plan does, in order", () => {
    const { plan } = planProgram(programOf(randomProgram(3)), robot);
    const path = planPath(plan, robot, { flangeFromTcp: () => TORCH });
    expect(path.stretches.map(({ step }) => step)).toEqual(
      plan.segments.filter(({ kind }) => kind === "motion").map(({ step }) => step),
    );
    const last = path.points_m.length - 3;
    expect(
      distance(
        [path.points_m[last]!, path.points_m[last + 1]!, path.points_m[last + 2]!],
        tcpAt(plan, plan.duration_s).position,
      ),
    ).toBeLessThan(1e-6);
    for (let k = 1; k < path.times_s.length; k++) expect(path.times_s[k]).toBeGreaterThanOrEqual(path.times_s[k - 1]!);
    expect(path.states).not.toContain(POINT_BEYOND_LIMIT);
  });
});
