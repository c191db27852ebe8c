import {
  angleBetween,
  compose,
  distance,
  flangePose,
  fromAxisAngle,
  pose,
  robotById,
  seededRandom,
  type Pose,
  type Vector3,
} from "@twincell/core";
import { edgeTraceCell, type CellDocument } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { cellStore } from "../../stores/cell.ts";
import { showDocument, worldFromFrameOf } from "../../stores/document.ts";
import type { JogFrame } from "../../stores/jog.ts";
import { fromFixedXyz } from "./fixed-xyz.ts";
import { startFollowing } from "../robot/follow.ts";
import { showJoints, theLive } from "../live.ts";
import { marginFraction, readFrame, readTcp } from "./readout.ts";

const robot = robotById("staubli_rx90l")!;
const example = edgeTraceCell();
const cell: CellDocument = {
  ...example,
  robot: { ...example.robot, worldFromBase: pose([0.2, -0.1, 0.3], fromAxisAngle([0, 0, 1], 0.7)) },
};
beforeEach(() => {
  showDocument(cell);
  startFollowing();
});

test.each<JogFrame>(["joint", "world", "base", "user", "tool"])(
  "N-21 the read-out in the frame of %s jogging is forward kinematics in that frame",
  frame => {
    const random = seededRandom(21);
    const shown = new Float64Array(6);
    const at = readFrame(frame);
    const { document } = cellStore.getState();
    const worldFromFrame = worldFromFrameOf(document, at, example.frames[0]!.name);
    for (let k = 0; k < 100; k++) {
      const q = robot.arm.joints.map(
        ({ limits: { lower_rad, upper_rad } }) => lower_rad + (upper_rad - lower_rad) * random(),
      );
      showJoints(q);
      readTcp(theLive().worldFromTcp, worldFromFrame, shown);
      const frameFromTcp: Pose = pose(
        [shown[0]!, shown[1]!, shown[2]!] as Vector3,
        fromFixedXyz(shown[3]!, shown[4]!, shown[5]!),
      );
      const wanted = compose(compose(cell.robot.worldFromBase, flangePose(robot.arm, q)), cell.tools[0]!.flangeFromTcp);
      const got = compose(worldFromFrame as Pose, frameFromTcp);
      expect(distance(got.position, wanted.position)).toBeLessThan(1e-9);
      expect(angleBetween(got.quaternion, wanted.quaternion)).toBeLessThan(1e-6);
    }
  },
);

test("N-21 base, user and world read different numbers where those frames differ", () => {
  const { document } = cellStore.getState();
  const { worldFromTcp } = theLive();
  const read = (at: "world" | "base" | "user"): number[] => [
    ...readTcp(worldFromTcp, worldFromFrameOf(document, at, example.frames[0]!.name), new Float64Array(6)),
  ];
  expect(read("world")).not.toEqual(read("base"));
  expect(read("world")).not.toEqual(read("user"));
});

test("the margin is 1 in the middle of a range and 0 at its ends", () => {
  expect([-2, 0, 2, 1].map(q => marginFraction(q, -2, 2))).toEqual([0, 1, 0, 0.5]);
});
