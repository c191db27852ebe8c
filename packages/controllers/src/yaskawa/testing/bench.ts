import {
  manualScheduler,
  robotById,
  type CommandOutcome,
  type Executed,
  type Interpreted,
  type JointSample,
  type ManualScheduler,
  type RealController,
  type Step,
} from "@twincell/core";
import { createRealController } from "../../driver/index.ts";
import { memoryNetwork, type DatagramSocket, type MemoryNetwork } from "../../transport/index.ts";
import { DIVISION, exampleScale, readReply, writeRequest, type HsesReply, type HsesRequest } from "../codec/index.ts";
import { yaskawaAdapter, type YaskawaAdapter, type YaskawaAdapterOptions } from "../adapter/index.ts";
import { createVirtualYaskawa, type VirtualYaskawa, type VirtualYaskawaOptions } from "../virtual/index.ts";

export const HOST = "127.0.0.1";
export const gp8 = robotById("yaskawa_gp8")!;

/** A controller in memory, its driver connected to it, and everything that was heard. */
export interface Bench {
  readonly scheduler: ManualScheduler;
  readonly network: MemoryNetwork;
  readonly virtual: VirtualYaskawa;
  readonly face: YaskawaAdapter;
  readonly real: RealController;
  readonly heard: JointSample[];
  readonly log: string[];
  carryOut(
    command: Promise<CommandOutcome>,
    most_s?: number,
  ): Promise<{ readonly outcome: CommandOutcome; readonly took_s: number }>;
}
export async function bench(
  virtualOptions: Partial<VirtualYaskawaOptions> = {},
  faceOptions: Partial<YaskawaAdapterOptions> = {},
  connect = true,
): Promise<Bench> {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const log: string[] = [];
  const heard: JointSample[] = [];
  const started = await createVirtualYaskawa({
    robot: gp8,
    scheduler,
    network,
    host: HOST,
    interpret,
    log: line => {
      log.push(line);
    },
    servoOn_s: 0.1,
    ...virtualOptions,
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  const adapter = yaskawaAdapter({
    robot: gp8,
    scheduler,
    network,
    host: HOST,
    scale: exampleScale(gp8),
    ...faceOptions,
  });
  const real = createRealController({ face: adapter, scheduler });
  real.onSample(sample => {
    heard.push({ ...sample, q_rad: sample.q_rad.slice() });
    if (heard.length > 4000) heard.shift();
  });
  if (connect) {
    void real.connect();
    await scheduler.elapse(0.2);
  }
  const carryOut = async (
    command: Promise<CommandOutcome>,
    most_s = 60,
  ): Promise<{ outcome: CommandOutcome; took_s: number }> => {
    const begun_s = scheduler.now_s();
    let outcome: CommandOutcome | undefined;
    let took_s = 0;
    void command.then(is => {
      outcome = is;
      took_s = scheduler.now_s() - begun_s;
    });
    while (!outcome && scheduler.now_s() - begun_s < most_s) await scheduler.elapse(0.05);
    if (!outcome) throw new Error(`The command took more than ${most_s} s.`);
    return { outcome, took_s };
  };
  return { scheduler, network, virtual: started.controller, face: adapter, real, heard, log, carryOut };
}

/** From home, every joint turned by so much. */
export const turned = (by_rad: number): number[] => Array.from(gp8.home_rad, q => q + by_rad);

/** Asks one packet at a time, as it is given. */
export interface RawClient {
  ask(request: Partial<HsesRequest>): Promise<HsesReply | null>;
  send(bytes: Uint8Array): void;
  readonly answers: number[];
  readonly socket: DatagramSocket;
}
export async function rawClient(
  { scheduler, network, virtual }: Pick<Bench, "scheduler" | "network" | "virtual">,
  files = false,
): Promise<RawClient> {
  const bound = await network.bind({ host: HOST, port: 0 });
  if (bound.kind === "taken") throw new Error(bound.sentence);
  const { socket } = bound;
  const out = new Uint8Array(600);
  const to = { host: HOST, port: files ? virtual.ports.files : virtual.ports.robot };
  const answers: number[] = [];
  let last: HsesReply | null = null;
  socket.onDatagram(lent => {
    answers.push(lent.length);
    const read = readReply(lent);
    last = read.kind === "packet" ? { ...read.packet, data: read.packet.data.slice() } : null;
  });
  return {
    answers,
    socket,
    send(bytes) {
      socket.send(bytes, to);
    },
    async ask(request) {
      last = null;
      const whole: HsesRequest = {
        division: files ? DIVISION.file : DIVISION.robot,
        ack: false,
        id: 1,
        block: 0,
        command: 0,
        instance: 0,
        attribute: 0,
        service: 0,
        data: new Uint8Array(0),
        ...request,
      };
      socket.send(out.subarray(0, writeRequest(whole, out)), to);
      await scheduler.elapse(0.003);
      return last;
    },
  };
}

/**
 * A few words of a language of the tests' own between NOP and END: `MOVJ angle` turns joint 1, `W seconds` waits, `O n`
 * and `I n` are lines.
 */
export function interpret(text: string): Interpreted {
  const lines = text.split("\n");
  const nop = lines.findIndex(line => line.trim() === "NOP");
  const end = lines.findIndex(line => line.trim() === "END");
  const bad = lines.slice(nop + 1, end).findIndex(line => !/^(MOVJ|W|O|I) -?[\d.]+$/.test(line.trim()));
  if (bad >= 0)
    return {
      kind: "not-understood",
      faults: [{ line: nop + bad + 2, column: 1, expected: "a word", sentence: "There is no such word." }],
    };
  return {
    kind: "ready",
    context: { tools: {}, frames: {} },
    *run(): Generator<Executed, void> {
      for (let i = nop + 1; i < end; i++) {
        const [word, value] = lines[i]!.trim().split(" ");
        const number = Number(value);
        const id = `L${i + 1}`;
        yield { line: i + 1, step: stepOf(word!, number, id) };
      }
    },
  };
}
function stepOf(word: string, number: number, id: string): Step {
  switch (word) {
    case "MOVJ":
      return {
        id,
        type: "move",
        path: "ptp",
        target: { q: [number, ...gp8.home_rad.slice(1)] },
        speed: { ratio: 0.5 },
        blend_m: 0,
      };
    case "W":
      return { id, type: "wait", s: number };
    case "O":
      return { id, type: "set", signal: `ot_${number}`, to: true };
    default:
      return { id, type: "wait-for", when: { signal: `in_${number}`, is: true } };
  }
}
export const job = (name: string, ...words: string[]): string =>
  ["/JOB", `//NAME ${name}`, "//INST", "NOP", ...words, "END", ""].join("\n");
