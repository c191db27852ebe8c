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

/** Shares of the time in which robots moved, by looking now and then. */
export class Use {
  private readonly counts = new Map<string, { looks: number; moving: number }>();
  look({ id, sample }: RobotState): void {
    const count = this.counts.get(id) ?? { looks: 0, moving: 0 };
    count.looks++;
    if (sample?.moving === true) count.moving++;
    this.counts.set(id, count);
  }
  of(id: string): number {
    const count = this.counts.get(id);
    return count ? count.moving / count.looks : 0;
  }
}
function stateOf({ sample, connection }: RobotState): FleetState {
  const { guard, link } = connection;
  if (link?.state !== "open" || sample === null) return "no-link";
  if (guard.state.emergency || sample.safety !== "normal") return "stopped";
  if (guard.state.link !== "up" || guard.state.trip !== "none") return "attention";
  return sample.moving || sample.step !== "" ? "running" : "idle";
}
export function fleetRobotOf(robot: RobotState, use: Use): FleetRobot {
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
    use: use.of(robot.id),
    roundTrip_s: Number.isFinite(roundTrip_s) ? roundTrip_s : null,
    heard_ms: robot.heard_ms,
  };
}
