import type { Vector3 } from "@twincell/core";
import { createStore } from "zustand/vanilla";

export type HeadsetTab = "teach" | "check" | "run" | "cell" | "history";
/** How the next point is reached; "way": not points but the way of the hand is kept (row L-31). */
export type RecordAs = "ptp" | "lin" | "circ" | "way";
/** Where the eyes are: standing on the floor, on a chair, or before a cell that stands on a table (row M-14). */
export type Posture = "standing" | "seated" | "table";
/** What the hand may change of the tool (row L-30). */
export type HandLock = "free" | "move" | "turn";
/** Where a panel stands in the room of the headset, and how it is turned; y up. */
export interface PanelPlace {
  readonly at: Readonly<Vector3>;
  readonly turn_rad: number;
  readonly tilt_rad: number;
}
/** Which parts of a controller carry the tool, turn the view, close the gripper: each chosen by itself (row X-33). */
export interface ControllerUse {
  readonly take: "grip" | "trigger";
  readonly view: "both" | "left" | "right";
  readonly gripper: "a" | "b" | "none";
}

/**
 * Whether a headset can be entered, and if not, why: for the button and its tip. `ready` is `null` while the browser is
 * being asked. The rest is what a person has chosen inside.
 */
export interface HeadsetState {
  readonly ready: boolean | null;
  readonly reason: string;
  readonly tab: HeadsetTab;
  /** Which page of the tab is shown, from 0. */
  readonly page: number;
  readonly recordAs: RecordAs;
  readonly lock: HandLock;
  /** The tool goes this share of the way of the hand (row L-28). */
  readonly ratio: number;
  /** The hand that wears the plate; "stand": it stands beside the person, for one-handed use. */
  readonly wrist: "left" | "right" | "stand";
  readonly posture: Posture;
  readonly turning: "snap" | "smooth";
  /** Size of the cell as it is drawn; 1 is 1:1. */
  readonly scale: number;
  /** The tool was taken once: how that is done need not be shown again. */
  readonly hintDone: boolean;
  /** The emergency stop was pressed and not reset. */
  readonly emergency: boolean;
  /** Counts up with every wish to stand at the robot again. */
  readonly placedAnew: number;
  readonly use: ControllerUse;
  /** Where panels were put, by their id. */
  readonly places: Readonly<Record<string, PanelPlace>>;
}
export const headsetStore = createStore<HeadsetState>(() => ({
  ready: null,
  reason: "",
  tab: "teach",
  page: 0,
  recordAs: "ptp",
  lock: "free",
  ratio: 1,
  wrist: "left",
  posture: "standing",
  turning: "snap",
  scale: 1,
  hintDone: false,
  emergency: false,
  placedAnew: 0,
  use: { take: "grip", view: "both", gripper: "a" },
  places: {},
}));

/** What is kept from one session to the next, and from one day to the next. */
export type KeptHeadset = Pick<HeadsetState, "wrist" | "posture" | "turning" | "use" | "places" | "hintDone">;
export const keptHeadset = (): KeptHeadset => {
  const { wrist, posture, turning, use, places, hintDone } = headsetStore.getState();
  return { wrist, posture, turning, use, places, hintDone };
};
const KEPT: readonly (keyof KeptHeadset)[] = ["wrist", "posture", "turning", "use", "places", "hintDone"];
export const keptChanged = (now: KeptHeadset, before: KeptHeadset): boolean =>
  KEPT.some(key => now[key] !== before[key]);
const one = <T>(choices: readonly T[], value: unknown, otherwise: T): T =>
  choices.find(choice => choice === value) ?? otherwise;
const isNumber = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);

/** Takes what was kept, as far as it has the right shape; the rest stays as it is. */
export function readKeptHeadset(raw: unknown): void {
  if (typeof raw !== "object" || raw === null) return;
  const has = (key: string, of: object = raw): unknown => Reflect.get(of, key);
  const now = headsetStore.getState();
  const use = has("use");
  const { take, view, gripper } = now.use;
  headsetStore.setState({
    wrist: one(["left", "right", "stand"], has("wrist"), now.wrist),
    posture: one(["standing", "seated", "table"], has("posture"), now.posture),
    turning: one(["snap", "smooth"], has("turning"), now.turning),
    hintDone: has("hintDone") === true,
    use:
      typeof use === "object" && use !== null
        ? {
            take: one(["grip", "trigger"], has("take", use), take),
            view: one(["both", "left", "right"], has("view", use), view),
            gripper: one(["a", "b", "none"], has("gripper", use), gripper),
          }
        : now.use,
    places: readPlaces(has("places")),
  });
}
function readPlaces(raw: unknown): Record<string, PanelPlace> {
  if (typeof raw !== "object" || raw === null) return {};
  const places: Record<string, PanelPlace> = {};
  for (const [id, place] of Object.entries(raw)) {
    if (typeof place !== "object" || place === null) continue;
    const at: unknown = Reflect.get(place, "at");
    const turn_rad: unknown = Reflect.get(place, "turn_rad");
    const tilt_rad: unknown = Reflect.get(place, "tilt_rad");
    if (!Array.isArray(at) || !isNumber(turn_rad) || !isNumber(tilt_rad)) continue;
    const [x, y, z]: unknown[] = at;
    if (isNumber(x) && isNumber(y) && isNumber(z)) places[id] = { at: [x, y, z], turn_rad, tilt_rad };
  }
  return places;
}

/** A panel was put there. */
export const putPanel = (id: string, place: PanelPlace): void =>
  headsetStore.setState(({ places }) => ({ places: { ...places, [id]: place } }));
/** All panels stand again where they stand at first. */
export const resetPanels = (): void => headsetStore.setState({ places: {} });

export const SMALLEST_SCALE = 1 / 20;
export const LARGEST_SCALE = 2;
/** Draws the cell smaller or larger, within 1:20 … 2:1 (row L-07). Kinematics and program stay as they are. */
export const scaleCell = (scale: number): void =>
  headsetStore.setState({ scale: Math.min(LARGEST_SCALE, Math.max(SMALLEST_SCALE, scale)) });

/** Opens a tab at its first page; the open one goes on to its next. */
export function openTab(tab: HeadsetTab): void {
  headsetStore.setState({ tab, page: 0 });
}

/** The one after a choice, round and round. */
export function nextOf<T>(choices: readonly T[], now: T): T {
  return choices[(choices.indexOf(now) + 1) % choices.length]!;
}

/** The scene owns the session and says here how it is left. */
let leaving: (() => void) | null = null;
export const leaveHeadset = (): void => leaving?.();
export function leaveHeadsetBy(leave: (() => void) | null): void {
  leaving = leave;
}
