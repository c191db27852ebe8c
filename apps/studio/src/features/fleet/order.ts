import type { FleetEntry } from "@twincell/protocol";

export type FleetState = FleetEntry["state"];
export type Order = "site" | "state" | "name";
/** What needs somebody first. */
export const STATES: readonly FleetState[] = ["stopped", "attention", "no-link", "running", "idle"];
export const keyOf = ({ site, id }: FleetEntry): string => `${site} ${id}`;
const byName = (a: FleetEntry, b: FleetEntry): number => a.name.localeCompare(b.name, undefined, { numeric: true });
const COMPARE: Readonly<Record<Order, (a: FleetEntry, b: FleetEntry) => number>> = {
  name: byName,
  site: (a, b) => a.site.localeCompare(b.site, undefined, { numeric: true }) || byName(a, b),
  state: (a, b) => STATES.indexOf(a.state) - STATES.indexOf(b.state) || byName(a, b),
};

export interface Wish {
  readonly query: string;
  readonly state: FleetState | null;
  /** "" for every site. */
  readonly site: string;
  readonly order: Order;
}
/** The robots that are asked for, in their order. */
export function shownRobots(robots: readonly FleetEntry[], { query, state, site, order }: Wish): FleetEntry[] {
  const asked = query.trim().toLowerCase();
  return robots
    .filter(robot => state === null || robot.state === state)
    .filter(robot => site === "" || robot.site === site)
    .filter(({ name, model, vendor, site: at, news }) =>
      [name, model, vendor, at, news].some(text => text.toLowerCase().includes(asked)),
    )
    .toSorted(COMPARE[order]);
}
/** The same robots in the places they had: nothing jumps under a pointer; new ones come last. */
export function inPlace(robots: readonly FleetEntry[], places: readonly string[]): FleetEntry[] {
  const place = new Map(places.map((key, i) => [key, i]));
  return robots.toSorted((a, b) => (place.get(keyOf(a)) ?? Infinity) - (place.get(keyOf(b)) ?? Infinity));
}
/** What needs somebody, the newest first. */
export const needing = (robots: readonly FleetEntry[]): FleetEntry[] =>
  robots
    .filter(({ state }) => state === "stopped" || state === "attention" || state === "no-link")
    .toSorted((a, b) => b.since_ms - a.since_ms || byName(a, b));

export interface Figures {
  readonly linked: number;
  readonly count: Readonly<Record<FleetState, number>>;
  /** Mean share of the time in motion, 0 … 1; null without a robot. */
  readonly use: number | null;
  readonly slowest: FleetEntry | null;
}
export function figuresOf(robots: readonly FleetEntry[]): Figures {
  const count = Object.fromEntries(STATES.map(state => [state, 0])) as Record<FleetState, number>;
  let slowest: FleetEntry | null = null;
  for (const robot of robots) {
    count[robot.state]++;
    if ((robot.roundTrip_s ?? -1) > (slowest?.roundTrip_s ?? -1)) slowest = robot;
  }
  return {
    linked: robots.length - count["no-link"],
    count,
    use: robots.length === 0 ? null : robots.reduce((sum, { use }) => sum + use, 0) / robots.length,
    slowest,
  };
}
