import { describe, expect, test } from "vitest";
import {
  COMMAND,
  DIVISION,
  PLURAL,
  SERVICE,
  noPosition,
  putU32,
  readJob,
  readPosition,
  textAt,
  textBytes,
  word,
  writePosition,
  writePulseMove,
} from "../codec/index.ts";
import { job, rawClient, turned } from "../testing/bench.ts";
import { OK, cabinet, refused } from "../testing/cabinet.ts";

describe("a virtual Yaskawa controller: values", () => {
  test.each([
    ["B", COMMAND.byte, [200]],
    ["I", COMMAND.integer, [0xfe, 0xff]],
    ["D", COMMAND.double, [1, 2, 3, 4]],
    ["R", COMMAND.real, [0, 0, 0x48, 0x41]],
    ["M", COMMAND.register, [0x34, 0x12]],
    ["S", COMMAND.string, [...textBytes("HELLO", 16)]],
  ])("variable %s is written and read, alone and many at once", async (_, command, value) => {
    const { read, order, raw } = await cabinet();
    expect((await read(command, 7, 1))!.data).toEqual(new Uint8Array(value.length));
    expect(await order(command, 7, Uint8Array.from(value))).toMatchObject(OK);
    expect((await read(command, 7, 1))!.data).toEqual(Uint8Array.from(value));
    const many = new Uint8Array(4 + 2 * value.length);
    putU32(many, 0, 2);
    many.set(value, 4);
    expect(
      await raw.ask({ id: 90, command: command + PLURAL, instance: 8, service: SERVICE.setMany, data: many }),
    ).toMatchObject(OK);
    const got = await raw.ask({
      id: 91,
      command: command + PLURAL,
      instance: 7,
      service: SERVICE.getMany,
      data: word(2),
    });
    expect([...got!.data]).toEqual([2, 0, 0, 0, ...value, ...value]);
    expect(
      await raw.ask({ command: command + PLURAL, instance: 999, service: SERVICE.getMany, data: word(2) }),
    ).toMatchObject({ status: 0x28 });
    expect(await read(command, 1000, 1)).toMatchObject({ status: 0x28 });
    expect(await read(command, 7, 2)).toMatchObject({ status: 9 });
  });

  test("position variables: not set, set whole, a word at a time; a type there is not is refused", async () => {
    const { read, order } = await cabinet();
    const value = writePosition({ ...noPosition(), type: 16, axes: Int32Array.of(1, -2, 3, 4, 5, 6, 0, 0) });
    expect(await read(COMMAND.robotPosition, 3)).toMatchObject(refused(0xb001));
    expect(await order(COMMAND.robotPosition, 3, value, 0, SERVICE.setAll)).toMatchObject(OK);
    expect((await read(COMMAND.robotPosition, 3))!.data).toEqual(value);
    expect((await read(COMMAND.robotPosition, 3, 7))!.data).toEqual(Uint8Array.of(0xfe, 0xff, 0xff, 0xff));
    value[0] = 99;
    expect(await order(COMMAND.robotPosition, 3, value, 0, SERVICE.setAll)).toMatchObject(refused(0xb00c));
  });

  test("of the groups of lines only network inputs are written, and the example ladder joins them to the inputs", async () => {
    const { read, order, raw, virtual } = await cabinet();
    expect(await order(COMMAND.io, 2702, Uint8Array.of(0b101))).toMatchObject(OK);
    expect((await read(COMMAND.io, 2702, 1))!.data).toEqual(Uint8Array.of(0b101));
    virtual.pendant.setInput(10, true);
    expect((await read(COMMAND.io, 2, 1))!.data).toEqual(Uint8Array.of(0b111));
    for (const group of [1, 1001, 2001, 3001, 3701, 4001, 5001, 7001, 8001])
      expect(await order(COMMAND.io, group, Uint8Array.of(1))).toMatchObject(refused(0x2110));
    expect(await order(COMMAND.io, 999, Uint8Array.of(1))).toMatchObject({ status: 0x28 });
    const many = await raw.ask({
      command: COMMAND.io + PLURAL,
      instance: 2701,
      service: SERVICE.getMany,
      data: word(2),
    });
    expect([...many!.data]).toEqual([2, 0, 0, 0, 0, 0b101]);
    expect(
      await raw.ask({ command: COMMAND.io + PLURAL, instance: 2701, service: SERVICE.getMany, data: word(3) }),
    ).toMatchObject(refused(0xb004));
    expect(
      await raw.ask({ command: COMMAND.double + PLURAL, instance: 0, service: SERVICE.getMany, data: word(100) }),
    ).toMatchObject({ status: 0 });
    expect(
      await raw.ask({ command: COMMAND.string + PLURAL, instance: 0, service: SERVICE.getMany, data: word(30) }),
    ).toMatchObject(refused(0xa100));
  });

  test("position in pulses and in the base frame, axis names, model, speed override", async () => {
    const { read, virtual } = await cabinet({ start_rad: [Math.PI / 180, 0, 0, 0, -Math.PI / 2, 0] });
    const pulses = noPosition();
    const place = noPosition();
    readPosition((await read(COMMAND.position, 1))!.data, pulses);
    expect([...pulses.axes]).toEqual([1340, 0, 0, 0, -90_000, 0, 0, 0]);
    readPosition((await read(COMMAND.position, 101))!.data, place);
    // 40 + 340 mm ahead of axis 1 turned by a degree; the wrist hangs down by 80 mm from 345 + 40 above axis 2, from
    // where the controller counts.
    expect([place.type, ...place.axes]).toEqual([
      16,
      379_942,
      6632,
      305_000,
      1_800_000,
      0,
      expect.closeTo(10_000, 0),
      0,
      0,
    ]);
    expect(textAt((await read(COMMAND.axisNames, 1))!.data, 8, 4)).toBe("U");
    expect(textAt((await read(COMMAND.systemInfo, 11, 2))!.data, 0, 16)).toBe("YASKAWA GP8");
    virtual.pendant.setOverride(30);
    expect(readJob((await read(COMMAND.job, 1))!.data)?.override).toBe(0.3);
    expect((await read(COMMAND.status, 1, 2))!.data).toEqual(Uint8Array.of(0x40, 0, 0, 0));
    for (const [command, instance] of [
      [COMMAND.position, 2],
      [COMMAND.alarm, 5],
      [COMMAND.systemInfo, 12],
      [COMMAND.status, 2],
    ] as const)
      expect(await read(command, instance)).toMatchObject({ status: 0x28 });
    expect(await read(0x6f, 1)).toMatchObject({ status: 8, added: 0xa000 });
    expect(await read(COMMAND.status, 1, 3)).toMatchObject({ status: 9 });
  });

  test("moves with wrong numbers are refused by their codes, and nothing moves", async () => {
    const { order, move, j1, status, raw, virtual } = await cabinet();
    const pulse = (change: Partial<Parameters<typeof writePulseMove>[0]>) =>
      order(
        COMMAND.movePulse,
        1,
        writePulseMove({ robot: 1, station: 0, speedClass: 0, speed: 100, axes: [0], tool: 0, ...change }),
        1,
        SERVICE.setAll,
      );
    expect(await pulse({ robot: 3 })).toMatchObject(refused(0xb008));
    expect(await pulse({ speed: 0 })).toMatchObject(refused(0xb009));
    expect(await pulse({ speed: 10_001 })).toMatchObject(refused(0xb009));
    expect(await pulse({ speedClass: 1 })).toMatchObject(refused(0xb009));
    expect(await pulse({ tool: 9 })).toMatchObject(refused(0xb00d));
    expect(await pulse({ axes: [1340 * 171] })).toMatchObject(refused(0xb004));
    expect(await move(turned(0), 100, 7)).toMatchObject(refused(0xa001));
    expect(
      await raw.ask({
        id: 77,
        command: COMMAND.movePulse,
        instance: 1,
        attribute: 1,
        service: SERVICE.setAll,
        data: new Uint8Array(12),
      }),
    ).toMatchObject(refused(0xb003));
    expect(await status()).toMatchObject({ running: false, alarm: false });
    expect(j1()).toBe(virtual.robot.home_rad[0]);
  });
});

describe("a virtual Yaskawa controller: the line", () => {
  test("an order that comes twice with one id is carried out once; of a client that never changes its id every order counts", async () => {
    const made = await cabinet();
    const { raw, scheduler, virtual } = made;
    const start = (id: number) =>
      raw.ask({ id, command: COMMAND.start, instance: 1, attribute: 1, service: SERVICE.setOne, data: word(1) });
    virtual.files.save("ONE.JBI", job("ONE", "W 0.05"));
    virtual.pendant.select("ONE");
    await raw.ask({ id: 1, command: COMMAND.status, instance: 1, service: SERVICE.getAll });
    expect(await start(2)).toMatchObject(OK);
    // Refused as running if it were carried out again.
    expect(await start(2)).toMatchObject(OK);
    expect(await start(3)).toMatchObject(refused(0x2010));
    await scheduler.elapse(3);
    const plain = await rawClient(made);
    const again = () =>
      plain.ask({ id: 0, command: COMMAND.start, instance: 1, attribute: 1, service: SERVICE.setOne, data: word(1) });
    expect(await again()).toMatchObject(OK);
    expect(await again()).toMatchObject(refused(0x2010));
  });

  test("any bytes on either port: no crash, answered by their code or not at all, logged once", async () => {
    const made = await cabinet();
    const { raw, filing, scheduler, log, status, read } = made;
    let seed = 1;
    const random = (below: number): number => {
      seed = (seed * 48_271) % 2_147_483_647;
      return seed % below;
    };
    for (let i = 0; i < 3000; i++) {
      const bytes = Uint8Array.from({ length: random(520) }, () => random(256));
      if (i % 2 === 0 && bytes.length >= 32)
        bytes.set([
          0x59,
          0x45,
          0x52,
          0x43,
          0x20,
          0,
          (bytes.length - 32) & 255,
          (bytes.length - 32) >> 8,
          3,
          i % 4 === 0 ? 1 : 2,
          random(3),
          random(256),
          0,
          0,
          0,
          0,
        ]);
      (i % 4 === 0 ? raw : filing).send(bytes);
      if (i % 50 === 0) await scheduler.elapse(0.002);
    }
    await scheduler.elapse(0.1);
    expect(log.length).toBeGreaterThan(3);
    expect(log.length).toBeLessThanOrEqual(100);
    expect(new Set(log).size).toBe(log.length);
    expect(await status()).toMatchObject({ servo: true });
    expect((await read(COMMAND.position, 1))!.data.length).toBe(52);
    expect(
      await raw.ask({ division: DIVISION.file, service: SERVICE.listFiles, data: textBytes("*.JBI") }),
    ).toMatchObject({ status: 0x1f, added: 0xe4a3 });
  });

  test("faults by switch: silence, loss, wrong ids, late answers; a restart forgets orders and keeps jobs", async () => {
    const { virtual, raw, scheduler, status, servo } = await cabinet();
    const ask = () => raw.ask({ id: 5, command: COMMAND.status, instance: 1, service: SERVICE.getAll });
    virtual.faults.frozen = true;
    expect(await ask()).toBeNull();
    virtual.faults.frozen = false;
    virtual.faults.wrongId = 1;
    expect((await ask())?.id).not.toBe(5);
    virtual.faults.wrongId = 0;
    virtual.faults.loss = 1;
    expect(await ask()).toBeNull();
    virtual.faults.loss = 0;
    virtual.faults.delay_s = 0.05;
    expect(await ask()).toBeNull();
    const before = raw.answers.length;
    await scheduler.elapse(0.06);
    expect(raw.answers.length).toBe(before + 1);
    virtual.faults.delay_s = 0;
    virtual.faults.duplicates = 1;
    await ask();
    expect(raw.answers.length).toBe(before + 3);
    virtual.faults.duplicates = 0;
    virtual.files.save("KEPT.JBI", job("KEPT"));
    virtual.reboot(1);
    expect(await ask()).toBeNull();
    await scheduler.elapse(1.1);
    expect(await status()).toMatchObject({ servo: false, running: false });
    expect(virtual.files.read("KEPT.JBI")).toBeDefined();
    expect(await servo(true)).toMatchObject(OK);
  });
});
