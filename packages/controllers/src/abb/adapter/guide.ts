import { DONE, stopped } from "../../outcomes.ts";
import {
  axesOfJoints,
  jointsOfAxes,
  Stepper,
  type CommandOutcome,
  type Refusal,
  type Robot,
  type Scheduler,
  type AxisCounting,
} from "@twincell/core";
import { Execution, stepOfMotion, type AdapterMotion } from "../../driver/index.ts";
import type { Address, DatagramSocket, Network } from "../../transport/index.ts";
import { EGM_PORT, egmSensorWriter, noEgmRobot, noEgmSensor, readEgmRobot, type EgmRobot } from "../codec/index.ts";
import { linkClosed, notStreamed, notStreamedBecause, taken, wasStopped } from "./words.ts";
import { abbAxes } from "../codec/axes.ts";

export interface SetpointStreamOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  /** Address of the controller: messages of others are not listened to. */
  readonly host: string;
  /** Where the controller sends to. */
  readonly ports?: { readonly egm?: number };
  /**
   * Where to listen. Left out: everywhere, or at the controller's own address when that is one of this machine, so that
   * several virtual ones have a port each.
   */
  readonly local?: string;
  /** Part of the robot's own joint speeds that 100 % stands for. */
  readonly maxSpeed?: number;
}
/** What the guide tells of each message of the controller. */
export interface SetpointStreamEvents {
  /** A state came; `axes` is what the robot there has. */
  state(message: EgmRobot, axes: number): void;
}
export interface SetpointStream {
  readonly port: number;
  readonly q_rad: Float64Array;
  /** The last message. */
  readonly message: EgmRobot;
  /** When it came; -Infinity before the first. */
  readonly heard_s: number;
  readonly isGoing: boolean;
  /** Whether the robot moves, by what it says or by what it is told. */
  readonly isMoving: boolean;
  readonly override: number;
  /** Why nothing can be heard, or null. */
  open(events: SetpointStreamEvents): Promise<Refusal | null>;
  close(why?: Refusal): void;
  move(motion: AdapterMotion): Promise<CommandOutcome>;
  /** Brakes on the path. An emergency also falls silent as soon as the robot stands. */
  stop(emergency: boolean, why?: Refusal): void;
  setOverride(ratio: number): void;
  /** After an emergency stop: the controller is answered again. */
  rearm(): void;
}

/** A robot this near to the end of its path is there [rad]; the last of the way is first-order. */
const THERE_RAD = (0.0005 * Math.PI) / 180;
/** A gap between two messages counts as at most so long: after a longer one the path goes on from where it was [s]. */
const MOST_GAP_S = 0.05;
/** Without a motion of ours a robot that is faster than this is not moved by us [rad/s]. */
const DRIVEN_RAD_S = 0.01;
const STILL_RAD_S = 1e-4;

interface Going {
  readonly stepper: Stepper;
  readonly resolve: (outcome: CommandOutcome) => void;
  isSent: boolean;
}

/**
 * Externally Guided Motion: the path is made here and told cycle by cycle, in answer to each state that the controller
 * sends.
 */
export function createSetpointStream(options: SetpointStreamOptions): SetpointStream {
  return setpointStreamOf(new Guide(options));
}

class Guide extends Execution<Going> {
  readonly options: SetpointStreamOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly n: number;
  readonly port: number;
  readonly maxSpeed: number;
  readonly message = noEgmRobot();
  readonly answer = noEgmSensor();
  readonly write = egmSensorWriter();
  readonly q_rad: Float64Array;
  readonly target_rad: Float64Array;
  readonly next_rad: Float64Array;
  readonly before_rad: Float64Array;
  readonly before_deg: Float64Array;
  readonly counting: AxisCounting;
  socket: DatagramSocket | null = null;
  events: SetpointStreamEvents | null = null;
  override = 1;
  severed = false;
  told = 0;
  heard_s = -Infinity;
  fresh = true;
  isInMotion = false;

  constructor(options: SetpointStreamOptions) {
    super();
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.n = this.robot.arm.joints.length;
    this.port = this.options.ports?.egm ?? EGM_PORT;
    this.maxSpeed = this.options.maxSpeed ?? 1;
    this.q_rad = Float64Array.from(this.robot.home_rad);
    this.target_rad = this.q_rad.slice();
    this.next_rad = this.q_rad.slice();
    this.before_rad = this.q_rad.slice();
    this.before_deg = this.q_rad.slice();
    this.counting = abbAxes(this.robot);
    this.answer.axes = this.n;
  }

  /** The next piece of the path, as long as the controller's own clock says. */
  advance(dt_s: number): void {
    this.next_rad.set(this.target_rad);
    if (this.moving && !this.moving.isSent) {
      const state = this.moving.stepper.advance(dt_s, this.override * this.maxSpeed, this.next_rad);
      if (state.kind === "fault" && state.fault) {
        this.settle({ kind: "stopped", why: state.fault });
        return;
      }
      if (state.kind !== "running") this.moving.isSent = true;
    }
    axesOfJoints(this.counting, this.target_rad, this.before_deg);
    axesOfJoints(this.counting, this.next_rad, this.answer.joints_deg);
    for (let i = 0; i < this.n; i++)
      this.answer.speeds_deg_s[i] = dt_s > 0 ? (this.answer.joints_deg[i]! - this.before_deg[i]!) / dt_s : 0;
    this.target_rad.set(this.next_rad);
  }

  take(from: Address, dt_s: number): void {
    let fastest = 0;
    let gap_rad = 0;
    this.before_rad.set(this.q_rad);
    jointsOfAxes(this.counting, this.message.joints_deg, this.q_rad);
    for (let i = 0; i < this.n; i++) {
      const before = this.before_rad[i]!;
      if (this.fresh) this.target_rad[i] = this.q_rad[i]!;
      else if (dt_s > 0) fastest = Math.max(fastest, Math.abs(this.q_rad[i]! - before) / dt_s);
      gap_rad = Math.max(gap_rad, Math.abs(this.target_rad[i]! - this.q_rad[i]!));
    }
    // Somebody else moves it, or it still brakes from what moved it before.
    if (!this.moving && !this.fresh && fastest > DRIVEN_RAD_S) {
      this.target_rad.set(this.q_rad);
      gap_rad = 0;
    }
    this.fresh = false;
    const because = notStreamedBecause(this.message);
    if (because !== "") {
      // The way is given up where the robot stands: nothing old is told when it listens again.
      this.target_rad.set(this.q_rad);
      gap_rad = 0;
      if (this.moving) this.ending ??= stopped(notStreamed(this.robot, because));
      if (fastest <= STILL_RAD_S) this.settle(this.ending ?? stopped(notStreamed(this.robot, because)));
    }
    if (because === "" && this.moving?.isSent && gap_rad <= THERE_RAD) this.settle(this.ending ?? DONE);
    this.isInMotion =
      fastest > STILL_RAD_S ||
      (this.moving !== null && !this.moving.isSent && this.override > 0 && gap_rad > THERE_RAD);
    this.events?.state(this.message, this.message.axes);
    // Silence ends EGM on the controller: the last word of an emergency stop, once the robot stands.
    if (!this.socket || (this.severed && this.moving === null)) return;
    // Who does not listen is not answered: an answer that is late would be the first target of a program that has just
    // begun to listen.
    if (because !== "") return;
    this.advance(Math.min(MOST_GAP_S, Math.max(0, dt_s)));
    this.answer.sequence = this.told = (this.told + 1) >>> 0;
    this.answer.time_ms = this.message.time_ms;
    this.socket.send(this.write(this.answer), from);
  }

  readonly hear = (lent: Uint8Array, from: Address): void => {
    if (from.host !== this.host) return;
    const last_ms = this.message.time_ms;
    if (readEgmRobot(lent, this.message) !== null) return;
    this.heard_s = this.scheduler.now_s();
    const dt_s = (this.message.time_ms - last_ms) / 1000;
    // Who moved the robot while nothing was heard is not known: it is not called back to where it was.
    if (!this.moving && !(dt_s <= MOST_GAP_S)) this.fresh = true;
    if (this.message.axes === this.n) this.take(from, dt_s);
    else this.events?.state(this.message, this.message.axes);
  };
}

function setpointStreamOf(guiding: Guide): SetpointStream {
  const guide: SetpointStream = {
    port: guiding.port,
    q_rad: guiding.q_rad,
    message: guiding.message,
    get heard_s() {
      return guiding.heard_s;
    },
    get isGoing() {
      return guiding.moving !== null;
    },
    get isMoving() {
      return guiding.isInMotion;
    },
    get override() {
      return guiding.override;
    },
    async open(to) {
      guide.close();
      const bound = await guiding.network.bind({
        host: guiding.options.local ?? (guiding.host.startsWith("127.") ? guiding.host : "0.0.0.0"),
        port: guiding.port,
      });
      if (bound.kind === "taken") return taken(bound.sentence);
      guiding.socket = bound.socket;
      guiding.events = to;
      guiding.severed = false;
      guiding.fresh = true;
      guiding.heard_s = -Infinity;
      guiding.socket.onDatagram(guiding.hear);
      return null;
    },
    close(why = linkClosed(guiding.robot)) {
      guiding.socket?.close();
      guiding.socket = guiding.events = null;
      guiding.isInMotion = false;
      guiding.settle({ kind: "stopped", why });
    },
    move(motion) {
      const because = notStreamedBecause(guiding.message);
      const why = !guiding.socket
        ? linkClosed(guiding.robot)
        : because !== ""
          ? notStreamed(guiding.robot, because)
          : null;
      if (why) return Promise.resolve({ kind: "refused", why });
      guiding.settle(stopped(wasStopped(guiding.robot)));
      return guiding.execute(
        resolve => ({
          stepper: new Stepper(guiding.robot, { tools: {}, frames: {} }, [stepOfMotion(motion)], guiding.target_rad),
          resolve,
          isSent: false,
        }),
        () => {
          /* The next message of the controller is answered with the first of its path. */
        },
      );
    },
    stop(emergency, why = wasStopped(guiding.robot)) {
      guiding.severed ||= emergency;
      if (!guiding.moving) return;
      guiding.ending ??= stopped(why);
      guiding.moving.stepper.stop(true);
    },
    setOverride(ratio) {
      guiding.override = ratio;
    },
    rearm() {
      guiding.severed = false;
    },
  };
  return guide;
}
