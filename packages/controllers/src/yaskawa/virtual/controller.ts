import {
  brakingTime_s,
  identity,
  seededRandom,
  type CommandOutcome,
  type Pose,
  type Robot,
  type Scheduler,
} from "@twincell/core";
import { addressText, type Network } from "../../transport/index.ts";
import { createVirtualController, type VirtualController } from "../../virtual/index.ts";
import {
  DIVISION,
  exampleScale,
  FILE_PORT,
  HEADER_BYTES,
  LAST_BLOCK,
  MAX_DATA_BYTES,
  ROBOT_PORT,
  SERVICE,
  STATUS,
  readRequest,
  writeReply,
  type HsesReply,
  type HsesRequest,
  type PulseScale,
} from "../codec/index.ts";
import { answerer, type Answer } from "./answers.ts";
import { faultySocket, noFaults, type Faults } from "./faults.ts";
import { fileServer } from "./files.ts";
import { Files } from "./jobs.ts";
import { Machine, type Interpret, type KeySwitch } from "./machine.ts";
import { Lines, Variables } from "./memory.ts";

export interface VirtualYaskawaOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  /** UDP ports of the robot commands and of the files; the vendor's own when left out. */
  readonly ports?: { readonly robot: number; readonly files: number };
  /** Runs job text. Without one jobs are kept and not started. */
  readonly interpret?: Interpret;
  /** How pulses are counted; an example when left out. */
  readonly scale?: PulseScale;
  /** What 0x89 answers; the name of the robot when left out. */
  readonly model?: string;
  readonly mode?: KeySwitch;
  readonly servo?: boolean;
  readonly servoOn_s?: number;
  readonly cycle_s?: number;
  readonly start_rad?: ArrayLike<number>;
  readonly maxSpeed?: number;
  /** Tools and user frames of moves by command; those of jobs are in their text. */
  readonly tools?: ReadonlyMap<number, Pose<"flange", "tcp">>;
  readonly users?: ReadonlyMap<number, Pose<"base", "frame">>;
  /** Time of day at the start [s since 1970]. */
  readonly began_unix_s?: number;
  readonly seed?: number;
  readonly initialize?: () => void;
  readonly onMotion?: (q_rad: ArrayLike<number>) => void;
  /** Told once about each kind of flawed packet from each sender. */
  readonly log?: (sentence: string) => void;
}

/** What a person does at the robot and at its pendant (rows T-26, T-27). */
export interface YaskawaPendant {
  setMode(mode: KeySwitch): void;
  setCommandRemote(on: boolean): void;
  setServo(on: boolean): number;
  emergencyStop(pressed: boolean): void;
  hold(pressed: boolean): void;
  /** Starts the job that was selected, in PLAY. */
  start(): number;
  select(job: string): number;
  setOverride(percent: number): void;
  jog(q_rad: ArrayLike<number>, ratio?: number): Promise<CommandOutcome>;
  raiseAlarm(code: number, name: string, data?: number, major?: boolean): void;
  reset(): void;
  /** Somebody is near the robot, or its gate is open. */
  setGuardOpen(open: boolean): void;
  /** What is wired to IN#(number). */
  setInput(number: number, on: boolean): void;
  /** What 0x85 wrote, and why the last job ended. */
  readonly text: string;
  readonly message: string;
}

export interface VirtualYaskawa {
  readonly robot: Robot;
  /** The robot that moves: for showing it, and for tests. */
  readonly neutral: VirtualController;
  readonly pendant: YaskawaPendant;
  readonly faults: Faults;
  readonly files: Files;
  readonly lines: Lines;
  readonly machine: Pick<
    Machine,
    "status" | "alarms" | "keySwitch" | "speedOverride" | "place" | "message" | "servoIsComing"
  >;
  readonly scale: PulseScale;
  /** Longest time from a hold until standstill [s]. */
  readonly brakingTime_s: number;
  /** Off for so long, then on again: servo off, no job selected; jobs and variables are kept. */
  reboot(off_s: number): void;
  readonly ports: { readonly robot: number; readonly files: number };
  close(): void;
}
export type YaskawaStart =
  | { readonly kind: "listening"; readonly controller: VirtualYaskawa }
  | { readonly kind: "taken"; readonly sentence: string };

/** Clients whose last order is remembered, and for how long an order with the same id counts as said again [s]. */
const MOST_CLIENTS = 64;
const AGAIN_S = 2;
const MOST_LOGGED = 100;
const CYCLE_S = 0.004;
const READING: readonly number[] = [SERVICE.getAll, SERVICE.getOne, SERVICE.getMany];

interface Client {
  id: number;
  counts: boolean;
  at_s: number;
  order: Uint8Array | null;
  answer: Answer | null;
}

/**
 * A virtual FS100/DX200/YRC1000: the states of the vendor, its bytes on UDP, its job text, in front of the neutral
 * virtual robot.
 */
export async function createVirtualYaskawa(options: VirtualYaskawaOptions): Promise<YaskawaStart> {
  const { robot, scheduler, network, host } = options;
  const random = seededRandom(options.seed ?? 1);
  const faults = noFaults();
  const wanted = options.ports ?? { robot: ROBOT_PORT, files: FILE_PORT };
  const robotPort = await network.bind({ host, port: wanted.robot });
  if (robotPort.kind === "taken") return robotPort;
  const filePort = await network.bind({ host, port: wanted.files });
  if (filePort.kind === "taken") {
    robotPort.socket.close();
    return filePort;
  }

  const { start_rad, maxSpeed, initialize, onMotion } = options;
  const neutral = createVirtualController({
    robot,
    scheduler,
    cycle_s: options.cycle_s ?? CYCLE_S,
    ...(start_rad ? { start_rad } : {}),
    ...(maxSpeed === undefined ? {} : { maxSpeed }),
    ...(initialize ? { initialize } : {}),
  });
  const scale = options.scale ?? exampleScale(robot);
  const files = new Files();
  const variables = new Variables();
  const lines = new Lines(neutral.signals);
  const zero_s = scheduler.now_s();
  const unix_s = (): number => (options.began_unix_s ?? 0) + scheduler.now_s() - zero_s;
  const machine = new Machine({
    robot,
    neutral,
    files,
    mode: options.mode ?? "remote",
    servo: options.servo ?? true,
    servoOn_s: options.servoOn_s ?? 0.4,
    unix_s,
    ...(options.interpret ? { interpret: options.interpret } : {}),
  });
  let text = "";
  let isOff = false;
  let stopWaiting: () => void = () => {
    /* Nothing is waited for yet. */
  };
  const answer = answerer({
    robot,
    neutral,
    machine,
    lines,
    variables,
    scale,
    model: options.model ?? robot.vendorSection?.model ?? robot.name.toUpperCase(),
    unix_s,
    display: shown => {
      text = shown;
    },
    tools: new Map([[0, identity<"flange", "tcp">()], ...(options.tools ?? [])]),
    users: options.users ?? new Map<number, Pose<"base", "frame">>(),
    ...(onMotion ? { onMotion } : {}),
  });
  const answerFile = fileServer({
    files,
    now_s: () => scheduler.now_s(),
    fromOutside: () => machine.fromOutside(),
    isRunning: () => machine.isBusy,
  });
  const clients = new Map<string, Client>();
  const logged = new Set<string>();

  /**
   * An order that comes again with the same id gets the same answer and is not carried out again. Clients that never
   * change their id cannot be told apart from themselves: theirs are always new.
   */
  function once(request: HsesRequest, from: string): Answer {
    const now_s = scheduler.now_s();
    const known = clients.get(from);
    const client: Client = known ?? { id: request.id, counts: false, at_s: now_s, order: null, answer: null };
    if (!known) {
      if (clients.size >= MOST_CLIENTS) clients.delete(clients.keys().next().value!);
      clients.set(from, client);
    }
    client.counts ||= request.id !== client.id;
    const isOrder = !READING.includes(request.service);
    const bytes = isOrder ? orderBytes(request) : null;
    if (bytes && client.counts && client.answer && now_s - client.at_s <= AGAIN_S && same(client.order, bytes))
      return client.answer;
    const answered = answer(request);
    client.id = request.id;
    if (bytes) {
      client.order = bytes;
      client.answer = answered;
      client.at_s = now_s;
    }
    return answered;
  }

  function log(from: string, sentence: string): void {
    const line = `${from}: ${sentence}`;
    if (logged.size >= MOST_LOGGED || logged.has(line)) return;
    logged.add(line);
    options.log?.(line);
  }

  const out = new Uint8Array(HEADER_BYTES + MAX_DATA_BYTES);
  const nothing = new Uint8Array(0);
  const robotSocket = faultySocket(robotPort.socket, faults, scheduler, random);
  const fileSocket = faultySocket(filePort.socket, faults, scheduler, random);
  for (const [socket, division] of [
    [robotSocket, DIVISION.robot],
    [fileSocket, DIVISION.file],
  ] as const) {
    const send = (reply: HsesReply, to: Parameters<typeof socket.send>[1]): void => {
      socket.send(out.subarray(0, writeReply(reply, out)), to);
    };
    socket.onDatagram((lent, from) => {
      if (isOff) return;
      const read = readRequest(lent);
      const sender = addressText(from);
      const flaw =
        read.kind === "flawed"
          ? read
          : read.packet.division !== division
            ? { added: 0xe4a3, sentence: `Division ${read.packet.division} has another port.` }
            : null;
      if (read.kind === "flawed" || flaw) {
        log(sender, flaw!.sentence);
        // What is not even a header is not answered.
        if (lent.length >= HEADER_BYTES)
          send(
            {
              division,
              id: lent[11]!,
              block: LAST_BLOCK,
              service: lent[29]! & 0x7f,
              status: STATUS.refused,
              added: flaw!.added,
              data: nothing,
            },
            from,
          );
        return;
      }
      const { packet } = read;
      const { id, service } = packet;
      if (division === DIVISION.robot) {
        // Answers of a robot command are one block; there is nothing to acknowledge.
        if (!packet.ack) send({ division, id, block: LAST_BLOCK, service, ...once(packet, sender) }, from);
        return;
      }
      const answered = answerFile(packet, sender);
      if (answered) send({ division, id, service, ...answered }, from);
    });
  }

  const controller: VirtualYaskawa = {
    robot,
    neutral,
    machine,
    lines,
    faults,
    files,
    scale,
    brakingTime_s: brakingTime_s(robot) + 2 * (options.cycle_s ?? CYCLE_S),
    ports: { robot: robotSocket.address.port, files: fileSocket.address.port },
    pendant: {
      get text() {
        return text;
      },
      get message() {
        return machine.message;
      },
      setMode(mode) {
        machine.turn(mode);
      },
      setCommandRemote(on) {
        machine.setCommandRemote(on);
      },
      setServo: on => machine.servo(on),
      emergencyStop(pressed) {
        machine.pressEmergencyStop(pressed);
      },
      hold(pressed) {
        machine.hold("heldByPendant", pressed);
      },
      start: () => machine.start(),
      select: job => machine.select(job, 0),
      setOverride(percent) {
        machine.setOverride(percent / 100);
      },
      jog: (q_rad, ratio) => machine.jog(q_rad, ratio),
      raiseAlarm(code, name, data, major) {
        machine.raise(code, name, data, major);
      },
      reset() {
        machine.resetAlarm();
      },
      setGuardOpen(open) {
        machine.openGuard(open);
      },
      setInput(number, on) {
        lines.setInput(number, on);
      },
    },
    reboot(off_s) {
      machine.reboot();
      clients.clear();
      text = "";
      isOff = true;
      stopWaiting();
      const stop = scheduler.every(off_s, () => {
        stop();
        isOff = false;
      });
      stopWaiting = stop;
    },
    close() {
      stopWaiting();
      robotSocket.close();
      fileSocket.close();
      neutral.close();
    },
  };
  return { kind: "listening", controller };
}

/** What makes an order the same one: id, numbers and data. */
function orderBytes({ id, command, instance, attribute, service, data }: HsesRequest): Uint8Array {
  const bytes = new Uint8Array(7 + data.length);
  bytes.set([id, command & 255, command >> 8, instance & 255, instance >> 8, attribute, service]);
  bytes.set(data, 7);
  return bytes;
}
const same = (a: Uint8Array | null, b: Uint8Array): boolean =>
  a !== null && a.length === b.length && a.every((byte, i) => byte === b[i]);
