import type { OperatingMode, SafetyState } from "@twincell/core";
import { createStore } from "zustand/vanilla";
import { words } from "../messages/index.ts";

/** The controller chip: who commands, in which mode, how late, in words. */
export interface ControlState {
  readonly controller: string;
  readonly mode: OperatingMode;
  readonly safety: SafetyState;
  readonly commander: string;
  readonly latency_ms: number | null;
  readonly running: boolean;
  /** Line and step being executed. */
  readonly step: string;
  readonly line: number;
  /** Largest joint difference between twin and controller in this run [rad]. */
  readonly twinError_rad: number;
  readonly message: string;
  /** What the lines in and out say, by name. */
  readonly signals: ReadonlyMap<string, boolean | number>;
}
export const controlStore = createStore<ControlState>(() => ({
  controller: words.control.virtualRobot,
  mode: "automatic",
  safety: "normal",
  commander: "you",
  latency_ms: null,
  running: false,
  step: "",
  line: 0,
  twinError_rad: 0,
  message: "",
  signals: new Map(),
}));
