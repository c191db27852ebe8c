import { branchOf, millimetres, pose, toYaskawaRxyz, fromYaskawaRxyz, type Pose, type Robot } from "@twincell/core";

/** A number with a fixed count of decimals and no minus before zero. */
export const fixed = (value: number, decimals: number): string => {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace("-", "") : text;
};

/** `X,Y,Z,Rx,Ry,Rz` in mm with three and degrees with four decimals. */
export function rectanText({ position, quaternion }: Pose): string {
  return [
    ...position.map(value => fixed(millimetres(value), 3)),
    ...toYaskawaRxyz(quaternion).map(value => fixed(value, 4)),
  ].join(",");
}

/** The pose that a text says: what is left of a pose when it is written down. */
export function rectanPose<Into extends string, From extends string>(text: string): Pose<Into, From> {
  const [x, y, z, rx, ry, rz] = text.split(",").map(Number);
  return pose([x! / 1000, y! / 1000, z! / 1000], fromYaskawaRxyz(rx!, ry!, rz!));
}

export const pulseText = (axes_deg: readonly number[], pulsesPerDegree: readonly number[]): string =>
  axes_deg.map((value, i) => fixed(Math.round(value * pulsesPerDegree[i]!), 0)).join(",");

/** Flags of ///RCONF; the controllers from the DX100 on have 24. */
const FLAGS = 24;

/**
 * Manipulator types of a posture: flip or no flip by the angle of R, upper or lower arm, front or rear, then R, T and S
 * from half a turn on.
 */
export function rconfText(robot: Robot, q_rad: ArrayLike<number>, axes_deg: readonly number[]): string {
  const branch = branchOf(robot, q_rad);
  const [s, , , r, , t] = axes_deg as [number, number, number, number, number, number];
  const within = Math.abs(r) % 360;
  const isFlip = within <= 90 || within >= 270;
  const flags = [
    isFlip ? 0 : 1,
    branch?.elbow === "down" ? 1 : 0,
    branch?.shoulder === "back" ? 1 : 0,
    ...[r, t, s].map(value => (Math.abs(value) >= 180 ? 1 : 0)),
  ];
  return [...flags, ...Array<number>(FLAGS - flags.length).fill(0)].join(",");
}
