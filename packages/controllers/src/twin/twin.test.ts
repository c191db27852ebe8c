import { manualScheduler, robotById, type JointSample } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { describeController, onCorruptSample } from "../testing/index.ts";
import { createVirtualController } from "../virtual/index.ts";
import { createTwin, type Mirror } from "./twin.ts";

const robot = robotById("staubli_rx90l")!;
const near = (by: number): number[] => robot.home_rad.map(q => q + by);
const ACCURACY_RAD = (0.001 * Math.PI) / 180;

describeController("twin of a virtual RX90L", {
  robot,
  scheduler: manualScheduler,
  make: options => createTwin({ real: createVirtualController(options), scheduler: options.scheduler }),
});

describe("twin", () => {
  function bench(mirror?: Mirror) {
    const scheduler = manualScheduler();
    const real = createVirtualController({ robot, scheduler });
    return { scheduler, real, twin: createTwin({ real, scheduler, ...(mirror ? { mirror } : {}) }) };
  }

  test("T-23 commanded, measured and mirrored angles agree to 0.001°", async () => {
    const { scheduler, real, twin } = bench();
    for (const by of [0.3, -0.2, 0.1]) {
      const command = twin.moveJoints(near(by));
      await scheduler.elapse(3);
      expect(await command).toEqual({ kind: "done" });
      twin.jointAngles().forEach((q, i) => expect(Math.abs(q - near(by)[i]!)).toBeLessThanOrEqual(ACCURACY_RAD));
    }
    expect(twin.accuracy.mirror_rad).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(twin.accuracy.command_rad).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(twin.jointAngles()).toEqual(real.jointAngles());
  });

  test("T-23 a mirror that shows something else is found out", async () => {
    const q_rad = new Float64Array(6);
    const crooked: Mirror = {
      show: lent => {
        q_rad.set(lent.q_rad);
        q_rad[3]! += 2 * ACCURACY_RAD;
      },
      read: out => {
        out.set(q_rad);
        return out;
      },
    };
    const { scheduler, twin } = bench(crooked);
    await scheduler.elapse(0.1);
    expect(twin.accuracy.mirror_rad).toBeCloseTo(2 * ACCURACY_RAD, 9);
  });

  test("T-24 what moves the real robot moves the twin, sample by sample", async () => {
    const { scheduler, real, twin } = bench();
    const pairs: [number[], number[]][] = [];
    onCorruptSample(twin, lent => {
      pairs.push([[...lent.q_rad], [...real.jointAngles()]]);
    });
    void real.moveJoints(near(0.5));
    await scheduler.elapse(2);
    expect(pairs.length).toBe(500);
    for (const [twinAngles, realAngles] of pairs) expect(twinAngles).toEqual(realAngles);
    twin.jointAngles().forEach((q, i) => expect(q).toBeCloseTo(near(0.5)[i]!, 9));
  });

  test("T-25 the real robot is commanded before the twin's pose changes", async () => {
    const { scheduler, twin } = bench();
    await scheduler.elapse(0.01);
    const before = twin.jointAngles();
    const command = twin.moveJoints(near(0.3));
    expect(twin.jointAngles()).toEqual(before);
    await scheduler.elapse(3);
    await command;
    const [sent, changed] = twin.log;
    expect(sent).toMatchObject({ what: "command", says: "move joints" });
    expect(changed).toMatchObject({ what: "pose", says: "move joints" });
    expect(sent!.at_s).toBeLessThan(changed!.at_s);
    expect(changed!.at_s - sent!.at_s).toBeLessThanOrEqual(0.008);
  });

  test("T-26 in manual mode the twin mirrors the pendant and refuses the studio", async () => {
    const { scheduler, real, twin } = bench();
    real.atTheRobot.setMode("manual");
    await scheduler.elapse(0.01);
    twin.clearLog();
    const jog = real.atTheRobot.jog(near(0.2));
    for (const command of [
      twin.moveToZero(),
      twin.moveJoints(near(0)),
      twin.moveJoint(1, 0),
      twin.run([], { tools: {}, frames: {} }),
      twin.moveToPose({ position: [0.5, 0, 0.5], quaternion: [0, 0, 0, 1] }),
    ]) {
      expect(await command).toMatchObject({ kind: "refused", why: { code: "controller.manual-mode" } });
    }
    expect(twin.setSpeed(10).kind).toBe("refused");
    expect(twin.log).toEqual([]);
    await scheduler.elapse(2);
    expect(await jog).toEqual({ kind: "done" });
    expect(twin.jointAngles()).toEqual(real.jointAngles());
    real.atTheRobot.setMode("automatic");
    await scheduler.elapse(0.01);
    const command = twin.moveToZero();
    await scheduler.elapse(5);
    expect(await command).toEqual({ kind: "done" });
  });

  test("T-27 a sensor in the stand stops both at equal joints; anyone may still stop while it lasts", async () => {
    const { scheduler, real, twin } = bench();
    const seen: JointSample["safety"][] = [];
    onCorruptSample(twin, lent => {
      if (seen.at(-1) !== lent.safety) seen.push(lent.safety);
    });
    const command = twin.moveJoints(near(0.8));
    await scheduler.elapse(0.3);
    real.atTheRobot.setGuardOpen(true);
    await scheduler.elapse(1);
    expect(await command).toMatchObject({ kind: "stopped", why: { code: "safety.guard-stop" } });
    expect(seen).toEqual(["normal", "guard-stop"]);
    expect(twin.jointAngles()).toEqual(real.jointAngles());
    expect(twin.jointAngles()[0]).not.toBeCloseTo(near(0.8)[0]!, 3);
    expect(await twin.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.guard-stop" } });
    twin.stop(true);
    await scheduler.elapse(0.1);
    expect(await twin.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.emergency-stop" } });
  });

  test("closing the twin leaves the real robot running", async () => {
    const { scheduler, real, twin } = bench();
    twin.close();
    const command = real.moveJoints(near(0.1));
    await scheduler.elapse(2);
    expect(await command).toEqual({ kind: "done" });
  });
});
