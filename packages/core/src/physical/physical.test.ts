import { describe, expect, test } from "vitest";
import {
  allowedOverride,
  calibrateFinger,
  distanceToOutline,
  fingerBend,
  GRASP_MARK_HEIGHT,
  GraspFilter,
  graspSignal,
  liftRefusal,
  personAt,
  personInZone,
  robotById,
  carriedTogether,
  type GraspSignal,
  type PeopleZone,
  type Person,
} from "../index.ts";

describe("the grasp signal", () => {
  const sense = { bend: 1, distance_m: 0, between: true, graspable: true };
  test("M-20 both are needed: bent fingers, and a hand at the piece", () => {
    expect(graspSignal(sense)).toBe("held");
    expect(graspSignal({ ...sense, bend: 0.2 })).toBe("ready");
    expect(graspSignal({ ...sense, between: false })).toBe("ready");
    expect(graspSignal({ ...sense, distance_m: 0.02 })).toBe("free");
  });
  test("M-20 the bend comes from a glove as well as from a gripper", () => {
    const answer = calibrateFinger([500, 3500]);
    const finger = answer.kind === "calibrated" ? answer.finger : expect.fail();
    const bent = (raw: number): number => fingerBend(raw, finger) / (Math.PI / 2);
    expect([600, 3400].map(raw => graspSignal({ ...sense, bend: bent(raw) }))).toEqual(["ready", "held"]);
  });
  test("M-19 a table or conveyor is never grasped", () => {
    expect(graspSignal({ ...sense, graspable: false })).toBe("free");
  });
  test("M-21 a hand that comes, closes, opens and goes: a, b, c, b, a (G3), each with its own place of the mark", () => {
    const hand: readonly [number, number][] = [
      [0, 0.1],
      [0, 0],
      [0.3, 0],
      [1, 0],
      [0.2, 0],
      [0, 0],
      [0, 0.1],
    ];
    const seen: GraspSignal[] = [];
    for (const [bend, distance_m] of hand) {
      const next = graspSignal({ bend, distance_m, between: true, graspable: true });
      if (next !== seen.at(-1)) seen.push(next);
    }
    expect(seen).toEqual(["free", "ready", "held", "ready", "free"]);
    const filter = new GraspFilter();
    const shown: GraspSignal[] = [];
    // Closed at one stroke and opened at one stroke, with a flicker in between: what is shown keeps the order.
    const sensed: GraspSignal[] = [
      ...Array<GraspSignal>(50).fill("free"),
      ...Array<GraspSignal>(50).fill("held"),
      "free",
      ...Array<GraspSignal>(50).fill("held"),
      ...Array<GraspSignal>(60).fill("free"),
    ];
    for (const each of sensed) {
      const next = filter.step(each, 0.002);
      if (next !== shown.at(-1)) shown.push(next);
    }
    expect(shown).toEqual(["free", "ready", "held", "ready", "free"]);
    expect(new Set(Object.values(GRASP_MARK_HEIGHT)).size).toBe(3);
  });
});

test("X-07 9.9 kg are lifted, 10 kg too (E-25), 10.1 kg refused with words; the gripper counts", () => {
  const robot = robotById("ur10e")!;
  const lifted = (mass_kg: number, gripper_kg = 0): string | undefined =>
    liftRefusal(robot, { name: "Box", mass_kg }, gripper_kg)?.sentence;
  expect([9.9, 10].map(mass_kg => lifted(mass_kg))).toEqual([undefined, undefined]);
  expect(lifted(10.1)).toBe("Universal Robots UR10e carries at most 10 kg; “Box” weighs 10.1 kg.");
  expect(lifted(9.9, 0.08)).toBeUndefined();
  expect(lifted(9.9, 0.9)).toBe(
    "Universal Robots UR10e carries at most 10 kg; “Box” (9.9 kg) with the gripper (0.9 kg) weighs 10.8 kg.",
  );
  expect(liftRefusal(robot, { name: "Box", mass_kg: 10.1 }, 0)?.hint).toBe(
    "Take a part that is 0.1 kg lighter, or a robot that carries more.",
  );
});

describe("people in the cell", () => {
  const person: Person = {
    id: "p",
    name: "Ann",
    path_m: [
      [-3, 0],
      [0, 0],
      [0, 2],
    ],
    speed_mps: 1.5,
    starts_s: 2,
    height_m: 1.75,
  };
  const zone: PeopleZone = {
    id: "z",
    name: "Near",
    outline_m: [
      [-1, -1],
      [1, -1],
      [1, 1],
      [-1, 1],
    ],
    reaction: { kind: "stop" },
  };
  test("T-57 someone sets out, walks the line at a steady pace and stands at its end", () => {
    expect(personAt(person, 1)).toEqual({ x_m: -3, y_m: 0, heading_rad: 0, walking: false });
    expect(personAt(person, 3)).toEqual({ x_m: -1.5, y_m: 0, heading_rad: 0, walking: true });
    expect(personAt(person, 4 + 2 / 3)).toMatchObject({ x_m: 0, walking: true, heading_rad: Math.PI / 2 });
    expect(personAt(person, 99)).toMatchObject({ x_m: 0, y_m: 2, walking: false });
    expect(personAt({ ...person, path_m: [] }, 3)).toMatchObject({ x_m: 0, y_m: 0 });
  });
  test("T-57 a foot in the zone counts as the person: 0.3 m before its middle", () => {
    const inside = (x_m: number): boolean => personInZone(zone, { x_m, y_m: 0, heading_rad: 0, walking: true });
    expect([-1.31, -1.29, 0].map(inside)).toEqual([false, true, true]);
    expect(
      distanceToOutline(
        [
          [0, 0],
          [2, 0],
          [0, 2],
        ],
        2,
        2,
      ),
    ).toBeCloseTo(Math.SQRT2, 12);
  });
  test("the strictest zone decides", () => {
    expect(allowedOverride([])).toBe(1);
    expect(
      allowedOverride([
        { kind: "slow", override: 0.3 },
        { kind: "slow", override: 0.5 },
      ]),
    ).toBe(0.3);
    expect(allowedOverride([{ kind: "slow", override: 0.3 }, { kind: "stop" }])).toBe(0);
  });
});

test("two loads as one weigh and turn as both", () => {
  const both = carriedTogether({ mass_kg: 1, center_m: [0, 0, 0.1] }, { mass_kg: 3, center_m: [0, 0, 0.5] });
  expect(both.mass_kg).toBe(4);
  expect(both.center_m[2]).toBeCloseTo(0.4, 12);
  expect(both.inertia_kgm2![0]).toBeCloseTo(1 * 0.3 ** 2 + 3 * 0.1 ** 2, 12);
  expect(both.inertia_kgm2![2]).toBe(0);
});
