import { addCatalogue, catalogueRobots, LIBRARY } from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";
import { expect, test } from "vitest";
import { ANY_ROBOT, fittingRobots, makersOf } from "./choose.ts";

addCatalogue(CATALOGUE);
const ROBOTS = [...LIBRARY, ...catalogueRobots()];
const ids = (wish: Partial<typeof ANY_ROBOT>): string[] =>
  fittingRobots(ROBOTS, { ...ANY_ROBOT, ...wish }).map(({ id }) => id);

test("without a wish all robots stand in their order; words, maker and reach narrow the list", () => {
  expect(ids({})).toEqual(ROBOTS.map(({ id }) => id));
  expect(ids({ search: "ur5e" })).toEqual(["ur5e"]);
  const kuka = fittingRobots(ROBOTS, { ...ANY_ROBOT, maker: "KUKA", reach_m: 1.5 });
  expect(kuka.length).toBeGreaterThan(3);
  for (const { vendor, reach_m } of kuka) {
    expect(vendor).toBe("KUKA");
    expect(reach_m).toBeGreaterThanOrEqual(1.5);
  }
});

test("with a wished payload too small robots are left out and those of unknown payload stand last", () => {
  const found = fittingRobots(ROBOTS, { ...ANY_ROBOT, payload_kg: 9 });
  const first = found.findIndex(({ payload_kg }) => payload_kg === undefined);
  expect(first).toBeGreaterThan(0);
  expect(found.slice(0, first).every(({ payload_kg }) => payload_kg! >= 9)).toBe(true);
  expect(found.slice(first).every(({ payload_kg }) => payload_kg === undefined)).toBe(true);
});

test("makers are listed once each, by name", () => {
  const makers = makersOf(ROBOTS);
  expect(makers).toEqual([...new Set(makers)].toSorted((a, b) => a.localeCompare(b, "en")));
  expect(makers).toContain("Universal Robots");
});
