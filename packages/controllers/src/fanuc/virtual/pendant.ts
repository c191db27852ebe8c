import type { SafetyState } from "@twincell/core";
import type { KeyPosition, Pendant, PendantShown } from "../../driver/index.ts";
import { fanucInput, type VirtualFanuc } from "./controller.ts";
import type { FanucKey } from "./machine.ts";
import { jogKeys } from "../../virtual/jog-keys.ts";

const KEYS: readonly KeyPosition[] = [
  { id: "T1", name: "T1", mode: "manual" },
  { id: "T2", name: "T2", mode: "manual" },
  { id: "AUTO", name: "AUTO", mode: "automatic" },
];
const SHOWN = 16;
const numbered = (sort: "DI" | "DO"): readonly string[] => Array.from({ length: SHOWN }, (_, i) => `${sort}[${i + 1}]`);
const INPUTS = numbered("DI");
const OUTPUTS = numbered("DO");

/** iPendant and operator panel of a virtual FANUC controller. */
export function fanucPendant({
  pendant,
  arm,
  machine,
  isRunning,
}: Pick<VirtualFanuc, "pendant" | "arm" | "machine" | "isRunning">): Pendant {
  const { jog, stopJog } = jogKeys(
    (q_rad, ratio) => pendant.jog(q_rad, ratio),
    () => {
      arm.stop();
    },
  );
  const safety = (): SafetyState =>
    machine.emergency
      ? "emergency-stop"
      : machine.fenceOpen && !machine.pendant
        ? "guard-stop"
        : machine.faults.length > 0
          ? "protective-stop"
          : "normal";
  return {
    keys: KEYS,
    labels: { servo: "Servos", reset: "RESET" },
    lines: { inputs: INPUTS, outputs: OUTPUTS, read: signal => arm.signals.read(signal) === true },
    get shown(): PendantShown {
      return {
        key: machine.key,
        servo: machine.ready ? "on" : "off",
        safety: safety(),
        override: machine.override / 100,
        program: isRunning() ? "RMI_MOVE" : "",
        running: isRunning(),
        alarms: machine.faults,
      };
    },
    turnKey(position) {
      pendant.setKey(position as FanucKey);
    },
    setMode(mode) {
      pendant.setKey(mode === "manual" ? "T1" : "AUTO");
    },
    setEnabling(held) {
      if (!held) stopJog();
    },
    setServo: on => (on ? pendant.reset() : "The pendant has no key for servos off: the red button takes them off."),
    setOverride: ratio =>
      machine.setOverride(Math.max(1, Math.round(100 * ratio))) ? null : "The override goes from 1 to 100 %.",
    reset: () => pendant.reset(),
    jog,
    stopJog,
    emergencyStop(pressed) {
      pendant.setEmergencyStop(pressed);
    },
    setGuardOpen(open) {
      pendant.setGuardOpen(open);
    },
    protectiveStop(because) {
      pendant.fault(because);
    },
    setInput(signal, value) {
      const n = fanucInput(signal);
      if (n > 0) pendant.setInput(n, value === true || (typeof value === "number" && value !== 0));
    },
  };
}
