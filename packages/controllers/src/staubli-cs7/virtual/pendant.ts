import type { SafetyState, Scheduler } from "@twincell/core";
import type { KeyPosition, Pendant, PendantShown } from "../../driver/index.ts";
import { stateName } from "../codec/monitor.ts";
import type { VirtualCs7 } from "./index.ts";
import { jogKeys } from "../../virtual/jog-keys.ts";

const KEYS: readonly KeyPosition[] = [
  { id: "man", name: "MAN", mode: "manual" },
  { id: "comp", name: "COMP", mode: "remote" },
];
const SHOWN = 8;
const OUTPUTS = Array.from({ length: SHOWN }, (_, i) => `out_${i + 1}`);
const INPUTS = Array.from({ length: SHOWN }, (_, i) => `in_${1001 + i}`);
const TYPES_S = 2;
const LOOK_S = 0.1;

/** Manual control pendant, high-power button and terminal of a virtual CS7. */
export function cs7Pendant(virtual: VirtualCs7, scheduler: Scheduler): Pendant {
  const { pendant, machine, arm } = virtual;
  const { jog, stopJog } = jogKeys(
    (q_rad, ratio) => pendant.jog(q_rad, ratio),
    () => {
      arm.stop();
    },
  );
  const safety = (): SafetyState =>
    machine.isPressed
      ? "emergency-stop"
      : machine.isGuardOpen
        ? "guard-stop"
        : machine.isPowered && machine.calibrated
          ? "normal"
          : "protective-stop";
  /** What is typed at the cabinet's terminal, and the hand on the blinking button. */
  function power(): string | null {
    const error = /\*[^*]+\*/.exec(pendant.type("ENABLE POWER"))?.[0] ?? null;
    if (error !== null) return error;
    const until_s = scheduler.now_s() + TYPES_S;
    const stop = scheduler.every(LOOK_S, () => {
      if (virtual.isPowered && !virtual.calibrated) pendant.type("CALIBRATE");
      if (virtual.isPowered || scheduler.now_s() > until_s) stop();
    });
    return null;
  }
  function turn(manual: boolean): void {
    pendant.setManual(manual);
    if (!manual) power();
  }
  return {
    keys: KEYS,
    labels: { servo: "High power", reset: "Enable power, calibrate" },
    lines: { inputs: INPUTS, outputs: OUTPUTS, read: signal => arm.signals.read(signal) === true },
    get shown(): PendantShown {
      const alarms = [
        ...(machine.isPressed ? ["The emergency stop is pressed."] : []),
        ...(machine.isGuardOpen ? ["The gate is open."] : []),
        ...(safety() === "protective-stop" ? [`The robot says: ${stateName(machine.state)}.`] : []),
      ];
      return {
        key: machine.manual ? "man" : "comp",
        servo: machine.isPowered ? "on" : machine.blinking ? "coming" : "off",
        safety: safety(),
        override: machine.speed / 100,
        program: virtual.isRunning ? "task 1" : "",
        running: virtual.isRunning,
        alarms,
      };
    },
    turnKey(position) {
      turn(position === "man");
    },
    setMode(mode) {
      turn(mode === "manual");
    },
    setEnabling(held) {
      if (!held) stopJog();
    },
    setServo(on) {
      if (on) return power();
      pendant.type("DISABLE POWER");
      return null;
    },
    setOverride: ratio =>
      machine.setSpeed(Math.max(1, Math.round(100 * ratio))) ? null : "The monitor speed goes from 1 to 100 %.",
    reset: power,
    jog,
    stopJog,
    emergencyStop(pressed) {
      pendant.setEmergencyStop(pressed);
    },
    setGuardOpen(open) {
      pendant.setGuardOpen(open);
    },
    protectiveStop() {
      pendant.fail();
    },
    setInput(signal, value) {
      pendant.setInput(signal, value === true || (typeof value === "number" && value !== 0));
    },
  };
}
