import type { Pose } from "@twincell/core";
import type { ConnectionInfo, EventOf } from "@twincell/protocol";
import { createStore } from "zustand/vanilla";

/** Where the host of a station runs: in a worker of this page, or on the server that served it. */
export type ServerAddress = "page" | "server";

/** Another controller of the cell, as slowly as people read. Its joint angles are in `runtime/robot/stations.ts`. */
export interface StationState extends ConnectionInfo {
  readonly place: ServerAddress;
  /** Where its robot is drawn. */
  readonly stand: Pose<"world", "base">;
  readonly link: Omit<EventOf<"link">, "type" | "station">;
  readonly guard: Omit<EventOf<"guard">, "type" | "station">;
  readonly mode: "manual" | "automatic" | "remote";
  readonly safety: EventOf<"sample">["safety"];
  readonly moving: boolean;
  readonly override: number;
  readonly step: string;
  readonly message: string;
  readonly plan_rad: number | null;
  readonly command_rad: number | null;
  readonly running: boolean;
  /** The program that it runs cycle after cycle; null while it does not. */
  readonly production: Omit<EventOf<"production">, "type" | "station"> | null;
  /** Whether its ghost is shown, and how. Its angles are in `runtime/robot/stations.ts`. */
  readonly ghost: "none" | "free" | "blocked";
  /** The first thing in its way ahead, with the time to come; "" while the way is free. */
  readonly foreseen: string;
  /** How far ahead is looked [s]. */
  readonly ahead_s: number;
  /** The plug of a virtual controller was pulled. */
  readonly unplugged: boolean;
  /** The last thing the guard or the host said. */
  readonly notice: string;
}
/** Whether it carries out a program now: one that is held may be moved by hand. */
export const isCarryingOut = ({ running, production }: Pick<StationState, "running" | "production">): boolean =>
  running && production?.state !== "held";
export interface StationsState {
  readonly stations: readonly StationState[];
  readonly brands: EventOf<"hello">["brands"];
  /** Whether the page was served by a server that hosts stations; null until it was asked. */
  readonly server: boolean | null;
}
export const stationStore = createStore<StationsState>(() => ({ stations: [], brands: [], server: null }));

export const stationOf = (id: string): StationState | undefined =>
  stationStore.getState().stations.find(station => station.id === id);
export function changeStation(id: string, change: Partial<StationState>): void {
  stationStore.setState(({ stations }) => ({
    stations: stations.map(station => (station.id === id ? { ...station, ...change } : station)),
  }));
}
