import { seededRandom } from "@twincell/core";
import { describe, expect, test } from "vitest";
import {
  COMM,
  jointsBytes,
  MessageReader,
  noPoint,
  noStatus,
  pointBytes,
  readFullPoint,
  readJoints,
  readPoint,
  readStatus,
  REPLY,
  SEQUENCE,
  statusBytes,
} from "./simple-message.ts";

/** Written out by hand after the VAL 3 source of ros_server, not by our encoder. */
const hex = (text: string): Uint8Array => Uint8Array.from(text.trim().split(/\s+/), byte => parseInt(byte, 16));
const ZERO = "00 00 00 00 ";
/**
 * Length 64, type 11, request, no reply code; sequence 7; 1, −0.5, 0.25, 2, 0, 0 rad and four joints that are not
 * there; half the speed; 1.5 s.
 */
const POINT = hex(`40 00 00 00  0b 00 00 00  02 00 00 00  00 00 00 00  07 00 00 00
  00 00 80 3f  00 00 00 bf  00 00 80 3e  00 00 00 40  ${ZERO.repeat(6)} 00 00 00 3f  00 00 c0 3f`);
/** Length 64, type 11, request; sequence −4 and zeros. */
const STOP = hex(`40 00 00 00  0b 00 00 00  02 00 00 00  00 00 00 00  fc ff ff ff  ${ZERO.repeat(12)}`);
/** Length 56, type 10, topic; sequence 0; joints. */
const JOINTS = hex(
  `38 00 00 00  0a 00 00 00  01 00 00 00  00 00 00 00  ${ZERO}  00 00 80 3f  00 00 00 bf  00 00 80 3e  00 00 00 40  ${ZERO.repeat(6)}`,
);
/** Length 40, type 13, topic; powered, no emergency stop, no error, in motion, automatic, motion possible. */
const STATUS = hex(
  `28 00 00 00  0d 00 00 00  01 00 00 00  00 00 00 00  01 00 00 00 ${ZERO.repeat(3)} 01 00 00 00  02 00 00 00  01 00 00 00`,
);
/** Length 148, type 14, request; robot 3, sequence 9, time 2 s, first position 1 rad, first speed a half. */
const FULL = hex(
  `94 00 00 00  0e 00 00 00  02 00 00 00  00 00 00 00  03 00 00 00  09 00 00 00  07 00 00 00  00 00 00 40  00 00 80 3f ${ZERO.repeat(9)} 00 00 00 3f ${ZERO.repeat(19)}`,
);
const Q = [1, -0.5, 0.25, 2, 0, 0];

const all = (bytes: Uint8Array, size = bytes.length): number[][] => {
  const reader = new MessageReader();
  const got: number[][] = [];
  for (let at = 0; at < bytes.length; at += size) {
    const lent = bytes.slice(at, at + size);
    expect(
      reader.push(lent, ({ type, comm, reply }) => {
        got.push([type, comm, reply]);
        return true;
      }),
    ).toBeNull();
    lent.fill(255);
  }
  return got;
};

describe("simple_message, byte by byte", () => {
  test("points, stops, joints and states are written as the facts have them", () => {
    const point = noPoint();
    point.sequence = 7;
    point.q_rad.set(Q);
    point.velocity = 0.5;
    point.duration_s = 1.5;
    expect(pointBytes(point, COMM.request, REPLY.none)).toEqual(POINT);
    expect(pointBytes({ ...noPoint(), sequence: SEQUENCE.stop }, COMM.request, REPLY.none)).toEqual(STOP);
    expect(jointsBytes(Q)).toEqual(JOINTS);
    expect(
      statusBytes({ powered: true, emergency: false, error: 0, inError: false, moving: true, mode: 2, possible: true }),
    ).toEqual(STATUS);
  });

  test("and read again", () => {
    const point = noPoint();
    const full = noPoint();
    const joints = new Float64Array(10);
    const status = noStatus();
    new MessageReader().push(POINT, message => {
      readPoint(message, point);
      expect(message.fits).toBe(true);
      return true;
    });
    expect(point).toMatchObject({ sequence: 7, velocity: 0.5, duration_s: 1.5 });
    expect([...point.q_rad]).toEqual([...Q, 0, 0, 0, 0]);
    new MessageReader().push(JOINTS, message => {
      readJoints(message, joints);
      return true;
    });
    expect([...joints]).toEqual([...Q, 0, 0, 0, 0]);
    new MessageReader().push(STATUS, message => {
      readStatus(message, status);
      return true;
    });
    expect(status).toEqual({
      powered: true,
      emergency: false,
      error: 0,
      inError: false,
      moving: true,
      mode: 2,
      possible: true,
    });
    // The program takes the number of the robot for the sequence.
    new MessageReader().push(FULL, message => {
      readFullPoint(message, full);
      return true;
    });
    expect([full.sequence, full.q_rad[0], full.velocity]).toEqual([3, 1, 0.5]);
  });

  test("in pieces of any size they are the same messages; a wrong length is told and not minded", () => {
    const stream = Uint8Array.from([...POINT, ...STOP, ...JOINTS, ...STATUS, ...FULL]);
    for (const size of [1, 3, 4, 17, 60, stream.length])
      expect(all(stream, size)).toEqual([
        [11, 2, 0],
        [11, 2, 0],
        [10, 1, 0],
        [13, 1, 0],
        [14, 2, 0],
      ]);
    const wrong = POINT.slice();
    wrong[0] = 8;
    new MessageReader().push(wrong, message => {
      expect(message.fits).toBe(false);
      return true;
    });
  });

  test("an unknown type ends the stream with a sentence, and so does what is neither topic, request nor reply", () => {
    expect(new MessageReader().push(hex("40 00 00 00  0c 00 00 00  02 00 00 00  00 00 00 00"), () => true)).toContain(
      "type 12",
    );
    expect(new MessageReader().push(hex("40 00 00 00  0b 00 00 00  04 00 00 00  00 00 00 00"), () => true)).toContain(
      "meant as 4",
    );
    expect(
      new MessageReader().push(
        Uint8Array.from("GET / HTTP/1.1\r\n", sign => sign.charCodeAt(0)),
        () => true,
      ),
    ).toContain("none of the program's");
  });

  test("any bytes: no crash (4,000 inputs)", () => {
    const random = seededRandom(3);
    const point = noPoint();
    const status = noStatus();
    const joints = new Float64Array(10);
    for (let i = 0; i < 4_000; i++) {
      const bytes = Uint8Array.from({ length: Math.floor(random() * 200) }, () => Math.floor(random() * 256));
      if (random() < 0.7 && bytes.length > 12)
        bytes.set([[10, 11, 13, 14][Math.floor(random() * 4)]!, 0, 0, 0, 1 + Math.floor(random() * 3), 0, 0, 0], 4);
      new MessageReader().push(bytes, message => {
        readPoint(message, point);
        readStatus(message, status);
        readJoints(message, joints);
        readFullPoint(message, point);
        return true;
      });
    }
  });
});
