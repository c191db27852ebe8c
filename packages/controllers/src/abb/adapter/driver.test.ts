import { type EmittedFile, type Executed, type Interpreted, type JointSample, type Step } from "@twincell/core";
import { describe, expect, test } from "vitest";
import {
  AROUND,
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
import { abbAdapter, type AbbAdapterOptions } from "./index.ts";

/**
 * Joint moves in degrees, signals and faults of a module: enough to show that a controller executes what it is handed.
 * RAPID itself is read in the apps' tests.
 */
function interpret(text: string): Interpreted {
  const lines = text.split("\n");
  const wrong = lines.findIndex(line => line.includes("nonsense"));
  if (wrong >= 0)
    return {
      kind: "not-understood",
      faults: [{ line: wrong + 1, column: 1, expected: "an instruction", sentence: "This is no instruction." }],
    };
  return {
    kind: "ready",
    context: NOTHING,
    *run(): Generator<Executed, void> {
      for (const [i, line] of lines.entries()) {
        const move = /^\s*MoveAbsJ (.*);/.exec(line);
        const set = /^\s*SetDO (\w+),([01]);/.exec(line);
        if (line.includes("FAULT")) throw new Error("division by zero");
        if (set) yield { line: i + 1, step: { id: "", type: "set", signal: set[1]!, to: set[2] === "1" } };
        if (move)
          yield {
            line: i + 1,
            step: {
              id: "",
              type: "move",
              path: "ptp",
              target: { q: move[1]!.split(",").map(value => (Number(value) * Math.PI) / 180) },
              speed: { ratio: 1 },
              blend_m: 0,
            },
          };
      }
    },
  };
}
const module = (...body: string[]): EmittedFile[] => [
  { name: "job.mod", text: ["MODULE job", "PROC main()", ...body, "ENDPROC", "ENDMODULE", ""].join("\n"), lines: [] },
];

const bench = (virtualOptions: Partial<VirtualAbbOptions> = {}, faceOptions: Partial<AbbAdapterOptions> = {}) =>
  streamingBench(options => abbAdapter({ ...options, ...faceOptions }), { rws: 80, interpret, ...virtualOptions });
const spread = (heard: readonly JointSample[], of: (sample: JointSample) => string): string[] =>
  heard.map(of).filter((value, i, all) => value !== all[i - 1]);

describe("the driver of ABB's controllers, over both of their interfaces", () => {
  test("T-19 connected when both answer; nobody, another user, another robot, other axes: one sentence each", async () => {
    const { real, connecting } = await bench();
    expect(await connecting).toEqual({ kind: "done" });
    expect(real.isConnected).toBe(true);
    real.disconnect();
    expect(real.isConnected).toBe(false);
    expect(await (await bench({ rws: 81 })).connecting).toMatchObject({
      kind: "refused",
      why: {
        code: "link.refused",
        sentence: expect.stringMatching(/^No Robot Web Services at 127\.0\.0\.1:80: /) as string,
      },
    });
    expect(await (await bench({}, { login: { user: "Default User", password: "wrong" } })).connecting).toMatchObject({
      kind: "refused",
      why: { sentence: "No Robot Web Services at 127.0.0.1:80: The controller does not take this user and password." },
    });
    const other = await bench({ model: "IRB 1200-5/0.9" });
    expect(await other.connecting).toMatchObject({
      kind: "refused",
      why: {
        code: "link.other-robot",
        sentence: 'ABB IRB 120-3/0.6 was expected; the controller moves the robot "IRB 1200-5/0.9".',
      },
    });
    await other.scheduler.elapse(20);
    expect(other.links).toHaveLength(2);
    expect(await (await bench({ model: "IRB 120" })).connecting).toEqual({ kind: "done" });
    const short = await bench(
      {},
      { robot: { ...irb120, arm: { ...irb120.arm, joints: irb120.arm.joints.slice(0, 5) } } },
    );
    expect(await short.connecting).toMatchObject({
      kind: "refused",
      why: { code: "link.other-robot", sentence: `${irb120.name} has 5 axes; the robot whose controller sends has 6.` },
    });
  });

  test("T-23 joints end within 0.001° of what was commanded; 250 states a second, none missing, while resources are asked for beside", async () => {
    const guided = await bench();
    const { real, scheduler } = guided;
    await endsWhereCommanded(guided);
    expect(real.link.roundTrip_s).toBeGreaterThan(0);
    // A connection carries 400 requests; nobody notices that there are others by now.
    await scheduler.elapse(20);
    expect(real.link).toMatchObject({ state: "open", missing: 0 });
  });

  test("T-10 an emergency stop takes the motors off, a reset brings them and the program back, without anybody at the cabinet", async () => {
    const { real, virtual, carryOut, scheduler, heard } = await bench();
    const moving = real.moveJoints(AROUND);
    await scheduler.elapse(0.3);
    real.stop(true);
    await scheduler.elapse(0.01);
    expect(virtual.cabinet.state).toBe("motoroff");
    expect((await carryOut(moving)).kind).toBe("stopped");
    await scheduler.elapse(5);
    expect([heard.at(-1)!.safety, virtual.programs.isRunning]).toEqual(["emergency-stop", false]);
    expect(await real.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.emergency-stop" } });
    void real.reset();
    await scheduler.elapse(0.5);
    expect([heard.at(-1)!.safety, virtual.cabinet.state, virtual.programs.isRunning]).toEqual([
      "normal",
      "motoron",
      true,
    ]);
    expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
    // One that is pressed at the cabinet is not taken back from here.
    virtual.pendant.emergencyStop(true);
    await scheduler.elapse(0.3);
    void real.reset();
    await scheduler.elapse(0.5);
    expect(heard.at(-1)).toMatchObject({ safety: "emergency-stop", message: "Its emergency stop is pressed." });
    virtual.pendant.emergencyStop(false);
    await scheduler.elapse(0.3);
    expect(heard.at(-1)).toMatchObject({
      safety: "emergency-stop",
      message: "Its emergency stop was turned out again; the motors are off.",
    });
    void real.reset();
    await scheduler.elapse(0.5);
    expect(heard.at(-1)).toMatchObject({ safety: "normal", message: "" });
  });

  test("T-20 an error of EGM on the controller ends the motion and is told; a reset starts it again, and nothing old is followed", async () => {
    const guided = await bench();
    await errorEndsTheMotion(guided, () => {
      void guided.real.reset();
    });
  });

  test("T-24, T-25 the twin follows; T-26 in manual the pendant's jogs are mirrored, commands and resets refused", async () => {
    const guided = await bench();
    const { real, virtual, scheduler } = guided;
    await followsThePendant(guided, 0.3, 1e-6);
    void real.reset();
    await scheduler.elapse(0.5);
    expect(virtual.programs.isRunning).toBe(false);
  });

  test("T-27 a guard that is opened stops it and is told as such; closed again it stays where it is until a reset", async () => {
    const { real, virtual, carryOut, scheduler, heard } = await bench();
    const moving = real.moveJoints(AROUND);
    await scheduler.elapse(0.3);
    virtual.pendant.setGuardOpen(true);
    expect((await carryOut(moving)).kind).toBe("stopped");
    await scheduler.elapse(0.3);
    expect(heard.at(-1)).toMatchObject({ safety: "guard-stop", message: "Its guard is open." });
    const rest = virtual.neutral.jointAngles();
    virtual.pendant.setGuardOpen(false);
    await scheduler.elapse(1);
    virtual.neutral.jointAngles().forEach((q, i) => {
      expect(q).toBeCloseTo(rest[i]!, 9);
    });
    expect((await real.moveJoints(turned(0))).kind).toBe("refused");
    void real.reset();
    await scheduler.elapse(0.5);
    expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
  });

  test("while EGM is silent states come over Robot Web Services: mode, motors, guard, angles, override by the speed ratio; moves are refused with the reason", async () => {
    const { real, virtual, scheduler, heard, links } = await bench();
    virtual.frozen = true;
    await scheduler.elapse(1);
    expect([real.isConnected, heard.at(-1)!.message]).toEqual([
      true,
      "EGM is silent: no program there waits for targets.",
    ]);
    expect(await real.moveJoints(turned(0.1))).toMatchObject({ kind: "refused", why: { code: "abb.not-guided" } });
    real.setSpeed(40);
    await scheduler.elapse(0.3);
    expect([virtual.cabinet.speedRatio, heard.at(-1)!.override]).toEqual([40, 0.4]);
    virtual.pendant.setGuardOpen(true);
    await scheduler.elapse(0.3);
    expect(heard.at(-1)!.safety).toBe("guard-stop");
    virtual.pendant.setGuardOpen(false);
    virtual.pendant.emergencyStop(true);
    await scheduler.elapse(0.3);
    expect(heard.at(-1)!.safety).toBe("emergency-stop");
    virtual.pendant.emergencyStop(false);
    virtual.pendant.setMode("manual");
    void virtual.pendant.jog(turned(0.2));
    await scheduler.elapse(0.5);
    expect(heard.at(-1)).toMatchObject({ mode: "manual", safety: "normal", moving: true });
    await scheduler.elapse(2);
    expect(real.jointAngle(2)).toBeCloseTo(turned(0.2)[1]!, 6);
    virtual.frozen = false;
    virtual.pendant.setMode("automatic");
    await scheduler.elapse(0.5);
    expect([heard.at(-1)!.safety, links, real.link.missing]).toEqual([
      "normal",
      [expect.stringMatching(/^connecting: /) as string, "open"],
      0,
    ]);
    for (let i = 1; i < heard.length; i++) expect(heard[i]!.time_s).toBeGreaterThan(heard[i - 1]!.time_s);
  });

  test("signals are read and written by their names; what the controller has not is refused, what it refuses is told", async () => {
    const { real, virtual, carryOut, scheduler, heard } = await bench();
    virtual.pendant.setInput("DI3", true);
    real.signals!.write("DO2", true);
    real.signals!.write("AO1", 2.5);
    await scheduler.elapse(0.5);
    expect([virtual.neutral.signals.read("DO2"), virtual.neutral.signals.read("AO1")]).toEqual([true, 2.5]);
    expect([real.signals!.read("DI3"), real.signals!.read("DO2"), real.signals!.read("AO1")]).toEqual([
      true,
      true,
      2.5,
    ]);
    expect(await real.run([{ id: "s", type: "set", signal: "lamp", to: true }], NOTHING)).toMatchObject({
      kind: "refused",
      why: {
        code: "abb.no-such-signal",
        sentence:
          '“s” cannot be carried out over this connection: The controller has no signal "lamp". Nothing has moved.',
      },
    });
    real.signals!.write("DI1", true);
    await scheduler.elapse(0.2);
    expect(heard.at(-1)!.message).toBe('Writing "DI1": The signal DI1 is an input (-1073445859).');
    const steps: Step[] = [
      { id: "g", type: "gripper", closed: true },
      { id: "w", type: "wait-for", when: { signal: "DI3", is: false }, timeout_s: 2 },
    ];
    const running = real.run(steps, NOTHING);
    await scheduler.elapse(0.5);
    expect([virtual.neutral.signals.read("doGripper"), heard.at(-1)!.gripperClosed]).toEqual([true, true]);
    virtual.pendant.setInput("DI3", false);
    expect(await carryOut(running)).toEqual({ kind: "done" });
  });

  test("lines and arcs go over EGM as before, and the speed changes on the way", async () => {
    await keepsToTheLine(await bench());
  });
});

describe("program texts", () => {
  const there = turned(0.2)
    .map(q => ((q * 180) / Math.PI).toFixed(6))
    .join(",");

  test("are put on the controller, run to their end over its own interpreter, and give way to the program that waits for targets", async () => {
    const { real, virtual, carryOut, scheduler, heard } = await bench();
    heard.length = 0;
    expect(await carryOut(real.runText!(module("SetDO DO5,1;", `MoveAbsJ ${there};`)))).toEqual({ kind: "done" });
    expect(virtual.neutral.jointAngle(1)).toBeCloseTo(turned(0.2)[0]!, 6);
    expect(virtual.neutral.signals.read("DO5")).toBe(true);
    expect([virtual.programs.names, virtual.programs.isRunning]).toEqual([["TwincellEGM"], true]);
    expect(spread(heard, sample => String(sample.moving))).toEqual(["true", "false"]);
    expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
    await scheduler.elapse(0.5);
    expect(real.signals!.read("DO5")).toBe(true);
  });

  test("over a late line the program that waits for targets begins where the robot stands: no old answer calls it back", async () => {
    const { real, virtual, carryOut, scheduler, network } = await bench();
    network.weather.delay_s = 0.02;
    await scheduler.elapse(0.5);
    expect(await carryOut(real.runText!(module(`MoveAbsJ ${there};`)))).toEqual({ kind: "done" });
    let farthest_rad = 0;
    for (let t_s = 0; t_s < 1; t_s += 0.002) {
      await scheduler.elapse(0.002);
      farthest_rad = Math.max(farthest_rad, Math.abs(virtual.neutral.jointAngle(1) - turned(0.2)[0]!));
    }
    expect(farthest_rad).toBeLessThan(1e-6);
  });

  test("a stop ends it on its way; an emergency takes the motors off too; override 0 holds it by the speed ratio", async () => {
    const { real, virtual, carryOut, scheduler, heard } = await bench();
    const far = AROUND.map(q => (q * 180) / Math.PI).join(",");
    for (const emergency of [false, true]) {
      const running = real.runText!(module(`MoveAbsJ ${far};`));
      await scheduler.elapse(0.3);
      expect(real.isMoving()).toBe(true);
      real.setSpeed(0);
      await scheduler.elapse(0.6);
      expect([real.isMoving(), heard.at(-1)!.override]).toEqual([false, 0]);
      real.setSpeed(20);
      await scheduler.elapse(0.3);
      expect(real.isMoving()).toBe(true);
      real.stop(emergency);
      expect(await carryOut(running)).toMatchObject({ kind: "stopped" });
      await scheduler.elapse(1);
      expect([virtual.cabinet.motorsOn, heard.at(-1)!.safety, real.isMoving()]).toEqual([
        !emergency,
        emergency ? "emergency-stop" : "normal",
        false,
      ]);
      real.setSpeed(100);
      if (emergency) {
        void real.reset();
        await scheduler.elapse(1);
      }
      expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
    }
  });

  test("what is no module, is not understood, faults on its way, or is not for now: refused or stopped with the controller's own words", async () => {
    const { real, virtual, carryOut, scheduler } = await bench();
    expect(await carryOut(real.runText!([{ name: "a.txt", text: "", lines: [] }]))).toMatchObject({
      kind: "refused",
      why: { code: "abb.no-module" },
    });
    expect(await carryOut(real.runText!([{ name: "a.mod", text: "nothing", lines: [] }]))).toMatchObject({
      kind: "refused",
      why: { sentence: "Loading a.mod: The file holds no module (-1073445859)." },
    });
    expect(await carryOut(real.runText!(module("nonsense;")))).toMatchObject({
      kind: "refused",
      why: { sentence: "Setting the program pointer to PROC main: job, line 3: This is no instruction (-1073445859)." },
    });
    expect(await carryOut(real.runText!(module(`MoveAbsJ ${there};`, "FAULT;")))).toMatchObject({
      kind: "stopped",
      why: {
        sentence: "The program stopped: Program stopped: The program ended with a fault of its own: division by zero",
      },
    });
    const stopped = real.runText!(module(`MoveAbsJ ${AROUND.map(q => (q * 180) / Math.PI).join(",")};`));
    await scheduler.elapse(0.6);
    virtual.pendant.setGuardOpen(true);
    expect((await carryOut(stopped)).kind).toBe("stopped");
    virtual.pendant.setGuardOpen(false);
    void real.reset();
    await scheduler.elapse(1);
    expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
    expect(virtual.programs.names).toEqual(["TwincellEGM"]);
  });
});

describe("what is handed over in two", () => {
  const far = AROUND.map(q => (q * 180) / Math.PI).join(",");

  test("lies there until it is started; dropped, or stopped in between, the program that waits for targets has its place again", async () => {
    const { real, virtual, carryOut, scheduler } = await bench();
    const rest = virtual.neutral.jointAngles();
    const handing = async () => {
      const asked = real.handText!(module(`MoveAbsJ ${far};`));
      await scheduler.elapse(0.5);
      const handed = await asked;
      if (handed.kind === "refused") throw new Error(handed.why.sentence);
      return handed;
    };
    const dropped = await handing();
    expect([virtual.programs.names, virtual.programs.isRunning, real.isConnected]).toEqual([["job"], false, true]);
    dropped.drop();
    await scheduler.elapse(0.5);
    expect([virtual.programs.names, virtual.programs.isRunning]).toEqual([["TwincellEGM"], true]);
    const stopped = await handing();
    real.stop();
    expect((await carryOut(stopped.start())).kind).toBe("stopped");
    virtual.neutral.jointAngles().forEach((q, i) => {
      expect(q).toBeCloseTo(rest[i]!, 6);
    });
    expect(await carryOut((await handing()).start())).toEqual({ kind: "done" });
    expect(virtual.neutral.jointAngle(1)).toBeCloseTo(2.4, 6);
  });

  test("a text that is left there by a broken line is never started by a reset, nor by turning the key: it is taken away first", async () => {
    const { real, virtual, carryOut, scheduler } = await bench();
    const running = real.runText!(module(`MoveAbsJ ${far};`));
    await scheduler.elapse(0.3);
    virtual.setRefusing(true);
    expect((await carryOut(running)).kind).toBe("stopped");
    await scheduler.elapse(2);
    virtual.pendant.setMode("manual");
    virtual.setRefusing(false);
    await scheduler.elapse(8);
    expect([real.isConnected, virtual.programs.names]).toEqual([true, ["job"]]);
    const rest = virtual.neutral.jointAngles();
    virtual.pendant.setMode("remote");
    await scheduler.elapse(1);
    expect(virtual.programs.isRunning).toBe(false);
    void real.reset();
    await scheduler.elapse(1);
    expect([virtual.programs.names, virtual.programs.isRunning]).toEqual([["TwincellEGM"], true]);
    virtual.neutral.jointAngles().forEach((q, i) => {
      expect(q).toBeCloseTo(rest[i]!, 6);
    });
    expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
  });

  test("watch only: states over Robot Web Services, nothing heard of EGM, nothing written", async () => {
    const { real, virtual, scheduler, heard, network } = await bench({}, { isWatched: () => true });
    await scheduler.elapse(1);
    expect([real.isConnected, heard.at(-1)!.safety, virtual.programs.names, virtual.programs.isRunning]).toEqual([
      true,
      "normal",
      ["TwincellEGM"],
      true,
    ]);
    // Whoever guides it has the port.
    expect((await network.bind({ host: HOST, port: 6510 })).kind).toBe("bound");
  });
});

describe("X-41 when a line is lost", () => {
  test("T-46, T-47 everything cut: noticed within 100 ms, the robot stops by itself within its time-out and braking time, and stays", async () => {
    await stopsWhenCutOff(await bench());
  });

  test("EGM alone: the program is stopped over Robot Web Services within 100 ms, the link is lost, both are said", async () => {
    const { real, virtual, carryOut, scheduler, links } = await bench();
    const moving = real.moveJoints(AROUND);
    await scheduler.elapse(0.3);
    virtual.frozen = true;
    const from_s = scheduler.now_s();
    while (virtual.programs.isRunning && scheduler.now_s() - from_s < 1) await scheduler.elapse(0.002);
    expect(scheduler.now_s() - from_s).toBeLessThanOrEqual(0.1);
    expect(await carryOut(moving)).toMatchObject({ kind: "stopped", why: { code: "link.lost" } });
    expect(links[2]).toMatch(
      /^lost: No EGM message came from ABB IRB 120-3\/0\.6 for \d+ ms\. Its program was stopped\.$/,
    );
    await scheduler.elapse(virtual.brakingTime_s);
    const rest = virtual.neutral.jointAngles();
    virtual.frozen = false;
    await scheduler.elapse(2);
    expect([real.isConnected, virtual.neutral.jointAngles()]).toEqual([true, rest]);
    void real.reset();
    await scheduler.elapse(0.5);
    expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
  });

  test("Robot Web Services alone: the robot brakes on its path, then the link is lost and said", async () => {
    const { real, virtual, carryOut, scheduler, links } = await bench();
    const moving = real.moveJoints(AROUND);
    await scheduler.elapse(0.3);
    virtual.setRefusing(true);
    expect(await carryOut(moving)).toMatchObject({
      kind: "stopped",
      why: {
        code: "link.lost",
        sentence: expect.stringMatching(
          /^Robot Web Services of ABB IRB 120-3\/0\.6 are gone: .* The robot was stopped\.$/,
        ) as string,
      },
    });
    const rest = virtual.neutral.jointAngles();
    expect([real.isConnected, links[2]]).toEqual([false, expect.stringMatching(/^lost: Robot Web Services/)]);
    await scheduler.elapse(1);
    expect([...virtual.neutral.jointAngles()].every((q, i) => Math.abs(q - rest[i]!) < 1e-4)).toBe(true);
    virtual.setRefusing(false);
    await scheduler.elapse(8);
    expect(real.isConnected).toBe(true);
    void real.reset();
    await scheduler.elapse(0.5);
    expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
  });

  test("a connection that ends between two requests is nothing: another one is opened", async () => {
    const { real, network, carryOut, scheduler, links } = await bench();
    await scheduler.elapse(0.0101);
    const moving = real.moveJoints(AROUND);
    await scheduler.elapse(0.3);
    network.cut();
    expect((await carryOut(moving)).kind).not.toBe("refused");
    await scheduler.elapse(3);
    expect([real.isConnected, links.length <= 5]).toEqual([true, true]);
  });

  test("a controller that is switched off and on is there again by itself; the motion is not", async () => {
    const { real, virtual, carryOut, scheduler } = await bench();
    const moving = real.moveJoints(AROUND);
    await scheduler.elapse(0.3);
    virtual.reboot(1);
    expect((await carryOut(moving)).kind).toBe("stopped");
    await scheduler.elapse(8);
    expect(real.isConnected).toBe(true);
    void real.reset();
    await scheduler.elapse(0.5);
    expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
  });
});
