import type { CommandOutcome, EmittedFile, JointSample, Pose, Refusal, Robot, Watchdog } from "@twincell/core";

/** One motion as a controller takes it, counted from its base. What the controller cannot do it refuses with a reason. */
export type FaceMotion =
  | { readonly path: "joints"; readonly q_rad: Float64Array; readonly ratio: number }
  | { readonly path: "line"; readonly baseFromFlange: Pose<"base", "flange">; readonly q_rad: Float64Array; readonly speed_mps: number }
  | { readonly path: "arc"; readonly baseFromVia: Pose<"base", "flange">; readonly baseFromFlange: Pose<"base", "flange">; readonly q_rad: Float64Array; readonly speed_mps: number };

/** What a connection tells. `lent` is only valid during the call. */
export interface FaceEvents {
  /** A state, as soon as it came. Time is the controller's own. */
  sample(lent: Omit<JointSample, "step">): void;
  /** A question was answered after so long [s]. */
  roundTrip(seconds: number): void;
  /** The connection is gone, by whoever's doing; the face has closed what it had open. */
  lost(sentence: string): void;
}
export type Opened = { readonly kind: "open" } | { readonly kind: "failed"; readonly why: Refusal };

/**
 * What differs between brands: how to open a connection, to say a motion, a stop, an override, and to read states. All
 * that is common to drivers (reconnecting, staleness, refusals, commands, latency) stands in front of it once.
 * No method throws and none waits: what takes time returns a promise, which the caller may leave.
 */
export interface Face {
  readonly brand: string;
  readonly robot: Robot;
  /** Without a sample for this long the link counts as lost [s]. */
  readonly stale_s: number;
  /** Time from one sample to the next where the controller sends steadily [s]: gaps are counted by it. */
  readonly period_s?: number;
  readonly watchdog: Watchdog;
  /** One attempt. Refuses a robot of another model or joint count with both names. Ends in time by itself. */
  open(events: FaceEvents): Promise<Opened>;
  close(): void;
  /** Starts a motion and resolves when the controller says how it ended. One at a time. */
  move(motion: FaceMotion): Promise<CommandOutcome>;
  /** Stops along the path; an emergency also takes the drives off. Sent at once, ahead of whatever waits. */
  stop(emergency: boolean): void;
  /** Override 0 … 1; why not, where the protocol cannot. */
  setOverride(ratio: number): Refusal | null;
  /** After a stop: alarms cleared, drives on. Why not, where a person must do it at the robot. */
  reset(): Promise<CommandOutcome>;
  setSignal(signal: string, value: boolean | number): Refusal | null;
  setGripper(closed: boolean): Refusal | null;
  /** Hands over a program text and runs it to its end. */
  runText?(files: readonly EmittedFile[]): Promise<CommandOutcome>;
}
