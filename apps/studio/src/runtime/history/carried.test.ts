import { compose, fromAxisAngle, identity, pose, type CarriedPart, type Pose } from "@twincell/core";
import { expect, test } from "vitest";
import { carriedPose } from "./carried.ts";

const seat = (x: number) => ({ worldFromObject: pose<"world", "object">([x, 0, 0]), on: new Set<string>() });
const twice: readonly CarriedPart[] = [
  { id: "box", flangeFromObject: pose([0, 0, 0.1]), taken: seat(0), taken_s: 1, put: seat(2), put_s: 3 },
  { id: "box", flangeFromObject: pose([0, 0, 0.2]), taken: seat(2), taken_s: 5, put: undefined, put_s: undefined },
];

test("L-34 a part stands where it is, goes with the gripper, stays where it was put, and goes on from there", () => {
  const turned: Pose<"world", "flange"> = { position: [1, 1, 1], quaternion: fromAxisAngle([1, 0, 0], Math.PI) };
  const at = (t_s: number) => carriedPose(twice, "box", t_s, turned, identity());
  expect(at(0.99)).toBeUndefined();
  expect(at(1)).toEqual(compose(turned, twice[0]!.flangeFromObject));
  expect(at(2)?.position[2]).toBeCloseTo(0.9, 12);
  expect(at(4)).toEqual(seat(2).worldFromObject);
  expect(at(99)?.position[2]).toBeCloseTo(0.8, 12);
  expect(carriedPose(twice, "other", 2, turned, identity())).toBeUndefined();
});
