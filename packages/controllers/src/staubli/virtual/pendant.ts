import type { OperatingMode, SafetyState, Scheduler } from "@twincell/core";
import type { KeyPosition, Pendant, PendantShown } from "../../driver/index.ts";
import type { StaubliMode, VirtualStaubli } from "./index.ts";
import { jogKeys } from "../../virtual/jog-keys.ts";

const KEYS: readonly KeyPosition[] = [
  { id: "manual", name: "Manual", mode: "manual" },
  { id: "local", name: "Local", mode: "automatic" },
  { id: "remote", name: "Remote", mode: "remote" },
];
const POSITION: Readonly<Record<OperatingMode, StaubliMode>> = {
  manual: "manual",
  automatic: "local",
  remote: "remote",
};
/** The lines of the first I/O board. VAL 3 programs read and write them; the protocol carries none. */
const SHOWN = 8;
const INPUTS = Array.from({ length: SHOWN }, (_, i) => `%I${i}`);
const OUTPUTS = Array.from({ length: SHOWN }, (_, i) => `%Q${i}`);
const PRESSES_S = 2;
const LOOK_S = 0.05;

/** Working-mode selector and pendant of a virtual CS8 or CS9. */
export function staubliPendant(virtual: VirtualStaubli, scheduler: Scheduler): Pendant {
  const { pendant, machine, arm } = virtual;
  let gripped = false;
  const keys = jogKeys(
    (q_rad, ratio) => pendant.jog(q_rad, ratio),
    () => {
      arm.stop();
    },
  );
  const safety = (): SafetyState =>
    machine.isPressed
      ? "emergency-stop"
      : machine.isDoorOpen
        ? "guard-stop"
        : machine.error !== ""
          ? "protective-stop"
          : "normal";
  const reset = (): string | null => {
    pendant.acknowledge();
    if (machine.isPressed) return "The red button is pressed: turn it out.";
    return machine.isDoorOpen ? "The door is open." : null;
  };
  const setServo = (on: boolean): string | null => pendant.setPower(on);
  function turn(to: StaubliMode): void {
    pendant.setMode(to);
    if (to === "manual") return;
    // Whoever turns the selector acknowledges the chain and presses the power button as soon as the robot stands.
    const until_s = scheduler.now_s() + PRESSES_S;
    const stop = scheduler.every(LOOK_S, () => {
      pendant.acknowledge();
      if (virtual.mode !== to || scheduler.now_s() > until_s || pendant.setPower(true) === null) stop();
    });
  }
  return {
    keys: KEYS,
    labels: { servo: "Arm power", reset: "Acknowledge" },
    lines: { inputs: INPUTS, outputs: OUTPUTS, read: signal => arm.signals.read(signal) === true },
    get shown(): PendantShown {
      const alarms = [
        ...(machine.isPressed ? ["The emergency stop is pressed."] : []),
        ...(machine.isDoorOpen ? ["The door is open."] : []),
        ...(machine.error === "" ? [] : [machine.error]),
      ];
      return {
        key: machine.mode,
        servo: machine.isPowered ? "on" : "off",
        safety: safety(),
        override: machine.monitorSpeed / 100,
        program: virtual.runsText ? "start" : "ros_server",
        running: virtual.runsText || virtual.waiting > 0,
        alarms,
      };
    },
    turnKey(position) {
      const to = KEYS.find(({ id }) => id === position);
      if (to) turn(POSITION[to.mode]);
    },
    setMode(mode) {
      turn(POSITION[mode]);
    },
    setEnabling(held) {
      if (held === gripped) return;
      gripped = held;
      if (held) pendant.acknowledge();
      pendant.setEnabling(held);
    },
    setServo,
    setOverride: ratio => (pendant.setMonitorSpeed(100 * ratio) ? null : "The monitor speed goes from 0 to 100 %."),
    reset,
    async jog(q_rad, ratio) {
      // Jogged with nobody at the switch, it is pressed for as long as the jog lasts.
      const presses = !gripped;
      if (presses) {
        pendant.acknowledge();
        pendant.setEnabling(true);
      }
      const outcome = await keys.jog(q_rad, ratio);
      if (presses) pendant.setEnabling(false);
      return outcome;
    },
    stopJog: keys.stopJog,
    emergencyStop(pressed) {
      pendant.setEmergencyStop(pressed);
    },
    setGuardOpen(open) {
      pendant.setDoorOpen(open);
    },
    protectiveStop(because) {
      pendant.fail(because);
    },
    setInput(signal, value) {
      pendant.setInput(signal, value);
    },
  };
}
