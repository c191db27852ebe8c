import { type AxisPulses, type Robot } from "@twincell/core";

/** Pulses per degree of each axis, S first. */
export interface PulseData {
  readonly pulsesPerDegree: readonly number[];
  readonly source: string;
}

/** What sources of pulses say that are made up: for virtual controllers only. */
const EXAMPLE = "example";

/**
 * The pulses of a robot's vendor section; undefined where it has none.
 *
 * @param examples  whether made-up ones are taken too: those of a virtual controller, never of a real job.
 */
export function pulsesOf({ vendorSection }: Robot, examples: boolean): PulseData | undefined {
  const pulses: AxisPulses | undefined = vendorSection?.pulses;
  if (pulses === undefined || (pulses.source === EXAMPLE && !examples)) return undefined;
  return {
    pulsesPerDegree: pulses.perRadian.map(value => (value * Math.PI) / 180),
    source: pulses.source,
  };
}
