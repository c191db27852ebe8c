import { flangePose, radians, robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { egmSensorWriter, noEgmRobot, noEgmSensor, readEgmRobot } from "../codec/index.ts";
import type { Address, DatagramSocket } from "../../transport/index.ts";
import { EgmMotion } from "./egm-motion.ts";

const robot = robotById("abb_irb120")!;

test("each cycle says the pose of the flange as it is and as it is planned, of the same posture as the joints", () => {
  let hear: (lent: Uint8Array, from: Address) => void = () => undefined;
  const said = noEgmRobot();
  const here = { host: "127.0.0.1", port: 6510 };
  const socket = {
    onDatagram: (listen: typeof hear) => {
      hear = listen;
    },
    send: (lent: Uint8Array) => {
      expect(readEgmRobot(lent, said)).toBeNull();
    },
  } as unknown as DatagramSocket;
  const motion = new EgmMotion(
    {
      robot,
      socket,
      to: here,
      maxSpeed: 1,
      gain_per_s: 20,
      commTimeout_s: undefined,
      log: sentence => expect.unreachable(sentence),
      failed: sentence => expect.unreachable(sentence),
    },
    Float64Array.from(robot.home_rad),
  );
  motion.start();
  const target = { ...noEgmSensor(), axes: 6, hasSpeeds: true };
  robot.home_rad.forEach((q, i) => {
    target.joints_deg[i] = (q * 180) / Math.PI + (i === 0 ? 20 : 0);
  });
  hear(egmSensorWriter()(target), here);
  for (let i = 0; i < 10; i++) motion.cycle(0.004);
  motion.tell(40);
  for (const [joints_deg, pose] of [
    [said.joints_deg, said.pose],
    [said.planned_deg, said.plannedPose],
  ] as const) {
    const { position, quaternion } = flangePose(robot.arm, Array.from(joints_deg.subarray(0, 6), radians));
    expect(pose.known).toBe(true);
    position.forEach((value, i) => {
      expect(pose.position_mm[i]).toBeCloseTo(1000 * value, 6);
    });
    const [x, y, z, w] = quaternion;
    [w, x, y, z].forEach((value, i) => {
      expect(pose.orientation[i]).toBeCloseTo(value, 9);
    });
  }
  // It is on its way, and planned where it was told to be.
  expect(said.planned_deg[0]! - said.joints_deg[0]!).toBeGreaterThan(1);
  expect(said.planned_deg[0]).toBeCloseTo(target.joints_deg[0]!, 9);
});
