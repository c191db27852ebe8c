import {
  axesOfJoints,
  fromYaskawaRxyz,
  jointsOfAxes,
  millimetres,
  plainAxes,
  pose,
  radians,
  sectionForDriver,
  toYaskawaRxyz,
  type AxisCounting,
  type AxisPulses,
  type Pose,
  type Robot,
} from "@twincell/core";

/**
 * How a controller counts the axes S, L, U, R, B, T of its robot: pulses = round(pulsesPerDegree · shown_deg), by what
 * the vendor section says of signs, zeros and couplings. Data of one robot, from its parameter file (ALL.PRM); nobody
 * can work it out from a name.
 */
export interface PulseScale {
  readonly pulsesPerDegree: readonly number[];
  readonly counting: AxisCounting;
  /** Where the numbers come from: the parameter file, or "example" for those of a virtual controller. */
  readonly source: string;
}

const EXAMPLE = "example";
/** Of virtual controllers only: the size is that of the class, the digits are made up. A real robot has its own. */
const EXAMPLE_PER_DEGREE = [1340, 1340, 1340, 1000, 1000, 620];
const PLAIN: AxisCounting = { axes: plainAxes(["S", "L", "U", "R", "B", "T"]) };

const perDegree = ({ perRadian }: AxisPulses): number[] => perRadian.map(radians);

/** The scale of a virtual controller: that of the section, or an example where it has none. */
export function exampleScale(robot: Robot): PulseScale {
  const section = sectionForDriver(robot, "yaskawa");
  const { pulses } = section ?? {};
  return {
    pulsesPerDegree: pulses === undefined ? EXAMPLE_PER_DEGREE : perDegree(pulses),
    counting: section ?? PLAIN,
    source: pulses?.source ?? EXAMPLE,
  };
}

/** The scale of a controller whose pulses the section of its robot knows; undefined where none, or made up. */
export function ownScale(robot: Robot): PulseScale | undefined {
  const scale = exampleScale(robot);
  return scale.source === EXAMPLE ? undefined : scale;
}

/** A scale with pulses that a person read off the controller. */
export const scaleWith = (robot: Robot, pulsesPerDegree: readonly number[], source: string): PulseScale => ({
  ...exampleScale(robot),
  pulsesPerDegree,
  source,
});

export function pulsesOf(
  q_rad: ArrayLike<number>,
  { pulsesPerDegree, counting }: PulseScale,
  out: Int32Array,
): Int32Array {
  const shown = axesOfJoints(counting, q_rad, new Float64Array(counting.axes.length));
  for (let i = 0; i < q_rad.length; i++) out[i] = Math.round(pulsesPerDegree[i]! * shown[i]!);
  return out;
}

/** Joint angles of pulses. A limit lies between two pulses: what rounding put beyond it is on it. */
export function radiansOf(
  pulses: ArrayLike<number>,
  { pulsesPerDegree, counting }: PulseScale,
  robot: Robot,
  out: Float64Array,
): Float64Array {
  for (let i = 0; i < out.length; i++) out[i] = pulses[i]! / pulsesPerDegree[i]!;
  jointsOfAxes(counting, out, out);
  for (let i = 0; i < out.length; i++) {
    const { lower_rad, upper_rad } = robot.arm.joints[i]!.limits;
    const pulse_rad = pulse(pulsesPerDegree[i]!);
    const q = out[i]!;
    if (q > upper_rad && q - upper_rad <= pulse_rad) out[i] = upper_rad;
    else if (q < lower_rad && lower_rad - q <= pulse_rad) out[i] = lower_rad;
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
