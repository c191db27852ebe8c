import { createStore } from "zustand/vanilla";

export type HeadsetTab = "teach" | "check" | "run" | "cell" | "history";
/** How the next point is reached; "way": not points but the way of the hand is kept (row L-31). */
export type RecordAs = "ptp" | "lin" | "circ" | "way";
/** Where the eyes are: standing on the floor, on a chair, or before a cell that stands on a table (row M-14). */
export type Posture = "standing" | "seated" | "table";
/** What the hand may change of the tool (row L-30). */
export type HandLock = "free" | "move" | "turn";

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
}));

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
