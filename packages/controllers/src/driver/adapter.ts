import type {
  CommandOutcome,
  EmittedFile,
  UploadedProgram,
  JointSample,
  Pose,
  Refusal,
  Robot,
  Watchdog,
} from "@twincell/core";

interface MotionBase {
  /** Where it ends [rad]: for a line or an arc the posture that it leads to. */
  readonly q_rad: Float64Array;
  /** Share of the joint accelerations of the robot, more than 0 and up to 1. */
  readonly acceleration: number;
  /**
   * How long the motion takes at full override by the planner's reckoning: who waits for its end waits a multiple of
   * it.
   */
  readonly duration_s: number;
}
/**
 * One motion from rest to rest, as a controller takes it, counted from its base. What the controller cannot do it
 * refuses with a reason.
 */
export type AdapterMotion =
  /** `ratio`: share of the joint speeds of the robot, more than 0 and up to 1. */
  | (MotionBase & { readonly path: "joints"; readonly ratio: number })
  | (MotionBase & {
      readonly path: "line";
      readonly baseFromFlange: Pose<"base", "flange">;
      readonly speed_mps: number;
    })
  | (MotionBase & {
      readonly path: "arc";
      readonly baseFromVia: Pose<"base", "flange">;
      readonly baseFromFlange: Pose<"base", "flange">;
      readonly speed_mps: number;
    });

/**
 * What a connection is to say, without where it leads: whether it can is known before anything moves. An
 * `AdapterMotion` is one of these.
 */
export type AdapterOrder =
  | ({ readonly kind?: "motion" } & Pick<AdapterMotion, "path" | "acceleration">)
  | { readonly kind: "signal"; readonly signal: string; readonly value: boolean | number }
  | { readonly kind: "gripper"; readonly closed: boolean };

/** What a connection tells. `lent` is only valid during the call. */
export interface AdapterEvents {
  /** A state, as soon as it came. Time is the controller's own; `sequence` counts what the controller sent. */
  sample(lent: Omit<JointSample, "step">): void;
  /** A question was answered after so long [s]. */
  roundTrip(seconds: number): void;
  /** The connection is gone, by whoever's doing. */
  lost(sentence: string): void;
}
/**
 * `again`: whether another try may succeed without a person's doing; a robot of another model will not change by
 * itself.
 */
export type Opened =
  | { readonly kind: "open" }
  | { readonly kind: "failed"; readonly why: Refusal; readonly again: boolean };

/**
 * What differs between brands: how to open a connection, to say a motion, a stop, an override, and to read states. All
 * that is common to drivers (reconnecting, staleness, refusals, commands, latency) stands in front of it once.
 * No method throws and none waits: what takes time returns a promise, which the caller may leave.
 */
export interface ControllerAdapter {
  readonly brand: string;
  readonly robot: Robot;
  /** Without a sample for this long the link counts as lost [s]. */
  readonly stale_s: number;
  readonly watchdog: Watchdog;
  /** One attempt. Refuses a robot of another model or joint count with both names. */
  open(events: AdapterEvents): Promise<Opened>;
  /** Closes what is open, without a word to `events`. A motion under way resolves as stopped. */
  close(): void;
  /**
   * Why the connection cannot say that, wherever the robot stands; null when it can. The adapter itself asks this
   * before it encodes, so that there is no second list. Sends nothing.
   */
  cannotSay(order: AdapterOrder): Refusal | null;
  /** Starts a motion and resolves when the controller says how it ended. One at a time. */
  move(motion: AdapterMotion): Promise<CommandOutcome>;
  /** Stops along the path; an emergency also takes the drives off. Sent at once, ahead of whatever waits. */
  stop(emergency: boolean): void;
  /** Override 0 … 1; why not, where the protocol cannot. */
  setOverride(ratio: number): Refusal | null;
  /**
   * After a stop: alarms cleared, drives on. Why not, where a person must do it at the robot. `wanted` is asked before
   * each order: it says no once a stop came, and then nothing more may be switched on.
   */
  reset(wanted: () => boolean): Promise<CommandOutcome>;
  setSignal(signal: string, value: boolean | number): Refusal | null;
  setGripper(closed: boolean): Refusal | null;
  /** Mass and centre of what the flange carries, where the wire can say it. */
  setPayload?(mass_kg: number, center_m: readonly [number, number, number]): Refusal | null;
  /** Hands over a program text and runs it to its end. */
  runText?(files: readonly EmittedFile[]): Promise<CommandOutcome>;
  /** The same in two: the controller has it, and nothing moves before it is started. A stop in between ends it. */
  handText?(files: readonly EmittedFile[]): Promise<UploadedProgram>;
}
