import { compose, distance, flangePose, identity, robotById, toMatrix, wristCentre } from "@twincell/core";
import { edgeTraceCell } from "@twincell/project";
import { expect, test } from "vitest";
import { commit, showDocument } from "../../stores/document.ts";
import { startFollowing } from "./follow.ts";
import { showJoints, theLive } from "../live.ts";

const robot = robotById("staubli_rx90l")!;
const cell = edgeTraceCell();
const { worldFromBase } = cell.robot;
const { flangeFromTcp } = cell.tools[0]!;
/** The paper counts from the shoulder, this much above the base. */
const SHOULDER_M = 0.42;

test("N-69 the app starts at Do Ready: wrist at (0, 0, 1.1) in the shoulder frame, not turned, and the TCP where forward kinematics says", () => {
  showDocument(cell);
  const stop = startFollowing();
  const { q_rad, baseFromFlange, worldFromTcp } = theLive();
  expect([...q_rad].map(q => (q * 180) / Math.PI)).toEqual(
    [0, -90, 90, 0, 0, 0].map(angle => expect.closeTo(angle, 9)),
  );
  if (robot.family.kind !== "ortho-parallel") throw new Error("The RX90L has a spherical wrist.");
  const [x, y, z] = wristCentre(robot.family, baseFromFlange);
  expect([x, y, z - SHOULDER_M]).toEqual([0, 0, 1.1].map(value => expect.closeTo(value, 9)));
  expect([...toMatrix(baseFromFlange.quaternion)]).toEqual(
    [1, 0, 0, 0, 1, 0, 0, 0, 1].map(value => expect.closeTo(value, 9)),
  );
  const wanted = compose(compose(worldFromBase, flangePose(robot.arm, robot.home_rad)), flangeFromTcp);
  expect(distance(worldFromTcp.position, wanted.position)).toBeLessThan(1e-12);
  stop();
});

test("another place or tool moves the TCP at once and leaves the joints alone", () => {
  showDocument(cell);
  const stop = startFollowing();
  const q = [0.1, -1, 1.4, 0, 0.3, 0];
  showJoints(q);
  commit("Move robot", document => ({
    ...document,
    robot: { ...document.robot, worldFromBase: { position: [1, 2, 3], quaternion: [0, 0, 0, 1] } },
  }));
  expect([...theLive().q_rad]).toEqual(q);
  const wanted = compose(
    compose({ ...identity<"world", "base">(), position: [1, 2, 3] }, flangePose(robot.arm, q)),
    flangeFromTcp,
  );
  expect(distance(theLive().worldFromTcp.position, wanted.position)).toBeLessThan(1e-12);
  stop();
});
