import { manualScheduler, robotById } from "@twincell/core";
import { createRealController } from "../../driver/index.ts";
import { endedOn } from "../../testing/index.ts";
import { memoryNetwork } from "../../transport/index.ts";
import {
  createFanucAdapter,
  createVirtualFanuc,
  type FanucAdapterOptions,
  type VirtualFanucOptions,
} from "../index.ts";

export const robot = robotById("fanuc_lrmate200id")!;
export const HOST = "127.0.0.5";
export const shifted = (by_rad: number): number[] => Array.from(robot.home_rad, q => q + by_rad);

/** A virtual controller and a driver that is connected to it, over a network in memory. */
export async function bench(
  more: { readonly virtual?: Partial<VirtualFanucOptions>; readonly face?: Partial<FanucAdapterOptions> } = {},
) {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const log: string[] = [];
  const started = await createVirtualFanuc({
    robot,
    scheduler,
    network,
    host: HOST,
    log: sentence => {
      log.push(sentence);
    },
    ...more.virtual,
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  const real = createRealController({
    face: createFanucAdapter({ robot, scheduler, network, host: HOST, period_s: 0.004, ...more.face }),
    scheduler,
  });
  const connecting = real.connect();
  await scheduler.elapse(0.1);
  await connecting;
  return { scheduler, network, fanuc: started.virtual, real, log, ended: endedOn(scheduler) };
}
