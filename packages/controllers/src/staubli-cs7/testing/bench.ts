import { robotById, type Executed, type Interpreted, type RealController, type Robot, type Step } from "@twincell/core";
import { createRealController } from "../../driver/index.ts";
import { endedOn, manualScheduler } from "../../testing/index.ts";
import { memoryNetwork, type MemoryNetwork } from "../../transport/index.ts";
import {
  createCs7Adapter,
  createVirtualCs7,
  type Cs7FaceOptions,
  type VirtualCs7,
  type VirtualCs7Options,
} from "../index.ts";

export const RX90L: Robot = robotById("staubli_rx90l")!;
export const HOST = "127.0.0.7";
/** Postures near the one it begins in; a radian to either side is within its limits. */
export const shifted = (by_rad: number): number[] => RX90L.home_rad.map((q, i) => (i < 3 ? q + by_rad : q));

/**
 * Programs of joint moves, one `MOVE #PPOINT(…)` a line: enough to show that texts are executed. V+ itself is read in
 * the apps' tests.
 */
export function interpretMoves(text: string): Interpreted {
  const lines = text.split(/\r?\n/);
  const faulty = lines.findIndex(
    line => line !== "" && !/^(\.PROGRAM .*|\.END|(DO )?MOVE #PPOINT\([-0-9.,]+\)|DO (SET )?[#\w.]+ = .*)$/.test(line),
  );
  if (faulty >= 0)
    return {
      kind: "not-understood",
      faults: [{ line: faulty + 1, column: 1, expected: "a joint move", sentence: "Unexpected text" }],
    };
  return {
    kind: "ready",
    context: { tools: {}, frames: {} },
    *run(): Generator<Executed, void> {
      for (const [i, line] of lines.entries()) {
        const q = /MOVE #PPOINT\((.*)\)/
          .exec(line)?.[1]
          ?.split(",")
          .map(value => (Number(value) * Math.PI) / 180);
        const step: Step | undefined = q && {
          id: "",
          type: "move",
          path: "ptp",
          target: { q },
          speed: { ratio: 1 },
          blend_m: 0,
        };
        if (line.startsWith(".END")) return;
        yield { line: i + 1, ...(step ? { step } : {}) };
      }
    },
  };
}

export interface Cs7Bench {
  readonly scheduler: ReturnType<typeof manualScheduler>;
  readonly network: MemoryNetwork;
  readonly cs7: VirtualCs7;
  readonly real: RealController;
  readonly log: string[];
  readonly ended: <T>(command: Promise<T>) => Promise<T>;
}
export async function bench(
  more: { readonly virtual?: Partial<VirtualCs7Options>; readonly face?: Partial<Cs7FaceOptions> } = {},
): Promise<Cs7Bench> {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const log: string[] = [];
  const started = await createVirtualCs7({
    robot: RX90L,
    scheduler,
    network,
    host: HOST,
    interpret: interpretMoves,
    log: sentence => {
      log.push(sentence);
    },
    ...more.virtual,
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  const real = createRealController({
    face: createCs7Adapter({ robot: RX90L, scheduler, network, host: HOST, period_s: 0.02, ...more.face }),
    scheduler,
  });
  const connecting = real.connect();
  await scheduler.elapse(0.2);
  await connecting;
  return {
    scheduler,
    network,
    cs7: started.virtual,
    real,
    log,
    ended: endedOn(scheduler),
  };
}
