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
import { serveSocket } from "./server.ts";
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
  const { robot, scheduler, network, host } = options;
  const log =
    options.log ??
    ((): void => {
      /* Nobody asked for it. */
    });
  if (robot.arm.joints.length !== JOINTS)
    return {
      kind: "taken",
      sentence: `${robot.name} has ${robot.arm.joints.length} joints; ros_server moves ${JOINTS}.`,
    };
  const feedback_s = options.feedback_s ?? FEEDBACK_S;
  const settle_s = options.settle_s ?? SETTLE_S;
  const arm = createVirtualController({
    robot,
    scheduler,
    name: `Virtual ${robot.name}`,
    ...(options.start_rad ? { start_rad: options.start_rad } : {}),
    ...(options.maxSpeed === undefined ? {} : { maxSpeed: options.maxSpeed }),
  });
  const machine = new Machine(arm, options.mode ?? "remote");
  const stack = new Stack(robot, arm, machine);
  const faults = noLineFaults();
  const point = noPoint();
  const status = noStatus();
  const now_rad = arm.jointAngles();
  let heardFrom_s = Infinity;
  let sent_s = -Infinity;
  let throttle = 0;
  let stopNow = false;
  let booting = false;
  let loaded: Extract<Interpreted, { kind: "ready" }> | null = null;

  /** `pushMotion` of the program; whether the point was taken. */
  function take({ sequence, q_rad, velocity }: typeof point): boolean {
    if (sequence === SEQUENCE.stop) {
      stopNow = true;
      return true;
    }
    const q = [...q_rad.subarray(0, JOINTS)];
    const ratio = Math.min(1, Math.max(0, velocity));
    return ratio > 0 && jointRefusal(robot, q) === null && stack.push(q, ratio);
  }
  function onMotion(message: Message): void {
    if (message.type !== MESSAGE.point && message.type !== MESSAGE.fullPoint) return;
    const isFull = message.type === MESSAGE.fullPoint;
    const taken = take(isFull ? readFullPoint(message, point) : readPoint(message, point));
    if (message.comm !== COMM.request) return;
    const { sequence } = point;
    const reply = taken ? REPLY.success : REPLY.failure;
    motion.send(isFull ? fullPointReply(sequence, reply) : pointBytes({ ...noPoint(), sequence }, COMM.reply, reply));
  }
  const isSending = (): boolean => scheduler.now_s() - heardFrom_s >= settle_s;

  const common = { network, host, scheduler, faults, log };
  const motion = await serveSocket({
    ...common,
    port: options.ports?.motion ?? MOTION_PORT,
    onMessage: onMotion,
    onChange() {
      /* The cycle looks. */
    },
  });
  const feedback = await serveSocket({
    ...common,
    port: options.ports?.feedback ?? FEEDBACK_PORT,
    // What comes here is taken for a sign of life.
    onMessage() {
      /* Nothing is answered. */
    },
    onChange(connected) {
      heardFrom_s = connected ? scheduler.now_s() : Infinity;
    },
  });
  for (const { listening } of [motion, feedback]) {
    if (listening.kind === "taken") {
      motion.close();
      feedback.close();
      arm.close();
      return listening;
    }
  }

  function tell(): void {
    feedback.send(jointsBytes(now_rad));
    if (throttle === STATUS_EVERY) {
      const es = machine.esStatus;
      const powered = machine.isPowered;
      status.powered = powered;
      status.emergency = es === ES.stop;
      status.moving = arm.isMoving();
      status.mode = machine.workingMode < 3 ? 1 : 2;
      status.possible = powered && es === ES.ok;
      feedback.send(statusBytes(status));
      throttle = 0;
    }
    throttle++;
  }
  arm.onSample(sample => {
    if (!faults.frozen) now_rad.set(sample.q_rad);
    if (booting) return;
    // `motionControl`: with a client gone, or told to stop, everything is forgotten.
    const alone = !motion.isConnected || !feedback.isConnected || !isSending();
    if (stopNow || (alone && !stack.runsText)) {
      if (stopNow || stack.waiting > 0) stack.reset();
      stopNow = false;
    }
    stack.cycle(sample.step);
    const t = scheduler.now_s();
    if (feedback.isConnected && isSending() && t - sent_s >= feedback_s - 1e-9) {
      sent_s = t;
      tell();
    }
  });
  machine.enablePower();

  const address = (socket: typeof motion): number =>
    socket.listening.kind === "listening" ? socket.listening.address.port : 0;
  return {
    kind: "started",
    virtual: {
      robot,
      arm,
      faults,
      machine,
      ports: { motion: address(motion), feedback: address(feedback) },
      get isPowered() {
        return machine.isPowered;
      },
      get mode() {
        return machine.mode;
      },
      get waiting() {
        return stack.waiting;
      },
      get runsText() {
        return stack.runsText;
      },
      get line() {
        return stack.line;
      },
      pendant: {
        setMode(mode) {
          machine.setMode(mode);
        },
        setEnabling(pressed) {
          machine.setEnabling(pressed);
        },
        acknowledge() {
          machine.acknowledge();
        },
        setPower(on) {
          if (!on) machine.disablePower();
          return on ? machine.enablePower() : null;
        },
        setHold(on) {
          machine.setHold(on);
        },
        setMonitorSpeed: percent => machine.setMonitorSpeed(percent),
        setEmergencyStop(pressed) {
          machine.setEmergency(pressed);
        },
        setDoorOpen(open) {
          machine.setDoor(open);
        },
        fail(because) {
          machine.fail(because);
        },
        setInput(signal, value) {
          arm.signals.write(signal, value);
        },
        async jog(q_rad, ratio = 1) {
          if (machine.mode !== "manual" || !machine.moves)
            return {
              kind: "refused",
              why: {
                code: "controller.not-manual",
                sentence:
                  machine.mode === "manual"
                    ? "The enabling switch is not pressed."
                    : `The mode is ${machine.mode}; the arm is jogged in manual mode.`,
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
          return arm.run([slowed(robot, step, arm.jointAngles(), MANUAL_MPS)], { tools: {}, frames: {} });
        },
        load(text) {
          const read = options.interpret(text);
          if (read.kind === "not-understood") {
            const [fault] = read.faults;
            return `Line ${fault?.line ?? 1}: ${fault?.sentence ?? "The text was not understood."}`;
          }
          loaded = read;
          return null;
        },
        start() {
          if (!loaded) return Promise.resolve("No program is loaded.");
          const { context } = loaded;
          const run = new TextRun(loaded.run(arm.signals));
          return new Promise(over => {
            stack.start({ run, context, over });
          });
        },
        stop() {
          stack.reset();
        },
      },
      reboot() {
        motion.cut();
        feedback.cut();
        stack.reset();
        machine.disablePower();
        booting = true;
        const stop = scheduler.every(BOOT_S, () => {
          stop();
          booting = false;
          // In remote mode the program switches the arm on by itself when it starts.
          if (machine.mode === "remote") machine.enablePower();
        });
      },
      close() {
        motion.close();
        feedback.close();
        arm.close();
      },
    },
  };
}
