import {
  compose,
  flangePose,
  fromAxisAngle,
  identity,
  inverse,
  multiply,
  nearestSolution,
  type Pose,
  type Quaternion,
  type Robot,
} from "@twincell/core";

type Wanted =
  | { readonly kind: "rest"; readonly deceleration: number }
  | { readonly kind: "servo"; readonly q_rad: Float64Array; readonly lookahead_s: number }
  | { readonly kind: "speed"; readonly qd_rad_s: Float64Array; readonly acceleration: number }
  | { readonly kind: "tool"; readonly twist: Float64Array; readonly acceleration: number };

/**
 * Motion whose target changes while it moves: what servoj, speedj, speedl and their stops ask for. Every joint keeps
 * its speed and acceleration and stops in front of its limit. A tool's motion begins from rest; where a joint cannot
 * follow its speed it is slowed as a whole, and where no posture follows it the joints come to rest.
 */
export class Stream {
  private readonly robot: Robot;
  private readonly dt_s: number;
  private readonly next: Float64Array;
  /** Joint speeds [rad/s]. */
  readonly qd: Float64Array;
  /** Speed and turning rate of the tool in the robot's base [m/s, rad/s]. */
  private readonly twist = new Float64Array(6);
  private toolMoves = false;
  private wanted: Wanted = { kind: "rest", deceleration: 4 };
  tool: Pose<"flange", "tcp"> = identity();

  constructor(robot: Robot, dt_s: number) {
    this.robot = robot;
    this.dt_s = dt_s;
    this.next = new Float64Array(robot.arm.joints.length);
    this.qd = new Float64Array(robot.arm.joints.length);
  }

  /** Whether the arm stands and nothing is asked of it. */
  get isAtRest(): boolean {
    return this.wanted.kind === "rest" && this.qd.every(speed => speed === 0);
  }
  /** Slows down [rad/s²]; the joints' own accelerations are not exceeded. */
  rest(deceleration: number): void {
    this.wanted = { kind: "rest", deceleration };
  }
  servo(q_rad: ArrayLike<number>, lookahead_s: number): void {
    this.wanted = { kind: "servo", q_rad: Float64Array.from(q_rad), lookahead_s };
  }
  speed(qd_rad_s: ArrayLike<number>, acceleration: number): void {
    this.wanted = { kind: "speed", qd_rad_s: Float64Array.from(qd_rad_s), acceleration };
  }
  /** @param twist  of the tool in the robot's base. */
  moveTool(twist: ArrayLike<number>, acceleration: number): void {
    if (this.wanted.kind !== "tool") {
      this.twist.fill(0);
      this.toolMoves = false;
    }
    this.wanted = { kind: "tool", twist: Float64Array.from(twist), acceleration };
  }
  /** Whether the wanted speed is there, where one is wanted. */
  get hasReached(): boolean {
    const { wanted } = this;
    if (wanted.kind === "speed") return wanted.qd_rad_s.every((speed, i) => Math.abs(speed - this.qd[i]!) < 1e-6);
    if (wanted.kind === "tool") return wanted.twist.every((speed, i) => Math.abs(speed - this.twist[i]!) < 1e-9);
    return true;
  }

  /** One cycle from `q` on; lent. Null when nothing moves. */
  advance(q: Float64Array): Float64Array | null {
    if (this.isAtRest) return null;
    const { dt_s, robot, next, qd } = this;
    const joints = robot.arm.joints;
    this.toolMoves ||= this.wanted.kind === "tool" && qd.every(speed => speed === 0);
    if (this.wanted.kind === "tool" && this.toolMoves && this.followTool(q, this.wanted)) return next;
    const { wanted } = this;
    for (let i = 0; i < joints.length; i++) {
      const { limits } = joints[i]!;
      const most = limits.acceleration_rad_s2;
      let speed = 0;
      let acceleration = most;
      if (wanted.kind === "servo") {
        // v = e / T, and never so fast that it could not stop at the target.
        const error = wanted.q_rad[i]! - q[i]!;
        const direct = Math.abs(error) / wanted.lookahead_s;
        const stoppable = Math.sqrt(2 * most * Math.abs(error));
        speed = Math.sign(error) * Math.min(direct, stoppable);
      } else if (wanted.kind === "speed") {
        speed = wanted.qd_rad_s[i]!;
        acceleration = Math.min(most, wanted.acceleration);
      } else if (wanted.kind === "rest") acceleration = Math.min(most, wanted.deceleration);
      // v²/2a + v·dt ≤ room: the cycle under way is driven as well.
      const room = Math.max(0, speed > 0 ? limits.upper_rad - q[i]! : q[i]! - limits.lower_rad);
      const step = most * dt_s;
      const stoppable = Math.sqrt(step * step + 2 * most * room) - step;
      speed = Math.sign(speed) * Math.min(Math.abs(speed), limits.speed_rad_s, stoppable);
      const change = acceleration * dt_s;
      qd[i] = qd[i]! + Math.max(-change, Math.min(change, speed - qd[i]!));
      next[i] = Math.max(limits.lower_rad, Math.min(limits.upper_rad, q[i]! + qd[i]! * dt_s));
    }
    return next;
  }

  /** The tool goes on along its twist; false when no posture goes there: then the joints come to rest. */
  private followTool(q: Float64Array, wanted: Extract<Wanted, { kind: "tool" }>): boolean {
    const { dt_s, robot, next, qd, twist } = this;
    const change = wanted.acceleration * dt_s;
    for (let i = 0; i < 6; i++)
      twist[i] = twist[i]! + Math.max(-change, Math.min(change, wanted.twist[i]! - twist[i]!));
    const baseFromTcp = compose(flangePose(robot.arm, q), this.tool);
    const [x, y, z] = baseFromTcp.position;
    const rate = Math.hypot(twist[3]!, twist[4]!, twist[5]!);
    const turn: Quaternion =
      rate < 1e-12 ? [0, 0, 0, 1] : fromAxisAngle([twist[3]! / rate, twist[4]! / rate, twist[5]! / rate], rate * dt_s);
    const goal: Pose<"base", "tcp"> = {
      position: [x + twist[0]! * dt_s, y + twist[1]! * dt_s, z + twist[2]! * dt_s],
      quaternion: multiply(turn, baseFromTcp.quaternion),
    };
    const joints = robot.arm.joints;
    const isWithin = (angle: number, i: number): boolean =>
      angle <= joints[i]!.limits.upper_rad && angle >= joints[i]!.limits.lower_rad;
    if (!nearestSolution(robot, compose(goal, inverse(this.tool)), q, next) || !next.every(isWithin)) {
      this.wanted = { kind: "rest", deceleration: Infinity };
      return false;
    }
    let load = 1;
    for (let i = 0; i < next.length; i++)
      load = Math.max(load, Math.abs(next[i]! - q[i]!) / (joints[i]!.limits.speed_rad_s * dt_s));
    for (let i = 0; i < next.length; i++) {
      next[i] = q[i]! + (next[i]! - q[i]!) / load;
      qd[i] = (next[i]! - q[i]!) / dt_s;
    }
    return true;
  }
}
