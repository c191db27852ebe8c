import { identity, type SafetyState } from "@twincell/core";
import { jointMoveSpeed } from "../../guard/index.ts";
import type { KeyPosition, Pendant, PendantShown } from "../../driver/index.ts";
import { neutralPendant } from "../../virtual/index.ts";
import type { VirtualAbb } from "./index.ts";

const KEYS = [
  { id: "MANR", name: "Manual reduced", mode: "manual" },
  { id: "MANF", name: "Manual full speed", mode: "manual" },
  { id: "AUTO", name: "Auto", mode: "automatic" },
] as const satisfies readonly KeyPosition[];
const REDUCED_MPS = 0.25;
const FLANGE = identity<"flange", "tcp">();

/** FlexPendant and operator panel of a virtual ABB controller. */
export function abbPendant(controller: VirtualAbb): Pendant {
  const { neutral, robot, pendant, cabinet: virtualPendant, programs, lines } = controller;
  const common = neutralPendant(neutral, { keys: KEYS });
  const digital = (kind: "DI" | "DO"): readonly string[] =>
    lines.all.filter(line => line.kind === kind).map(({ name }) => name);
  let pressed = false;
  const isManual = (): boolean => virtualPendant.key !== "AUTO";
  const safety = (): SafetyState =>
    virtualPendant.state === "emergencystop"
      ? "emergency-stop"
      : virtualPendant.state === "guardstop"
        ? "guard-stop"
        : controller.hasFailed
          ? "protective-stop"
          : "normal";
  const alarms = (): readonly string[] =>
    safety() === "normal" && (isManual() || programs.isRunning)
      ? []
      : virtualPendant.events
          .filter(({ kind }) => kind > 1)
          .slice(0, 1)
          .map(({ code, text }) => `${code} ${text}`);
  return {
    ...common,
    labels: { servo: "Motors", reset: "Acknowledge, start" },
    lines: { inputs: digital("DI"), outputs: digital("DO"), read: signal => lines.find(signal)?.value === true },
    get shown(): PendantShown {
      return {
        key: virtualPendant.key,
        servo: virtualPendant.motorsOn ? "on" : "off",
        safety: safety(),
        override: virtualPendant.speedRatio / 100,
        program: programs.names.at(-1) ?? "",
        running: programs.isRunning,
        alarms: alarms(),
      };
    },
    turnKey(position) {
      const to = KEYS.find(({ id }) => id === position);
      if (!to || to.id === virtualPendant.key) return;
      common.stopJog();
      if ((to.mode === "manual") !== isManual()) pendant.setMode(to.mode);
      if (to.mode === "manual") virtualPendant.setKey(to.id);
    },
    setMode(mode) {
      pendant.setMode(mode);
    },
    setEnabling(held) {
      if (!held) common.stopJog();
    },
    setServo(on) {
      if (on) return virtualPendant.switchOn();
      virtualPendant.motorsOff("The motors were switched off.");
      return null;
    },
    setOverride: ratio =>
      virtualPendant.setSpeedRatio(100 * ratio) ? common.setOverride(ratio) : "The speed goes from 0 to 100 %.",
    /** Off manual this is also the start of the program, which waits for targets again. */
    reset() {
      if (pressed) return "The emergency stop is pressed.";
      if (virtualPendant.state === "guardstop") return "The guard is open.";
      pendant.setMode(isManual() ? "manual" : "automatic");
      return null;
    },
    async jog(q_rad, most = 1) {
      if (!virtualPendant.motorsOn)
        return {
          kind: "refused",
          why: {
            code: "controller.not-ready",
            sentence: pressed ? "The emergency stop is pressed." : "The motors are off.",
            hint: "Turn the red button out, and press the enabling switch.",
          },
        };
      const full_mps = virtualPendant.key === "MANR" ? jointMoveSpeed(robot, neutral.jointAngles(), q_rad, FLANGE) : 0;
      return common.jog(q_rad, Math.min(most, full_mps > 0 ? REDUCED_MPS / full_mps : 1));
    },
    emergencyStop(is) {
      pressed = is;
      if (is) common.stopJog();
      pendant.emergencyStop(is);
    },
    setGuardOpen(open) {
      pendant.setGuardOpen(open);
    },
    protectiveStop(because) {
      common.stopJog();
      pendant.protectiveStop(because);
    },
    setInput(signal, value) {
      pendant.setInput(signal, value);
    },
  };
}
