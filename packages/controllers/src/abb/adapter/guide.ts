import {
  axesOfJoints,
  jointsOfAxes,
  Stepper,
  type CommandOutcome,
  type Refusal,
  type Robot,
  type Scheduler,
} from "@twincell/core";
import { stepOfMotion, type AdapterMotion } from "../../driver/index.ts";
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
  stopping: Refusal | null;
}

/**
 * Externally Guided Motion: the path is made here and told cycle by cycle, in answer to each state that the controller
 * sends.
 */
export function createSetpointStream(options: SetpointStreamOptions): SetpointStream {
  const { robot, scheduler, network, host } = options;
  const n = robot.arm.joints.length;
  const port = options.ports?.egm ?? EGM_PORT;
  const maxSpeed = options.maxSpeed ?? 1;
  const message = noEgmRobot();
  const answer = noEgmSensor();
  const write = egmSensorWriter();
  const q_rad = Float64Array.from(robot.home_rad);
  const target_rad = q_rad.slice();
  const next_rad = q_rad.slice();
  const before_rad = q_rad.slice();
  const before_deg = q_rad.slice();
  const counting = abbAxes(robot);
  let socket: DatagramSocket | null = null;
  let events: SetpointStreamEvents | null = null;
  let going: Going | null = null;
  let override = 1;
  let severed = false;
  let told = 0;
  let heard_s = -Infinity;
  let fresh = true;
  let moving = false;
  answer.axes = n;

  const end = (outcome: CommandOutcome): void => {
    const ended = going;
    going = null;
    ended?.resolve(outcome);
  };

  /** The next piece of the path, as long as the controller's own clock says. */
  function advance(dt_s: number): void {
    next_rad.set(target_rad);
    if (going && !going.isSent) {
      const state = going.stepper.advance(dt_s, override * maxSpeed, next_rad);
      if (state.kind === "fault" && state.fault) {
        end({ kind: "stopped", why: state.fault });
        return;
      }
      if (state.kind !== "running") going.isSent = true;
    }
    axesOfJoints(counting, target_rad, before_deg);
    axesOfJoints(counting, next_rad, answer.joints_deg);
    for (let i = 0; i < n; i++) answer.speeds_deg_s[i] = dt_s > 0 ? (answer.joints_deg[i]! - before_deg[i]!) / dt_s : 0;
    target_rad.set(next_rad);
  }

  function take(from: Address, dt_s: number): void {
    let fastest = 0;
    let gap_rad = 0;
    before_rad.set(q_rad);
    jointsOfAxes(counting, message.joints_deg, q_rad);
    for (let i = 0; i < n; i++) {
      const before = before_rad[i]!;
      if (fresh) target_rad[i] = q_rad[i]!;
      else if (dt_s > 0) fastest = Math.max(fastest, Math.abs(q_rad[i]! - before) / dt_s);
      gap_rad = Math.max(gap_rad, Math.abs(target_rad[i]! - q_rad[i]!));
    }
    // Somebody else moves it, or it still brakes from what moved it before.
    if (!going && !fresh && fastest > DRIVEN_RAD_S) {
      target_rad.set(q_rad);
      gap_rad = 0;
    }
    fresh = false;
    const because = notStreamedBecause(message);
    if (because !== "") {
      // The way is given up where the robot stands: nothing old is told when it listens again.
      target_rad.set(q_rad);
      gap_rad = 0;
      if (going) going.stopping ??= notStreamed(robot, because);
      if (fastest <= STILL_RAD_S) end({ kind: "stopped", why: going?.stopping ?? notStreamed(robot, because) });
    }
    if (because === "" && going?.isSent && gap_rad <= THERE_RAD)
      end(going.stopping ? { kind: "stopped", why: going.stopping } : { kind: "done" });
    moving = fastest > STILL_RAD_S || (going !== null && !going.isSent && override > 0 && gap_rad > THERE_RAD);
    events?.state(message, message.axes);
    // Silence ends EGM on the controller: the last word of an emergency stop, once the robot stands.
    if (!socket || (severed && going === null)) return;
    // Who does not listen is not answered: an answer that is late would be the first target of a program that has just
    // begun to listen.
    if (because !== "") return;
    advance(Math.min(MOST_GAP_S, Math.max(0, dt_s)));
    answer.sequence = told = (told + 1) >>> 0;
    answer.time_ms = message.time_ms;
    socket.send(write(answer), from);
  }

  function hear(lent: Uint8Array, from: Address): void {
    if (from.host !== host) return;
    const last_ms = message.time_ms;
    if (readEgmRobot(lent, message) !== null) return;
    heard_s = scheduler.now_s();
    const dt_s = (message.time_ms - last_ms) / 1000;
    // Who moved the robot while nothing was heard is not known: it is not called back to where it was.
    if (!going && !(dt_s <= MOST_GAP_S)) fresh = true;
    if (message.axes === n) take(from, dt_s);
    else events?.state(message, message.axes);
  }

  const guide: SetpointStream = {
    port,
    q_rad,
    message,
    get heard_s() {
      return heard_s;
    },
    get isGoing() {
      return going !== null;
    },
    get isMoving() {
      return moving;
    },
    get override() {
      return override;
    },
    async open(to) {
      guide.close();
      const bound = await network.bind({ host: options.local ?? (host.startsWith("127.") ? host : "0.0.0.0"), port });
      if (bound.kind === "taken") return taken(bound.sentence);
      socket = bound.socket;
      events = to;
      severed = false;
      fresh = true;
      heard_s = -Infinity;
      socket.onDatagram(hear);
      return null;
    },
    close(why = linkClosed(robot)) {
      socket?.close();
      socket = events = null;
      moving = false;
      end({ kind: "stopped", why });
    },
    move(motion) {
      const because = notStreamedBecause(message);
      const why = !socket ? linkClosed(robot) : because !== "" ? notStreamed(robot, because) : null;
      if (why) return Promise.resolve({ kind: "refused", why });
      return new Promise(resolve => {
        end({ kind: "stopped", why: wasStopped(robot) });
        going = {
          stepper: new Stepper(robot, { tools: {}, frames: {} }, [stepOfMotion(motion)], target_rad),
          resolve,
          isSent: false,
          stopping: null,
        };
      });
    },
    stop(emergency, why = wasStopped(robot)) {
      severed ||= emergency;
      if (!going) return;
      going.stopping ??= why;
      going.stepper.stop(true);
    },
    setOverride(ratio) {
      override = ratio;
    },
    rearm() {
      severed = false;
    },
  };
  return guide;
}
