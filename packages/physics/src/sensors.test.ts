import { describe, expect, test } from "vitest";
import {
  emptyProgram,
  pose,
  SignalTable,
  type PhysicalObject,
  type Person,
  type PeopleZone,
  type Program,
  type Sensor,
} from "@twincell/core";
import { createWorld, PhysicsRun, type PhysicsEvent } from "./index.ts";
import { at, bareScene, box, engine, ready, rest } from "./testing/cells.ts";

const belt = (speed_mps: number, more: Partial<PhysicalObject> = {}): PhysicalObject => ({
  id: "belt",
  name: "Belt",
  role: "fixture",
  worldFromObject: pose([2, 0, 0.45]),
  shape: { kind: "box", size_m: [0.4, 2, 0.1] },
  friction: 0.8,
  belt: { direction: [0, 1, 0], speed_mps },
  ...more,
});
const beam: Sensor = {
  id: "cell",
  name: "Photo-cell",
  kind: "beam",
  from_m: [1.7, 0.4, 0.55],
  to_m: [2.3, 0.4, 0.55],
  signal: "part_there",
  sees: ["part"],
};
const onBelt = box("part", [0.1, 0.1, 0.1], [2, -0.5, 0.55], { mass_kg: 1 });

describe("a conveyor belt", () => {
  test("carries what lies on it at its speed, and its own place stays", () => {
    const world = ready(bareScene({ objects: [belt(0.2), onBelt] }));
    rest(world, 0.5);
    const before = at(world, 0)[1];
    rest(world, 2);
    expect(Math.abs((at(world, 0)[1] - before) / 2 - 0.2)).toBeLessThan(0.002);
    expect(Math.abs(at(world, 0)[2] - 0.55)).toBeLessThan(0.001);
    world.close();
  });
  test("T-55 a photo-cell trips when the part comes, and its line stops the belt with the part before it", () => {
    const signals = new SignalTable();
    const scene = bareScene({
      sensors: [beam],
      objects: [
        belt(0.2, { belt: { direction: [0, 1, 0], speed_mps: 0.2, runs: { signal: "part_there", is: false } } }),
        onBelt,
      ],
    });
    const answer = createWorld(engine, scene, signals);
    const world = answer.kind === "ready" ? answer.world : expect.fail();
    rest(world, 3);
    expect(signals.read("part_there")).toBe(false);
    rest(world, 5);
    expect(signals.read("part_there")).toBe(true);
    // Its front edge stands in the beam: it came to rest from 0.2 m/s with 1 m/s², in 20 mm.
    expect(at(world, 0)[1] + 0.05).toBeGreaterThan(0.4);
    expect(at(world, 0)[1] + 0.05).toBeLessThan(0.4 + 0.03);
    world.close();
  });
  test("T-55 the beam sees through the gap over a low part, and is not tripped by what it does not see", () => {
    const tripped = (sensor: Sensor): boolean => {
      const world = ready(bareScene({ sensors: [sensor], objects: [belt(0.2), onBelt] }));
      let seen = false;
      for (let i = 0; i < 40; i++) {
        rest(world, 0.2);
        seen ||= world.tripped[0] === 1;
      }
      world.close();
      return seen;
    };
    expect(tripped(beam)).toBe(true);
    expect(tripped({ ...beam, from_m: [1.7, 0.4, 0.62], to_m: [2.3, 0.4, 0.62] } as Sensor)).toBe(false);
    expect(tripped({ ...beam, sees: ["robot", "person"] })).toBe(false);
  });
});

/** The arm turns about its first axis, there and back. */
const turning = (scene = bareScene()): Program => {
  const q = (first: number): number[] => [first, ...scene.q_rad.slice(1)];
  return {
    ...emptyProgram(scene.robot.id),
    steps: [1.5, -1.5, 0].map((angle, i) => ({
      id: `s${i + 1}`,
      type: "move",
      path: "ptp",
      target: { q: q(angle) },
      speed: { ratio: 0.5 },
      blend_m: 0,
    })),
  };
};
const speedOf = (run: PhysicsRun): number => Math.abs(run.world.state.qd_rad_s[0]!);

test("T-27 a proximity sensor in the stand stops the robot in mid-move; it goes on only when somebody lets it", () => {
  const sensor: Sensor = {
    id: "prox",
    name: "Stand sensor",
    kind: "proximity",
    at_m: [1, 1, 1],
    range_m: 0.3,
    signal: "near",
    sees: ["part"],
    stops: true,
  };
  const world = ready(
    bareScene({ sensors: [sensor], floor_m: 0, objects: [box("ball", [0.1, 0.1, 0.1], [3, 3, 0.05])] }),
  );
  const events: PhysicsEvent[] = [];
  const run = new PhysicsRun(world, turning(), { onEvent: event => events.push(event) });
  run.runFor(0.8);
  expect(speedOf(run)).toBeGreaterThan(0.3);
  // Somebody throws a box past the sensor: 0.25 m before it, over the corner of its range.
  world.place("ball", pose([1, 1.34, 1]));
  run.advance();
  run.advance();
  expect(world.signals.read("near")).toBe(true);
  run.runFor(1);
  expect(speedOf(run)).toBe(0);
  expect(events.map(({ sentence }) => sentence)).toEqual([
    "“Stand sensor” was tripped.",
    "The robot is stopped; it goes on when somebody lets it.",
    "“Stand sensor” is free again.",
  ]);
  const stood = Float64Array.from(world.state.q_rad);
  run.runFor(1);
  expect([...world.state.q_rad]).toEqual([...stood]);
  expect(run.watch.resume()).toEqual({ kind: "done" });
  expect(run.runFor(20).kind).toBe("done");
  world.close();
});

test("T-27 the range is that of the surface: 0.29 m trips, 0.31 m does not", () => {
  const reads = (gap_m: number): unknown => {
    const sensor: Sensor = {
      id: "prox",
      name: "Prox",
      kind: "proximity",
      at_m: [2, 0, 1],
      range_m: 0.3,
      signal: "near",
      sees: ["part"],
    };
    const world = ready(
      bareScene({ sensors: [sensor], objects: [box("bar", [0.04, 2, 0.1], [2 + gap_m + 0.02, 0.9, 1])] }),
    );
    const is = world.tripped[0];
    world.close();
    return is;
  };
  expect([reads(0.29), reads(0.31)]).toEqual([1, 0]);
});

test("T-57 a person walks through the zones: slowed down, stopped, logged; let go on once it has left", () => {
  const square = (half: number): [number, number][] => [
    [-half, -half],
    [half, -half],
    [half, half],
    [-half, half],
  ];
  const zones: PeopleZone[] = [
    { id: "outer", name: "Warning zone", outline_m: square(2.5), reaction: { kind: "slow", override: 0.3 } },
    { id: "inner", name: "Stop zone", outline_m: square(1.5), reaction: { kind: "stop" } },
  ];
  const ann: Person = {
    id: "ann",
    name: "Ann",
    path_m: [
      [4, 0],
      [1.2, 0],
      [1.2, 4],
    ],
    speed_mps: 1.6,
    starts_s: 0,
    height_m: 1.75,
  };
  const world = ready(bareScene({ zones, people: [ann], floor_m: 0 }));
  const events: PhysicsEvent[] = [];
  const run = new PhysicsRun(
    world,
    { ...turning(), steps: [{ id: "loop", type: "repeat", times: "forever", steps: turning().steps }] },
    { onEvent: event => events.push(event) },
  );
  run.runFor(0.7);
  const free = speedOf(run);
  run.runFor(0.5);
  expect(speedOf(run)).toBeLessThan(0.4 * free);
  expect(speedOf(run)).toBeGreaterThan(0);
  run.runFor(1);
  expect(speedOf(run)).toBe(0);
  expect(run.watch.resume()).toEqual({
    kind: "refused",
    sentence: "Somebody is in “Stop zone”: the robot stays where it is.",
  });
  run.runFor(4);
  expect(speedOf(run)).toBe(0);
  expect(run.watch.resume()).toEqual({ kind: "done" });
  run.runFor(1);
  expect(speedOf(run)).toBeGreaterThan(0.3);
  expect(events.map(({ sentence }) => sentence)).toEqual([
    "Ann entered “Warning zone”.",
    "The robot is slowed down to 30 %.",
    "Ann entered “Stop zone”.",
    "The robot is stopped; it goes on when somebody lets it.",
    "Ann left “Stop zone”.",
    "Ann left “Warning zone”.",
    "The robot runs at its own speed again.",
  ]);
  // Into the outer zone with a foot 0.3 m ahead of its middle: (4 − 2.8) m at 1.6 m/s.
  expect(Math.abs(events[0]!.at_s - 1.2 / 1.6)).toBeLessThan(0.01);
  world.close();
});

test("T-57 a light curtain sees the walking mannequin", () => {
  const curtain: Sensor = {
    id: "curtain",
    name: "Curtain",
    kind: "beam",
    from_m: [3, -1, 0.4],
    to_m: [3, 1, 0.4],
    signal: "curtain",
    sees: ["person"],
  };
  const world = ready(
    bareScene({
      sensors: [curtain],
      people: [
        {
          id: "p",
          name: "Ben",
          path_m: [
            [4, 0],
            [2, 0],
          ],
          speed_mps: 1,
          starts_s: 0,
          height_m: 1.8,
        },
      ],
      floor_m: 0,
    }),
  );
  const seen: number[] = [];
  for (let t = 0; t < 20; t++) {
    rest(world, 0.1);
    if (world.tripped[0] === 1) seen.push(t);
  }
  expect(seen.length).toBeGreaterThan(0);
  expect(Math.min(...seen)).toBeGreaterThanOrEqual(7);
  expect(Math.max(...seen)).toBeLessThanOrEqual(11);
  world.close();
});
