import type { CommandOutcome, ConnectedRobot, PreparedRun, Refusal, RobotCommander } from "@twincell/core";
import type { ServedVirtualPendant } from "./pendant.ts";
import type { ConnectionInfo, EventOf } from "./tell.ts";

/** What a host needs of a station. */
export interface ServedConnection<C extends RobotCommander = RobotCommander> extends ConnectedRobot<C> {
  readonly words: ConnectionInfo;
  readonly guard: { readonly state: Omit<EventOf<"guard">, "type" | "station" | "cell" | "kept_m"> };
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
  /** The pendant of a virtual controller; null where a person stands before a real one. */
  readonly pendant: ServedVirtualPendant | null;
  onGuard(listen: () => void): () => void;
}
export interface ServedMember {
  readonly station: ServedConnection;
  readonly prepare: () => Promise<PreparedRun>;
}
export interface ServedGroup {
  readonly outcome: CommandOutcome;
  readonly each: ReadonlyMap<string, CommandOutcome>;
}
export type OpenedConnection =
  | { readonly kind: "opened"; readonly station: ServedConnection }
  | { readonly kind: "refused"; readonly why: Refusal };
