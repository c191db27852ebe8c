import { flangePose, manualScheduler, type Step } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { createRealController } from "../../driver/index.ts";
import { createTwin } from "../../twin/index.ts";
import { exampleScale, resolution_rad, scaleWith } from "../codec/index.ts";
import { HOST, bench, gp8, job, turned } from "../testing/bench.ts";
import type { Client } from "./client.ts";
import { lineTable, logicalOf, watchedLines } from "./lines.ts";
import { yaskawaAdapter } from "./index.ts";

/** All the way round from the middle: long enough for full speed. */
const FAR = gp8.home_rad.with(0, -2.8);
const NOTHING = { tools: {}, frames: {} };
const emitted = (name: string, text: string) => ({ name, text, lines: text.split("\n").map(() => "") });
const half_rad = resolution_rad(exampleScale(gp8));

describe("the driver of Yaskawa's Ethernet server", () => {
  test("T-19 not connected, connected, and not any more", async () => {
    const { scheduler, real } = await bench({}, {}, false);
    expect(real.isConnected).toBe(false);
    const connecting = real.connect();
    await scheduler.elapse(0.1);
    expect(await connecting).toEqual({ kind: "done" });
    expect(real.isConnected).toBe(true);
    expect(real.link).toMatchObject({ state: "open", missing: 0 });
    expect(real.link.roundTrip_s).toBeLessThan(0.01);
    real.disconnect();
    expect(real.isConnected).toBe(false);
  });

  test("nobody there, another model, another number of axes, pulses nobody knows: one sentence each, with both names", async () => {
    const away = await bench({}, { ports: { robot: 9, files: 10 } }, false);
    const nobody = away.real.connect();
    await away.scheduler.elapse(3);
    expect(await nobody).toMatchObject({
      kind: "refused",
      why: { code: "link.no-answer", sentence: "Nothing answers at 127.0.0.1:9 (UDP)." },
    });
    const trial = async (virtual: Parameters<typeof bench>[0], adapter: Parameters<typeof bench>[1]) => {
      const { scheduler, real } = await bench(virtual, adapter, false);
      const answer = real.connect();
      await scheduler.elapse(1);
      expect(real.link.state).toBe("closed");
      return answer;
    };
    expect(await trial({ model: "YR-1-06VX8-A00" }, {})).toMatchObject({
      why: {
        code: "link.other-robot",
        sentence:
          'Yaskawa GP8 was expected, known to its controller as "GP8"; the controller says it moves "YR-1-06VX8-A00".',
      },
    });
    const seven = { ...gp8, arm: { ...gp8.arm, joints: [...gp8.arm.joints, gp8.arm.joints[0]!] } };
    expect(await trial({}, { robot: seven, scale: scaleWith(seven, [1, 1, 1, 1, 1, 1, 1], "test") })).toMatchObject({
      why: { code: "link.other-robot", sentence: "Yaskawa GP8 has 7 axes; the YASKAWA GP8 that answers has 6." },
    });
    expect(await trial({}, { scale: scaleWith(gp8, [1, 1], "test") })).toMatchObject({
      why: { code: "yaskawa.pulses" },
    });
  });

  test("T-20 an alarm of the robot arrives with its number and name, and ends the motion; reset clears it", async () => {
    const { scheduler, virtual, real, heard, carryOut } = await bench();
    const moving = real.moveJoints(turned(1));
    await scheduler.elapse(0.3);
    virtual.pendant.raiseAlarm(4320, "OVERLOAD (CONTINUE)", 2);
    expect((await carryOut(moving)).outcome).toMatchObject({
      kind: "stopped",
      why: { sentence: "Yaskawa GP8 stopped. Alarm 4320: OVERLOAD (CONTINUE) [2]" },
    });
    await scheduler.elapse(0.1);
    expect(heard.at(-1)).toMatchObject({ safety: "protective-stop", message: "Alarm 4320: OVERLOAD (CONTINUE) [2]" });
    expect(await real.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.protective-stop" } });
    void real.reset();
    await scheduler.elapse(1);
    expect(heard.at(-1)).toMatchObject({ safety: "normal", message: "" });
    expect((await carryOut(real.moveToZero())).outcome).toEqual({ kind: "done" });
  });

  test("T-03 half the speed is half the speed on the way", async () => {
    const fastest = async (percent: number): Promise<number> => {
      const { real, heard, carryOut } = await bench({ start_rad: FAR });
      real.setSpeed(percent);
      heard.length = 0;
      await carryOut(real.moveJoints(gp8.home_rad.with(0, 2.8)));
      return Math.max(
        ...heard
          .slice(4)
          .map(({ q_rad, time_s }, i) => Math.abs(q_rad[0]! - heard[i]!.q_rad[0]!) / (time_s - heard[i]!.time_s)),
      );
    };
    const full = await fastest(100);
    const half = await fastest(50);
    expect(full / half).toBeCloseTo(2, 1);
    expect(full).toBeCloseTo(gp8.arm.joints[0]!.limits.speed_rad_s, 0);
  });

  test("a change of speed on the way holds, and goes on at the new speed to the same end", async () => {
    const { scheduler, real, carryOut, heard } = await bench({ start_rad: FAR });
    const moving = real.moveJoints(gp8.home_rad.with(0, 2.8));
    await scheduler.elapse(0.2);
    real.setSpeed(10);
    heard.length = 0;
    const { outcome, took_s } = await carryOut(moving);
    expect(outcome).toEqual({ kind: "done" });
    expect(took_s).toBeGreaterThan(1.5);
    expect(Math.abs(real.jointAngle(1) - 2.8)).toBeLessThanOrEqual(half_rad[0]!);
    const last = heard.slice(-40);
    const speed = (last.at(-21)!.q_rad[0]! - last[0]!.q_rad[0]!) / (last.at(-21)!.time_s - last[0]!.time_s);
    expect(speed).toBeLessThan(0.11 * gp8.arm.joints[0]!.limits.speed_rad_s);
  });

  test("T-23 what is commanded is what is told back: within half a pulse, 0.0008° at worst", async () => {
    const { real, carryOut } = await bench();
    for (const part of [0.1, 0.37, 0.5, 0.93]) {
      const wanted = gp8.arm.joints.map(
        ({ limits }) => limits.lower_rad + part * (limits.upper_rad - limits.lower_rad),
      );
      expect((await carryOut(real.moveJoints(wanted))).outcome).toEqual({ kind: "done" });
      wanted.forEach((q, i) => {
        expect(Math.abs(real.jointAngle(i + 1) - q)).toBeLessThanOrEqual(half_rad[i]! + 1e-9);
      });
    }
    expect((Math.max(...half_rad) * 180) / Math.PI).toBeLessThan(0.001);
  });

  test("straight moves keep their line: told in millimetres where the posture is certain, in pulses where it is not", async () => {
    const { real, carryOut, heard, scheduler } = await bench();
    const start = [0.3, 0.2, 0.1, 0.2, -1.2, 0.1];
    await carryOut(real.moveJoints(start));
    for (const bend of [-1.2, 0.005]) {
      await carryOut(real.moveJoints([0.3, 0.2, 0.1, bend > 0 ? Math.PI / 2 - 0.01 : 0.2, -1.2, 0.1]));
      const from = flangePose(gp8.arm, real.jointAngles());
      const to: Step = {
        id: "line",
        type: "move",
        path: "lin",
        blend_m: 0,
        speed: { mps: 0.1 },
        target: {
          pose: {
            position: [from.position[0], from.position[1] + 0.08, from.position[2] - 0.05],
            quaternion: from.quaternion,
          },
          frame: "world",
          tool: "flange",
        },
      };
      heard.length = 0;
      const { outcome, took_s } = await carryOut(real.run([to], NOTHING));
      expect(outcome).toEqual({ kind: "done" });
      expect(took_s).toBeGreaterThan(0.9);
      await scheduler.elapse(0.1);
      for (const { q_rad } of heard) {
        const [x, y, z] = flangePose(gp8.arm, q_rad).position;
        expect(Math.abs(x - from.position[0])).toBeLessThan(2e-4);
        expect(Math.abs(z - (from.position[2] - ((y - from.position[1]) * 5) / 8))).toBeLessThan(2e-4);
      }
      expect(flangePose(gp8.arm, real.jointAngles()).position[1]).toBeCloseTo(from.position[1] + 0.08, 4);
    }
  });

  test("arcs and soft accelerations are no commands of this server: refused, and where they can be said", async () => {
    const { real } = await bench();
    const here = flangePose(gp8.arm, real.jointAngles());
    const at = (dy: number, dz: number) => ({
      pose: {
        position: [here.position[0], here.position[1] + dy, here.position[2] + dz] as [number, number, number],
        quaternion: here.quaternion,
      },
      frame: "world",
      tool: "flange",
    });
    expect(
      await real.run(
        [
          {
            id: "c",
            type: "move",
            path: "circ",
            via: at(0.05, 0.05),
            target: at(0.1, 0),
            speed: { mps: 0.1 },
            blend_m: 0,
          },
        ],
        NOTHING,
      ),
    ).toMatchObject({ kind: "refused", why: { code: "yaskawa.arc", hint: expect.stringContaining("MOVC") as string } });
    expect(
      await real.run(
        [
          {
            id: "s",
            type: "move",
            path: "ptp",
            target: { q: turned(0.1) },
            speed: { ratio: 1 },
            acceleration: { ratio: 0.5 },
            blend_m: 0,
          },
        ],
        NOTHING,
      ),
    ).toMatchObject({ kind: "refused", why: { code: "yaskawa.acceleration" } });
    expect(real.watchdog).toMatchObject({
      kind: "none",
      because: expect.stringContaining("streams of targets are not sent") as string,
    });
  });

  test("lines and the gripper by their numbers; a job on the controller sees them", async () => {
    const { real, scheduler, virtual, heard, carryOut } = await bench(
      {},
      { signals: { start: 27_010, lamp: 10_011 }, gripper: 27_024 },
    );
    expect(
      (
        await carryOut(
          real.run(
            [
              { id: "g", type: "gripper", closed: true },
              { id: "s", type: "set", signal: "start", to: true },
            ],
            NOTHING,
          ),
        )
      ).outcome,
    ).toEqual({ kind: "done" });
    await scheduler.elapse(0.3);
    expect(heard.at(-1)?.gripperClosed).toBe(true);
    expect(real.signals?.read("start")).toBe(true);
    expect(virtual.neutral.signals.read("in_1")).toBe(true);
    expect(virtual.neutral.signals.read("in_13")).toBe(true);
    virtual.neutral.signals.write("ot_2", true);
    await scheduler.elapse(0.3);
    expect(real.signals?.read("lamp")).toBe(true);
    const set = (signal: string, to: boolean | number) =>
      carryOut(real.run([{ id: "x", type: "set", signal, to }], NOTHING));
    expect((await set("lamp", true)).outcome).toMatchObject({ kind: "refused", why: { code: "signals.not-writable" } });
    expect((await set("horn", true)).outcome).toMatchObject({ kind: "refused", why: { code: "signals.unknown" } });
    expect((await set("start", 0.5)).outcome).toMatchObject({ kind: "refused", why: { code: "signals.kind" } });
  });

  test("lines by INFORM's own names: inputs are read, outputs switched by the network inputs that the ladder passes on, and read back", async () => {
    const { real, scheduler, virtual } = await bench({}, {});
    virtual.pendant.setInput(5, true);
    for (const [signal, output] of [
      ["OT#(2)", "ot_2"],
      ["OUT#(12)", "ot_12"],
      ["ot_3", "ot_3"],
      ["out_128", "ot_128"],
    ] as const) {
      real.signals!.write(signal, true);
      await scheduler.elapse(0.3);
      expect(virtual.neutral.signals.read(output), signal).toBe(true);
      expect(real.signals!.read(signal === "OUT#(12)" ? "OT#(12)" : signal), signal).toBe(true);
    }
    expect([
      real.signals!.read("IN#(5)"),
      real.signals!.read("IN#(6)"),
      real.signals!.read("ot_2"),
      real.signals!.read("ot_4"),
    ]).toEqual([true, false, true, false]);
    real.signals!.write("OT#(2)", false);
    await scheduler.elapse(0.3);
    expect([
      virtual.neutral.signals.read("ot_2"),
      virtual.neutral.signals.read("ot_3"),
      real.signals!.read("OT#(2)"),
    ]).toEqual([false, true, false]);
    // What a job switches stays as it is until the line from outside changes.
    virtual.neutral.signals.write("ot_3", false);
    real.signals!.write("OT#(2)", true);
    await scheduler.elapse(0.3);
    expect(virtual.neutral.signals.read("ot_3")).toBe(false);
    real.signals!.write("27013", true);
    await scheduler.elapse(0.3);
    expect([virtual.neutral.signals.read("in_4"), real.signals!.read("27013")]).toEqual([true, true]);
  });

  test("a controller that is no virtual one: inputs and outputs are watched, an output is switched only where the ladder's network input is said", async () => {
    expect(["IN#(1)", "in_9", "OT#(8)", "OUT#(9)", "27013", "99999", "lamp", "IN#(0)", "IN#(1"].map(logicalOf)).toEqual(
      [10, 20, 10_017, 10_020, 27_013, 99_999, undefined, undefined, undefined],
    );
    const client = {
      ask: () =>
        new Promise<never>(() => {
          /* Nothing is answered here. */
        }),
      say() {
        /* Nobody listens. */
      },
    } as unknown as Client;
    const complain = (): void => {
      throw new Error("Nothing was refused.");
    };
    const plain = lineTable(watchedLines(), undefined, () => {
      /* Not looked at. */
    });
    const joined = lineTable(watchedLines(), 27_300, () => {
      /* Not looked at. */
    });
    expect([
      plain.write(client, "OT#(1)", true, complain),
      plain.write(client, "IN#(1)", true, complain),
      plain.write(client, "99999", true, complain),
    ]).toMatchObject([{ code: "signals.not-writable" }, { code: "signals.not-writable" }, { code: "signals.unknown" }]);
    expect([
      plain.write(client, "27010", true, complain),
      joined.write(client, "OT#(10)", true, complain),
      joined.groups,
    ]).toEqual([null, null, [1, 1001, 2, 1002, 2731]]);
  });

  test("a program text becomes a job: saved, selected, started, watched to its end", async () => {
    const { real, face: adapter, virtual, carryOut } = await bench();
    const text = job("PICK", "MOVJ 0.4", "W 0.2", ...Array.from({ length: 60 }, (_, i) => `O ${i + 1}`), "MOVJ 0.1");
    const { outcome, took_s } = await carryOut(real.runText!([emitted("PICK.JBI", text)]));
    expect(outcome).toEqual({ kind: "done" });
    expect(took_s).toBeGreaterThan(0.5);
    expect(Math.abs(real.jointAngle(1) - 0.1)).toBeLessThanOrEqual(half_rad[0]!);
    expect(await carryOut(adapter.files!.load("PICK.JBI").then(got => ({ kind: "done", got }) as never))).toMatchObject(
      {
        outcome: { got: { kind: "done", value: text } },
      },
    );
    expect(virtual.files.names(".JBI")).toEqual(["PICK.JBI"]);
    expect((await carryOut(real.runText!([emitted("PICK.JBI", job("PICK", "DANCE"))]))).outcome).toMatchObject({
      kind: "refused",
      why: { sentence: expect.stringContaining("5110") as string },
    });
    expect((await carryOut(real.runText!([emitted("PICK.TXT", "")]))).outcome).toMatchObject({
      kind: "refused",
      why: { code: "yaskawa.no-job" },
    });
    virtual.pendant.setMode("play");
    expect((await carryOut(real.runText!([emitted("PICK.JBI", text)]))).outcome).toMatchObject({
      kind: "refused",
      why: { sentence: expect.stringContaining("E2B2") as string },
    });
  });

  test("a stop holds a job at its place, and none is started by what was on its way", async () => {
    const { real, scheduler, carryOut, virtual } = await bench();
    const running = real.runText!([emitted("A.JBI", job("A", "MOVJ 1", "MOVJ 0"))]);
    await scheduler.elapse(0.3);
    real.stop();
    expect((await carryOut(running)).outcome.kind).toBe("stopped");
    const rest = real.jointAngle(1);
    await scheduler.elapse(2);
    expect(real.jointAngle(1)).toBe(rest);
    const early = real.runText!([emitted("B.JBI", job("B", ...Array.from({ length: 400 }, () => "W 0.1"), "MOVJ 1"))]);
    await scheduler.elapse(0.005);
    real.stop();
    await carryOut(early);
    await scheduler.elapse(3);
    expect(virtual.neutral.isMoving()).toBe(false);
    expect((await carryOut(real.moveJoints(turned(0)))).outcome).toEqual({ kind: "done" });
  });

  test("T-24, T-25 the twin follows the robot, one state behind what was commanded", async () => {
    const { real, scheduler, carryOut } = await bench();
    const twin = createTwin({ real, scheduler });
    const moving = twin.moveJoints(turned(0.3));
    const before = twin.jointAngle(1);
    expect(before).toBe(gp8.home_rad[0]);
    await carryOut(moving);
    await scheduler.elapse(0.1);
    expect([...twin.jointAngles()]).toEqual([...real.jointAngles()]);
  });

  test("T-26 in TEACH the driver mirrors the pendant's jogs and its commands are refused", async () => {
    const { real, virtual, scheduler, heard, carryOut } = await bench();
    virtual.pendant.setMode("teach");
    await scheduler.elapse(0.05);
    expect(await real.moveToZero()).toMatchObject({ kind: "refused", why: { code: "controller.manual-mode" } });
    void virtual.pendant.jog(turned(0.02));
    await scheduler.elapse(0.1);
    expect(heard.at(-1)).toMatchObject({ mode: "manual", moving: true });
    await scheduler.elapse(10);
    expect(Math.abs(real.jointAngle(1) - 0.02)).toBeLessThanOrEqual(half_rad[0]!);
    virtual.pendant.setMode("play");
    await scheduler.elapse(0.05);
    expect((await carryOut(real.moveToZero())).outcome).toMatchObject({
      kind: "refused",
      why: { sentence: expect.stringContaining("2080") as string },
    });
  });

  test("T-27 somebody near the robot stops it: the motion ends with the reason, the joints are equal, nothing starts again", async () => {
    const { real, virtual, scheduler, heard, carryOut } = await bench();
    const moving = real.moveJoints(turned(1));
    await scheduler.elapse(0.3);
    virtual.pendant.setGuardOpen(true);
    expect((await carryOut(moving)).outcome).toMatchObject({ kind: "stopped" });
    await scheduler.elapse(0.5);
    expect(heard.at(-1)?.safety).toBe("guard-stop");
    const rest = virtual.neutral.jointAngles();
    gp8.arm.joints.forEach((_, i) => {
      expect(Math.abs(real.jointAngle(i + 1) - rest[i]!)).toBeLessThanOrEqual(half_rad[i]! + 1e-9);
    });
    expect(await real.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.guard-stop" } });
    virtual.pendant.setGuardOpen(false);
    await scheduler.elapse(1);
    expect(virtual.neutral.jointAngles()).toEqual(rest);
  });
});

describe("the driver when the line is bad", () => {
  test("T-46, T-47 with a stalled controller nothing waits, and the stop is sent at once", async () => {
    const { real, virtual, scheduler } = await bench();
    const moving = real.moveJoints(turned(1));
    await scheduler.elapse(0.2);
    // Answers come two seconds late; what is sent arrives.
    virtual.faults.delay_s = 2;
    const from_s = performance.now();
    real.stop();
    real.setSpeed(50);
    real.jointAngles();
    expect(performance.now() - from_s).toBeLessThan(20);
    await scheduler.elapse(0.05 + virtual.brakingTime_s);
    expect(virtual.neutral.isMoving()).toBe(false);
    await scheduler.elapse(3);
    expect((await moving).kind).toBe("stopped");
  });

  test("X-41 silence: the link is lost and a hold is its last word within 100 ms; after it is back nothing moves by itself", async () => {
    const { real, virtual, scheduler, carryOut } = await bench({ start_rad: FAR });
    const moving = real.moveJoints(gp8.home_rad.with(0, 2.8));
    await scheduler.elapse(0.2);
    // The controller hears and cannot be heard.
    virtual.faults.refusing = true;
    const from_s = scheduler.now_s();
    while (real.isConnected && scheduler.now_s() - from_s < 1) await scheduler.elapse(0.002);
    expect(scheduler.now_s() - from_s).toBeLessThanOrEqual(0.1);
    expect((await moving).kind).toBe("stopped");
    await scheduler.elapse(virtual.brakingTime_s + 0.01);
    const rest = virtual.neutral.jointAngles();
    expect(virtual.neutral.isMoving()).toBe(false);
    expect(rest[0]).toBeLessThan(2.5);
    virtual.faults.refusing = false;
    await scheduler.elapse(10);
    expect(real.isConnected).toBe(true);
    expect(virtual.neutral.jointAngles()).toEqual(rest);
    expect((await carryOut(real.moveJoints(turned(0)))).outcome).toEqual({ kind: "done" });
  });

  test("a lost answer to a move: the robot is looked at, the move is not told twice", async () => {
    let moves = 0;
    const { real, virtual, scheduler, carryOut } = await bench({
      onMotion: () => {
        moves++;
      },
    });
    const moving = real.moveJoints(turned(0.8));
    // The move arrives, its answer does not; states come again soon after.
    virtual.faults.refusing = true;
    await scheduler.elapse(0.02);
    virtual.faults.refusing = false;
    expect((await carryOut(moving)).outcome).toEqual({ kind: "done" });
    expect(moves).toBe(1);
  });

  test("a lost move: told again, and carried out once", async () => {
    let moves = 0;
    const { real, network, scheduler, carryOut } = await bench({
      onMotion: () => {
        moves++;
      },
    });
    network.weather.frozen = true;
    const moving = real.moveJoints(turned(0.3));
    await scheduler.elapse(0.02);
    network.weather.frozen = false;
    expect((await carryOut(moving)).outcome).toEqual({ kind: "done" });
    expect(moves).toBe(1);
  });

  test("one datagram in fifty is lost, some come late, twice or damaged: every move is done or stopped by the line, every end is where it was said", async () => {
    const { real, network, scheduler, carryOut, heard } = await bench();
    Object.assign(network.weather, { loss: 0.02, jitter_s: 0.003, duplicates: 0.02, garbage: 0.01 });
    let done = 0;
    for (let i = 0; i < 20; i++) {
      const target = turned(i % 2 === 0 ? 0.2 : 0);
      const { outcome } = await carryOut(real.moveJoints(target));
      if (outcome.kind === "done") {
        done++;
        expect(Math.abs(real.jointAngle(1) - target[0]!)).toBeLessThan((0.02 * Math.PI) / 180);
      } else expect(outcome.why.code).toMatch(/^(link|yaskawa|safety)\./);
      for (let tries = 0; tries < 60 && !real.isConnected; tries++) await scheduler.elapse(0.5);
    }
    expect(done).toBeGreaterThanOrEqual(17);
    expect(heard.every(({ q_rad }) => q_rad.every(Number.isFinite))).toBe(true);
  });

  test("a restart of the controller: lost, found again, servo on by reset, and the robot is driven", async () => {
    const { real, virtual, scheduler, heard, carryOut } = await bench();
    virtual.reboot(1);
    await scheduler.elapse(0.3);
    expect(real.isConnected).toBe(false);
    await scheduler.elapse(10);
    expect(real.isConnected).toBe(true);
    expect(heard.at(-1)?.safety).toBe("emergency-stop");
    void real.reset();
    await scheduler.elapse(1);
    expect((await carryOut(real.moveJoints(turned(0.1)))).outcome).toEqual({ kind: "done" });
  });

  test("reset while the button is in says what a person must do", async () => {
    const { real, virtual, scheduler, heard } = await bench();
    virtual.pendant.emergencyStop(true);
    await scheduler.elapse(0.1);
    expect(heard.at(-1)).toMatchObject({
      safety: "emergency-stop",
      message: "The emergency stop is pressed, or an error is present.",
    });
    const adapter = yaskawaAdapter({
      robot: gp8,
      scheduler: manualScheduler(),
      network: {
        connect: () => Promise.reject(new Error("unused")),
        listen: () => Promise.reject(new Error("unused")),
        bind: () => Promise.resolve({ kind: "taken", sentence: "No port is free." }),
      },
      host: HOST,
    });
    expect(await createRealController({ face: adapter, scheduler }).connect()).toMatchObject({
      kind: "refused",
      why: { sentence: "No port is free." },
    });
    void real.reset();
    await scheduler.elapse(0.5);
    expect(heard.at(-1)?.safety).toBe("emergency-stop");
    expect(await real.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.emergency-stop" } });
  });
});
