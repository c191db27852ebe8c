import {
  angleBetween,
  compose,
  copyPose,
  fromAxisAngle,
  identity,
  inverse,
  normalize,
  pose,
  seededRandom,
  subtract,
  type Pose,
  type Vector3,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import type { HandlePart } from "../interaction.ts";
import { carried, dragged, type Grip, type Ray, restrained } from "./drag-maths.ts";

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

test("L-28 L-29 L-30 the tool goes a share of the way, not along what is locked, and does not jump when it is taken", () => {
  const random = seededRandom(7);
  const pose = (): Pose<"world", "tcp"> => ({
    position: [random() - 0.5, random() - 0.5, random() - 0.5],
    quaternion: normalize4([random() - 0.5, random() - 0.5, random() - 0.5, random() - 0.5]),
  });
  const free = { x: false, y: false, z: false, turn: false };
  let worst = 0;
  // Row L-29: 10⁵ grips, each at its own scale and with its own locks.
  for (let i = 0; i < 100_000; i++) {
    const start = pose();
    const wanted = copyPose(start);
    const locks = { x: random() < 0.3, y: random() < 0.3, z: random() < 0.3, turn: random() < 0.3 };
    restrained({ worldFromTcp: start, axes: start.quaternion }, 0.1 + 1.9 * random(), locks, wanted);
    for (let k = 0; k < 3; k++) worst = Math.max(worst, Math.abs(wanted.position[k]! - start.position[k]!));
    worst = Math.max(worst, angleBetween(wanted.quaternion, start.quaternion));
  }
  expect(worst).toBeLessThan(1e-7);

  const start: Pose<"world", "tcp"> = { position: [1, 2, 3], quaternion: [0, 0, 0, 1] };
  const turned = fromAxisAngle([0, 0, 1], 0.4);
  const go = (share: number, locks: Partial<typeof free>): Pose<"world", "tcp"> =>
    restrained(
      { worldFromTcp: start, axes: [0, 0, 0, 1] },
      share,
      { ...free, ...locks },
      {
        position: [1.1, 2.2, 3.3],
        quaternion: [...turned],
      },
    );
  const by = (share: number, locks: Partial<typeof free>): number[] =>
    go(share, locks).position.map((value, k) => Math.round((value - start.position[k]!) * 1e9) / 1e9);
  expect(by(0.1, {})).toEqual([0.01, 0.02, 0.03]);
  expect(by(2, { y: true })).toEqual([0.2, 0, 0.6]);
  expect(angleBetween(go(2, {}).quaternion, start.quaternion)).toBeCloseTo(0.8, 9);
  expect(angleBetween(go(0.5, {}).quaternion, start.quaternion)).toBeCloseTo(0.2, 9);
  expect(go(2, { turn: true }).quaternion).toEqual(start.quaternion);
});
const normalize4 = (q: [number, number, number, number]): [number, number, number, number] => {
  const length = Math.hypot(...q);
  return [q[0] / length, q[1] / length, q[2] / length, q[3] / length];
};
