import { manualScheduler, robotById, seededRandom, type CommandOutcome } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { createRealController } from "../../driver/index.ts";
import { memoryNetwork } from "../../transport/index.ts";
import { createUrAdapter, createVirtualUr, ROBOT_MODE, RUNTIME } from "../index.ts";
import { HOST, robot, urBench } from "../testing/bench.ts";

const FAR = [2.5, -1.2, 1.4, -1.4, -1.2, 0.4];
/** The watchdog on the robot, two cycles and the braking of the arm. */
const WATCHDOG_S = 0.08;
function watched<T>(promise: Promise<T>): { value: T | undefined } {
  const seen: { value: T | undefined } = { value: undefined };
  void promise.then(value => {
    seen.value = value;
  });
  return seen;
}
const still = (before: Float64Array, after: Float64Array): boolean =>
  before.every((q, i) => Math.abs(q - after[i]!) < 1e-9);

describe("UR driver: who answers", () => {
  test("a robot of another model is refused with both names, and not asked again", async () => {
    const { scheduler, network } = await urBench({ model: "UR5" });
    const controller = createRealController({
      face: createUrAdapter({ robot, scheduler, network, host: HOST }),
      scheduler,
    });
    const outcome = watched(controller.connect());
    await scheduler.elapse(0.5);
    expect(outcome.value).toMatchObject({
      kind: "refused",
      why: {
        code: "link.other-robot",
        sentence: expect.stringMatching(/Universal Robots UR10e .*UR10; a UR5 answers\.$/) as string,
      },
    });
    expect(controller.link.state).toBe("closed");
  });

  test("an arm without six joints is refused by the driver and by the virtual controller", async () => {
    const iiwa = robotById("kuka_lbr_iiwa_14_r820")!;
    const scheduler = manualScheduler();
    const network = memoryNetwork(scheduler);
    const controller = createRealController({
      face: createUrAdapter({ robot: iiwa, scheduler, network, host: HOST }),
      scheduler,
    });
    const sentence = expect.stringContaining("has 7 joints; robots of Universal Robots have 6.") as string;
    expect(await controller.connect()).toMatchObject({ kind: "refused", why: { code: "link.other-robot", sentence } });
    expect(
      await createVirtualUr({
        robot: iiwa,
        scheduler,
        network,
        interpret: () => ({ kind: "not-understood", faults: [] }),
      }),
    ).toMatchObject({ kind: "taken", sentence });
  });

  test.each([
    [
      "nobody there",
      () => {
        /* See below. */
      },
      /Nobody answers at 127\.0\.0\.9/,
    ],
    ["refused", "refusing", /closed the connection|does not answer/],
    ["taken and silent", "silent", /did not answer|does not answer/],
    ["software that is too old", "oldProtocol", /too old/],
    ["inputs of another client", "inUse", /Another client writes input_int_register_24/],
  ] as const)("%s: told in words, tried again", async (_, fault, words) => {
    const { scheduler, network, ur } = await urBench();
    if (typeof fault === "string") ur.faults[fault] = true;
    const controller = createRealController({
      face: createUrAdapter({ robot, scheduler, network, host: typeof fault === "string" ? HOST : "127.0.0.9" }),
      scheduler,
    });
    const outcome = watched(controller.connect());
    await scheduler.elapse(8);
    expect(outcome.value).toMatchObject({ kind: "refused", why: { sentence: expect.stringMatching(words) as string } });
    expect(controller.link.attempts).toBeGreaterThan(1);
    if (typeof fault === "string") {
      ur.faults[fault] = false;
      await scheduler.elapse(15);
      expect(controller.isConnected).toBe(true);
    }
  });

  test("somebody else's program is left alone: a motion is refused, and works when it has ended", async () => {
    const bench = await urBench();
    const { stream } = await bench.connect("secondary");
    const text = "def theirs():\n  while True:\n    sync()\n  end\nend\n";
    stream.send(Uint8Array.from(text, letter => letter.charCodeAt(0)));
    await bench.scheduler.elapse(0.1);
    const controller = await bench.driver();
    expect(bench.ur.state.runtime).toBe(RUNTIME.PLAYING);
    const refused = watched(controller.moveJoints(FAR));
    await bench.scheduler.elapse(0.1);
    expect(refused.value).toMatchObject({ kind: "refused", why: { code: "controller.program-running" } });
    bench.ur.pendant.stopProgram();
    await bench.scheduler.elapse(0.1);
    const next = watched(controller.moveJoints(FAR));
    await bench.scheduler.elapse(6);
    expect(next.value).toEqual({ kind: "done" });
  });
});

describe("UR driver: what breaks on the way", () => {
  test("X-41 T-47 a driver that stalls for two seconds: the robot's own watchdog stops it within the stated time", async () => {
    const bench = await urBench();
    const controller = await bench.driver();
    const running = watched(controller.moveJoints(FAR));
    await bench.scheduler.elapse(0.5);
    expect(bench.ur.state.moving).toBe(true);
    expect(controller.watchdog).toEqual({ kind: "robot", within_s: WATCHDOG_S });
    // Nothing from or to the driver arrives, and nobody is told.
    bench.network.weather.frozen = true;
    await bench.scheduler.elapse(WATCHDOG_S + 0.01);
    expect(bench.ur.state.runtime).toBe(RUNTIME.STOPPED);
    await bench.scheduler.elapse(bench.ur.brakingTime_s);
    const rest = bench.ur.jointAngles();
    await bench.scheduler.elapse(2 - WATCHDOG_S - 0.01 - bench.ur.brakingTime_s);
    expect(still(rest, bench.ur.jointAngles())).toBe(true);
    expect(running.value).toMatchObject({ kind: "stopped" });
    bench.network.weather.frozen = false;
    await bench.scheduler.elapse(12);
    expect(controller.isConnected).toBe(true);
    expect(still(rest, bench.ur.jointAngles())).toBe(true);
    const next = watched(controller.moveJoints(FAR));
    await bench.scheduler.elapse(6);
    expect(next.value).toEqual({ kind: "done" });
  });

  test("T-46 T-47 a stop goes out at once and alone, while a question waits for its answer; no call takes time", async () => {
    const bench = await urBench();
    const controller = await bench.driver();
    const running = watched(controller.moveJoints(FAR));
    await bench.scheduler.elapse(0.5);
    // Everything the controller says is two tenths late: questions wait, states are old.
    bench.ur.faults.delay_s = 0.2;
    const began_ms = performance.now();
    void controller.reset();
    controller.stop();
    expect(performance.now() - began_ms).toBeLessThan(50);
    await bench.scheduler.elapse(0.004 + bench.ur.brakingTime_s);
    expect(bench.ur.state.moving).toBe(false);
    await bench.scheduler.elapse(1);
    expect(running.value).toMatchObject({ kind: "stopped" });
  });

  test("a stop that the program on the robot does not take goes through the dashboard", async () => {
    const bench = await urBench();
    const controller = await bench.driver();
    void controller.moveJoints(FAR);
    await bench.scheduler.elapse(0.5);
    // The orders are spoilt on their way: another client's hand on the register.
    const order = bench.ur.memory.get("input_int_register_25");
    const spoil = bench.scheduler.every(0.0005, () => {
      bench.ur.memory.set("input_int_register_25", order);
    });
    controller.stop();
    await bench.scheduler.elapse(0.06 + bench.ur.brakingTime_s);
    expect([bench.ur.state.moving, bench.ur.state.runtime]).toEqual([false, RUNTIME.STOPPED]);
    spoil();
  });

  const afterwards: readonly (readonly [string, (bench: Awaited<ReturnType<typeof urBench>>) => Promise<void>])[] = [
    [
      "the line is cut",
      async ({ network }) => {
        network.cut();
        await Promise.resolve();
      },
    ],
    [
      "half of the line is gone and nobody says so",
      async ({ network }) => {
        network.cut(true);
        await Promise.resolve();
      },
    ],
    [
      "the controller hangs for a second",
      async ({ ur, scheduler }) => {
        ur.faults.frozen = true;
        await scheduler.elapse(1);
        ur.faults.frozen = false;
      },
    ],
    [
      "it breaks off after some packages",
      async ({ ur, scheduler }) => {
        ur.faults.dropAfter = 20;
        await scheduler.elapse(0.3);
        ur.faults.dropAfter = 0;
      },
    ],
    [
      "garbage on the line",
      async ({ ur, scheduler }) => {
        ur.faults.garbage = 0.5;
        await scheduler.elapse(0.3);
        ur.faults.garbage = 0;
      },
    ],
  ];
  test.each(afterwards)(
    "%s: the motion ends, the link comes back by itself, the motion does not",
    async (_, breakIt) => {
      const bench = await urBench();
      const controller = await bench.driver();
      const running = watched(controller.moveJoints(FAR));
      await bench.scheduler.elapse(0.4);
      await breakIt(bench);
      await bench.scheduler.elapse(0.2 + bench.ur.brakingTime_s);
      const rest = bench.ur.jointAngles();
      for (let i = 0; i < 300 && !(controller.isConnected && running.value); i++) await bench.scheduler.elapse(0.1);
      expect([running.value?.kind, controller.isConnected]).toEqual(["stopped", true]);
      // An answer whose line end was spoilt is missed only after a while, and ends the link once more.
      await bench.scheduler.elapse(4);
      for (let i = 0; i < 300 && !controller.isConnected; i++) await bench.scheduler.elapse(0.1);
      expect(still(rest, bench.ur.jointAngles())).toBe(true);
      const next = watched(controller.moveJoints(FAR));
      for (let i = 0; i < 300 && !next.value; i++) await bench.scheduler.elapse(0.1);
      expect(next.value).toEqual({ kind: "done" });
    },
  );

  test("the controller is switched off and on: its clock begins again, its drives are off until somebody resets it", async () => {
    const bench = await urBench();
    const controller = await bench.driver();
    const running = watched(controller.moveJoints(FAR));
    await bench.scheduler.elapse(0.4);
    bench.ur.reboot();
    for (let i = 0; i < 100 && !(controller.isConnected && running.value); i++) await bench.scheduler.elapse(0.1);
    expect([running.value?.kind, controller.isConnected, bench.ur.state.robotMode]).toEqual([
      "stopped",
      true,
      ROBOT_MODE.POWER_OFF,
    ]);
    await bench.scheduler.elapse(0.1);
    expect(await controller.moveJoints(FAR)).toMatchObject({ kind: "refused" });
    void controller.reset();
    await bench.scheduler.elapse(2);
    const next = watched(controller.moveJoints(FAR));
    await bench.scheduler.elapse(6);
    expect(next.value).toEqual({ kind: "done" });
  });

  test("delay, jitter, single bytes and lost states on the way: motions still end where they should", async () => {
    const bench = await urBench();
    const controller = await bench.driver();
    Object.assign(bench.network.weather, { delay_s: 0.004, jitter_s: 0.006, pieces: 1 });
    bench.ur.faults.loss = 0.1;
    for (const target of [FAR, robot.home_rad]) {
      const outcome = watched(controller.moveJoints(target));
      for (let i = 0; i < 80 && !outcome.value; i++) await bench.scheduler.elapse(0.1);
      expect(outcome.value).toEqual({ kind: "done" });
    }
    expect(controller.link.missing).toBeGreaterThan(100);
  });

  test("60 faults at random moments: every command is answered, no limit is passed, nothing moves after a link that was lost", async () => {
    const bench = await urBench();
    const controller = await bench.driver();
    const random = seededRandom(11);
    const { limits } = robot.arm.joints[0]!;
    const { ur, scheduler, network } = bench;
    let asked = 0;
    let answered = 0;
    let last = ur.jointAngles();
    let fastest = 0;
    const look = scheduler.every(0.002, () => {
      const q = ur.jointAngles();
      fastest = Math.max(fastest, Math.abs(q[0]! - last[0]!) / 0.002 / limits.speed_rad_s);
      last = q;
    });
    const kinds = [
      "cut",
      "half",
      "freeze",
      "garbage",
      "split",
      "delay",
      "reboot",
      "stop",
      "emergency",
      "protective",
      "guard",
      "local",
    ] as const;
    for (let i = 0; i < 60; i++) {
      asked++;
      void controller.moveJoints([3 * (random() - 0.5), -1.2, 1.4, -1.4, -1.2, 0]).then((_: CommandOutcome) => {
        answered++;
      });
      await scheduler.elapse(0.3 * random());
      switch (kinds[Math.floor(random() * kinds.length)]!) {
        case "cut":
          network.cut();
          break;
        case "half":
          network.cut(true);
          break;
        case "freeze":
          ur.faults.frozen = true;
          await scheduler.elapse(0.3 * random());
          ur.faults.frozen = false;
          break;
        case "garbage":
          ur.faults.garbage = 0.2;
          await scheduler.elapse(0.1);
          ur.faults.garbage = 0;
          break;
        case "split":
          ur.faults.split = !ur.faults.split;
          break;
        case "delay":
          ur.faults.delay_s = 0.02 * random();
          break;
        case "reboot":
          ur.reboot();
          break;
        case "stop":
          controller.stop();
          break;
        case "emergency":
          controller.stop(true);
          break;
        case "protective":
          ur.pendant.protectiveStop("A test.");
          break;
        case "guard":
          ur.pendant.setGuardOpen(true);
          await scheduler.elapse(0.1);
          ur.pendant.setGuardOpen(false);
          break;
        case "local":
          ur.pendant.setMode("manual");
          await scheduler.elapse(0.2);
          ur.pendant.setMode("remote");
          break;
      }
      await scheduler.elapse(0.2 * random());
      if (random() < 0.3) void controller.reset();
    }
    await scheduler.elapse(25);
    look();
    expect(answered).toBe(asked);
    expect(fastest).toBeLessThanOrEqual(1.000001);
    expect(ur.state.moving).toBe(false);
    Object.assign(ur.faults, { split: false, delay_s: 0 });
    await scheduler.elapse(20);
    for (let i = 0; i < 4; i++) {
      void controller.reset();
      await scheduler.elapse(6);
    }
    const last_move = watched(controller.moveJoints(FAR));
    await scheduler.elapse(6);
    expect(last_move.value).toEqual({ kind: "done" });
  });
});
