import fc from "fast-check";
import {
  distance,
  emptyProgram,
  flangePose,
  manualScheduler,
  PlainFault,
  robotById,
  seededRandom,
  unrolled,
  type Program,
  type RobotController,
  type Step,
  type Vector3,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { describeController, numericSolver, onCorruptSample } from "../testing/index.ts";
import { createTwin } from "../twin/index.ts";
import { createVirtualController } from "./controller.ts";

const robot = robotById("staubli_rx90l")!;
const HOME = robot.home_rad;
const near = (by: number): number[] => HOME.map(q => q + by);

describeController("virtual RX90L", {
  robot,
  scheduler: manualScheduler,
  make: options => createVirtualController(options),
});
describeController("virtual RX90L with a second solver", {
  robot,
  scheduler: manualScheduler,
  make: options => createVirtualController({ ...options, solve: numericSolver(options.robot) }),
});

describe("virtual controller", () => {
  const bench = (options = {}) => {
    const scheduler = manualScheduler();
    return { scheduler, robot: createVirtualController({ robot, scheduler, ...options }) };
  };
  const move = (id: string, q: readonly number[]): Step => ({
    id,
    type: "move",
    path: "ptp",
    target: { q },
    speed: { ratio: 1 },
    blend_m: 0,
  });

  test("emits one sample each 4 ms, also when ticks come late", () => {
    let now_s = 0;
    let tick = (): void => undefined;
    const late = {
      now_s: () => now_s,
      every: (_: number, ticking: () => void) => {
        tick = ticking;
        return () => undefined;
      },
    };
    const controller = createVirtualController({ robot, scheduler: late });
    const times: number[] = [];
    onCorruptSample(controller, sample => times.push(sample.time_s));
    for (const to of [0.004, 0.011, 0.1, 0.1]) {
      now_s = to;
      tick();
    }
    expect(times.length).toBe(25);
    times.forEach((time, i) => expect(time).toBeCloseTo(0.004 * (i + 1), 12));
    now_s = 60;
    tick();
    expect(times.length).toBeLessThanOrEqual(25 + 251);
    expect(times.at(-1)).toBeCloseTo(60, 9);
  });

  test("stopped while it is held it has nothing left to brake when the override comes back", async () => {
    const { scheduler, robot: controller } = bench();
    const command = controller.moveJoints(near(0.8));
    await scheduler.elapse(0.3);
    controller.setSpeed(0);
    await scheduler.elapse(1);
    const held = controller.jointAngles();
    controller.stop();
    expect((await command).kind).toBe("stopped");
    controller.setSpeed(100);
    await scheduler.elapse(1);
    expect(controller.jointAngles()).toEqual(held);
  });

  test("a stop brakes within the stated time, within every joint's acceleration, and stays on the path", async () => {
    const { scheduler, robot: controller } = bench();
    const from = controller.jointAngles();
    const to = near(0.8);
    const command = controller.moveJoints(to);
    await scheduler.elapse(0.3);
    const speeds: number[][] = [];
    let last = controller.jointAngles();
    onCorruptSample(controller, sample => {
      speeds.push([...sample.q_rad].map((q, i) => (q - last[i]!) / 0.004));
      last = Float64Array.from(sample.q_rad);
    });
    await scheduler.elapse(0.02);
    const stopped_s = scheduler.now_s();
    controller.stop();
    let standing_s = NaN;
    void command.then(() => {
      standing_s = scheduler.now_s();
    });
    await scheduler.elapse(1);
    expect(standing_s - stopped_s).toBeLessThanOrEqual(controller.brakingTime_s + 0.004 + 1e-9);
    robot.arm.joints.forEach(({ limits }, i) => {
      for (let k = 1; k < speeds.length; k++) {
        expect(Math.abs(speeds[k]![i]! - speeds[k - 1]![i]!) / 0.004).toBeLessThanOrEqual(
          limits.acceleration_rad_s2 * 1.02,
        );
      }
    });
    const part = (last[0]! - from[0]!) / (to[0]! - from[0]!);
    last.forEach((q, i) => expect(q).toBeCloseTo(from[i]! + part * (to[i]! - from[i]!), 9));
    expect(part).toBeLessThan(1);
  });

  test("X-41 wherever a program is stopped, it stands within the stated braking time", async () => {
    const random = seededRandom(5);
    const start = [0, -0.6, 2.4, 0, 0.5, 0];
    const {
      position: [x, y, z],
      quaternion,
    } = flangePose(robot.arm, start);
    for (let i = 0; i < 60; i++) {
      const { scheduler, robot: controller } = bench({ start_rad: start });
      const steps = [0, 1, 2, 3, 4].map(
        (k): Step => ({
          id: `s${k}`,
          type: "move",
          ...(i % 3 === 0
            ? {
                path: "ptp",
                target: {
                  q: robot.arm.joints.map(
                    ({ limits }) => limits.lower_rad + random() * (limits.upper_rad - limits.lower_rad),
                  ),
                },
                speed: { ratio: 1 },
              }
            : {
                path: "lin",
                target: {
                  pose: { position: [x - 0.4 * random(), y + 0.6 * random() - 0.3, z + 0.3 * random()], quaternion },
                  frame: "world",
                  tool: "flange",
                },
                speed: { mps: 3 },
              }),
          blend_m: k < 4 && i % 2 === 1 ? 0.05 : 0,
        }),
      );
      let ended_s = NaN;
      void controller.run(steps, { tools: {}, frames: {} }).then(() => {
        ended_s = scheduler.now_s();
      });
      await scheduler.elapse(0.05 + random());
      const stopped_s = scheduler.now_s();
      controller.stop();
      await scheduler.elapse(controller.brakingTime_s);
      expect(Number.isNaN(ended_s), `program ${i}`).toBe(false);
      expect(ended_s - stopped_s).toBeLessThanOrEqual(controller.brakingTime_s);
      controller.close();
    }
  });

  test("T-30 a wait lasts as long as it says, whatever the override", async () => {
    for (const percent of [100, 30]) {
      const { scheduler, robot: controller } = bench();
      controller.setSpeed(percent);
      const steps: Step[] = [{ id: "w", type: "wait", s: 0.5 }];
      const begun_s = scheduler.now_s();
      let ended_s = NaN;
      void controller.run(steps, { tools: {}, frames: {} }).then(() => {
        ended_s = scheduler.now_s();
      });
      await scheduler.elapse(1);
      expect(Math.abs(ended_s - begun_s - 0.5)).toBeLessThanOrEqual(0.01);
    }
  });

  test("T-31 the gripper follows: true closes, false opens; samples name the step", async () => {
    const { scheduler, robot: controller } = bench();
    const seen: string[] = [];
    onCorruptSample(controller, ({ step, gripperClosed }) => {
      const line = `${step} ${gripperClosed}`;
      if (seen.at(-1) !== line) seen.push(line);
    });
    const steps: Step[] = [
      move("a", near(0.1)),
      { id: "g", type: "gripper", closed: true },
      { id: "w", type: "wait", s: 0.1 },
      move("b", HOME),
      { id: "h", type: "gripper", closed: false },
      { id: "v", type: "wait", s: 0.1 },
    ];
    void controller.run(steps, { tools: {}, frames: {} });
    await scheduler.elapse(3);
    expect(seen).toEqual(["a false", "g true", "w true", "b true", "h false", "v false", " false"]);
  });

  test("outputs, inputs and pulses are in the samples; the program waits for an input", async () => {
    const { scheduler, robot: controller } = bench();
    const seen: string[] = [];
    onCorruptSample(controller, ({ step, signals }) => {
      const line = `${step} ${[...signals!].map(([name, value]) => `${name}=${value}`).join(",")}`;
      if (seen.at(-1) !== line) seen.push(line);
    });
    const done: string[] = [];
    const steps: Step[] = [
      { id: "a", type: "set", signal: "lamp", to: true },
      { id: "b", type: "wait-for", when: { signal: "part", is: true }, timeout_s: 5 },
      { id: "c", type: "set", signal: "level", to: 2.5 },
      { id: "d", type: "wait", s: 0.1 },
    ];
    void controller.run(steps, { tools: {}, frames: {} }).then(({ kind }) => done.push(kind));
    await scheduler.elapse(1);
    expect(done).toEqual([]);
    controller.atTheRobot.setInput("part", true);
    await scheduler.elapse(0.5);
    expect(done).toEqual(["done"]);
    expect(seen.filter(line => !line.startsWith("a"))).toEqual([
      "b lamp=true",
      "d lamp=true,part=true,level=2.5",
      " lamp=true,part=true,level=2.5",
    ]);
    expect([
      controller.signals.read("lamp"),
      controller.signals.read("level"),
      controller.signals.read("nothing"),
    ]).toEqual([true, 2.5, false]);
  });

  test("T-32 one program of points, waits and gripper actions, in a loop, runs alike on a virtual robot, a simulated real one and a twin", async () => {
    const program: Program = {
      ...emptyProgram(robot.id),
      steps: [
        {
          id: "r",
          type: "repeat",
          times: 2,
          steps: [
            move("a", near(0.1)),
            { id: "g", type: "gripper", closed: true },
            { id: "w", type: "wait", s: 0.1 },
            move("b", HOME),
            { id: "h", type: "gripper", closed: false },
          ],
        },
      ],
    };
    const runs = await Promise.all(
      (["virtual", "real", "twin"] as const).map(async kind => {
        const { scheduler, robot: virtual } = bench();
        const real: RobotController = kind === "virtual" ? virtual : { ...virtual, kind: "real" };
        const controller = kind === "twin" ? createTwin({ real, scheduler }) : real;
        const seen: string[] = [];
        const outcomes: string[] = [];
        onCorruptSample(controller, ({ step, gripperClosed, q_rad }) => {
          seen.push(`${step} ${gripperClosed} ${q_rad.join()}`);
        });
        void controller.run(unrolled(program), program).then(({ kind: outcome }) => outcomes.push(outcome));
        await scheduler.elapse(5);
        return { outcomes, seen };
      }),
    );
    expect(runs[0]!.outcomes).toEqual(["done"]);
    expect(new Set(runs[0]!.seen.map(line => line.split(" ").slice(0, 2).join(" ")))).toEqual(
      new Set(["a false", "g true", "w true", "b true", "h false", "a false", " false"]),
    );
    expect(runs[1]).toEqual(runs[0]);
    expect(runs[2]).toEqual(runs[0]);
  });

  test("the next step is asked for when it is needed", async () => {
    const { scheduler, robot: controller } = bench();
    let asked = 0;
    function* endless(): Generator<Step> {
      for (;;) yield move(`s${asked++}`, near(asked % 2 ? 0.2 : 0));
    }
    void controller.run(endless(), { tools: {}, frames: {} });
    await scheduler.elapse(0.1);
    expect(asked).toBe(1);
    await scheduler.elapse(3);
    expect(asked).toBeGreaterThan(3);
    controller.close();
  });

  test("a step that cannot be done stops the program there, with the reason; as the first it is refused", async () => {
    const { scheduler, robot: controller } = bench();
    const far = near(0);
    far[0] = 9;
    const outcomes: unknown[] = [];
    void controller
      .run([move("a", near(0.1)), move("far", far)], { tools: {}, frames: {} })
      .then(outcome => outcomes.push(outcome));
    await scheduler.elapse(3);
    void controller.run([move("far", far)], { tools: {}, frames: {} }).then(outcome => outcomes.push(outcome));
    await scheduler.elapse(0.1);
    const why = { code: "limits.joint", sentence: expect.stringContaining("joint 1") };
    expect(outcomes).toMatchObject([
      { kind: "stopped", why },
      { kind: "refused", why },
    ]);
  });

  test("straight and circular steps run, with tools, frames and blends", async () => {
    const start = [0, -0.6, 2.4, 0, 0.5, 0];
    const { scheduler, robot: controller } = bench({ start_rad: start });
    const from = flangePose(robot.arm, start);
    const [x, y, z] = from.position;
    const { quaternion } = from;
    const rest = { type: "move", blend_m: 0, speed: { mps: 0.2 } } as const;
    const at = (dx: number, dy: number, dz: number) => ({
      pose: { position: [x + dx, y + dy, z + dz] as Vector3, quaternion },
      frame: "world",
      tool: "flange",
    });
    const seen: Vector3[] = [];
    onCorruptSample(controller, lent => {
      if (lent.step === "line") seen.push([...flangePose(robot.arm, lent.q_rad).position]);
    });
    const command = controller.run(
      [
        { ...rest, id: "line", path: "lin", target: at(0, 0.2, 0) },
        { ...rest, id: "arc", path: "circ", via: at(-0.05, 0.25, 0), target: at(-0.1, 0.2, 0) },
        { ...rest, id: "corner", path: "lin", target: at(-0.1, 0.1, 0), blend_m: 0.02 },
        { ...rest, id: "end", path: "lin", target: at(0, 0.1, 0) },
      ],
      { tools: {}, frames: {} },
    );
    await scheduler.elapse(10);
    expect(await command).toEqual({ kind: "done" });
    expect(seen.length).toBeGreaterThan(200);
    for (const [px, , pz] of seen) {
      expect(Math.abs(px - x)).toBeLessThan(1e-4);
      expect(Math.abs(pz - z)).toBeLessThan(1e-4);
    }
    expect(distance(flangePose(robot.arm, controller.jointAngles()).position, [x, y + 0.1, z])).toBeLessThan(1e-6);
  });

  test("a program that faults by itself ends there; the robot takes the next command", async () => {
    const { scheduler, robot: controller } = bench();
    const outcomes: unknown[] = [];
    function* faulty(reason: Error): Generator<Step> {
      yield move("a", near(0.1));
      throw reason;
    }
    for (const reason of [
      new PlainFault("text.divide-by-zero", "Line 4 divides by zero.", "Check the divisor."),
      new Error("no such array"),
    ]) {
      void controller.run(faulty(reason), { tools: {}, frames: {} }).then(outcome => outcomes.push(outcome));
      await scheduler.elapse(2);
    }
    expect(outcomes).toMatchObject([
      {
        kind: "stopped",
        why: { code: "text.divide-by-zero", sentence: "Line 4 divides by zero.", hint: "Check the divisor." },
      },
      {
        kind: "stopped",
        why: { code: "controller.program-fault", sentence: expect.stringContaining("no such array") },
      },
    ]);
    const next = controller.moveToZero();
    await scheduler.elapse(5);
    expect(await next).toEqual({ kind: "done" });
  });

  test("whatever is commanded whenever, limits and speeds are kept and every command is answered", async () => {
    const joints = robot.arm.joints;
    const slack = 1e-6;
    const anything = fc.array(
      fc.record({
        what: fc.constantFrom(
          "move",
          "joint",
          "zero",
          "stop",
          "emergency",
          "reset",
          "speed",
          "guard",
          "protective",
          "manual",
          "automatic",
          "jog",
          "run",
          "jump",
        ),
        part: fc.array(fc.double({ min: -0.1, max: 1.1, noNaN: true }), { minLength: 6, maxLength: 6 }),
        wait_s: fc.double({ min: 0, max: 0.8, noNaN: true }),
      }),
      { minLength: 1, maxLength: 25 },
    );
    await fc.assert(
      fc.asyncProperty(anything, async commands => {
        const { scheduler, robot: controller } = bench();
        let asked = 0;
        let answered = 0;
        let jumped = false;
        let last = controller.jointAngles();
        const faults: string[] = [];
        onCorruptSample(controller, lent => {
          joints.forEach(({ limits }, i) => {
            const q = lent.q_rad[i]!;
            if (!(q >= limits.lower_rad - slack && q <= limits.upper_rad + slack))
              faults.push(`joint ${i + 1} at ${q}`);
            if (!jumped && Math.abs(q - last[i]!) > limits.speed_rad_s * 0.004 * 1.001)
              faults.push(`joint ${i + 1} by ${q - last[i]!}`);
          });
          jumped = false;
          last = Float64Array.from(lent.q_rad);
        });
        const count = (outcome: Promise<unknown>): void => {
          asked++;
          void outcome.then(() => {
            answered++;
          });
        };
        for (const { what, part, wait_s } of commands) {
          const q = joints.map(({ limits }, i) => limits.lower_rad + part[i]! * (limits.upper_rad - limits.lower_rad));
          if (what === "move") count(controller.moveJoints(q));
          else if (what === "joint") count(controller.moveJoint(2, q[1]!));
          else if (what === "zero") count(controller.moveToZero());
          else if (what === "run")
            count(
              controller.run([move("a", q), { id: "w", type: "wait", s: 0.1 }, move("b", HOME)], {
                tools: {},
                frames: {},
              }),
            );
          else if (what === "jog") count(controller.atTheRobot.jog(q));
          else if (what === "jump") jumped = controller.jumpTo(q).kind === "done" || jumped;
          else if (what === "stop" || what === "emergency") controller.stop(what === "emergency");
          else if (what === "reset") void controller.reset();
          else if (what === "speed") controller.setSpeed(100 * Math.max(0, Math.min(1, part[0]!)));
          else if (what === "guard") controller.atTheRobot.setGuardOpen(part[0]! > 0.5);
          else if (what === "protective") controller.atTheRobot.protectiveStop("A test.");
          else controller.atTheRobot.setMode(what);
          await scheduler.elapse(wait_s);
        }
        controller.setSpeed(100);
        await scheduler.elapse(20);
        expect(faults).toEqual([]);
        expect(answered).toBe(asked);
      }),
      { seed: 7, numRuns: 40 },
    );
  });

  test("a second command while one runs is refused, and the first goes on", async () => {
    const { scheduler, robot: controller } = bench();
    const first = controller.moveJoints(near(0.2));
    expect(await controller.moveToZero()).toMatchObject({ kind: "refused", why: { code: "controller.busy" } });
    await scheduler.elapse(3);
    expect(await first).toEqual({ kind: "done" });
  });

  test("T-26 in manual mode the pendant moves it and others are refused; the switch stops a move under way", async () => {
    const { scheduler, robot: controller } = bench();
    expect(await controller.atTheRobot.jog(near(0.1))).toMatchObject({
      kind: "refused",
      why: { code: "controller.not-manual" },
    });
    const running = controller.moveJoints(near(0.8));
    await scheduler.elapse(0.2);
    controller.atTheRobot.setMode("manual");
    await scheduler.elapse(1);
    expect(await running).toMatchObject({ kind: "stopped", why: { code: "controller.mode-changed" } });
    expect(await controller.moveToZero()).toMatchObject({ kind: "refused", why: { code: "controller.manual-mode" } });
    const jog = controller.atTheRobot.jog(near(0.1));
    await scheduler.elapse(2);
    expect(await jog).toEqual({ kind: "done" });
  });

  test("T-27 a guard stop ends the move and clears itself without moving; a protective stop wants a reset", async () => {
    const { scheduler, robot: controller } = bench();
    const first = controller.moveJoints(near(0.8));
    await scheduler.elapse(0.2);
    controller.atTheRobot.setGuardOpen(true);
    await scheduler.elapse(1);
    expect(await first).toMatchObject({ kind: "stopped", why: { code: "safety.guard-stop" } });
    expect(await controller.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.guard-stop" } });
    expect((await controller.reset()).kind).toBe("refused");
    const rest = controller.jointAngles();
    controller.atTheRobot.setGuardOpen(false);
    await scheduler.elapse(1);
    expect(controller.jointAngles()).toEqual(rest);
    const second = controller.moveJoints(HOME);
    await scheduler.elapse(0.1);
    controller.atTheRobot.protectiveStop("Joint 2 met a resistance.");
    expect(await controller.reset()).toMatchObject({ kind: "refused", why: { code: "controller.braking" } });
    await scheduler.elapse(1);
    expect(await second).toMatchObject({ kind: "stopped", why: { code: "safety.protective-stop" } });
    expect((await controller.moveToZero()).kind).toBe("refused");
    expect((await controller.reset()).kind).toBe("done");
    const third = controller.moveToZero();
    await scheduler.elapse(5);
    expect(await third).toEqual({ kind: "done" });
  });

  test("T-67 without a solver poses are refused and joint moves still work", async () => {
    const { scheduler, robot: controller } = bench({ solve: null });
    expect(await controller.moveToPose({ position: [0.5, 0, 0.5], quaternion: [0, 0, 0, 1] })).toMatchObject({
      kind: "refused",
      why: { code: "controller.no-solver" },
    });
    const move = controller.moveToZero();
    await scheduler.elapse(5);
    expect(await move).toEqual({ kind: "done" });
  });

  test("a pose out of reach is refused with the distance, and nothing moves", async () => {
    const { scheduler, robot: controller } = bench();
    const before = controller.jointAngles();
    const outcome = await controller.moveToPose({ position: [3, 0, 0.42], quaternion: [0, 0, 0, 1] });
    expect(outcome).toMatchObject({ kind: "refused", why: { code: "reach.too-far" } });
    if (outcome.kind === "refused") expect(outcome.why.sentence).toMatch(/\d/);
    await scheduler.elapse(0.1);
    expect(controller.jointAngles()).toEqual(before);
  });

  test("closing ends what runs and refuses what comes", async () => {
    const { scheduler, robot: controller } = bench();
    let samples = 0;
    onCorruptSample(controller, () => {
      samples++;
    });
    const running = controller.moveToZero();
    await scheduler.elapse(0.1);
    controller.close();
    const before = samples;
    await scheduler.elapse(1);
    expect(samples).toBe(before);
    expect(await running).toMatchObject({ kind: "stopped", why: { code: "controller.closed" } });
    expect(await controller.moveToZero()).toMatchObject({ kind: "refused", why: { code: "controller.closed" } });
  });
});
