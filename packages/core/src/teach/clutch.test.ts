import { expect, test } from "vitest";
import {
  angleBetween,
  clutchStep,
  compose,
  copyPose,
  distance,
  FREE_HAND,
  fromAxisAngle,
  pose,
  takeGrip,
  type Pose,
} from "../index.ts";

const hand = (x: number, y: number, z: number, angle = 0): Pose<"world", "hand"> =>
  pose([x, y, z], fromAxisAngle([0, 0.6, 0.8], angle));
const tcp: Pose<"world", "tcp"> = pose([0.8, -0.2, 0.9], fromAxisAngle([1, 0, 0], 2.5));
const far = { ...FREE_HAND, maxStep_m: 10, maxTurn_rad: 4 };
const gap = (a: Pose, b: Pose): number => distance(a.position, b.position) + angleBetween(a.quaternion, b.quaternion);

test("L-29 closing the grip moves nothing, wherever the hand is, and again at the next grip", () => {
  for (const start of [hand(0.7, 0, 1), hand(-2, 3, 0.1, 1.2)]) {
    const grip = takeGrip(start, tcp);
    expect(gap(clutchStep(grip, start, far), tcp)).toBeLessThan(1e-12);
    const moved = clutchStep(grip, hand(0.5, 0.1, 1.2, 0.3), far);
    const again = hand(0.1, 0.2, 0.3, -1);
    expect(gap(clutchStep(takeGrip(again, moved), again, far), moved)).toBeLessThan(1e-12);
  }
});

test("L-28 the tip moves as if it were fixed to the hand", () => {
  const start = hand(0.7, 0, 1, 0.4);
  const end = hand(0.75, 0.1, 0.9, 0.9);
  const wanted = compose(end, compose(pose<"hand", "world">(...invert(start)), tcp));
  expect(gap(clutchStep(takeGrip(start, tcp), end, far), wanted)).toBeLessThan(1e-12);
});

test("L-30 position or orientation alone, without a lever arm", () => {
  const start = hand(0.7, 0, 1);
  const end = hand(0.75, 0.1, 0.9, 0.9);
  const slid = clutchStep(takeGrip(start, tcp), end, { ...far, orientation: "locked" });
  expect(slid.quaternion).toEqual(tcp.quaternion);
  slid.position.forEach((value, i) => {
    expect(value - tcp.position[i]!).toBeCloseTo(end.position[i]! - start.position[i]!, 12);
  });
  const turned = clutchStep(takeGrip(start, tcp), end, { ...far, position: "locked" });
  expect(turned.position).toEqual(tcp.position);
  expect(angleBetween(turned.quaternion, tcp.quaternion)).toBeCloseTo(0.9, 12);
  const fine = clutchStep(takeGrip(start, tcp), end, { ...far, orientation: "locked", scale: 0.1 });
  expect(distance(fine.position, tcp.position)).toBeCloseTo(0.1 * distance(start.position, end.position), 12);
});

test("a hand that leaps is followed in bounded steps and reached in the end; one that is lost holds the tip", () => {
  const start = hand(0, 0, 1);
  const end = hand(1, 0, 1, 1.2);
  const grip = takeGrip(start, tcp);
  const rigid = clutchStep(takeGrip(start, tcp), end, far);
  let last = copyPose(tcp);
  let steps = 0;
  for (; gap(last, rigid) > 1e-9 && steps < 100; steps++) {
    const now = clutchStep(grip, end, FREE_HAND);
    expect(distance(now.position, last.position)).toBeLessThanOrEqual(FREE_HAND.maxStep_m + 1e-12);
    expect(angleBetween(now.quaternion, last.quaternion)).toBeLessThanOrEqual(FREE_HAND.maxTurn_rad + 1e-9);
    last = now;
  }
  expect(steps).toBeGreaterThan(5);
  expect(steps).toBeLessThan(30);
  expect(clutchStep(grip, hand(NaN, 0, 0), FREE_HAND)).toEqual(last);
});

function invert(p: Pose): [[number, number, number], [number, number, number, number]] {
  const [x, y, z, w] = p.quaternion;
  const back = compose(pose([0, 0, 0], [-x, -y, -z, w]), pose([-p.position[0], -p.position[1], -p.position[2]]));
  return [back.position, back.quaternion];
}
