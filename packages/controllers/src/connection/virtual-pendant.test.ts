import { flangePose, manualScheduler, type CommandOutcome } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { DRIVER_KINDS, robotsOf } from "../brands.ts";
import { createRealController, type DriverKind } from "../driver/index.ts";
import { endedOn } from "../testing/index.ts";
import { memoryNetwork } from "../transport/index.ts";
import { openVirtualPendant, type VirtualPendantAction } from "./index.ts";

const HOST = "127.0.0.9";
const ME = "me";
/** A brand's virtual controller with its cabinet, and its driver at the other end of a network in memory. */
async function bench(brand: DriverKind) {
  const robot = robotsOf(brand).find(({ arm }) => arm.joints.length === 6)!;
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const opened = await openVirtualPendant({
    brand,
    robot,
    scheduler,
    network,
    host: HOST,
    interpret: () => ({ kind: "not-understood", faults: [] }),
  });
  if (opened.kind === "taken") throw new Error(opened.sentence);
  const { cabinet: virtualPendant, virtual } = opened;
  const real = createRealController({
    face: brand.face({ robot, scheduler, network, host: HOST, ports: virtual.ports }),
    scheduler,
  });
  const ended = endedOn(scheduler);
  const act = (what: VirtualPendantAction): Promise<CommandOutcome> => virtualPendant.act(ME, what);
  const key = (mode: string) => virtualPendant.words.keys.find(each => each.mode === mode)!.id;
  let beats = true;
  scheduler.every(0.025, () => {
    if (beats) virtualPendant.alive(ME);
  });
  expect(await ended(real.connect())).toEqual({ kind: "done" });
  await scheduler.elapse(0.2);
  /** How long the arm goes on from now on [s]. */
  const untilRest = async (): Promise<number> => {
    const begun_s = scheduler.now_s();
    const before = virtual.jointAngles().slice();
    let moved_s = begun_s;
    for (let t = 0; t < 1; t += 0.004) {
      await scheduler.elapse(0.004);
      const now = virtual.jointAngles();
      if (farthest(now, before) > 1e-9) moved_s = scheduler.now_s();
      before.set(now);
    }
    return moved_s - begun_s;
  };
  /** Into manual mode, the switch held, the drives on. */
  const byHand = async (): Promise<void> => {
    await act({ do: "key", position: key("manual") });
    await scheduler.elapse(1);
    await act({ do: "enable", pressed: true });
    await scheduler.elapse(1);
  };
  return {
    robot,
    scheduler,
    virtual,
    cabinet: virtualPendant,
    real,
    ended,
    act,
    key,
    untilRest,
    byHand,
    silence() {
      beats = false;
    },
    close() {
      opened.close();
      real.close();
    },
  };
}
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));

describe.each(DRIVER_KINDS.map(brand => [brand.id, brand] as const))("the cabinet of a virtual %s", (_, brand) => {
  test("T-26 a jog key moves its joint, at 250 mm/s at most, while it and the enabling switch are held; the twin follows, others are refused", async () => {
    const {
      robot,
      scheduler,
      virtual,
      cabinet: virtualPendant,
      real,
      act,
      untilRest,
      byHand,
      close,
    } = await bench(brand);
    expect(await act({ do: "jog", joint: 1, direction: 1 })).toMatchObject({
      kind: "refused",
      why: { code: "controller.not-manual" },
    });
    await act({ do: "key", position: virtualPendant.words.keys.find(({ mode }) => mode === "manual")!.id });
    await scheduler.elapse(1);
    expect(await act({ do: "jog", joint: 1, direction: 1 })).toMatchObject({
      kind: "refused",
      why: { code: "cabinet.enabling" },
    });
    await byHand();
    expect(await act({ do: "jog", joint: 9, direction: 1 })).toMatchObject({
      kind: "refused",
      why: { code: "controller.no-joint" },
    });
    for (const [joint, direction] of [
      [1, 1],
      [2, -1],
      [6, 1],
    ] as const) {
      const before = virtual.jointAngles().slice();
      const held = act({ do: "jog", joint, direction });
      let fastest_mps = 0;
      let place = flangePose(robot.arm, before);
      for (let t = 0; t < 0.6; t += 0.02) {
        await scheduler.elapse(0.02);
        const next = flangePose(robot.arm, virtual.jointAngles());
        fastest_mps = Math.max(fastest_mps, Math.hypot(...next.position.map((x, k) => x - place.position[k]!)) / 0.02);
        place = next;
      }
      expect(virtualPendant.shown).toMatchObject({ moving: true, enabled: true, jog: { joint, direction } });
      expect((await real.moveJoints(before)).kind).toBe("refused");
      void act({ do: "jog", joint, direction: 0 });
      expect(await held).toEqual({ kind: "done" });
      expect(await untilRest()).toBeLessThanOrEqual(0.1);
      const after = virtual.jointAngles();
      after.forEach((q, i) => {
        expect(Math.abs(q - before[i]!) > 0.01, `joint ${i + 1} after jogging joint ${joint}`).toBe(i === joint - 1);
      });
      expect(Math.sign(after[joint - 1]! - before[joint - 1]!)).toBe(direction);
      expect(fastest_mps).toBeLessThan(0.2505);
      expect(farthest(real.jointAngles(), after)).toBeLessThan(2e-5);
    }
    close();
  });

  test("X-41 whoever falls silent, leaves, or lets the enabling switch go has let the jog key go: at rest within 100 ms and the brakes", async () => {
    for (const how of ["silent", "gone", "switch"] as const) {
      const { cabinet: virtualPendant, scheduler, act, byHand, untilRest, silence, close } = await bench(brand);
      await byHand();
      const held = act({ do: "jog", joint: 1, direction: 1 });
      await scheduler.elapse(0.5);
      expect(virtualPendant.shown.moving).toBe(true);
      if (how === "silent") silence();
      else if (how === "gone") virtualPendant.leave(ME);
      else void act({ do: "enable", pressed: false });
      expect(await untilRest(), how).toBeLessThanOrEqual(how === "silent" ? 0.2 : 0.1);
      expect(await held).toEqual({ kind: "done" });
      expect(virtualPendant.shown).toMatchObject({ enabled: false, jog: null, moving: false });
      if (how === "silent") expect(virtualPendant.shown.says).toContain("80 ms");
      expect(await act({ do: "jog", joint: 1, direction: 1 })).toMatchObject({
        kind: "refused",
        why: { code: "cabinet.enabling" },
      });
      close();
    }
  });

  test("T-27 somebody near the robot stops a move from outside, both at equal joints; gate and sensor are one circuit", async () => {
    const { robot, scheduler, virtual, cabinet: virtualPendant, real, ended, act, close } = await bench(brand);
    const moving = real.moveJoints(Array.from(robot.home_rad, (q, i) => (i < 3 ? q + 0.6 : q)));
    await scheduler.elapse(0.3);
    expect(virtualPendant.shown.moving).toBe(true);
    await act({ do: "near", somebody: true });
    expect((await ended(moving)).kind).toBe("stopped");
    await act({ do: "guard", open: true });
    await act({ do: "near", somebody: false });
    await scheduler.elapse(1);
    expect(virtualPendant.shown).toMatchObject({ near: false, gateOpen: true, safety: "guard-stop", moving: false });
    expect(virtualPendant.shown.alarms.length).toBeGreaterThan(0);
    expect(farthest(virtual.jointAngles(), real.jointAngles())).toBeLessThan(2e-5);
    expect((await real.moveJoints(robot.home_rad)).kind).toBe("refused");
    close();
  });

  test("the red button takes the drives; turned out, acknowledged and switched on, the arm is jogged again", async () => {
    const { cabinet: virtualPendant, scheduler, virtual, act, byHand, close } = await bench(brand);
    await byHand();
    await act({ do: "emergency-stop", pressed: true });
    await scheduler.elapse(1);
    expect(virtualPendant.shown).toMatchObject({ safety: "emergency-stop", pressed: true, servo: "off" });
    const there = virtual.jointAngles().slice();
    void act({ do: "jog", joint: 1, direction: 1 });
    await scheduler.elapse(3);
    expect(farthest(virtual.jointAngles(), there)).toBe(0);
    await act({ do: "emergency-stop", pressed: false });
    await act({ do: "enable", pressed: false });
    await scheduler.elapse(0.5);
    await act({ do: "reset" });
    await act({ do: "enable", pressed: true });
    await scheduler.elapse(0.1);
    if (virtualPendant.shown.servo === "off") await act({ do: "servo", on: true });
    await scheduler.elapse(4);
    expect(virtualPendant.shown).toMatchObject({ safety: "normal", servo: "on" });
    void act({ do: "jog", joint: 1, direction: 1 });
    await scheduler.elapse(0.5);
    expect(virtualPendant.shown.moving).toBe(true);
    close();
  });

  test("the override slows a jog; inputs are what was clicked; words and read-out are JSON", async () => {
    const { cabinet: virtualPendant, scheduler, virtual, act, byHand, close } = await bench(brand);
    await byHand();
    const way = async (percent: number): Promise<number> => {
      expect(await act({ do: "override", percent })).toEqual({ kind: "done" });
      const from = virtual.jointAngles()[0]!;
      void act({ do: "jog", joint: 1, direction: 1 });
      await scheduler.elapse(1);
      void act({ do: "jog", joint: 1, direction: 0 });
      await scheduler.elapse(0.5);
      return virtual.jointAngles()[0]! - from;
    };
    const full = await way(100);
    const half = await way(50);
    expect(half / full).toBeGreaterThan(0.4);
    expect(half / full).toBeLessThan(0.62);
    expect(virtualPendant.shown.override).toBe(0.5);
    expect((await act({ do: "override", percent: 101 })).kind).toBe("refused");
    const [signal] = virtualPendant.words.inputs;
    await act({ do: "input", signal: signal!, value: true });
    expect(virtualPendant.shown.on).toEqual([signal]);
    await act({ do: "input", signal: signal!, value: false });
    expect(virtualPendant.shown.on).toEqual([]);
    for (const said of [virtualPendant.words, virtualPendant.shown])
      expect(JSON.parse(JSON.stringify(said))).toEqual(said);
    close();
  });

  test("X-41 faults: the plug is out, the controller hangs, a late line: the driver says so, and the connection comes back", async () => {
    const { cabinet: virtualPendant, scheduler, virtual, real, robot, act, close } = await bench(brand);
    expect(virtualPendant.shown.peers.length).toBeGreaterThan(0);
    for (const [out, back] of [
      [{ unplugged: true }, { unplugged: false }],
      [{ hangs: true }, { hangs: false }],
    ] as const) {
      const moving = real.moveJoints(
        Array.from(robot.home_rad, (q, i) => (i < 3 ? virtual.jointAngles()[i]! + 0.5 : q)),
      );
      await scheduler.elapse(0.2);
      await act({ do: "trouble", ...out });
      const there = virtual.jointAngles().slice();
      await scheduler.elapse(1.5);
      expect(real.link.state, JSON.stringify(out)).not.toBe("open");
      if ("hangs" in out) expect(farthest(virtual.jointAngles(), there)).toBe(0);
      expect((await moving).kind).not.toBe("done");
      await act({ do: "trouble", ...back });
      for (let i = 0; i < 200 && !real.isConnected; i++) await scheduler.elapse(0.1);
      expect(real.isConnected, `after ${JSON.stringify(out)}`).toBe(true);
      await scheduler.elapse(2);
    }
    await act({ do: "trouble", delay_s: 0.03 });
    await scheduler.elapse(1);
    expect(virtualPendant.shown.trouble).toEqual({ delay_s: 0.03, loss: 0, hangs: false, unplugged: false });
    // Where states are asked for, the way there and back is what is late.
    expect(Math.max(real.link.late_s, real.link.roundTrip_s || 0)).toBeGreaterThan(0.02);
    close();
  }, 60_000);
});
