import { robotById, type Executed, type Interpreted, type RealController, type Robot, type Step } from "@twincell/core";
import { createRealController } from "../../driver/index.ts";
import { endedOn, manualScheduler } from "../../testing/index.ts";
import { memoryNetwork, type MemoryNetwork } from "../../transport/index.ts";
import {
  createKukaAdapter,
  createVirtualKuka,
  startLoop,
  type KukaAdapterOptions,
  type VirtualKuka,
  type VirtualKukaOptions,
} from "../index.ts";

export const KR6: Robot = robotById("kuka_kr6r900sixx")!;
export const HOST = "127.0.0.3";

/**
 * A text of one joint move a line, in degrees: enough to show that a controller executes what it is handed. KRL itself
 * is read in the apps' tests.
 */
export function interpretMoves(text: string): Interpreted {
  const lines = text.split(/\r?\n/);
  const faulty = lines.findIndex(line => line !== "" && !/^(DEF.*|END|PTP( -?[0-9.]+){6})$/.test(line));
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
        if (!line.startsWith("PTP")) continue;
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

export interface KukaBench {
  readonly scheduler: ReturnType<typeof manualScheduler>;
  readonly network: MemoryNetwork;
  readonly kuka: VirtualKuka;
  readonly real: RealController;
  readonly log: string[];
}
/** A virtual KUKA with the loop running, and a driver that is connected to it, over a network in memory. */
export async function kukaBench(
  more: {
    readonly virtual?: Partial<VirtualKukaOptions>;
    readonly face?: Partial<KukaAdapterOptions>;
    readonly running?: boolean;
  } = {},
): Promise<KukaBench> {
  const scheduler = (more.virtual?.scheduler as ReturnType<typeof manualScheduler> | undefined) ?? manualScheduler();
  const network = memoryNetwork(scheduler);
  const log: string[] = [];
  const kuka = await createVirtualKuka({
    robot: KR6,
    scheduler,
    network,
    host: HOST,
    interpret: interpretMoves,
    log: sentence => {
      log.push(sentence);
    },
    ...more.virtual,
  });
  if (more.running !== false) startLoop(kuka);
  await scheduler.elapse(0.02);
  const adapter = createKukaAdapter({ robot: KR6, scheduler, network, host: HOST, period_s: 0.004, ...more.face });
  const real = createRealController({ face: adapter, scheduler });
  const connecting = real.connect();
  await scheduler.elapse(0.05);
  await connecting;
  await scheduler.elapse(0.02);
  return { scheduler, network, kuka, real, log };
}
/** Lets a command run to its end. */
export const ended = <T>(
  { scheduler }: Pick<KukaBench, "scheduler">,
  command: Promise<T>,
  most_s?: number,
): Promise<T> => endedOn(scheduler, 0.02, most_s)(command);
