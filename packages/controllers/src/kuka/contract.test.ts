import { manualScheduler } from "@twincell/core";
import { createRealController } from "../driver/index.ts";
import { describeController } from "../testing/index.ts";
import { memoryNetwork } from "../transport/index.ts";
import { KUKA_CANNOT, KUKA_RSI_CANNOT } from "./cannot.ts";
import {
  axisConfig,
  createKukaAdapter,
  createKukaRsiAdapter,
  createVirtualKuka,
  RSI_NAME,
  startLoop,
} from "./index.ts";
import { HOST, interpretMoves, KR6 } from "./testing/bench.ts";

describeController("KUKA driver on its virtual controller, over variables", {
  robot: KR6,
  scheduler: manualScheduler,
  cannot: KUKA_CANNOT,
  async make({ robot, scheduler, start_rad, maxSpeed, initialize, onMotion }) {
    const network = memoryNetwork(scheduler);
    const model = "#KR6R900SIXX";
    // As many digits as there are: what is compared here is the driver, not the rounding of a 32-bit REAL (that is
    // T-23's).
    const kuka = await createVirtualKuka({
      robot,
      scheduler,
      network,
      host: HOST,
      interpret: interpretMoves,
      model,
      start_rad,
      digits: 14,
      ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    startLoop(kuka);
    const adapter = createKukaAdapter({ robot, scheduler, network, host: HOST, model, period_s: 0.004 });
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

describeController("KUKA driver on its virtual controller, over RSI", {
  robot: KR6,
  scheduler: manualScheduler,
  cannot: KUKA_RSI_CANNOT,
  async make({ robot, scheduler, start_rad, maxSpeed, initialize, onMotion }) {
    const network = memoryNetwork(scheduler);
    const model = "#KR6R900SIXX";
    const config = axisConfig("127.0.0.1", 49_152);
    const kuka = await createVirtualKuka({
      robot,
      scheduler,
      network,
      host: HOST,
      interpret: interpretMoves,
      model,
      start_rad,
      digits: 14,
      rsi: { config, decimals: 10 },
      ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    startLoop(kuka, RSI_NAME);
    const adapter = createKukaRsiAdapter({
      robot,
      scheduler,
      network,
      host: HOST,
      model,
      period_s: 0.012,
      config,
      decimals: 10,
    });
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
