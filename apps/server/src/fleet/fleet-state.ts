import { z } from "zod";
import type { RobotState } from "../standards/robot-states.ts";

export const FLEET_STATES = ["running", "idle", "attention", "stopped", "no-link"] as const;
export type FleetState = (typeof FLEET_STATES)[number];
/** One robot as a fleet is told of it. */
export const fleetRobot = z.object({
  id: z.string().max(200),
  name: z.string().max(200),
  model: z.string().max(200),
  vendor: z.string().max(200),
  virtual: z.boolean(),
  state: z.enum(FLEET_STATES),
  /** One line of what there is to say. */
  news: z.string().max(2000),
  holder: z.string().max(200).nullable(),
  /** Share of the time since its server was started in which it moved, 0 … 1. */
  use: z.number(),
  /** The same for each ten minutes of the last eight hours, the newest last. */
  use_line: z.array(z.number()).max(48).default([]),
  /** Since when it has been in this state [ms]; 0 where that is not known. */
  since_ms: z.number().default(0),
  /** Where its server is reached from other machines; "" where it is not. */
  url: z.string().max(300).default(""),
  /** From a question to the controller to its answer [s]. */
  roundTrip_s: z.number().nullable(),
  heard_ms: z.number(),
});
export type FleetRobot = z.infer<typeof fleetRobot>;
/** One sample: count of the controller, its time [s], when it came [ms], joints [rad or m]. */
export const fleetSample = z.tuple([z.number(), z.number(), z.number(), z.array(z.number()).max(16)]);
/** What a server tells each tick: its robots, and every sample of them since the tick before. */
export const fleetBatch = z.object({
  server: z.string().max(100),
  number: z.int(),
  robots: z.array(z.object({ state: fleetRobot, samples: z.array(fleetSample) })).max(64),
});
export type FleetBatch = z.infer<typeof fleetBatch>;

const PART_MS = 600_000;
const PARTS = 48;
interface Counted {
  looks: number;
  moving: number;
  /** Looks and those in motion of each ten minutes, the newest last. */
  readonly parts: { readonly from_ms: number; looks: number; moving: number }[];
  state: FleetState;
  since_ms: number;
}
/** Shares of the time in which robots moved, and since when they are in their state, by looking now and then. */
export class Use {
  private readonly counts = new Map<string, Counted>();
  look(robot: RobotState, now_ms: number): void {
    const { id, sample } = robot;
    const state = stateOf(robot);
    let count = this.counts.get(id);
    if (!count) this.counts.set(id, (count = { looks: 0, moving: 0, parts: [], state, since_ms: now_ms }));
    if (state !== count.state) {
      count.state = state;
      count.since_ms = now_ms;
    }
    const from_ms = Math.floor(now_ms / PART_MS) * PART_MS;
    let part = count.parts.at(-1);
    if (part?.from_ms !== from_ms) {
      count.parts.push((part = { from_ms, looks: 0, moving: 0 }));
      if (count.parts.length > PARTS) count.parts.shift();
    }
    count.looks++;
    part.looks++;
    if (sample?.moving !== true) return;
    count.moving++;
    part.moving++;
  }
  of(id: string): Pick<FleetRobot, "use" | "use_line" | "since_ms"> {
    const count = this.counts.get(id);
    return {
      use: count ? count.moving / count.looks : 0,
      use_line: count?.parts.map(({ looks, moving }) => Math.round((1000 * moving) / looks) / 1000) ?? [],
      since_ms: count?.since_ms ?? 0,
    };
  }
}
function stateOf({ sample, connection }: RobotState): FleetState {
  const { guard, link } = connection;
  if (link?.state !== "open" || sample === null) return "no-link";
  if (guard.state.emergency || sample.safety !== "normal") return "stopped";
  if (guard.state.link !== "up" || guard.state.trip !== "none") return "attention";
  return sample.moving || sample.step !== "" ? "running" : "idle";
}
export function fleetRobotOf(robot: RobotState, use: Use, url: string): FleetRobot {
  const { connection, sample } = robot;
  const state = stateOf(robot);
  const roundTrip_s = connection.link?.roundTrip_s ?? NaN;
  return {
    id: robot.id,
    name: robot.name,
    model: robot.model?.id ?? "",
    vendor: robot.model?.vendor ?? "",
    virtual: robot.virtual,
    state,
    news: state === "no-link" ? (connection.link?.sentence ?? "") : (sample?.message ?? ""),
    holder: connection.guard.state.holder,
    ...use.of(robot.id),
    url,
    roundTrip_s: Number.isFinite(roundTrip_s) ? roundTrip_s : null,
    heard_ms: robot.heard_ms,
  };
}
