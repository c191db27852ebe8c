import { flangePose, robotById, type CommandOutcome, type Robot, type Step, type Target } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { createTwin } from "../../twin/index.ts";
import { twinAgrees } from "../../testing/index.ts";
import { bench, RX90L, shifted } from "../testing/bench.ts";

const ACCURACY_RAD = (0.001 * Math.PI) / 180;
const NOTHING = { tools: {}, frames: {} };
const far = shifted(0.7);
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));
const codeOf = (outcome: CommandOutcome): string => (outcome.kind === "done" ? "done" : outcome.why.code);

describe("the driver", () => {
  test("T-19 X-41 CS7: connected only while it is; a cut line is found again, what was left is stopped then, and nothing moves by itself", async () => {
    const { scheduler, network, real, cs7, ended } = await bench();
    real.setSpeed(20);
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    network.cut();
    expect((await ended(moving)).kind).toBe("stopped");
    await scheduler.elapse(4);
    expect(real.isConnected).toBe(true);
    // It has no watchdog; who comes again stops what is still on its way.
    expect([real.watchdog.kind, farthest(cs7.arm.jointAngles(), far) > 0.05]).toEqual(["none", true]);
    const rest = cs7.arm.jointAngles();
    await scheduler.elapse(2);
    expect(cs7.arm.jointAngles()).toEqual(rest);
    expect(await ended(real.moveJoints(shifted(0.1)))).toEqual({ kind: "done" });
    real.disconnect();
    expect(real.isConnected).toBe(false);
  });

  test("X-41 CS7: no watchdog: a pulled cable is noticed here, and the motion goes on to its end there", async () => {
    const { scheduler, network, real, cs7, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    network.weather.frozen = true;
    expect(codeOf(await ended(moving))).toMatch(/^link\./);
    await scheduler.elapse(4);
    expect(farthest(cs7.arm.jointAngles(), far)).toBeLessThan(ACCURACY_RAD);
    network.weather.frozen = false;
    await scheduler.elapse(15);
    expect(real.isConnected).toBe(true);
  });

  test("half open: the terminal that nobody types at any more is given to who comes", async () => {
    const { scheduler, network, real, ended } = await bench();
    network.cut(true);
    await scheduler.elapse(20);
    expect(real.isConnected).toBe(true);
    expect(await ended(real.moveJoints(shifted(0.1)))).toEqual({ kind: "done" });
  });

  test("T-23 T-24 T-25 CS7: commanded, measured and mirrored angles agree to 0.001°; the robot is commanded first", async () => {
    const open = await bench();
    await twinAgrees({ ...open, arm: open.cs7.arm }, shifted);
  });

  test("T-20 T-27 CS7: an open gate takes high power; the state arrives in words; power alone brings no motion back", async () => {
    const { scheduler, cs7, real, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    cs7.pendant.setGuardOpen(true);
    expect(await ended(moving)).toMatchObject({ kind: "stopped", why: { code: "safety.power" } });
    let heard = "";
    real.onSample(({ safety, message }) => {
      heard = `${safety}: ${message}`;
    });
    void real.reset();
    await scheduler.elapse(1);
    expect([heard.startsWith("protective-stop: "), cs7.isPowered, codeOf(await real.moveToZero())]).toEqual([
      true,
      false,
      "safety.protective-stop",
    ]);
    cs7.pendant.setGuardOpen(false);
    const rest = cs7.arm.jointAngles();
    void real.reset();
    await scheduler.elapse(2);
    expect([cs7.isPowered, farthest(cs7.arm.jointAngles(), rest)]).toEqual([true, 0]);
    expect(await ended(real.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("T-26 CS7: by hand the twin follows and commands from here are refused", async () => {
    const { scheduler, cs7, real, ended } = await bench();
    const twin = createTwin({ real, scheduler });
    cs7.pendant.setManual(true);
    await scheduler.elapse(0.2);
    expect(codeOf(await twin.moveToZero())).toBe("controller.manual-mode");
    expect(await ended(cs7.pendant.jog(shifted(0.2)))).toEqual({ kind: "done" });
    await scheduler.elapse(0.1);
    expect(farthest(twin.jointAngles(), shifted(0.2))).toBeLessThanOrEqual(ACCURACY_RAD);
    cs7.pendant.setManual(false);
    await scheduler.elapse(0.2);
    expect(await ended(twin.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("T-46 T-47 CS7: a controller that does not answer holds nothing up here, and the stop still goes out; PANIC takes high power", async () => {
    const { scheduler, cs7, real, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    cs7.faults.silent = true;
    const from_s = scheduler.now_s();
    real.stop(true);
    expect(scheduler.now_s()).toBe(from_s);
    expect((await ended(moving)).kind).toBe("stopped");
    expect([farthest(cs7.arm.jointAngles(), far) > 0.1, cs7.isPowered]).toEqual([true, false]);
    cs7.faults.silent = false;
    await scheduler.elapse(15);
    expect(real.isConnected).toBe(true);
  });

  test("a boot is survived; the calibration is a person's, and a reset from here says so", async () => {
    const { scheduler, cs7, real, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    cs7.reboot();
    expect((await ended(moving)).kind).toBe("stopped");
    await scheduler.elapse(12);
    expect(real.isConnected).toBe(true);
    void real.reset();
    await scheduler.elapse(2);
    expect([cs7.isPowered, codeOf(await real.moveToZero())]).toEqual([true, "safety.protective-stop"]);
    let heard = "";
    real.onSample(({ message }) => {
      heard = message;
    });
    await scheduler.elapse(0.1);
    expect(heard).toContain("not calibrated");
    cs7.pendant.type("CALIBRATE");
    await scheduler.elapse(0.2);
    expect(await ended(real.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("lines end where they should; arcs, other joint counts, unknown joints and wrong places are refused by name; outputs by their numbers", async () => {
    const start = [0, -1.2, 2.2, 0, 0.8, 0];
    const { cs7, real, ended } = await bench({ virtual: { start_rad: start } });
    const from = flangePose(RX90L.arm, start);
    const [x, y, z] = from.position;
    const at = (dy: number, dz: number): Target => ({
      pose: { position: [x, y + dy, z + dz], quaternion: from.quaternion },
      frame: "world",
      tool: "flange",
    });
    const line: Step = { id: "line", type: "move", path: "lin", target: at(0.1, 0), speed: { mps: 0.2 }, blend_m: 0 };
    expect(await ended(real.run([line, { id: "set", type: "set", signal: "out_7", to: true }], NOTHING))).toEqual({
      kind: "done",
    });
    expect(flangePose(RX90L.arm, real.jointAngles()).position[1]).toBeCloseTo(y + 0.1, 4);
    expect(cs7.arm.signals.read("out_7")).toBe(true);
    const arc: Step = { ...line, id: "arc", path: "circ", via: at(0.05, 0.05), target: at(0, 0) };
    expect(await real.run([arc], NOTHING)).toMatchObject({ kind: "refused", why: { code: "cs7.arc" } });
    expect(await real.run([{ id: "set", type: "set", signal: "DO[1]", to: true }], NOTHING)).toMatchObject({
      kind: "refused",
      why: { code: "cs7.line" },
    });
    const seven = await bench({ face: { robot: robotById("kuka_lbr_iiwa_14_r820")! } });
    expect(seven.real.link.sentence).toMatch(/6 joints; .* has 7/);
    const other = await bench({ face: { robot: robotById("staubli_rx160")! } });
    expect(other.real.link.sentence).toContain("How V+ counts the joints of Stäubli RX160");
    const small: Robot = {
      ...RX90L,
      name: "Stäubli RX60",
      arm: {
        ...RX90L.arm,
        joints: RX90L.arm.joints.map(joint => ({ ...joint, limits: { ...joint.limits, lower_rad: -1, upper_rad: 1 } })),
      },
    };
    const elsewhere = await bench({ face: { robot: small } });
    expect(elsewhere.real.link.sentence).toBe(
      "Joint 2 of the controller's robot stands at -90.0°, where a Stäubli RX60 cannot be.",
    );
  });

  test("connecting disturbs nothing: a program that somebody started at the controller goes on under the eyes of who watches", async () => {
    const { scheduler, cs7, real, ended } = await bench();
    const { pendant } = cs7;
    const there = [20, -80, 80, 0, 0, 0];
    real.disconnect();
    pendant.write("JOB.V2", `.PROGRAM job()\nMOVE #PPOINT(${there.join(",")})\n.END\n`);
    expect([pendant.type("LOAD job"), pendant.type("EXECUTE 1 job")]).toEqual(["", ""]);
    expect(await ended(real.connect())).toEqual({ kind: "done" });
    await scheduler.elapse(3);
    expect(
      farthest(
        real.jointAngles(),
        there.map(value => (value * Math.PI) / 180),
      ),
    ).toBeLessThanOrEqual(ACCURACY_RAD);
  });

  test("X-41 a slow serial line, 0.3 s an answer: it stays open, says how late a break is noticed, motions come and end, the stop is typed at once", async () => {
    const { scheduler, cs7, real, ended } = await bench({ face: { baud: 9600 } });
    cs7.faults.delay_s = 0.3;
    await scheduler.elapse(1);
    let states = 0;
    real.onSample(() => {
      states++;
    });
    await scheduler.elapse(10);
    expect(states).toBeGreaterThan(20);
    expect(states).toBeLessThan(40);
    expect(await ended(real.moveJoints(far))).toEqual({ kind: "done" });
    expect(farthest(cs7.arm.jointAngles(), far)).toBeLessThanOrEqual(ACCURACY_RAD);
    real.setSpeed(10);
    const back = real.moveJoints(shifted(0));
    await scheduler.elapse(1.5);
    expect(cs7.arm.isMoving()).toBe(true);
    real.stop();
    await scheduler.elapse(cs7.arm.brakingTime_s + 0.05);
    expect(cs7.arm.isMoving()).toBe(false);
    expect((await ended(back)).kind).toBe("stopped");
  });

  test("what the controller says of its own accord, with a prompt behind it, is no answer to a question", async () => {
    const { scheduler, cs7, real, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.1);
    cs7.faults.split = true;
    expect(await ended(moving)).toEqual({ kind: "done" });
    await scheduler.elapse(1);
    expect(real.isConnected).toBe(true);
    expect(farthest(real.jointAngles(), far)).toBeLessThanOrEqual(ACCURACY_RAD);
  });
});
