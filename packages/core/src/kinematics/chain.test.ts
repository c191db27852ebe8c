import { expect, test } from "vitest";
import {
  angleBetween,
  LIBRARY,
  armScratch,
  compose,
  distance,
  flangePose,
  fromAxisAngle,
  identity,
  inverse,
  linkPoses,
  pose,
  robotById,
  seededRandom,
  type Pose,
  type SerialArm,
} from "../index.ts";
import { elbowChainOf } from "./elbow-chain.ts";

const limits = { lower_rad: -100, upper_rad: 100, speed_rad_s: 1, acceleration_rad_s2: 1 };
const turntable: SerialArm = {
  name: "turntable",
  joints: [{ name: "1", axis: [0, 0, 1], parentFromJoint: pose(), limits }],
  lastJointFromFlange: pose(),
};

test("a joint's own sine and cosine are the engine's to 5e-16 over many turns, sign included, and NaN stays NaN", () => {
  const random = seededRandom(31);
  const angles = Array.from({ length: 20_000 }, () => (random() - 0.5) * 60);
  for (let k = -16; k <= 16; k++) for (const aside of [0, 1e-9, -1e-9, 1e-16]) angles.push((k * Math.PI) / 4 + aside);
  let worst = 0;
  for (const angle of angles) {
    const [x, y, z, w] = flangePose(turntable, [angle]).quaternion;
    expect(x === 0 && y === 0).toBe(true);
    worst = Math.max(worst, Math.abs(z - Math.sin(angle / 2)), Math.abs(w - Math.cos(angle / 2)));
  }
  expect(worst).toBeLessThan(5e-16);
  expect(flangePose(turntable, [NaN]).quaternion[3]).toBeNaN();
  expect(flangePose(turntable, [0]).quaternion).toEqual([0, 0, 0, 1]);
});

test("N-05 the links are a hierarchy: each follows its parent, and a joint carries along what is behind it and nothing before it", () => {
  const { arm } = robotById("staubli_rx90l")!;
  const random = seededRandom(5);
  const scratch = armScratch();
  const links = (q: readonly number[]): Pose<"base", "link">[] => {
    const out = Array.from({ length: 7 }, () => identity<"base", "link">());
    linkPoses(arm, q, out, scratch);
    return out;
  };
  const gap = (a: Pose, b: Pose): number =>
    Math.max(distance(a.position, b.position), angleBetween(a.quaternion, b.quaternion));
  for (let k = 0; k < 100; k++) {
    const q = arm.joints.map(({ limits: { lower_rad, upper_rad } }) => lower_rad + (upper_rad - lower_rad) * random());
    const before = links(q);
    for (const [i, joint] of arm.joints.entries()) {
      const linkFromNext: Pose<"link", "link"> = compose<"link", "joint", "link">(
        pose(joint.parentFromJoint.position, joint.parentFromJoint.quaternion),
        pose([0, 0, 0], fromAxisAngle(joint.axis, q[i]!)),
      );
      expect(gap(before[i + 1]!, compose(before[i]!, linkFromNext))).toBeLessThan(1e-7);
      const after = links(q.with(i, q[i]! + 0.3));
      const carried = compose(after[i + 1]!, inverse(before[i + 1]!));
      for (let link = 0; link <= 6; link++) {
        if (link <= i) expect(after[link]).toEqual(before[link]);
        else expect(gap(after[link]!, compose(carried, before[link]!))).toBeLessThan(1e-7);
      }
      expect(gap(after[i + 1]!, before[i + 1]!)).toBeGreaterThan(0.29);
    }
  }
});

test("arms built at right angles take the straight line of arithmetic, and it is the walk's to 1e-15 m and its very quaternion; others walk", () => {
  const random = seededRandom(77);
  const links = Array.from({ length: 7 }, () => identity<"base", "link">());
  const straight = LIBRARY.filter(({ arm }) => elbowChainOf(arm) !== null).map(({ id }) => id);
  expect(straight).toEqual(expect.arrayContaining(["staubli_rx90l", "kuka_kr6r900sixx", "abb_irb120"]));
  expect(straight).not.toContain("ur10e");
  for (const id of straight) {
    const { arm } = robotById(id)!;
    const last = arm.lastJointFromFlange;
    for (let k = 0; k < 300; k++) {
      const q = arm.joints.map(() => (random() - 0.5) * 14);
      const flange = flangePose(arm, q);
      linkPoses(arm, q, links);
      const walked = compose<"base", "joint", "flange">(pose(links[6]!.position, links[6]!.quaternion), last);
      expect(distance(flange.position, walked.position)).toBeLessThan(3e-15);
      flange.quaternion.forEach((value, i) => {
        expect(Math.abs(value - walked.quaternion[i]!)).toBeLessThan(3e-15);
      });
    }
    expect(flangePose(arm, [0, 0, NaN, 0, 0, 0]).quaternion[0]).toBeNaN();
  }
});
