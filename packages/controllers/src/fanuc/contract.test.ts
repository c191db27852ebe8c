import { manualScheduler, robotById } from "@twincell/core";
import { createRealController } from "../driver/index.ts";
import { describeController } from "../testing/index.ts";
import { memoryNetwork } from "../transport/index.ts";
import { FANUC_CANNOT } from "./cannot.ts";
import { createFanucAdapter, createVirtualFanuc } from "./index.ts";

const robot = robotById("fanuc_lrmate200id")!;
const HOST = "127.0.0.5";

describeController("FANUC driver on its virtual controller, over RMI", {
  robot,
  scheduler: manualScheduler,
  cannot: FANUC_CANNOT,
  async make({ robot: driven, scheduler, start_rad, maxSpeed, initialize, onMotion }) {
    const network = memoryNetwork(scheduler);
    await createVirtualFanuc({
      robot: driven,
      scheduler,
      network,
      host: HOST,
      start_rad,
      digits: 12,
      ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    const adapter = createFanucAdapter({ robot: driven, scheduler, network, host: HOST, period_s: 0.004 });
    const controller = createRealController({
      face: adapter,
      scheduler,
      ...(initialize ? { initialize } : {}),
      ...(onMotion ? { onMotion } : {}),
    });
    const connecting = controller.connect();
    await scheduler.elapse(0.05);
    await connecting;
    await scheduler.elapse(0.02);
    return controller;
  },
});
