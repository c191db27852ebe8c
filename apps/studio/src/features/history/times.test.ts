import { expect, test } from "vitest";
import { clockOf } from "./times.ts";

test("times read as a person says them", () => {
  expect([0, 9.999, 59.99, 60, 83.45, 3599.96, 3600, 86_399.99].map(clockOf)).toEqual([
    "0.00 s",
    "10.00 s",
    "59.99 s",
    "1:00.0",
    "1:23.4",
    "59:59.9",
    "1:00:00.0",
    "23:59:59.9",
  ]);
});
