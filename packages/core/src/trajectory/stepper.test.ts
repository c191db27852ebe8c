import { describe, expect, test } from "vitest";
import { seededRandom } from "../random.ts";
import { brakingTime_s } from "../model/jerk.ts";
import { robotById } from "../robots/library/index.ts";
import { planProgram } from "./planner.ts";
import { samplePlan } from "./sample.ts";
import { flangePose } from "../kinematics/forward.ts";
import { unrolled } from "../program/flow.ts";
import { emptyProgram, type MoveStep, type Program, type Step } from "../program/program.ts";
import { SignalTable } from "../program/signals.ts";
import { Stepper, type StepperState } from "./stepper.ts";

const robot = robotById("staubli_rx90l")!;
const DT = 0.004;

const at = (
  x: number,
  y: number,
  z: number,
): {
  pose: { position: [number, number, number]; quaternion: [number, number, number, number] };
  frame: string;
  tool: string;
} => ({ pose: { position: [x, y, z], quaternion: [1, 0, 0, 0] }, frame: "world", tool: "flange" });
const steps: readonly Step[] = [
  { id: "a", type: "move", path: "ptp", target: { q: [0, -1, 2, 0, 0.6, 0] }, speed: { ratio: 1 }, blend_m: 0 },
  { id: "b", type: "move", path: "lin", target: at(0.6, 0.2, 0.4), speed: { mps: 0.5 }, blend_m: 0.02 },
  { id: "c", type: "move", path: "lin", target: at(0.5, 0.2, 0.4), speed: { mps: 0.5 }, blend_m: 0 },
  { id: "w", type: "wait", s: 0.3 },
  { id: "g", type: "gripper", closed: true },
  { id: "d", type: "move", path: "ptp", target: { q: [0, -1, 2, 0, 0.6, 0] }, speed: { ratio: 1 }, blend_m: 0 },
];
const program: Program = { ...emptyProgram(robot.id), steps };

function play(
  stepper: Stepper,
  override: (t: number) => number,
  seen: (t: number, q: Float64Array) => void = () => undefined,
): number {
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
    const end = play(
      fresh(),
      () => 1,
      (t, q) => {
        samplePlan(answer.plan, Math.min(t, answer.plan.duration_s), planned);
        for (let j = 0; j < 6; j++) expect(Math.abs(q[j]! - planned[j]!)).toBeLessThan(1e-9);
      },
    );
    expect(Math.abs(end - answer.plan.duration_s)).toBeLessThan(2 * DT);
  });

  test("T-03 half the override takes twice the time for moves, waits keep theirs", () => {
    const moves = steps.filter(step => step.type === "move");
    const time = (override: number): number => play(new Stepper(robot, program, moves, robot.home_rad), () => override);
    expect(Math.abs(time(0.5) - 2 * time(1))).toBeLessThan(2 * DT);
    expect(
      Math.abs(
        play(new Stepper(robot, program, [{ id: "w", type: "wait", s: 0.5 }], robot.home_rad), () => 0.25) - 0.5,
      ),
    ).toBeLessThan(2 * DT);
  });

  test("override 0 holds, and the path is the same afterwards", () => {
    const path = new Set<string>();
    const key = (q: Float64Array): string => Array.from(q, x => x.toFixed(2)).join(" ");
    play(
      fresh(),
      () => 0.2,
      (_t, q) => path.add(key(q)),
    );
    let held = 0;
    let last = "";
    play(
      fresh(),
      t => (t > 0.5 && t < 1.5 ? 0 : 1),
      (t, q) => {
        if (t > 1.2 && t < 1.5) {
          if (last !== "") expect(key(q)).toBe(last);
          held++;
          last = key(q);
        }
        expect(path.has(key(q)) || [...path].some(one => near(one, q))).toBe(true);
      },
    );
    expect(held).toBeGreaterThan(50);
  });

  test("a stop slows down along the path within the accelerations and does not go on", () => {
    const stepper = fresh();
    const q = new Float64Array(6);
    const rows: Float64Array[] = [];
    for (let k = 0; k < 75; k++) stepper.advance(DT, 1, q);
    stepper.stop();
    let state = stepper.advance(DT, 1, q);
    for (let k = 0; k < 500 && state.kind === "running"; k++) {
      rows.push(q.slice());
      state = stepper.advance(DT, 1, q);
    }
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
    const random = seededRandom(9);
    const between = (a: number, b: number): number => a + (b - a) * random();
    const braking_s = brakingTime_s(robot);
    for (let round = 0; round < 60; round++) {
      const list = Array.from(
        { length: 6 },
        (_, i): Step => ({
          id: `s${i}`,
          type: "move",
          path: i > 0 && random() < 0.6 ? "lin" : "ptp",
          target: at(between(0.45, 0.65), between(-0.3, 0.3), between(0.3, 0.55)),
          speed: random() < 0.5 ? { mps: between(0.3, 3) } : { ratio: 1 },
          blend_m: random() < 0.7 ? between(0.001, 0.05) : 0,
        }),
      );
      const { plan } = planProgram({ ...program, steps: list }, robot);
      const stepper = new Stepper(robot, program, list, robot.home_rad);
      const q = new Float64Array(6);
      const until_s = between(0.05, 0.95) * plan.duration_s;
      for (let t = 0; t < until_s; t += DT) stepper.advance(DT, 1, q);
      stepper.stop();
      let a = q.slice();
      let b = a;
      let cycles = 0;
      for (let state = stepper.advance(DT, 1, q); state.kind === "running"; state = stepper.advance(DT, 1, q)) {
        // The rate changes once a slice while the plan goes on within it: a quarter over is what that can cost.
        if (cycles++ > 0)
          for (let j = 0; j < 6; j++)
            expect(Math.abs(q[j]! - 2 * b[j]! + a[j]!) / DT ** 2).toBeLessThan(
              robot.arm.joints[j]!.limits.acceleration_rad_s2 * 1.25,
            );
        a = b;
        b = q.slice();
      }
      expect(cycles * DT).toBeLessThanOrEqual(braking_s + 2 * DT);
    }
  });

  test("T-31 the gripper follows its step, and the step in force is named", () => {
    const stepper = fresh();
    const seen: string[] = [];
    const q = new Float64Array(6);
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

  test("a step is only asked for when it is needed", () => {
    const asked: string[] = [];
    const source = function* (): Generator<Step> {
      for (const step of steps) {
        asked.push(step.id);
        yield step;
      }
    };
    const stepper = new Stepper(robot, program, source(), robot.home_rad);
    const q = new Float64Array(6);
    stepper.advance(DT, 1, q);
    expect(asked).toEqual(["a"]);
    while (stepper.advance(DT, 1, q).step === "a") expect(asked).toEqual(["a"]);
    expect(asked).toEqual(["a", "b", "c"]);
  });

  test("a step that cannot be carried out is a fault with the joint and the limit, and what comes before it is done", () => {
    const far: Step = {
      id: "far",
      type: "move",
      path: "ptp",
      target: { q: [0, -1, 2, 0, 2.5, 0] },
      speed: { ratio: 1 },
      blend_m: 0,
    };
    const stepper = new Stepper(robot, program, [steps[0]!, far], robot.home_rad);
    const q = new Float64Array(6);
    let state = stepper.advance(DT, 1, q);
    while (state.kind === "running") state = stepper.advance(DT, 1, q);
    expect(state.kind).toBe("fault");
    expect(state.fault?.sentence).toMatch(/joint 5 would turn to 1[0-9]{2}\.[0-9]°; its limit is 120\.0°\.$/);
    expect(q[4]).toBeCloseTo(0.6, 9);
  });
});

const near = (one: string, q: Float64Array): boolean =>
  one.split(" ").every((x, j) => Math.abs(Number(x) - q[j]!) < 0.03);

describe("signals, searches and blocks", () => {
  const q = new Float64Array(6);
  /** Plays until it ends; `seen` is told what holds after each slice. */
  const run = (
    program: Program,
    signals: SignalTable,
    seen: (t_s: number, state: StepperState) => void = () => undefined,
  ): StepperState => {
    const stepper = new Stepper(robot, program, unrolled(program, signals), robot.home_rad, { signals });
    for (let k = 1; k < 20_000; k++) {
      const state = stepper.advance(DT, 1, q);
      seen(k * DT, state);
      if (state.kind !== "running") return state;
    }
    throw new Error("The stepper never ended.");
  };
  const of = (...list: Step[]): Program => ({
    ...program,
    signals: { part: { kind: "digital-in" }, lamp: { kind: "digital-out" }, level: { kind: "analogue-in" } },
    steps: list,
  });

  test("an output is written when its step is reached, and a pulse goes back while the program goes on", () => {
    const signals = new SignalTable();
    const changes: string[] = [];
    let lamp: boolean | number = false;
    run(
      of(
        { id: "w", type: "wait", s: 0.1 },
        { id: "p", type: "set", signal: "lamp", to: true, pulse_s: 0.2 },
        { id: "v", type: "wait", s: 0.5 },
      ),
      signals,
      (t_s, state) => {
        if (signals.read("lamp") !== lamp) {
          lamp = signals.read("lamp");
          changes.push(`${t_s.toFixed(2)} ${state.step}`);
        }
      },
    );
    expect(changes.length).toBe(2);
    expect(Number(changes[0]!.split(" ")[0])).toBeCloseTo(0.1, 1);
    expect(Number(changes[1]!.split(" ")[0]) - Number(changes[0]!.split(" ")[0])).toBeCloseTo(0.2, 1);
    expect(changes[1]).toMatch(/ v$/);
  });

  test("the end of a program waits for its pulses", () => {
    const signals = new SignalTable();
    let end_s = 0;
    expect(
      run(of({ id: "p", type: "set", signal: "lamp", to: true, pulse_s: 0.2 }), signals, t_s => {
        end_s = t_s;
      }).kind,
    ).toBe("done");
    expect(end_s).toBeCloseTo(0.2, 1);
    expect(signals.read("lamp")).toBe(false);
  });

  test("T-30 a wait for a signal ends within 10 ms of it, and a timeout is a fault that names signal and time", () => {
    const signals = new SignalTable();
    const waiting = of({ id: "w", type: "wait-for", when: { signal: "part", is: true }, timeout_s: 2 });
    let end_s = 0;
    expect(
      run(waiting, signals, t_s => {
        end_s = t_s;
        if (t_s >= 1.3) signals.write("part", true);
      }).kind,
    ).toBe("done");
    expect(Math.abs(end_s - 1.3)).toBeLessThanOrEqual(0.01);
    const late = run(waiting, new SignalTable(), t_s => {
      end_s = t_s;
    });
    expect(late).toMatchObject({
      kind: "fault",
      fault: { step: "w", code: "signals.timeout", sentence: "Step “w” waited 2 s for the signal “part”." },
    });
    expect(Math.abs(end_s - 2)).toBeLessThanOrEqual(0.01);
  });

  const down = (missing: "continue" | "fault"): Step => ({
    id: "s",
    type: "move",
    path: "lin",
    target: at(0.6, 0.2, 0.3),
    speed: { mps: 0.1 },
    blend_m: 0,
    until: { when: { signal: "part", is: true }, missing },
  });
  const height = (): number => flangePose(robot.arm, q).position[2];

  test("a search stops where its signal comes, and the next step starts from there", () => {
    const over = { ...(steps[1] as MoveStep), target: at(0.6, 0.2, 0.4), blend_m: 0 };
    const signals = new SignalTable();
    let seen_m = 0;
    let stopped_m = 0;
    const end = run(of(steps[0]!, over, down("fault"), { id: "w", type: "wait", s: 0.1 }), signals, (_t, state) => {
      if (state.step === "s" && height() < 0.36 && signals.read("part") === false) {
        signals.write("part", true);
        seen_m = height();
      }
      if (state.step === "w") stopped_m = height();
    });
    expect(end.kind).toBe("done");
    expect(seen_m - stopped_m).toBeGreaterThanOrEqual(0);
    expect(seen_m - stopped_m).toBeLessThan(0.005);
  });

  test("a search that finds nothing is a fault, or goes on when it says so; one that has found already does not move", () => {
    const over = { ...(steps[1] as MoveStep), target: at(0.6, 0.2, 0.4), blend_m: 0 };
    expect(run(of(steps[0]!, over, down("fault")), new SignalTable())).toMatchObject({
      kind: "fault",
      fault: { code: "search.missing", step: "s" },
    });
    expect(run(of(steps[0]!, over, down("continue")), new SignalTable()).kind).toBe("done");
    expect(height()).toBeCloseTo(0.3, 6);
    expect(run(of(steps[0]!, over, down("fault")), new SignalTable([["part", true]])).kind).toBe("done");
    expect(height()).toBeCloseTo(0.4, 6);
  });

  test("a decision is taken when the robot is there, even behind a move that is passed", () => {
    const blended = { ...(steps[1] as MoveStep), blend_m: 0.02 };
    const signals = new SignalTable();
    const done: string[] = [];
    const choice: Step = {
      id: "i",
      type: "if",
      when: { signal: "part", is: true },
      then: [{ id: "yes", type: "wait", s: 0.1 }],
      else: [{ id: "no", type: "wait", s: 0.1 }],
    };
    run(of(steps[0]!, blended, choice, steps[2]!), signals, (_t, state) => {
      if (state.step === "b" && height() < 0.41) signals.write("part", true);
      if (done.at(-1) !== state.step) done.push(state.step);
    });
    expect(done).toEqual(["a", "b", "yes", "c", ""]);
  });

  test("payload and message are told, a stop ends everything, a block by itself is a fault that says why", () => {
    const load: Step = { id: "l", type: "payload", mass_kg: 2, center_m: [0, 0, 0.1] };
    const say: Step = { id: "m", type: "message", text: "Tray full." };
    const state = run(
      of(
        load,
        say,
        { id: "r", type: "repeat", times: "forever", steps: [{ id: "x", type: "stop" }] },
        { id: "never", type: "wait", s: 9 },
      ),
      new SignalTable(),
    );
    expect(state).toMatchObject({ kind: "done", message: "Tray full.", payload: { mass_kg: 2 } });
    const stepper = new Stepper(robot, program, [{ id: "r", type: "repeat", times: 2, steps: [] }], robot.home_rad);
    stepper.advance(DT, 1, q);
    expect(stepper.advance(DT, 1, q)).toMatchObject({ kind: "fault", fault: { code: "program.block", step: "r" } });
  });

  test("a loop without end that does nothing lets time pass and can be stopped", () => {
    const idle = of({
      id: "r",
      type: "repeat",
      times: "forever",
      steps: [{ id: "c", type: "comment", text: "nothing" }],
    });
    const stepper = new Stepper(robot, idle, unrolled(idle), robot.home_rad);
    for (let k = 0; k < 100; k++) expect(stepper.advance(DT, 1, q).kind).toBe("running");
    stepper.stop();
    expect(stepper.advance(DT, 1, q).kind).toBe("stopped");
  });
});
