import { robotById } from "@twincell/core";
import fc from "fast-check";
import { describe, expect, test } from "vitest";
import * as codec from "./index.ts";
import { COMMAND, DIVISION, SERVICE } from "./index.ts";

/** Hexadecimal with spaces, as the facts are written. */
const bytes = (text: string): Uint8Array => Uint8Array.from(text.trim().split(/\s+/), value => parseInt(value, 16));
const NONE = new Uint8Array(0);
const robot = robotById("yaskawa_gp8")!;

// Written out from the description of the protocol, not by our encoder: a fault shared by both directions cannot hide.
const ASK_STATUS = bytes(
  "59 45 52 43 20 00 00 00 03 01 00 07 00 00 00 00 39 39 39 39 39 39 39 39 72 00 01 00 00 01 00 00",
);
const STATUS_REMOTE_RUNNING_SERVO = bytes(
  "59 45 52 43 20 00 08 00 03 01 01 07 00 00 00 80 39 39 39 39 39 39 39 39 81 00 00 00 00 00 00 00 CA 00 00 00 40 00 00 00",
);
const REFUSED_NO_JOB = bytes(
  "59 45 52 43 20 00 00 00 03 01 01 09 00 00 00 80 39 39 39 39 39 39 39 39 82 1F 01 00 40 40 00 00",
);
const SERVO_ON = bytes(
  "59 45 52 43 20 00 04 00 03 01 00 FF 00 00 00 00 39 39 39 39 39 39 39 39 83 00 02 00 01 10 00 00 01 00 00 00",
);
const LAST_FILE_BLOCK = bytes(
  "59 45 52 43 20 00 03 00 03 02 01 00 03 00 00 80 39 39 39 39 39 39 39 39 00 00 00 00 00 15 00 00 45 4E 44",
);

const written = (write: (out: Uint8Array) => number): Uint8Array => {
  const out = new Uint8Array(600).fill(0xaa);
  return out.subarray(0, write(out));
};

describe("HSES packets against bytes written out by hand", () => {
  test("the question for the status, servo on, and the last block of a file", () => {
    const ask = {
      division: DIVISION.robot,
      ack: false,
      id: 7,
      block: 0,
      command: COMMAND.status,
      instance: 1,
      attribute: 0,
      service: SERVICE.getAll,
      data: NONE,
    };
    expect(written(out => codec.writeRequest(ask, out))).toEqual(ASK_STATUS);
    expect(codec.readRequest(ASK_STATUS)).toEqual({ kind: "packet", packet: ask });
    const servo = {
      ...ask,
      id: 255,
      command: COMMAND.power,
      instance: 2,
      attribute: 1,
      service: SERVICE.setOne,
      data: codec.word(1),
    };
    expect(written(out => codec.writeRequest(servo, out))).toEqual(SERVO_ON);
    expect(codec.readRequest(SERVO_ON)).toEqual({ kind: "packet", packet: servo });
    const block = {
      division: DIVISION.file,
      ack: true,
      id: 0,
      block: 0x8000_0003,
      command: 0,
      instance: 0,
      attribute: 0,
      service: SERVICE.saveFile,
      data: bytes("45 4E 44"),
    };
    expect(written(out => codec.writeRequest(block, out))).toEqual(LAST_FILE_BLOCK);
    expect(codec.readRequest(LAST_FILE_BLOCK)).toEqual({ kind: "packet", packet: block });
  });

  test("an answer with flags, and a refusal with its added status", () => {
    const answer = {
      division: DIVISION.robot,
      id: 7,
      block: 0x8000_0000,
      service: SERVICE.getAll,
      status: 0,
      added: 0,
      data: bytes("CA 00 00 00 40 00 00 00"),
    };
    expect(written(out => codec.writeReply(answer, out))).toEqual(STATUS_REMOTE_RUNNING_SERVO);
    expect(codec.readReply(STATUS_REMOTE_RUNNING_SERVO)).toEqual({ kind: "packet", packet: answer });
    const refusal = {
      division: DIVISION.robot,
      id: 9,
      block: 0x8000_0000,
      service: SERVICE.setAll,
      status: 0x1f,
      added: 0x4040,
      data: NONE,
    };
    expect(written(out => codec.writeReply(refusal, out))).toEqual(REFUSED_NO_JOB);
    expect(codec.readReply(REFUSED_NO_JOB)).toEqual({ kind: "packet", packet: refusal });
    expect(codec.refusalSentence(0x1f, 0x4040)).toBe("There is no such job. (status 1F, 4040)");
  });

  test("flags of the status", () => {
    const status = codec.noStatus();
    expect(codec.readStatus(bytes("CA 00 00 00 40 00 00 00"), status)).toBe(true);
    expect(status).toEqual({ ...codec.noStatus(), once: true, running: true, play: true, remote: true, servo: true });
    expect(codec.readStatus(bytes("31 00 00 00 3E 00 00 00"), status)).toBe(true);
    expect(status).toEqual({
      ...codec.noStatus(),
      step: true,
      slow: true,
      teach: true,
      heldByPendant: true,
      heldOutside: true,
      heldByCommand: true,
      alarm: true,
      error: true,
    });
    expect(codec.writeStatus(status)).toEqual(bytes("31 00 00 00 3E 00 00 00"));
    expect(codec.readStatus(bytes("31 00 00 00"), status)).toBe(false);
  });

  test("a position in pulses, a job being executed, an alarm", () => {
    const data = bytes(`00 00 00 00 05 00 00 00 02 00 00 00 00 00 00 00 00 00 00 00
      3C 05 00 00 C4 FA FF FF 00 00 00 00 E8 03 00 00 18 FC FF FF 6C 02 00 00 00 00 00 00 00 00 00 00`);
    const position = codec.noPosition();
    expect(codec.readPosition(data, position)).toBe(true);
    expect(position).toEqual({
      type: 0,
      form: 5,
      tool: 2,
      user: 0,
      extendedForm: 0,
      axes: Int32Array.of(1340, -1340, 0, 1000, -1000, 620, 0, 0),
    });
    expect(codec.writePosition(position)).toEqual(data);
    const job = new Uint8Array(44);
    job.set(bytes("50 49 43 4B"), 0);
    job.set(bytes("0C 00 00 00 03 00 00 00 88 13 00 00"), 32);
    expect(codec.readJob(job)).toEqual({ job: "PICK", line: 12, step: 3, override: 0.5 });
    expect(codec.writeJob({ job: "PICK", line: 12, step: 3, override: 0.5 })).toEqual(job);
    const alarm = new Uint8Array(60);
    alarm.set(
      bytes("46 11 00 00 01 00 00 00 05 00 00 00 32 30 32 36 2F 31 31 2F 32 32 20 31 33 3A 30 30 53 45 52 56 4F"),
      0,
    );
    expect(codec.readAlarm(alarm)).toEqual({ code: 4422, data: 1, type: 5, time: "2026/11/22 13:00", name: "SERVO" });
    expect(codec.writeAlarm(codec.readAlarm(alarm))).toEqual(alarm);
    expect(codec.writeAlarm(undefined)).toEqual(new Uint8Array(60));
    expect(codec.readAlarm(new Uint8Array(60))).toBeUndefined();
  });

  test("moves in pulses and in millimetres", () => {
    const pulses = new Uint8Array(88);
    pulses.set(bytes("01 00 00 00 00 00 00 00 00 00 00 00 88 13 00 00 3C 05 00 00 C4 FA FF FF"), 0);
    pulses.set(bytes("03 00 00 00"), 48);
    const move = {
      robot: 1,
      station: 0,
      speedClass: 0,
      speed: 5000,
      axes: Int32Array.of(1340, -1340, 0, 0, 0, 0, 0, 0),
      tool: 3,
    };
    expect(codec.readPulseMove(pulses)).toEqual(move);
    expect(codec.writePulseMove(move)).toEqual(pulses);
    const straight = new Uint8Array(104);
    straight.set(
      bytes(
        "01 00 00 00 00 00 00 00 01 00 00 00 C4 09 00 00 10 00 00 00 20 A1 07 00 60 79 FE FF 00 00 00 00 40 77 1B 00",
      ),
      0,
    );
    straight.set(bytes("04 00 00 00"), 52);
    straight.set(bytes("02 00 00 00 01 00 00 00"), 60);
    const line = {
      robot: 1,
      station: 0,
      speedClass: 1,
      speed: 2500,
      frame: 16,
      place: Int32Array.of(500_000, -100_000, 0, 1_800_000, 0, 0, 0),
      form: 4,
      extendedForm: 0,
      tool: 2,
      user: 1,
    };
    expect(codec.readCartesianMove(straight)).toEqual(line);
    expect(codec.writeCartesianMove(line)).toEqual(straight);
    expect(codec.readPulseMove(pulses.subarray(0, 51))).toBeUndefined();
    expect(codec.readCartesianMove(straight.subarray(0, 67))).toBeUndefined();
    expect(codec.readSelection(codec.writeSelection("PICK", 4))).toEqual({ job: "PICK", line: 4 });
  });

  test("numbers of groups and lines", () => {
    expect(codec.lineAt(27013)).toEqual({ group: 2701, bit: 3 });
    expect(codec.lineAt(27018)).toBeUndefined();
    expect(codec.ioGroupOf(2701)?.name).toBe("network input");
    expect(codec.ioGroupOf(600)).toBeUndefined();
  });
});

describe("what is no packet", () => {
  const damaged = (at: number, to: number): Uint8Array => {
    const copy = ASK_STATUS.slice();
    copy[at] = to;
    return copy;
  };
  test.each([
    ["shorter than a header", ASK_STATUS.subarray(0, 31), 0xe49d],
    ["another beginning", damaged(0, 0x58), 0xe4a6],
    ["another size of header", damaged(4, 0x21), 0xe49d],
    ["data that did not come", damaged(6, 4), 0xe4a7],
    ["a division there is not", damaged(9, 3), 0xe4a3],
    ["a wrong acknowledgement", damaged(10, 2), 0xe4a2],
    ["a request that is a block", damaged(12, 1), 0xe4a1],
  ])("%s is named with its code", (_, packet, added) => {
    const read = codec.readRequest(packet);
    expect(read).toMatchObject({ kind: "flawed", added });
    expect(read.kind === "flawed" && read.sentence).toMatch(/^[A-Z].*\.$/);
  });

  test("any bytes are a packet or one sentence, 20,000 of them", () => {
    const near = fc
      .tuple(
        fc.constantFrom(ASK_STATUS, STATUS_REMOTE_RUNNING_SERVO, SERVO_ON, LAST_FILE_BLOCK),
        fc.array(fc.tuple(fc.nat(40), fc.nat(255)), { maxLength: 4 }),
        fc.nat(60),
      )
      .map(([base, changes, length]) => {
        const copy = base.slice(0, Math.max(0, length));
        for (const [at, to] of changes) if (at < copy.length) copy[at] = to;
        return copy;
      });
    fc.assert(
      fc.property(fc.oneof(fc.uint8Array({ maxLength: 600 }), near), packet => {
        for (const read of [codec.readRequest(packet), codec.readReply(packet)]) {
          if (read.kind === "flawed") expect(read.sentence).toMatch(/^[A-Z].*\.$/);
          else expect(read.packet.data.length).toBeLessThanOrEqual(codec.MAX_DATA_BYTES);
        }
        codec.readAlarm(packet);
        codec.readJob(packet);
        codec.readPulseMove(packet);
        codec.readCartesianMove(packet);
        codec.readSelection(packet);
        codec.readStatus(packet, codec.noStatus());
        codec.readPosition(packet, codec.noPosition());
      }),
      { numRuns: 20_000, seed: 1 },
    );
  });
});

describe("pulses", () => {
  const scale = codec.exampleScale(robot);
  test("a degree of each axis is so many pulses, with sign and zero where a controller has them", () => {
    expect([
      ...codec.pulsesOf(
        [Math.PI / 180, Math.PI / 180, -Math.PI / 180, Math.PI / 2, 0, -Math.PI],
        scale,
        new Int32Array(8),
      ),
    ]).toEqual([1340, 1340, -1340, 90_000, 0, -111_600, 0, 0]);
    const { axes } = scale.counting;
    const turned = { ...scale, counting: { axes: axes.with(1, { name: "L", sign: -1, zero_deg: 90 }) } };
    expect(codec.pulsesOf([0, Math.PI / 6, 0, 0, 0, 0], turned, new Int32Array(8))[1]).toBe(80_400);
    expect(codec.radiansOf(Int32Array.of(0, 80_400), turned, robot, new Float64Array(6))[1]).toBeCloseTo(
      Math.PI / 6,
      12,
    );
  });

  test("T-23 what pulses can say: half a pulse is 0.00037° to 0.00081°, below 0.001° on every axis", () => {
    const half_deg = codec.resolution_rad(scale).map(value => (value * 180) / Math.PI);
    expect(Math.max(...half_deg)).toBeCloseTo(0.5 / 620, 12);
    expect(Math.max(...half_deg)).toBeLessThan(0.001);
    fc.assert(
      fc.property(fc.array(fc.double({ min: 0, max: 1, noNaN: true }), { minLength: 6, maxLength: 6 }), parts => {
        const q = robot.arm.joints.map(
          ({ limits }, i) => limits.lower_rad + parts[i]! * (limits.upper_rad - limits.lower_rad),
        );
        const back = codec.radiansOf(codec.pulsesOf(q, scale, new Int32Array(8)), scale, robot, new Float64Array(6));
        robot.arm.joints.forEach(({ limits }, i) => {
          expect((Math.abs(back[i]! - q[i]!) * 180) / Math.PI).toBeLessThanOrEqual(half_deg[i]! + 1e-9);
          expect(back[i]! >= limits.lower_rad && back[i]! <= limits.upper_rad).toBe(true);
        });
      }),
      { numRuns: 2000, seed: 23 },
    );
  });

  test("poses in µm and 0.0001°", () => {
    const place = codec.placeOf({ position: [0.5, -0.1, 0.25], quaternion: [1, 0, 0, 0] }, new Int32Array(7));
    expect([...place]).toEqual([500_000, -100_000, 250_000, 1_800_000, 0, 0, 0]);
    expect(codec.poseAt(place).position).toEqual([0.5, -0.1, 0.25]);
  });

  test("posture words: as the arm stands at home, turned over backwards, with R folded", () => {
    expect(codec.formOf(robot, robot.home_rad)).toBe(0);
    expect(codec.formOf(robot, [0, 0, 0, Math.PI, 1, 0])).toBe(0b1100);
    expect(codec.formOf(robot, [0, 0, 0, 0, 1, 3.5])).toBe(0b1_0000);
    expect(codec.formOf(robot, [0, -1.1, 2.5, 0, 1, 0]) & 1).toBe(1);
  });
});
