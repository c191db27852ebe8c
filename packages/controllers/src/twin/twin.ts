import type { CommandOutcome, JointSample, Refusal, RobotController, Scheduler } from "@twincell/core";
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
  const { real, scheduler } = options;
  const { robot } = real;
  const n = robot.arm.joints.length;
  const mirror = options.mirror ?? memoryMirror(real);
  const samples = listeners<JointSample>();
  const log: TwinLogEntry[] = [];
  const shown_rad = mirror.read(new Float64Array(n));
  const before_rad = new Float64Array(n);
  let mirror_rad = 0;
  let command_rad = 0;
  let awaiting = "";
  let mode: JointSample["mode"] | null = null;
  let safety: JointSample["safety"] = "normal";
  let message = "";

  const note = (what: TwinLogEntry["what"], says: string): void => {
    log.push({ what, at_s: scheduler.now_s(), says });
    if (log.length > LOG_LENGTH) log.shift();
  };

  const lent: { -readonly [K in keyof JointSample]: JointSample[K] } = {
    sequence: 0,
    time_s: 0,
    q_rad: shown_rad,
    moving: false,
    mode: "automatic",
    safety: "normal",
    override: 1,
    gripperClosed: false,
    step: "",
    message: "",
  };
  const unsubscribe = real.onSample(sample => {
    ({ mode, safety, message } = sample);
    before_rad.set(shown_rad);
    mirror.show(sample);
    mirror.read(shown_rad);
    mirror_rad = Math.max(mirror_rad, largest(shown_rad, sample.q_rad));
    if (awaiting !== "" && largest(shown_rad, before_rad) > 0) {
      note("pose", awaiting);
      awaiting = "";
    }
    Object.assign(lent, sample, { q_rad: shown_rad });
    samples.call(lent);
  });

  /** Why the studio may not command now; the real robot is not even asked. */
  function held(): Refusal | null {
    if (safety === "emergency-stop") return drivesOff(robot);
    if (safety === "protective-stop") return protective(message);
    if (safety === "guard-stop") return guardOpen(robot);
    return mode === "manual" ? manualMode(robot) : null;
  }

  /** Real first: the mirror is not touched here. */
  async function command(
    says: string,
    send: () => Promise<CommandOutcome>,
    targets: (measured_rad: Float64Array) => Float64Array | null,
  ): Promise<CommandOutcome> {
    const why = held();
    if (why) return { kind: "refused", why };
    note("command", says);
    awaiting = says;
    const outcome = await send();
    if (outcome.kind === "done") {
      const measured_rad = real.jointAngles();
      const wanted_rad = targets(measured_rad);
      if (wanted_rad) command_rad = Math.max(command_rad, largest(measured_rad, wanted_rad));
    }
    return outcome;
  }

  return {
    kind: "twin",
    name: options.name ?? `Twin of ${real.name}`,
    robot,
    log,
    ...(real.signals === undefined ? {} : { signals: real.signals }),
    get accuracy() {
      return { mirror_rad, command_rad };
    },
    clearLog() {
      log.length = 0;
      mirror_rad = 0;
      command_rad = 0;
      awaiting = "";
    },
    onSample: listen => samples.add(listen),
    close() {
      unsubscribe();
      samples.clear();
    },
    isMoving: () => real.isMoving(),
    setSpeed(percent) {
      const why = mode === "manual" ? manualMode(robot) : null;
      return why ? { kind: "refused", why } : real.setSpeed(percent);
    },
    jointAngle: joint => shown_rad[joint - 1] ?? NaN,
    jointAngles(out = new Float64Array(n)) {
      out.set(shown_rad);
      return out;
    },
    moveJoint: (joint, angle_rad) =>
      command(
        `move joint ${joint}`,
        () => real.moveJoint(joint, angle_rad),
        measured_rad => {
          const wanted_rad = Float64Array.from(measured_rad);
          wanted_rad[joint - 1] = angle_rad;
          return wanted_rad;
        },
      ),
    moveJoints(q_rad) {
      const wanted_rad = Float64Array.from(q_rad);
      return command(
        "move joints",
        () => real.moveJoints(wanted_rad),
        () => wanted_rad,
      );
    },
    moveToPose: baseFromFlange =>
      command(
        "move to pose",
        () => real.moveToPose(baseFromFlange),
        () => null,
      ),
    moveToZero: () =>
      command(
        "move to zero",
        () => real.moveToZero(),
        () => new Float64Array(n),
      ),
    run: (steps, context) =>
      command(
        "run",
        () => real.run(steps, context),
        () => null,
      ),
    cannotCarryOut: step => real.cannotCarryOut(step),
    stop(emergency = false) {
      note("command", emergency ? "emergency stop" : "stop");
      real.stop(emergency);
    },
    reset: () => real.reset(),
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
