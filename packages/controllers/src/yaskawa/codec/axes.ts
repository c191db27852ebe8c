import {
  degrees,
  fromYaskawaRxyz,
  millimetres,
  pose,
  radians,
  toYaskawaRxyz,
  type Pose,
  type Robot,
} from "@twincell/core";

/**
 * How a controller counts the axes S, L, U, R, B, T of its robot: pulses = round(pulsesPerDegree · (sign · degrees(q) +
 * offset_deg)). Data of one robot, from its parameter file (ALL.PRM); nobody can work it out from a name.
 */
export interface PulseScale {
  readonly pulsesPerDegree: readonly number[];
  readonly signs?: readonly number[];
  readonly offsets_deg?: readonly number[];
  /** Where the numbers come from: the parameter file, or "example" for those of a virtual controller. */
  readonly source: string;
}

/** Of virtual controllers only: the size is that of the class, the digits are made up. A real robot has its own. */
export const EXAMPLE_SCALE: PulseScale = { pulsesPerDegree: [1340, 1340, 1340, 1000, 1000, 620], source: "example" };

export function pulsesOf(
  q_rad: ArrayLike<number>,
  { pulsesPerDegree, signs, offsets_deg }: PulseScale,
  out: Int32Array,
): Int32Array {
  for (let i = 0; i < q_rad.length; i++)
    out[i] = Math.round(pulsesPerDegree[i]! * ((signs?.[i] ?? 1) * degrees(q_rad[i]!) + (offsets_deg?.[i] ?? 0)));
  return out;
}

/** Joint angles of pulses. A limit lies between two pulses: what rounding put beyond it is on it. */
export function radiansOf(
  pulses: ArrayLike<number>,
  { pulsesPerDegree, signs, offsets_deg }: PulseScale,
  robot: Robot,
  out: Float64Array,
): Float64Array {
  for (let i = 0; i < out.length; i++) {
    const { lower_rad, upper_rad } = robot.arm.joints[i]!.limits;
    const pulse_rad = pulse(pulsesPerDegree[i]!);
    const q = radians((signs?.[i] ?? 1) * (pulses[i]! / pulsesPerDegree[i]! - (offsets_deg?.[i] ?? 0)));
    out[i] =
      q > upper_rad && q - upper_rad <= pulse_rad
        ? upper_rad
        : q < lower_rad && lower_rad - q <= pulse_rad
          ? lower_rad
          : q;
  }
  return out;
}
const pulse = (perDegree: number): number => radians(1 / Math.abs(perDegree));

/** Half a pulse of each axis [rad]: nothing that is said in pulses is nearer than this. */
export const resolution_rad = ({ pulsesPerDegree }: PulseScale): number[] =>
  pulsesPerDegree.map(value => pulse(value) / 2);

/** X Y Z [µm], Rx Ry Rz [0.0001°] of a pose; fixed axes. */
export function placeOf({ position, quaternion }: Pose, out: Int32Array): Int32Array {
  for (let i = 0; i < 3; i++) out[i] = Math.round(millimetres(position[i]!) * 1000);
  const turned_deg = toYaskawaRxyz(quaternion);
  for (let i = 0; i < 3; i++) out[3 + i] = Math.round(turned_deg[i]! * 10_000);
  return out;
}
export function poseAt<Into extends string, From extends string>(place: ArrayLike<number>): Pose<Into, From> {
  return pose(
    [place[0]! / 1e6, place[1]! / 1e6, place[2]! / 1e6],
    fromYaskawaRxyz(place[3]! / 1e4, place[4]! / 1e4, place[5]! / 1e4),
  );
}
