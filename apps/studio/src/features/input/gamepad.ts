import {
  axisOf,
  axisOfStick,
  isCamera,
  type Bindings,
  type HeldAction,
  type PadAction,
  type PressedAction,
} from "../../stores/bindings.ts";

/** A gamepad at one instant: Gamepad of the browser, or a recorded one. */
export interface PadReading {
  readonly buttons: readonly number[];
  readonly axes: readonly number[];
}
export interface PadStep {
  /** −1 … 1 of each coordinate. */
  readonly axes: Float64Array;
  /** Buttons that went down in this step. */
  readonly pressed: readonly PressedAction[];
  /** 0 … 1 when the tilt trigger moved; null otherwise (row N-44). */
  readonly tilt: number | null;
  /** EDIT is held (row L-42). */
  readonly edit: boolean;
  /** The gripper is to be closed (row X-32); null where no button is bound to it. */
  readonly grip: boolean | null;
  /** −1 … 1: how fast the view turns to the right and up (row X-31). */
  readonly view: readonly [number, number];
}

/** Sticks at rest are never quite 0. What is left is stretched so that it begins at 0. */
const DEAD_ZONE = 0.15;
export const DOWN = 0.5;
const isHeld = (action: PadAction): action is HeldAction => action.endsWith("+") || action.endsWith("-");
const isPressed = (action: PadAction): action is PressedAction =>
  !isHeld(action) && action !== "turn-back" && action !== "tilt" && action !== "edit" && action !== "grip";
const live = (value: number): number =>
  Number.isFinite(value) && Math.abs(value) > DEAD_ZONE
    ? (Math.sign(value) * (Math.abs(value) - DEAD_ZONE)) / (1 - DEAD_ZONE)
    : 0;

/**
 * What the pad commands now (rows N-25 … N-37). The turn-back button must go down first, as in the paper:
 * `turningBack` remembers which buttons were pressed while it was held.
 */
export function padStep(
  now: PadReading,
  before: PadReading | null,
  bindings: Bindings,
  turningBack: Set<number>,
): PadStep {
  const axes = new Float64Array(6);
  const pressed: PressedAction[] = [];
  const down = (reading: PadReading | null, button: number): boolean => (reading?.buttons[button] ?? 0) >= DOWN;
  let back = false;
  let tilt: number | null = null;
  let edit = false;
  let grip: boolean | null = null;
  const view: [number, number] = [0, 0];
  for (const [key, action] of Object.entries(bindings.buttons))
    if (action === "turn-back" && down(now, Number(key))) back = true;
  for (const [key, action] of Object.entries(bindings.buttons)) {
    const button = Number(key);
    const isDown = down(now, button);
    const wasDown = down(before, button);
    if (isHeld(action)) {
      if (isDown && !wasDown && back) turningBack.add(button);
      if (!isDown) {
        turningBack.delete(button);
        continue;
      }
      const { axis, sign } = axisOf(action);
      axes[axis] = axes[axis]! + sign * (axis > 2 && turningBack.has(button) ? -1 : 1);
    } else if (isPressed(action)) {
      if (isDown && !wasDown) pressed.push(action);
    } else if (action === "edit") edit ||= isDown;
    else if (action === "grip") grip = (grip ?? false) || isDown;
    else if (action === "tilt") {
      const value = now.buttons[button] ?? 0;
      if (Number.isFinite(value) && value !== (before?.buttons[button] ?? 0)) tilt = Math.min(1, Math.max(0, value));
    }
  }
  for (const [key, action] of Object.entries(bindings.axes)) {
    const deflection = live(now.axes[Number(key)] ?? 0);
    if (isCamera(action)) {
      const which = action === "camera-x" ? 0 : 1;
      view[which] += deflection;
      continue;
    }
    const { axis, sign } = axisOfStick(action);
    axes[axis] = axes[axis]! + sign * deflection;
  }
  return { axes, pressed, tilt, edit, grip, view };
}
