import { describe, expect, test } from "vitest";
import {
  bestAttempt,
  checkProgram,
  distance,
  emptyProgram,
  filterDemonstration,
  flangePose,
  judgeAttempt,
  pathDeviation,
  planProgram,
  pose,
  repeatOnPallet,
  robotById,
  samplePlan,
  seededRandom,
  stepsOfDemonstration,
  type Demonstration,
  type Pallet,
  type Program,
  type Quaternion,
  type Vector3,
} from "../../index.ts";

const robot = robotById("kuka_kr6r900sixx")!;
const DOWN: Quaternion = [0, 1, 0, 0];
const PICK: Vector3 = [0.5, -0.2, 0.2];
const PLACE: Vector3 = [0.5, 0.2, 0.2];
const above = ([x, y, z]: Vector3): Vector3 => [x, y, z + 0.15];

/**
 * A hand that goes through these places in straight lines at 0.2 m/s, rests half a second at each, closed in between.
 */
function pickAndPlace(noise_m = 0, seed = 1): Demonstration {
  const random = seededRandom(seed);
  const places: readonly Vector3[] = [above(PICK), PICK, above(PICK), above(PLACE), PLACE, above(PLACE)];
  const times_s: number[] = [];
  const worldFromTcp: ReturnType<typeof pose<"world", "tcp">>[] = [];
  const closed: boolean[] = [];
  let t = 0;
  const sample = (at: Vector3, holds: boolean): void => {
    times_s.push(t);
    worldFromTcp.push(pose(at.map(v => v + noise_m * (2 * random() - 1)) as Vector3, DOWN));
    closed.push(holds);
    t += 0.02;
  };
  places.forEach((place, i) => {
    const from = places[Math.max(0, i - 1)]!;
    const count = Math.round(distance(from, place) / 0.2 / 0.02);
    const held = i > 1 && i < 5;
    for (let n = 1; n <= count; n++) sample(from.map((v, k) => v + (n / count) * (place[k]! - v)) as Vector3, held);
    for (let n = 0; n < 25; n++) sample(place, i === 1 ? n > 12 : i === 4 ? n <= 12 : held);
  });
  return { times_s, worldFromTcp, closed };
}
const programOf = (demonstration: Demonstration, exactDurations = false): Program => ({
  ...emptyProgram(robot.id, "Shown"),
  steps: stepsOfDemonstration(demonstration, filterDemonstration(demonstration), {
    frame: "world",
    worldFromFrame: pose(),
    tool: "flange",
    approach: { ratio: 0.3 },
    waitsFrom_s: Infinity,
    exactDurations,
  }),
});

describe("a demonstration becomes an editable program", () => {
  const demonstration = pickAndPlace(0.001);
  const program = programOf(demonstration);

  test("five straights with the hand's own time, and the grip closes and opens where the hand did", () => {
    const said = program.steps.map(step => (step.type === "move" ? step.path : step.type));
    expect(said).toEqual(["ptp", "lin", "gripper", "lin", "lin", "lin", "gripper", "lin"]);
    const times = programOf(demonstration, true).steps.flatMap(step =>
      step.type === "move" && "time_s" in step.speed ? [step.speed.time_s] : [],
    );
    // 0.15 m, 0.15 m, 0.4 m, 0.15 m, 0.15 m at 0.2 m/s, each with what belongs to the rests around it at most.
    [0.75, 0.75, 2, 0.75, 0.75].forEach((wanted_s, i) => {
      expect(Math.abs(times[i]! - wanted_s)).toBeLessThan(0.06);
    });
    const speeds = program.steps.flatMap(step => (step.type === "move" && "mps" in step.speed ? [step.speed.mps] : []));
    expect(speeds).toHaveLength(5);
    for (const mps of speeds) expect(Math.abs(mps - 0.2)).toBeLessThan(0.01);
  });

  test("its planned path is the hand's within 3 mm", () => {
    const planned = planProgram(program, robot);
    if (planned.kind !== "planned") throw new Error(planned.stuck.sentence);
    const q = new Float64Array(6);
    const way: Vector3[] = [];
    const [first] = planned.plan.segments;
    for (let t_s = first!.duration_s; t_s <= planned.plan.duration_s; t_s += 0.01) {
      samplePlan(planned.plan, t_s, q);
      way.push([...flangePose(robot.arm, q).position]);
    }
    const hand = demonstration.worldFromTcp.map(({ position }): Vector3 => [...position]);
    expect(pathDeviation(way, hand).max_m).toBeLessThan(0.003);
    expect(pathDeviation(hand, way).max_m).toBeLessThan(0.003);
    expect(checkProgram(program, robot).verdict.steps.filter(({ verdict }) => verdict !== "ok")).toEqual([]);
  });
});

test("M-54 one shown pick-and-place is done at nine places by three corners, the pick always at the same one", () => {
  const program = programOf(pickAndPlace(0.001));
  const answer = repeatOnPallet(program, "table", {
    frame: "world",
    origin: pose(PLACE, DOWN),
    rowEnd: [PLACE[0] + 0.1, PLACE[1], PLACE[2]],
    columnEnd: [PLACE[0], PLACE[1] + 0.1, PLACE[2]],
    rows: 3,
    columns: 3,
    layers: 1,
    layer_m: 0.05,
  });
  if (answer.kind !== "program") throw new Error(answer.sentence);
  expect(answer.places).toBe(9);
  const planned = planProgram(answer.program, robot);
  if (planned.kind !== "planned") throw new Error(planned.stuck.sentence);
  // Where the flange is whenever the gripper changes.
  const seen = planned.plan.segments.flatMap(segment =>
    segment.kind === "rest"
      ? [{ closed: segment.gripperClosed, at: flangePose(robot.arm, segment.q_rad).position }]
      : [],
  );
  const picks = seen.filter(({ closed }) => closed);
  const places = seen.filter(({ closed }) => !closed);
  expect([picks.length, places.length]).toEqual([9, 9]);
  for (const pick of picks) expect(distance(pick.at, PICK)).toBeLessThan(0.002);
  const wanted = [0, 1, 2].flatMap(row =>
    [0, 1, 2].map((column): Vector3 => [PLACE[0] + 0.05 * column, PLACE[1] + 0.05 * row, PLACE[2]]),
  );
  wanted.forEach((place, i) => {
    expect(distance(places[i]!.at, place)).toBeLessThan(0.002);
  });
});

test("a program without one pick and one place is not repeated, and the sentence says why", () => {
  const pallet: Pallet = {
    frame: "world",
    origin: pose(PLACE, DOWN),
    rowEnd: PLACE,
    columnEnd: PLACE,
    rows: 1,
    columns: 1,
    layers: 1,
    layer_m: 0.1,
  };
  expect(repeatOnPallet(emptyProgram(robot.id), "table", pallet)).toEqual({
    kind: "refused",
    sentence: "One closing and then one opening of the gripper are needed: one pick and one place.",
  });
  const program = programOf(pickAndPlace());
  expect(repeatOnPallet(program, "table", { ...pallet, frame: "nowhere" })).toMatchObject({
    sentence: "There is no frame “nowhere”.",
  });
});

test("M-61 M-62 an attempt is accepted or not with both numbers, and of three the best is chosen", () => {
  const expert = pickAndPlace();
  const slower = (factor: number, from: Demonstration): Demonstration => ({
    ...from,
    times_s: from.times_s.map(t => t * factor),
  });
  const acceptance = { within_m: 0.01, within_s: 12 };
  const attempts = [
    slower(2, pickAndPlace(0.03, 2)),
    slower(1.2, pickAndPlace(0.004, 3)),
    slower(1.1, pickAndPlace(0.02, 4)),
  ].map(attempt => judgeAttempt(attempt, expert, acceptance));
  expect(attempts.map(({ accepted }) => accepted)).toEqual([false, true, false]);
  expect(bestAttempt(attempts)).toBe(1);
  expect(attempts[0]!.missed[0]).toMatch(/^It leaves the path by \d\d\.\d mm; 10\.0 mm are allowed\.$/);
  expect(attempts[0]!.missed[1]).toMatch(/^It takes \d\d\.\d s; 12\.0 s are allowed\.$/);
  const itself = judgeAttempt(expert, expert, acceptance);
  expect([itself.score, itself.accepted, itself.pathRatio]).toEqual([100, true, 1]);
});

test("the score ranks 200 hands as their noise does: rank correlation of at least 0.9", () => {
  const random = seededRandom(200);
  const expert = pickAndPlace();
  const hands = Array.from({ length: 200 }, (_, i) => {
    const noise_m = 0.03 * random();
    return { noise_m, score: judgeAttempt(pickAndPlace(noise_m, 1000 + i), expert, {}).score };
  });
  const ranks = (of: (hand: (typeof hands)[number]) => number): number[] => {
    const order = hands.map((hand, i) => [of(hand), i] as const).sort((a, b) => a[0] - b[0]);
    const rank: number[] = [];
    order.forEach(([, i], place) => {
      rank[i] = place;
    });
    return rank;
  };
  const skill = ranks(hand => -hand.noise_m);
  const score = ranks(hand => hand.score);
  const squares = skill.reduce((sum, rank, i) => sum + (rank - score[i]!) ** 2, 0);
  expect(1 - (6 * squares) / (200 * (200 ** 2 - 1))).toBeGreaterThanOrEqual(0.9);
});

test("what the hand holds is never lost: a demonstration that begins closed begins with a closed gripper", () => {
  const { closed, ...rest } = pickAndPlace();
  const program = programOf({ ...rest, closed: closed.map(() => true) });
  expect(program.steps.filter(step => step.type === "gripper")).toMatchObject([{ closed: true }]);
});
