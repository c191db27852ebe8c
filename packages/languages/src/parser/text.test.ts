import fc from "fast-check";
import { describe, expect, test } from "vitest";
import { asciiText, decimalText, plainText, singleText, textLines } from "./index.ts";

describe("numbers as single-precision controllers print them", () => {
  test.each([
    [67.2654, "67.2654"],
    [-62.22573, "-62.22573"],
    [7.642985, "7.642985"],
    [-164.0191, "-164.0191"],
    [0, "0"],
    [-0, "0"],
    [1e-9, "0.000000001"],
    [0.1, "0.1"],
    [1 / 3, "0.3333333"],
    [123456789, "123456800"],
    [-1e-30, `-0.${"0".repeat(29)}1`],
    [99999.999, "100000"],
    [1e20, "100000000000000000000"],
  ])("%d is %s", (value, text) => {
    expect(singleText(value)).toBe(text);
  });

  test("reading it back is the single-precision number to seven digits", () => {
    fc.assert(
      fc.property(fc.float({ noNaN: true, noDefaultInfinity: true }), value => {
        const text = singleText(value);
        expect(text).toMatch(/^-?[0-9]+(\.[0-9]*[1-9])?$/);
        expect(Number(text)).toBe(Number(Math.fround(value).toPrecision(7)) + 0);
      }),
      { seed: 5, numRuns: 500 },
    );
  });

  test("what is not a number is not written", () => {
    for (const value of [NaN, Infinity, -Infinity, 1e39]) expect(() => singleText(value)).toThrow(RangeError);
    expect(decimalText(12345.678, 3)).toBe("12300");
  });
});

describe("lines", () => {
  test("any line end, and none at the end of the text", () => {
    expect(textLines("a\r\nb\nc\rd\n")).toEqual(["a", "b", "c", "d"]);
    expect(textLines("a\n\n")).toEqual(["a", ""]);
    expect(textLines("")).toEqual([]);
  });

  test("typographic signs become ASCII, one for one", () => {
    expect(plainText("–1\u00a0−2\t—3")).toBe("-1 -2 -3");
    fc.assert(
      fc.property(fc.string({ unit: "binary" }), text => {
        expect(plainText(text)).toHaveLength(text.length);
      }),
      { seed: 6, numRuns: 200 },
    );
  });

  test("names in ASCII", () => {
    expect(asciiText("Stäubli – Größe „A“ ½ 机")).toBe('Staubli - Grosse ?A" 1?2 ?');
  });
});
