import {
  angleBetween,
  compose,
  fromAxisAngle,
  identity,
  inverse,
  normalize,
  pose,
  subtract,
  type Vector3,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import type { HandlePart } from "../interaction.ts";
import { carried, dragged, type Grip, type Ray } from "./drag-maths.ts";

const eye: Vector3 = [3, -2, 2];
const centre: Vector3 = [0.6, 0.1, 0.5];
const towards = (point: Vector3): Ray => ({ origin: eye, direction: normalize(subtract(point, eye)) });
const grip = (part: HandlePart, from: Vector3): Grip => ({
  part,
  worldFromTcp: pose([...centre], fromAxisAngle([1, 0, 0], 0.4)),
  axes: [0, 0, 0, 1],
  ray: towards(from),
  view: normalize(subtract(centre, eye)),
});

describe("desktop drags of the TCP handle", () => {
  test("taking the handle moves nothing", () => {
    for (const part of ["x", "y", "z", "xy", "yz", "zx", "free", "rx", "ry", "rz"] as const) {
      const taken = grip(part, [0.65, 0.12, 0.53]);
      const out = dragged(taken, taken.ray, 0, 0, identity());
      expect(out.position.map((x, i) => x - centre[i]!).every(d => Math.abs(d) < 1e-12)).toBe(true);
      expect(angleBetween(out.quaternion, taken.worldFromTcp.quaternion)).toBeLessThan(1e-9);
    }
  });

  test("an arrow follows the pointer along its axis and nowhere else", () => {
    const out = dragged(grip("x", [0.7, 0.1, 0.5]), towards([0.95, 0.1, 0.5]), 0, 0, identity());
    expect(out.position[0]).toBeCloseTo(0.85, 9);
    expect(out.position[1]).toBeCloseTo(0.1, 12);
    expect(out.position[2]).toBeCloseTo(0.5, 12);
  });

  test("a plane follows the pointer within the plane", () => {
    const out = dragged(grip("xy", [0.65, 0.15, 0.5]), towards([0.75, 0.05, 0.5]), 0, 0, identity());
    expect(out.position.map(x => Math.round(x * 1e9) / 1e9)).toEqual([0.7, 0, 0.5]);
  });

  test("a ring turns by the angle the pointer went round", () => {
    const at = (angle: number): Vector3 => [
      centre[0] + 0.1 * Math.cos(angle),
      centre[1] + 0.1 * Math.sin(angle),
      centre[2],
    ];
    const start = grip("rz", at(0.3));
    const out = dragged(start, towards(at(0.3 + 0.7)), 0, 0, identity());
    expect(angleBetween(out.quaternion, start.worldFromTcp.quaternion)).toBeCloseTo(0.7, 9);
    expect(out.position).toEqual(centre);
    const snapped = dragged(start, towards(at(0.3 + 0.7)), 0, Math.PI / 36, identity());
    expect(angleBetween(snapped.quaternion, start.worldFromTcp.quaternion)).toBeCloseTo((8 * Math.PI) / 36, 9);
  });
});

test("X a grip in the hand does not jump when taken and then follows rigidly", () => {
  const worldFromHand = pose<"world", "hand">([0.4, 0.2, 1.1], fromAxisAngle([0, 0, 1], 0.8));
  const worldFromTcp = pose<"world", "tcp">([0.6, 0.1, 0.5], fromAxisAngle([1, 0, 0], 0.4));
  const handFromTcp = compose(inverse(worldFromHand), worldFromTcp);
  const held = carried(worldFromHand, handFromTcp);
  expect(Math.hypot(...subtract(held.position, worldFromTcp.position))).toBeLessThan(1e-12);
  const moved = carried(pose([0.5, 0.2, 1.1], worldFromHand.quaternion), handFromTcp);
  expect(moved.position[0] - held.position[0]).toBeCloseTo(0.1, 12);
});
