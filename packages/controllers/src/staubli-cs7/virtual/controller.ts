import type { Listening } from "../../transport/port.ts";
import type { FaultyLine } from "../../transport/faulty.ts";
import {
  sectionForDriver,
  type CommandOutcome,
  type Interpreted,
  type MoveStep,
  type Robot,
  type Scheduler,
  type VendorSection,
} from "@twincell/core";
import { slowed } from "../../guard/index.ts";
import { faultyLine, noLineFaults, type ByteStream, type LineFaults, type Network } from "../../transport/index.ts";
import { createVirtualController, type VirtualController } from "../../virtual/index.ts";
import { isText, LINE_PORT, LONGEST, textBytes, JOINTS } from "../codec/monitor.ts";
import { Machine } from "./machine.ts";
import { createMonitor, type Said } from "./monitor.ts";
import { Programs } from "./programs.ts";

export interface VirtualCs7Options {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly port?: number;
  /** Executes V+: a disk file, or a list of terminal commands. */
  readonly interpret: (text: string) => Interpreted;
  readonly start_rad?: ArrayLike<number>;
  readonly maxSpeed?: number;
  /** Behind the point of what WHERE says: three on a real one. */
  readonly digits?: number;
  /** Somebody presses the blinking button of high power after so long [s]; null: nobody does. */
  readonly presses_s?: number | null;
  readonly log?: (sentence: string) => void;
}
/** What a person does at the cabinet and the pendant. */
export interface Cs7Pendant {
  setManual(on: boolean): void;
  pressHighPower(): void;
  setEmergencyStop(pressed: boolean): void;
  setGuardOpen(open: boolean): void;
  /** The arm switches itself off. */
  fail(): void;
  jog(q_rad: ArrayLike<number>, ratio?: number): Promise<CommandOutcome>;
  setInput(signal: string, value: boolean): void;
  /** Puts a file on the disk. */
  write(name: string, text: string): string | null;
  /** A command typed at the cabinet's own terminal; what it says. */
  type(command: string): string;
}
export interface VirtualCs7 {
  readonly robot: Robot;
  readonly arm: VirtualController;
  readonly pendant: Cs7Pendant;
  readonly faults: LineFaults;
  readonly ports: { readonly line: number };
  readonly machine: Machine;
  readonly isPowered: boolean;
  readonly calibrated: boolean;
  /** A program has the robot. */
  readonly isRunning: boolean;
  reboot(): void;
  close(): void;
}
export type Cs7Started =
  | { readonly kind: "started"; readonly virtual: VirtualCs7 }
  | { readonly kind: "taken"; readonly sentence: string };

const MANUAL_MPS = 0.25;
const PRESSES_S = 0.5;
const BOOT_S = 2;
const DIGITS = 3;
const MAX_WAITING = 65_536;
const MOST_AHEAD = 64;
const URGENT = /^\s*(PANIC|ABORT|DO\s+BRAKE)\b/i;

/** A CS7 of numbers behind the raw line of its monitor: one terminal, echo, prompt, programs in a task beside it. */
export async function createVirtualCs7(options: VirtualCs7Options): Promise<Cs7Started> {
  const { robot } = options;
  const joints = sectionForDriver(robot, "staubli-cs7");
  return !joints || robot.arm.joints.length !== JOINTS
    ? { kind: "taken", sentence: `How V+ counts the joints of ${robot.name} is not known.` }
    : openCs7(options, joints);
}

function openCs7(options: VirtualCs7Options, joints: VendorSection): Promise<Cs7Started> {
  return new Cs7ControllerState(options, joints).open();
}

class Cs7ControllerState {
  readonly options: VirtualCs7Options;
  readonly joints: VendorSection;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly interpret: (text: string) => Interpreted;
  readonly log: (sentence: string) => void;
  readonly arm: VirtualController;
  readonly machine: Machine;
  readonly faults = noLineFaults();
  readonly now_rad: Float64Array;
  readonly queue: string[] = [];
  terminal: ByteStream | null = null;
  line: FaultyLine;
  seed = 1;
  typed = "";
  asks: Said["asks"];
  blocked = false;
  booting = false;
  blinkedFor_s = NaN;
  /** What comes without being asked for: the prompt follows it. */
  readonly programs: Programs;
  readonly monitor: (line: string) => Said;
  listening!: Listening & { kind: "listening" };

  constructor(options: VirtualCs7Options, joints: VendorSection) {
    this.options = options;
    this.joints = joints;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.interpret = this.options.interpret;
    this.log =
      this.options.log ??
      ((): void => {
        /* Nobody asked for it. */
      });
    this.arm = createVirtualController({
      robot: this.robot,
      scheduler: this.scheduler,
      name: `Virtual ${this.robot.name}`,
      ...(this.options.start_rad ? { start_rad: this.options.start_rad } : {}),
      ...(this.options.maxSpeed === undefined ? {} : { maxSpeed: this.options.maxSpeed }),
    });
    this.machine = new Machine(this.arm);
    this.now_rad = this.arm.jointAngles();
    this.line = faultyLine(this.faults, this.scheduler, 1);
    this.programs = new Programs(this.arm, this.machine, this.robot, this.joints, this.interpret, text => {
      this.out(`\r\n${text}\r\n${this.blocked ? "" : "."}`);
    });
    this.monitor = createMonitor({
      robot: this.robot,
      arm: this.arm,
      machine: this.machine,
      programs: this.programs,
      joints: this.joints,
      interpret: this.interpret,
      now_rad: this.now_rad,
      digits: this.options.digits ?? DIGITS,
    });
  }

  async open(): Promise<Cs7Started> {
    const listening = await this.network.listen({ host: this.host, port: this.options.port ?? LINE_PORT }, stream => {
      if (this.faults.refusing || this.booting) {
        stream.close();
        return;
      }
      // There is one terminal: who comes takes the place of one that may be gone without a word.
      this.cut();
      this.terminal = stream;
      this.line = faultyLine(this.faults, this.scheduler, ++this.seed);
      stream.onEnd(() => {
        if (this.terminal === stream) this.cut();
      });
      stream.onBytes(lent => {
        if (this.terminal === stream) this.take(lent, stream);
      });
    });
    if (listening.kind === "taken") {
      this.arm.close();
      return listening;
    }
    this.listening = listening;
    this.arm.onSample(sample => {
      if (!this.faults.frozen) this.now_rad.set(sample.q_rad);
      this.programs.cycle(sample.step);
      if (this.blocked && !this.programs.isRunning && !this.arm.isMoving()) {
        this.blocked = false;
        this.out(this.machine.hindrance ? `${this.machine.hindrance}\r\n.` : ".");
        this.work();
      }
      const presses_s = this.options.presses_s === undefined ? PRESSES_S : this.options.presses_s;
      if (!this.machine.blinking) this.blinkedFor_s = NaN;
      else if (presses_s !== null) {
        if (Number.isNaN(this.blinkedFor_s)) this.blinkedFor_s = this.scheduler.now_s();
        if (this.scheduler.now_s() - this.blinkedFor_s >= presses_s) this.machine.press();
      }
    });
    return startedCs7(this);
  }

  out(text: string): void {
    const to = this.terminal;
    if (!to || text === "" || to.waiting > MAX_WAITING) return;
    this.line.send(textBytes(text), bytes => {
      to.send(bytes);
    });
    if (--this.faults.dropAfter <= 0) {
      this.faults.dropAfter = Infinity;
      this.cut();
    }
  }

  answer(spoken: Said): void {
    ({ asks: this.asks } = spoken);
    this.blocked = spoken.blocks === true;
    this.out(spoken.text + (this.asks || this.blocked ? "" : "."));
  }

  /** One line at a time, with its echo. While a motion of DO is under way what is typed waits, except what stops it. */
  work(): void {
    while (this.terminal) {
      const at = this.blocked ? this.queue.findIndex(each => URGENT.test(each)) : 0;
      const command = this.queue[at];
      if (command === undefined) return;
      this.queue.splice(at, 1);
      this.out(`${command}\r\n`);
      if (this.blocked) {
        this.arm.stop();
        if (/PANIC/i.test(command)) this.machine.off();
        continue;
      }
      const question = this.asks;
      this.asks = undefined;
      this.answer(question ? question(command) : this.monitor(command));
    }
  }

  cut(): void {
    this.terminal?.close();
    this.terminal = null;
    this.typed = "";
    this.queue.length = 0;
    this.asks = undefined;
  }

  take(bytes: Uint8Array, from: ByteStream): void {
    for (const byte of bytes) {
      const why = !isText(byte)
        ? `A byte ${byte} came, which is none of a terminal's.`
        : this.typed.length > LONGEST
          ? "A line without end came."
          : this.queue.length > MOST_AHEAD
            ? "Lines came faster than they are carried out."
            : null;
      if (why) {
        this.log(`${from.peer.host}:${from.peer.port}: ${why} The connection is reset.`);
        this.cut();
        return;
      }
      if (byte === 8) this.typed = this.typed.slice(0, -1);
      else if (byte === 13) {
        this.queue.push(this.typed);
        this.typed = "";
      } else if (byte !== 10) this.typed += String.fromCharCode(byte);
    }
    this.work();
  }
}

function startedCs7(own: Cs7ControllerState): Cs7Started {
  return {
    kind: "started",
    virtual: {
      robot: own.robot,
      arm: own.arm,
      faults: own.faults,
      machine: own.machine,
      get isRunning() {
        return own.programs.isRunning;
      },
      ports: { line: own.listening.address.port },
      get isPowered() {
        return own.machine.isPowered;
      },
      get calibrated() {
        return own.machine.calibrated;
      },
      pendant: {
        setManual(on) {
          if (on) own.programs.abort();
          own.machine.setManual(on);
        },
        pressHighPower() {
          own.machine.press();
        },
        setEmergencyStop(pressed) {
          own.machine.setEmergency(pressed);
        },
        setGuardOpen(open) {
          own.machine.setGuard(open);
        },
        fail() {
          own.machine.off();
        },
        setInput(signal, value) {
          own.arm.signals.write(signal, value);
        },
        write: (name, text) => own.programs.write(name, text),
        type(command) {
          const spoken = own.monitor(command);
          return spoken.asks ? spoken.asks("Y").text : spoken.text;
        },
        async jog(q_rad, ratio = 1) {
          if (!own.machine.manual || !own.machine.isPowered)
            return {
              kind: "refused",
              why: {
                code: "controller.not-manual",
                sentence: own.machine.manual ? "High power is off." : "The pendant is in COMP mode.",
                hint: "Press MAN at the pendant and switch high power on.",
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
      },
      reboot() {
        own.cut();
        own.programs.forget();
        own.machine.off();
        own.machine.calibrated = false;
        own.booting = true;
        const stop = own.scheduler.every(BOOT_S, () => {
          stop();
          own.booting = false;
        });
      },
      close() {
        own.listening.close();
        own.cut();
        own.arm.close();
      },
    },
  };
}
