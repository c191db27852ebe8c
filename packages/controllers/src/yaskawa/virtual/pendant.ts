import type { OperatingMode, SafetyState } from "@twincell/core";
import type { KeyPosition, Pendant, PendantShown } from "../../driver/index.ts";
import { refusalSentence } from "../codec/index.ts";
import type { VirtualYaskawa, YaskawaKeySwitch } from "./index.ts";
import { jogKeys } from "../../virtual/jog-keys.ts";

const KEYS: readonly KeyPosition[] = [
  { id: "teach", name: "TEACH", mode: "manual" },
  { id: "play", name: "PLAY", mode: "automatic" },
  { id: "remote", name: "REMOTE", mode: "remote" },
];
const POSITION: Readonly<Record<OperatingMode, YaskawaKeySwitch>> = {
  manual: "teach",
  automatic: "play",
  remote: "remote",
};
const ALARM_BY_HAND = 4499;
const REFUSED = 8;
const SHOWN = 16;
const INPUTS = Array.from({ length: SHOWN }, (_, i) => `IN#(${i + 1})`);
const OUTPUTS = Array.from({ length: SHOWN }, (_, i) => `OT#(${i + 1})`);
const lineNumber = (signal: string, sort: "in" | "out"): number =>
  Number((sort === "in" ? /^in(?:_|#\()(\d+)\)?$/i : /^ot#\((\d+)\)$/i).exec(signal)?.[1]);
const why = (added: number): string | null => (added === 0 ? null : refusalSentence(REFUSED, added));

/** Programming pendant of a virtual Yaskawa controller. */
export function yaskawaPendant({ pendant, machine, lines, neutral }: VirtualYaskawa): Pendant {
  let held = false;
  let pressed = false;
  const { jog, stopJog } = jogKeys(
    (q_rad, ratio) => pendant.jog(q_rad, ratio),
    () => {
      neutral.stop();
    },
  );
  const isTeach = (): boolean => machine.keySwitch === "teach";
  const safety = (): SafetyState =>
    pressed
      ? "emergency-stop"
      : machine.status.heldOutside
        ? "guard-stop"
        : machine.status.alarm || machine.status.error
          ? "protective-stop"
          : "normal";
  return {
    keys: KEYS,
    labels: { servo: "Servo", reset: "Reset" },
    lines: {
      inputs: INPUTS,
      outputs: OUTPUTS,
      read(signal) {
        const input = lineNumber(signal, "in");
        return input > 0 ? lines.isIn(input) : lines.isOut(lineNumber(signal, "out"));
      },
    },
    get shown(): PendantShown {
      const { status, alarms, speedOverride, place, message } = machine;
      return {
        key: machine.keySwitch,
        servo: status.servo ? "on" : machine.servoIsComing ? "coming" : "off",
        safety: safety(),
        override: speedOverride,
        program: place.job,
        running: status.running,
        alarms: [
          ...(pressed ? ["The emergency stop is pressed."] : []),
          ...alarms.map(({ code, name }) => `ALARM ${code} ${name}`),
          ...(status.error && !pressed ? ["The emergency stop was pressed."] : []),
          ...(message === "" || status.alarm ? [] : [message]),
        ],
      };
    },
    turnKey(position) {
      const to = KEYS.find(({ id }) => id === position);
      if (to) pendant.setMode(POSITION[to.mode]);
    },
    setMode(mode) {
      pendant.setMode(POSITION[mode]);
    },
    // In TEACH the servo is on while the switch is gripped.
    setEnabling(is) {
      if (is === held) return;
      held = is;
      if (isTeach()) pendant.setServo(is);
    },
    setServo: on =>
      on && isTeach() && !held ? "In TEACH the enabling switch brings the servo on." : why(pendant.setServo(on)),
    setOverride(ratio) {
      pendant.setOverride(100 * ratio);
      return null;
    },
    reset() {
      if (pressed) return "The emergency stop is pressed: turn it out.";
      pendant.reset();
      return null;
    },
    jog,
    stopJog,
    emergencyStop(is) {
      pressed = is;
      pendant.emergencyStop(is);
    },
    setGuardOpen(open) {
      pendant.setGuardOpen(open);
    },
    protectiveStop(because) {
      pendant.raiseAlarm(ALARM_BY_HAND, because);
    },
    setInput(signal, value) {
      const number = lineNumber(signal, "in");
      if (Number.isInteger(number) && number > 0)
        pendant.setInput(number, value === true || (typeof value === "number" && value !== 0));
    },
  };
}
