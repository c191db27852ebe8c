import { linkPoses, armScratch, type ArmScratch } from "../kinematics/forward.ts";
import type { SerialArm } from "../model/arm.ts";
import { isSlide } from "../model/slide.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import { rotate } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** Position and angle a followed pose is met to [m], [rad]. */
const MET = 1e-10;
/** A step of more than this [rad] is shortened: the linear model holds no further. */
const LONGEST_STEP_RAD = 0.25;
const MOST_STEPS = 40;
/** Damping [m², rad²]: far below anything but a singular posture, where it keeps the step finite. */
const DAMPING = 1e-12;

/**
 * Follows a path from one posture to the next nearby one, whatever the arm: Newton's method on
 *
 *   (JᵀJ + λ²) Δq = Jᵀ e,   e = (p_goal − p, rotation vector of R_goal Rᵀ)
 *
 * It keeps to the branch it is on and knows no joint limits, so a path that leaves them is followed all the same and
 * can be drawn and explained. One instance per caller; it allocates only when made.
 *
 * @see Lynch & Park, Modern Robotics, Cambridge 2017, ch. 6.2.
 */
export class Follower {
  readonly arm: SerialArm;
  private readonly links: Pose<"base", "link">[];
  private readonly flange: Pose<"base", "flange"> = identity();
  private readonly scratch: ArmScratch = armScratch();
  private readonly axis: Vector3 = [0, 0, 0];
  private readonly slides: readonly boolean[];
  /** 6 × n, row by row: linear rows first. */
  private readonly jacobian: Float64Array;
  private readonly normal: Float64Array;
  private readonly step: Float64Array;
  private readonly error = new Float64Array(6);

  constructor(arm: SerialArm) {
    const n = arm.joints.length;
    this.arm = arm;
    this.slides = arm.joints.map(isSlide);
    this.links = Array.from({ length: n + 1 }, () => identity<"base", "link">());
    this.jacobian = new Float64Array(6 * n);
    this.normal = new Float64Array(n * n);
    this.step = new Float64Array(n);
  }

  /**
   * Turns `q` until the flange is at the goal.
   *
   * @param q  n angles [rad]: a posture nearby; receives the answer.
   * @returns  whether the goal was met within 1e-10 m and rad; when not, `q` is the last posture tried.
   */
  meet(goal: Pose<"base", "flange">, q: Float64Array): boolean {
    const n = q.length;
    for (let turn = 0; turn < MOST_STEPS; turn++) {
      this.place(q);
      this.differentiate();
      if (this.measure(goal) < MET) return true;
      if (!this.solve(this.error)) return false;
      let longest = 0;
      for (let j = 0; j < n; j++) longest = Math.max(longest, Math.abs(this.step[j]!));
      const shorten = longest > LONGEST_STEP_RAD ? LONGEST_STEP_RAD / longest : 1;
      if (!(shorten > 0)) return false;
      for (let j = 0; j < n; j++) q[j]! += this.step[j]! * shorten;
    }
    return false;
  }

  /**
   * Joint speeds that move the flange with a twist: J q̇ = (v, ω), both in base directions.
   *
   * @param met  q is where the last call of `meet` ended well: its Jacobian is still there.
   * @param out  n speeds, per unit of whatever the twist counts in.
   */
  speeds(q: ArrayLike<number>, twist: Float64Array, out: Float64Array, met = false): void {
    if (!met) {
      this.place(q);
      this.differentiate();
    }
    this.solve(twist);
    out.set(this.step);
  }

  /** How far the flange at `q` is from the goal [m], [rad], the larger of the two. */
  miss(q: ArrayLike<number>, goal: Pose<"base", "flange">): number {
    this.place(q);
    return this.measure(goal);
  }

  /** Fills the poses of links and flange of `q`. */
  private place(q: ArrayLike<number>): void {
    linkPoses(this.arm, q, this.links, this.scratch);
    const last: Pose = this.links[this.arm.joints.length]!;
    compose(last, this.arm.lastJointFromFlange as Pose, this.flange as Pose);
  }

  /** Fills the Jacobian of the posture placed last. */
  private differentiate(): void {
    const n = this.arm.joints.length;
    const links = this.links;
    const J = this.jacobian;
    const axis = this.axis;
    const p = this.flange.position;
    for (let j = 0; j < n; j++) {
      const link = links[j + 1]!;
      const o = link.position;
      rotate(link.quaternion, this.arm.joints[j]!.axis, axis);
      if (this.slides[j] === true) {
        for (let row = 0; row < 3; row++) {
          J[row * n + j] = axis[row]!;
          J[(3 + row) * n + j] = 0;
        }
        continue;
      }
      const rx = p[0] - o[0];
      const ry = p[1] - o[1];
      const rz = p[2] - o[2];
      J[j] = axis[1] * rz - axis[2] * ry;
      J[n + j] = axis[2] * rx - axis[0] * rz;
      J[2 * n + j] = axis[0] * ry - axis[1] * rx;
      J[3 * n + j] = axis[0];
      J[4 * n + j] = axis[1];
      J[5 * n + j] = axis[2];
    }
  }

  private measure(goal: Pose<"base", "flange">): number {
    const e = this.error;
    const p = this.flange.position;
    const a = this.flange.quaternion;
    const g = goal.position;
    const b = goal.quaternion;
    e[0] = g[0] - p[0];
    e[1] = g[1] - p[1];
    e[2] = g[2] - p[2];
    // b · a⁻¹ as a rotation vector in base directions.
    const w = b[3] * a[3] + b[0] * a[0] + b[1] * a[1] + b[2] * a[2];
    const x = -b[3] * a[0] + b[0] * a[3] - b[1] * a[2] + b[2] * a[1];
    const y = -b[3] * a[1] + b[0] * a[2] + b[1] * a[3] - b[2] * a[0];
    const z = -b[3] * a[2] - b[0] * a[1] + b[1] * a[0] + b[2] * a[3];
    const sine = Math.sqrt(x * x + y * y + z * z);
    const factor = sine < 1e-9 ? (w < 0 ? -2 : 2) : (2 * Math.atan2(w < 0 ? -sine : sine, Math.abs(w))) / sine;
    e[3] = x * factor;
    e[4] = y * factor;
    e[5] = z * factor;
    const far = Math.sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    const turned = Math.sqrt(e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
    return Math.max(far, turned);
  }

  /** step = (JᵀJ + λ²)⁻¹ Jᵀ right, by Cholesky. False when a number was not finite. */
  private solve(right: Float64Array): boolean {
    const n = this.step.length;
    const J = this.jacobian;
    const A = this.normal;
    const x = this.step;
    for (let i = 0; i < n; i++) {
      let sum = 0;
      for (let r = 0; r < 6; r++) sum += J[r * n + i]! * right[r]!;
      x[i] = sum;
      for (let j = 0; j <= i; j++) {
        let product = i === j ? DAMPING : 0;
        for (let r = 0; r < 6; r++) product += J[r * n + i]! * J[r * n + j]!;
        for (let k = 0; k < j; k++) product -= A[i * n + k]! * A[j * n + k]!;
        A[i * n + j] = i === j ? Math.sqrt(Math.max(product, DAMPING * 1e-3)) : product / A[j * n + j]!;
      }
    }
    for (let i = 0; i < n; i++) {
      for (let k = 0; k < i; k++) x[i]! -= A[i * n + k]! * x[k]!;
      x[i]! /= A[i * n + i]!;
    }
    for (let i = n - 1; i >= 0; i--) {
      for (let k = i + 1; k < n; k++) x[i]! -= A[k * n + i]! * x[k]!;
      x[i]! /= A[i * n + i]!;
    }
    return Number.isFinite(x[0]!);
  }
}
