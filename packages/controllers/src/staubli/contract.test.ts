import { manualScheduler, robotById } from "@twincell/core";
import { createRealController } from "../driver/index.ts";
import { describeController } from "../testing/index.ts";
import { memoryNetwork } from "../transport/index.ts";
import { STAUBLI_CANNOT } from "./cannot.ts";
import { createStaubliAdapter, createVirtualStaubli } from "./index.ts";

const robot = robotById("staubli_rx160")!;
const HOST = "127.0.0.6";
const FEEDBACK_S = 0.004;
/** Half a step of a 32-bit number below 8 rad. */
const half_rad = 2 ** -22;

describeController("Stäubli driver on its virtual controller, over simple_message", {
  robot,
  scheduler: manualScheduler,
  cannot: STAUBLI_CANNOT,
  // A point waits for its cycle; the end is told by a status, which comes with every fifth state, and the state behind
  // it.
  answer_s: 0.004 + 6 * FEEDBACK_S + 0.004,
  resolution: { q_rad: half_rad, position_m: 6 * half_rad * 1.8, angle_rad: 6 * half_rad },
  async make({ robot: driven, scheduler, start_rad, maxSpeed, initialize, onMotion }) {
    const network = memoryNetwork(scheduler);
    await createVirtualStaubli({
      robot: driven,
      scheduler,
      network,
      host: HOST,
      start_rad,
      feedback_s: FEEDBACK_S,
      settle_s: 0.02,
      interpret: () => ({ kind: "not-understood", faults: [] }),
      ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    const adapter = createStaubliAdapter({ robot: driven, scheduler, network, host: HOST });
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
