import { FINGERS, parseHandProfile, type HandProfile } from "@twincell/core";
import { createStore } from "zustand/vanilla";

/** What is read of a finger while the hand opens and closes: 12-bit numbers; low above high before the first. */
export interface FingerSweep {
  readonly low: number;
  readonly high: number;
}
/** A profile being made: the ranges seen, and the voltages of the tracker at rest. */
export interface Calibration {
  readonly sweeps: readonly FingerSweep[];
  readonly rest_V: number | null;
}
export interface GloveState {
  readonly link: "none" | "opening" | "open";
  /** Lines that were understood and lines that were left out since it was opened. */
  readonly samples: number;
  readonly dropped: number;
  readonly rate_Hz: number;
  /** Bend of the fingers, thumb first [rad]; by the chosen profile. */
  readonly bends_rad: readonly number[];
  /** The hand is closed: the gripper takes (row M-24). */
  readonly closed: boolean;
  readonly profiles: readonly HandProfile[];
  /** Name of the profile of the one who wears it; "" for none. */
  readonly wearer: string;
  readonly calibration: Calibration | null;
  readonly recording: boolean;
}
export const gloveStore = createStore<GloveState>(() => ({
  link: "none",
  samples: 0,
  dropped: 0,
  rate_Hz: 0,
  bends_rad: Array.from({ length: FINGERS }, () => 0),
  closed: false,
  profiles: [],
  wearer: "",
  calibration: null,
  recording: false,
}));
export const wearerOf = ({ profiles, wearer }: GloveState): HandProfile | undefined =>
  profiles.find(({ name }) => name === wearer);

const KEY = "twincell.hands";
type TextStore = Pick<Storage, "getItem" | "setItem">;
/** Profiles stay in this browser: they are of people, not of a cell (row M-29). */
export function readHands(store: TextStore): void {
  const texts = ((): unknown => {
    try {
      return JSON.parse(store.getItem(KEY) ?? "[]");
    } catch {
      return [];
    }
  })();
  const profiles = (Array.isArray(texts) ? texts : []).flatMap(text => {
    const profile = typeof text === "string" ? parseHandProfile(text) : null;
    return profile ? [profile] : [];
  });
  gloveStore.setState({ profiles, wearer: profiles[0]?.name ?? "" });
}
/** Keeps a profile in place of one of that name, and takes it. A store that is full costs it after a reload only. */
export function keepHand(profile: HandProfile, store: TextStore): boolean {
  const { profiles } = gloveStore.getState();
  const kept = [...profiles.filter(({ name }) => name !== profile.name), profile];
  gloveStore.setState({ profiles: kept, wearer: profile.name, calibration: null });
  try {
    store.setItem(KEY, JSON.stringify(kept.map(each => JSON.stringify(each))));
    return true;
  } catch {
    return false;
  }
}
