import { createStore } from "zustand/vanilla";

export const AXIS_NAMES = ["x", "y", "z", "rx", "ry", "rz"] as const;
export type AxisName = (typeof AXIS_NAMES)[number];
/** Moves a coordinate (in the joint frame: joint 1 … 6) one way while held. */
export type HeldAction = `${AxisName}${"+" | "-"}`;
export type PressedAction = "aid-next" | "aid-previous" | "record" | "ready" | "camera";
/** "turn-back": held first, the turning buttons turn the other way. "tilt": how far pressed is how far tilted.
 * "edit": held while a point is taught again. "grip": the gripper is closed while it is held. */
export type PadAction = HeldAction | PressedAction | "turn-back" | "tilt" | "edit" | "grip";
/** "x": the stick's coordinate; a leading "-" turns it round. */
export type StickAction = AxisName | `-${AxisName}` | CameraAction;
/** The stick turns the view about what is looked at. */
export type CameraAction = "camera-x" | "camera-y";
export const isCamera = (action: StickAction): action is CameraAction => action === "camera-x" || action === "camera-y";

export const PRESSED_ACTIONS: readonly HeldAction[] = AXIS_NAMES.flatMap(axis => [
  `${axis}+` as const,
  `${axis}-` as const,
]);
export const PAD_ACTIONS: readonly PadAction[] = [
  ...PRESSED_ACTIONS,
  "turn-back",
  "aid-next",
  "aid-previous",
  "record",
  "ready",
  "camera",
  "tilt",
  "edit",
  "grip",
];
export const STICK_ACTIONS: readonly StickAction[] = [
  ...AXIS_NAMES.flatMap(axis => [axis, `-${axis}` as const]),
  "camera-x",
  "camera-y",
];

/** Coordinate and direction of a held action. */
export function axisOf(action: HeldAction): { readonly axis: number; readonly sign: 1 | -1 } {
  return {
    axis: AXIS_NAMES.findIndex(name => action === `${name}+` || action === `${name}-`),
    sign: action.endsWith("+") ? 1 : -1,
  };
}
export function axisOfStick(action: Exclude<StickAction, CameraAction>): {
  readonly axis: number;
  readonly sign: 1 | -1;
} {
  return {
    axis: AXIS_NAMES.findIndex(name => action === name || action === `-${name}`),
    sign: action.startsWith("-") ? -1 : 1,
  };
}

export interface Bindings {
  /** KeyboardEvent.code → action. */
  readonly keyboard: Readonly<Record<string, HeldAction>>;
  /** Index into Gamepad.buttons → action. */
  readonly buttons: Readonly<Record<string, PadAction>>;
  /** Index into Gamepad.axes → coordinate. */
  readonly axes: Readonly<Record<string, StickAction>>;
}
/**
 * Table 3 of the edge-tracing paper by physical button (rows N-25 … N-37): 0, 1, 2 turn about y, x, z, and back while
 * 4 is held; 3 and 8 cycle the orientation aids; 5 records; 9 is Do Ready; 11 changes camera; 7 tilts the close one.
 */
export const DEFAULT_BINDINGS: Bindings = {
  keyboard: {
    KeyD: "x+",
    KeyA: "x-",
    KeyW: "y+",
    KeyS: "y-",
    KeyE: "z+",
    KeyQ: "z-",
    KeyI: "rx+",
    KeyK: "rx-",
    KeyL: "ry+",
    KeyJ: "ry-",
    KeyO: "rz+",
    KeyU: "rz-",
  },
  buttons: {
    0: "ry+",
    1: "rx+",
    2: "rz+",
    3: "aid-next",
    4: "turn-back",
    5: "record",
    6: "edit",
    7: "tilt",
    8: "aid-previous",
    9: "ready",
    11: "camera",
    12: "z+",
    13: "z-",
  },
  axes: { 0: "x", 1: "-y", 2: "camera-x", 3: "camera-y" },
};
/**
 * The table of the reaching robot (rows X-30 … X-33): the left stick and the cross move the target, the right stick
 * turns the view, A closes the gripper while it is held. Each can be bound to something else by itself.
 */
export const TARGET_BINDINGS: Bindings = {
  keyboard: DEFAULT_BINDINGS.keyboard,
  buttons: {
    0: "grip",
    3: "aid-next",
    5: "record",
    6: "edit",
    7: "tilt",
    8: "aid-previous",
    9: "ready",
    11: "camera",
    12: "z+",
    13: "z-",
  },
  axes: DEFAULT_BINDINGS.axes,
};

export interface BindingState extends Bindings {
  /** Keeps what is known of a table read from outside; null when nothing is left. */
  readonly accept: (
    keyboard: Readonly<Record<string, string>>,
    buttons: Readonly<Record<string, string>>,
    axes: Readonly<Record<string, string>>,
  ) => Bindings | null;
}
const known = <Action extends string>(
  table: Readonly<Record<string, string>>,
  actions: readonly Action[],
): Readonly<Record<string, Action>> => {
  const kept: Record<string, Action> = {};
  for (const [key, wanted] of Object.entries(table)) {
    const action = actions.find(candidate => candidate === wanted);
    if (action !== undefined) kept[key] = action;
  }
  return kept;
};
export const bindingStore = createStore<BindingState>(() => ({
  ...DEFAULT_BINDINGS,
  accept(keyboard, buttons, axes) {
    const kept = {
      keyboard: known(keyboard, PRESSED_ACTIONS),
      buttons: known(buttons, PAD_ACTIONS),
      axes: known(axes, STICK_ACTIONS),
    };
    return Object.keys(kept.keyboard).length + Object.keys(kept.buttons).length === 0 ? null : kept;
  },
}));

/** One key does one thing: binding it anew takes it from what it did. */
export const bindKey = (code: string, action: HeldAction): void =>
  bindingStore.setState(({ keyboard }) => ({
    keyboard: {
      ...Object.fromEntries(Object.entries(keyboard).filter(([key, bound]) => key !== code && bound !== action)),
      [code]: action,
    },
  }));
export const bindButton = (button: number, action: PadAction): void =>
  bindingStore.setState(({ buttons }) => ({
    buttons: {
      ...Object.fromEntries(
        Object.entries(buttons).filter(([key, bound]) => key !== String(button) && bound !== action),
      ),
      [button]: action,
    },
  }));
export const bindStick = (axis: number, action: StickAction): void =>
  bindingStore.setState(({ axes }) => ({ axes: { ...axes, [axis]: action } }));
export const bindForTarget = (): void => bindingStore.setState(TARGET_BINDINGS);
export const resetBindings = (): void => bindingStore.setState(DEFAULT_BINDINGS);
