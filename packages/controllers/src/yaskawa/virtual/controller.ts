import type { Division } from "../codec/packet.ts";
import type { DatagramSocket } from "../../transport/port.ts";
import {
  brakingTime_s,
  identity,
  seededRandom,
  type CommandOutcome,
  type Pose,
  type Robot,
  type Scheduler,
  type Random,
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
import { fileServer, type FileAnswer } from "./files.ts";
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
  const { network, host } = options;
  const wanted = options.ports ?? { robot: ROBOT_PORT, files: FILE_PORT };
  const robotPort = await network.bind({ host, port: wanted.robot });
  if (robotPort.kind === "taken") return robotPort;
  const filePort = await network.bind({ host, port: wanted.files });
  if (filePort.kind === "taken") {
    robotPort.socket.close();
    return filePort;
  }
  return { kind: "listening", controller: yaskawaOn(options, robotPort.socket, filePort.socket) };
}

function yaskawaOn(
  options: VirtualYaskawaOptions,
  robotPort: DatagramSocket,
  filePort: DatagramSocket,
): VirtualYaskawa {
  return virtualYaskawaOf(new YaskawaControllerState(options, robotPort, filePort));
}

class YaskawaControllerState {
  readonly options: VirtualYaskawaOptions;
  readonly robotPort: DatagramSocket;
  readonly filePort: DatagramSocket;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly random: Random;
  readonly faults = noFaults();
  readonly start_rad: ArrayLike<number> | undefined;
  readonly maxSpeed: number | undefined;
  readonly initialize: (() => void) | undefined;
  readonly onMotion: ((q_rad: ArrayLike<number>) => void) | undefined;
  readonly neutral: VirtualController;
  readonly scale: PulseScale;
  readonly files = new Files();
  readonly variables = new Variables();
  readonly lines: Lines;
  readonly zero_s: number;
  readonly machine: Machine;
  text = "";
  isOff = false;
  readonly answer: (request: HsesRequest) => Answer;
  readonly answerFile: (request: HsesRequest, from: string) => FileAnswer | null;
  readonly clients = new Map<string, Client>();
  readonly logged = new Set<string>();
  readonly out = new Uint8Array(HEADER_BYTES + MAX_DATA_BYTES);
  readonly nothing = new Uint8Array(0);
  readonly robotSocket: DatagramSocket;
  readonly fileSocket: DatagramSocket;

  constructor(options: VirtualYaskawaOptions, robotPort: DatagramSocket, filePort: DatagramSocket) {
    this.options = options;
    this.robotPort = robotPort;
    this.filePort = filePort;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.random = seededRandom(this.options.seed ?? 1);
    this.start_rad = this.options.start_rad;
    this.maxSpeed = this.options.maxSpeed;
    this.initialize = this.options.initialize;
    this.onMotion = this.options.onMotion;
    this.neutral = createVirtualController({
      robot: this.robot,
      scheduler: this.scheduler,
      cycle_s: this.options.cycle_s ?? CYCLE_S,
      ...(this.start_rad ? { start_rad: this.start_rad } : {}),
      ...(this.maxSpeed === undefined ? {} : { maxSpeed: this.maxSpeed }),
      ...(this.initialize ? { initialize: this.initialize } : {}),
    });
    this.scale = this.options.scale ?? exampleScale(this.robot);
    this.lines = new Lines(this.neutral.signals);
    this.zero_s = this.scheduler.now_s();
    this.machine = new Machine({
      robot: this.robot,
      neutral: this.neutral,
      files: this.files,
      mode: this.options.mode ?? "remote",
      servo: this.options.servo ?? true,
      servoOn_s: this.options.servoOn_s ?? 0.4,
      unix_s: this.unix_s,
      ...(this.options.interpret ? { interpret: this.options.interpret } : {}),
    });
    this.answer = answerer({
      robot: this.robot,
      neutral: this.neutral,
      machine: this.machine,
      lines: this.lines,
      variables: this.variables,
      scale: this.scale,
      model: this.options.model ?? this.robot.vendorSection?.model ?? this.robot.name.toUpperCase(),
      unix_s: this.unix_s,
      display: shown => {
        this.text = shown;
      },
      tools: new Map([[0, identity<"flange", "tcp">()], ...(this.options.tools ?? [])]),
      users: this.options.users ?? new Map<number, Pose<"base", "frame">>(),
      ...(this.onMotion ? { onMotion: this.onMotion } : {}),
    });
    this.answerFile = fileServer({
      files: this.files,
      now_s: () => this.scheduler.now_s(),
      fromOutside: () => this.machine.fromOutside(),
      isRunning: () => this.machine.isBusy,
    });
    this.robotSocket = faultySocket(this.robotPort, this.faults, this.scheduler, this.random);
    this.fileSocket = faultySocket(this.filePort, this.faults, this.scheduler, this.random);
    this.serve(this.robotSocket, DIVISION.robot);
    this.serve(this.fileSocket, DIVISION.file);
  }

  /** Answers what comes to one of the two ports. */
  private serve(socket: DatagramSocket, division: Division): void {
    const send = (reply: HsesReply, to: Parameters<typeof socket.send>[1]): void => {
      socket.send(this.out.subarray(0, writeReply(reply, this.out)), to);
    };
    socket.onDatagram((lent, from) => {
      if (this.isOff) return;
      const read = readRequest(lent);
      const sender = addressText(from);
      const flaw =
        read.kind === "flawed"
          ? read
          : read.packet.division !== division
            ? { added: 0xe4a3, sentence: `Division ${read.packet.division} has another port.` }
            : null;
      if (read.kind === "flawed" || flaw) {
        this.log(sender, flaw!.sentence);
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
              data: this.nothing,
            },
            from,
          );
        return;
      }
      const { packet } = read;
      const { id, service } = packet;
      if (division === DIVISION.robot) {
        // Answers of a robot command are one block; there is nothing to acknowledge.
        if (!packet.ack) send({ division, id, block: LAST_BLOCK, service, ...this.once(packet, sender) }, from);
        return;
      }
      const answered = this.answerFile(packet, sender);
      if (answered) send({ division, id, service, ...answered }, from);
    });
  }

  readonly unix_s = (): number => (this.options.began_unix_s ?? 0) + this.scheduler.now_s() - this.zero_s;

  stopWaiting: () => void = () => {
    /* Nothing is waited for yet. */
  };

  /**
   * An order that comes again with the same id gets the same answer and is not carried out again. Clients that never
   * change their id cannot be told apart from themselves: theirs are always new.
   */
  once(request: HsesRequest, from: string): Answer {
    const now_s = this.scheduler.now_s();
    const known = this.clients.get(from);
    const client: Client = known ?? { id: request.id, counts: false, at_s: now_s, order: null, answer: null };
    if (!known) {
      if (this.clients.size >= MOST_CLIENTS) this.clients.delete(this.clients.keys().next().value!);
      this.clients.set(from, client);
    }
    client.counts ||= request.id !== client.id;
    const isOrder = !READING.includes(request.service);
    const bytes = isOrder ? orderBytes(request) : null;
    if (bytes && client.counts && client.answer && now_s - client.at_s <= AGAIN_S && same(client.order, bytes))
      return client.answer;
    const answered = this.answer(request);
    client.id = request.id;
    if (bytes) {
      client.order = bytes;
      client.answer = answered;
      client.at_s = now_s;
    }
    return answered;
  }

  log(from: string, sentence: string): void {
    const line = `${from}: ${sentence}`;
    if (this.logged.size >= MOST_LOGGED || this.logged.has(line)) return;
    this.logged.add(line);
    this.options.log?.(line);
  }
}

function virtualYaskawaOf(own: YaskawaControllerState): VirtualYaskawa {
  return {
    robot: own.robot,
    neutral: own.neutral,
    machine: own.machine,
    lines: own.lines,
    faults: own.faults,
    files: own.files,
    scale: own.scale,
    brakingTime_s: brakingTime_s(own.robot) + 2 * (own.options.cycle_s ?? CYCLE_S),
    ports: { robot: own.robotSocket.address.port, files: own.fileSocket.address.port },
    pendant: {
      get text() {
        return own.text;
      },
      get message() {
        return own.machine.message;
      },
      setMode(mode) {
        own.machine.turn(mode);
      },
      setCommandRemote(on) {
        own.machine.setCommandRemote(on);
      },
      setServo: on => own.machine.servo(on),
      emergencyStop(pressed) {
        own.machine.pressEmergencyStop(pressed);
      },
      hold(pressed) {
        own.machine.hold("heldByPendant", pressed);
      },
      start: () => own.machine.start(),
      select: job => own.machine.select(job, 0),
      setOverride(percent) {
        own.machine.setOverride(percent / 100);
      },
      jog: (q_rad, ratio) => own.machine.jog(q_rad, ratio),
      raiseAlarm(code, name, data, major) {
        own.machine.raise(code, name, data, major);
      },
      reset() {
        own.machine.resetAlarm();
      },
      setGuardOpen(open) {
        own.machine.openGuard(open);
      },
      setInput(number, on) {
        own.lines.setInput(number, on);
      },
    },
    reboot(off_s) {
      own.machine.reboot();
      own.clients.clear();
      own.text = "";
      own.isOff = true;
      own.stopWaiting();
      const stop = own.scheduler.every(off_s, () => {
        stop();
        own.isOff = false;
      });
      own.stopWaiting = stop;
    },
    close() {
      own.stopWaiting();
      own.robotSocket.close();
      own.fileSocket.close();
      own.neutral.close();
    },
  };
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
