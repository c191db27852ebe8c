/**
 * What a robot's joints were during the last seconds, to be asked for any moment of them. Allocates nothing after it
 * was made.
 */
export interface PoseTrail {
  /** Times must not run backwards; such a sample begins anew. `q_rad` is read. */
  record(at_s: number, q_rad: ArrayLike<number>): void;
  /**
   * Joint angles of that moment, between two samples on the straight line. False before the first sample, and with
   * none.
   */
  at(at_s: number, out_rad: Float64Array): boolean;
}

/** @param most  samples that are kept: 1024 are 11 s at 90 a second */
export function poseTrail(joints: number, most = 1024): PoseTrail {
  const times = new Float64Array(most);
  const samples = new Float64Array(most * joints);
  let newest = -1;
  let count = 0;
  const slot = (back: number): number => (newest - back + most) % most;
  return {
    record(at_s, q_rad) {
      if (count > 0 && at_s < times[newest]!) count = 0;
      newest = (newest + 1) % most;
      count = Math.min(most, count + 1);
      times[newest] = at_s;
      for (let j = 0; j < joints; j++) samples[newest * joints + j] = q_rad[j]!;
    },
    at(at_s, out_rad) {
      if (count === 0 || at_s < times[slot(count - 1)]!) return false;
      // The last sample that is not after that moment, by halves: 0 steps back is the newest.
      let near = 0;
      let far = count - 1;
      while (near < far) {
        const middle = (near + far) >> 1;
        if (times[slot(middle)]! <= at_s) far = middle;
        else near = middle + 1;
      }
      const before = slot(near);
      const after = near === 0 ? before : slot(near - 1);
      const span_s = times[after]! - times[before]!;
      const share = span_s > 0 ? Math.min(1, (at_s - times[before]!) / span_s) : 0;
      for (let j = 0; j < joints; j++) {
        const from = samples[before * joints + j]!;
        out_rad[j] = from + share * (samples[after * joints + j]! - from);
      }
      return true;
    },
  };
}
