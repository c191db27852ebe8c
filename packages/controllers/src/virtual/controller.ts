import {
  explainReach,
  hardBrakingTime_s,
  SignalTable,
  solveAll,
  Stepper,
  type StepperState,
  type CommandOutcome,
  type JointSample,
  type OperatingMode,
  type Pose,
  type Program,
  type Reach,
  type Refusal,
  type Robot,
  type RobotController,
  type SafetyState,
  type Scheduler,
  type Signals,
  type Step,
} from "@twincell/core";
import { listeners } from "../listeners.ts";
import {
  busy,
  closed,
  drivesOff,
  guardOpen,
  guardStillOpen,
  jointNumberRefusal,
  jointRefusal,
  manualMode,
  percentRefusal,
  programFault,
  protective,
  stillBraking,
  stopped,
} from "../refusals.ts";
import { DONE, refused } from "../outcomes.ts";

export interface VirtualOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly name?: string;
  /** One sample, and one step of motion, every so often. */
  readonly cycle_s?: number;
  /** Part of the robot's own joint speeds that 100 % stands for, 0 … 1 (row T-17). */
  readonly maxSpeed?: number;
  readonly start_rad?: ArrayLike<number>;
  readonly mode?: OperatingMode;
  /** Where the robot stands in the cell; frames of a program are seen from the world. */
  readonly worldFromBase?: Pose<"world", "base">;
  /**
   * Finds joint angles for a pose: core's own when left out; with null `moveToPose` is refused and joint moves still
   * work (row T-67).
   */
  readonly solve?: Solve | null;
  /** Called once, before the first sample (row T-11). */
  readonly initialize?: () => void;
  /** Called with the target of every joint motion: the one primitive behind all moves (row T-12). */
  readonly onMotion?: (q_rad: ArrayLike<number>) => void;
}

export type Solve = (baseFromFlange: Pose<"base", "flange">, near_rad: Float64Array) => Reach;

/** What a person does at the robot itself: mode switch, teach pendant, guard, and what the drives do on their own. */
export interface AtTheRobot {
  /** The key that clears a stop. */
  reset(): CommandOutcome;
  setMode(mode: OperatingMode): void;
  /** A joint move commanded at the pendant, at that share of the joint speeds; works in manual mode only. */
  jog(q_rad: ArrayLike<number>, ratio?: number): Promise<CommandOutcome>;
  setOverride(percent: number): CommandOutcome;
  /** A proximity sensor or a gate: true stops, false allows motion again but starts none (row T-27). */
  setGuardOpen(open: boolean): void;
  /** The robot stops by itself and stays so until reset. */
  protectiveStop(because: string): void;
  /** What is connected to an input: a sensor, a button, another machine. */
  setInput(signal: string, value: boolean | number): void;
}

export interface VirtualController extends RobotController {
  readonly kind: "virtual";
  readonly signals: Signals;
  readonly jumpTo: (q_rad: ArrayLike<number>) => CommandOutcome;
  readonly atTheRobot: AtTheRobot;
  /** Longest time from the command to stop until standstill. */
  readonly brakingTime_s: number;
}

interface Command {
  readonly stepper: Stepper;
  readonly resolve: (outcome: CommandOutcome) => void;
  stopping: Refusal | null;
  begun: boolean;
  moving: boolean;
  step: string;
}
type Lent = { -readonly [K in keyof JointSample]: JointSample[K] };

/** A page in the background gets few ticks: at most this much time is caught up in one. */
const CATCH_UP_S = 1;

/** A robot made of numbers, with a controller's habits: modes, override, limits, stops, samples in its own cycle. */
export function createVirtualController(options: VirtualOptions): VirtualController {
  return virtualControllerOf(new VirtualArm(options));
}

class VirtualArm {
  readonly options: VirtualOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly cycle_s: number;
  readonly maxSpeed: number;
  readonly solve: Solve | null;
  readonly name: string;
  readonly n: number;
  // The slowest joint from full speed to rest, and the cycles in which the command comes through.
  readonly brakingTime_s: number;
  readonly q_rad: Float64Array;
  readonly samples = listeners<JointSample>();
  readonly signals = new SignalTable();
  readonly lent: Lent;
  mode: OperatingMode;
  safety: SafetyState = "normal";
  override = 1;
  gripperClosed = false;
  message = "";
  guardIsOpen = false;
  why: Refusal | null = null;
  command: Command | null = null;
  cycles = 0;
  skipped = 0;
  isClosed = false;
  readonly begun_s: number;
  readonly stopCycle: () => void;

  constructor(options: VirtualOptions) {
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.cycle_s = this.options.cycle_s ?? 0.004;
    this.maxSpeed = this.options.maxSpeed ?? 1;
    this.solve =
      this.options.solve === undefined ? (pose, near) => solveAll(this.robot, pose, { near }) : this.options.solve;
    this.name = this.options.name ?? `Virtual ${this.robot.name}`;
    this.n = this.robot.arm.joints.length;
    this.brakingTime_s = hardBrakingTime_s(this.robot) + 2 * this.cycle_s;
    this.q_rad = Float64Array.from(this.options.start_rad ?? this.robot.home_rad);
    this.lent = {
      sequence: 0,
      time_s: 0,
      q_rad: new Float64Array(this.n),
      moving: false,
      mode: this.options.mode ?? "automatic",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      step: "",
      message: "",
      signals: this.signals.all,
    };
    this.mode = this.lent.mode;
    this.begun_s = this.scheduler.now_s();
    this.options.initialize?.();
    this.stopCycle = this.scheduler.every(this.cycle_s, () => {
      const due = Math.floor((this.scheduler.now_s() - this.begun_s) / this.cycle_s + 1e-6) - this.skipped;
      const late = due - this.cycles - Math.ceil(CATCH_UP_S / this.cycle_s);
      if (late > 0) this.skipped += late;
      const until = due - Math.max(0, late);
      while (this.cycles < until && !this.isClosed) this.cycle();
    });
  }

  readonly isMoving = (): boolean =>
    this.command !== null && (this.command.begun ? this.command.moving : this.override > 0);

  finish(outcome: CommandOutcome): void {
    const ended = this.command;
    this.command = null;
    if (outcome.kind !== "done") this.message = outcome.why.sentence;
    ended?.resolve(outcome);
  }

  /** One cycle of motion; what ended with it, if anything did. */
  move(at: Command): CommandOutcome | null {
    const { begun } = at;
    let state: StepperState;
    try {
      state = at.stepper.advance(this.cycle_s, this.override * this.maxSpeed, this.q_rad);
    } catch (reason) {
      // Steps may come from a running program text, and that may fault: the program ends, the robot goes on being a
      // robot.
      return { kind: "stopped", why: programFault(reason) };
    }
    this.gripperClosed = state.gripperClosed;
    if (state.message !== "") this.message = state.message;
    at.begun = true;
    at.moving = state.moving;
    at.step = state.step;
    if (state.kind === "running") return null;
    if (state.kind === "fault" && state.fault) return { kind: begun ? "stopped" : "refused", why: state.fault };
    return at.stopping ? { kind: "stopped", why: at.stopping } : DONE;
  }

  cycle(): void {
    this.cycles++;
    const outcome = this.command && this.move(this.command);
    if (outcome) this.finish(outcome);
    this.lent.sequence = this.cycles;
    this.lent.time_s = (this.cycles + this.skipped) * this.cycle_s;
    this.lent.q_rad.set(this.q_rad);
    this.lent.moving = this.isMoving();
    this.lent.mode = this.mode;
    this.lent.safety = this.safety;
    this.lent.override = this.override;
    this.lent.gripperClosed = this.gripperClosed;
    this.lent.message = this.message;
    this.lent.step = this.command?.step ?? "";
    this.samples.call(this.lent);
  }

  unfit(): Refusal | null {
    return this.isClosed
      ? closed(this.name)
      : this.safety !== "normal"
        ? this.why
        : this.command
          ? busy(this.robot)
          : null;
  }

  readonly notNow = (): Refusal | null =>
    !this.isClosed && this.safety === "normal" && this.mode === "manual" ? manualMode(this.robot) : this.unfit();

  refuse(reason: Refusal): CommandOutcome {
    this.message = reason.sentence;
    return refused(reason);
  }

  /** A stop cleared, by a command or by the key at the robot itself. */
  readonly resetHere = (): CommandOutcome => {
    if (this.isClosed) return refused(closed(this.name));
    if (this.command) return this.refuse(stillBraking(this.robot));
    if (this.guardIsOpen) return this.refuse(guardStillOpen(this.robot));
    this.safety = "normal";
    this.why = null;
    this.message = "";
    return DONE;
  };

  /** Carries out steps from standstill. Everything that moves the virtual robot goes through here. */
  start(steps: Iterator<Step>, context: Pick<Program, "tools" | "frames">): Promise<CommandOutcome> {
    this.message = "";
    const plan = this.options.worldFromBase ? { ...context, worldFromBase: this.options.worldFromBase } : context;
    const stepper = new Stepper(this.robot, plan, steps, this.q_rad, {
      gripperClosed: this.gripperClosed,
      signals: this.signals,
    });
    return new Promise(resolve => {
      this.command = { stepper, resolve, stopping: null, begun: false, moving: false, step: "" };
    });
  }

  /** The one motion primitive (rows T-12, T-13): joint targets, checked, then carried out over many cycles. */
  async moveRobotJoints(
    target_rad: ArrayLike<number>,
    fit: () => Refusal | null = this.notNow,
    ratio = 1,
  ): Promise<CommandOutcome> {
    const reason = fit() ?? jointRefusal(this.robot, target_rad);
    if (reason) return this.refuse(reason);
    this.options.onMotion?.(target_rad);
    const step: Step = {
      id: "",
      type: "move",
      path: "ptp",
      target: { q: Array.from(target_rad) },
      speed: { ratio },
      blend_m: 0,
    };
    return this.start([step][Symbol.iterator](), { tools: {}, frames: {} });
  }

  brake(state: SafetyState, reason: Refusal): void {
    if (state !== "normal") {
      this.safety = state;
      this.why = reason;
    }
    this.message = reason.sentence;
    if (this.command && !this.command.stopping) {
      this.command.stopping = reason;
      this.command.stepper.stop(true);
    }
    // Held where it stands there is nothing to brake, now or when the override comes back.
    if (this.command && this.command.begun && !this.command.moving && this.override === 0)
      this.finish({ kind: "stopped", why: reason });
  }
}

function virtualControllerOf(arm: VirtualArm): VirtualController {
  return {
    kind: "virtual",
    name: arm.name,
    robot: arm.robot,
    brakingTime_s: arm.brakingTime_s,
    signals: arm.signals,
    onSample: listen => arm.samples.add(listen),
    close() {
      if (arm.isClosed) return;
      arm.isClosed = true;
      arm.stopCycle();
      if (arm.command) arm.finish({ kind: "stopped", why: closed(arm.name) });
      arm.samples.clear();
    },
    isMoving: arm.isMoving,
    setSpeed(percent) {
      const reason = percentRefusal(percent);
      if (reason) return arm.refuse(reason);
      arm.override = percent / 100;
      return DONE;
    },
    jointAngle: joint => arm.q_rad[joint - 1] ?? NaN,
    jointAngles(out = new Float64Array(arm.n)) {
      out.set(arm.q_rad);
      return out;
    },
    async moveJoint(joint, angle_rad) {
      const reason = jointNumberRefusal(arm.robot, joint);
      if (reason) return arm.refuse(reason);
      const target = Float64Array.from(arm.q_rad);
      target[joint - 1] = angle_rad;
      return arm.moveRobotJoints(target);
    },
    moveJoints: target_rad => arm.moveRobotJoints(target_rad),
    moveToZero: () => arm.moveRobotJoints(new Float64Array(arm.n)),
    cannotCarryOut: () => null,
    async moveToPose(baseFromFlange) {
      if (!arm.solve) {
        return arm.refuse({
          code: "controller.no-solver",
          sentence: `${arm.name} has no solver for poses.`,
          hint: "Attach one, or command joint angles.",
        });
      }
      const reach = arm.solve(baseFromFlange, arm.q_rad);
      const nearest = reach.kind === "reached" ? reach.solutions[0] : undefined;
      if (!nearest)
        return arm.refuse({
          code: `reach.${reach.kind}`,
          sentence: explainReach(reach),
          hint: "Choose a pose within reach.",
        });
      return arm.moveRobotJoints(nearest.q_rad);
    },
    async run(steps, context) {
      const reason = arm.notNow();
      return reason ? arm.refuse(reason) : arm.start(steps[Symbol.iterator](), context);
    },
    stop(emergency = false) {
      if (emergency) arm.brake("emergency-stop", drivesOff(arm.robot));
      else arm.brake("normal", stopped("controller.stopped", `${arm.robot.name} was stopped.`));
    },
    reset: () => Promise.resolve(arm.resetHere()),
    jumpTo(target_rad) {
      const reason = arm.unfit() ?? jointRefusal(arm.robot, target_rad);
      if (reason) return arm.refuse(reason);
      arm.q_rad.set(Float64Array.from(target_rad));
      return DONE;
    },
    atTheRobot: atTheRobotOf(arm),
  };
}

function atTheRobotOf(arm: VirtualArm): AtTheRobot {
  return {
    reset: arm.resetHere,
    setMode(to) {
      if (to === arm.mode) return;
      arm.mode = to;
      arm.brake("normal", stopped("controller.mode-changed", `${arm.robot.name} was switched to ${to} mode.`));
    },
    jog: (target_rad, ratio = 1) =>
      arm.moveRobotJoints(
        target_rad,
        () =>
          arm.mode === "manual"
            ? arm.unfit()
            : {
                code: "controller.not-manual",
                sentence: `${arm.robot.name} is in ${arm.mode} mode; its pendant jogs in manual mode only.`,
                hint: "Turn the mode switch to manual.",
              },
        ratio,
      ),
    setOverride(percent) {
      const reason = percentRefusal(percent);
      if (reason) return arm.refuse(reason);
      arm.override = percent / 100;
      return DONE;
    },
    setGuardOpen(open) {
      arm.guardIsOpen = open;
      if (open && arm.safety === "normal") arm.brake("guard-stop", guardOpen(arm.robot));
      if (!open && arm.safety === "guard-stop") {
        arm.safety = "normal";
        arm.why = null;
        arm.message = "";
      }
    },
    setInput(signal, value) {
      arm.signals.write(signal, value);
    },
    protectiveStop(because) {
      if (arm.safety !== "emergency-stop") arm.brake("protective-stop", protective(because));
    },
  };
}
