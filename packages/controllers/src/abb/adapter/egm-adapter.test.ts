import { flangePose } from "@twincell/core";
import { describe, expect, test } from "vitest";
import {
  AROUND,
  beside,
  endsWhereCommanded,
  errorEndsTheMotion,
  followsThePendant,
  streamingBench,
  HOST,
  irb120,
  keepsToTheLine,
  NOTHING,
  stopsWhenCutOff,
  turned,
} from "../testing/guided.ts";
import type { VirtualAbbOptions } from "../virtual/index.ts";
import { abbEgmAdapter, type AbbEgmAdapterOptions } from "./index.ts";

const bench = (virtualOptions: Partial<VirtualAbbOptions> = {}, faceOptions: Partial<AbbEgmAdapterOptions> = {}) =>
  streamingBench(options => abbEgmAdapter({ ...options, ...faceOptions }), virtualOptions);

describe("the driver of ABB's externally guided motion alone", () => {
  test("T-19 connected by the first message of the controller; nobody, or a robot with other axes, is one sentence", async () => {
    const { real, connecting } = await bench();
    expect(await connecting).toEqual({ kind: "done" });
    expect(real.isConnected).toBe(true);
    real.disconnect();
    expect(real.isConnected).toBe(false);
    const away = await bench({ sensor: { host: HOST, port: 9 } });
    await away.scheduler.elapse(4);
    expect(await away.connecting).toMatchObject({
      kind: "refused",
      why: {
        code: "link.no-answer",
        sentence: "No controller at 127.0.0.1 sends EGM messages to port 6510 of this machine.",
      },
    });
    const other = await bench(
      {},
      { robot: { ...irb120, arm: { ...irb120.arm, joints: irb120.arm.joints.slice(0, 5) } } },
    );
    expect(await other.connecting).toMatchObject({
      kind: "refused",
      why: { code: "link.other-robot", sentence: `${irb120.name} has 5 axes; the robot whose controller sends has 6.` },
    });
  });

  test("T-23 joints end within 0.001° of what was commanded; 250 states a second, none missing", async () => {
    await endsWhereCommanded(await bench());
  });

  test("lines and arcs are followed, soft accelerations kept, and the speed changes on the way", async () => {
    const guided = await bench();
    const { real, carryOut } = guided;
    const at = flangePose(irb120.arm, real.jointAngles());
    const place = beside(at);
    await keepsToTheLine(guided, { acceleration: { ratio: 0.5 } });
    real.setSpeed(100);
    expect(
      await carryOut(
        real.run(
          [
            {
              id: "c",
              type: "move",
              path: "circ",
              via: place(0.05, -0.02),
              target: place(0, 0),
              speed: { mps: 0.1 },
              blend_m: 0,
            },
          ],
          NOTHING,
        ),
      ),
    ).toEqual({ kind: "done" });
    expect(flangePose(irb120.arm, real.jointAngles()).position[1]).toBeCloseTo(at.position[1], 4);
    expect(await real.run([{ id: "s", type: "set", signal: "lamp", to: true }], NOTHING)).toMatchObject({
      kind: "refused",
      why: { code: "abb.no-signals" },
    });
  });

  test("T-20 an error on the controller ends the motion and is told; nothing old is followed when EGM is started again", async () => {
    const guided = await bench();
    await errorEndsTheMotion(guided, () => {
      guided.virtual.pendant.setMode("automatic");
    });
  });

  test("T-24, T-25 the twin follows; T-26 in manual the pendant's jogs are mirrored and commands refused", async () => {
    await followsThePendant(await bench(), 0.1, 1e-9);
  });

  test("T-27 somebody near the robot stops it; it is where it was when he has stepped back", async () => {
    const { real, virtual, carryOut, scheduler } = await bench();
    const moving = real.moveJoints(AROUND);
    await scheduler.elapse(0.3);
    virtual.pendant.setGuardOpen(true);
    expect((await carryOut(moving)).kind).toBe("stopped");
    await scheduler.elapse(virtual.brakingTime_s);
    const rest = virtual.neutral.jointAngles();
    virtual.pendant.setGuardOpen(false);
    await scheduler.elapse(1);
    virtual.neutral.jointAngles().forEach((q, i) => {
      expect(q).toBeCloseTo(rest[i]!, 9);
    });
  });

  test("T-10 an emergency stop brakes hard and falls silent; the controller ends EGM, and a person starts it there", async () => {
    const { real, virtual, carryOut, scheduler, heard } = await bench();
    const moving = real.moveJoints(AROUND);
    await scheduler.elapse(0.3);
    real.stop(true);
    expect((await carryOut(moving)).kind).toBe("stopped");
    expect(heard.at(-1)?.safety).toBe("emergency-stop");
    expect(await real.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.emergency-stop" } });
    await scheduler.elapse(2);
    expect(virtual.message).toBe("No target came for 1 s.");
    void real.reset();
    await scheduler.elapse(0.5);
    expect(heard.at(-1)?.safety).toBe("protective-stop");
    virtual.pendant.setMode("remote");
    await scheduler.elapse(0.5);
    expect(heard.at(-1)?.safety).toBe("normal");
    expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
    virtual.pendant.emergencyStop(true);
    await scheduler.elapse(0.1);
    expect(heard.at(-1)).toMatchObject({ safety: "emergency-stop", message: "Its motors are off." });
  });

  test("T-46, T-47, X-41 a cut line: noticed within 100 ms, and the robot stops by itself within its time-out and braking time", async () => {
    await stopsWhenCutOff(await bench());
  });

  test("loss, late and doubled datagrams leave the path what it was; damaged ones are logged once", async () => {
    const { real, network, carryOut, log, scheduler, virtual } = await bench();
    Object.assign(network.weather, { loss: 0.05, jitter_s: 0.003, duplicates: 0.05 });
    for (const by of [0.3, 0]) expect(await carryOut(real.moveJoints(turned(by)))).toEqual({ kind: "done" });
    const bound = await network.bind({ host: HOST, port: 0 });
    if (bound.kind === "taken") throw new Error(bound.sentence);
    for (let i = 0; i < 500; i++)
      bound.socket.send(
        Uint8Array.from({ length: i % 40 }, (_, k) => (k * 31 + i) & 255),
        virtual.address,
      );
    await scheduler.elapse(0.1);
    expect(log.length).toBeGreaterThan(0);
    expect(new Set(log).size).toBe(log.length);
    expect(await carryOut(real.moveJoints(turned(0.1)))).toEqual({ kind: "done" });
    virtual.reboot(0.5);
    await scheduler.elapse(3);
    expect(real.isConnected).toBe(true);
    virtual.pendant.setMode("remote");
    await scheduler.elapse(0.2);
    expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
  });
});
