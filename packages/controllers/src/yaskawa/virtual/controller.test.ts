import { flangePose } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { COMMAND, SERVICE, readAlarm, readJob, textAt, textBytes, word } from "../codec/index.ts";
import { gp8, job, turned } from "../testing/bench.ts";
import { OK, cabinet, refused } from "../testing/cabinet.ts";

describe("a virtual Yaskawa controller: its states", () => {
  test("reading works in every mode; what changes something needs REMOTE with command remote", async () => {
    const { virtual, status, move, servo, select, start, order, hold } = await cabinet();
    for (const [mode, commandRemote, added] of [
      ["teach", true, 0x2080],
      ["play", true, 0x2080],
      ["remote", false, 0x2100],
    ] as const) {
      virtual.pendant.setMode(mode);
      virtual.pendant.setCommandRemote(commandRemote);
      expect(await status()).toMatchObject({
        teach: mode === "teach",
        play: mode !== "teach",
        remote: false,
        servo: true,
      });
      for (const answer of [
        await move(turned(0.1)),
        await servo(true),
        await select("A"),
        await start(),
        await order(COMMAND.byte, 0, Uint8Array.of(1)),
        await order(COMMAND.cycle, 2, word(1)),
        await order(COMMAND.io, 2701, Uint8Array.of(1)),
      ]) {
        expect(answer).toMatchObject(refused(added));
      }
      // Anyone may stop the robot; letting go needs remote.
      expect(await hold(true)).toMatchObject(OK);
      expect(await hold(false)).toMatchObject(refused(added));
      virtual.pendant.setMode("remote");
      virtual.pendant.setCommandRemote(true);
      expect(await hold(false)).toMatchObject(OK);
    }
    expect(await status()).toMatchObject({ remote: true });
    expect(await move(turned(0.1))).toMatchObject(OK);
    expect((await status()).running).toBe(true);
    expect(await move(turned(0.2))).toMatchObject(refused(0x2010));
  });

  test("a hold slows a move down and ends it; only after it is let go the next one is heard", async () => {
    const { scheduler, move, hold, status, j1 } = await cabinet();
    await move(turned(1));
    await scheduler.elapse(0.2);
    await hold(true);
    await scheduler.elapse(0.6);
    expect(await status()).toMatchObject({ running: false, heldByCommand: true, servo: true, alarm: false });
    const rest = j1();
    expect(rest).toBeGreaterThan(0.01);
    expect(await move(turned(0))).toMatchObject(refused(0x2050));
    await hold(false);
    await scheduler.elapse(0.5);
    expect(j1()).toBe(rest);
    expect(await move(turned(0))).toMatchObject(OK);
    await scheduler.elapse(2);
    expect(j1()).toBeCloseTo(0, 4);
  });

  test("emergency stop: servo off and an error until the button is out, reset, and servo on", async () => {
    const { virtual, scheduler, move, status, order, servo, j1 } = await cabinet();
    await move(turned(1));
    await scheduler.elapse(0.2);
    virtual.pendant.emergencyStop(true);
    await scheduler.elapse(0.5);
    const rest = j1();
    expect(await status()).toMatchObject({ servo: false, error: true, running: false });
    expect(await servo(true)).toMatchObject(refused(0x3450));
    virtual.pendant.emergencyStop(false);
    expect(await servo(true)).toMatchObject(refused(0x2060));
    expect(await order(COMMAND.reset, 1, word(1))).toMatchObject(OK);
    expect(await move(turned(0))).toMatchObject(refused(0x2070));
    expect(await servo(true)).toMatchObject(OK);
    expect((await status()).servo).toBe(false);
    await scheduler.elapse(0.2);
    expect(await status()).toMatchObject({ servo: true, error: false });
    expect(j1()).toBe(rest);
    expect(await move(turned(0))).toMatchObject(OK);
  });

  test("T-20 a major alarm takes the servo off, is told by 0x70 and kept in the history; a minor one does not", async () => {
    const { virtual, read, status, order, move } = await cabinet({ began_unix_s: 1_795_352_400 });
    expect((await read(COMMAND.alarm, 1))!.data).toEqual(new Uint8Array(60));
    virtual.pendant.raiseAlarm(4320, "OVERLOAD (CONTINUE)", 2);
    expect(readAlarm((await read(COMMAND.alarm, 1))!.data)).toEqual({
      code: 4320,
      data: 2,
      type: 0,
      time: "2026/11/22 13:00",
      name: "OVERLOAD (CONTINUE)",
    });
    expect(await status()).toMatchObject({ alarm: true, servo: false });
    await order(COMMAND.reset, 1, word(1));
    expect(await status()).toMatchObject({ alarm: false, servo: false });
    virtual.pendant.raiseAlarm(9010, "BATTERY", 0, false);
    expect(readAlarm((await read(COMMAND.alarmHistory, 2))!.data)?.code).toBe(4320);
    expect(textAt((await read(COMMAND.alarm, 1, 5))!.data, 0, 32)).toBe("BATTERY");
    expect(await move(turned(0.1))).toMatchObject(refused(0x2060));
  });

  test("T-26 TEACH: nothing is started, jogs reach no more than 250 mm/s", async () => {
    const { virtual, scheduler } = await cabinet();
    virtual.pendant.setMode("teach");
    const jog = virtual.pendant.jog(turned(0.3));
    const tips: { at_s: number; flange: readonly number[] }[] = [];
    virtual.neutral.onSample(({ time_s, q_rad }) => {
      tips.push({ at_s: time_s, flange: [...flangePose(gp8.arm, q_rad).position] });
    });
    await scheduler.elapse(20);
    // A promise that never ends would hang the test.
    expect(await Promise.race([jog, Promise.resolve("still jogging")])).toEqual({ kind: "done" });
    const fastest = Math.max(
      ...tips
        .slice(1)
        .map(
          ({ at_s, flange }, i) =>
            Math.hypot(...flange.map((value, k) => value - tips[i]!.flange[k]!)) / (at_s - tips[i]!.at_s),
        ),
    );
    expect(fastest).toBeGreaterThan(0.03);
    expect(fastest).toBeLessThanOrEqual(0.25);
    virtual.pendant.setMode("remote");
    expect((await virtual.pendant.jog(turned(0))).kind).toBe("refused");
  });

  test("T-27 somebody near the robot stops it; it stays stopped when he steps back", async () => {
    const { virtual, scheduler, move, status, j1 } = await cabinet();
    await move(turned(1));
    await scheduler.elapse(0.2);
    virtual.pendant.setGuardOpen(true);
    await scheduler.elapse(0.5);
    const rest = j1();
    expect(await status()).toMatchObject({ heldOutside: true, running: false, servo: true });
    expect(await move(turned(0))).toMatchObject(refused(0x2040));
    virtual.pendant.setGuardOpen(false);
    await scheduler.elapse(0.5);
    expect(j1()).toBe(rest);
    expect(await move(turned(0))).toMatchObject(OK);
  });
});

describe("a virtual Yaskawa controller: jobs and files", () => {
  const save = async (
    { filing }: Pick<Awaited<ReturnType<typeof cabinet>>, "filing">,
    name: string,
    text: string,
  ): Promise<number> => {
    let answer = await filing.ask({ service: SERVICE.saveFile, data: textBytes(name) });
    for (let block = 1; answer?.status === 0 && answer.block < 0x8000_0000; block++) {
      const isLast = block * 400 >= text.length;
      answer = await filing.ask({
        service: SERVICE.saveFile,
        ack: true,
        block: isLast ? (block | 0x8000_0000) >>> 0 : block,
        data: textBytes(text.slice((block - 1) * 400, block * 400)),
      });
    }
    return answer?.status === 0 ? 0 : (answer?.added ?? -1);
  };

  test("a job is saved in blocks, listed, loaded back letter by letter, and deleted", async () => {
    const made = await cabinet();
    const { filing, virtual } = made;
    const text = job("LONG", ...Array.from({ length: 100 }, (_, i) => `MOVJ 0.${i}`));
    expect(text.length).toBeGreaterThan(900);
    expect(await save(made, "LONG.JBI", text)).toBe(0);
    expect(virtual.files.read("LONG.JBI")).toBe(text);
    const list = await filing.ask({ service: SERVICE.listFiles, data: textBytes("*.JBI") });
    expect(list).toMatchObject({ ...OK, block: 0x8000_0001 });
    expect(textAt(list!.data, 0, 99)).toBe("LONG.JBI\r\n");
    let got = "";
    let answer = await filing.ask({ service: SERVICE.loadFile, data: textBytes("LONG.JBI") });
    for (let asked = 0; answer && asked < 10; asked++) {
      got += textAt(answer.data, 0, 400);
      if (answer.block >= 0x8000_0000) break;
      answer = await filing.ask({ service: SERVICE.loadFile, ack: true, block: answer.block });
    }
    expect(got).toBe(text);
    expect(await filing.ask({ service: SERVICE.deleteFile, data: textBytes("LONG.JBI") })).toMatchObject(OK);
    expect(await filing.ask({ service: SERVICE.deleteFile, data: textBytes("LONG.JBI") })).toMatchObject(
      refused(0xe2b3),
    );
    expect(await filing.ask({ service: SERVICE.loadFile, data: textBytes("LONG.JBI") })).toMatchObject(refused(0xe2b3));
  });

  test("what cannot be saved says why: no job, no END, a name, a mode; a repeated block counts once, a missing one ends it, a stalled one is dropped", async () => {
    const made = await cabinet();
    const { filing, virtual, scheduler } = made;
    expect(await save(made, "A.JBI", "hello")).toBe(0x5170);
    expect(await save(made, "A.JBI", "/JOB\nNOP\nMOVJ 1\n")).toBe(0x5130);
    expect(await save(made, "WRONG?.JBI", job("A"))).toBe(0x4190);
    virtual.pendant.setMode("teach");
    expect(await save(made, "A.JBI", job("A"))).toBe(0xe2b2);
    virtual.pendant.setMode("remote");
    const block = (number: number, text: string) =>
      filing.ask({ service: SERVICE.saveFile, ack: true, block: number, data: textBytes(text) });
    await filing.ask({ service: SERVICE.saveFile, data: textBytes("B.JBI") });
    await block(1, "/JOB\nNOP\n");
    await block(1, "/JOB\nNOP\n");
    expect(await block(0x8000_0002, "END\n")).toMatchObject(OK);
    expect(virtual.files.read("B.JBI")).toBe("/JOB\nNOP\nEND\n");
    await filing.ask({ service: SERVICE.saveFile, data: textBytes("C.JBI") });
    expect(await block(2, "END\n")).toMatchObject(refused(0xe4a1));
    await filing.ask({ service: SERVICE.saveFile, data: textBytes("C.JBI") });
    await scheduler.elapse(11);
    expect(await block(1, "/JOB")).toMatchObject(refused(0xe28b));
  });

  test("a job is selected, started and watched: line and step count from NOP; a hold is followed by start", async () => {
    const made = await cabinet();
    const { scheduler, select, start, read, hold, status, j1, virtual, move } = made;
    expect(await start()).toMatchObject(refused(0x4060));
    expect(await select("PICK")).toMatchObject(refused(0x4040));
    await save(made, "PICK.JBI", job("PICK", "MOVJ 0.5", "O 2", "I 1", "MOVJ 0", "MOVJ 0.7"));
    expect(await select("PICK")).toMatchObject(OK);
    expect(await start()).toMatchObject(OK);
    expect(await start()).toMatchObject(refused(0x2010));
    await scheduler.elapse(0.1);
    expect(readJob((await read(COMMAND.job, 1))!.data)).toMatchObject({ job: "PICK", line: 1, step: 1, override: 1 });
    await hold(true);
    await scheduler.elapse(0.5);
    const rest = j1();
    expect(await status()).toMatchObject({ running: false });
    await hold(false);
    await scheduler.elapse(0.5);
    expect(j1()).toBe(rest);
    expect(await start()).toMatchObject(OK);
    await scheduler.elapse(2);
    // Waiting for its input.
    expect(j1()).toBeCloseTo(0.5, 6);
    expect(await status()).toMatchObject({ running: true });
    expect(readJob((await read(COMMAND.job, 1))!.data)).toMatchObject({ line: 3, step: 1 });
    expect((await read(COMMAND.io, 1001, 1))!.data).toEqual(Uint8Array.of(2));
    virtual.pendant.setInput(1, true);
    await scheduler.elapse(4);
    expect(await status()).toMatchObject({ running: false });
    expect(j1()).toBeCloseTo(0.7, 6);
    expect(await move(turned(0))).toMatchObject(OK);
  });

  test("an emergency stop interrupts a job; after reset and servo on it goes on from its line", async () => {
    const made = await cabinet();
    const { scheduler, select, start, status, j1, virtual, order, servo } = made;
    await save(made, "GO.JBI", job("GO", "MOVJ 0.3", "MOVJ 1", "MOVJ 0.2"));
    await select("GO");
    await start();
    await scheduler.elapse(0.5);
    virtual.pendant.emergencyStop(true);
    await scheduler.elapse(0.5);
    virtual.pendant.emergencyStop(false);
    await order(COMMAND.reset, 1, word(1));
    await servo(true);
    await scheduler.elapse(0.3);
    expect(j1()).toBeGreaterThan(0.31);
    expect(await start()).toMatchObject(OK);
    await scheduler.elapse(4);
    expect(await status()).toMatchObject({ running: false });
    expect(j1()).toBeCloseTo(0.2, 6);
  });

  test("cycles: one step at a time, once, and again and again", async () => {
    const made = await cabinet();
    const { scheduler, select, start, order, status, j1 } = made;
    await save(made, "TWO.JBI", job("TWO", "MOVJ 0.1", "MOVJ 0.2"));
    await select("TWO");
    await order(COMMAND.cycle, 2, word(1));
    expect(await status()).toMatchObject({ step: true, once: false });
    await start();
    await scheduler.elapse(2);
    expect(j1()).toBeCloseTo(0.1, 6);
    await start();
    await scheduler.elapse(2);
    expect(j1()).toBeCloseTo(0.2, 6);
    await order(COMMAND.cycle, 2, word(3));
    await select("TWO");
    await start();
    await scheduler.elapse(5);
    expect(await status()).toMatchObject({ running: true, continuous: true });
    expect(await order(COMMAND.cycle, 2, word(4))).toMatchObject(refused(0xb004));
  });

  test("a job that is not understood is not started, and the pendant says the line", async () => {
    const made = await cabinet();
    const { select, start, virtual } = made;
    await save(made, "ODD.JBI", job("ODD", "MOVJ 0.1", "DANCE"));
    await select("ODD");
    expect(await start()).toMatchObject(refused(0x5110));
    expect(virtual.pendant.message).toBe("ODD, line 6: There is no such word.");
  });
});
