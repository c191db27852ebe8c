import type { FleetEntry } from "@twincell/protocol";
import { expect, test } from "vitest";
import { figuresOf, inPlace, keyOf, needing, shownRobots } from "./order.ts";

const robot = (name: string, more: Partial<FleetEntry> = {}): FleetEntry => ({
  site: "line1",
  id: name,
  name,
  model: "ur10e",
  vendor: "Universal Robots",
  virtual: true,
  state: "running",
  news: "",
  holder: null,
  use: 0.5,
  use_line: [],
  since_ms: 0,
  url: "",
  roundTrip_s: 0.004,
  heard_ms: 0,
  ...more,
});
const fleet = [
  robot("Weld 10"),
  robot("Weld 2", { state: "stopped", since_ms: 5, news: "Gripper did not close." }),
  robot("Lab", { site: "line2", state: "no-link", use: 0, since_ms: 9, roundTrip_s: null }),
  robot("Bore", { site: "line2", state: "attention", since_ms: 7, roundTrip_s: 0.048 }),
];
const names = (robots: readonly FleetEntry[]): string[] => robots.map(({ name }) => name);
const all = { query: "", state: null, site: "", order: "name" } as const;

test("T-56 a fleet is filtered by state, site and text and ordered by name, site and state, what needs somebody first", () => {
  expect(names(shownRobots(fleet, all))).toEqual(["Bore", "Lab", "Weld 2", "Weld 10"]);
  expect(names(shownRobots(fleet, { ...all, order: "site" }))).toEqual(["Weld 2", "Weld 10", "Bore", "Lab"]);
  expect(names(shownRobots(fleet, { ...all, order: "state" }))).toEqual(["Weld 2", "Bore", "Lab", "Weld 10"]);
  expect(names(shownRobots(fleet, { ...all, query: " GRIPPER " }))).toEqual(["Weld 2"]);
  expect(names(shownRobots(fleet, { ...all, state: "no-link", site: "line1" }))).toEqual([]);
  expect(names(needing(fleet))).toEqual(["Lab", "Bore", "Weld 2"]);
});

test("T-56 its figures are those of its robots, and none are made up without one", () => {
  const { linked, count, use, slowest } = figuresOf(fleet);
  expect([linked, count.running, count.stopped, use, slowest?.name]).toEqual([3, 1, 1, 0.375, "Bore"]);
  expect(figuresOf([])).toMatchObject({ linked: 0, use: null, slowest: null });
});

test("while the pointer is inside nothing changes its place; new ones come last", () => {
  const places = shownRobots(fleet.slice(1), all).map(keyOf);
  const changed = fleet.map(each => ({ ...each, state: "idle" as const }));
  expect(names(inPlace(changed, places))).toEqual(["Bore", "Lab", "Weld 2", "Weld 10"]);
});
