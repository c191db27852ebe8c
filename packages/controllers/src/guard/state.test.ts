import { describe, expect, test } from "vitest";
import {
  AT_FIRST,
  guardStep,
  mayMove,
  type GuardAnswer,
  type GuardEvent,
  type GuardRules,
  type GuardState,
} from "./state.ts";

const people = ["a", "b"];
const EVENTS: readonly GuardEvent[] = [
  ...people.flatMap(who =>
    (["take", "release", "press", "let-go", "ask", "confirm", "reset"] as const).map(type => ({ type, who })),
  ),
  ...people.flatMap(who => [true, false].map(on => ({ type: "watch" as const, who, on }))),
  { type: "stop", emergency: false },
  { type: "stop", emergency: true },
  { type: "ended" },
  { type: "too-near" },
  { type: "link-lost" },
  { type: "link-back" },
];
interface Edge {
  readonly from: GuardState;
  readonly event: GuardEvent;
  readonly answer: GuardAnswer;
}

/** Every state that can come about, and every step between them. */
function explore(rules: GuardRules): { states: GuardState[]; edges: Edge[] } {
  const known = new Map([[JSON.stringify(AT_FIRST), AT_FIRST]]);
  const edges: Edge[] = [];
  for (const from of known.values()) {
    for (const event of EVENTS) {
      const answer = guardStep(from, event, rules);
      edges.push({ from, event, answer });
      known.set(JSON.stringify(answer.state), answer.state);
    }
  }
  return { states: [...known.values()], edges };
}
const underWay = (state: GuardState): boolean => state.motion === "moving" || state.motion === "returning";

describe.each([{ deadMan: true }, { deadMan: false }])("guard, all states × all events, enabling switch %o", rules => {
  const { states, edges } = explore(rules);

  test("there are many states and the walk is closed", () => {
    expect(states.length).toBeGreaterThan(50);
    expect(edges.length).toBe(states.length * EVENTS.length);
  });
  test("nothing moves without lease, enabling switch and link, nor with the drives off", () => {
    for (const state of states) if (underWay(state)) expect(mayMove(state, rules), JSON.stringify(state)).toBe(true);
    for (const { answer } of edges) {
      if (answer.effects.includes("forward") || answer.effects.includes("return"))
        expect(mayMove(answer.state, rules)).toBe(true);
    }
  });
  test("only the holder's own asking sets a move going; only his confirming or the guard's own stop sends it back", () => {
    for (const { from, event, answer } of edges) {
      if (answer.effects.includes("forward")) expect(event).toEqual({ type: "ask", who: from.holder });
      if (!answer.effects.includes("return")) continue;
      if (event.type === "confirm") expect(event.who).toBe(from.holder);
      else
        expect({ event, motion: from.motion, trip: from.trip }).toEqual({
          event: { type: "ended" },
          motion: "stopping",
          trip: "return-due",
        });
    }
  });
  test("motion never begins from anything but standstill", () => {
    for (const { from, answer } of edges) if (answer.effects.includes("forward")) expect(from.motion).toBe("at-rest");
  });
  test("X-41 a lost link stops, always; after it is back nothing moves until the holder confirms", () => {
    for (const { from, event, answer } of edges) {
      if (event.type === "link-lost" && !from.watching) expect(answer.effects).toContain("stop");
      if (from.link === "up" || answer.state.link !== "up" || from.watching) continue;
      expect(event).toEqual({ type: "confirm", who: from.holder });
      expect(answer.effects).toEqual([]);
    }
  });
  test("anyone stops, in any state, and an emergency stop lasts until reset at rest", () => {
    for (const { from, event, answer } of edges) {
      if (event.type === "stop") {
        expect(answer.effects).toEqual([event.emergency ? "emergency-stop" : "stop"]);
        expect(underWay(answer.state)).toBe(false);
      }
      if (from.emergency && !answer.state.emergency) {
        expect(event).toEqual({ type: "reset", who: from.holder });
        expect(from.motion).toBe("at-rest");
      }
    }
  });
  test("losing what motion needs while under way stops at once", () => {
    for (const { from, answer } of edges) {
      if (underWay(from) && !mayMove(answer.state, rules)) {
        expect(answer.effects.some(effect => effect === "stop" || effect === "emergency-stop")).toBe(true);
        expect(answer.state.motion).toBe("stopping");
      }
    }
  });
  test("what is only watched is left alone: no command, no lease, and of itself the guard sends nothing; a stop by anyone is sent", () => {
    for (const { from, event, answer } of edges) {
      if (answer.state.watching) expect(answer.state).toMatchObject({ holder: null, pressed: false, trip: "none" });
      if (!from.watching) continue;
      if (event.type === "stop") expect(answer.effects.length).toBe(1);
      else expect(answer.effects).toEqual([]);
      if ("who" in event && event.type !== "watch") expect(answer.denied).toBe("watching");
      if (!answer.state.watching)
        expect({ type: event.type, motion: underWay(answer.state), holder: answer.state.holder }).toEqual({
          type: "watch",
          motion: false,
          holder: null,
        });
    }
  });
  test("one who commands gives the robot up to be watched; it is stopped, and nobody takes it from him", () => {
    for (const { from, event, answer } of edges) {
      if (event.type !== "watch" || !event.on || from.watching) continue;
      if (from.holder !== null && from.holder !== event.who) expect(answer.denied).toBe("lease-taken");
      else expect(answer.effects).toEqual(underWay(from) ? ["stop"] : []);
    }
  });
  test("one commander: the lease passes only through nobody", () => {
    for (const { from, answer } of edges) {
      if (from.holder !== null && answer.state.holder !== null) expect(answer.state.holder).toBe(from.holder);
    }
  });
  test("what is denied changes nothing and does nothing", () => {
    for (const { from, answer } of edges) {
      if (answer.denied === undefined) continue;
      expect(answer.state).toEqual(from);
      expect(answer.effects).toEqual([]);
    }
  });
  test("no state is a dead end: from each, some events lead to motion again", () => {
    const back = new Map<string, Set<string>>();
    for (const { from, answer } of edges) {
      const key = JSON.stringify(answer.state);
      back.set(key, (back.get(key) ?? new Set()).add(JSON.stringify(from)));
    }
    const good = new Set(states.filter(state => state.motion === "moving").map(state => JSON.stringify(state)));
    for (const key of good) for (const from of back.get(key) ?? []) good.add(from);
    expect(good.size).toBe(states.length);
  });
});
