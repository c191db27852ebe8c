/**
 * A program laid out in time. Plain data: it crosses a worker's border by structured clone,
 * and `samplePlan` gives the joint angles of any instant from it.
 */
export interface Plan {
  readonly robot: string;
  readonly duration_s: number;
  /** In order, without gaps. */
  readonly segments: readonly Segment[];
  /** What the program writes to its outputs, in order of time. */
  readonly writes: readonly SignalWrite[];
}

export interface SignalWrite {
  readonly at_s: number;
  readonly signal: string;
  readonly to: boolean | number;
}

interface SegmentBase {
  /** Id of the step it belongs to. */
  readonly step: string;
  readonly start_s: number;
  readonly duration_s: number;
}

/**
 * Joint angles on a grid of times, rising from 0 to duration_s, close enough that the cubic Hermite curve through
 * (q, q̇) stays within the planner's tolerance of the commanded path.
 */
export interface MotionSegment extends SegmentBase {
  readonly kind: "motion";
  readonly path: "ptp" | "lin" | "circ" | "spline";
  /** n times [s] after start_s. */
  readonly times_s: Float64Array;
  /** n × joints angles and speeds, row by row. */
  readonly q_rad: Float64Array;
  readonly qd_rad_s: Float64Array;
}
export interface RestSegment extends SegmentBase {
  readonly kind: "rest";
  readonly q_rad: Float64Array;
  /** State of the gripper during the rest and until the next change. */
  readonly gripperClosed: boolean;
}
export type Segment = MotionSegment | RestSegment;
