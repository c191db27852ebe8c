import type { ControllerUse } from "../../stores/headset.ts";

/** What is read of a gamepad here: those of the browser, or recorded ones. */
export interface PadState {
  readonly axes: readonly number[];
  readonly buttons: readonly { readonly pressed: boolean }[];
}

/** Places of the xr-standard mapping, which all profiles of the W3C registry share. */
const TRIGGER = 0;
const SQUEEZE = 1;
const TOUCHPAD = 2;
const A_OR_X = 4;
const B_OR_Y = 5;
const TOUCHPAD_AXES = 0;
const STICK_AXES = 2;

const isDown = (pad: PadState, button: number): boolean => pad.buttons[button]?.pressed === true;

/**
 * Where the stick is, −1 … 1 to the right and down, written into `out`. A controller with a touchpad and no stick
 * (Vive) has it while the pad is pressed: a thumb that only rests there asks for nothing.
 */
export function readStick(pad: PadState, out: [number, number]): void {
  const x = pad.axes[STICK_AXES] ?? 0;
  const y = pad.axes[STICK_AXES + 1] ?? 0;
  const byPad = x === 0 && y === 0 && isDown(pad, TOUCHPAD);
  out[0] = byPad ? (pad.axes[TOUCHPAD_AXES] ?? 0) : x;
  out[1] = byPad ? (pad.axes[TOUCHPAD_AXES + 1] ?? 0) : y;
}

/** Whether what takes the tool is held. A controller without a grip takes it with its trigger. */
export const takesWith = (pad: PadState, { take }: ControllerUse): boolean =>
  isDown(pad, take === "trigger" || pad.buttons.length <= SQUEEZE ? TRIGGER : SQUEEZE);

export const triggerHeld = (pad: PadState): boolean => isDown(pad, TRIGGER);

/** Whether the stick of that hand turns and goes about. */
export const turnsView = (handedness: XRHandedness, { view }: ControllerUse): boolean =>
  view === "both" || view === handedness;

/**
 * Whether the gripper is to be closed: held down is closed, let go is open (row X-32). `null` where this controller has
 * no such button, or none is to do it.
 */
export function gripperHeld(pad: PadState, { gripper }: ControllerUse): boolean | null {
  if (gripper === "none") return null;
  const button = gripper === "a" ? A_OR_X : B_OR_Y;
  return pad.buttons.length > button ? isDown(pad, button) : null;
}
