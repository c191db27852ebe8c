import type { CommandOutcome, JointSample, LinkReport, Program, Refusal, RobotController } from "@twincell/core";
import type { ServedVirtualPendant } from "./pendant.ts";
import type { ConnectionInfo, EventOf } from "./tell.ts";

/** The place of one who commands at one station. */
export interface ServedCommander {
  acquireLease(): CommandOutcome;
  releaseLease(): CommandOutcome;
  setEnabled(pressed: boolean): CommandOutcome;
  acknowledge(): CommandOutcome;
  alive(): void;
  readonly robot: RobotController;
}
/** What a host needs of a station. */
export interface ServedConnection<Seat extends ServedCommander = ServedCommander> {
  readonly words: ConnectionInfo;
  readonly link: LinkReport | null;
  readonly guard: { readonly state: Omit<EventOf<"guard">, "type" | "station" | "cell" | "kept_m"> };
  /** Whether its guard knows a cell, and how much it keeps from what stands there [m]. */
  readonly kept: { readonly cell: boolean; readonly kept_m: number };
  readonly deviation: { readonly plan_rad: number; readonly command_rad: number };
  commander(who: string): Seat;
  connect(): Promise<CommandOutcome>;
  disconnect(): void;
  /** Only to watch it from now on, or to command it again: the connection is opened anew, as one or the other. */
  watch(seat: Seat, on: boolean): Promise<CommandOutcome>;
  readonly ahead: {
    horizon_s: number;
    onChange(
      listen: (
        words: {
          readonly q_rad: Float64Array;
          readonly in_s: number;
          readonly problem: { readonly code: string; readonly sentence: string; readonly in_s: number } | null;
        } | null,
      ) => void,
    ): () => void;
  };
  preview(program: Program): Promise<CommandOutcome>;
  /** Whether its connection can be told every step of it, one by one. */
  takes(program: Program): CommandOutcome;
  run(seat: Seat, program: Program, asText: boolean, despite?: readonly string[]): Promise<CommandOutcome>;
  /** Makes a program ready to be started: what may be refused is told before anything moves. */
  prepare(seat: Seat, program: Program, asText: boolean, despite?: readonly string[]): Promise<ServedRun>;
  /** Why that program would not be run from where the one that runs now ends; null where it would. */
  judge?(program: Program, asText: boolean, despite?: readonly string[]): Promise<Refusal | null>;
  stop(emergency: boolean): void;
  /** The cell whose objects and tool its guard keeps it from. */
  setCell(document: unknown): CommandOutcome;
  /** The pendant of a virtual controller; null where a person stands before a real one. */
  readonly pendant: ServedVirtualPendant | null;
  readonly plug: ((pulled: boolean) => void) | null;
  onSample(listen: (lent: JointSample) => void): () => void;
  onLink(listen: (report: LinkReport) => void): () => void;
  onGuard(listen: () => void): () => void;
  onNotice(listen: (why: Refusal) => void): () => void;
  close(): void;
}
/** A program that a station has and is ready for. */
export type ServedRun =
  | {
      readonly kind: "armed";
      readonly movesAtOnce: boolean;
      readiness(): Refusal | null;
      start(): Promise<CommandOutcome>;
      drop(): void;
    }
  | { readonly kind: "refused"; readonly why: Refusal };
export interface ServedMember {
  readonly station: ServedConnection;
  readonly prepare: () => Promise<ServedRun>;
}
export interface ServedGroup {
  readonly outcome: CommandOutcome;
  readonly each: ReadonlyMap<string, CommandOutcome>;
}
export type OpenedConnection =
  | { readonly kind: "opened"; readonly station: ServedConnection }
  | { readonly kind: "refused"; readonly why: Refusal };
