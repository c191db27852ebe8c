import { degrees, radians, Stepper, type CommandOutcome, type JointSample, type OperatingMode, type Pose, type Refusal, type Robot, type SafetyState, type Scheduler, type Step } from "@twincell/core";
import type { Face, FaceEvents, FaceMotion, Opened } from "../../real/index.ts";
import type { Address, DatagramSocket, Network } from "../../transport/index.ts";
import { COMM_TIMEOUT_S, EGM_PORT, EGM_STATE, MOTORS, egmSensorWriter, noEgmRobot, noEgmSensor, readEgmRobot } from "../codec/index.ts";
import { linkClosed, noDrives, noLines, nobody, notGuided, notGuidedBecause, otherAxes, taken, wasStopped } from "./words.ts";

export interface AbbFaceOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  /** Address of the controller: messages of others are not listened to. */
  readonly host: string;
  /** Where the controller sends to. */
  readonly ports?: { readonly egm: number };
  /** Where to listen. Left out: everywhere, or at the controller's own address when that is one of this machine, so that several virtual ones have a port each. */
  readonly local?: string;
  /** Part of the robot's own joint speeds that 100 % stands for. */
  readonly maxSpeed?: number;
  readonly stale_s?: number;
}

const STALE_S = 0.08, OPEN_S = 3, LOOK_S = 0.01;
/** A robot this near to the end of its path is there [rad]; the last of the way is first-order. */
const THERE_RAD = 0.0005 * Math.PI / 180;
/** A gap between two messages counts as at most so long: after a longer one the path goes on from where it was [s]. */
const MOST_GAP_S = 0.05;
const STILL_RAD_S = 1e-4, MOTION = "motion";

type Lent = { -readonly [K in keyof Omit<JointSample, "step">]: JointSample[K] };
interface Going { readonly stepper: Stepper; readonly resolve: (outcome: CommandOutcome) => void; isSent: boolean; stopping: Refusal | null }

/** Externally Guided Motion as a face: the path is made here and told cycle by cycle, in answer to each state that the controller sends. */
export function abbFace(options: AbbFaceOptions): Face {
  const { robot, scheduler, network, host } = options, n = robot.arm.joints.length, port = options.ports?.egm ?? EGM_PORT, maxSpeed = options.maxSpeed ?? 1;
  const message = noEgmRobot(), answer = noEgmSensor(), write = egmSensorWriter(), q_rad = Float64Array.from(robot.home_rad), before_rad = q_rad.slice(), target_rad = q_rad.slice(), next_rad = q_rad.slice();
  const sample: Lent = { sequence: 0, time_s: 0, q_rad, moving: false, mode: "remote", safety: "normal", override: 1, gripperClosed: false, message: "" };
  let socket: DatagramSocket | null = null, events: FaceEvents | null = null, going: Going | null = null, override = 1, severed = false, told = 0, first: ((axes: number) => void) | null = null;
  answer.axes = n;

  const end = (outcome: CommandOutcome): void => { const ended = going; going = null; ended?.resolve(outcome); };
  const modeOf = (): OperatingMode => message.motors === MOTORS.off || message.state === EGM_STATE.running ? "remote" : message.state === EGM_STATE.error ? "remote" : "manual";
  const safetyOf = (): SafetyState => severed || message.motors === MOTORS.off ? "emergency-stop" : message.state === EGM_STATE.error ? "protective-stop" : "normal";

  /** The next piece of the path, as long as the controller's own clock says. */
  function advance(dt_s: number): void {
    next_rad.set(target_rad);
    if (going && !going.isSent) {
      const state = going.stepper.advance(dt_s, override * maxSpeed, next_rad);
      if (state.kind === "fault" && state.fault) { end({ kind: "stopped", why: state.fault }); return; }
      if (state.kind !== "running") going.isSent = true;
    }
    for (let i = 0; i < n; i++) {
      answer.joints_deg[i] = degrees(next_rad[i]!);
      answer.speeds_deg_s[i] = dt_s > 0 ? degrees((next_rad[i]! - target_rad[i]!) / dt_s) : 0;
    }
    target_rad.set(next_rad);
  }

  function take(from: Address, dt_s: number): void {
    let fastest = 0, gap_rad = 0;
    for (let i = 0; i < n; i++) {
      before_rad[i] = q_rad[i]!;
      q_rad[i] = radians(message.joints_deg[i]!);
      if (dt_s > 0) fastest = Math.max(fastest, Math.abs(q_rad[i]! - before_rad[i]!) / dt_s);
      gap_rad = Math.max(gap_rad, Math.abs(target_rad[i]! - q_rad[i]!));
    }
    const because = notGuidedBecause(message);
    if (because !== "") {
      // The way is given up where the robot stands: nothing old is told when it listens again.
      target_rad.set(q_rad);
      end({ kind: "stopped", why: going?.stopping ?? notGuided(robot, because) });
    }
    if (going?.isSent && gap_rad <= THERE_RAD) end(going.stopping ? { kind: "stopped", why: going.stopping } : { kind: "done" });
    sample.sequence = message.sequence; sample.time_s = message.time_ms / 1000;
    sample.moving = fastest > STILL_RAD_S || (going !== null && !going.isSent && override > 0 && gap_rad > THERE_RAD);
    sample.mode = modeOf(); sample.safety = safetyOf(); sample.override = override; sample.message = because;
    events?.sample(sample);
    // Silence ends EGM on the controller: the last word of an emergency stop, once the robot stands.
    if (severed && going === null) return;
    advance(Math.min(MOST_GAP_S, Math.max(0, dt_s)));
    answer.sequence = told = (told + 1) >>> 0;
    answer.time_ms = message.time_ms;
    socket?.send(write(answer), from);
  }

  function hear(lent: Uint8Array, from: Address): void {
    if (from.host !== host) return;
    const last_ms = message.time_ms;
    if (readEgmRobot(lent, message) !== null) return;
    if (first) { first(message.axes); return; }
    if (message.axes === n) take(from, (message.time_ms - last_ms) / 1000);
  }

  function close(): void {
    socket?.close();
    socket = events = null;
    first?.(-1);
    end({ kind: "stopped", why: linkClosed(robot) });
  }

  return {
    brand: "ABB", robot, stale_s: options.stale_s ?? STALE_S, watchdog: { kind: "robot", within_s: COMM_TIMEOUT_S },
    async open(heard): Promise<Opened> {
      close();
      const bound = await network.bind({ host: options.local ?? (host.startsWith("127.") ? host : "0.0.0.0"), port });
      if (bound.kind === "taken") return { kind: "failed", why: taken(bound.sentence), again: true };
      const own = socket = bound.socket, from_s = scheduler.now_s();
      const axes = await new Promise<number>(resolve => {
        const stop = scheduler.every(LOOK_S, () => { if (scheduler.now_s() - from_s > OPEN_S) first?.(0); });
        first = got => { stop(); first = null; resolve(got); };
        own.onDatagram(hear);
      });
      if (axes !== n || socket !== own) {
        own.close();
        if (socket === own) socket = null;
        return { kind: "failed", why: axes > 0 ? otherAxes(robot, axes) : axes < 0 ? linkClosed(robot) : nobody(port, host), again: axes <= 0 };
      }
      for (let i = 0; i < n; i++) target_rad[i] = q_rad[i] = radians(message.joints_deg[i]!);
      severed = false;
      events = heard;
      return { kind: "open" };
    },
    close,
    move(motion) {
      const because = notGuidedBecause(message), why = !socket ? linkClosed(robot) : because !== "" ? notGuided(robot, because) : null;
      if (why) return Promise.resolve({ kind: "refused", why });
      return new Promise(resolve => {
        end({ kind: "stopped", why: wasStopped(robot) });
        going = { stepper: new Stepper(robot, { tools: {}, frames: {} }, [stepOf(motion)], target_rad), resolve, isSent: false, stopping: null };
      });
    },
    stop(emergency) {
      severed ||= emergency;
      if (!going) return;
      going.stopping ??= wasStopped(robot);
      going.stepper.stop(true);
    },
    setOverride(ratio) { override = ratio; return null; },
    async reset() {
      severed = false;
      // The controller's own answer: EGM runs again only when somebody started it there.
      await new Promise<void>(resolve => { const stop = scheduler.every(2 * MOST_GAP_S, () => { stop(); resolve(); }); });
      return notGuidedBecause(message) === "" ? { kind: "done" } : { kind: "refused", why: noDrives(robot) };
    },
    setSignal: () => noLines(),
    setGripper: () => noLines(),
  };
}

/** A motion as a step: the base is the world here, and the flange its tool. */
function stepOf(motion: FaceMotion): Step {
  const base = { id: MOTION, type: "move", blend_m: 0, acceleration: { ratio: motion.acceleration } } as const;
  const at = (baseFromFlange: Pose<"base", "flange">) => ({ pose: baseFromFlange as Pose as Pose<"frame", "tcp">, frame: "world", tool: "flange" });
  switch (motion.path) {
    case "joints": return { ...base, path: "ptp", target: { q: [...motion.q_rad] }, speed: { ratio: motion.ratio } };
    case "line": return { ...base, path: "lin", target: at(motion.baseFromFlange), speed: { mps: motion.speed_mps } };
    case "arc": return { ...base, path: "circ", target: at(motion.baseFromFlange), via: at(motion.baseFromVia), speed: { mps: motion.speed_mps } };
  }
}
