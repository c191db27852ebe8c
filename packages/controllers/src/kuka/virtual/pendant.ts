import type { OperatingMode, SafetyState, Scheduler } from "@twincell/core";
import type { KeyPosition, Pendant, PendantShown } from "../../driver/index.ts";
import type { VirtualKuka } from "./controller.ts";
import type { KukaMode } from "./machine.ts";
import { jogKeys } from "../../virtual/jog-keys.ts";

const KEYS: readonly KeyPosition[] = [
  { id: "T1", name: "T1", mode: "manual" },
  { id: "T2", name: "T2", mode: "manual" },
  { id: "AUT", name: "AUT", mode: "automatic" },
  { id: "EX", name: "EXT", mode: "remote" },
];
const POSITION: Readonly<Record<OperatingMode, KukaMode>> = { manual: "T1", automatic: "AUT", remote: "EX" };
const PRESSES_S = 2;
const LOOK_S = 0.05;
const INPUT = /^\$IN\[([0-9]{1,4})\]$/;
const SHOWN = 16;
const numbered = (sort: "IN" | "OUT"): readonly string[] =>
  Array.from({ length: SHOWN }, (_, i) => `$${sort}[${i + 1}]`);
const INPUTS = numbered("IN");
const OUTPUTS = numbered("OUT");

/** smartPAD of a virtual KUKA controller. */
export function kukaPendant({ pendant, arm, machine, program }: VirtualKuka, scheduler: Scheduler): Pendant {
  let held = false;
  const keys = jogKeys(
    (q_rad, ratio) => pendant.jog(q_rad, ratio),
    () => {
      arm.stop();
    },
  );
  const safety = (): SafetyState =>
    machine.emergency
      ? "emergency-stop"
      : !machine.safetyClosed && !machine.isManual
        ? "guard-stop"
        : machine.stopMessage
          ? "protective-stop"
          : "normal";
  return {
    keys: KEYS,
    labels: { servo: "Drives", reset: "Confirm all" },
    lines: { inputs: INPUTS, outputs: OUTPUTS, read: signal => arm.signals.read(signal) === true },
    get shown(): PendantShown {
      return {
        key: machine.mode,
        servo: machine.ready ? "on" : "off",
        safety: safety(),
        override: machine.override / 100,
        program: program.name,
        running: program.state === "ACTIVE",
        alarms: machine.messages.filter(({ stops }) => stops).map(({ text }) => text),
      };
    },
    turnKey(position) {
      const to = KEYS.find(({ id }) => id === position);
      if (to) pendant.setMode(to.id as KukaMode);
    },
    setMode(mode) {
      pendant.setMode(POSITION[mode]);
      // Whoever turns the key to AUT presses the button of the drives as soon as the robot stands; in EXT that is the
      // remote control's.
      const until_s = scheduler.now_s() + PRESSES_S;
      const stop = scheduler.every(LOOK_S, () => {
        if (machine.mode !== "AUT" || scheduler.now_s() > until_s || pendant.setDrives(true) === null) stop();
      });
    },
    setEnabling(is) {
      held = is;
      pendant.setEnabling(is);
    },
    setServo: on => pendant.setDrives(on),
    setOverride: ratio => (pendant.setOverride(Math.round(100 * ratio)) ? null : "The override goes from 0 to 100 %."),
    reset() {
      pendant.confirm();
      return machine.stopMessage ? "The cause of a message is still there." : null;
    },
    // Without a hand on it, the enabling switch is pressed for as long as the jog lasts.
    async jog(q_rad, ratio) {
      pendant.setEnabling(true);
      const outcome = await keys.jog(q_rad, ratio);
      if (!held) pendant.setEnabling(false);
      return outcome;
    },
    stopJog: keys.stopJog,
    emergencyStop(pressed) {
      pendant.setEmergencyStop(pressed);
    },
    setGuardOpen(open) {
      pendant.setGuardOpen(open);
    },
    protectiveStop(because) {
      pendant.fail(because);
    },
    setInput(signal, value) {
      const n = INPUT.exec(signal);
      if (n) pendant.setInput(Number(n[1]), value === true || (typeof value === "number" && value !== 0));
    },
  };
}
