import { flangePose, robotById, seededRandom, type CommandOutcome, type Step, type Target } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { silenceHoldsNothingUp, twinAgrees } from "../../testing/index.ts";
import { createTwin } from "../../twin/index.ts";
import { bench, HOST, robot, shifted } from "../testing/bench.ts";

const ACCURACY_RAD = (0.001 * Math.PI) / 180;
const far = shifted(0.7);
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));
const codeOf = (outcome: CommandOutcome): string => (outcome.kind === "done" ? "done" : outcome.why.code);
const NOTHING = { tools: {}, frames: {} };

/** A client of lines: what comes back, parsed. */
async function lines({ scheduler, network }: Awaited<ReturnType<typeof bench>>, port: number) {
  const connected = network.connect({ host: HOST, port });
  await scheduler.elapse(0.01);
  const answer = await connected;
  if (answer.kind === "refused") throw new Error(answer.sentence);
  let text = "";
  let over = false;
  answer.stream.onBytes(lent => {
    text += String.fromCharCode(...lent);
  });
  answer.stream.onEnd(() => {
    over = true;
  });
  return {
    over: () => over,
    close: () => {
      answer.stream.close();
    },
    async ask(line: string): Promise<Record<string, unknown>[]> {
      text = "";
      answer.stream.send(Uint8Array.from(line, sign => sign.charCodeAt(0)));
      await scheduler.elapse(0.02);
      return text
        .split("\r\n")
        .filter(each => each !== "")
        .map(each => JSON.parse(each) as Record<string, unknown>);
    },
  };
}

describe("the controller", () => {
  test("one client is let in: asked for at one port, served at another; the second is told so", async () => {
    const made = await bench();
    const route = await lines(made, 16_001);
    expect(await route.ask('{"Communication":"FRC_Connect"}\r\n')).toEqual([
      { Communication: "FRC_Connect", ErrorID: 2556954, PortNumber: 0, MajorVersion: 5, MinorVersion: 0 },
    ]);
    made.real.disconnect();
    await made.scheduler.elapse(0.1);
    expect(await route.ask('{"Communication":"FRC_Connect"}\r\n')).toMatchObject([{ ErrorID: 0, PortNumber: 16_002 }]);
    const session = await lines(made, 16_002);
    expect(await session.ask('{"Instruction":"FRC_WaitTime","SequenceID":1,"Time":0.1}\r\n')).toEqual([
      { Instruction: "FRC_WaitTime", ErrorID: 2556937, SequenceID: 1 },
    ]);
    expect(await session.ask('{"Command":"FRC_Initialize","GroupMask":1}\r\n')).toMatchObject([
      { Command: "FRC_Initialize", ErrorID: 0 },
    ]);
    expect(await session.ask('{"Instruction":"FRC_WaitTime","SequenceID":2,"Time":0.1}\r\n')).toMatchObject([
      { ErrorID: 2556957, SequenceID: 2 },
    ]);
    expect(await session.ask('{"Command":"FRC_Continue"}\r\n{"Command":"FRC_Fly"}\r\n')).toMatchObject([
      { ErrorID: 2556938 },
      { ErrorID: 2556941 },
    ]);
    expect(await session.ask('{"Command":"FRC_ReadJointAngles","Group":1}\r\n')).toMatchObject([
      { JointAngle: { J1: 0, J2: 0, J3: 0, J5: -90 } },
    ]);
    // Counted from axis 2: 50 + 335 mm ahead, 330 + 35 − 80 mm up.
    expect(await session.ask('{"Command":"FRC_ReadCartesianPosition"}\r\n')).toMatchObject([
      { Position: { X: 385, Y: 0, Z: 285 } },
    ]);
    expect(session.over()).toBe(false);
  });

  test("a position says its posture and turns, and a motion to it arrives in those; what the arm cannot take is refused", async () => {
    const start_rad = [0.2, 0.3, -0.2, 3.3, -0.9, -4];
    const made = await bench({ virtual: { start_rad } });
    made.real.disconnect();
    await made.scheduler.elapse(0.1);
    const route = await lines(made, 16_001);
    await route.ask('{"Communication":"FRC_Connect"}\r\n');
    const session = await lines(made, 16_002);
    await session.ask('{"Command":"FRC_Initialize","GroupMask":1}\r\n');
    type Said = { readonly Configuration: Record<string, number>; readonly Position: Record<string, number> };
    const read = async (): Promise<Said> => {
      const [said] = await session.ask('{"Command":"FRC_ReadCartesianPosition","Group":1}\r\n');
      const { Configuration, Position } = said as unknown as Said;
      return { Configuration, Position };
    };
    const here = await read();
    expect(here.Configuration).toEqual({
      UToolNumber: 1,
      UFrameNumber: 0,
      Front: 1,
      Up: 1,
      Left: 0,
      Flip: 0,
      Turn4: 1,
      Turn5: 0,
      Turn6: -1,
    });
    let sequence = 0;
    const go = async (name: string, Configuration: Record<string, number>): Promise<unknown> => {
      const packet = {
        Instruction: name,
        SequenceID: ++sequence,
        Configuration,
        Position: here.Position,
        SpeedType: "Percent",
        Speed: 50,
        TermType: "FINE",
        TermValue: 0,
      };
      let [answer] = await session.ask(`${JSON.stringify(packet)}\r\n`);
      for (let i = 0; i < 500 && answer === undefined; i++) [answer] = await session.ask("");
      return answer?.["ErrorID"];
    };
    // The same pose with the wrist flipped and no axis turned over, and back again.
    const other = { ...here.Configuration, Flip: 1, Turn4: 0, Turn6: 0 };
    expect(await go("FRC_JointMotion", other)).toBe(0);
    const moved = await read();
    expect(moved.Configuration).toEqual(other);
    for (const [axis, value] of Object.entries(here.Position)) expect(moved.Position[axis]).toBeCloseTo(value, 2);
    expect(await go("FRC_JointMotion", here.Configuration)).toBe(0);
    expect((await read()).Configuration).toEqual(here.Configuration);
    expect(await go("FRC_JointMotion", { ...here.Configuration, Turn4: 2 })).toBe(2_556_951);
    expect(await go("FRC_JointMotion", { ...here.Configuration, Flip: 7 })).toBe(2_556_951);
  });

  test("the pendant shows joint 3 against the horizon", async () => {
    const made = await bench({ virtual: { start_rad: [0, 0.5, 0.2, 0, 0, 0] } });
    expect(farthest(made.real.jointAngles(), [0, 0.5, 0.2, 0, 0, 0])).toBeLessThan(1e-6);
    made.real.disconnect();
    await made.scheduler.elapse(0.1);
    const route = await lines(made, 16_001);
    await route.ask('{"Communication":"FRC_Connect"}\r\n');
    const session = await lines(made, 16_002);
    const [said] = await session.ask('{"Command":"FRC_ReadJointAngles"}\r\n');
    expect((said as { JointAngle: { J3: number } }).JointAngle.J3).toBeCloseTo((-0.3 * 180) / Math.PI, 4);
  });

  test("any bytes: logged once for each connection, cut off, and the next one is served (200 connections)", async () => {
    const made = await bench();
    const random = seededRandom(2);
    made.real.disconnect();
    for (let i = 0; i < 200; i++) {
      const before = made.log.length;
      const client = await lines(made, 16_001);
      for (let k = 0; k < 3 && !client.over(); k++)
        await client.ask(
          Array.from({ length: 30 }, () => String.fromCharCode(Math.floor(random() * 256))).join("") +
            (k === 1 ? "\n" : ""),
        );
      expect(made.log.length - before).toBeLessThanOrEqual(1);
      client.close();
    }
    expect(made.log.length).toBeGreaterThan(100);
    const route = await lines(made, 16_001);
    expect(await route.ask('{"Communication":"FRC_Connect"}\r\n')).toMatchObject([{ ErrorID: 0 }]);
  });
});

describe("the driver", () => {
  test("T-19 FANUC: connected only while it is; a cut line is found again, and nothing moves by itself", async () => {
    const { scheduler, network, real, fanuc, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    network.cut();
    expect((await ended(moving)).kind).toBe("stopped");
    await scheduler.elapse(4);
    expect(real.isConnected).toBe(true);
    // What was sent is carried out to its end: the interface has no watchdog, and says so.
    expect([real.watchdog.kind, farthest(fanuc.arm.jointAngles(), far) < 1e-9]).toEqual(["none", true]);
    const rest = real.jointAngles();
    await scheduler.elapse(2);
    expect(real.jointAngles()).toEqual(rest);
    expect(await ended(real.moveJoints(shifted(0.1)))).toEqual({ kind: "done" });
    real.disconnect();
    expect(real.isConnected).toBe(false);
  });

  test("half open: the place that nobody speaks from any more is given to who asks", async () => {
    const { scheduler, network, real, ended } = await bench();
    network.cut(true);
    await scheduler.elapse(20);
    expect(real.isConnected).toBe(true);
    void real.reset();
    await scheduler.elapse(0.1);
    expect(await ended(real.moveJoints(shifted(0.1)))).toEqual({ kind: "done" });
  });

  test("T-23 T-24 T-25 FANUC: commanded, measured and mirrored angles agree to 0.001°; the robot is commanded first", async () => {
    const open = await bench();
    await twinAgrees({ ...open, arm: open.fanuc.arm }, shifted);
  });

  test("T-20 T-27 FANUC: the fence takes the servos off; the fault arrives in the controller's words; a reset is a person's", async () => {
    const { scheduler, fanuc, real, ended } = await bench();
    const moving = real.moveJoints(far);
    await scheduler.elapse(0.2);
    fanuc.pendant.setGuardOpen(true);
    expect(await ended(moving)).toMatchObject({ kind: "stopped" });
    await scheduler.elapse(0.5);
    let heard = "";
    real.onSample(({ safety, message }) => {
      heard = `${safety}: ${message}`;
    });
    await scheduler.elapse(0.05);
    expect(heard).toBe("protective-stop: SRVO-004 Fence open");
    expect(farthest(real.jointAngles(), fanuc.arm.jointAngles())).toBeLessThanOrEqual(ACCURACY_RAD);
    void real.reset();
    await scheduler.elapse(0.1);
    expect(codeOf(await real.moveToZero())).toBe("safety.protective-stop");
    fanuc.pendant.setGuardOpen(false);
    void real.reset();
    await scheduler.elapse(0.1);
    expect(await ended(real.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("T-26 FANUC: with the pendant enabled the twin follows and commands from here are refused", async () => {
    const { scheduler, fanuc, real, ended } = await bench();
    const twin = createTwin({ real, scheduler });
    fanuc.pendant.setKey("T1");
    await scheduler.elapse(0.1);
    expect(codeOf(await twin.moveToZero())).toBe("controller.manual-mode");
    expect(await ended(fanuc.pendant.jog(shifted(0.2)))).toEqual({ kind: "done" });
    await scheduler.elapse(0.05);
    expect(farthest(twin.jointAngles(), shifted(0.2))).toBeLessThanOrEqual(ACCURACY_RAD);
    fanuc.pendant.setKey("AUTO");
    await scheduler.elapse(0.1);
    expect(await ended(twin.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("T-46 T-47 FANUC: a controller that does not answer holds nothing up here, and the stop still goes out", async () => {
    const open = await bench();
    await silenceHoldsNothingUp({ ...open, ...open.fanuc }, far, 0.2);
  });

  test("a clock that stands still is stale; a reboot is survived, and its fault waits for a person", async () => {
    const { scheduler, fanuc, real, ended } = await bench();
    fanuc.faults.frozen = true;
    await scheduler.elapse(0.3);
    expect(real.isConnected).toBe(false);
    fanuc.faults.frozen = false;
    await scheduler.elapse(5);
    expect(real.isConnected).toBe(true);
    fanuc.reboot();
    await scheduler.elapse(5);
    expect([real.isConnected, codeOf(await real.moveToZero())]).toEqual([true, "safety.protective-stop"]);
    void real.reset();
    await scheduler.elapse(0.1);
    expect(await ended(real.moveJoints(far))).toEqual({ kind: "done" });
  });

  test("lines end where they should; arcs, other joint counts and unknown joints are refused by name; outputs and inputs by their numbers", async () => {
    const { scheduler, fanuc, real, ended } = await bench({ face: { signals: ["DI[3]"], gripperOutput: 2 } });
    const from = flangePose(robot.arm, robot.home_rad);
    const [x, y, z] = from.position;
    const at = (dy: number, dz: number): Target => ({
      pose: { position: [x, y + dy, z + dz], quaternion: from.quaternion },
      frame: "world",
      tool: "flange",
    });
    const line: Step = { id: "line", type: "move", path: "lin", target: at(0.1, 0), speed: { mps: 0.2 }, blend_m: 0 };
    expect(await ended(real.run([line], NOTHING))).toEqual({ kind: "done" });
    expect(flangePose(robot.arm, real.jointAngles()).position[1]).toBeCloseTo(y + 0.1, 5);
    const arc: Step = { ...line, id: "arc", path: "circ", via: at(0.05, 0.05), target: at(0, 0) };
    expect(await real.run([arc], NOTHING)).toMatchObject({ kind: "refused", why: { code: "fanuc.arc" } });
    const run = real.run(
      [
        { id: "a", type: "set", signal: "DO[7]", to: true },
        { id: "b", type: "gripper", closed: true },
        { id: "c", type: "wait-for", when: { signal: "DI[3]", is: true } },
      ],
      NOTHING,
    );
    await scheduler.elapse(1);
    expect([fanuc.arm.signals.read("DO[7]"), fanuc.arm.signals.read("DO[2]")]).toEqual([true, true]);
    fanuc.pendant.setInput(3, true);
    expect(await ended(run)).toEqual({ kind: "done" });
    const seven = await bench({ face: { robot: robotById("kuka_lbr_iiwa_14_r820")! } });
    expect(seven.real.link.sentence).toContain("has 7 joints");
    const strange = await bench({ face: { robot: robotById("staubli_rx90l")! } });
    expect(strange.real.link.sentence).toContain("shows the joints of");
  });

  test("T-17 FANUC: the greatest speed of the robot scales how long it moves, measured at the robot", async () => {
    const lasting = async (maxSpeed: number): Promise<number> => {
      const { fanuc, real, ended } = await bench({ virtual: { maxSpeed } });
      let cycles = 0;
      fanuc.arm.onSample(({ moving }) => {
        if (moving) cycles++;
      });
      await ended(real.moveJoints(far));
      return 0.004 * cycles;
    };
    expect(Math.abs((await lasting(0.25)) - 4 * (await lasting(1)))).toBeLessThan(0.0125);
  });
});
