import type { OperatingMode, SafetyState } from "@twincell/core";
import type { KeyPosition, Pendant, PendantShown } from "../driver/brand.ts";
import type { VirtualController } from "./controller.ts";
import { jogKeys } from "./jog-keys.ts";

export interface NeutralPendantOptions {
  readonly keys: readonly KeyPosition[];
  readonly labels?: Pendant["labels"];
  readonly inputs?: readonly string[];
  readonly outputs?: readonly string[];
}

/** The pendant of a neutral virtual robot. A brand spreads it under what its own cabinet does otherwise. */
export function neutralPendant(
  neutral: VirtualController,
  { keys, labels = { servo: "Drives", reset: "Reset" }, inputs = [], outputs = [] }: NeutralPendantOptions,
): Pendant {
  let key = keys[0]?.id ?? "";
  let mode: OperatingMode = keys[0]?.mode ?? "automatic";
  let safety: SafetyState = "normal";
  let override = 1;
  let message = "";
  let pressed = false;
  neutral.onSample(sample => {
    mode = sample.mode;
    safety = sample.safety;
    override = sample.override;
    message = sample.message;
  });
  const positionOf = (of: OperatingMode): KeyPosition | undefined =>
    keys.find(each => each.mode === of) ?? keys.find(each => each.mode !== "manual");
  const turn = (to: KeyPosition | undefined): void => {
    if (to) {
      key = to.id;
      mode = to.mode;
      neutral.atTheRobot.setMode(to.mode);
    }
  };
  const { jog, stopJog } = jogKeys(
    (q_rad, ratio) => neutral.atTheRobot.jog(q_rad, ratio),
    () => {
      neutral.stop();
    },
  );
  return {
    keys,
    labels,
    lines: { inputs, outputs, read: signal => neutral.signals.read(signal) === true },
    get shown(): PendantShown {
      const at = keys.find(({ id }) => id === key);
      return {
        key: at?.mode === mode ? key : (positionOf(mode)?.id ?? key),
        servo: safety === "emergency-stop" ? "off" : "on",
        safety,
        override,
        program: "",
        running: mode !== "manual" && neutral.isMoving(),
        alarms: safety === "normal" || message === "" ? [] : [message],
      };
    },
    turnKey(position) {
      turn(keys.find(({ id }) => id === position));
    },
    setMode(to) {
      turn(positionOf(to));
    },
    setEnabling(held) {
      if (!held) stopJog();
    },
    setServo(on) {
      if (!on) {
        neutral.stop(true);
        return null;
      }
      if (pressed) return "The red button is pressed.";
      const outcome = neutral.atTheRobot.reset();
      return outcome.kind === "done" ? null : outcome.why.sentence;
    },
    setOverride(ratio) {
      const outcome = neutral.atTheRobot.setOverride(100 * ratio);
      return outcome.kind === "done" ? null : outcome.why.sentence;
    },
    reset() {
      if (pressed) return "The red button is pressed.";
      const outcome = neutral.atTheRobot.reset();
      return outcome.kind === "done" ? null : outcome.why.sentence;
    },
    jog,
    stopJog,
    emergencyStop(is) {
      pressed = is;
      if (is) neutral.stop(true);
    },
    setGuardOpen(open) {
      neutral.atTheRobot.setGuardOpen(open);
    },
    protectiveStop(because) {
      neutral.atTheRobot.protectiveStop(because);
    },
    setInput(signal, value) {
      neutral.atTheRobot.setInput(signal, value);
    },
  };
}
