import type { JointMotion } from "../collision/motion.ts";
import type { MotionSegment } from "../trajectory/plan.ts";
import { sampleSegment } from "../trajectory/sample.ts";

/** The motion of a segment with bounds on its joint speeds. `rates` receives them and is kept by the motion. */
export function motionOf(segment: MotionSegment, rates: Float64Array): JointMotion {
  topSpeeds(segment, rates);
  return {
    sample: (t, out) => {
      sampleSegment(segment, t, out);
    },
    maxRate: rates,
  };
}

/**
 * Bounds on the joint speeds of a motion. A cubic's speed in Bernstein form is q̇₀, 3 Δq/h − q̇₀ − q̇₁, q̇₁ and stays
 * within the largest of them.
 */
function topSpeeds({ times_s, q_rad, qd_rad_s }: MotionSegment, out: Float64Array): void {
  const n = out.length;
  out.fill(0);
  for (let i = 0; i + 1 < times_s.length; i++) {
    const h = times_s[i + 1]! - times_s[i]!;
    for (let j = 0; j < n; j++) {
      const a = i * n + j;
      const d0 = qd_rad_s[a]!;
      const d1 = qd_rad_s[a + n]!;
      const m = h > 0 ? (3 * (q_rad[a + n]! - q_rad[a]!)) / h - d0 - d1 : 0;
      out[j] = Math.max(out[j]!, Math.abs(d0), Math.abs(d1), Math.abs(m));
    }
  }
}
