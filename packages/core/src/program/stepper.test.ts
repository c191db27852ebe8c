import { describe, expect, test } from "vitest";
import { seededRandom } from "../random.ts";
import { brakingTime_s } from "../robots/jerk.ts";
import { robotById } from "../robots/library/index.ts";
import { planProgram } from "../trajectory/planner.ts";
import { samplePlan } from "../trajectory/sample.ts";
import { emptyProgram, type Program, type Step } from "./program.ts";
import { Stepper } from "./stepper.ts";

const robot = robotById("staubli_rx90l")!;
const DT = 0.004;

const at = (x: number, y: number, z: number): { pose: { position: [number, number, number]; quaternion: [number, number, number, number] }; frame: string; tool: string } =>
  ({ pose: { position: [x, y, z], quaternion: [1, 0, 0, 0] }, frame: "world", tool: "flange" });
const steps: readonly Step[] = [
  { id: "a", type: "move", path: "ptp", target: { q: [0, -1, 2, 0, 0.6, 0] }, speed: { ratio: 1 }, blend_m: 0 },
  { id: "b", type: "move", path: "lin", target: at(0.6, 0.2, 0.4), speed: { mps: 0.5 }, blend_m: 0.02 },
  { id: "c", type: "move", path: "lin", target: at(0.5, 0.2, 0.4), speed: { mps: 0.5 }, blend_m: 0 },
  { id: "w", type: "wait", s: 0.3 },
  { id: "g", type: "gripper", closed: true },
  { id: "d", type: "move", path: "ptp", target: { q: [0, -1, 2, 0, 0.6, 0] }, speed: { ratio: 1 }, blend_m: 0 },
];
const program: Program = { ...emptyProgram(robot.id), steps };

function play(stepper: Stepper, override: (t: number) => number, seen: (t: number, q: Float64Array) => void = () => undefined): number {
  const q = new Float64Array(6);
  for (let k = 1; k < 100_000; k++) {
    const state = stepper.advance(DT, override(k * DT), q);
    seen(k * DT, q);
    if (state.kind !== "running") return k * DT;
  }
  throw new Error("The stepper never ended.");
}
const fresh = (): Stepper => new Stepper(robot, program, steps, robot.home_rad);

describe("stepper", () => {
  test("at full override it passes where the plan passes, at the same times", () => {
    const answer = planProgram(program, robot);
    expect(answer.kind).toBe("planned");
    const planned = new Float64Array(6);
    const end = play(fresh(), () => 1, (t, q) => {
      samplePlan(answer.plan, Math.min(t, answer.plan.duration_s), planned);
      for (let j = 0; j < 6; j++) expect(Math.abs(q[j]! - planned[j]!)).toBeLessThan(1e-9);
    });
    expect(Math.abs(end - answer.plan.duration_s)).toBeLessThan(2 * DT);
  });

  test("T-03 half the override takes twice the time for moves, waits keep theirs", () => {
    const moves = steps.filter(step => step.type === "move");
    const time = (override: number): number => play(new Stepper(robot, program, moves, robot.home_rad), () => override);
    expect(Math.abs(time(0.5) - 2 * time(1))).toBeLessThan(2 * DT);
    expect(Math.abs(play(new Stepper(robot, program, [{ id: "w", type: "wait", s: 0.5 }], robot.home_rad), () => 0.25) - 0.5)).toBeLessThan(2 * DT);
  });

  test("override 0 holds, and the path is the same afterwards", () => {
    const path = new Set<string>(), key = (q: Float64Array): string => Array.from(q, x => x.toFixed(2)).join(" ");
    play(fresh(), () => 0.2, (_t, q) => path.add(key(q)));
    let held = 0, last = "";
    play(fresh(), t => (t > 0.5 && t < 1.5 ? 0 : 1), (t, q) => {
      if (t > 1.2 && t < 1.5) { if (last !== "") expect(key(q)).toBe(last); held++; last = key(q); }
      expect(path.has(key(q)) || [...path].some(one => near(one, q))).toBe(true);
    });
    expect(held).toBeGreaterThan(50);
  });

  test("a stop slows down along the path within the accelerations and does not go on", () => {
    const stepper = fresh(), q = new Float64Array(6), rows: Float64Array[] = [];
    for (let k = 0; k < 75; k++) stepper.advance(DT, 1, q);
    stepper.stop();
    let state = stepper.advance(DT, 1, q);
    for (let k = 0; k < 500 && state.kind === "running"; k++) { rows.push(q.slice()); state = stepper.advance(DT, 1, q); }
    rows.push(q.slice());
    expect(state.kind).toBe("stopped");
    expect(rows.length).toBeGreaterThan(5);
    for (let k = 2; k < rows.length; k++) {
      for (let j = 0; j < 6; j++) {
        const bend = (rows[k]![j]! - 2 * rows[k - 1]![j]! + rows[k - 2]![j]!) / DT ** 2;
        expect(Math.abs(bend)).toBeLessThan(robot.arm.joints[j]!.limits.acceleration_rad_s2 * 1.05);
      }
    }
    expect(stepper.advance(DT, 1, q).moving).toBe(false);
  });

  test("a stop at any instant of any program ends within the braking time", () => {
    const random = seededRandom(9), between = (a: number, b: number): number => a + (b - a) * random();
    const braking_s = brakingTime_s(robot);
    for (let round = 0; round < 60; round++) {
      const list = Array.from({ length: 6 }, (_, i): Step => ({
        id: `s${i}`, type: "move", path: i > 0 && random() < 0.6 ? "lin" : "ptp", target: at(between(0.45, 0.65), between(-0.3, 0.3), between(0.3, 0.55)),
        speed: random() < 0.5 ? { mps: between(0.3, 3) } : { ratio: 1 }, blend_m: random() < 0.7 ? between(0.001, 0.05) : 0,
      }));
      const { plan } = planProgram({ ...program, steps: list }, robot), stepper = new Stepper(robot, program, list, robot.home_rad), q = new Float64Array(6);
      const until_s = between(0.05, 0.95) * plan.duration_s;
      for (let t = 0; t < until_s; t += DT) stepper.advance(DT, 1, q);
      stepper.stop();
      let a = q.slice(), b = a, cycles = 0;
      for (let state = stepper.advance(DT, 1, q); state.kind === "running"; state = stepper.advance(DT, 1, q)) {
        // The rate changes once a slice while the plan goes on within it: a quarter over is what that can cost.
        if (cycles++ > 0) for (let j = 0; j < 6; j++) expect(Math.abs(q[j]! - 2 * b[j]! + a[j]!) / DT ** 2).toBeLessThan(robot.arm.joints[j]!.limits.acceleration_rad_s2 * 1.25);
        a = b;
        b = q.slice();
      }
      expect(cycles * DT).toBeLessThanOrEqual(braking_s + 2 * DT);
    }
  });

  test("T-31 the gripper follows its step, and the step in force is named", () => {
    const stepper = fresh(), seen: string[] = [], q = new Float64Array(6);
    let closedAt = "";
    for (let k = 0; k < 5000; k++) {
      const state = stepper.advance(DT, 1, q);
      if (state.gripperClosed && closedAt === "") closedAt = state.step;
      if (state.kind !== "running") break;
      if (seen.at(-1) !== state.step) seen.push(state.step);
    }
    expect(seen).toEqual(["a", "b", "c", "w", "g", "d"]);
    expect(closedAt).toBe("g");
  });

  test("T-53 a step is only asked for when it is needed", () => {
    const asked: string[] = [], source = function* (): Generator<Step> { for (const step of steps) { asked.push(step.id); yield step; } };
    const stepper = new Stepper(robot, program, source(), robot.home_rad), q = new Float64Array(6);
    stepper.advance(DT, 1, q);
    expect(asked).toEqual(["a"]);
    while (stepper.advance(DT, 1, q).step === "a") expect(asked).toEqual(["a"]);
    expect(asked).toEqual(["a", "b", "c"]);
  });

  test("a step that cannot be carried out is a fault with the joint and the limit, and what comes before it is done", () => {
    const far: Step = { id: "far", type: "move", path: "ptp", target: { q: [0, -1, 2, 0, 2.5, 0] }, speed: { ratio: 1 }, blend_m: 0 };
    const stepper = new Stepper(robot, program, [steps[0]!, far], robot.home_rad), q = new Float64Array(6);
    let state = stepper.advance(DT, 1, q);
    while (state.kind === "running") state = stepper.advance(DT, 1, q);
    expect(state.kind).toBe("fault");
    expect(state.fault?.sentence).toMatch(/joint 5 would turn to 1[0-9]{2}\.[0-9]°; its limit is 120\.0°\.$/);
    expect(q[4]).toBeCloseTo(0.6, 9);
  });
});

const near = (one: string, q: Float64Array): boolean => one.split(" ").every((x, j) => Math.abs(Number(x) - q[j]!) < 0.03);
