import {
  sectionForDriver,
  type CommandOutcome,
  type Interpreted,
  type MoveStep,
  type Robot,
  type Scheduler,
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
  const { robot, scheduler, network, host, interpret } = options;
  const joints = sectionForDriver(robot, "staubli-cs7");
  const log =
    options.log ??
    ((): void => {
      /* Nobody asked for it. */
    });
  if (!joints || robot.arm.joints.length !== JOINTS)
    return { kind: "taken", sentence: `How V+ counts the joints of ${robot.name} is not known.` };
  const arm = createVirtualController({
    robot,
    scheduler,
    name: `Virtual ${robot.name}`,
    ...(options.start_rad ? { start_rad: options.start_rad } : {}),
    ...(options.maxSpeed === undefined ? {} : { maxSpeed: options.maxSpeed }),
  });
  const machine = new Machine(arm);
  const faults = noLineFaults();
  const now_rad = arm.jointAngles();
  const queue: string[] = [];
  let terminal: ByteStream | null = null;
  let line = faultyLine(faults, scheduler, 1);
  let seed = 1;
  let typed = "";
  let asks: Said["asks"];
  let blocked = false;
  let booting = false;
  let blinkedFor_s = NaN;

  function out(text: string): void {
    const to = terminal;
    if (!to || text === "" || to.waiting > MAX_WAITING) return;
    line.send(textBytes(text), bytes => {
      to.send(bytes);
    });
    if (--faults.dropAfter <= 0) {
      faults.dropAfter = Infinity;
      cut();
    }
  }
  /** What comes without being asked for: the prompt follows it. */
  const programs = new Programs(arm, machine, robot, joints, interpret, text => {
    out(`\r\n${text}\r\n${blocked ? "" : "."}`);
  });
  const monitor = createMonitor({
    robot,
    arm,
    machine,
    programs,
    joints,
    interpret,
    now_rad,
    digits: options.digits ?? DIGITS,
  });

  function answer(spoken: Said): void {
    ({ asks } = spoken);
    blocked = spoken.blocks === true;
    out(spoken.text + (asks || blocked ? "" : "."));
  }
  /** One line at a time, with its echo. While a motion of DO is under way what is typed waits, except what stops it. */
  function work(): void {
    while (terminal) {
      const at = blocked ? queue.findIndex(each => URGENT.test(each)) : 0;
      const command = queue[at];
      if (command === undefined) return;
      queue.splice(at, 1);
      out(`${command}\r\n`);
      if (blocked) {
        arm.stop();
        if (/PANIC/i.test(command)) machine.off();
        continue;
      }
      const question = asks;
      asks = undefined;
      answer(question ? question(command) : monitor(command));
    }
  }
  function cut(): void {
    terminal?.close();
    terminal = null;
    typed = "";
    queue.length = 0;
    asks = undefined;
  }
  function take(bytes: Uint8Array, from: ByteStream): void {
    for (const byte of bytes) {
      const why = !isText(byte)
        ? `A byte ${byte} came, which is none of a terminal's.`
        : typed.length > LONGEST
          ? "A line without end came."
          : queue.length > MOST_AHEAD
            ? "Lines came faster than they are carried out."
            : null;
      if (why) {
        log(`${from.peer.host}:${from.peer.port}: ${why} The connection is reset.`);
        cut();
        return;
      }
      if (byte === 8) typed = typed.slice(0, -1);
      else if (byte === 13) {
        queue.push(typed);
        typed = "";
      } else if (byte !== 10) typed += String.fromCharCode(byte);
    }
    work();
  }
  const listening = await network.listen({ host, port: options.port ?? LINE_PORT }, stream => {
    if (faults.refusing || booting) {
      stream.close();
      return;
    }
    // There is one terminal: who comes takes the place of one that may be gone without a word.
    cut();
    terminal = stream;
    line = faultyLine(faults, scheduler, ++seed);
    stream.onEnd(() => {
      if (terminal === stream) cut();
    });
    stream.onBytes(lent => {
      if (terminal === stream) take(lent, stream);
    });
  });
  if (listening.kind === "taken") {
    arm.close();
    return listening;
  }

  arm.onSample(sample => {
    if (!faults.frozen) now_rad.set(sample.q_rad);
    programs.cycle(sample.step);
    if (blocked && !programs.isRunning && !arm.isMoving()) {
      blocked = false;
      out(machine.hindrance ? `${machine.hindrance}\r\n.` : ".");
      work();
    }
    const presses_s = options.presses_s === undefined ? PRESSES_S : options.presses_s;
    if (!machine.blinking) blinkedFor_s = NaN;
    else if (presses_s !== null) {
      if (Number.isNaN(blinkedFor_s)) blinkedFor_s = scheduler.now_s();
      if (scheduler.now_s() - blinkedFor_s >= presses_s) machine.press();
    }
  });

  return {
    kind: "started",
    virtual: {
      robot,
      arm,
      faults,
      machine,
      get isRunning() {
        return programs.isRunning;
      },
      ports: { line: listening.address.port },
      get isPowered() {
        return machine.isPowered;
      },
      get calibrated() {
        return machine.calibrated;
      },
      pendant: {
        setManual(on) {
          if (on) programs.abort();
          machine.setManual(on);
        },
        pressHighPower() {
          machine.press();
        },
        setEmergencyStop(pressed) {
          machine.setEmergency(pressed);
        },
        setGuardOpen(open) {
          machine.setGuard(open);
        },
        fail() {
          machine.off();
        },
        setInput(signal, value) {
          arm.signals.write(signal, value);
        },
        write: (name, text) => programs.write(name, text),
        type(command) {
          const spoken = monitor(command);
          return spoken.asks ? spoken.asks("Y").text : spoken.text;
        },
        async jog(q_rad, ratio = 1) {
          if (!machine.manual || !machine.isPowered)
            return {
              kind: "refused",
              why: {
                code: "controller.not-manual",
                sentence: machine.manual ? "High power is off." : "The pendant is in COMP mode.",
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
          return arm.run([slowed(robot, step, arm.jointAngles(), MANUAL_MPS)], { tools: {}, frames: {} });
        },
      },
      reboot() {
        cut();
        programs.forget();
        machine.off();
        machine.calibrated = false;
        booting = true;
        const stop = scheduler.every(BOOT_S, () => {
          stop();
          booting = false;
        });
      },
      close() {
        listening.close();
        cut();
        arm.close();
      },
    },
  };
}
