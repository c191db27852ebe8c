import { manualScheduler, robotById } from "@twincell/core";
import { createRealController } from "../driver/index.ts";
import { describeController } from "../testing/index.ts";
import { memoryNetwork } from "../transport/index.ts";
import { CS7_CANNOT } from "./cannot.ts";
import { createCs7Adapter, createVirtualCs7 } from "./index.ts";

const robot = robotById("staubli_rx90l")!;
const HOST = "127.0.0.7";
const POLL_S = 0.004;
/** Half a step of WHERE's thousandths of a degree, and of the ten-thousandths of a precision point. */
const half_rad = (0.00055 * Math.PI) / 180;

describeController("Stäubli CS7 driver on its virtual controller, over the monitor", {
  robot,
  scheduler: manualScheduler,
  cannot: CS7_CANNOT,
  // Lines on their way, the cycle in which the program begins, the poll that tells its end and the one behind it.
  answer_s: 8 * POLL_S,
  resolution: { q_rad: half_rad, position_m: 6 * half_rad * 1.2, angle_rad: 6 * half_rad },
  async make({ robot: driven, scheduler, start_rad, maxSpeed, initialize, onMotion }) {
    const network = memoryNetwork(scheduler);
    await createVirtualCs7({
      robot: driven,
      scheduler,
      network,
      host: HOST,
      start_rad,
      presses_s: 0.1,
      interpret: () => ({ kind: "not-understood", faults: [] }),
      ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    const adapter = createCs7Adapter({ robot: driven, scheduler, network, host: HOST, period_s: POLL_S });
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
    await scheduler.elapse(0.02);
    return controller;
  },
});
