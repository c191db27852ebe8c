import {
  flangePose,
  manualScheduler,
  robotById,
  type LinkReport,
  type Program,
  type RealController,
  type Step,
  type Target,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { describeController, inMemoryAdapter, type InMemoryAdapter } from "../testing/index.ts";
import { createRealController } from "./index.ts";

const robot = robotById("staubli_rx90l")!;
const NOTHING = { tools: {}, frames: {} } satisfies Pick<Program, "tools" | "frames">;

describeController("driver over a near face", {
  robot,
  scheduler: manualScheduler,
  cannot: [],
  async make({ scheduler, start_rad, maxSpeed, initialize, onMotion, robot: driven }) {
    const adapter = inMemoryAdapter(driven, scheduler, { start_rad, ...(maxSpeed === undefined ? {} : { maxSpeed }) });
    const controller = createRealController({
      face: adapter,
      scheduler,
      ...(initialize ? { initialize } : {}),
      ...(onMotion ? { onMotion } : {}),
    });
    await controller.connect();
    await scheduler.elapse(0.02);
    return controller;
  },
});

async function bench(): Promise<{
  scheduler: ReturnType<typeof manualScheduler>;
  face: InMemoryAdapter;
  real: RealController;
  links: string[];
}> {
  const scheduler = manualScheduler();
  const adapter = inMemoryAdapter(robot, scheduler);
  const real = createRealController({ face: adapter, scheduler });
  const links: string[] = [];
  real.onLink((report: LinkReport) => {
    links.push(report.state);
  });
  await real.connect();
  await scheduler.elapse(0.1);
  return { scheduler, face: adapter, real, links };
}
const shifted = (by_rad: number): number[] => Array.from(robot.home_rad, q => q + by_rad);

describe("a driver", () => {
  test("T-19 says whether it is connected: not before, while, and not after", async () => {
    const scheduler = manualScheduler();
    const real = createRealController({ face: inMemoryAdapter(robot, scheduler), scheduler });
    expect([real.isConnected, real.link.state]).toEqual([false, "closed"]);
    expect(await real.moveToZero()).toMatchObject({ kind: "refused", why: { code: "link.closed" } });
    const connecting = real.connect();
    expect([real.isConnected, real.link.state]).toEqual([false, "connecting"]);
    expect(await connecting).toEqual({ kind: "done" });
    expect([real.isConnected, real.link.state, real.link.sentence]).toEqual([true, "open", ""]);
    real.disconnect();
    expect([real.isConnected, real.link.state]).toEqual([false, "closed"]);
    await scheduler.elapse(30);
    expect(real.isConnected).toBe(false);
  });

  test("T-20 a fault of the robot arrives as its message", async () => {
    const { scheduler, face: adapter, real } = await bench();
    const heard: string[] = [];
    real.onSample(sample => {
      heard.push(`${sample.safety}: ${sample.message}`);
    });
    adapter.virtual.atTheRobot.protectiveStop("joint 2 met something");
    await scheduler.elapse(0.02);
    expect(heard.at(-1)).toBe("protective-stop: The robot made a protective stop: joint 2 met something");
    expect(await real.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.protective-stop" } });
  });

  test("X-41 silence ends the motion and the link within 100 ms; it comes back by itself, the motion does not", async () => {
    const { scheduler, face: adapter, real, links } = await bench();
    const moving = real.moveJoints(shifted(1));
    await scheduler.elapse(0.2);
    adapter.silent = true;
    const from_s = scheduler.now_s();
    let ended_s = NaN;
    void moving.then(() => {
      ended_s = scheduler.now_s();
    });
    await scheduler.elapse(0.1);
    expect(ended_s - from_s).toBeLessThanOrEqual(0.1);
    expect(await moving).toMatchObject({ kind: "stopped", why: { code: "link.stale" } });
    expect(real.link.sentence).toMatch(/^Nothing came from Near .* for \d+ ms\.$/);
    adapter.virtual.stop();
    adapter.silent = false;
    await scheduler.elapse(1);
    expect(links).toEqual(["connecting", "open", "lost", "connecting", "open"]);
    const rest = real.jointAngles();
    await scheduler.elapse(2);
    expect(real.jointAngles()).toEqual(rest);
  });

  test("X-41 before a silent link is given up the robot is told to stop once more: the line may be good in that direction", async () => {
    const { scheduler, face: adapter, real } = await bench();
    const moving = real.moveJoints(shifted(1));
    await scheduler.elapse(0.2);
    adapter.silent = true;
    await scheduler.elapse(0.1);
    expect((await moving).kind).toBe("stopped");
    await scheduler.elapse(1);
    expect(adapter.virtual.isMoving()).toBe(false);
    expect(adapter.virtual.jointAngle(1)).toBeLessThan(shifted(1)[0]! - 0.1);
    // Nobody moved it, and nothing is said to it.
    adapter.silent = false;
    await scheduler.elapse(2);
    void adapter.virtual.moveJoints(shifted(0));
    await scheduler.elapse(0.1);
    adapter.silent = true;
    await scheduler.elapse(0.2);
    expect(real.isConnected).toBe(false);
    expect(adapter.virtual.isMoving()).toBe(true);
  });

  test("T-47 a controller that counts from its beginning at every connection is heard from the first state of the next one", async () => {
    const { scheduler, face: adapter, real } = await bench();
    await scheduler.elapse(5);
    adapter.silent = true;
    adapter.breakLine();
    await scheduler.elapse(0.27);
    expect(real.isConnected).toBe(true);
    let heard = 0;
    real.onSample(() => {
      heard++;
    });
    for (let sequence = 1; sequence <= 5; sequence++) adapter.say({ sequence, time_s: 5.3 + sequence / 100 });
    expect(heard).toBe(5);
  });

  test("T-47 states that hold no pose, or none that is newer, are as good as silence", async () => {
    const nonsense = shifted(0).map((q, i) => (i === 2 ? 1e12 : q));
    const old = { sequence: 3, time_s: 5 };
    for (const said of [{ q_rad: Float64Array.from(nonsense) }, { q_rad: new Float64Array(6).fill(NaN) }, old]) {
      const { scheduler, face: adapter, real } = await bench();
      await scheduler.elapse(5);
      const rest = real.jointAngles();
      adapter.silent = true;
      for (let i = 1; i < 30; i++) {
        adapter.say({ sequence: 10_000 + i, time_s: 6 + i / 100, ...said });
        await scheduler.elapse(0.005);
      }
      expect(real.isConnected).toBe(false);
      expect(real.jointAngles()).toEqual(rest);
    }
  });

  test("T-47 a robot that was there is asked twice before it is taken for another one", async () => {
    const { scheduler, face: adapter, real } = await bench();
    adapter.failing = {
      kind: "failed",
      again: false,
      why: {
        code: "link.other-robot",
        sentence: "An RX90L was expected; an RX9OL answers.",
        hint: "Choose the robot that is there.",
      },
    };
    adapter.breakLine();
    await scheduler.elapse(0.3);
    expect(real.link.state).toBe("lost");
    adapter.failing = null;
    await scheduler.elapse(1);
    expect(real.link.state).toBe("open");
    adapter.failing = {
      kind: "failed",
      again: false,
      why: {
        code: "link.other-robot",
        sentence: "An RX90L was expected; an RX60L answers.",
        hint: "Choose the robot that is there.",
      },
    };
    adapter.breakLine();
    await scheduler.elapse(2);
    expect([real.link.state, real.link.sentence]).toEqual(["closed", "An RX90L was expected; an RX60L answers."]);
  });

  test("who slept himself does not take the silence for the robot's", async () => {
    const clock = manualScheduler();
    const adapter = inMemoryAdapter(robot, clock);
    const links: string[] = [];
    let asleep = false;
    const scheduler = {
      now_s: () => clock.now_s(),
      every: (period_s: number, tick: () => void) =>
        clock.every(period_s, () => {
          if (!asleep) tick();
        }),
    };
    const real = createRealController({ face: adapter, scheduler });
    await real.connect();
    await clock.elapse(0.1);
    real.onLink(report => {
      links.push(report.state);
    });
    asleep = adapter.silent = true;
    await clock.elapse(2);
    asleep = false;
    // The first tick after sleep comes before what waits to be read.
    await clock.elapse(adapter.stale_s / 4 + 0.001);
    adapter.silent = false;
    await clock.elapse(1);
    expect([real.isConnected, links]).toEqual([true, []]);
    asleep = adapter.silent = true;
    await clock.elapse(2);
    asleep = false;
    await clock.elapse(adapter.stale_s);
    expect(links[0]).toBe("lost");
  });

  test("a lost link is tried again with pauses that grow to eight seconds", async () => {
    const { scheduler, face: adapter, real } = await bench();
    const tries_s: number[] = [];
    real.onLink(report => {
      if (report.state === "connecting") tries_s.push(scheduler.now_s());
    });
    adapter.failing = {
      kind: "failed",
      again: true,
      why: { code: "link.refused", sentence: "Nobody answers.", hint: "" },
    };
    adapter.breakLine();
    expect(real.link).toMatchObject({ state: "lost", sentence: "The line broke." });
    await scheduler.elapse(40);
    const pauses_s = tries_s.slice(1).map((at_s, i) => Math.round((at_s - tries_s[i]!) * 100) / 100);
    expect(pauses_s.slice(0, 7)).toEqual([0.25, 0.5, 1, 2, 4, 8, 8]);
    adapter.failing = null;
    await scheduler.elapse(8.1);
    expect(real.isConnected).toBe(true);
  });

  test("a robot of another kind is refused once, with both names, and not tried again", async () => {
    const scheduler = manualScheduler();
    const adapter = inMemoryAdapter(robot, scheduler);
    const real = createRealController({ face: adapter, scheduler });
    adapter.failing = {
      kind: "failed",
      again: false,
      why: { code: "link.other-robot", sentence: "A Stäubli RX90L was expected; a TX2-60 answers.", hint: "" },
    };
    expect(await real.connect()).toMatchObject({ kind: "refused", why: { code: "link.other-robot" } });
    await scheduler.elapse(60);
    expect([real.link.state, adapter.opened]).toEqual(["closed", 0]);
  });

  test("what an old connection still says is not listened to, nor what is no number, nor what was overtaken", async () => {
    const { scheduler, face: adapter, real } = await bench();
    adapter.breakLine();
    await scheduler.elapse(1);
    const is = real.jointAngles();
    let heard = 0;
    real.onSample(() => {
      heard++;
    });
    adapter.say({ q_rad: new Float64Array(6).fill(1), sequence: 1e6 }, 0);
    adapter.say({ q_rad: new Float64Array(6).fill(NaN), sequence: 1e6 });
    adapter.say({ q_rad: new Float64Array(6).fill(1), sequence: 3 });
    expect([heard, [...real.jointAngles()]]).toEqual([0, [...is]]);
    adapter.say({ q_rad: new Float64Array(6).fill(1), sequence: 1e6 });
    expect([heard, real.jointAngle(1)]).toEqual([1, 1]);
  });

  test("T-61 the link tells its rate, what is missing and how late samples come", async () => {
    const { scheduler, face: adapter, real } = await bench();
    await scheduler.elapse(2);
    expect(real.link.rate_Hz).toBe(250);
    expect([real.link.missing, real.link.late_s < 1e-9]).toEqual([0, true]);
    adapter.silent = true;
    await scheduler.elapse(0.02);
    adapter.silent = false;
    await scheduler.elapse(0.02);
    expect(real.link.missing).toBe(5);
    const time_s = scheduler.now_s() - 0.015;
    adapter.say({ sequence: 1e6, time_s });
    expect(real.link.late_s).toBeCloseTo(0.015, 9);
  });

  test("steps that are no motion take effect in order; what the wire cannot say is refused by name", async () => {
    const { scheduler, face: adapter, real } = await bench();
    const run = (steps: readonly Step[]) => real.run(steps, NOTHING);
    const steps: Step[] = [
      { id: "a", type: "set", signal: "lamp", to: true },
      { id: "b", type: "wait", s: 0.5 },
      { id: "c", type: "set", signal: "lamp", to: false },
      { id: "d", type: "wait-for", when: { signal: "part", is: true }, timeout_s: 1 },
    ];
    const first = run(steps);
    await scheduler.elapse(0.25);
    expect(adapter.virtual.signals.read("lamp")).toBe(true);
    await scheduler.elapse(0.3);
    expect(adapter.virtual.signals.read("lamp")).toBe(false);
    adapter.virtual.atTheRobot.setInput("part", true);
    await scheduler.elapse(0.1);
    expect(await first).toEqual({ kind: "done" });
    adapter.virtual.atTheRobot.setInput("part", false);
    const second = run(steps.slice(3));
    await scheduler.elapse(1.1);
    expect(await second).toMatchObject({ kind: "stopped", why: { code: "signals.timeout" } });
    const spline: Step = {
      id: "s",
      type: "move",
      path: "spline",
      target: { q: shifted(0.1) },
      speed: { ratio: 1 },
      blend_m: 0,
    };
    expect(await run([spline])).toMatchObject({
      kind: "refused",
      why: { code: "controller.motion", sentence: expect.stringContaining("“s”") as string },
    });
    expect(await run([{ id: "p", type: "payload", mass_kg: 2, center_m: [0, 0, 0.1] }])).toMatchObject({
      kind: "refused",
      why: { code: "controller.payload" },
    });
  });

  test("lines and arcs keep their speed and end where they should", async () => {
    const { scheduler, real } = await bench();
    const bent = [0, -1, 2, 0, 0.6, 0];
    const carryOut = async (steps: readonly Step[]) => {
      const from_s = scheduler.now_s();
      const running = real.run(steps, NOTHING);
      let took_s = NaN;
      void running.then(() => {
        took_s = scheduler.now_s() - from_s;
      });
      for (let i = 0; i < 300 && Number.isNaN(took_s); i++) await scheduler.elapse(0.1);
      return { outcome: await running, took_s };
    };
    await carryOut([{ id: "go", type: "move", path: "ptp", target: { q: bent }, speed: { ratio: 1 }, blend_m: 0 }]);
    const from = flangePose(robot.arm, bent);
    const [x, y, z] = from.position;
    const target = (dy: number, dz: number): Target => ({
      pose: { position: [x, y + dy, z + dz], quaternion: from.quaternion },
      frame: "world",
      tool: "flange",
    });
    const line = await carryOut([
      { id: "line", type: "move", path: "lin", target: target(0.2, 0), speed: { mps: 0.1 }, blend_m: 0 },
    ]);
    expect(line.outcome).toEqual({ kind: "done" });
    expect(line.took_s).toBeGreaterThan(2);
    expect(line.took_s).toBeLessThan(2.4);
    expect(flangePose(robot.arm, real.jointAngles()).position[1]).toBeCloseTo(y + 0.2, 6);
    const arc = await carryOut([
      {
        id: "arc",
        type: "move",
        path: "circ",
        via: target(0.1, -0.1),
        target: target(0, 0),
        speed: { mps: 0.1 },
        blend_m: 0,
      },
    ]);
    expect(arc.outcome).toEqual({ kind: "done" });
    expect(arc.took_s).toBeGreaterThan(Math.PI);
    expect(flangePose(robot.arm, real.jointAngles()).position[1]).toBeCloseTo(y, 6);
  });
});
