import { axesOfJoints, degrees, flangePose, jointsOfAxes, type AxisCounting, type Robot } from "@twincell/core";
import type { Address, DatagramSocket } from "../../transport/index.ts";
import {
  COMM_TIMEOUT_S,
  EGM_STATE,
  MOTORS,
  RAPID,
  egmRobotWriter,
  noEgmRobot,
  noEgmSensor,
  readEgmSensor,
  type EgmPose,
} from "../codec/index.ts";
import { abbAxes } from "../codec/axes.ts";

export interface EgmMotionOptions {
  readonly robot: Robot;
  readonly socket: DatagramSocket;
  readonly to: Address;
  readonly maxSpeed: number;
  readonly gain_per_s: number;
  readonly commTimeout_s: number | undefined;
  readonly log: (sentence: string) => void;
  /** EGM ended by itself, with an error. */
  readonly failed: (because: string) => void;
}
const MOST_LOGGED = 100;
const CONVERGED_DEG = 0.01;
/** Beyond its limit a target is a fault; rounding is none [rad]. */
const SLACK_RAD = 1e-7;

/**
 * Motion that is guided from outside: tells where the robot is, goes where it is told, with a lag, until targets fail
 * to come.
 */
export class EgmMotion {
  readonly q_rad: Float64Array;
  /** Why it ended last, or "". */
  message = "";
  frozen = false;
  motorsOn = true;
  private readonly options: EgmMotionOptions;
  private readonly v_rad_s: Float64Array;
  private readonly target_rad: Float64Array;
  private readonly wanted_rad_s: Float64Array;
  private readonly out = noEgmRobot();
  private readonly heard = noEgmSensor();
  private readonly write = egmRobotWriter();
  private readonly logged = new Set<string>();
  private state: number = EGM_STATE.running;
  private silent_s = -Infinity;
  private timeout_s: number;
  private sequence = 0;
  private readonly counting: AxisCounting;
  private readonly asked_rad: Float64Array;
  private readonly ahead_deg: Float64Array;

  constructor(options: EgmMotionOptions, q_rad: Float64Array) {
    const n = q_rad.length;
    this.options = options;
    this.q_rad = q_rad;
    this.v_rad_s = new Float64Array(n);
    this.target_rad = q_rad.slice();
    this.wanted_rad_s = new Float64Array(n);
    this.counting = abbAxes(options.robot);
    this.asked_rad = q_rad.slice();
    this.ahead_deg = new Float64Array(n);
    this.timeout_s = options.commTimeout_s ?? COMM_TIMEOUT_S;
    this.out.axes = n;
    options.socket.onDatagram((lent, from) => {
      if (!this.frozen) this.hear(lent, from);
    });
  }

  get isRunning(): boolean {
    return this.state === EGM_STATE.running;
  }
  get hasFailed(): boolean {
    return this.state === EGM_STATE.error;
  }
  /** The robot stays where it is until the first target comes. */
  start(commTimeout_s?: number): void {
    this.state = EGM_STATE.running;
    this.message = "";
    this.timeout_s = this.options.commTimeout_s ?? commTimeout_s ?? COMM_TIMEOUT_S;
    this.target_rad.set(this.q_rad);
    this.wanted_rad_s.fill(0);
    this.silent_s = -Infinity;
  }
  /** The robot brakes as hard as it can. */
  end(kind: "stopped" | "error", because: string): void {
    const to = kind === "error" ? EGM_STATE.error : EGM_STATE.stopped;
    // The first reason stays; an error is more than a stop.
    if (!this.isRunning && kind === "stopped") return;
    this.state = to;
    this.message = because;
  }
  /** Somebody else moves the robot: it is not called back to where it was before. */
  standsAt(fill: (q_rad: Float64Array) => void): void {
    fill(this.q_rad);
    this.v_rad_s.fill(0);
    this.target_rad.set(this.q_rad);
    this.wanted_rad_s.fill(0);
  }
  boot(): void {
    this.v_rad_s.fill(0);
    this.sequence = 0;
  }

  /** One cycle of motion towards the target, or of braking. */
  cycle(dt_s: number): void {
    const {
      options: { robot, maxSpeed, gain_per_s },
      q_rad,
      v_rad_s,
    } = this;
    const { joints } = robot.arm;
    this.silent_s += dt_s;
    if (this.isRunning && this.silent_s > this.timeout_s) this.fail(`No target came for ${this.timeout_s} s.`);
    for (let i = 0; i < q_rad.length; i++) {
      const { limits } = joints[i]!;
      const most = limits.speed_rad_s * maxSpeed;
      if (this.isRunning) {
        const to_rad_s = this.wanted_rad_s[i]! + gain_per_s * (this.target_rad[i]! - q_rad[i]!);
        v_rad_s[i] = Math.min(most, Math.max(-most, to_rad_s));
      } else {
        const less = limits.acceleration_rad_s2 * dt_s;
        const v = v_rad_s[i]!;
        v_rad_s[i] = Math.abs(v) <= less ? 0 : v - Math.sign(v) * less;
      }
      const q = q_rad[i]! + v_rad_s[i]! * dt_s;
      q_rad[i] = Math.min(limits.upper_rad, Math.max(limits.lower_rad, q));
    }
  }
  /** Says where it is. @param time_ms  of the controller's own clock. */
  tell(time_ms: number): void {
    const { out, q_rad } = this;
    let converged = true;
    axesOfJoints(this.counting, q_rad, out.joints_deg);
    axesOfJoints(this.counting, this.target_rad, out.planned_deg);
    for (let i = 0; i < q_rad.length; i++) {
      converged &&= Math.abs(degrees(this.target_rad[i]! - q_rad[i]!)) < CONVERGED_DEG;
    }
    this.tellPose(q_rad, out.pose);
    this.tellPose(this.target_rad, out.plannedPose);
    out.sequence = this.sequence++;
    out.time_ms = time_ms;
    out.motors = this.motorsOn ? MOTORS.on : MOTORS.off;
    out.state = this.state;
    out.rapid = this.isRunning ? RAPID.running : RAPID.stopped;
    out.converged = converged;
    this.options.socket.send(this.write(out), this.options.to);
  }

  /**
   * The flange (tool0) in the base frame (wobj0), as EGM tells it that was set up with neither tool nor work object.
   */
  private tellPose(q_rad: Float64Array, to: EgmPose): void {
    const {
      position: [x, y, z],
      quaternion: [qx, qy, qz, qw],
    } = flangePose(this.options.robot.arm, q_rad);
    to.known = true;
    to.position_mm.set([1000 * x, 1000 * y, 1000 * z]);
    to.orientation.set([qw, qx, qy, qz]);
  }
  private fail(because: string): void {
    this.end("error", because);
    this.options.failed(because);
  }
  private hear(lent: Uint8Array, from: Address): void {
    const {
      heard,
      options: { robot, log },
    } = this;
    const { joints } = robot.arm;
    const n = joints.length;
    const flaw =
      readEgmSensor(lent, heard) ??
      (heard.axes === n ? null : `The target has ${heard.axes} axes; ${robot.name} has ${n}.`);
    if (flaw !== null) {
      const line = `${from.host}:${from.port}: ${flaw}`;
      if (this.logged.size < MOST_LOGGED && !this.logged.has(line)) {
        this.logged.add(line);
        log(line);
      }
      return;
    }
    if (!this.isRunning) return;
    jointsOfAxes(this.counting, heard.joints_deg, this.asked_rad);
    for (let i = 0; i < n; i++) {
      const { lower_rad, upper_rad } = joints[i]!.limits;
      const q = this.asked_rad[i]!;
      if (q < lower_rad - SLACK_RAD || q > upper_rad + SLACK_RAD) {
        this.fail(`Joint ${i + 1} was told to go to ${heard.joints_deg[i]!.toFixed(1)}°, beyond its limit.`);
        return;
      }
    }
    this.silent_s = 0;
    this.target_rad.set(this.asked_rad);
    this.wanted_rad_s.fill(0);
    if (!heard.hasSpeeds) return;
    // Axes are counted linearly: what a second at that speed adds.
    for (let i = 0; i < n; i++) this.ahead_deg[i] = heard.joints_deg[i]! + heard.speeds_deg_s[i]!;
    jointsOfAxes(this.counting, this.ahead_deg, this.wanted_rad_s);
    for (let i = 0; i < n; i++) this.wanted_rad_s[i]! -= this.asked_rad[i]!;
  }
}
