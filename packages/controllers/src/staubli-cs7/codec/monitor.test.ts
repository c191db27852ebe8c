import { seededRandom } from "@twincell/core";
import { expect, test } from "vitest";
import {
  commandBytes,
  errorOf,
  MonitorReader,
  pointText,
  readPoint,
  readValues,
  readWhere,
  valuesText,
  whereText,
} from "./monitor.ts";

const bytes = (text: string): Uint8Array => Uint8Array.from(text, sign => sign.charCodeAt(0));
/** As a real RX90 said it after DO READY, before and behind it a prompt; written out by hand. */
const WHERE =
  "where\r\n   X         Y         Z         y         p         r       Hand\r\n    -0.077     0.000   985.000   179.999     0.008   179.995     0.000\r\n   J1        J2        J3        J4        J5        J6     \r\n    -0.000   -90.001    89.993     0.000    -0.000    -0.005\r\n.";

test("what is said comes line by line to its prompt, however it arrives; dots inside of lines are none", () => {
  const said = `.${WHERE}LISTR a[1]\r\na[1]=  12.34\r\n.DO MOVE #Q\r\n*Robot power off*\r\n.`;
  for (const size of [1, 3, 7, said.length]) {
    const reader = new MonitorReader();
    const answers: (readonly string[])[] = [];
    for (let at = 0; at < said.length; at += size)
      expect(
        reader.push(bytes(said.slice(at, at + size)), lines => {
          answers.push(lines);
        }),
      ).toBeNull();
    expect(answers.length).toBe(4);
    expect(readWhere(answers[1]!)).toEqual([-0, -90.001, 89.993, 0, -0, -0.005]);
    expect(readValues(answers[2]!)).toEqual([12.34]);
    expect(errorOf(answers[3]!)).toBe("*Robot power off*");
  }
});

test("places and values are written as they are read", () => {
  expect(
    `where\r\n${whereText([-0.077, 0, 985, 179.999, 0.008, 179.995], [-0.0001, -90.001, 89.993, 0, -0.0001, -0.005])}.`,
  ).toBe(WHERE);
  expect(
    valuesText([
      ["STATE(1)", 7],
      ["TWC.DONE", 3],
    ]),
  ).toBe("STATE(1) = 7\r\nTWC.DONE = 3\r\n");
  expect(readValues(["LISTR STATE(1),TWC.DONE", "STATE(1) = 7", "TWC.DONE = 3"])).toEqual([7, 3]);
  expect(commandBytes("WHERE")).toEqual(bytes("WHERE\r"));
  expect(pointText([12.34567, -90, 0, 0, 0, -0.00001])).toBe("#PPOINT(12.3457,-90,0,0,0,0)");
  expect(readPoint("#ppoint( 1, -2.5,3 ,0,0,0)")).toEqual([1, -2.5, 3, 0, 0, 0]);
  for (const wrong of ["#PPOINT()", "#PPOINT(1,,2)", "#PPOINT(a)", "PPOINT(1)"]) expect(readPoint(wrong)).toBeNull();
  expect(readWhere(["WHERE", "nothing"])).toBeNull();
});

test("no terminal: a byte that is no text, a line without end, no prompt: each with its sentence", () => {
  expect(new MonitorReader().push(Uint8Array.of(200), () => undefined)).toContain("byte 200");
  expect(new MonitorReader().push(bytes("A".repeat(600)), () => undefined)).toContain("more than 512");
  expect(new MonitorReader().push(bytes("A\n".repeat(500)), () => undefined)).toContain("without a prompt");
});

test("any text: no crash (4,000 inputs)", () => {
  const random = seededRandom(6);
  const signs = "J1 X=-.0123456789*\r\n#PPOINT(),E";
  for (let i = 0; i < 4_000; i++) {
    const text = Array.from(
      { length: Math.floor(random() * 60) },
      () => signs[Math.floor(random() * signs.length)],
    ).join("");
    new MonitorReader().push(bytes(text), lines => {
      readWhere(lines);
      readValues(lines);
      errorOf(lines);
    });
    readPoint(text);
  }
});
