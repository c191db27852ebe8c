import type { CommandOutcome, Refusal } from "./outcomes.ts";
import type { JointSample, LinkReport, RobotController } from "./ports.ts";
import type { Program } from "./program/program.ts";

/** A place from which a connected robot may be commanded; each who commands has one. */
export interface RobotCommander {
  /** Takes the motion lease. One at a time has it. */
  acquireLease(): CommandOutcome;
  releaseLease(): CommandOutcome;
  /** The enabling switch: pressed or let go. */
  setEnabled(pressed: boolean): CommandOutcome;
  /** A person's word that motion is wanted again, after a lost link or beside an obstacle. */
  acknowledge(): CommandOutcome;
  /** Sign of life, where heartbeats are asked for. */
  alive(): void;
  /** The robot as this one may command it. */
  readonly robot: RobotController;
}

/** A program that a controller has and is ready for. */
export type PreparedRun =
  | {
      readonly kind: "armed";
      /** Its program begins with a motion: whether it begins can be seen. */
      readonly movesAtOnce: boolean;
      /** Why it would be turned down now. */
      readiness(): Refusal | null;
      start(): Promise<CommandOutcome>;
      /** It is not started after all. */
      drop(): void;
    }
  | { readonly kind: "refused"; readonly why: Refusal };

/**
 * One connected robot as studio, server and command line meet it: its controller behind lease, enabling switch and
 * guard. Drivers implement it; a server hands it on to its clients.
 */
export interface ConnectedRobot<C extends RobotCommander = RobotCommander> {
  /** null where nothing is between: a simulated robot. */
  readonly link: LinkReport | null;
  /** How far it is from its plan, and from what it was told [rad]; NaN where neither is known. */
  readonly deviation: { readonly plan_rad: number; readonly command_rad: number };
  /**
   * Whether a cell is known to its guard, and what is kept between its links and what stands there, all errors in it
   * [m].
   */
  readonly kept: { readonly cell: boolean; readonly kept_m: number };
  commander(who: string): C;
  connect(): Promise<CommandOutcome>;
  /**
   * Stops a robot that moves, and closes the connection when it stands; nothing moves after the next one without a
   * person's word.
   */
  disconnect(): void;
  /** Only to watch it from now on, or to command it again: the connection is opened anew, as one or the other. */
  watch(commander: C, on: boolean): Promise<CommandOutcome>;
  /**
   * Runs a program from that place, compared with its plan all the way; as text where wanted and taken. It is planned
   * from where the robot stands and checked in its cell first: what makes the check red keeps it from being sent.
   *
   * @param despite  codes of findings that a person has seen and sends it in spite of; the guard stops it before
   *   contact all the same.
   */
  run(commander: C, program: Program, asText: boolean, despite?: readonly string[]): Promise<CommandOutcome>;
  /** Whether every step of it can be told over this connection, one by one; refused with all that cannot. */
  takes(program: Program): CommandOutcome;
  /** Shows where it would take the robot, without a word to it; refused with the first thing in the way. */
  preview(program: Program): Promise<CommandOutcome>;
  /** Why it would not be run from where the program that runs now ends, or the robot stands; null where it would. */
  judge(program: Program, asText: boolean, despite?: readonly string[]): Promise<Refusal | null>;
  /** The same as `run` in two, for a start together with others: what may be refused is told before anything moves. */
  prepare(commander: C, program: Program, asText: boolean, despite?: readonly string[]): Promise<PreparedRun>;
  /** Anyone may. */
  stop(emergency: boolean): void;
  /**
   * Another cell, or the same one changed. What moves is stopped if it is too near to something in it; one that cannot
   * be read leaves the one before.
   */
  setCell(document: unknown): CommandOutcome;
  /** Pulls the plug of the wire to a virtual controller, or puts it back; null where it is in a wall. */
  readonly plug: ((pulled: boolean) => void) | null;
  onSample(listen: (lent: JointSample) => void): () => void;
  onLink(listen: (report: LinkReport) => void): () => void;
  onNotice(listen: (why: Refusal) => void): () => void;
  close(then?: () => void): void;
}
