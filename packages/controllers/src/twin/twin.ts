import type { CommandOutcome, JointSample, Refusal, RobotController, Scheduler, Robot } from "@twincell/core";
import { listeners } from "../listeners.ts";
import { drivesOff, guardOpen, manualMode, protective } from "../refusals.ts";

/**
 * What shows the real robot: a drawing, a virtual robot, memory. It is written to and read back, so that the two can be
 * compared.
 */
export interface Mirror {
  /** `lent` is only valid during the call. */
  show(lent: JointSample): void;
  /** The joint angles shown now [rad]. */
  read(out: Float64Array): Float64Array;
}

export interface TwinLogEntry {
  /** "command": sent to the real robot. "pose": the mirror's angles changed, for the first time after a command. */
  readonly what: "command" | "pose";
  readonly at_s: number;
  readonly says: string;
}

/** Largest differences of any joint so far [rad]; row T-23 wants both within 0.001°. */
export interface TwinAccuracy {
  /** Between the real robot's sample and what the mirror then showed. */
  readonly mirror_rad: number;
  /** Between commanded angles and those measured when the command was done. */
  readonly command_rad: number;
}

export interface TwinOptions {
  /** The robot that is commanded; it stays its maker's to close. */
  readonly real: RobotController;
  readonly scheduler: Scheduler;
  readonly mirror?: Mirror;
  readonly name?: string;
}
export interface Twin extends RobotController {
  readonly kind: "twin";
  readonly accuracy: TwinAccuracy;
  /** The latest entries, oldest first. */
  readonly log: readonly TwinLogEntry[];
  /** Forgets log and accuracy, at the start of a run. */
  clearLog(): void;
}

const LOG_LENGTH = 200;

/**
 * A real robot and its mirror as one controller. Commands go to the real one; the mirror follows at the next sample
 * (row T-25). Whatever moves the real robot (a pendant, a sensor) shows in the mirror; while the pendant or a stop has
 * the robot, commands from here are refused with the reason (rows T-26, T-27).
 */
export function createTwin(options: TwinOptions): Twin {
  return twinOf(new TwinState(options));
}

class TwinState {
  readonly options: TwinOptions;
  readonly real: RobotController;
  readonly scheduler: Scheduler;
  readonly robot: Robot;
  readonly n: number;
  readonly mirror: Mirror;
  readonly samples = listeners<JointSample>();
  readonly log: TwinLogEntry[] = [];
  readonly shown_rad: Float64Array;
  readonly before_rad: Float64Array;
  mirror_rad = 0;
  command_rad = 0;
  awaiting = "";
  mode: JointSample["mode"] | null = null;
  safety: JointSample["safety"] = "normal";
  message = "";
  readonly lent: { -readonly [K in keyof JointSample]: JointSample[K] };
  readonly unsubscribe: () => void;

  constructor(options: TwinOptions) {
    this.options = options;
    this.real = this.options.real;
    this.scheduler = this.options.scheduler;
    this.robot = this.real.robot;
    this.n = this.robot.arm.joints.length;
    this.mirror = this.options.mirror ?? memoryMirror(this.real);
    this.shown_rad = this.mirror.read(new Float64Array(this.n));
    this.before_rad = new Float64Array(this.n);
    this.lent = {
      sequence: 0,
      time_s: 0,
      q_rad: this.shown_rad,
      moving: false,
      mode: "automatic",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      step: "",
      message: "",
    };
    this.unsubscribe = this.real.onSample(sample => {
      ({ mode: this.mode, safety: this.safety, message: this.message } = sample);
      this.before_rad.set(this.shown_rad);
      this.mirror.show(sample);
      this.mirror.read(this.shown_rad);
      this.mirror_rad = Math.max(this.mirror_rad, largest(this.shown_rad, sample.q_rad));
      if (this.awaiting !== "" && largest(this.shown_rad, this.before_rad) > 0) {
        this.note("pose", this.awaiting);
        this.awaiting = "";
      }
      Object.assign(this.lent, sample, { q_rad: this.shown_rad });
      this.samples.call(this.lent);
    });
  }

  note(what: TwinLogEntry["what"], says: string): void {
    this.log.push({ what, at_s: this.scheduler.now_s(), says });
    if (this.log.length > LOG_LENGTH) this.log.shift();
  }

  /** Why the studio may not command now; the real robot is not even asked. */
  held(): Refusal | null {
    if (this.safety === "emergency-stop") return drivesOff(this.robot);
    if (this.safety === "protective-stop") return protective(this.message);
    if (this.safety === "guard-stop") return guardOpen(this.robot);
    return this.mode === "manual" ? manualMode(this.robot) : null;
  }

  /** Real first: the mirror is not touched here. */
  async command(
    says: string,
    send: () => Promise<CommandOutcome>,
    targets: (measured_rad: Float64Array) => Float64Array | null,
  ): Promise<CommandOutcome> {
    const why = this.held();
    if (why) return { kind: "refused", why };
    this.note("command", says);
    this.awaiting = says;
    const outcome = await send();
    if (outcome.kind === "done") {
      const measured_rad = this.real.jointAngles();
      const wanted_rad = targets(measured_rad);
      if (wanted_rad) this.command_rad = Math.max(this.command_rad, largest(measured_rad, wanted_rad));
    }
    return outcome;
  }
}

function twinOf(own: TwinState): Twin {
  return {
    kind: "twin",
    name: own.options.name ?? `Twin of ${own.real.name}`,
    robot: own.robot,
    log: own.log,
    ...(own.real.signals === undefined ? {} : { signals: own.real.signals }),
    get accuracy() {
      return { mirror_rad: own.mirror_rad, command_rad: own.command_rad };
    },
    clearLog() {
      own.log.length = 0;
      own.mirror_rad = 0;
      own.command_rad = 0;
      own.awaiting = "";
    },
    onSample: listen => own.samples.add(listen),
    close() {
      own.unsubscribe();
      own.samples.clear();
    },
    isMoving: () => own.real.isMoving(),
    setSpeed(percent) {
      const why = own.mode === "manual" ? manualMode(own.robot) : null;
      return why ? { kind: "refused", why } : own.real.setSpeed(percent);
    },
    jointAngle: joint => own.shown_rad[joint - 1] ?? NaN,
    jointAngles(out = new Float64Array(own.n)) {
      out.set(own.shown_rad);
      return out;
    },
    moveJoint: (joint, angle_rad) =>
      own.command(
        `move joint ${joint}`,
        () => own.real.moveJoint(joint, angle_rad),
        measured_rad => {
          const wanted_rad = Float64Array.from(measured_rad);
          wanted_rad[joint - 1] = angle_rad;
          return wanted_rad;
        },
      ),
    moveJoints(q_rad) {
      const wanted_rad = Float64Array.from(q_rad);
      return own.command(
        "move joints",
        () => own.real.moveJoints(wanted_rad),
        () => wanted_rad,
      );
    },
    moveToPose: baseFromFlange =>
      own.command(
        "move to pose",
        () => own.real.moveToPose(baseFromFlange),
        () => null,
      ),
    moveToZero: () =>
      own.command(
        "move to zero",
        () => own.real.moveToZero(),
        () => new Float64Array(own.n),
      ),
    run: (steps, context) =>
      own.command(
        "run",
        () => own.real.run(steps, context),
        () => null,
      ),
    cannotCarryOut: step => own.real.cannotCarryOut(step),
    stop(emergency = false) {
      own.note("command", emergency ? "emergency stop" : "stop");
      own.real.stop(emergency);
    },
    reset: () => own.real.reset(),
  };
}

const largest = (a_rad: ArrayLike<number>, b_rad: ArrayLike<number>): number => {
  let most = 0;
  for (let i = 0; i < a_rad.length; i++) most = Math.max(most, Math.abs(a_rad[i]! - b_rad[i]!));
  return most;
};

function memoryMirror(real: RobotController): Mirror {
  const q_rad = real.jointAngles();
  return {
    show(sample) {
      q_rad.set(sample.q_rad);
    },
    read(out) {
      out.set(q_rad);
      return out;
    },
  };
}
