import type { CommandOutcome, Interpreted, MoveStep, Robot, Scheduler } from "@twincell/core";
import { slowed } from "../../guard/index.ts";
import { jointRefusal } from "../../refusals.ts";
import { TextRun } from "../../runner/index.ts";
import { noLineFaults, type LineFaults, type Network } from "../../transport/index.ts";
import { createVirtualController, type VirtualController } from "../../virtual/index.ts";
import {
  COMM,
  FEEDBACK_PORT,
  fullPointReply,
  jointsBytes,
  MESSAGE,
  MOTION_PORT,
  noPoint,
  noStatus,
  pointBytes,
  readFullPoint,
  readPoint,
  REPLY,
  SEQUENCE,
  statusBytes,
  type Message,
} from "../codec/simple-message.ts";
import { Machine, MANUAL_MPS, ES, type StaubliMode } from "./machine.ts";
import { serveSocket, type ServerSocket } from "./server.ts";
import { Stack } from "./stack.ts";

export interface VirtualStaubliOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly ports?: { readonly motion?: number; readonly feedback?: number };
  /** Executes VAL 3: the program and its data, one behind the other. */
  readonly interpret: (text: string) => Interpreted;
  readonly mode?: StaubliMode;
  readonly start_rad?: ArrayLike<number>;
  readonly maxSpeed?: number;
  /** Joint angles are sent this often, the status with every fifth of them [s]. */
  readonly feedback_s?: number;
  /** Nothing is sent for so long after a client has come to the feedback [s]. */
  readonly settle_s?: number;
  readonly log?: (sentence: string) => void;
}
/** What a person does at the robot. Why it cannot be is a sentence; null when it was done. */
export interface StaubliPendant {
  setMode(mode: StaubliMode): void;
  setEnabling(pressed: boolean): void;
  acknowledge(): void;
  setPower(on: boolean): string | null;
  setHold(on: boolean): void;
  setMonitorSpeed(percent: number): boolean;
  setEmergencyStop(pressed: boolean): void;
  /** The door, or a proximity sensor wired to the same chain (row T-27). */
  setDoorOpen(open: boolean): void;
  /** The arm switches itself off. */
  fail(because: string): void;
  /** A joint move by the jog keys, in manual mode with the enabling switch pressed. */
  jog(q_rad: ArrayLike<number>, ratio?: number): Promise<CommandOutcome>;
  setInput(signal: string, value: boolean | number): void;
  /** Reads a VAL 3 text into memory; it does not run yet. */
  load(text: string): string | null;
  /** Starts what was loaded; the promise says how it ended, "" well. */
  start(): Promise<string>;
  stop(): void;
}
export interface VirtualStaubli {
  readonly robot: Robot;
  /** The arm that moves; its samples are the truth that drivers are held against. */
  readonly arm: VirtualController;
  readonly pendant: StaubliPendant;
  readonly faults: LineFaults;
  readonly ports: { readonly motion: number; readonly feedback: number };
  readonly machine: Machine;
  readonly isPowered: boolean;
  readonly mode: StaubliMode;
  /** A program of the pendant has the arm. */
  readonly runsText: boolean;
  /** Points and motions that wait or are carried out. */
  readonly waiting: number;
  /** Line of the VAL 3 program that is carried out. */
  readonly line: number;
  reboot(): void;
  close(): void;
}
export type StaubliStarted =
  | { readonly kind: "started"; readonly virtual: VirtualStaubli }
  | { readonly kind: "taken"; readonly sentence: string };

const FEEDBACK_S = 0.02;
const SETTLE_S = 1;
const STATUS_EVERY = 5;
const BOOT_S = 2;
const JOINTS = 6;

/**
 * A CS8 or CS9 of numbers with the VAL 3 program ros_server running: motions over one socket, joint angles and status
 * over the other.
 */
export async function createVirtualStaubli(options: VirtualStaubliOptions): Promise<StaubliStarted> {
  const { name, arm } = options.robot;
  return arm.joints.length === JOINTS
    ? openStaubli(options)
    : { kind: "taken", sentence: `${name} has ${arm.joints.length} joints; ros_server moves ${JOINTS}.` };
}

function openStaubli(options: VirtualStaubliOptions): Promise<StaubliStarted> {
  return new StaubliControllerState(options).open();
}

class StaubliControllerState {
  readonly options: VirtualStaubliOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly log: (sentence: string) => void;
  readonly feedback_s: number;
  readonly settle_s: number;
  readonly arm: VirtualController;
  readonly machine: Machine;
  readonly stack: Stack;
  readonly faults = noLineFaults();
  readonly point = noPoint();
  readonly status = noStatus();
  readonly now_rad: Float64Array;
  heardFrom_s = Infinity;
  sent_s = -Infinity;
  throttle = 0;
  stopNow = false;
  booting = false;
  loaded: Extract<Interpreted, { kind: "ready" }> | null = null;
  readonly common: {
    network: Network;
    host: string;
    scheduler: Scheduler;
    faults: LineFaults;
    log: (sentence: string) => void;
  };
  motion!: ServerSocket;
  feedback!: ServerSocket;

  constructor(options: VirtualStaubliOptions) {
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.log =
      this.options.log ??
      ((): void => {
        /* Nobody asked for it. */
      });
    this.feedback_s = this.options.feedback_s ?? FEEDBACK_S;
    this.settle_s = this.options.settle_s ?? SETTLE_S;
    this.arm = createVirtualController({
      robot: this.robot,
      scheduler: this.scheduler,
      name: `Virtual ${this.robot.name}`,
      ...(this.options.start_rad ? { start_rad: this.options.start_rad } : {}),
      ...(this.options.maxSpeed === undefined ? {} : { maxSpeed: this.options.maxSpeed }),
    });
    this.machine = new Machine(this.arm, this.options.mode ?? "remote");
    this.stack = new Stack(this.robot, this.arm, this.machine);
    this.now_rad = this.arm.jointAngles();
    this.common = {
      network: this.network,
      host: this.host,
      scheduler: this.scheduler,
      faults: this.faults,
      log: this.log,
    };
  }

  async open(): Promise<StaubliStarted> {
    this.motion = await serveSocket({
      ...this.common,
      port: this.options.ports?.motion ?? MOTION_PORT,
      onMessage: this.onMotion,
      onChange() {
        /* The cycle looks. */
      },
    });
    this.feedback = await serveSocket({
      ...this.common,
      port: this.options.ports?.feedback ?? FEEDBACK_PORT,
      // What comes here is taken for a sign of life.
      onMessage() {
        /* Nothing is answered. */
      },
      onChange: connected => {
        this.heardFrom_s = connected ? this.scheduler.now_s() : Infinity;
      },
    });
    for (const { listening } of [this.motion, this.feedback]) {
      if (listening.kind === "taken") {
        this.motion.close();
        this.feedback.close();
        this.arm.close();
        return listening;
      }
    }
    this.arm.onSample(sample => {
      if (!this.faults.frozen) this.now_rad.set(sample.q_rad);
      if (this.booting) return;
      // `motionControl`: with a client gone, or told to stop, everything is forgotten.
      const alone = !this.motion.isConnected || !this.feedback.isConnected || !this.isSending();
      if (this.stopNow || (alone && !this.stack.runsText)) {
        if (this.stopNow || this.stack.waiting > 0) this.stack.reset();
        this.stopNow = false;
      }
      this.stack.cycle(sample.step);
      const t = this.scheduler.now_s();
      if (this.feedback.isConnected && this.isSending() && t - this.sent_s >= this.feedback_s - 1e-9) {
        this.sent_s = t;
        this.tell();
      }
    });
    this.machine.enablePower();
    return startedStaubli(this);
  }

  /** `pushMotion` of the program; whether the point was taken. */
  take({ sequence, q_rad, velocity }: typeof this.point): boolean {
    if (sequence === SEQUENCE.stop) {
      this.stopNow = true;
      return true;
    }
    const q = [...q_rad.subarray(0, JOINTS)];
    const ratio = Math.min(1, Math.max(0, velocity));
    return ratio > 0 && jointRefusal(this.robot, q) === null && this.stack.push(q, ratio);
  }

  readonly onMotion = (message: Message): void => {
    if (message.type !== MESSAGE.point && message.type !== MESSAGE.fullPoint) return;
    const isFull = message.type === MESSAGE.fullPoint;
    const taken = this.take(isFull ? readFullPoint(message, this.point) : readPoint(message, this.point));
    if (message.comm !== COMM.request) return;
    const { sequence } = this.point;
    const reply = taken ? REPLY.success : REPLY.failure;
    this.motion.send(
      isFull ? fullPointReply(sequence, reply) : pointBytes({ ...noPoint(), sequence }, COMM.reply, reply),
    );
  };

  isSending(): boolean {
    return this.scheduler.now_s() - this.heardFrom_s >= this.settle_s;
  }

  tell(): void {
    this.feedback.send(jointsBytes(this.now_rad));
    if (this.throttle === STATUS_EVERY) {
      const es = this.machine.esStatus;
      const powered = this.machine.isPowered;
      this.status.powered = powered;
      this.status.emergency = es === ES.stop;
      this.status.moving = this.arm.isMoving();
      this.status.mode = this.machine.workingMode < 3 ? 1 : 2;
      this.status.possible = powered && es === ES.ok;
      this.feedback.send(statusBytes(this.status));
      this.throttle = 0;
    }
    this.throttle++;
  }

  address(socket: typeof this.motion): number {
    return socket.listening.kind === "listening" ? socket.listening.address.port : 0;
  }
}

function startedStaubli(own: StaubliControllerState): StaubliStarted {
  return {
    kind: "started",
    virtual: {
      robot: own.robot,
      arm: own.arm,
      faults: own.faults,
      machine: own.machine,
      ports: { motion: own.address(own.motion), feedback: own.address(own.feedback) },
      get isPowered() {
        return own.machine.isPowered;
      },
      get mode() {
        return own.machine.mode;
      },
      get waiting() {
        return own.stack.waiting;
      },
      get runsText() {
        return own.stack.runsText;
      },
      get line() {
        return own.stack.line;
      },
      pendant: pendantOf(own),
      reboot() {
        own.motion.cut();
        own.feedback.cut();
        own.stack.reset();
        own.machine.disablePower();
        own.booting = true;
        const stop = own.scheduler.every(BOOT_S, () => {
          stop();
          own.booting = false;
          // In remote mode the program switches the arm on by itself when it starts.
          if (own.machine.mode === "remote") own.machine.enablePower();
        });
      },
      close() {
        own.motion.close();
        own.feedback.close();
        own.arm.close();
      },
    },
  };
}

function pendantOf(own: StaubliControllerState): StaubliPendant {
  return {
    setMode(mode) {
      own.machine.setMode(mode);
    },
    setEnabling(pressed) {
      own.machine.setEnabling(pressed);
    },
    acknowledge() {
      own.machine.acknowledge();
    },
    setPower(on) {
      if (!on) own.machine.disablePower();
      return on ? own.machine.enablePower() : null;
    },
    setHold(on) {
      own.machine.setHold(on);
    },
    setMonitorSpeed: percent => own.machine.setMonitorSpeed(percent),
    setEmergencyStop(pressed) {
      own.machine.setEmergency(pressed);
    },
    setDoorOpen(open) {
      own.machine.setDoor(open);
    },
    fail(because) {
      own.machine.fail(because);
    },
    setInput(signal, value) {
      own.arm.signals.write(signal, value);
    },
    async jog(q_rad, ratio = 1) {
      if (own.machine.mode !== "manual" || !own.machine.moves)
        return {
          kind: "refused",
          why: {
            code: "controller.not-manual",
            sentence:
              own.machine.mode === "manual"
                ? "The enabling switch is not pressed."
                : `The mode is ${own.machine.mode}; the arm is jogged in manual mode.`,
            hint: "Turn the mode selector to manual and press the enabling switch.",
          },
        };
      const step: MoveStep = {
        id: "jog",
        type: "move",
        path: "ptp",
        target: { q: Array.from(q_rad) },
        speed: { ratio },
        blend_m: 0,
      };
      return own.arm.run([slowed(own.robot, step, own.arm.jointAngles(), MANUAL_MPS)], { tools: {}, frames: {} });
    },
    load(text) {
      const read = own.options.interpret(text);
      if (read.kind === "not-understood") {
        const [fault] = read.faults;
        return `Line ${fault?.line ?? 1}: ${fault?.sentence ?? "The text was not understood."}`;
      }
      own.loaded = read;
      return null;
    },
    start() {
      if (!own.loaded) return Promise.resolve("No program is loaded.");
      const { context } = own.loaded;
      const run = new TextRun(own.loaded.run(own.arm.signals));
      return new Promise(over => {
        own.stack.start({ run, context, over });
      });
    },
    stop() {
      own.stack.reset();
    },
  };
}
