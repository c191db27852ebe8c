import { flangePose, manualScheduler, posesAgree, type CommandOutcome, type Step, type Target } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { createRealController } from "../../driver/index.ts";
import { describeController } from "../../testing/contract.ts";
import { memoryNetwork } from "../../transport/index.ts";
import { createTwin } from "../../twin/index.ts";
import { UR_CANNOT } from "../cannot.ts";
import { createUrAdapter, createVirtualUr, ROBOT_MODE, SAFETY_MODE } from "../index.ts";
import { HOST, robot, urBench } from "../testing/bench.ts";

describeController("UR driver on its virtual controller", {
  // Two cycles of 2 ms and the way there and back.
  robot,
  scheduler: manualScheduler,
  answer_s: 0.005,
  cannot: UR_CANNOT,
  async make({ scheduler, robot: driven, start_rad, maxSpeed, initialize, onMotion }) {
    const network = memoryNetwork(scheduler);
    const started = await createVirtualUr({
      robot: driven,
      scheduler,
      network,
      host: HOST,
      start_rad,
      powerOn_s: 0.1,
      brakes_s: 0.1,
      interpret: () => ({ kind: "not-understood", faults: [] }),
      ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    if (started.kind === "taken") throw new Error(started.sentence);
    const adapter = createUrAdapter({ robot: driven, scheduler, network, host: HOST });
    const controller = createRealController({
      face: adapter,
      scheduler,
      ...(initialize ? { initialize } : {}),
      ...(onMotion ? { onMotion } : {}),
    });
    let connected = false;
    void controller.connect().then(outcome => {
      connected = outcome.kind === "done";
    });
    for (let i = 0; i < 200 && !connected; i++) await scheduler.elapse(0.01);
    if (!connected) throw new Error(controller.link.sentence);
    await scheduler.elapse(0.02);
    return controller;
  },
});

const REACH = [0.6, -1.2, 1.4, -1.4, -1.2, 0.4];
const DEGREE_RAD = Math.PI / 180;
/** What a promise came to, or undefined while it is open. */
function watched<T>(promise: Promise<T>): { value: T | undefined } {
  const seen: { value: T | undefined } = { value: undefined };
  void promise.then(value => {
    seen.value = value;
  });
  return seen;
}

describe("UR driver", () => {
  test("T-26 another driver's robot is watched without taking anything from it: its motion ends, and a stop from here stops it", async () => {
    const { scheduler, network, driver } = await urBench();
    const controller = await driver();
    const watching = createRealController({
      face: createUrAdapter({ robot, scheduler, network, host: HOST, isWatched: () => true }),
      scheduler,
    });
    const seen: number[] = [];
    watching.onSample(({ q_rad }) => {
      seen.push(q_rad[0]!);
    });
    void watching.connect();
    await scheduler.elapse(0.3);
    expect(watching.isConnected).toBe(true);
    const first = watched(controller.moveJoints(REACH));
    await scheduler.elapse(8);
    expect(first.value).toEqual({ kind: "done" });
    expect(seen.at(-1)).toBeCloseTo(REACH[0]!, 9);
    const second = watched(controller.moveToZero());
    await scheduler.elapse(0.5);
    watching.stop();
    await scheduler.elapse(1);
    expect(second.value).toMatchObject({ kind: "stopped" });
    expect(controller.isMoving()).toBe(false);
  });

  test("T-10 a stop while its program is still being started on the robot wins: the motion that waited for it never begins", async () => {
    for (const after_s of [0, 0.004, 0.02, 0.06]) {
      const { scheduler, driver } = await urBench();
      const controller = await driver();
      // Room is made for a text that does not come: the next motion has to start the program anew.
      const handed = watched(controller.handText!([{ name: "a.script", text: "def a():\nend\n", lines: [] }]));
      await scheduler.elapse(1);
      if (handed.value?.kind !== "handed") throw new Error("The text was not taken.");
      handed.value.drop();
      const moving = watched(controller.moveJoints(REACH));
      await scheduler.elapse(after_s);
      controller.stop();
      for (let i = 0; i < 500 && !moving.value; i++) await scheduler.elapse(0.002);
      expect(moving.value).toMatchObject({ kind: "stopped" });
      // The way back, as a guard commands it at once, starts that program.
      const rest = [...controller.jointAngles()];
      const back = watched(controller.moveJoints(rest));
      await scheduler.elapse(4);
      expect(back.value).toEqual({ kind: "done" });
      controller.jointAngles().forEach((angle, i) => expect(angle).toBeCloseTo(rest[i]!, 5));
      controller.close();
    }
  });

  test("T-19 is connected while the link is open, and neither before nor after", async () => {
    const { scheduler, network } = await urBench();
    const controller = createRealController({
      face: createUrAdapter({ robot, scheduler, network, host: HOST }),
      scheduler,
    });
    expect(controller.isConnected).toBe(false);
    void controller.connect();
    await scheduler.elapse(0.2);
    expect(controller.isConnected).toBe(true);
    controller.disconnect();
    expect(controller.isConnected).toBe(false);
    expect(await controller.moveJoints(REACH)).toMatchObject({ kind: "refused", why: { code: "link.closed" } });
  });

  test("states come at 500 Hz, none is missing, each is 2 ms after the one before", async () => {
    const { scheduler, driver } = await urBench();
    const controller = await driver();
    const times_s: number[] = [];
    await scheduler.elapse(0.5);
    controller.onSample(({ time_s }) => {
      times_s.push(time_s);
    });
    await scheduler.elapse(2);
    expect(times_s.length).toBe(1000);
    times_s.forEach((time_s, i) => {
      if (i > 0) expect(time_s - times_s[i - 1]!).toBeCloseTo(0.002, 9);
    });
    expect(controller.link).toMatchObject({ missing: 0, rate_Hz: 500 });
    expect(controller.link.roundTrip_s).toBeLessThan(0.01);
  });

  test("T-20 a fault of the robot is told with its cause; wanted and measured angles come with each other", async () => {
    const { scheduler, ur, driver } = await urBench();
    const controller = await driver();
    const heard: string[] = [];
    let apart = 0;
    controller.onSample(({ safety, message, q_rad, target_rad }) => {
      const line = `${safety}: ${message}`;
      if (heard.at(-1) !== line) heard.push(line);
      apart = Math.max(apart, ...q_rad.map((q, i) => Math.abs(q - target_rad![i]!)));
    });
    await scheduler.elapse(0.01);
    ur.pendant.protectiveStop("Joint 2 met a resistance.");
    await scheduler.elapse(0.1);
    expect(heard).toContain("protective-stop: Joint 2 met a resistance.");
    expect(heard[0]).toBe("normal: ");
    expect(apart).toBe(0);
    ur.pendant.fault("The encoders of joint 3 differ.");
    await scheduler.elapse(0.1);
    expect(heard.at(-1)).toMatch(/^protective-stop: /);
  });

  test("T-23 what is commanded is where the robot comes to, within 0.001°", async () => {
    const { scheduler, driver, ur } = await urBench();
    const controller = await driver();
    for (const part of [0.21, 0.37, 0.5, 0.66, 0.83]) {
      const wanted = Float64Array.from(
        robot.arm.joints,
        ({ limits }, i) =>
          (limits.lower_rad + part * (limits.upper_rad - limits.lower_rad)) * (i % 2 === 0 ? 0.3 : 0.25),
      );
      const outcome = watched(controller.moveJoints(wanted));
      for (let i = 0; i < 200 && !outcome.value; i++) await scheduler.elapse(0.1);
      expect(outcome.value).toEqual({ kind: "done" });
      await scheduler.elapse(0.01);
      for (const is of [controller.jointAngles(), ur.jointAngles()])
        is.forEach((q, i) => {
          expect(Math.abs(q - wanted[i]!)).toBeLessThanOrEqual(0.001 * DEGREE_RAD);
        });
    }
  });

  test("T-24 T-25 the real robot first: the twin follows with the next sample of it", async () => {
    const { scheduler, driver, ur } = await urBench();
    const real = await driver();
    const moved: string[] = [];
    real.onSample(({ moving }) => {
      if (moving && !moved.includes("real")) moved.push("real");
    });
    const twin = createTwin({ real, scheduler });
    twin.onSample(({ moving }) => {
      if (moving && !moved.includes("twin")) moved.push("twin");
    });
    const outcome = watched(twin.moveJoints(REACH));
    for (let i = 0; i < 100 && !outcome.value; i++) await scheduler.elapse(0.1);
    expect(outcome.value).toEqual({ kind: "done" });
    expect(moved).toEqual(["real", "twin"]);
    await scheduler.elapse(0.02);
    twin.jointAngles().forEach((q, i) => {
      expect(q).toBe(ur.jointAngles()[i]);
    });
  });

  test("T-26 in local control the pendant moves it and the driver watches; its commands are refused until remote control is back", async () => {
    const { scheduler, driver, ur } = await urBench();
    const controller = await driver();
    const running = watched(controller.moveJoints(REACH));
    await scheduler.elapse(0.2);
    ur.pendant.setMode("manual");
    await scheduler.elapse(1);
    expect(running.value).toMatchObject({ kind: "stopped" });
    expect(await controller.moveJoints(REACH)).toMatchObject({
      kind: "refused",
      why: { code: "controller.manual-mode" },
    });
    const jog = watched(ur.pendant.jog([0.2, -1.5, 1.5, -1.5, -1.5, 0]));
    await scheduler.elapse(10);
    expect(jog.value).toEqual({ kind: "done" });
    expect(controller.jointAngle(1)).toBeCloseTo(0.2, 9);
    expect((await ur.pendant.jog([9, 0, 0, 0, 0, 0])).kind).toBe("refused");
    ur.pendant.setMode("remote");
    await scheduler.elapse(0.2);
    expect((await ur.pendant.jog([0, -1.5, 1.5, -1.5, -1.5, 0])).kind).toBe("refused");
    const again = watched(controller.moveJoints(REACH));
    await scheduler.elapse(5);
    expect(again.value).toEqual({ kind: "done" });
  });

  test("T-27 somebody comes near while it moves: it holds, the driver says guard stop, and nothing new begins until the way is clear", async () => {
    const { scheduler, driver, ur } = await urBench();
    const controller = await driver();
    const safety: string[] = [];
    controller.onSample(sample => {
      if (safety.at(-1) !== sample.safety) safety.push(sample.safety);
    });
    const running = watched(controller.moveJoints(REACH));
    await scheduler.elapse(0.2);
    ur.pendant.setGuardOpen(true);
    await scheduler.elapse(1);
    const rest = ur.jointAngles();
    await scheduler.elapse(1);
    expect(ur.jointAngles()).toEqual(rest);
    expect(controller.jointAngles()).toEqual(rest);
    expect(await controller.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.guard-stop" } });
    ur.pendant.setGuardOpen(false);
    await scheduler.elapse(5);
    expect(safety).toEqual(["normal", "guard-stop", "normal"]);
    // UR's safeguard resets by itself: what was under way before either ended with the stop, or goes on to its own
    // target.
    expect(running.value?.kind).toMatch(/^(stopped|done)$/);
    const next = watched(controller.moveToZero());
    await scheduler.elapse(5);
    expect(next.value).toEqual({ kind: "done" });
  });

  test("a protective stop is unlocked after five seconds and not before; an emergency stop only when the button is out; then drives and brakes", async () => {
    const bench = await urBench();
    const { driver } = bench;
    const controller = await driver();
    bench.ur.pendant.protectiveStop("A test.");
    await bench.scheduler.elapse(1);
    void controller.reset();
    await bench.scheduler.elapse(0.1);
    let said = "";
    controller.onSample(({ message }) => {
      said = message;
    });
    await bench.scheduler.elapse(5);
    void controller.reset();
    await bench.scheduler.elapse(0.3);
    expect([bench.ur.state.safetyMode, said]).toEqual([SAFETY_MODE.NORMAL, ""]);
    bench.ur.pendant.emergencyStop(true);
    await bench.scheduler.elapse(0.1);
    expect(await controller.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.emergency-stop" } });
    void controller.reset();
    await bench.scheduler.elapse(3);
    expect(bench.ur.state.robotMode).toBe(ROBOT_MODE.POWER_OFF);
    bench.ur.pendant.emergencyStop(false);
    await bench.scheduler.elapse(0.01);
    void controller.reset();
    await bench.scheduler.elapse(3);
    expect(bench.ur.state.robotMode).toBe(ROBOT_MODE.RUNNING);
    const next = watched(controller.moveToZero());
    await bench.scheduler.elapse(5);
    expect(next.value).toEqual({ kind: "done" });
  });

  test("outputs, inputs and the gripper by the names of the control box", async () => {
    const { scheduler, driver, ur } = await urBench();
    const controller = await driver();
    const at = (name: string) => controller.signals!.read(name);
    for (const line of ["digital_out_3", "digital_out_9", "digital_out_17"]) controller.signals!.write(line, true);
    controller.signals!.write("analog_out_1", 0.25);
    ur.pendant.setInput("digital_in_5", true);
    await scheduler.elapse(0.05);
    expect([3, 9, 17, 4].map(bit => ur.digitalOut(bit))).toEqual([true, true, true, false]);
    expect(
      ["digital_out_3", "digital_out_9", "digital_out_17", "digital_out_4", "digital_in_5", "analog_out_1"].map(at),
    ).toEqual([true, true, true, false, true, 0.25]);
    const steps: Step[] = [
      { id: "g", type: "gripper", closed: true },
      { id: "p", type: "payload", mass_kg: 2, center_m: [0, 0, 0.05] },
    ];
    const run = watched(controller.run(steps, { tools: {}, frames: {} }));
    await scheduler.elapse(2);
    expect([run.value, ur.digitalOut(16), ur.memory.get("payload")]).toEqual([{ kind: "done" }, true, 2]);
    expect(
      await controller.run([{ id: "s", type: "set", signal: "lamp", to: true }], { tools: {}, frames: {} }),
    ).toMatchObject({ kind: "refused", why: { code: "signals.unknown" } });
  });

  test("lines and arcs lead the flange where they should", async () => {
    const { scheduler, driver } = await urBench();
    const controller = await driver();
    const start = [0.3, -1.3, 1.9, -2.1, -1.4, 0.2];
    const carryOut = async (steps: readonly Step[]): Promise<CommandOutcome | undefined> => {
      const outcome = watched(controller.run(steps, { tools: {}, frames: {} }));
      for (let i = 0; i < 300 && !outcome.value; i++) await scheduler.elapse(0.1);
      await scheduler.elapse(0.01);
      return outcome.value;
    };
    expect(
      await carryOut([{ id: "go", type: "move", path: "ptp", target: { q: start }, speed: { ratio: 1 }, blend_m: 0 }]),
    ).toEqual({ kind: "done" });
    const from = flangePose(robot.arm, start);
    const [x, y, z] = from.position;
    const to = (dx: number, dz: number): Target => ({
      pose: { position: [x + dx, y, z + dz], quaternion: from.quaternion },
      frame: "world",
      tool: "flange",
    });
    expect(
      await carryOut([
        { id: "line", type: "move", path: "lin", target: to(0.1, 0.05), speed: { mps: 0.2 }, blend_m: 0 },
      ]),
    ).toEqual({ kind: "done" });
    expect(
      posesAgree(
        flangePose(robot.arm, controller.jointAngles()),
        { position: [x + 0.1, y, z + 0.05], quaternion: from.quaternion },
        1e-6,
        1e-6,
      ),
    ).toBe(true);
    expect(
      await carryOut([
        {
          id: "arc",
          type: "move",
          path: "circ",
          via: to(0.05, 0.1),
          target: to(0, 0.05),
          speed: { mps: 0.2 },
          blend_m: 0,
        },
      ]),
    ).toEqual({ kind: "done" });
    expect(
      posesAgree(
        flangePose(robot.arm, controller.jointAngles()),
        { position: [x, y, z + 0.05], quaternion: from.quaternion },
        1e-6,
        1e-6,
      ),
    ).toBe(true);
  });

  test("runs a text of the controller's own language to its end, and moves on afterwards; a fault of it is told with its line", async () => {
    const { scheduler, driver, ur } = await urBench();
    const controller = await driver();
    const run = (text: string) => watched(controller.runText!([{ name: "a.script", text, lines: [] }]));
    const good = run(
      "def a():\n  movej([0.4, -1.5, 1.5, -1.5, -1.5, 0], a=1, v=1)\n  set_standard_digital_out(1, True)\nend\n",
    );
    await scheduler.elapse(4);
    expect([good.value, ur.digitalOut(1)]).toEqual([{ kind: "done" }, true]);
    expect(controller.jointAngle(1)).toBeCloseTo(0.4, 9);
    const bad = run("def a():\n  sync()\n  movej([99, 0, 0, 0, 0, 0])\nend\n");
    await scheduler.elapse(2);
    expect(bad.value).toMatchObject({ kind: "stopped", why: { code: "controller.program-fault" } });
    await scheduler.elapse(5);
    void controller.reset();
    await scheduler.elapse(0.5);
    const cut = run(
      "def a():\n  while True:\n    movej([0.4, -1.5, 1.5, -1.5, -1.5, 0])\n    movej([0, -1.5, 1.5, -1.5, -1.5, 0])\n  end\nend\n",
    );
    await scheduler.elapse(1);
    expect(ur.state.moving).toBe(true);
    controller.stop();
    await scheduler.elapse(1);
    expect([cut.value?.kind, ur.state.moving]).toEqual(["stopped", false]);
    const next = watched(controller.moveToZero());
    await scheduler.elapse(6);
    expect(next.value).toEqual({ kind: "done" });
  });
});
