/** The virtual controller, met as its clients meet it: with bytes and lines written out by hand. */
import { seededRandom } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { lineBytes } from "../codec/lines.ts";
import { primaryPackages, readMessage, type PrimaryMessage } from "../codec/primary.ts";
import { robot, urBench, type UrBench } from "../testing/bench.ts";
import { ROBOT_MODE, RUNTIME, SAFETY_MODE, UR_PORTS } from "../index.ts";

const hex = (text: string): Uint8Array => Uint8Array.from(text.trim().split(/\s+/), byte => Number.parseInt(byte, 16));
const letters = (text: string): string =>
  [...text].map(letter => letter.charCodeAt(0).toString(16).padStart(2, "0")).join(" ");
const frame = (kind: string, payload: string): Uint8Array => {
  const bytes = hex(`00 00 ${kind} ${payload}`);
  bytes[1] = bytes.length;
  return bytes;
};
const HZ_500 = "40 7f 40 00 00 00 00 00";
const HZ_125 = "40 5f 40 00 00 00 00 00";

/** A client that has set up `timestamp,actual_q` and started, and the times its packages tell. */
async function receiving(bench: UrBench, frequency = HZ_500) {
  const { stream, got } = await bench.connect("rtde");
  for (const bytes of [
    hex("00 05 56 00 02"),
    frame("4f", `${frequency} ${letters("timestamp,actual_q,")}`),
    hex("00 03 53"),
  ])
    stream.send(bytes);
  await bench.scheduler.elapse(0.003);
  const times_s = (): number[] => {
    const bytes = Uint8Array.from(got);
    const view = new DataView(bytes.buffer);
    const all: number[] = [];
    for (let at = 0; at + 3 <= bytes.length; at += view.getUint16(at))
      if (bytes[at + 2] === 0x55 && at + view.getUint16(at) <= bytes.length) all.push(view.getFloat64(at + 4));
    return all;
  };
  return { stream, got, times_s };
}
/** A client of the primary interface, and the messages it got. */
async function listening(bench: UrBench) {
  const { stream, got } = await bench.connect("primary");
  const messages = (): PrimaryMessage[] => {
    const all: PrimaryMessage[] = [];
    primaryPackages().push(Uint8Array.from(got), (type, body) => {
      const said = type === 20 ? readMessage(body) : null;
      if (said) all.push(said);
    });
    return all;
  };
  return {
    stream,
    messages,
    send: (text: string) => {
      stream.send(lineBytes(text));
    },
  };
}

describe("RTDE of the virtual controller", () => {
  test("a session as it is described: protocol, version, outputs, start, packages, pause", async () => {
    const bench = await urBench();
    const { stream, got } = await bench.connect("rtde");
    const answer = async (bytes: Uint8Array): Promise<number[]> => {
      got.length = 0;
      stream.send(bytes);
      await bench.scheduler.elapse(0.002);
      return [...got];
    };
    expect(await answer(hex("00 05 56 00 02"))).toEqual([...hex("00 04 56 01")]);
    expect(await answer(hex("00 05 56 00 03"))).toEqual([...hex("00 04 56 00")]);
    expect((await answer(hex("00 03 76"))).slice(0, 11)).toEqual([...hex("00 13 76 00 00 00 05 00 00 00 0c")]);
    expect(await answer(frame("53", ""))).toEqual([...hex("00 04 53 00")]);
    expect(await answer(frame("4f", `${HZ_500} ${letters("timestamp,robot_mode,nonsense")}`))).toEqual([
      ...frame("4f", `00 ${letters("DOUBLE,INT32,NOT_FOUND")}`),
    ]);
    expect(await answer(frame("4f", `${HZ_500} ${letters("timestamp,robot_mode")}`))).toEqual([
      ...frame("4f", `01 ${letters("DOUBLE,INT32")}`),
    ]);
    expect((await answer(hex("00 03 53"))).slice(0, 4)).toEqual([...hex("00 04 53 01")]);
    await bench.scheduler.elapse(0.01);
    // size 16, kind 55, recipe 1, eight bytes of time, mode 7
    expect([...got.slice(-16, -12), ...got.slice(-4)]).toEqual([0x00, 0x10, 0x55, 0x01, 0, 0, 0, 7]);
    stream.send(hex("00 03 50"));
    await bench.scheduler.elapse(0.003);
    expect(got.slice(-4)).toEqual([...hex("00 04 50 01")]);
    got.length = 0;
    await bench.scheduler.elapse(0.1);
    expect(got).toEqual([]);
  });

  test("500 packages a second, each 2 ms after the one before by the controller's clock, which stands above 40 s; 125 when asked", async () => {
    for (const [frequency, rate] of [
      [HZ_500, 500],
      [HZ_125, 125],
    ] as const) {
      const bench = await urBench();
      const { times_s } = await receiving(bench, frequency);
      const before = times_s().length;
      await bench.scheduler.elapse(2);
      const times = times_s();
      expect(times.length - before).toBe(2 * rate);
      expect(times[0]).toBeGreaterThan(40);
      for (let i = 1; i < times.length; i++) expect(Math.abs(times[i]! - times[i - 1]! - 1 / rate)).toBeLessThan(1e-6);
    }
  });

  test("protocol 1: no frequency, no id, the highest rate", async () => {
    const bench = await urBench();
    const { stream, got } = await bench.connect("rtde");
    stream.send(frame("4f", letters("timestamp")));
    await bench.scheduler.elapse(0.002);
    expect(got).toEqual([...frame("4f", letters("DOUBLE"))]);
    stream.send(hex("00 03 53"));
    await bench.scheduler.elapse(0.02);
    expect(got.slice(-11, -8)).toEqual([0x00, 0x0b, 0x55]);
  });

  test("an input belongs to who took it until that connection ends", async () => {
    const bench = await urBench();
    const one = await bench.connect("rtde");
    const two = await bench.connect("rtde");
    const ask = frame("49", letters("input_int_register_0,speed_slider_mask"));
    one.stream.send(ask);
    await bench.scheduler.elapse(0.002);
    expect(one.got).toEqual([...frame("49", `01 ${letters("INT32,UINT32")}`)]);
    two.stream.send(ask);
    await bench.scheduler.elapse(0.002);
    expect(two.got).toEqual([...frame("49", `00 ${letters("IN_USE,IN_USE")}`)]);
    one.stream.close();
    await bench.scheduler.elapse(0.002);
    two.got.length = 0;
    two.stream.send(ask);
    await bench.scheduler.elapse(0.002);
    expect(two.got).toEqual([...frame("49", `01 ${letters("INT32,UINT32")}`)]);
  });

  test("inputs have their effects: outputs by mask, the speed slider; in local control neither", async () => {
    const bench = await urBench();
    const { stream } = await bench.connect("rtde");
    for (const names of [
      "standard_digital_output_mask,standard_digital_output",
      "speed_slider_mask,speed_slider_fraction",
    ])
      stream.send(frame("49", letters(names)));
    stream.send(hex("00 06 55 01 0a 08"));
    stream.send(hex("00 10 55 02 00 00 00 01 3f e0 00 00 00 00 00 00"));
    await bench.scheduler.elapse(0.01);
    expect([1, 3].map(bit => bench.ur.digitalOut(bit))).toEqual([false, true]);
    expect(bench.ur.state.speedFraction).toBe(0.5);
    bench.ur.pendant.setMode("manual");
    stream.send(hex("00 06 55 01 08 00"));
    stream.send(hex("00 10 55 02 00 00 00 01 3f f0 00 00 00 00 00 00"));
    await bench.scheduler.elapse(0.01);
    expect([bench.ur.digitalOut(3), bench.ur.state.speedFraction]).toEqual([true, 0.5]);
  });
});

describe("the dashboard of the virtual controller", () => {
  test("the banner, and one line for each question", async () => {
    const bench = await urBench();
    const { got } = await bench.connect("dashboard");
    const ask = await bench.dashboard();
    expect(String.fromCharCode(...got)).toBe("Connected: Universal Robots Dashboard Server\n");
    for (const [question, answer] of [
      ["robotmode", "Robotmode: RUNNING"],
      ["SafetyMode", "Safetymode: NORMAL"],
      ["running", "Program running: false"],
      ["programState", "STOPPED"],
      ["get loaded program", "No program loaded"],
      ["get robot model", "UR10"],
      ["is in remote control", "true"],
      ["PolyscopeVersion", "URSoftware 5.12.0.1101319 (Mar 22 2022)"],
      ["get operational mode", "NONE"],
      ["play", "Failed to execute: play"],
      ["load nothing.urp", "File not found: nothing.urp"],
      ["dance", 'could not understand: "dance"'],
      ["close popup", "closing popup"],
    ] as const)
      expect(await ask(question)).toBe(answer);
    expect(await ask("get serial number")).toMatch(/^20\d+$/);
  });

  test("off, power on, IDLE, brakes, RUNNING; set robotmode run does both", async () => {
    const bench = await urBench({ begins: "powered-off" });
    const ask = await bench.dashboard();
    const mode = (): number => bench.ur.state.robotMode;
    expect(await ask("brake release")).toBe("Brake releasing");
    bench.ur.pendant.switchOff();
    expect(mode()).toBe(ROBOT_MODE.POWER_OFF);
    expect(await ask("power on")).toBe("Powering on");
    expect(mode()).toBe(ROBOT_MODE.POWER_ON);
    await bench.scheduler.elapse(0.6);
    expect(mode()).toBe(ROBOT_MODE.IDLE);
    expect(await ask("brake release")).toBe("Brake releasing");
    await bench.scheduler.elapse(0.6);
    expect(mode()).toBe(ROBOT_MODE.RUNNING);
    expect(await ask("power off")).toBe("Powering off");
    const { send } = await listening(bench);
    send("set robotmode run");
    await bench.scheduler.elapse(1.1);
    expect(mode()).toBe(ROBOT_MODE.RUNNING);
  });

  test("a protective stop is not unlocked before five seconds have passed", async () => {
    const bench = await urBench();
    const ask = await bench.dashboard();
    const { messages } = await listening(bench);
    bench.ur.pendant.protectiveStop("Joint 2 met a resistance.");
    await bench.scheduler.elapse(4.9);
    expect(await ask("safetymode")).toBe("Safetymode: PROTECTIVE_STOP");
    expect(await ask("unlock protective stop")).toMatch(/^Cannot unlock protective stop until 5s after occurrence/);
    expect(bench.ur.state.robotMode).toBe(ROBOT_MODE.RUNNING);
    await bench.scheduler.elapse(0.1);
    expect(await ask("unlock protective stop")).toBe("Protective stop releasing");
    expect(await ask("safetymode")).toBe("Safetymode: NORMAL");
    expect(
      messages()
        .filter(said => said.kind === "safety-mode")
        .map(said => said.kind === "safety-mode" && said.mode),
    ).toEqual([1, 3, 1]);
  });

  test("an emergency stop takes the power and keeps it off while pressed; a fault wants the safety restarted", async () => {
    const bench = await urBench();
    const ask = await bench.dashboard();
    bench.ur.pendant.emergencyStop(true);
    expect([bench.ur.state.robotMode, bench.ur.state.safetyMode]).toEqual([
      ROBOT_MODE.POWER_OFF,
      SAFETY_MODE.ROBOT_EMERGENCY_STOP,
    ]);
    expect(await ask("power on")).toBe("Failed to execute: power on");
    bench.ur.pendant.emergencyStop(false);
    expect([bench.ur.state.robotMode, bench.ur.state.safetyMode]).toEqual([ROBOT_MODE.POWER_OFF, SAFETY_MODE.NORMAL]);
    expect(await ask("power on")).toBe("Powering on");
    bench.ur.pendant.fault("The encoders of joint 3 differ.");
    expect(await ask("power on")).toBe("Failed to execute: power on");
    expect(await ask("restart safety")).toBe("Restarting safety");
    expect([bench.ur.state.robotMode, bench.ur.state.safetyMode]).toEqual([ROBOT_MODE.POWER_OFF, SAFETY_MODE.NORMAL]);
  });

  test("in local control it answers questions and refuses commands; before 5.6 there was no local control", async () => {
    const bench = await urBench({ remote: false });
    const ask = await bench.dashboard();
    for (const command of ["power off", "play", "stop", "unlock protective stop", "load a.urp", "brake release"])
      expect(await ask(command)).toContain("not allowed in local control");
    expect(await ask("robotmode")).toBe("Robotmode: RUNNING");
    expect(await ask("is in remote control")).toBe("false");
    const old = await urBench({ remote: false, version: [5, 4, 0, 1] });
    const askOld = await old.dashboard();
    expect(await askOld("power off")).toBe("Powering off");
  });
});

const TURN = [
  "def turn():",
  "  while True:",
  "    movej([0.5, -1.5, 1.5, -1.5, -1.5, 0], a=1, v=1)",
  "    movej([0, -1.5, 1.5, -1.5, -1.5, 0], a=1, v=1)",
  "  end",
  "end",
].join("\n");

describe("programs on the virtual controller", () => {
  test("a script runs to its end and its life is told; a fault names its line", async () => {
    const bench = await urBench();
    const { send, messages } = await listening(bench);
    send(
      'def pick():\n  set_standard_digital_out(2, True)\n  textmsg("at ", 1)\n  movej([0.3, -1.5, 1.5, -1.5, -1.5, 0], a=1, v=1)\nend',
    );
    await bench.scheduler.elapse(3);
    expect(bench.ur.state.q_rad[0]).toBeCloseTo(0.3, 9);
    expect(bench.ur.digitalOut(2)).toBe(true);
    const said = messages();
    expect(said[0]).toMatchObject({ kind: "version", major: 5 });
    expect(said.filter(({ kind }) => kind === "key" || kind === "text")).toEqual([
      { kind: "key", title: "PROGRAM_XXX_STARTED", text: "pick" },
      { kind: "text", text: "at 1" },
      { kind: "key", title: "PROGRAM_XXX_STOPPED", text: "pick" },
    ]);
    send("def wrong():\n  sync()\n  dance()\nend");
    await bench.scheduler.elapse(0.1);
    expect(messages().filter(({ kind }) => kind === "exception")).toEqual([
      { kind: "exception", line: 3, column: 3, text: '"dance" is no function of this controller.' },
    ]);
    expect(bench.ur.state.runtime).toBe(RUNTIME.STOPPED);
  });

  test("a pose out of reach makes a protective stop", async () => {
    const bench = await urBench();
    const { send, messages } = await listening(bench);
    send("movel(p[10, 0, 0, 0, 0, 0], a=1, v=0.2)");
    await bench.scheduler.elapse(0.1);
    expect(bench.ur.state.safetyMode).toBe(SAFETY_MODE.PROTECTIVE_STOP);
    expect(messages().some(said => said.kind === "error" && said.level >= 2)).toBe(true);
  });

  test("a program replaces the one that runs; another may run beside it and move nothing; bare lines are programs of their own", async () => {
    const bench = await urBench();
    const { send, messages } = await listening(bench);
    send(TURN);
    await bench.scheduler.elapse(0.3);
    send("sec beside():\n  set_standard_digital_out(1, True)\n  movej([3, 0, 0, 0, 0, 0])\nend");
    await bench.scheduler.elapse(0.1);
    expect([bench.ur.state.runtime, bench.ur.digitalOut(1)]).toEqual([RUNTIME.PLAYING, true]);
    send("movej([0.1, -1.5, 1.5, -1.5, -1.5, 0], a=1, v=1)");
    await bench.scheduler.elapse(3);
    expect(bench.ur.state.q_rad[0]).toBeCloseTo(0.1, 9);
    expect(
      messages()
        .filter(({ kind }) => kind === "key")
        .map(said => said.kind === "key" && `${said.title.slice(12)} ${said.text}`),
    ).toEqual(["STARTED turn", "STOPPED turn", "STARTED unnamed", "STOPPED unnamed"]);
  });

  test("pause and play, a guard that opens and closes: the program holds and goes on; power off, local control and an emergency stop end it", async () => {
    const files = new Map([["turn.urp", TURN]]);
    const bench = await urBench({ files });
    const ask = await bench.dashboard();
    expect([await ask("load turn.urp"), await ask("play")]).toEqual(["Loading program: turn.urp", "Starting program"]);
    const moved = async (): Promise<boolean> => {
      await bench.scheduler.elapse(1);
      const before = bench.ur.jointAngles();
      await bench.scheduler.elapse(0.3);
      return bench.ur.jointAngles().some((q, i) => Math.abs(q - before[i]!) > 1e-6);
    };
    expect(await moved()).toBe(true);
    expect([await ask("pause"), await ask("programState"), await moved()]).toEqual([
      "Pausing program",
      "PAUSED turn",
      false,
    ]);
    expect([await ask("play"), await ask("running"), await moved()]).toEqual([
      "Starting program",
      "Program running: true",
      true,
    ]);
    bench.ur.pendant.setGuardOpen(true);
    expect([await ask("safetymode"), await moved()]).toEqual(["Safetymode: SAFEGUARD_STOP", false]);
    bench.ur.pendant.setGuardOpen(false);
    expect([await ask("safetymode"), await moved()]).toEqual(["Safetymode: NORMAL", true]);
    expect([await ask("stop"), await ask("stop"), await moved()]).toEqual([
      "Stopped",
      "Failed to execute: stop",
      false,
    ]);
    for (const end of [
      () => {
        bench.ur.pendant.setMode("manual");
      },
      () => {
        bench.ur.pendant.emergencyStop(true);
      },
    ]) {
      expect(await ask("play")).toBe("Starting program");
      expect(await moved()).toBe(true);
      end();
      expect([bench.ur.state.runtime, await moved()]).toEqual([RUNTIME.STOPPED, false]);
      bench.ur.pendant.setMode("remote");
    }
  });

  test("in local control a script is answered with error 210 and does not run", async () => {
    const bench = await urBench({ remote: false });
    const { send, messages } = await listening(bench);
    send(TURN);
    await bench.scheduler.elapse(0.1);
    expect(messages().filter(({ kind }) => kind === "error")).toMatchObject([{ code: 210 }]);
    expect(bench.ur.state.runtime).toBe(RUNTIME.STOPPED);
  });

  test("streams of targets keep every joint's speed and acceleration and stop in front of its limit", async () => {
    const bench = await urBench();
    const { send } = await listening(bench);
    const joints = robot.arm.joints;
    let last = bench.ur.jointAngles();
    let speeds = new Float64Array(6);
    let fastest = 0;
    let hardest = 0;
    const look = async (seconds: number): Promise<void> => {
      for (let i = 0; i < seconds * 500; i++) {
        await bench.scheduler.elapse(0.002);
        const q = bench.ur.jointAngles();
        const now = q.map((angle, j) => (angle - last[j]!) / 0.002);
        joints.forEach(({ limits }, j) => {
          fastest = Math.max(fastest, Math.abs(now[j]!) / limits.speed_rad_s);
          hardest = Math.max(hardest, Math.abs(now[j]! - speeds[j]!) / 0.002 / limits.acceleration_rad_s2);
          expect(q[j]! <= limits.upper_rad + 1e-9 && q[j]! >= limits.lower_rad - 1e-9).toBe(true);
        });
        last = q;
        speeds = now;
      }
    };
    send(
      "def s():\n  speedj([9, 0, 0, 0, 0, 0], a=99, t=6)\n  stopj(2)\n  i = 0\n  while i < 500:\n    servoj([0, -1.5, 1.5, -1.5, -1.5, 9], t=0.002, lookahead_time=0.1, gain=300)\n    i = i + 1\n  end\n  speedl([0, 0, -0.1, 0, 0, 0], a=0.5, t=1)\n  stopl(1)\nend",
    );
    await look(9);
    expect(fastest).toBeLessThanOrEqual(1.000001);
    expect(hardest).toBeLessThanOrEqual(1.01);
    expect(fastest).toBeGreaterThan(0.9);
    expect(bench.ur.state.moving).toBe(false);
  });
});

describe("the real-time interface", () => {
  test("T-20 tells every cycle where the robot is, each number at its place in 1220 bytes", async () => {
    const bench = await urBench();
    const { got } = await bench.connect("realTime");
    bench.ur.pendant.setInput("digital_in_3", true);
    await bench.scheduler.elapse(0.02);
    const bytes = Uint8Array.from(got);
    const view = new DataView(bytes.buffer);
    const last = bytes.length - 1220;
    const double = (at: number): number => view.getFloat64(last + at);
    expect([...bytes.subarray(0, 4)]).toEqual([0x00, 0x00, 0x04, 0xc4]);
    expect(bytes.length % 1220).toBe(0);
    expect(bytes.length / 1220).toBeGreaterThanOrEqual(9);
    expect(double(4) - view.getFloat64(last - 1220 + 4)).toBeCloseTo(0.002, 6);
    const at = (place: number, count: number): number[] =>
      Array.from({ length: count }, (_, i) => double(place + 8 * i));
    expect(at(252, 6)).toEqual([...bench.ur.state.q_rad]);
    expect(at(444, 3)).toEqual([
      ...bench.ur.memory.slots.subarray(
        bench.ur.memory.slotOf("actual_TCP_pose"),
        bench.ur.memory.slotOf("actual_TCP_pose") + 3,
      ),
    ]);
    // Inputs, robot mode, modes of the joints, safety mode, outputs, state of the program.
    expect([at(684, 1), at(756, 1), at(764, 6), at(812, 1), at(1044, 1), at(1052, 1)]).toEqual([
      [8],
      [ROBOT_MODE.RUNNING],
      Array(6).fill(253),
      [SAFETY_MODE.NORMAL],
      [0],
      [RUNTIME.STOPPED],
    ]);
  });

  test("the read-only ports tell the same and take nothing", async () => {
    const bench = await urBench();
    const copies = { primaryCopy: "primary", secondaryCopy: "secondary", realTimeCopy: "realTime" } as const;
    for (const [copy, port] of Object.entries(copies) as [
      keyof typeof copies,
      (typeof copies)[keyof typeof copies],
    ][]) {
      const a = await bench.connect(copy);
      const b = await bench.connect(port);
      a.got.length = b.got.length = 0;
      a.stream.send(lineBytes("power off"));
      a.stream.send(new Uint8Array(1 << 18).fill(97));
      await bench.scheduler.elapse(0.2);
      expect(a.got.length, copy).toBeGreaterThan(100);
      expect(a.got).toEqual(b.got);
      expect(a.ended()).toBe(false);
      expect(bench.ur.state.robotMode).toBe(ROBOT_MODE.RUNNING);
      a.stream.close();
      b.stream.close();
    }
  });
});

describe("bad input at the virtual controller", () => {
  test("any bytes on any port: logged once, that connection reset or answered, the others and the controller untouched", async () => {
    const bench = await urBench();
    const { times_s } = await receiving(bench);
    for (const port of Object.keys(UR_PORTS) as (keyof typeof UR_PORTS)[]) {
      for (let seed = 1; seed <= 12; seed++) {
        const random = seededRandom(seed);
        const { stream } = await bench.connect(port);
        const before = bench.log.length;
        for (let i = 0; i < 20; i++) {
          stream.send(Uint8Array.from({ length: Math.floor(random() * 400) }, () => Math.floor(random() * 256)));
          await bench.scheduler.elapse(0.002);
        }
        if (port === "rtde") expect(bench.log.length - before).toBeLessThanOrEqual(20);
        stream.close();
      }
    }
    for (const port of ["dashboard", "primary", "secondary", "realTime"] as const) {
      const { stream, ended } = await bench.connect(port);
      const before = bench.log.length;
      stream.send(new Uint8Array(1 << 17).fill(97));
      stream.send(new Uint8Array(1 << 17).fill(97));
      await bench.scheduler.elapse(0.02);
      expect([port, ended(), bench.log.length - before]).toEqual([port, true, 1]);
    }
    const { stream, ended } = await bench.connect("rtde");
    const before = bench.log.length;
    stream.send(hex("00 01 00 00 01 00 00 01 00"));
    await bench.scheduler.elapse(0.02);
    expect([ended(), bench.log.length - before]).toEqual([true, 1]);
    const count = times_s().length;
    await bench.scheduler.elapse(0.1);
    expect(times_s().length).toBe(count + 50);
  });

  test("a client that does not read is not kept in memory", async () => {
    const bench = await urBench();
    const { stream } = await receiving(bench);
    bench.network.weather.frozen = true;
    await bench.scheduler.elapse(6);
    expect(bench.network.underWay).toBeLessThan(1 << 18);
    bench.network.weather.frozen = false;
    stream.close();
  });

  test("a port that is taken is said, and the others are given back", async () => {
    const bench = await urBench();
    const { createVirtualUr } = await import("../index.ts");
    const again = () =>
      createVirtualUr({
        robot,
        scheduler: bench.scheduler,
        network: bench.network,
        host: "127.0.0.2",
        interpret: () => ({ kind: "not-understood", faults: [] }),
      });
    expect(await again()).toMatchObject({
      kind: "taken",
      sentence: expect.stringContaining(String(UR_PORTS.dashboard)) as string,
    });
    bench.ur.close();
    expect((await again()).kind).toBe("started");
  });
});
