import { add, addScaled, cross, normalize, scale, type SurfaceFeature, type Vector3 } from "@twincell/core";
import type { RigAxis, RigState } from "../../stores/rig.ts";

type Polyline = readonly Vector3[];

const TURN_STEP_RAD = Math.PI / 32;
/** How far an axis is drawn beyond what it belongs to, as a share of its radius, and at least [m]. */
const BEYOND = 1.5;
const LEAST_BEYOND_M = 0.05;
const HEAD_M = 0.02;
const FACE_M = 0.04;

/** Two unit vectors across an axis, at right angles, the same for the same axis. */
function acrossOf(axis: Vector3): readonly [Vector3, Vector3] {
  const least = axis.map(Math.abs).indexOf(Math.min(...axis.map(Math.abs)));
  const u = normalize(cross(axis, [least === 0 ? 1 : 0, least === 1 ? 1 : 0, least === 2 ? 1 : 0]));
  return [u, cross(axis, u)];
}

function arc(center: Vector3, axis: Vector3, radius_m: number, from_rad: number, to_rad: number): Polyline {
  const [u, v] = acrossOf(axis);
  const steps = Math.max(2, Math.ceil(Math.abs(to_rad - from_rad) / TURN_STEP_RAD));
  return Array.from({ length: steps + 1 }, (_, i) => {
    const angle = from_rad + ((to_rad - from_rad) * i) / steps;
    return add(center, add(scale(u, radius_m * Math.cos(angle)), scale(v, radius_m * Math.sin(angle))));
  });
}

/** A line along an axis with a head where it points to. */
function arrow(center: Vector3, axis: Vector3, back_m: number, on_m: number): Polyline[] {
  const tip = addScaled(center, axis, on_m);
  const [u] = acrossOf(axis);
  const foot = addScaled(tip, axis, -HEAD_M);
  return [
    [addScaled(center, axis, -back_m), tip],
    [addScaled(foot, u, HEAD_M / 2.5), tip, addScaled(foot, u, -HEAD_M / 2.5)],
  ];
}

/** The lines that show what a click would take: rings and an axis, or a small square on a face with its normal. */
export function surfaceLines(feature: SurfaceFeature): readonly Polyline[] {
  const { center_m, axis } = feature;
  if (feature.kind === "plane") {
    const [u, v] = acrossOf(axis);
    const corner = (x: number, y: number): Vector3 => add(center_m, add(scale(u, x * FACE_M), scale(v, y * FACE_M)));
    return [
      [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1), corner(-1, -1)],
      ...arrow(center_m, axis, 0, 2 * FACE_M),
    ];
  }
  const half = feature.kind === "cylinder" ? feature.length_m / 2 : 0;
  const beyond = half + Math.max(LEAST_BEYOND_M, feature.radius_m * BEYOND);
  const ring = (at: number): Polyline => arc(addScaled(center_m, axis, at), axis, feature.radius_m, 0, 2 * Math.PI);
  return [
    ...(half > 0 ? [ring(-half), ring(half)] : [ring(0)]),
    [addScaled(center_m, axis, -beyond), addScaled(center_m, axis, beyond)],
  ];
}

/** One joint of a rig: its axis, and the range between its limits: an arc about it, or a bar along it. */
export function axisLines(picked: RigAxis): {
  readonly axis: readonly Polyline[];
  readonly range: readonly Polyline[];
} {
  const { through_m, axis, radius_m, kind, lower, upper } = picked;
  const beyond = Math.max(2 * LEAST_BEYOND_M, radius_m * (1 + BEYOND));
  if (kind === "prismatic") {
    const [u] = acrossOf(axis);
    const beside = addScaled(through_m, u, radius_m);
    return {
      axis: arrow(through_m, axis, beyond, beyond),
      range: [[addScaled(beside, axis, lower), addScaled(beside, axis, upper)]],
    };
  }
  const around = Math.max(radius_m * 1.3, 0.04);
  const [from, to] = [Math.max(lower, -2 * Math.PI), Math.min(upper, 2 * Math.PI)];
  const bow = arc(through_m, axis, around, from, to);
  const whole = to - from > 2 * Math.PI - 1e-3;
  return {
    axis: arrow(through_m, axis, beyond, beyond),
    // The ends of the range are spokes: one sees where it begins and ends.
    range: whole ? [bow] : [[through_m, ...bow, through_m]],
  };
}

/** The line from joint to joint and to the flange: the chain. */
export const chainLine = ({ axes, flange }: Pick<RigState, "axes" | "flange">): Polyline => [
  ...axes.map(({ through_m }) => through_m),
  ...(flange ? [flange.at_m] : []),
];
