import { expect, test } from "vitest";
import { freshness } from "./freshness.ts";

test("X-40 a picture is fresh up to 250 ms, late beyond, and stands still after 1 s without another", () => {
  expect(freshness(null, 5)).toEqual({ kind: "none" });
  expect(freshness({ captured_s: 10, shown_s: 10.25 }, 10.3)).toEqual({ kind: "fresh", age_s: 0.25 });
  expect(freshness({ captured_s: 10, shown_s: 10.5 }, 10.5)).toEqual({ kind: "late", age_s: 0.5 });
  expect(freshness({ captured_s: 10, shown_s: 10.125 }, 11.125).kind).toBe("fresh");
  expect(freshness({ captured_s: 10, shown_s: 10.125 }, 12.5)).toEqual({ kind: "still", still_s: 2.375 });
});

test("X-40 clocks that are a little apart make no picture younger than nothing, and an unknown capture makes none late", () => {
  expect(freshness({ captured_s: 10.002, shown_s: 10 }, 10)).toEqual({ kind: "fresh", age_s: 0 });
  expect(freshness({ captured_s: NaN, shown_s: 10 }, 10)).toEqual({ kind: "fresh", age_s: NaN });
});
