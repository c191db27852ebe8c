import { expect, test } from "vitest";
import { momentFrom, momentHash } from "./moment-link.ts";

test("a moment goes into an address and comes out of it as it was", () => {
  for (const link of [
    { recording: "2026-11-22T13-00-00-000Z", t_s: 0 },
    { recording: "Zelle 1 · α & β#.mcap", t_s: 86_399.123 },
  ])
    expect(momentFrom(momentHash(link))).toEqual(link);
  expect(momentHash({ recording: "a b", t_s: 1.23456 })).toBe("#moment=a%20b&t=1.235");
});
test("an address that says something else is no moment", () => {
  for (const hash of [
    "",
    "#",
    "#moment=",
    "#t=3",
    "#moment=a&t=NaN",
    "#moment=a&t=-1",
    "#moment=a&t=1e999",
    "#program",
  ])
    expect(momentFrom(hash)).toBeNull();
});
