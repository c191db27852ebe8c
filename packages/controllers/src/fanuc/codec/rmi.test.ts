import { seededRandom } from "@twincell/core";
import { expect, test } from "vitest";
import { jointPart, readRmi, RmiReader, rmiErrorWords, rmiJoints, rmiNumber, rmiText } from "./rmi.ts";

/** Written out by hand after the facts, not by our encoder. */
const LINES = [
  '{"Communication":"FRC_Connect"}\r\n',
  '{"Command":"FRC_SetOverRide","Value":50}\r\n',
  '{"Instruction":"FRC_JointMotionJRep","SequenceID":3,"JointAngle":{"J1":10,"J2":-5.5,"J3":0,"J4":0,"J5":0,"J6":0,"J7":0,"J8":0,"J9":0},"SpeedType":"Percent","Speed":20,"TermType":"FINE","TermValue":100}\r\n',
];
const bytes = (text: string): Uint8Array => Uint8Array.from(text, sign => sign.charCodeAt(0));

test("packets, character by character, there and back", () => {
  for (const line of LINES) expect(rmiText(readRmi(line)!)).toBe(line);
  expect(
    rmiText({
      key: "Instruction",
      name: "FRC_JointMotionJRep",
      fields: {
        SequenceID: 3,
        JointAngle: jointPart([10, -5.5, 0, 0, 0, -0], 6),
        SpeedType: "Percent",
        Speed: 20,
        TermType: "FINE",
        TermValue: 100,
      },
    }),
  ).toBe(LINES[2]);
  const out = new Float64Array(6);
  expect(rmiJoints(readRmi(LINES[2]!)!.fields, out)).toBe(true);
  expect([...out]).toEqual([10, -5.5, 0, 0, 0, 0]);
  expect(rmiJoints({ JointAngles: jointPart([1, 2, 3, 4, 5, 6], 3) }, out)).toBe(true);
  expect([rmiJoints({}, out), rmiJoints({ JointAngle: { J1: "1" } }, out), rmiNumber({ a: "1" }, "a")]).toEqual([
    false,
    false,
    NaN,
  ]);
  expect(rmiErrorWords(2556957)).toContain("sequence number");
});

test("in pieces of any size they are the same packets; what is none ends the stream with a sentence, and so does a line without end", () => {
  const stream = bytes(LINES.join(""));
  for (const size of [1, 3, 17, stream.length]) {
    const reader = new RmiReader();
    const got: string[] = [];
    for (let at = 0; at < stream.length; at += size) {
      const lent = stream.slice(at, at + size);
      expect(
        reader.push(lent, packet => {
          got.push(rmiText(packet));
          return true;
        }),
      ).toBeNull();
      lent.fill(0);
    }
    expect(got).toEqual(LINES);
  }
  for (const wrong of [
    "{}\r\n",
    "[1]\r\n",
    "{\r\n",
    '{"Command":1}\r\n',
    '{"Command":"a","Instruction":"b"}\r\n',
    "GET / HTTP/1.1\r\n",
  ])
    expect(
      new RmiReader().push(bytes(wrong), () => true),
      wrong,
    ).toContain("no packet");
  const endless = new RmiReader();
  let why: string | null = null;
  for (let i = 0; i < 70 && why === null; i++) why = endless.push(new Uint8Array(1000).fill(65), () => true);
  expect(why).toContain("more than 65536");
});

test("any bytes: no crash (4,000 inputs)", () => {
  const random = seededRandom(9);
  const signs = '{}[]":,\r\nCommandFRC_0123456789.-eE';
  for (let i = 0; i < 4_000; i++) {
    const text = Array.from(
      { length: Math.floor(random() * 40) },
      () => signs[Math.floor(random() * signs.length)],
    ).join("");
    new RmiReader().push(bytes(text), packet => {
      rmiJoints(packet.fields, new Float64Array(6));
      return true;
    });
  }
});
