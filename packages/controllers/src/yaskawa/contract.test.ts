import { manualScheduler, robotById } from "@twincell/core";
import { createRealController } from "../driver/index.ts";
import { describeController } from "../testing/index.ts";
import { memoryNetwork } from "../transport/index.ts";
import { YASKAWA_CANNOT } from "./cannot.ts";
import { exampleScale, resolution_rad } from "./codec/index.ts";
import { yaskawaAdapter } from "./adapter/index.ts";
import { createVirtualYaskawa } from "./virtual/index.ts";

const HOST = "127.0.0.1";
const gp8 = robotById("yaskawa_gp8")!;
const half_rad = resolution_rad(exampleScale(gp8));

describeController("Yaskawa driver on its virtual controller", {
  robot: gp8,
  scheduler: manualScheduler,
  cannot: YASKAWA_CANNOT,
  // Half a pulse of every axis at once, over a reach of 0.9 m and the hand.
  resolution: {
    q_rad: Math.max(...half_rad),
    position_m:
      half_rad.slice(0, 3).reduce((sum, value) => sum + 0.9 * value, 0) +
      half_rad.slice(3).reduce((sum, value) => sum + 0.08 * value, 0),
    angle_rad: half_rad.reduce((sum, value) => sum + value, 0),
  },
  async make({ robot, scheduler, start_rad, maxSpeed, initialize, onMotion }) {
    const network = memoryNetwork(scheduler);
    const started = await createVirtualYaskawa({
      robot,
      scheduler,
      network,
      host: HOST,
      start_rad,
      servoOn_s: 0.1,
      cycle_s: 0.002,
      ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    if (started.kind === "taken") throw new Error(started.sentence);
    const adapter = yaskawaAdapter({
      robot,
      scheduler,
      network,
      host: HOST,
      scale: exampleScale(robot),
      poll_s: 0.002,
    });
    const controller = createRealController({
      face: adapter,
      scheduler,
      ...(initialize ? { initialize } : {}),
      ...(onMotion ? { onMotion } : {}),
    });
    const connecting = controller.connect();
    await scheduler.elapse(0.1);
    const connected = await connecting;
    if (connected.kind !== "done") throw new Error(connected.why.sentence);
    return controller;
  },
});
