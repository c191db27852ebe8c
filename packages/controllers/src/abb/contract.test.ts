import { manualScheduler, robotById } from "@twincell/core";
import { createRealController } from "../driver/index.ts";
import { describeController } from "../testing/index.ts";
import { memoryNetwork } from "../transport/index.ts";
import { ABB_CANNOT, ABB_EGM_CANNOT } from "./cannot.ts";
import { abbEgmAdapter, abbAdapter } from "./adapter/index.ts";
import { createVirtualAbb } from "./virtual/index.ts";

const HOST = "127.0.0.1";
const irb120 = robotById("abb_irb120")!;

for (const [name, cannot, rws] of [
  ["EGM and Robot Web Services", ABB_CANNOT, 80],
  ["EGM alone", ABB_EGM_CANNOT, undefined],
] as const) {
  describeController(`ABB driver (${name}) on its virtual controller`, {
    robot: irb120,
    scheduler: manualScheduler,
    cannot,
    // The last of the way is first-order, and the end is seen a cycle later.
    answer_s: 0.4,
    resolution: { q_rad: 1e-5, position_m: 3e-5, angle_rad: 6e-5 },
    async make({ robot, scheduler, start_rad, maxSpeed, initialize, onMotion }) {
      const network = memoryNetwork(scheduler);
      const started = await createVirtualAbb({
        robot,
        scheduler,
        network,
        host: HOST,
        start_rad,
        ...(rws === undefined ? {} : { rws }),
      });
      if (started.kind === "taken") throw new Error(started.sentence);
      const options = { robot, scheduler, network, host: HOST, ...(maxSpeed === undefined ? {} : { maxSpeed }) };
      const adapter = rws === undefined ? abbEgmAdapter(options) : abbAdapter(options);
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
}
