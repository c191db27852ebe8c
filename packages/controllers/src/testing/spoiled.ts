import type { JointSample, StateSource } from "@twincell/core";

/**
 * The samples of a source, each overwritten with nonsense as soon as the listener returns: whoever keeps a lent one is
 * found out.
 */
export function onCorruptSample(source: StateSource, listen: (lent: JointSample) => void): () => void {
  return source.onSample(sample => {
    const lent = { ...sample, q_rad: Float64Array.from(sample.q_rad) };
    listen(lent);
    lent.q_rad.fill(NaN);
    Object.assign(lent, { sequence: -1, time_s: NaN, step: "spoiled", message: "spoiled" });
  });
}
