import { identity, type MoveStep, type Robot, type CommandOutcome } from "@twincell/core";
import { jointMoveSpeed } from "../../guard/index.ts";
import type { KeyPosition, Pendant, PendantShown } from "../../driver/index.ts";
import { jointRefusal } from "../../refusals.ts";
import type { VirtualController } from "../../virtual/index.ts";
import { DIGITAL_LINES, lineNumber } from "../codec/models.ts";
import { EMERGENCY_STOPS, ROBOT_MODE, RUNTIME, SAFEGUARD_STOPS, SAFETY_MODE, UNLOCK_AFTER_S } from "../codec/modes.ts";
import type { Memory } from "./memory.ts";
import type { Mover } from "./mover.ts";
import type { Programs } from "./programs.ts";
import type { States } from "./states.ts";

/**
 * What a person does at the teach pendant and at the robot, beside what every brand has. Manual mode is local control.
 */
export interface UrPendant extends Pendant {
  setOperationalMode(mode: string): void;
  setSpeed(fraction: number): void;
  fault(because: string): void;
  /** Powers on and releases the brakes. */
  switchOn(): void;
  switchOff(): void;
  unlock(): "unlocked" | "too-soon" | "nothing";
  stopProgram(): void;
}
/** What the screen of the pendant sets and the ports read. */
export interface Panel {
  remote: boolean;
  operational: string;
  fraction: number;
}

export interface UrPendantParts {
  readonly robot: Robot;
  readonly neutral: VirtualController;
  readonly mover: Mover;
  readonly states: States;
  readonly programs: Programs;
  readonly memory: Memory;
  readonly panel: Panel;
  readonly now_s: () => number;
  readonly setSpeed: (fraction: number) => void;
  readonly protectiveStop: (because: string) => void;
}

const KEYS: readonly KeyPosition[] = [
  { id: "manual", name: "Local, manual", mode: "manual" },
  { id: "automatic", name: "Local, automatic", mode: "automatic" },
  { id: "remote", name: "Remote", mode: "remote" },
];
/** By hand no joint is asked for more than this share of its speed, and no flange for more than 250 mm/s. */
const BY_HAND = 0.25;
const BY_HAND_MPS = 0.25;
const numbered = (side: "in" | "out"): readonly string[] =>
  Array.from({ length: DIGITAL_LINES }, (_, i) => `digital_${side}_${i}`);
const FLANGE = identity<"flange", "tcp">();
const INPUTS = numbered("in");
const OUTPUTS = numbered("out");

export function urPendant(options: UrPendantParts): UrPendant {
  return urPendantOf(new TeachPanel(options));
}

class TeachPanel {
  readonly robot: Robot;
  readonly neutral: VirtualController;
  readonly mover: Mover;
  readonly states: States;
  readonly programs: Programs;
  readonly memory: Memory;
  readonly panel: Panel;
  readonly now_s: () => number;
  readonly setSpeed: (fraction: number) => void;
  readonly protectiveStop: (because: string) => void;
  jogging = false;

  constructor({
    robot,
    neutral,
    mover,
    states,
    programs,
    memory,
    panel,
    now_s,
    setSpeed,
    protectiveStop,
  }: UrPendantParts) {
    this.robot = robot;
    this.neutral = neutral;
    this.mover = mover;
    this.states = states;
    this.programs = programs;
    this.memory = memory;
    this.panel = panel;
    this.now_s = now_s;
    this.setSpeed = setSpeed;
    this.protectiveStop = protectiveStop;
  }

  turn(remote: boolean): void {
    if (remote !== this.panel.remote) {
      this.panel.remote = remote;
      this.programs.end();
    }
  }

  readonly stopJog = (): void => {
    if (this.jogging) this.mover.stop();
  };

  whyNoJog(): { readonly code: string; readonly sentence: string; readonly hint: string } | null {
    return this.panel.remote
      ? {
          code: "controller.not-manual",
          sentence: `${this.robot.name} is in remote control; its pendant jogs in local control only.`,
          hint: "Switch it to local control.",
        }
      : !this.states.mayMove
        ? {
            code: "controller.not-ready",
            sentence: `${this.robot.name} is not ready to move.`,
            hint: "Power it on and release its brakes.",
          }
        : !this.mover.isAtRest
          ? { code: "controller.busy", sentence: `${this.robot.name} is still moving.`, hint: "Wait until it stands." }
          : null;
  }

  shown(): PendantShown {
    const { robotMode, safetyMode, message } = this.states;
    return {
      key: this.panel.remote ? "remote" : this.panel.operational === "AUTOMATIC" ? "automatic" : "manual",
      override: this.panel.fraction,
      safety: EMERGENCY_STOPS.has(safetyMode)
        ? "emergency-stop"
        : SAFEGUARD_STOPS.has(safetyMode)
          ? "guard-stop"
          : this.states.mayMove || safetyMode === SAFETY_MODE.NORMAL
            ? "normal"
            : "protective-stop",
      servo: this.states.isRunning
        ? "on"
        : robotMode === ROBOT_MODE.POWER_ON || robotMode === ROBOT_MODE.IDLE
          ? "coming"
          : "off",
      program: this.programs.name,
      running: this.programs.runtime === RUNTIME.PLAYING,
      alarms: message === "" ? [] : [message],
    };
  }

  async jog(q_rad: ArrayLike<number>, most = 1): Promise<CommandOutcome> {
    const why = jointRefusal(this.robot, q_rad) ?? this.whyNoJog();
    if (why) return { kind: "refused", why };
    const full_mps = jointMoveSpeed(this.robot, this.neutral.jointAngles(), q_rad, FLANGE);
    const ratio = Math.min(most, BY_HAND, full_mps > 0 ? BY_HAND_MPS / full_mps : 1);
    const step: MoveStep = {
      id: "",
      type: "move",
      path: "ptp",
      target: { q: Array.from(q_rad) },
      speed: { ratio },
      blend_m: 0,
    };
    const moving = this.mover.run([step], { tools: {}, frames: {} });
    this.jogging = true;
    return new Promise(resolve => {
      const done = this.neutral.onSample(() => {
        if (!moving.over) return;
        this.jogging = false;
        done();
        resolve(
          moving.sentence === ""
            ? { kind: "done" }
            : {
                kind: "stopped",
                why: { code: "controller.stopped", sentence: moving.sentence, hint: "Jog it again." },
              },
        );
      });
    });
  }
}

function urPendantOf(own: TeachPanel): UrPendant {
  return {
    keys: KEYS,
    labels: { servo: "Power and brakes", reset: "Unlock" },
    lines: {
      inputs: INPUTS,
      outputs: OUTPUTS,
      read(signal) {
        const line = lineNumber(signal);
        return line !== null && own.memory.digital(line.kind === "digital-in" ? "input" : "output", line.number);
      },
    },
    get shown(): PendantShown {
      return own.shown();
    },
    turnKey(position) {
      if (position !== "remote") own.panel.operational = position === "automatic" ? "AUTOMATIC" : "MANUAL";
      own.turn(position === "remote");
      if (position !== "manual") own.stopJog();
    },
    setMode(mode) {
      own.turn(mode !== "manual");
    },
    setOperationalMode(mode) {
      own.panel.operational = mode;
    },
    setEnabling(pressed) {
      if (!pressed) own.stopJog();
    },
    setServo(on) {
      if (!on) {
        own.states.powerOff();
        return null;
      }
      return own.states.powerOn(own.now_s(), ROBOT_MODE.RUNNING)
        ? null
        : "The safety system keeps the power off: turn the red button out first.";
    },
    setOverride(ratio) {
      own.setSpeed(ratio);
      return null;
    },
    reset() {
      if (own.states.safetyMode === SAFETY_MODE.FAULT || own.states.safetyMode === SAFETY_MODE.VIOLATION) {
        own.states.restartSafety();
        return null;
      }
      const unlocked = own.states.unlock(own.now_s());
      if (unlocked === "too-soon")
        return `A protective stop can be unlocked ${UNLOCK_AFTER_S} s after it came: look at the robot first.`;
      return unlocked === "unlocked" || own.states.message === "" ? null : own.states.message;
    },
    stopJog: own.stopJog,
    jog: (q_rad, most) => own.jog(q_rad, most),
    setSpeed: own.setSpeed,
    emergencyStop(pressed) {
      own.states.emergencyStop(pressed);
    },
    setGuardOpen(open) {
      own.states.safeguard(open);
    },
    protectiveStop: own.protectiveStop,
    fault(because) {
      own.states.fault(because);
    },
    switchOn() {
      own.states.powerOn(own.now_s(), ROBOT_MODE.RUNNING);
    },
    switchOff() {
      own.states.powerOff();
    },
    unlock: () => own.states.unlock(own.now_s()),
    stopProgram() {
      own.programs.end();
    },
    setInput(signal, value) {
      const line = lineNumber(signal);
      if (line?.kind === "digital-in")
        own.memory.setDigital("input", line.number, value === true || (typeof value === "number" && value !== 0));
      if (line?.kind === "analogue-in") own.memory.set(`standard_analog_input${line.number}`, Number(value));
    },
  };
}
