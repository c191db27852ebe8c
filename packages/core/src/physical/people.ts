import type { Point2 } from "../mesh/polygon.ts";

/** Someone who walks through the cell: along a line of points at a steady pace, then stands (row T-57). */
export interface Person {
  readonly id: string;
  readonly name: string;
  /** Points on the floor, in the world [m]. */
  readonly path_m: readonly Point2[];
  readonly speed_mps: number;
  /** Sets out at this time [s]. */
  readonly starts_s: number;
  readonly height_m: number;
}

/** What the cell does while someone is inside. */
export type ZoneReaction = { readonly kind: "slow"; readonly override: number } | { readonly kind: "stop" };

/** An area of the floor that is watched for people. */
export interface PeopleZone {
  readonly id: string;
  readonly name: string;
  /** A simple outline in the world [m]. */
  readonly outline_m: readonly Point2[];
  readonly reaction: ZoneReaction;
}

/** Half of a person's breadth and of a step: how far around its middle a person may be [m]. */
export const PERSON_RADIUS_M = 0.3;

/** Where a person is on the floor and which way it looks [rad]. */
export interface PersonPlace {
  x_m: number;
  y_m: number;
  heading_rad: number;
  walking: boolean;
}

/** The person at that time. Without points it stands in the origin. `out` is overwritten and returned. */
export function personAt(
  { path_m, speed_mps, starts_s }: Person,
  time_s: number,
  out: PersonPlace = { x_m: 0, y_m: 0, heading_rad: 0, walking: false },
): PersonPlace {
  let left_m = Math.max(0, time_s - starts_s) * speed_mps;
  const first = path_m[0] ?? [0, 0];
  out.x_m = first[0];
  out.y_m = first[1];
  out.walking = false;
  for (let i = 0; i + 1 < path_m.length; i++) {
    const [ax, ay] = path_m[i]!;
    const [bx, by] = path_m[i + 1]!;
    const dx = bx - ax;
    const dy = by - ay;
    const length_m = Math.sqrt(dx * dx + dy * dy);
    if (length_m > 0) out.heading_rad = Math.atan2(dy, dx);
    const share = length_m > 0 ? Math.min(1, left_m / length_m) : 1;
    out.x_m = ax + dx * share;
    out.y_m = ay + dy * share;
    if (left_m < length_m) {
      out.walking = left_m > 0;
      return out;
    }
    left_m -= length_m;
  }
  return out;
}

/** Distance of a point of the floor from an area: 0 inside [m]. */
export function distanceToOutline(outline: readonly Point2[], x: number, y: number): number {
  let inside = false;
  let least = Number.POSITIVE_INFINITY;
  for (let i = 0, j = outline.length - 1; i < outline.length; j = i++) {
    const [ax, ay] = outline[i]!;
    const [bx, by] = outline[j]!;
    const dx = bx - ax;
    const dy = by - ay;
    const square = dx * dx + dy * dy;
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
    const t = square > 0 ? Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
    const ex = ax + t * dx - x;
    const ey = ay + t * dy - y;
    least = Math.min(least, Math.sqrt(ex * ex + ey * ey));
  }
  return inside ? 0 : least;
}

/** Whether the person stands in the area with any part of its body. */
export const personInZone = ({ outline_m }: PeopleZone, { x_m, y_m }: PersonPlace): boolean =>
  distanceToOutline(outline_m, x_m, y_m) < PERSON_RADIUS_M;

/** The strictest of the reactions: 0 stops, 1 lets the robot run. */
export const allowedOverride = (reactions: Iterable<ZoneReaction>): number => {
  let least = 1;
  for (const reaction of reactions) least = Math.min(least, reaction.kind === "stop" ? 0 : reaction.override);
  return least;
};
