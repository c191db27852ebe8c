import type { Robot } from "@twincell/core";

/**
 * How a Yaskawa controller counts the axes S, L, U, R, B, T of a robot:
 *   axis_deg = sign · degrees(q) + offset_deg.
 * One line per robot whose controller speaks INFORM; a robot without a line is refused instead of guessed.
 */
export interface AxisConvention {
  readonly signs: readonly number[];
  readonly offsets_deg: readonly number[];
}

const CONVENTIONS: Readonly<Record<string, AxisConvention>> = {
  // The library turns the axes as the controller shows them; U is level at 0 with the upper arm upright.
  yaskawa_gp8: { signs: [1, 1, 1, 1, 1, 1], offsets_deg: [0, 0, 0, 0, 0, 0] },
};

export const axisConvention = (robot: Robot): AxisConvention | undefined =>
  Object.hasOwn(CONVENTIONS, robot.id) ? CONVENTIONS[robot.id] : undefined;

/**
 * Encoder pulses per degree of each axis, S first, as the controller's own parameters give them: data of one robot,
 * which nobody can work out from its name.
 */
export interface PulseData {
  readonly pulsesPerDegree: readonly number[];
  /** Where the numbers come from: the parameter file, or "example" for those of a virtual controller. */
  readonly source: string;
}

/** Of the virtual GP8 only: the size is that of the class, the digits are made up. A real robot has its own. */
export const EXAMPLE_PULSES: Readonly<Record<string, PulseData>> = {
  yaskawa_gp8: { pulsesPerDegree: [1340, 1340, 1340, 1000, 1000, 620], source: "example" },
};
