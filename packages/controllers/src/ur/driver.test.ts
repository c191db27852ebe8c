import { manualScheduler, robotById } from "@twincell/core";
import { createRealController } from "../real/index.ts";
import { describeController } from "../testing/contract.ts";
import { memoryNetwork } from "../transport/index.ts";
import { createUrFace, createVirtualUr } from "./index.ts";

const robot = robotById("ur10e")!, HOST = "127.0.0.2";

describeController("UR driver on its virtual controller", {
  // Two cycles of 2 ms and the way there and back.
  robot, scheduler: manualScheduler, answer_s: 0.005,
  async make({ scheduler, robot: driven, start_rad, maxSpeed, initialize, onMotion }) {
    const network = memoryNetwork(scheduler);
    const started = await createVirtualUr({
      robot: driven, scheduler, network, host: HOST, start_rad, powerOn_s: 0.1, brakes_s: 0.1, interpret: () => ({ kind: "not-understood", faults: [] }), ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    if (started.kind === "taken") throw new Error(started.sentence);
    const face = createUrFace({ robot: driven, scheduler, network, host: HOST });
    const controller = createRealController({ face, scheduler, ...(initialize ? { initialize } : {}), ...(onMotion ? { onMotion } : {}) });
    let connected = false;
    void controller.connect().then(outcome => { connected = outcome.kind === "done"; });
    for (let i = 0; i < 200 && !connected; i++) await scheduler.elapse(0.01);
    if (!connected) throw new Error(controller.link.sentence);
    await scheduler.elapse(0.02);
    return controller;
  },
});
