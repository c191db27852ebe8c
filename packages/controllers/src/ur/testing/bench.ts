import { manualScheduler, robotById, type ManualScheduler, type RealController, type Robot } from "@twincell/core";
import { createRealController } from "../../driver/index.ts";
import { memoryNetwork, type ByteStream, type MemoryNetwork } from "../../transport/index.ts";
import { lineBytes, lineReader } from "../codec/lines.ts";
import { createUrAdapter, createVirtualUr, UR_PORTS, type VirtualUr, type VirtualUrOptions } from "../index.ts";

export const robot: Robot = robotById("ur10e")!;
export const HOST = "127.0.0.2";

export interface UrBench {
  readonly scheduler: ManualScheduler;
  readonly network: MemoryNetwork;
  readonly ur: VirtualUr;
  readonly log: string[];
  /** A connection to one of its ports, and what came over it so far. */
  connect(
    port: keyof typeof UR_PORTS,
  ): Promise<{ readonly stream: ByteStream; readonly got: number[]; readonly ended: () => boolean }>;
  /** A dashboard: says a line, answers with the next. */
  dashboard(): Promise<(command: string) => Promise<string>>;
  /** A driver that is connected. */
  driver(): Promise<RealController>;
}

/** A virtual controller on a network in memory, on a clock of its own. */
export async function urBench(options: Partial<VirtualUrOptions> = {}): Promise<UrBench> {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const log: string[] = [];
  const started = await createVirtualUr({
    robot,
    scheduler,
    network,
    host: HOST,
    powerOn_s: 0.5,
    brakes_s: 0.5,
    interpret: () => ({ kind: "not-understood", faults: [] }),
    log: sentence => {
      log.push(sentence);
    },
    ...options,
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  const ur = started.virtual;

  async function connect(port: keyof typeof UR_PORTS) {
    let stream: ByteStream | null = null;
    let over = false;
    const got: number[] = [];
    void network.connect({ host: HOST, port: UR_PORTS[port] }).then(answer => {
      if (answer.kind === "refused") throw new Error(answer.sentence);
      stream = answer.stream;
      stream.onBytes(lent => {
        for (const byte of lent) got.push(byte);
      });
      stream.onEnd(() => {
        over = true;
      });
    });
    await scheduler.elapse(0.01);
    return { stream: stream!, got, ended: () => over };
  }
  return {
    scheduler,
    network,
    ur,
    log,
    connect,
    async dashboard() {
      const { stream } = await connect("dashboard");
      const lines = lineReader();
      const heard: string[] = [];
      stream.onBytes(lent => {
        lines.push(lent, line => {
          heard.push(line);
        });
      });
      return async command => {
        heard.length = 0;
        stream.send(lineBytes(command));
        await scheduler.elapse(0.01);
        return heard.join("|");
      };
    },
    async driver() {
      const controller = createRealController({
        face: createUrAdapter({ robot, scheduler, network, host: HOST }),
        scheduler,
      });
      void controller.connect();
      for (let i = 0; i < 300 && !controller.isConnected; i++) await scheduler.elapse(0.01);
      if (!controller.isConnected) throw new Error(controller.link.sentence);
      return controller;
    },
  };
}
