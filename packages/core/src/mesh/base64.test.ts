import fc from "fast-check";
import { expect, test } from "vitest";
import { fromBase64, toBase64 } from "./base64.ts";

test("base64 agrees with Node's and comes back", () => {
  fc.assert(
    fc.property(fc.uint8Array({ maxLength: 100 }), bytes => {
      const text = toBase64(bytes);
      expect(text).toBe(Buffer.from(bytes).toString("base64"));
      expect(fromBase64(text)).toEqual(bytes);
    }),
    { seed: 1, numRuns: 200 },
  );
  const long = Uint8Array.from({ length: 20_000 }, (_, i) => (i * 7919) & 255);
  expect(toBase64(long)).toBe(Buffer.from(long).toString("base64"));
});

test("what is not canonical base64 is refused", () => {
  for (const text of ["A", "AB", "ABC", "AB=C", "====", "A===", "AB\n=", "Zé==", "AB=="])
    expect(fromBase64(text), text).toBeUndefined();
  expect(fromBase64("AA==")).toEqual(Uint8Array.of(0));
});
