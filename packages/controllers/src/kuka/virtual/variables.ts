import { distance, flangePose, type Robot, type Vector3, type AxisCounting, axesOfJoints } from "@twincell/core";
import type { VirtualController } from "../../virtual/index.ts";
import { AXES, e6axis, flangeText } from "../codec/axes.ts";
import { boolIn, krlBool, krlReal, krlText, numberIn, REAL_DIGITS } from "../codec/values.ts";
import type { Globals, Timers } from "./globals.ts";
import type { Machine } from "./machine.ts";
import type { Programs } from "./programs.ts";

/** What the controller says of itself. */
export interface KukaIdentity {
  readonly model: string;
  readonly serial: string;
  readonly name: string;
}
/** What the arm said in its last cycle. */
export interface Now {
  readonly q_rad: Float64Array;
  time_s: number;
}
export interface VariableSources {
  readonly robot: Robot;
  readonly axes: AxisCounting;
  readonly identity: KukaIdentity;
  readonly machine: Machine;
  readonly programs: Programs;
  readonly globals: Globals;
  readonly timers: Timers;
  readonly arm: VirtualController;
  readonly now: Now;
  readonly digits?: number;
  /** Names of the proxy itself, `@PROXY_PORT`. */
  readonly proxy: ReadonlyMap<string, string>;
  /** An output was written from outside. */
  readonly onOutput: (n: number, value: boolean) => void;
}
export interface Variables {
  read(name: string): string | undefined;
  write(name: string, value: string): boolean;
}

const DIGITAL = 4096;
const ANALOGUE = 32;
const INDEXED = /^(\$[A-Z_]+)\[([0-9]{1,5})\]$/;

/**
 * The variables of the controller by name, in any case, as texts. What is not known or may not be written is not done.
 */
export function kukaVariables(from: VariableSources): Variables {
  const { robot, axes, machine, programs, globals, timers, arm, now, identity } = from;
  const digits = from.digits ?? REAL_DIGITS;
  const a_deg = new Float64Array(AXES);
  const speed = tcpSpeed(robot, now);
  const axis = (): string => e6axis(axesOfJoints(axes, now.q_rad, a_deg), digits);
  const system = new Map<string, () => string>([
    ["$AXIS_ACT", axis],
    ["$AXIS_ACT_MEAS", axis],
    ["$POS_ACT", () => flangeText(robot, now.q_rad, axesOfJoints(axes, now.q_rad, a_deg), digits)],
    ["$VEL_ACT", () => krlReal(speed(), digits)],
    // Counts to 2³¹ − 1 and begins again.
    ["$ROB_TIMER", () => String(Math.round(1000 * now.time_s) % 0x80000000)],
    ["$MODE_OP", () => `#${machine.mode}`],
    ["$PRO_STATE1", () => `#P_${programs.state}`],
    ["$PRO_NAME1[]", () => krlText(programs.name)],
    ["$PRO_ACT", () => krlBool(programs.state === "ACTIVE")],
    ["$OV_PRO", () => String(machine.override)],
    ["$PERI_RDY", () => krlBool(machine.ready)],
    ["$STOPMESS", () => krlBool(machine.stopMessage)],
    ["$ALARM_STOP", () => krlBool(!machine.emergency)],
    ["$USER_SAF", () => krlBool(machine.userSafe)],
    ["$MODEL_NAME[]", () => krlText(identity.model)],
    ["$KR_SERIALNO", () => identity.serial],
    ["$ROBNAME[]", () => krlText(identity.name)],
  ]);
  const wire = (name: string, n: number): boolean => n >= 1 && n <= (name.includes("AN") ? ANALOGUE : DIGITAL);

  return {
    read(given) {
      const name = given.trim().toUpperCase();
      const known = system.get(name) ?? null;
      if (known) return known();
      const indexed = INDEXED.exec(name);
      if (!indexed) return globals.text(name) ?? from.proxy.get(name);
      const n = Number(indexed[2]);
      switch (indexed[1]) {
        case "$IN":
        case "$OUT":
          return wire(indexed[1], n) ? krlBool(arm.signals.read(`${indexed[1]}[${n}]`) === true) : undefined;
        case "$ANIN":
        case "$ANOUT":
          return wire(indexed[1], n) ? krlReal(Number(arm.signals.read(`${indexed[1]}[${n}]`)), digits) : undefined;
        case "$TIMER":
          return timers.has(n) ? String(Math.round(timers.read(n))) : undefined;
        case "$TIMER_FLAG":
          return timers.has(n) ? krlBool(timers.read(n) > 0) : undefined;
        case "$TIMER_STOP":
          return timers.has(n) ? krlBool(timers.stopped(n)) : undefined;
        default:
          return undefined;
      }
    },
    write(given, text) {
      const name = given.trim().toUpperCase();
      const indexed = INDEXED.exec(name);
      const number = numberIn(text);
      const bool = boolIn(text);
      if (name === "$OV_PRO") return Number.isInteger(number) && machine.setOverride(number);
      if (!indexed) return globals.write(name, text);
      const n = Number(indexed[2]);
      switch (indexed[1]) {
        case "$OUT":
          if (!wire("$OUT", n) || bool === undefined) return false;
          arm.signals.write(`$OUT[${n}]`, bool);
          from.onOutput(n, bool);
          return true;
        case "$ANOUT":
          if (!wire("$ANOUT", n) || !(Math.abs(number) <= 1)) return false;
          arm.signals.write(`$ANOUT[${n}]`, number);
          return true;
        case "$TIMER":
          if (!timers.has(n) || !Number.isInteger(number)) return false;
          timers.write(n, number);
          return true;
        case "$TIMER_STOP":
          if (!timers.has(n) || bool === undefined) return false;
          timers.stop(n, bool);
          return true;
        default:
          return false;
      }
    },
  };
}

/** Speed of the flange [m/s] between the last two cycles in which it was asked for. */
function tcpSpeed(robot: Robot, now: Now): () => number {
  let last: Vector3 = flangePose(robot.arm, now.q_rad).position;
  let at_s = now.time_s;
  let speed_mps = 0;
  return () => {
    if (now.time_s <= at_s) return speed_mps;
    const { position } = flangePose(robot.arm, now.q_rad);
    speed_mps = distance(last, position) / (now.time_s - at_s);
    last = position;
    at_s = now.time_s;
    return speed_mps;
  };
}
