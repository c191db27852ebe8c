import { flangePose, robotById, type CommandOutcome, type Robot, type Step, type Target } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { createTwin } from "../../twin/index.ts";
import { silenceHoldsNothingUp, twinAgrees } from "../../testing/index.ts";
import { BEGIN_RAD, bench, RX160, shifted } from "../testing/bench.ts";

const ACCURACY_RAD = (0.001 * Math.PI) / 180;
const NOTHING = { tools: {}, frames: {} };
const far = shifted(0.7);
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));
const codeOf = (outcome: CommandOutcome): string => (outcome.kind === "done" ? "done" : outcome.why.code);

describe("the driver", () => {
  test("T-19 X-41 Stäubli: connected only while it is; a cut line is found again, stops the robot, and nothing moves by itself", async () => {
    const { scheduler, network, real, staubli, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.15);
    network.cut();
    expect((await ended(moving)).kind).toBe("stopped");
    await scheduler.elapse(4);
    expect([real.isConnected, farthest(staubli.arm.jointAngles(), far) > 0.1]).toEqual([true, true]);
    const rest = real.jointAngles();
    await scheduler.elapse(2);
    expect(real.jointAngles()).toEqual(rest);
    expect(await ended(real.moveJoints(shifted(0.1)))).toEqual({ kind: "done" });
    real.disconnect();
    expect(real.isConnected).toBe(false);
  });

  test("X-41 Stäubli: no watchdog: a pulled cable is noticed here, and the motion goes on to its end there; it says so", async () => {
    const { scheduler, network, real, staubli, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.3);
    network.weather.frozen = true;
    expect(codeOf(await ended(moving))).toBe("link.stale");
    await scheduler.elapse(4);
    expect(farthest(staubli.arm.jointAngles(), far)).toBeLessThan(1e-6);
    expect(real.watchdog).toMatchObject({ kind: "none" });
    network.weather.frozen = false;
    await scheduler.elapse(12);
    expect(real.isConnected).toBe(true);
  });

  test("half open: the place that nobody speaks from any more is given to who comes", async () => {
    const { scheduler, network, real, ended } = await bench();
    network.cut(true);
    await scheduler.elapse(20);
    expect(real.isConnected).toBe(true);
    expect(await ended(real.moveJoints(shifted(0.1)))).toEqual({ kind: "done" });
  });

  test("T-23 T-24 T-25 Stäubli: commanded, measured and mirrored angles agree to 0.001°; the robot is commanded first", async () => {
    const open = await bench();
    await twinAgrees({ ...open, arm: open.staubli.arm }, shifted);
  });

  test("T-20 T-27 Stäubli: an open door takes the power; the motion is cancelled, so that power alone brings none back; the power is a person's", async () => {
    const { scheduler, staubli, real, ended } = await bench();
    const { pendant } = staubli;
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.3);
    pendant.setDoorOpen(true);
    expect(await ended(moving)).toMatchObject({ kind: "stopped", why: { code: "safety.power" } });
    await scheduler.elapse(0.5);
    let heard = "";
    real.onSample(({ safety, message }) => {
      heard = `${safety}: ${message}`;
    });
    await scheduler.elapse(0.15);
    expect(heard).toBe("emergency-stop: The emergency-stop chain of the robot is open.");
    expect(farthest(real.jointAngles(), staubli.arm.jointAngles())).toBeLessThanOrEqual(ACCURACY_RAD);
    pendant.setDoorOpen(false);
    await scheduler.elapse(0.2);
    expect(heard).toBe("protective-stop: The power of the arm is off.");
    void real.reset();
    await scheduler.elapse(0.1);
    expect([codeOf(await real.moveToZero()), staubli.isPowered]).toEqual(["safety.protective-stop", false]);
    const rest = staubli.arm.jointAngles();
    pendant.acknowledge();
    expect(pendant.setPower(true)).toBeNull();
    await scheduler.elapse(3);
    expect(farthest(staubli.arm.jointAngles(), rest)).toBe(0);
    expect(await ended(real.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("T-26 Stäubli: by hand the twin follows and commands from here are refused", async () => {
    const { scheduler, staubli, real, ended } = await bench();
    const { pendant } = staubli;
    const twin = createTwin({ real, scheduler });
    pendant.setMode("manual");
    await scheduler.elapse(0.2);
    expect(codeOf(await twin.moveToZero())).toMatch(/^(controller\.manual-mode|safety\.protective-stop)$/);
    pendant.acknowledge();
    pendant.setEnabling(true);
    await scheduler.elapse(0.2);
    expect(codeOf(await twin.moveToZero())).toBe("controller.manual-mode");
    expect(await ended(pendant.jog(shifted(0.2)))).toEqual({ kind: "done" });
    pendant.setEnabling(false);
    await scheduler.elapse(0.05);
    expect(farthest(twin.jointAngles(), shifted(0.2))).toBeLessThanOrEqual(ACCURACY_RAD);
    pendant.setMode("remote");
    pendant.acknowledge();
    expect(pendant.setPower(true)).toBeNull();
    await scheduler.elapse(0.2);
    expect(await ended(twin.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("T-46 T-47 Stäubli: a controller that does not answer holds nothing up here, and the stop still goes out", async () => {
    const open = await bench();
    await silenceHoldsNothingUp({ ...open, ...open.staubli }, far, 0.15);
  });

  test("an emergency stop from here brakes, and keeps this client from moving until a person resets it; the power stays on", async () => {
    const { scheduler, staubli, real, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.3);
    real.stop(true);
    expect((await ended(moving)).kind).toBe("stopped");
    await scheduler.elapse(0.1);
    expect([codeOf(await real.moveJoints(far)), staubli.isPowered, staubli.waiting]).toEqual([
      "safety.emergency-stop",
      true,
      0,
    ]);
    void real.reset();
    await scheduler.elapse(0.1);
    expect(await ended(real.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("held at its pendant for too long a motion is cancelled: Move pressed later moves nothing", async () => {
    const { scheduler, staubli, real, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.15);
    staubli.pendant.setHold(true);
    await scheduler.elapse(3);
    staubli.pendant.setHold(false);
    await scheduler.elapse(0.1);
    expect(real.isMoving()).toBe(true);
    expect(await ended(moving)).toEqual({ kind: "done" });
    const back = real.moveToZero();
    await scheduler.elapse(0.15);
    staubli.pendant.setHold(true);
    expect(codeOf(await ended(back))).toBe("staubli.short");
    staubli.pendant.setHold(false);
    await scheduler.elapse(2);
    expect(
      farthest(
        staubli.arm.jointAngles(),
        BEGIN_RAD.map(() => 0),
      ),
    ).toBeGreaterThan(0.1);
  });

  test("a boot is survived: the link comes back, power too in remote mode, the motion does not", async () => {
    const { scheduler, staubli, real, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.3);
    staubli.reboot();
    expect((await ended(moving)).kind).toBe("stopped");
    await scheduler.elapse(10);
    const rest = staubli.arm.jointAngles();
    await scheduler.elapse(2);
    expect([real.isConnected, farthest(staubli.arm.jointAngles(), rest)]).toEqual([true, 0]);
    expect(await ended(real.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("connecting disturbs nothing: a program started at the pendant goes on under the eyes of who watches", async () => {
    const { scheduler, staubli, real, ended } = await bench();
    const there = [10, 20, 30, 0, 20, 0];
    real.disconnect();
    expect(staubli.pendant.load(`movej ${there.join(" ")}`)).toBeNull();
    const running = staubli.pendant.start();
    expect(await ended(real.connect())).toEqual({ kind: "done" });
    expect(await ended(running)).toBe("");
    await scheduler.elapse(0.1);
    expect(
      farthest(
        real.jointAngles(),
        there.map(value => (value * Math.PI) / 180),
      ),
    ).toBeLessThanOrEqual(ACCURACY_RAD);
  });

  test("half the speed is half the speed on the way; lowered in the middle of a motion it counts at once", async () => {
    const { scheduler, staubli, real, ended } = await bench();
    const long = shifted(1);
    let last = staubli.arm.jointAngles();
    let most = 0;
    staubli.arm.onSample(({ q_rad }) => {
      most = Math.max(most, Math.abs(q_rad[0]! - last[0]!) / 0.004);
      last = q_rad.slice();
    });
    expect(await ended(real.moveJoints(shifted(-1)))).toEqual({ kind: "done" });
    expect(await ended(real.moveJoints(long))).toEqual({ kind: "done" });
    const full = most;
    most = 0;
    real.setSpeed(50);
    expect(await ended(real.moveJoints(shifted(-1)))).toEqual({ kind: "done" });
    expect(Math.abs(most / full - 0.5)).toBeLessThan(0.01);
    real.setSpeed(100);
    const moving = real.moveJoints(long);
    await scheduler.elapse(0.15);
    real.setSpeed(10);
    await scheduler.elapse(0.6);
    most = 0;
    expect(await ended(moving)).toEqual({ kind: "done" });
    expect(most / full).toBeLessThan(0.11);
  });

  test("lines, arcs and softer accelerations are refused with a way out; signals too", async () => {
    const { real } = await bench();
    const from = flangePose(RX160.arm, BEGIN_RAD);
    const [x, y, z] = from.position;
    const at = (dy: number, dz: number): Target => ({
      pose: { position: [x, y + dy, z + dz], quaternion: from.quaternion },
      frame: "world",
      tool: "flange",
    });
    const line: Step = {
      id: "line",
      type: "move",
      path: "lin",
      target: at(0.02, -0.02),
      speed: { mps: 0.2 },
      blend_m: 0,
    };
    const soft: Step = {
      id: "soft",
      type: "move",
      path: "ptp",
      target: { q: far },
      speed: { ratio: 1 },
      acceleration: { ratio: 0.5 },
      blend_m: 0,
    };
    const refused = await real.run([line], NOTHING);
    expect(codeOf(refused)).toBe("staubli.path");
    expect(codeOf(await real.run([soft], NOTHING))).toBe("staubli.acceleration");
    expect(codeOf(await real.run([{ id: "set", type: "set", signal: "valve1", to: true }], NOTHING))).toBe(
      "staubli.signals",
    );
  });

  test("T-15 another robot is refused by name: joint count, V+'s zeros, joints where it cannot be", async () => {
    const seven = await bench({ face: { robot: robotById("kuka_lbr_iiwa_14_r820")! } });
    expect(seven.real.link.sentence).toMatch(/has 7 joints.*Stäubli arm of 6/);
    const old = await bench({ face: { robot: robotById("staubli_rx90l")! } });
    expect(old.real.link.sentence).toContain("Stäubli RX90L counts its joints as V+ does");
    const small: Robot = {
      ...RX160,
      id: "tx2_40",
      name: "Stäubli TX2-40",
      arm: {
        ...RX160.arm,
        joints: RX160.arm.joints.map(joint => ({ ...joint, limits: { ...joint.limits, lower_rad: -1, upper_rad: 1 } })),
      },
    };
    const other = await bench({
      face: { robot: small },
      virtual: { start_rad: BEGIN_RAD.map((q, i) => (i === 1 ? 1.5 : q)) },
    });
    expect([other.real.isConnected, other.real.link.state, other.real.link.sentence]).toEqual([
      false,
      "closed",
      "Joint 2 of the controller's robot stands at 85.9°, where a Stäubli TX2-40 cannot be.",
    ]);
  });
});
