import { identity, type MoveStep, type Robot } from "@twincell/core";
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

export function urPendant({
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
}: UrPendantParts): UrPendant {
  let jogging = false;
  const turn = (remote: boolean): void => {
    if (remote !== panel.remote) {
      panel.remote = remote;
      programs.end();
    }
  };
  const stopJog = (): void => {
    if (jogging) mover.stop();
  };
  const whyNoJog = (): { readonly code: string; readonly sentence: string; readonly hint: string } | null =>
    panel.remote
      ? {
          code: "controller.not-manual",
          sentence: `${robot.name} is in remote control; its pendant jogs in local control only.`,
          hint: "Switch it to local control.",
        }
      : !states.mayMove
        ? {
            code: "controller.not-ready",
            sentence: `${robot.name} is not ready to move.`,
            hint: "Power it on and release its brakes.",
          }
        : !mover.isAtRest
          ? { code: "controller.busy", sentence: `${robot.name} is still moving.`, hint: "Wait until it stands." }
          : null;
  return {
    keys: KEYS,
    labels: { servo: "Power and brakes", reset: "Unlock" },
    lines: {
      inputs: INPUTS,
      outputs: OUTPUTS,
      read(signal) {
        const line = lineNumber(signal);
        return line !== null && memory.digital(line.kind === "digital-in" ? "input" : "output", line.number);
      },
    },
    get shown(): PendantShown {
      const { robotMode, safetyMode, message } = states;
      return {
        key: panel.remote ? "remote" : panel.operational === "AUTOMATIC" ? "automatic" : "manual",
        override: panel.fraction,
        safety: EMERGENCY_STOPS.has(safetyMode)
          ? "emergency-stop"
          : SAFEGUARD_STOPS.has(safetyMode)
            ? "guard-stop"
            : states.mayMove || safetyMode === SAFETY_MODE.NORMAL
              ? "normal"
              : "protective-stop",
        servo: states.isRunning
          ? "on"
          : robotMode === ROBOT_MODE.POWER_ON || robotMode === ROBOT_MODE.IDLE
            ? "coming"
            : "off",
        program: programs.name,
        running: programs.runtime === RUNTIME.PLAYING,
        alarms: message === "" ? [] : [message],
      };
    },
    turnKey(position) {
      if (position !== "remote") panel.operational = position === "automatic" ? "AUTOMATIC" : "MANUAL";
      turn(position === "remote");
      if (position !== "manual") stopJog();
    },
    setMode(mode) {
      turn(mode !== "manual");
    },
    setOperationalMode(mode) {
      panel.operational = mode;
    },
    setEnabling(pressed) {
      if (!pressed) stopJog();
    },
    setServo(on) {
      if (!on) {
        states.powerOff();
        return null;
      }
      return states.powerOn(now_s(), ROBOT_MODE.RUNNING)
        ? null
        : "The safety system keeps the power off: turn the red button out first.";
    },
    setOverride(ratio) {
      setSpeed(ratio);
      return null;
    },
    reset() {
      if (states.safetyMode === SAFETY_MODE.FAULT || states.safetyMode === SAFETY_MODE.VIOLATION) {
        states.restartSafety();
        return null;
      }
      const unlocked = states.unlock(now_s());
      if (unlocked === "too-soon")
        return `A protective stop can be unlocked ${UNLOCK_AFTER_S} s after it came: look at the robot first.`;
      return unlocked === "unlocked" || states.message === "" ? null : states.message;
    },
    stopJog,
    async jog(q_rad, most = 1) {
      const why = jointRefusal(robot, q_rad) ?? whyNoJog();
      if (why) return { kind: "refused", why };
      const full_mps = jointMoveSpeed(robot, neutral.jointAngles(), q_rad, FLANGE);
      const ratio = Math.min(most, BY_HAND, full_mps > 0 ? BY_HAND_MPS / full_mps : 1);
      const step: MoveStep = {
        id: "",
        type: "move",
        path: "ptp",
        target: { q: Array.from(q_rad) },
        speed: { ratio },
        blend_m: 0,
      };
      const moving = mover.run([step], { tools: {}, frames: {} });
      jogging = true;
      return new Promise(resolve => {
        const done = neutral.onSample(() => {
          if (!moving.over) return;
          jogging = false;
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
    },
    setSpeed,
    emergencyStop(pressed) {
      states.emergencyStop(pressed);
    },
    setGuardOpen(open) {
      states.safeguard(open);
    },
    protectiveStop,
    fault(because) {
      states.fault(because);
    },
    switchOn() {
      states.powerOn(now_s(), ROBOT_MODE.RUNNING);
    },
    switchOff() {
      states.powerOff();
    },
    unlock: () => states.unlock(now_s()),
    stopProgram() {
      programs.end();
    },
    setInput(signal, value) {
      const line = lineNumber(signal);
      if (line?.kind === "digital-in")
        memory.setDigital("input", line.number, value === true || (typeof value === "number" && value !== 0));
      if (line?.kind === "analogue-in") memory.set(`standard_analog_input${line.number}`, Number(value));
    },
  };
}
