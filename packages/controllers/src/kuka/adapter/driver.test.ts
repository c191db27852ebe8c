import { flangePose, robotById, type CommandOutcome, type LinkReport, type Step, type Target } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { createTwin } from "../../twin/index.ts";
import { ended, HOST, interpretMoves, KR6, kukaBench } from "../testing/bench.ts";
import { createVirtualKuka } from "../index.ts";

const ACCURACY_RAD = (0.001 * Math.PI) / 180;
const shifted = (by_rad: number): number[] => Array.from(KR6.home_rad, (q, i) => (i === 4 ? q - by_rad : q + by_rad));
const far = shifted(0.6);
const NOTHING = { tools: {}, frames: {} };
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));
const codeOf = (outcome: CommandOutcome): string => (outcome.kind === "done" ? "done" : outcome.why.code);

describe("connection", () => {
  test("T-19 KUKA: connected only while it is; a cut line is lost, found again, and nothing moves by itself", async () => {
    const bench = await kukaBench();
    const { scheduler, network, real } = bench;
    const states: string[] = [];
    expect(real.isConnected).toBe(true);
    real.onLink((report: LinkReport) => {
      states.push(report.state);
    });
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    network.cut();
    expect(await moving).toMatchObject({ kind: "stopped", why: { code: "link.lost" } });
    await scheduler.elapse(2);
    expect(states).toEqual(["lost", "connecting", "open"]);
    const rest = real.jointAngles();
    await scheduler.elapse(2);
    expect(real.jointAngles()).toEqual(rest);
    real.disconnect();
    expect(real.isConnected).toBe(false);
  });

  test("X-41 KUKA: the line dies without a word: the motion ends here within 100 ms and on the robot by its own timer", async () => {
    const { scheduler, network, kuka, real } = await kukaBench();
    expect(real.watchdog).toEqual({ kind: "robot", within_s: 0.5 });
    real.setSpeed(20);
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.5);
    network.weather.frozen = true;
    const from_s = scheduler.now_s();
    let ended_s = NaN;
    void moving.then(() => {
      ended_s = scheduler.now_s();
    });
    await scheduler.elapse(0.15);
    expect(ended_s - from_s).toBeLessThanOrEqual(0.13);
    await scheduler.elapse(0.5);
    expect(kuka.arm.isMoving()).toBe(false);
    expect(kuka.variables.read("TWC_RESULT")).toBe("4");
    const rest = kuka.arm.jointAngles();
    network.weather.frozen = false;
    await scheduler.elapse(3);
    expect(real.isConnected).toBe(true);
    expect(kuka.arm.jointAngles()).toEqual(rest);
  });

  test("a robot of another model, of another number of joints, of unknown axes is refused with both names", async () => {
    const other = await kukaBench({ virtual: { model: "#KR10R1100SIXX C4 FLR" } });
    expect(other.real.isConnected).toBe(false);
    expect(other.real.link.sentence).toBe(
      "KUKA KR 6 R900 sixx was expected; the controller says it moves a #KR10R1100SIXX C4 FLR.",
    );
    const seven = await kukaBench({ face: { robot: robotById("kuka_lbr_iiwa_14_r820")! } });
    expect(seven.real.link.sentence).toContain("has 7 joints; the controller of a KUKA counts 6 axes");
    const strange = await kukaBench({
      face: { robot: robotById("staubli_rx90l")!, model: "#KR6R900SIXX C2 FLR ZH100" },
    });
    expect(strange.real.link.sentence).toContain("counts the axes of");
  });

  test("a controller whose variables stand still is stale, though it answers", async () => {
    const { scheduler, kuka, real } = await kukaBench();
    kuka.faults.frozen = true;
    await scheduler.elapse(0.2);
    expect(real.isConnected).toBe(false);
    expect(real.link.sentence).toMatch(/Nothing came/);
    kuka.faults.frozen = false;
    await scheduler.elapse(3);
    expect(real.isConnected).toBe(true);
  });

  test("after a reboot the clock begins again: the link comes back, motion waits for a person", async () => {
    const bench = await kukaBench();
    const { scheduler, kuka, real } = bench;
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    kuka.reboot();
    expect((await ended(bench, moving)).kind).toBe("stopped");
    await scheduler.elapse(3);
    expect([real.isConnected, kuka.arm.isMoving()]).toEqual([true, false]);
    expect(codeOf(await real.moveToZero())).toBe("kuka.drives-off");
    void real.reset();
    await scheduler.elapse(0.3);
    expect(await ended(bench, real.moveJoints(shifted(0.1)))).toEqual({ kind: "done" });
  });

  test("without the program on the controller it is watched and not moved", async () => {
    const bench = await kukaBench({ running: false });
    bench.kuka.pendant.setDrives(true);
    await bench.scheduler.elapse(0.1);
    expect(bench.real.isConnected).toBe(true);
    expect(await bench.real.moveToZero()).toMatchObject({
      kind: "refused",
      why: { code: "kuka.loop-rests", sentence: "The program TWINCELL is not selected." },
    });
  });

  test("faults of the line, each for itself: no crash, no motion of its own, and it works again afterwards", async () => {
    for (const fault of [{ refusing: true }, { silent: true }, { garbage: 1 }, { dropAfter: 3 }, { delay_s: 0.3 }]) {
      const bench = await kukaBench();
      const { scheduler, network, kuka, real } = bench;
      const moving = real.moveJoints(far);
      await scheduler.elapse(0.15);
      Object.assign(kuka.faults, fault);
      if ("refusing" in fault) network.cut();
      await scheduler.elapse(1.5);
      expect((await ended(bench, moving)).kind, JSON.stringify(fault)).toBe("stopped");
      expect(kuka.arm.isMoving()).toBe(false);
      Object.assign(kuka.faults, { refusing: false, silent: false, garbage: 0, dropAfter: Infinity, delay_s: 0 });
      const rest = kuka.arm.jointAngles();
      await scheduler.elapse(12);
      expect([real.isConnected, farthest(rest, kuka.arm.jointAngles())], JSON.stringify(fault)).toEqual([true, 0]);
    }
  });

  test("answers byte by byte and a slow, jittery line change nothing but the time", async () => {
    const bench = await kukaBench();
    const { network, kuka, real } = bench;
    kuka.faults.split = true;
    Object.assign(network.weather, { delay_s: 0.01, jitter_s: 0.01 });
    expect(await ended(bench, real.moveJoints(far))).toEqual({ kind: "done" });
    expect(farthest(real.jointAngles(), far)).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(real.link.roundTrip_s).toBeGreaterThanOrEqual(0.02);
  });
});

describe("motion", () => {
  test("T-23 KUKA: commanded, measured and mirrored angles agree to 0.001°, with seven digits on the wire", async () => {
    const bench = await kukaBench();
    const twin = createTwin({ real: bench.real, scheduler: bench.scheduler });
    for (const by of [0.4, -0.3, 0.123456789]) {
      expect(await ended(bench, twin.moveJoints(shifted(by)))).toEqual({ kind: "done" });
      expect(farthest(bench.real.jointAngles(), shifted(by))).toBeLessThanOrEqual(ACCURACY_RAD);
      expect(farthest(bench.kuka.arm.jointAngles(), shifted(by))).toBeLessThanOrEqual(ACCURACY_RAD);
    }
    expect(twin.accuracy.mirror_rad).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(twin.accuracy.command_rad).toBeLessThanOrEqual(ACCURACY_RAD);
  });

  test("T-24 T-25 KUKA: the robot is commanded first, the mirror follows at the next sample", async () => {
    const bench = await kukaBench();
    const twin = createTwin({ real: bench.real, scheduler: bench.scheduler });
    await ended(bench, twin.moveJoints(far));
    const command = twin.log.find(({ what }) => what === "command")!;
    const pose = twin.log.find(({ what }) => what === "pose")!;
    expect(command.at_s).toBeLessThan(pose.at_s);
    expect(pose.at_s - command.at_s).toBeLessThan(0.05);
  });

  test("T-17 KUKA: the greatest speed of the robot scales how long it moves, measured at the robot", async () => {
    const lasting = async (maxSpeed: number): Promise<number> => {
      const bench = await kukaBench({ virtual: { maxSpeed } });
      let cycles = 0;
      bench.kuka.arm.onSample(({ moving }) => {
        if (moving) cycles++;
      });
      await ended(bench, bench.real.moveJoints(far));
      return 0.004 * cycles;
    };
    expect(Math.abs((await lasting(0.25)) - 4 * (await lasting(1)))).toBeLessThan(0.0125);
  });

  test("lines and arcs go where they should, at their speed; a spline is refused by name", async () => {
    const bench = await kukaBench();
    const { real, scheduler, kuka } = bench;
    const from = flangePose(KR6.arm, KR6.home_rad);
    const [x, y, z] = from.position;
    const at = (dy: number, dz: number): Target => ({
      pose: { position: [x, y + dy, z + dz], quaternion: from.quaternion },
      frame: "world",
      tool: "flange",
    });
    const begun_s = scheduler.now_s();
    const line: Step = { id: "line", type: "move", path: "lin", target: at(0.2, 0), speed: { mps: 0.1 }, blend_m: 0 };
    expect(await ended(bench, real.run([line], NOTHING))).toEqual({ kind: "done" });
    expect(scheduler.now_s() - begun_s).toBeGreaterThan(2);
    expect(scheduler.now_s() - begun_s).toBeLessThan(2.5);
    let highest = -Infinity;
    kuka.arm.onSample(({ q_rad }) => {
      highest = Math.max(highest, flangePose(KR6.arm, q_rad).position[2]);
    });
    const arc: Step = {
      id: "arc",
      type: "move",
      path: "circ",
      via: at(0.1, 0.1),
      target: at(0, 0),
      speed: { mps: 0.2 },
      blend_m: 0,
    };
    expect(await ended(bench, real.run([arc], NOTHING))).toEqual({ kind: "done" });
    expect(highest - z).toBeCloseTo(0.1, 4);
    const is = flangePose(KR6.arm, real.jointAngles()).position;
    expect(Math.hypot(is[0] - x, is[1] - y, is[2] - z)).toBeLessThan(1e-6);
    expect(await real.run([{ ...line, path: "spline" }], NOTHING)).toMatchObject({
      kind: "refused",
      why: { code: "controller.motion" },
    });
  });

  test("outputs, inputs and the gripper by their numbers; what is no output is refused by name", async () => {
    const bench = await kukaBench({ face: { signals: ["$IN[3]", "$OUT[1]"], gripperOutput: 9 } });
    const { real, kuka, scheduler } = bench;
    const steps: Step[] = [
      { id: "a", type: "set", signal: "$OUT[1]", to: true },
      { id: "b", type: "gripper", closed: true },
      { id: "c", type: "wait-for", when: { signal: "$IN[3]", is: true } },
    ];
    const run = real.run(steps, NOTHING);
    await scheduler.elapse(1);
    expect([kuka.variables.read("$OUT[1]"), kuka.variables.read("$OUT[9]"), real.signals!.read("$OUT[1]")]).toEqual([
      "TRUE",
      "TRUE",
      true,
    ]);
    kuka.pendant.setInput(3, true);
    expect(await ended(bench, run)).toEqual({ kind: "done" });
    expect(await real.run([{ id: "d", type: "set", signal: "lamp", to: true }], NOTHING)).toMatchObject({
      kind: "refused",
      why: { code: "kuka.line" },
    });
  });
});

describe("stops and whoever stands at the robot", () => {
  test("T-20 T-27 KUKA: the proximity input stops robot and twin at equal angles, and says why; a reset is a person's", async () => {
    const bench = await kukaBench();
    const { scheduler, kuka } = bench;
    const twin = createTwin({ real: bench.real, scheduler });
    let heard = "";
    twin.onSample(({ safety, message }) => {
      heard = `${safety}: ${message}`;
    });
    const moving = twin.moveJoints(far);
    await scheduler.elapse(0.3);
    kuka.pendant.setGuardOpen(true);
    expect((await ended(bench, moving)).kind).toBe("stopped");
    await scheduler.elapse(0.5);
    expect(heard).toBe("guard-stop: The operator safety is open.");
    expect(farthest(twin.jointAngles(), kuka.arm.jointAngles())).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(codeOf(await twin.moveToZero())).toBe("safety.guard-stop");
    kuka.pendant.setGuardOpen(false);
    await scheduler.elapse(0.1);
    expect(heard).toContain("protective-stop");
    const rest = kuka.arm.jointAngles();
    void twin.reset();
    await scheduler.elapse(1);
    expect([kuka.arm.jointAngles(), kuka.program.state]).toEqual([rest, "ACTIVE"]);
    expect(await ended(bench, twin.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("T-26 KUKA: on the pendant in T1 the twin follows and commands from here are refused", async () => {
    const bench = await kukaBench();
    const { scheduler, kuka, real } = bench;
    const twin = createTwin({ real, scheduler });
    kuka.pendant.setMode("T1");
    await scheduler.elapse(0.1);
    kuka.pendant.setEnabling(true);
    const jog = kuka.pendant.jog(shifted(0.1));
    await scheduler.elapse(0.3);
    expect(codeOf(await twin.moveToZero())).toBe("controller.manual-mode");
    expect(await ended(bench, jog)).toEqual({ kind: "done" });
    await scheduler.elapse(0.05);
    expect(farthest(twin.jointAngles(), shifted(0.1))).toBeLessThanOrEqual(ACCURACY_RAD);
    kuka.pendant.setMode("AUT");
    await scheduler.elapse(0.1);
    kuka.pendant.setDrives(true);
    await scheduler.elapse(0.05);
    void twin.reset();
    await scheduler.elapse(0.5);
    expect(await ended(bench, twin.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("the key turned in the middle of a motion ends it; started again at the pendant, the rest of it is not driven", async () => {
    const bench = await kukaBench();
    const { scheduler, kuka, real } = bench;
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    kuka.pendant.setMode("AUT");
    expect((await ended(bench, moving)).kind).toBe("stopped");
    await scheduler.elapse(0.5);
    const rest = kuka.arm.jointAngles();
    kuka.pendant.confirm();
    expect(kuka.pendant.setDrives(true)).toBeNull();
    expect(kuka.pendant.start()).toBeNull();
    await scheduler.elapse(1);
    expect(kuka.arm.jointAngles()).toEqual(rest);
  });

  test("the stop key at the pendant ends the motion here, and the start key does not take it up", async () => {
    const bench = await kukaBench();
    const { scheduler, kuka, real } = bench;
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    kuka.pendant.stop();
    expect((await ended(bench, moving)).kind).toBe("stopped");
    await scheduler.elapse(0.5);
    const rest = kuka.arm.jointAngles();
    kuka.pendant.start();
    await scheduler.elapse(1);
    expect(farthest(kuka.arm.jointAngles(), rest)).toBeLessThan(0.02);
    expect(kuka.variables.read("TWC_RESULT")).toBe("2");
  });

  test("a stop between a command and its start reaches the robot before it does", async () => {
    const bench = await kukaBench();
    const { scheduler, network, kuka, real } = bench;
    network.weather.delay_s = 0.02;
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.01);
    real.stop();
    expect((await ended(bench, moving)).kind).toBe("stopped");
    await scheduler.elapse(0.5);
    expect(farthest(kuka.arm.jointAngles(), KR6.home_rad)).toBe(0);
  });

  test("an emergency stop from here locks the program for everybody and takes the drives off; without a wire to them they stay on, as the protocol has none", async () => {
    for (const wiring of [{ drivesOn: 997, drivesOff: 998 }, null]) {
      const bench = await kukaBench({ virtual: { wiring } });
      const { scheduler, kuka, real } = bench;
      const moving = real.moveJoints(far);
      await scheduler.elapse(0.2);
      real.stop(true);
      expect((await ended(bench, moving)).kind).toBe("stopped");
      await scheduler.elapse(0.5);
      expect([kuka.variables.read("TWC_LOCK"), kuka.drivesOn, kuka.arm.isMoving()]).toEqual([
        "TRUE",
        wiring === null,
        false,
      ]);
      expect(codeOf(await real.moveToZero())).toBe("safety.emergency-stop");
      void real.reset();
      await scheduler.elapse(0.3);
      expect(await ended(bench, real.moveJoints(far))).toEqual({ kind: "done" });
    }
  });

  test("T-46 T-47 KUKA: while the controller does not answer for two seconds nothing here waits, and the stop still goes out", async () => {
    const bench = await kukaBench();
    const { scheduler, kuka, real } = bench;
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    kuka.faults.delay_s = 2;
    const from_s = scheduler.now_s();
    real.stop();
    expect(scheduler.now_s()).toBe(from_s);
    await scheduler.elapse(0.3);
    expect([kuka.arm.isMoving(), kuka.variables.read("TWC_RESULT")]).toEqual([false, "2"]);
    expect((await ended(bench, moving)).kind).toBe("stopped");
  });
});

describe("programs of the controller's own language", () => {
  const file = (name: string, ...lines: string[]) => ({ name, text: lines.join("\r\n"), lines: lines.map(() => "") });
  const MOVES = file("JOB.src", "DEF JOB( )", "PTP 20 -90 90 0 90 0", "PTP 60 -60 60 0 60 0", "END");

  test("a text is written, selected, started and watched to its end; afterwards our program has its place again", async () => {
    for (const mode of ["EX", "AUT"] as const) {
      const bench = await kukaBench({ virtual: { mode } });
      const { kuka, real, scheduler } = bench;
      expect(await ended(bench, real.runText!([MOVES]))).toEqual({ kind: "done" });
      expect(kuka.arm.jointAngle(1)).toBeCloseTo(Math.PI / 3, 9);
      await scheduler.elapse(0.1);
      if (mode === "AUT") kuka.pendant.start();
      await scheduler.elapse(0.1);
      expect([kuka.program.name, kuka.program.state]).toEqual(["TWINCELL", "ACTIVE"]);
      expect(await ended(bench, real.moveJoints(far))).toEqual({ kind: "done" });
    }
  });
  test("an error in the text is refused, a stop ends it, a module without .src is none", async () => {
    const bench = await kukaBench();
    const { kuka, real, scheduler } = bench;
    expect(codeOf(await ended(bench, real.runText!([file("JOB.src", "DEF JOB( )", "HOP", "END")])))).toBe(
      "kuka.program",
    );
    expect(codeOf(await ended(bench, real.runText!([file("JOB.dat", "")])))).toBe("kuka.file");
    await scheduler.elapse(0.1);
    const running = real.runText!([MOVES]);
    await scheduler.elapse(0.5);
    real.stop();
    expect((await ended(bench, running)).kind).toBe("stopped");
    await scheduler.elapse(0.5);
    expect(kuka.arm.isMoving()).toBe(false);
    expect(await ended(bench, real.moveJoints(far))).toEqual({ kind: "done" });
  });
  test("T-47 KUKA: a text that a lost line left behind makes room at a person's reset, and nothing goes on watching it", async () => {
    const bench = await kukaBench();
    const { kuka, real, scheduler, network } = bench;
    const running = real.runText!([MOVES]);
    await scheduler.elapse(0.5);
    network.weather.frozen = true;
    await scheduler.elapse(0.2);
    expect((await running).kind).toBe("stopped");
    network.weather.frozen = false;
    kuka.pendant.stop();
    await scheduler.elapse(2);
    expect([real.isConnected, kuka.program.name, kuka.program.state]).toEqual([true, "JOB", "STOP"]);
    expect(codeOf(await real.moveJoints(far))).toBe("kuka.loop-rests");
    void real.reset();
    await scheduler.elapse(1);
    expect(await ended(bench, real.moveJoints(far))).toEqual({ kind: "done" });
  });
});

test("T-21 a driver is a face handed in: two robots of one network, each its own", async () => {
  const one = await kukaBench();
  const two = await createVirtualKuka({
    robot: KR6,
    scheduler: one.scheduler,
    network: one.network,
    host: "127.0.0.4",
    interpret: interpretMoves,
  });
  expect([one.kuka.listening, two.listening]).toMatchObject([
    { kind: "listening", address: { host: HOST, port: 7000 } },
    { kind: "listening", address: { host: "127.0.0.4", port: 7000 } },
  ]);
  await ended(one, one.real.moveJoints(far));
  expect(two.arm.jointAngle(1)).toBe(KR6.home_rad[0]);
});
