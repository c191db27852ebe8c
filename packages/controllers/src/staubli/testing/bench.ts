import { robotById, type Executed, type Interpreted, type RealController, type Robot, type Step } from "@twincell/core";
import { createRealController } from "../../driver/index.ts";
import { endedOn, manualScheduler } from "../../testing/index.ts";
import { memoryNetwork, type MemoryNetwork } from "../../transport/index.ts";
import {
  createStaubliAdapter,
  createVirtualStaubli,
  type StaubliAdapterOptions,
  type VirtualStaubli,
  type VirtualStaubliOptions,
} from "../index.ts";

export const RX160: Robot = robotById("staubli_rx160")!;
export const HOST = "127.0.0.6";
/** Where the robot stands at first, and postures near it: a radian to either side is within its limits. */
export const BEGIN_RAD: readonly number[] = [0, 0.3, 0.8, 0, 0.3, 0];
export const shifted = (by_rad: number): number[] => BEGIN_RAD.map(q => q + by_rad);

/**
 * A text of one joint move a line, in degrees: enough to show that a controller executes what it is handed. VAL 3
 * itself is read in the apps' tests.
 */
export function interpretMoves(text: string): Interpreted {
  const lines = text.split("\n");
  const faulty = lines.findIndex(line => line !== "" && !/^movej( -?[0-9.]+){6}$/.test(line));
  if (faulty >= 0)
    return {
      kind: "not-understood",
      faults: [{ line: faulty + 1, column: 1, expected: "a joint move", sentence: "This is no joint move." }],
    };
  return {
    kind: "ready",
    context: { tools: {}, frames: {} },
    *run(): Generator<Executed, void> {
      for (const [i, line] of lines.entries()) {
        if (line === "") continue;
        const q = line
          .split(" ")
          .slice(1)
          .map(value => (Number(value) * Math.PI) / 180);
        const step: Step = { id: "", type: "move", path: "ptp", target: { q }, speed: { ratio: 1 }, blend_m: 0 };
        yield { line: i + 1, step };
      }
    },
  };
}

export interface StaubliBench {
  readonly scheduler: ReturnType<typeof manualScheduler>;
  readonly network: MemoryNetwork;
  readonly staubli: VirtualStaubli;
  readonly real: RealController;
  readonly log: string[];
  readonly ended: <T>(command: Promise<T>) => Promise<T>;
}
/** A virtual controller with ros_server running, and a driver that is connected to it, over a network in memory. */
export async function bench(
  more: { readonly virtual?: Partial<VirtualStaubliOptions>; readonly face?: Partial<StaubliAdapterOptions> } = {},
): Promise<StaubliBench> {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const log: string[] = [];
  const started = await createVirtualStaubli({
    robot: RX160,
    scheduler,
    network,
    host: HOST,
    interpret: interpretMoves,
    start_rad: BEGIN_RAD,
    log: sentence => {
      log.push(sentence);
    },
    ...more.virtual,
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  const real = createRealController({
    face: createStaubliAdapter({ robot: RX160, scheduler, network, host: HOST, ...more.face }),
    scheduler,
  });
  const connecting = real.connect();
  await scheduler.elapse(1.5);
  await connecting;
  return {
    scheduler,
    network,
    staubli: started.virtual,
    real,
    log,
    ended: endedOn(scheduler),
  };
}
