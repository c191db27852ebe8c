import { flangePose, seededRandom, manualScheduler } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { memoryNetwork, type ByteStream } from "../../transport/index.ts";
import { createVirtualKuka, startLoop, type VirtualKukaOptions } from "../index.ts";
import { LOOP_FILES, LOOP_GLOBALS } from "../codec/loop.ts";
import { HOST, interpretMoves, KR6 } from "../testing/bench.ts";

async function bench(options: Partial<VirtualKukaOptions> = {}) {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const log: string[] = [];
  const kuka = await createVirtualKuka({
    robot: KR6,
    scheduler,
    network,
    host: HOST,
    interpret: interpretMoves,
    log: sentence => {
      log.push(sentence);
    },
    ...options,
  });
  await scheduler.elapse(0.01);
  const read = (name: string): string => kuka.variables.read(name) ?? "?";
  /** Greatest speed of the flange [m/s] while it goes on. */
  const fastest = async (seconds: number): Promise<number> => {
    let most = 0;
    let last = flangePose(KR6.arm, kuka.arm.jointAngles()).position;
    const stop = kuka.arm.onSample(({ q_rad }) => {
      const at = flangePose(KR6.arm, q_rad).position;
      most = Math.max(most, Math.hypot(at[0] - last[0], at[1] - last[1], at[2] - last[2]) / 0.004);
      last = [...at];
    });
    await scheduler.elapse(seconds);
    stop();
    return most;
  };
  return { scheduler, network, kuka, log, read, fastest };
}
const HOME = "PTP 0 -90 90 0 90 0";
const AWAY = "PTP 60 -60 60 30 60 90";
const PROGRAM = ["DEF A( )", AWAY, HOME, AWAY, "END", ""].join("\r\n");

/** A client of bytes: what comes back, as numbers. */
async function bytesClient(scheduler: ReturnType<typeof manualScheduler>, network: ReturnType<typeof memoryNetwork>) {
  const got: number[] = [];
  const streams: ByteStream[] = [];
  let over = 0;
  void network.connect({ host: HOST, port: 7000 }).then(answer => {
    if (answer.kind !== "connected") return;
    streams.push(answer.stream);
    answer.stream.onBytes(lent => {
      got.push(...lent);
    });
    answer.stream.onEnd(() => {
      over++;
    });
  });
  await scheduler.elapse(0.01);
  const ask = async (...bytes: number[]): Promise<number[]> => {
    got.length = 0;
    streams[0]!.send(Uint8Array.from(bytes));
    await scheduler.elapse(0.01);
    return [...got];
  };
  return { ask, ended: () => over };
}
const ascii = (text: string): number[] => [...text].map(sign => sign.charCodeAt(0));

describe("variables on the wire, byte for byte", () => {
  test("a read of the old kind, one of many, a write, and what is not there", async () => {
    const { scheduler, network } = await bench();
    const { ask } = await bytesClient(scheduler, network);
    expect(await ask(0, 9, 0, 7, 0, 0, 4, ...ascii("PING"))).toEqual([0, 9, 0, 10, 0, 0, 4, ...ascii("PONG"), 0, 1, 1]);
    expect(await ask(1, 2, 0, 11, 0, 0, 8, ...ascii("$MODE_OP"))).toEqual([
      1,
      2,
      0,
      9,
      0,
      0,
      3,
      ...ascii("#EX"),
      0,
      1,
      1,
    ]);
    expect(await ask(0, 1, 0, 13, 1, 0, 7, ...ascii("$OV_PRO"), 0, 1, ...ascii("5"))).toEqual([
      0,
      1,
      0,
      7,
      1,
      0,
      1,
      ...ascii("5"),
      0,
      1,
      1,
    ]);
    expect(await ask(0, 1, 0, 9, 0, 0, 6, ...ascii("$NOPE!"))).toEqual([0, 1, 0, 6, 0, 0, 0, 0, 0, 0]);
    // Two of many: 12.0 characters of UTF-16, and one that is unknown with its own error code.
    expect(await ask(0, 3, 0, 16, 6, 2, 0, 4, 80, 0, 73, 0, 78, 0, 71, 0, 0, 1, 81, 0)).toEqual([
      0, 3, 0, 19, 6, 2, 1, 0, 4, 80, 0, 79, 0, 78, 0, 71, 0, 0, 0, 0, 0, 1, 1,
    ]);
  });

  test("states are read only; the mode is the key's alone", async () => {
    const { kuka, read } = await bench();
    for (const name of [
      "$MODE_OP",
      "$AXIS_ACT",
      "$POS_ACT",
      "$PRO_STATE1",
      "$PERI_RDY",
      "$IN[1]",
      "$MODEL_NAME[]",
      "NOBODY",
    ])
      expect(kuka.variables.write(name, read(name))).toBe(false);
    expect(kuka.variables.write("$OV_PRO", "101")).toBe(false);
    expect(kuka.variables.write("$out[7]", "TRUE")).toBe(true);
    expect([read("$OUT[7]"), read("$IN[7]"), read("$OUT[0]"), read("$OUT[4097]")]).toEqual(["TRUE", "FALSE", "?", "?"]);
    kuka.pendant.setInput(7, true);
    expect(read("$IN[7]")).toBe("TRUE");
    expect(kuka.variables.write("$ANOUT[1]", "0.5")).toBe(true);
    expect([read("$ANOUT[1]"), kuka.variables.write("$ANOUT[1]", "1.5")]).toEqual(["0.5", false]);
    expect(read("$AXIS_ACT")).toBe(
      "{E6AXIS: A1 0.0, A2 -90.0, A3 90.0, A4 0.0, A5 90.0, A6 0.0, E1 0.0, E2 0.0, E3 0.0, E4 0.0, E5 0.0, E6 0.0}",
    );
    // Upper arm upright, forearm level, wrist bent down: X = 25 + 420 mm, Z = 400 + 455 + 35 − 80 mm; A2 is the only
    // negative axis.
    expect(read("$POS_ACT")).toMatch(/^\{E6POS: X 445\.0, Y .*, Z 810\.0, A .*, B .*, C .*, S 2, T 2, E1 0\.0/);
    expect(read("TWC_AXIS").length).toBeLessThan(256 - 10);
  });

  test("what is no message is logged once and cut off; what is cannot be done is answered 7, what is malformed 9", async () => {
    const { scheduler, network, log } = await bench();
    const one = await bytesClient(scheduler, network);
    const two = await bytesClient(scheduler, network);
    expect(await one.ask(0, 1, 0, 1, 12)).toEqual([0, 1, 0, 4, 12, 0, 7, 0]);
    expect(await one.ask(0, 2, 0, 2, 0, 0)).toEqual([0, 2, 0, 4, 0, 0, 9, 0]);
    expect(one.ended()).toBe(0);
    expect(await one.ask(0, 1, 0, 1, 200)).toEqual([0, 1, 0, 4, 200, 0, 7, 0]);
    expect(one.ended()).toBe(1);
    await one.ask(0, 0, 0, 0);
    expect(log).toHaveLength(1);
    expect(log[0]).toContain("type 200");
    await two.ask(1, 1, 0, 0);
    expect(log).toHaveLength(2);
    const three = await bytesClient(scheduler, network);
    expect(await three.ask(0, 9, 0, 7, 0, 0, 4, ...ascii("PING"))).toHaveLength(14);
  });

  test("any bytes on the port: no crash, at most one line of log for a connection (300 connections)", async () => {
    const { scheduler, network, log, read } = await bench();
    const random = seededRandom(11);
    for (let i = 0; i < 300; i++) {
      const client = await bytesClient(scheduler, network);
      const before = log.length;
      for (let k = 0; k < 5; k++)
        await client.ask(
          ...Array.from({ length: 1 + Math.floor(random() * 40) }, () =>
            Math.floor(random() * (random() < 0.5 ? 8 : 256)),
          ),
        );
      expect(log.length - before).toBeLessThanOrEqual(1);
      network.cut();
      await scheduler.elapse(0.01);
    }
    expect(read("$MODE_OP")).toBe("#EX");
  });

  test("it is found by name: WHEREAREYOU?", async () => {
    const { scheduler, network } = await bench({ serial: "4711" });
    const answers: string[] = [];
    const asker = await network.bind({ host: HOST, port: 0 });
    if (asker.kind === "taken") throw new Error(asker.sentence);
    asker.socket.onDatagram(lent => {
      answers.push(String.fromCharCode(...lent));
    });
    for (const text of ["WHEREAREYOU?", "WHEREAREYOU", "x".repeat(2000)])
      asker.socket.send(Uint8Array.from(ascii(text)), { host: HOST, port: 7000 });
    await scheduler.elapse(0.01);
    expect(answers).toEqual(["KUKA|#KR6R900SIXX C2 FLR ZH100|4711"]);
  });
});

describe("mode, drives, stops, messages", () => {
  test("STOP 0: the enabling switch let go of takes the drives off at once", async () => {
    const { scheduler, kuka, read } = await bench({ mode: "T1" });
    expect(kuka.pendant.start()).toBe("The enabling switch is not pressed.");
    kuka.pendant.setEnabling(true);
    expect([kuka.drivesOn, read("$PERI_RDY")]).toEqual([true, "TRUE"]);
    void kuka.pendant.jog([0.5, -1.5, 1.5, 0, 1.5, 0]);
    await scheduler.elapse(0.2);
    expect(kuka.arm.isMoving()).toBe(true);
    kuka.pendant.setEnabling(false);
    expect([kuka.drivesOn, read("$PERI_RDY"), read("$STOPMESS")]).toEqual([false, "FALSE", "FALSE"]);
    await scheduler.elapse(0.5);
    expect(kuka.arm.isMoving()).toBe(false);
  });

  test("STOP 1: the emergency stop brakes, then takes the drives off; released, confirmed, drives on, start", async () => {
    const { scheduler, kuka, read } = await bench();
    expect(startLoop(kuka)).toBeNull();
    kuka.variables.write("TWC_AXIS", "{A1 60}");
    kuka.variables.write("TWC_KIND", "1");
    kuka.variables.write("TWC_RATIO", "100");
    kuka.variables.write("TWC_CMD", "1");
    await scheduler.elapse(0.25);
    expect([kuka.arm.isMoving(), read("$PRO_STATE1")]).toEqual([true, "#P_ACTIVE"]);
    kuka.pendant.setEmergencyStop(true);
    expect([kuka.drivesOn, read("$ALARM_STOP"), read("$PERI_RDY"), read("$STOPMESS"), read("$PRO_STATE1")]).toEqual([
      true,
      "FALSE",
      "FALSE",
      "TRUE",
      "#P_STOP",
    ]);
    await scheduler.elapse(1);
    expect([kuka.drivesOn, kuka.arm.isMoving()]).toEqual([false, false]);
    kuka.pendant.confirm();
    expect(read("$STOPMESS")).toBe("TRUE");
    expect(kuka.pendant.setDrives(true)).toBe("The emergency stop is pressed.");
    kuka.pendant.setEmergencyStop(false);
    expect(kuka.pendant.start()).toContain("not confirmed");
    kuka.pendant.confirm();
    expect(kuka.pendant.start()).toBe("The drives are not ready.");
    expect(kuka.pendant.setDrives(true)).toBeNull();
    const rest = kuka.arm.jointAngles();
    await scheduler.elapse(1);
    expect(kuka.arm.jointAngles()).toEqual(rest);
    expect(kuka.pendant.start()).toBeNull();
    await scheduler.elapse(2);
    // The controller goes on with the motion it was stopped in; the timer of our program has run out meanwhile and
    // takes it back.
    expect([read("TWC_DONE"), read("TWC_RESULT")]).toEqual(["1", "4"]);
    expect(Math.abs(kuka.arm.jointAngle(1) - rest[0]!)).toBeLessThan(0.01);
  });

  test("T-27 STOP 2: the gate brakes and leaves the drives on; closing it starts nothing", async () => {
    const { scheduler, kuka, read } = await bench();
    startLoop(kuka);
    for (const [name, value] of [
      ["TWC_AXIS", "{A1 60}"],
      ["TWC_KIND", "1"],
      ["TWC_RATIO", "100"],
      ["TWC_CMD", "1"],
    ] as const)
      kuka.variables.write(name, value);
    await scheduler.elapse(0.25);
    kuka.pendant.setGuardOpen(true);
    await scheduler.elapse(0.5);
    const rest = kuka.arm.jointAngles();
    expect([kuka.drivesOn, kuka.arm.isMoving(), read("$USER_SAF"), read("$PERI_RDY"), read("$PRO_STATE1")]).toEqual([
      true,
      false,
      "FALSE",
      "TRUE",
      "#P_STOP",
    ]);
    kuka.pendant.setGuardOpen(false);
    await scheduler.elapse(1);
    expect([read("$USER_SAF"), read("$STOPMESS"), read("$PRO_STATE1")]).toEqual(["TRUE", "TRUE", "#P_STOP"]);
    expect(kuka.arm.jointAngles()).toEqual(rest);
  });

  test("the key stops the program; T1 is slower than 250 mm/s at the flange, T2 is not; outside they cannot start anything", async () => {
    const { scheduler, kuka, read, fastest } = await bench({ mode: "AUT" });
    startLoop(kuka);
    kuka.pendant.setMode("T1");
    expect([read("$MODE_OP"), read("$PRO_STATE1")]).toEqual(["#T1", "#P_STOP"]);
    await scheduler.elapse(0.05);
    kuka.pendant.setEnabling(true);
    const slow = kuka.pendant.jog([1, -1, 1, 0, 1, 0]);
    expect(await fastest(8)).toBeLessThanOrEqual(0.25 * 1.001);
    expect((await slow).kind).toBe("done");
    kuka.pendant.setMode("T2");
    await scheduler.elapse(0.1);
    expect(kuka.pendant.setDrives(true)).toBeNull();
    void kuka.pendant.jog([0, -1.5, 1.5, 0, 1, 0]);
    expect(await fastest(2)).toBeGreaterThan(0.5);
  });
});

describe("programs", () => {
  test("a program runs to its path slowly; AUT then asks for a second start, EXT goes on", async () => {
    for (const mode of ["AUT", "EX"] as const) {
      const { scheduler, kuka, read, fastest } = await bench({ mode });
      expect(kuka.pendant.write("KRC:\\R1\\PROGRAM\\A.src", PROGRAM)).toBeNull();
      kuka.pendant.setDrives(true);
      expect(kuka.pendant.select("a")).toBeNull();
      expect([read("$PRO_NAME1[]"), read("$PRO_STATE1")]).toEqual(['"A"', "#P_RESET"]);
      expect(kuka.pendant.start()).toBeNull();
      expect(await fastest(2)).toBeLessThanOrEqual(0.25 * 1.001);
      await scheduler.elapse(8);
      if (mode === "AUT") {
        expect([read("$PRO_STATE1"), kuka.messages.at(-1)?.text]).toEqual(["#P_STOP", "Programmed path reached (BCO)"]);
        expect(kuka.pendant.start()).toBeNull();
        expect(await fastest(6)).toBeGreaterThan(0.5);
      }
      expect(read("$PRO_STATE1")).toBe("#P_END");
      expect(kuka.arm.jointAngle(1)).toBeCloseTo(Math.PI / 3, 9);
      expect(kuka.pendant.start()).toContain("has ended");
      expect(kuka.pendant.reset()).toBeNull();
      expect(read("$PRO_STATE1")).toBe("#P_RESET");
    }
  });

  test("the stop key holds on the path and start goes on; after a stop of the safety the step under way comes again", async () => {
    const { scheduler, kuka, read } = await bench();
    kuka.pendant.write("A.src", PROGRAM.replace(AWAY, HOME));
    kuka.pendant.setDrives(true);
    kuka.pendant.select("A");
    kuka.pendant.start();
    await scheduler.elapse(0.25);
    kuka.pendant.stop();
    await scheduler.elapse(1);
    const held = kuka.arm.jointAngles();
    expect([read("$PRO_STATE1"), kuka.arm.isMoving()]).toEqual(["#P_STOP", false]);
    expect(kuka.pendant.start()).toBeNull();
    await scheduler.elapse(0.2);
    expect(kuka.arm.jointAngles()).not.toEqual(held);
    kuka.pendant.setGuardOpen(true);
    await scheduler.elapse(1);
    kuka.pendant.setGuardOpen(false);
    kuka.pendant.confirm();
    kuka.pendant.setDrives(true);
    expect(kuka.pendant.start()).toBeNull();
    await scheduler.elapse(4);
    expect(read("$PRO_STATE1")).toBe("#P_END");
    expect(kuka.arm.jointAngle(1)).toBeCloseTo(Math.PI / 3, 9);
  });

  test("a text with an error is not selected, and the message names its line; names of files are looked at", async () => {
    const { kuka, read } = await bench();
    expect(kuka.pendant.write("A.src", "DEF A( )\r\nJUMP\r\nEND")).toBeNull();
    expect(kuka.pendant.select("A")).toContain("line 2");
    expect([read("$PRO_STATE1"), kuka.messages.at(-1)?.text]).toEqual(["#P_FREE", "A, line 2: This is no joint move."]);
    expect(kuka.pendant.write("A.txt", "")).not.toBeNull();
    expect(kuka.pendant.write(`${"A".repeat(25)}.src`, "")).not.toBeNull();
    expect(kuka.pendant.select("B")).toBe("There is no program B.");
  });

  test("our own program: 24 characters at most a name, every global declared, blocks closed", () => {
    const [src, dat] = LOOP_FILES;
    const lines = src.text.split("\r\n").map(line => line.trim());
    const count = (word: RegExp): number => lines.filter(line => word.test(line)).length;
    expect(count(/^DEF /)).toBe(count(/^END$/));
    expect([count(/^LOOP$/), count(/^FOR /), count(/^SWITCH /)]).toEqual([
      count(/^ENDLOOP$/),
      count(/^ENDFOR$/),
      count(/^ENDSWITCH$/),
    ]);
    expect(count(/^IF /)).toBe(count(/^ENDIF$/));
    for (const name of new Set(src.text.match(/\bTWC_[A-Z]+\b/g)))
      expect(dat.text.includes(` ${name}=`) || src.text.includes(`DEF ${name}(`), name).toBe(true);
    for (const [name] of LOOP_GLOBALS) expect(name.length).toBeLessThanOrEqual(24);
  });
});

describe("the program TWINCELL", () => {
  async function loop() {
    const made = await bench();
    const { kuka } = made;
    startLoop(kuka);
    const write = (values: Readonly<Record<string, string>>): void => {
      for (const [name, value] of Object.entries(values)) expect(kuka.variables.write(name, value), name).toBe(true);
    };
    const said = (): string[] => ["TWC_DONE", "TWC_RESULT", "TWC_STOP"].map(made.read);
    return { ...made, write, said };
  }
  const FAR = { TWC_AXIS: "{A1 90}", TWC_KIND: "1", TWC_RATIO: "100", TWC_WATCH: "500" } as const;

  test("moves joints, and says so", async () => {
    const { scheduler, kuka, write, said } = await loop();
    write({ ...FAR, TWC_WATCH: "60000", TWC_CMD: "5" });
    await scheduler.elapse(3);
    expect(said()).toEqual(["5", "1", "FALSE"]);
    expect(kuka.arm.jointAngle(1)).toBeCloseTo(Math.PI / 2, 6);
  });

  test("X-41 it brakes by its own timer when nobody sets that back", async () => {
    const { scheduler, kuka, write, said } = await loop();
    write({ ...FAR, TWC_RATIO: "10", TWC_CMD: "5" });
    await scheduler.elapse(0.48);
    expect(kuka.arm.isMoving()).toBe(true);
    await scheduler.elapse(0.2);
    expect(kuka.arm.isMoving()).toBe(false);
    expect(said()).toEqual(["5", "4", "FALSE"]);
    write({ ...FAR, TWC_RATIO: "10", TWC_CMD: "6" });
    for (let i = 0; i < 10; i++) {
      await scheduler.elapse(0.2);
      kuka.variables.write("$TIMER[10]", "-500");
    }
    expect(kuka.arm.isMoving()).toBe(true);
  });

  test("a stop brakes; one that comes with a command takes it back; the lock refuses", async () => {
    const { scheduler, kuka, write, said } = await loop();
    write({ ...FAR, TWC_CMD: "5" });
    await scheduler.elapse(0.2);
    write({ TWC_STOP: "TRUE" });
    await scheduler.elapse(0.5);
    expect([...said(), kuka.arm.isMoving()]).toEqual(["5", "2", "FALSE", false]);
    const rest = kuka.arm.jointAngles();
    write({ TWC_STOP: "TRUE", TWC_CMD: "6" });
    await scheduler.elapse(0.1);
    expect(said()).toEqual(["6", "2", "FALSE"]);
    write({ TWC_LOCK: "TRUE", TWC_CMD: "7" });
    await scheduler.elapse(0.1);
    expect(said()).toEqual(["7", "3", "FALSE"]);
    expect(kuka.arm.jointAngles()).toEqual(rest);
  });

  test("a target beyond an axis stops the program with a message; taken back before the start, nothing moves", async () => {
    const { scheduler, kuka, write, read } = await loop();
    write({ ...FAR, TWC_AXIS: "{A1 300}", TWC_CMD: "5" });
    await scheduler.elapse(0.1);
    expect([read("$PRO_STATE1"), read("$STOPMESS")]).toEqual(["#P_STOP", "TRUE"]);
    expect(kuka.messages.at(-1)?.text).toMatch(/joint 1 would turn .* 170\.0°/);
    write({ TWC_STOP: "TRUE" });
    kuka.pendant.confirm();
    expect(kuka.pendant.start()).toBeNull();
    await scheduler.elapse(0.1);
    expect([read("TWC_DONE"), read("TWC_RESULT"), read("$PRO_STATE1")]).toEqual(["5", "2", "#P_ACTIVE"]);
  });

  test("values that are none of the variable's kind are not taken", async () => {
    const { kuka } = await loop();
    for (const [name, value] of [
      ["TWC_CMD", "1.5"],
      ["TWC_CMD", "TRUE"],
      ["TWC_STOP", "1"],
      ["TWC_AXIS", "{X 1}"],
      ["TWC_AXIS", "{E6POS: A1 1}"],
      ["TWC_SPEED", "#A"],
      ["TWC_CMD", "3000000000"],
    ] as const) {
      expect(kuka.variables.write(name, value), `${name}=${value}`).toBe(false);
    }
  });
});
