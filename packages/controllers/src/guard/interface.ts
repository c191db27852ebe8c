import type { CommandOutcome, Pose, Refusal, RobotCommander, RobotController, Scheduler } from "@twincell/core";
import type { CellMember } from "../cell/index.ts";
import type { KnownPath } from "./known-path.ts";
import type { GuardState } from "./state.ts";

export interface GuardOptions {
  /** The robot behind the guard. Nothing else may command it. */
  readonly controller: RobotController;
  readonly scheduler: Scheduler;
  /**
   * Motion only while the commander keeps a switch pressed. Robots that are not virtual need it unless told otherwise.
   */
  readonly deadMan?: boolean;
  /** Whether the clearance margin is kept at those joint angles; asked for targets and along the motion. */
  readonly isSafe?: (q_rad: Float64Array) => boolean;
  /**
   * Without a sample for this long the link counts as lost. With the watch's own period it stays below 100 ms (row
   *
   */
  readonly silence_s?: number | (() => number);
  /** When given, the commander must call `alive` at least this often. */
  readonly heartbeat_s?: number;
  /** Longest time the robot needs to stop; how far ahead the clearance is looked at follows from it. */
  readonly brakingTime_s?: number;
  /**
   * On top of the guard's own reaction: how old samples are and how long a stop is under way, over the link to the
   * controller [s].
   */
  readonly linkDelay_s?: number;
  readonly flangeFromTcp?: Pose<"flange", "tcp">;
  /** The other robots of the cell; see `createSharedCell`. */
  readonly place?: CellMember;
  /** Begins as one that is only watched; see `Seat.watch`. */
  readonly watching?: boolean;
  /** Speed of the tool in manual mode. */
  readonly manualCap_mps?: number;
}

/** What a guard asks of a cell, and the tool whose speed it measures. */
export interface GuardedCell {
  readonly isSafe: (q_rad: Float64Array) => boolean;
  /** The pairs that touch: a motion that begins too near to something is stopped before it adds one. */
  readonly contactsAt?: (q_rad: Float64Array) => readonly string[];
  /** Told when the gripper closes or opens, and where: what it holds moves with the flange. */
  readonly gripper?: (closed: boolean, q_rad: Float64Array) => void;
  readonly flangeFromTcp?: Pose<"flange", "tcp">;
}

/** One who may command: mouse, headset, gamepad, server. */
export interface Commander extends RobotCommander {
  readonly name: string;
  /** Only to look at what others do with the robot, or to command it again. While it is watched only a stop is sent. */
  watch(on: boolean): CommandOutcome;
  /** Why a command would be turned down now; nothing is sent and nothing changes. */
  readiness(): Refusal | null;
}

export interface Guard {
  readonly state: GuardState;
  seat(name: string): Commander;
  /** Anyone may stop. */
  stop(emergency?: boolean): void;
  /** Who keeps the link knows that it is gone, maybe before it was silent for long, and maybe back before that. */
  linkLost(why?: Refusal): void;
  /**
   * The path of the motion that begins now, as a plan knows it; null when it is over. As long as the robot is on it,
   * that is where it is looked ahead, and not where its joints happen to point.
   */
  follow(path: KnownPath | null): void;
  /** What was safe on the way ahead may not be any more: something is carried now that was not, or the reverse. */
  lookAgain(): void;
  /** A virtual robot was put where it stands now without moving there: that is no speed, and no way ahead. */
  jumped(): void;
  /** The cell or the tool is another from now on; what moves is judged by it from its next sample on. */
  setCell(cell: GuardedCell): void;
  /** Why a point may not be added to a program (row T-42); null when it may. */
  pointRefusal(q_rad: ArrayLike<number>): Refusal | null;
  onChange(listen: (state: GuardState) => void): () => void;
  /** What the guard did on its own, in words. */
  onNotice(listen: (why: Refusal) => void): () => void;
  close(): void;
}
