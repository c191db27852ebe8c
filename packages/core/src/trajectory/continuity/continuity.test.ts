import { describe, expect, test } from "vitest";
import { allBranches, branchOf, flangePose, sameBranch } from "../../kinematics/index.ts";
import { turns, revolutionsInside } from "../../kinematics/turns.ts";
import { emptyProgram, type MoveStep } from "../../program/program.ts";
import { seededRandom } from "../../random.ts";
import type { Joint } from "../../model/arm.ts";
import { robotById } from "../../robots/library/index.ts";
import type { Robot } from "../../model/robot.ts";
import { identity, type Pose } from "../../spatial/pose.ts";
import { judgePlan } from "../judge.ts";
import { resolveMove, type Move } from "../moves.ts";
import { planProgram } from "../planner.ts";
import { posePathOf } from "../pose-paths.ts";
import { sampleSegment } from "../sample.ts";
import { chooseBranches } from "./choose.ts";
import { BREAK_S, ContinuitySolver, FLIP_RAD, FLIP_S, type Continuity } from "./continuity.ts";
import { CONTINUITY_RAD, StretchFollower } from "./stretch.ts";

const TURN = 2 * Math.PI;
const CONTEXT = { tools: {}, frames: {} };
const robotOf = (id: string): Robot => robotById(id)!;

/** Angles in the middle share of each joint's range. */
const anywhere = (robot: Robot, random: () => number, share: number): number[] =>
  robot.arm.joints.map(
    ({ limits: { lower_rad, upper_rad } }) =>
      (lower_rad + upper_rad) / 2 + (upper_rad - lower_rad) * share * (random() - 0.5),
  );
const poseStep = (robot: Robot, id: string, path: MoveStep["path"], q: readonly number[]): MoveStep => ({
  id,
  type: "move",
  path,
  target: { pose: frameFromTcp(robot, q), frame: "world", tool: "flange" },
  speed: path === "ptp" ? { ratio: 1 } : { mps: 0.05 },
  blend_m: 0,
});

const frameFromTcp = (robot: Robot, q: readonly number[]): Pose<"frame", "tcp"> => {
  const { position, quaternion } = flangePose(robot.arm, q);
  return { position, quaternion };
};

/**
 * Joint moves to poses with straight moves in between; every straight move ends where some posture of its start can get
 * to.
 */
function pathOf(robot: Robot, seed: number, kinds: readonly ("ptp" | "lin")[], share = 0.5): MoveStep[] {
  const random = seededRandom(seed);
  let q = anywhere(robot, random, share);
  return kinds.map((kind, i) => {
    if (kind === "ptp") q = anywhere(robot, random, share);
    else
      q = q.map((angle, j) => {
        const { lower_rad, upper_rad } = robot.arm.joints[j]!.limits;
        return Math.min(upper_rad - 0.02, Math.max(lower_rad + 0.02, angle + 1.4 * (random() - 0.5)));
      });
    return poseStep(robot, `s${i}`, kind, q);
  });
}

const runsOf = (robot: Robot, steps: readonly MoveStep[]): Move[][] =>
  steps.map(step => [resolveMove(step, robot, CONTEXT)]);

/** Everything tried: all branches, all copies by whole turns, every sequence of them. */
function bruteForce(
  robot: Robot,
  runs: readonly (readonly Move[])[],
  start: readonly number[],
): { cost_s: number; ways: number } {
  const follower = new StretchFollower(robot);
  const { joints } = robot.arm;
  let best = Number.POSITIVE_INFINITY;
  let ways = 0;
  const all = runs
    .map(run => run[0]!)
    .map(move => {
      const found: number[][] = [];
      for (const base of allBranches(robot, move.baseFromFlange, start)) {
        let copies: number[][] = [[]];
        for (let j = 0; j < joints.length; j++) {
          const { lower_rad, upper_rad } = joints[j]!.limits;
          copies = copies.flatMap(copy =>
            [-2, -1, 0, 1, 2]
              .map(k => base[j]! + k * TURN)
              .filter(angle => angle >= lower_rad && angle <= upper_rad)
              .map(angle => [...copy, angle]),
          );
        }
        found.push(...copies);
      }
      return found;
    });
  const go = (i: number, q: readonly number[], cost: number): void => {
    if (cost >= best) {
      ways++;
      return;
    }
    if (i === runs.length) {
      ways++;
      best = cost;
      return;
    }
    const move = runs[i]![0]!;
    if (move.step.path === "lin") {
      const end = Float64Array.from(q);
      const path = posePathOf([move], 0, flangePose(robot.arm, q))!;
      const lost =
        follower.follow(path, move.tcpFromFlange, end, true) ?? follower.confirm(path, move.tcpFromFlange, q);
      if (lost === undefined) go(i + 1, Array.from(end), cost + follower.seconds);
      return;
    }
    for (const next of all[i]!) {
      const time_s = Math.max(...next.map((angle, j) => Math.abs(angle - q[j]!) / joints[j]!.limits.speed_rad_s));
      const way = Math.max(...next.map((angle, j) => Math.abs(angle - q[j]!)));
      const turned = way > FLIP_RAD && !sameBranch(branchOf(robot, q)!, branchOf(robot, next)!);
      go(i + 1, next, cost + time_s + (turned ? FLIP_S : 0));
    }
  };
  go(0, start, 0);
  return { cost_s: best, ways };
}

/** The same robot with less room, so that the ways that can be tried stay few. */
const narrowed = (robot: Robot, most_rad: number): Robot => ({
  ...robot,
  arm: {
    ...robot.arm,
    joints: robot.arm.joints.map(joint => ({
      ...joint,
      limits: {
        ...joint.limits,
        lower_rad: Math.max(joint.limits.lower_rad, -most_rad),
        upper_rad: Math.min(joint.limits.upper_rad, most_rad),
      },
    })),
  },
});

describe("postures over the whole path", () => {
  test.each([
    ["staubli_rx90l", ["ptp", "lin", "ptp"], 8],
    ["kuka_kr6r900sixx", ["ptp", "lin", "ptp"], 8],
    ["yaskawa_gp8", ["lin", "ptp", "ptp"], 4],
    ["kuka_lbr_iiwa_14_r820", ["ptp", "lin"], 8],
    ["abb_crb15000_5_95", ["ptp", "lin"], 2],
  ] as const)("%s: as cheap as the best of every sequence there is", (id, kinds, count) => {
    const robot = robotOf(id);
    const solver = new ContinuitySolver(robot);
    let compared = 0;
    for (let seed = 1; seed <= count; seed++) {
      const runs = runsOf(robot, pathOf(robot, seed, kinds));
      const start = kinds[0] === "ptp" ? robot.home_rad : anywhere(robot, seededRandom(seed), 0.5);
      if (kinds[0] !== "ptp") runs.shift();
      const way = solver.solve(runs, Float64Array.from(start));
      const oracle = bruteForce(robot, runs, start);
      if (oracle.cost_s === Number.POSITIVE_INFINITY) {
        expect(way.cost_s).toBeGreaterThanOrEqual(BREAK_S);
        continue;
      }
      // Seven joints meet a pose to 1e-9 and their elbow angle to some 1e-5: paths that begin there differ by as much.
      expect(way.cost_s).toBeCloseTo(oracle.cost_s, robot.arm.joints.length === 7 ? 4 : 9);
      compared++;
    }
    expect(compared).toBeGreaterThan(0);
  });

  test("ur10e: the same with one turn and a half of room", () => {
    const robot = narrowed(robotOf("ur10e"), 4);
    const solver = new ContinuitySolver(robot);
    for (let seed = 1; seed <= 6; seed++) {
      const runs = runsOf(robot, pathOf(robot, seed, ["ptp", "lin", "ptp"]));
      const way = solver.solve(runs, Float64Array.from(robot.home_rad));
      const oracle = bruteForce(robot, runs, robot.home_rad);
      if (oracle.cost_s < Number.POSITIVE_INFINITY) expect(way.cost_s).toBeCloseTo(oracle.cost_s, 9);
      else expect(way.breaks.length).toBeGreaterThan(0);
    }
  });

  test.each(["staubli_rx90l", "kuka_kr6r900sixx", "ur10e", "kuka_lbr_iiwa_14_r820"])(
    "%s: where the nearest posture leads nowhere and another one through, the plan takes it, without a jump",
    id => {
      const robot = robotOf(id);
      let rescued = 0;
      for (let seed = 1; seed <= 40 && rescued < 2; seed++) {
        const steps = pathOf(robot, 100 + seed, ["ptp", "lin", "lin"]);
        const choice = chooseBranches(runsOf(robot, steps), robot, Float64Array.from(robot.home_rad))!;
        const nearest = new ContinuitySolver(robot).solve(runsOf(robot, steps), Float64Array.from(robot.home_rad), {
          nearest: true,
        });
        if (!choice.chosen || nearest.breaks.length === 0 || choice.way.breaks.length > 0 || choice.turning.length > 0)
          continue;
        rescued++;
        const answer = planProgram({ ...emptyProgram(robot.id), steps }, robot);
        expect(answer.kind).toBe("planned");
        expect(
          judgePlan(answer.plan, robot, { period_s: 0.01 }).filter(
            flaw => flaw.code === "plan.gap" || flaw.code === "plan.limit" || flaw.code === "plan.speed",
          ),
        ).toEqual([]);
        expect(
          longestStep(
            robot,
            answer.plan.segments.flatMap(segment =>
              segment.kind === "motion" && segment.path !== "ptp" ? [segment] : [],
            ),
          ),
        ).toBeLessThan(CONTINUITY_RAD);
      }
      expect(rescued).toBe(2);
    },
  );

  test("a joint move that flips the wrist is avoided where another posture does not need to", () => {
    const robot = robotOf("staubli_rx90l");
    const solver = new ContinuitySolver(robot);
    let avoided = 0;
    for (let seed = 1; seed <= 200 && avoided < 5; seed++) {
      const steps = pathOf(robot, seed, ["ptp", "ptp", "ptp"], 0.9);
      const runs = runsOf(robot, steps);
      const start = Float64Array.from(robot.home_rad);
      const nearest = solver.solve(runs, start, { nearest: true });
      const best = solver.solve(runs, start);
      expect(best.flips.length).toBeLessThanOrEqual(nearest.flips.length);
      if (best.flips.length === nearest.flips.length) continue;
      avoided++;
      expect(chooseBranches(runs, robot, start)!.chosen).toBe(true);
    }
    expect(avoided).toBe(5);
  });

  test("a flip that no choice avoids is named with its move, its joint and its way", () => {
    const robot = robotOf("staubli_rx90l");
    const a = [0, -1, 2, 0.2, 0.6, 0];
    const pose = frameFromTcp(robot, [0.1, -1.1, 2.1, 0.2, 0.6, 0]);
    const step: MoveStep = {
      id: "b",
      type: "move",
      path: "ptp",
      target: { pose, frame: "world", tool: "flange", branch: { shoulder: "front", elbow: "up", wrist: "negative" } },
      speed: { ratio: 1 },
      blend_m: 0,
    };
    const { flips } = new ContinuitySolver(robot).solve(runsOf(robot, [step]), Float64Array.from(a));
    expect(flips).toMatchObject([
      { kind: "joint-move", move: 0, from: { wrist: "positive" }, to: { wrist: "negative" } },
    ]);
    expect([4, 6]).toContain(flips[0]!.joint);
    expect(flips[0]!.way_rad).toBeGreaterThan(FLIP_RAD);
  });

  test("a path that needs joint 6 beyond its limit: the move, the share, the joint; and where a turn at a standstill would help", () => {
    const robot = robotOf("staubli_rx90l");
    const q = [0, -1, 2, 0, 0.8, 4.6];
    const end = [0, -1, 2, 0, 0.8, 5.2];
    const limit = robot.arm.joints[5]!.limits.upper_rad;
    const steps: MoveStep[] = [{ ...poseStep(robot, "a", "ptp", q), target: { q } }, poseStep(robot, "b", "lin", end)];
    const choice = chooseBranches(runsOf(robot, steps), robot, Float64Array.from(robot.home_rad))!;
    expect(choice.broken).toMatchObject([{ move: 1, best: { lost: { kind: "limit", joint: 6, limit_rad: limit } } }]);
    expect(choice.broken[0]!.share).toBeCloseTo((limit - 4.6) / 0.6, 1);
    expect(choice.turning).toMatchObject([{ kind: "standstill", move: 1 }]);
  });

  test("a taught branch is taken as controllers take it: the nearest copy, even where another would lead further", () => {
    const robot = robotOf("ur10e");
    const random = seededRandom(9);
    for (let k = 0; k < 10; k++) {
      const q = anywhere(robot, random, 0.4);
      const step = poseStep(robot, "a", "ptp", q);
      const branch = branchOf(robot, q)!;
      const way: Continuity = new ContinuitySolver(robot).solve(
        runsOf(robot, [{ ...step, target: { ...step.target, branch } as MoveStep["target"] }]),
        Float64Array.from(robot.home_rad),
      );
      const end = way.ends[0]!;
      expect(sameBranch(branchOf(robot, end)!, branch)).toBe(true);
      // Joint 3 has no room for a copy.
      for (const j of [0, 1, 3, 4, 5])
        expect(Math.abs(end[j]! - robot.home_rad[j]!)).toBeLessThanOrEqual(Math.PI + 1e-9);
    }
  });
});

test("whole turns are copies of a joint that turns, never of one that slides", () => {
  const limits = { lower_rad: -20, upper_rad: 20, speed_rad_s: 1, acceleration_rad_s2: 1 };
  const joint = (kind?: Joint["kind"]): Joint => ({
    name: "j",
    axis: [0, 0, 1],
    parentFromJoint: identity(),
    limits,
    ...(kind === undefined ? {} : { kind }),
  });
  const arm = {
    name: "gantry",
    joints: [joint("prismatic"), joint(), joint("revolute")],
    lastJointFromFlange: identity<"joint", "flange">(),
  };
  expect(arm.joints.map(turns)).toEqual([false, true, true]);
  const copies = revolutionsInside({ arm }, Float64Array.of(1, 2, 3));
  expect(copies.length).toBe(6 * 6);
  expect(new Set(copies.map(copy => copy[0]))).toEqual(new Set([1]));
  expect(revolutionsInside({ arm }, Float64Array.of(25, 2, 3))).toEqual([]);
});

/** The longest way of a joint between two looks that are 5 ms apart. */
function longestStep(robot: Robot, segments: Parameters<typeof sampleSegment>[0][]): number {
  const n = robot.arm.joints.length;
  const last = new Float64Array(n);
  const q = new Float64Array(n);
  let longest = 0;
  for (const segment of segments) {
    const looks = Math.ceil(segment.duration_s / 0.005);
    for (let k = 0; k <= looks; k++) {
      sampleSegment(segment, (segment.duration_s * k) / looks, q);
      for (let j = 0; j < n && k > 0; j++) longest = Math.max(longest, Math.abs(q[j]! - last[j]!));
      last.set(q);
    }
  }
  return longest;
}
