import { compose, fromAxisAngle, pose, transformPoint, type Pose, type Vector3 } from "@twincell/core";
import { readUrdf, writeUrdfTree } from "@twincell/formats";
import { twoFingerTree } from "@twincell/project";
import { expect, test } from "vitest";

const read = readUrdf(writeUrdfTree(twoFingerTree()));
if (read.kind !== "read") throw new Error(read.sentence);
const { joints, links } = read.robot;

/** A point of a link in the flange's frame, with the driven joint at q and the others as they mimic it. */
function place(link: string, at: Vector3, q_rad: number): Vector3 {
  let from: Pose = pose(at);
  for (let name = link; ; ) {
    const joint = joints.find(({ child }) => child === name);
    if (!joint) return transformPoint(from, [0, 0, 0]);
    const angle = joint.mimic ? joint.mimic.multiplier * q_rad : q_rad;
    const turned = compose(joint.parentFromJoint as Pose, pose([0, 0, 0], fromAxisAngle(joint.axis, angle)) as Pose);
    from = compose(turned, from);
    name = joint.parent;
  }
}

test("X-05 the URDF of the two fingers has one driven joint and five that mimic it: 85 mm at 0 rad, 45.3 at 0.4, closed at 0.8; tips from 149 to 163 mm, upright, 0.921 kg", () => {
  expect(joints.filter(({ mimic }) => mimic === undefined).map(({ name }) => name)).toEqual(["left_knuckle_joint"]);
  expect(joints.filter(({ mimic }) => mimic?.joint === "left_knuckle_joint")).toHaveLength(5);
  const tip = links.find(({ name }) => name === "left_finger_tip")!;
  const [box] = tip.visuals;
  if (box?.geometry.kind !== "box") throw new Error("The tip is a box.");
  const [width, , height] = box.geometry.size_m;
  const [x, , z] = box.linkFromShape.position;
  const pad = (q: number): Vector3 => place("left_finger_tip", [x - width / 2, 0, z + height / 2], q);
  const mirrored = (q: number): Vector3 => place("right_finger_tip", [-(x - width / 2), 0, z + height / 2], q);
  for (const [q, gap_m] of [
    [0, 0.085],
    [0.4, 0.0453],
    [0.8, 0],
  ] as const) {
    expect(pad(q)[0] - mirrored(q)[0]).toBeCloseTo(gap_m, 3);
    expect(pad(q)[2]).toBeCloseTo(mirrored(q)[2], 12);
    // Upright: both ends of the pad are above one another.
    const foot = place("left_finger_tip", [x - width / 2, 0, z - height / 2], q);
    expect(foot[0]).toBeCloseTo(pad(q)[0], 12);
  }
  expect(pad(0)[2]).toBeCloseTo(0.149, 3);
  expect(pad(0.8)[2]).toBeCloseTo(0.1625, 3);
  expect(links.reduce((sum, { inertial }) => sum + (inertial?.mass_kg ?? 0), 0)).toBeCloseTo(0.921, 9);
});
