import { identity, type SafetyState } from "@twincell/core";
import { jointMoveSpeed } from "../guard/index.ts";
import type { KeyPosition, Pendant, PendantShown } from "../real/index.ts";
import { neutralPendant } from "../virtual/index.ts";
import type { VirtualAbb } from "./virtual/index.ts";

const KEYS: readonly KeyPosition[] = [
  { id: "reduced", name: "Manual reduced", mode: "manual" }, { id: "full", name: "Manual full speed", mode: "manual" }, { id: "auto", name: "Auto", mode: "automatic" },
];
const REDUCED_MPS = 0.25, FLANGE = identity<"flange", "tcp">();

/** FlexPendant and operator panel of a virtual ABB controller. */
export function abbPendant(controller: VirtualAbb): Pendant {
  const { neutral, robot, pendant } = controller, common = neutralPendant(neutral, { keys: KEYS, labels: { servo: "Motors", reset: "Acknowledge, start" } });
  let key = "auto", pressed = false, guardOpen = false, ratio = 1;
  const isManual = (): boolean => key !== "auto", stands = (): string | null => pressed ? "The emergency stop is pressed." : guardOpen && !isManual() ? "The guard is open." : null;
  const safety = (): SafetyState => pressed ? "emergency-stop" : guardOpen && !isManual() ? "guard-stop" : controller.inError ? "protective-stop" : "normal";
  return {
    ...common,
    get shown(): PendantShown {
      const { motorsOn, isRunning, message } = controller;
      return { key, servo: motorsOn ? "on" : "off", safety: safety(), override: ratio, program: "EGM", running: isRunning, alarms: message === "" ? [] : [message] };
    },
    turnKey(position) {
      const to = KEYS.find(({ id }) => id === position);
      if (!to || to.id === key) return;
      const was = isManual();
      common.stopJog();
      key = to.id;
      if (isManual() !== was) pendant.setMode(isManual() ? "manual" : "remote");
    },
    setMode(mode) { key = mode === "manual" ? "reduced" : "auto"; pendant.setMode(mode); },
    setEnabling(held) { if (!held) common.stopJog(); else if (isManual() && !pressed) controller.setMotors(true); },
    setServo(on) {
      const why = on ? stands() : null;
      if (why === null) controller.setMotors(on);
      return why;
    },
    setOverride(to) { ratio = to; return common.setOverride(to); },
    /** Off manual this is also the start of the program: the key says automatic already. */
    reset() {
      const why = stands();
      if (why === null) pendant.setMode(isManual() ? "manual" : "remote");
      return why;
    },
    async jog(q_rad, most = 1) {
      const sentence = pressed ? "The emergency stop is pressed." : controller.motorsOn ? null : "The motors are off.";
      if (sentence !== null) return { kind: "refused", why: { code: "controller.not-ready", sentence, hint: "Turn the red button out and press the enabling switch." } };
      const full_mps = key === "reduced" ? jointMoveSpeed(robot, neutral.jointAngles(), q_rad, FLANGE) : 0;
      return common.jog(q_rad, Math.min(most, full_mps > 0 ? REDUCED_MPS / full_mps : 1));
    },
    emergencyStop(is) { pressed = is; if (is) common.stopJog(); pendant.emergencyStop(is); },
    setGuardOpen(open) { guardOpen = open; pendant.setGuardOpen(open); },
    protectiveStop(because) { common.stopJog(); pendant.protectiveStop(because); },
    setInput() { /* EGM carries no signals. */ },
  };
}
