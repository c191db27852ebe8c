import { seededRandom } from "@twincell/core";
import { expect, test } from "vitest";
import { boolIn, enumIn, krlReal, krlStruct, krlText, numberIn, partsIn, readKrlValue, textIn } from "./values.ts";

test("values as controllers print them", () => {
  expect(numberIn("12.5")).toBe(12.5);
  expect(numberIn(" -1.5E-3 ")).toBe(-0.0015);
  expect(numberIn("'B010010'")).toBe(18);
  expect(numberIn("'H1A'")).toBe(26);
  expect(numberIn("TRUE")).toBeNaN();
  expect(boolIn("TRUE")).toBe(true);
  expect(boolIn("false")).toBe(false);
  expect(boolIn("1")).toBeUndefined();
  expect(enumIn("#EX")).toBe("EX");
  expect(enumIn("EX")).toBe("");
  expect(textIn('"KR6"')).toBe("KR6");
  expect(textIn("KR6")).toBe("KR6");
});

test("structures, with their type and without, in any order and case", () => {
  const out = new Float64Array(3);
  expect(partsIn("{E6AXIS: A1 0.0, A2 -90.0, A3 90.0, A4 1, E1 0.0}", ["A1", "A2", "A3"], out)).toBe(true);
  expect([...out]).toEqual([0, -90, 90]);
  expect(partsIn("{a3 1,a1 2,a2 3}", ["A1", "A2", "A3"], out)).toBe(true);
  expect([...out]).toEqual([2, 3, 1]);
  expect(partsIn("{A1 1,A2 2}", ["A1", "A2", "A3"], out)).toBe(false);
  expect(partsIn("12", ["A1"], out)).toBe(false);
  expect(readKrlValue('{PDAT: VEL 100.0,MODE #CPTP,ON TRUE,AT {X 1,Y 2},POINT[] " "}')).toMatchObject({
    kind: "value",
    value: { kind: "struct", type: "PDAT" },
  });
});

test("written with seven digits, as a 32-bit REAL holds them, or as many as asked for", () => {
  expect(krlReal(-90)).toBe("-90.0");
  expect(krlReal(-0)).toBe("0.0");
  expect(krlReal(123.456789)).toBe("123.4568");
  expect(krlReal(123.456789, 12)).toBe("123.456789");
  expect(krlReal(1e-9)).toBe("1E-9");
  expect(
    krlStruct(
      "E6POS",
      [
        ["X", 1.5],
        ["S", 2],
        ["T", 35],
      ],
      7,
      ["S", "T"],
    ),
  ).toBe("{E6POS: X 1.5, S 2, T 35}");
  expect(krlText('a "b"')).toBe("\"a 'b'\"");
});

test("T-23 an axis written and read again is off by less than 0.0001°, 20,000 angles", () => {
  const random = seededRandom(7);
  const out = new Float64Array(1);
  for (let i = 0; i < 20_000; i++) {
    const angle = 720 * random() - 360;
    expect(partsIn(krlStruct("E6AXIS", [["A1", angle]]), ["A1"], out)).toBe(true);
    expect(Math.abs(out[0]! - angle)).toBeLessThan(1e-4);
  }
});

test("what is no value says where and what was expected", () => {
  expect(readKrlValue("{A1 1")).toEqual({ kind: "not-understood", column: 6, expected: "a comma or a closing brace" });
  expect(readKrlValue("1 2")).toEqual({ kind: "not-understood", column: 3, expected: "the end" });
  expect(readKrlValue("{A {A {A {A {A {A {A {A {A 1}}}}}}}}}").kind).toBe("not-understood");
  expect(readKrlValue("1e999").kind).toBe("not-understood");
});

test("any text: an answer, never an exception (20,000 inputs)", () => {
  const random = seededRandom(3);
  const signs = "{}:,#\"' A1.-+E\tXYZTRUEFALSE$[]0é";
  for (let i = 0; i < 20_000; i++) {
    const text = Array.from(
      { length: Math.floor(random() * 40) },
      () => signs[Math.floor(random() * signs.length)],
    ).join("");
    expect(["value", "not-understood"]).toContain(readKrlValue(text).kind);
  }
});
