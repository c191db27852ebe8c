import { expect, test } from "vitest";
import { emptyProgram, type Program, type Step } from "../program/program.ts";
import { seededRandom, type Random } from "../random.ts";
import { robotById } from "../robots/library/index.ts";
import { pose } from "../spatial/pose.ts";
import { planProgram } from "../trajectory/index.ts";
import { checkProgram } from "./check.ts";
import { bestResult, judgeLesson, lessonOf, readLesson, type Lesson, type LessonResult } from "./lesson.ts";

const robot = robotById("staubli_rx90l")!;
const base = pose<"world", "base">();
const DOWN = [1, 0, 0, 0] as const;
type At = readonly [number, number, number];
const PLACES: readonly At[] = [
  [0.7, -0.2, 0.6],
  [0.7, -0.2, 0.4],
  [0.7, -0.2, 0.6],
  [0.6, 0.2, 0.6],
  [0.6, 0.2, 0.4],
  [0.6, 0.2, 0.6],
];
const move = (id: string, at: At, mps: number): Step => ({
  id,
  type: "move",
  path: id === "p1" ? "ptp" : "lin",
  target: { pose: { position: [...at], quaternion: [...DOWN] }, frame: "world", tool: "flange" },
  speed: id === "p1" ? { ratio: 0.5 } : { mps },
  blend_m: 0,
});
const withSteps = (steps: readonly Step[]): Program => ({ ...emptyProgram("staubli_rx90l", "Pick and place"), steps });
const expert = withSteps(PLACES.map((at, i) => move(`p${i + 1}`, at, 0.25)));
const lesson = lessonOf(expert, robot, base, planProgram(expert, robot).plan)!;
const judged = (program: Program): LessonResult => {
  const { plan, verdict } = checkProgram(program, robot);
  return judgeLesson(lesson, program, robot, base, plan, verdict);
};

test("M-61 who made the lesson passes it; one who misses a place, dawdles or takes a long way is told which", () => {
  expect(lesson.goals).toHaveLength(6);
  expect(judged(expert)).toMatchObject({ passed: true, lacks: [], bad: 0 });
  expect(judged(expert).score).toBeGreaterThan(99);
  const without = judged(withSteps(expert.steps.filter(step => step.id !== "p5")));
  expect(without).toMatchObject({ passed: false, met: [true, true, true, true, false, true] });
  // Nearest: the place above it, 200 mm away.
  expect(without.distances_m[4]).toBeCloseTo(0.2, 3);
  const slow = withSteps([...expert.steps, { id: "w", type: "wait", s: 2 * lesson.expert.duration_s }]);
  expect(judged(slow).lacks).toEqual(["time"]);
  const trips = [0, 1, 2, 3].flatMap(i => [move(`p${7 + 2 * i}`, PLACES[2]!, 1), move(`p${8 + 2 * i}`, PLACES[5]!, 1)]);
  const far = withSteps([...expert.steps, ...trips]);
  expect(judged(far).lacks).toContain("path");
  const outside = withSteps([...expert.steps, move("p7", [3, 0, 0.6], 0.25)]);
  expect(judged(outside).lacks).toContain("bad");
});

test("M-62 of three attempts the best is one that passed, else the highest score", () => {
  expect(bestResult([])).toBe(-1);
  expect(
    bestResult([
      { passed: false, score: 95 },
      { passed: true, score: 80 },
      { passed: true, score: 85 },
    ]),
  ).toBe(2);
  expect(
    bestResult([
      { passed: false, score: 40 },
      { passed: false, score: 60 },
      { passed: false, score: 50 },
    ]),
  ).toBe(1);
});

/** A learner of that skill, 0 … 1: shaky hands, hesitation, detours, places left out. The score knows none of it. */
function learner(skill: number, random: Random): Program {
  const lack = 1 - skill;
  const noise = (): number => (random() + random() + random() - 1.5) * 2 * (0.001 + 0.012 * lack);
  const steps: Step[] = [];
  let n = 0;
  const go = ([x, y, z]: At): void => {
    steps.push(move(`p${++n}`, [x + noise(), y + noise(), z + noise()], 0.25 * (1 - 0.6 * lack)));
  };
  for (const at of PLACES) {
    if (n > 0 && random() < 0.25 * lack) continue;
    if (n > 0 && random() < 0.5 * lack) go([at[0] - 0.1 * random(), at[1], at[2] + 0.15 * random()]);
    go(at);
    if (random() < lack) steps.push({ id: `w${n}`, type: "wait", s: 2 * lack * random() });
  }
  return withSteps(steps);
}
const ranks = (values: readonly number[]): readonly number[] => {
  const order = values.map((_, i) => i).sort((a, b) => values[a]! - values[b]!);
  const rank = values.map(() => 0);
  for (const [place, i] of order.entries()) rank[i] = place;
  return rank;
};

test("T-70 X-50 L-64 the scores of 200 scripted learners rank them by skill: correlation 0.9 or more", () => {
  const random = seededRandom(20_261_127);
  const skills = Array.from({ length: 200 }, () => random());
  const scores = skills.map(skill => {
    const program = learner(skill, random);
    const { plan } = planProgram(program, robot);
    return judgeLesson(lesson, program, robot, base, plan, { steps: [] }).score;
  });
  const [a, b] = [ranks(skills), ranks(scores)];
  const squares = a.reduce((sum, rank, i) => sum + (rank - b[i]!) ** 2, 0);
  const n = skills.length;
  expect(1 - (6 * squares) / (n * (n * n - 1))).toBeGreaterThanOrEqual(0.9);
});

test("a lesson is saved and read; what is none is refused in one sentence", () => {
  expect(readLesson(JSON.stringify(lesson))).toEqual(lesson);
  const bad: readonly [unknown, RegExp][] = [
    ["{", /no JSON/],
    [null, /no lesson/],
    [{ ...lesson, version: 2 }, /no lesson of version 1/],
    [{ ...lesson, goals: [] } satisfies Lesson, /no goals/],
    [{ ...lesson, goals: [{ name: "", position_m: [0, "x", 0], axis: [0, 0, 1] }] }, /no goals/],
    [{ ...lesson, expert: {} }, /lacks/],
  ];
  for (const [value, why] of bad)
    expect(readLesson(typeof value === "string" ? value : JSON.stringify(value))).toMatch(why);
  expect(lessonOf(withSteps([]), robot, base, planProgram(withSteps([]), robot).plan)).toBeUndefined();
});
