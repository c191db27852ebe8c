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
  const { robot, scheduler } = options;
  const cycle_s = options.cycle_s ?? 0.004;
  const maxSpeed = options.maxSpeed ?? 1;
  const solve: Solve | null =
    options.solve === undefined ? (pose, near) => solveAll(robot, pose, { near }) : options.solve;
  const name = options.name ?? `Virtual ${robot.name}`;
  const n = robot.arm.joints.length;
  // The slowest joint from full speed to rest, and the cycles in which the command comes through.
  const brakingTime_s = hardBrakingTime_s(robot) + 2 * cycle_s;
  const q_rad = Float64Array.from(options.start_rad ?? robot.home_rad);
  const samples = listeners<JointSample>();
  const signals = new SignalTable();
  const lent: Lent = {
    sequence: 0,
    time_s: 0,
    q_rad: new Float64Array(n),
    moving: false,
    mode: options.mode ?? "automatic",
    safety: "normal",
    override: 1,
    gripperClosed: false,
    step: "",
    message: "",
    signals: signals.all,
  };
  let mode: OperatingMode = lent.mode;
  let safety: SafetyState = "normal";
  let override = 1;
  let gripperClosed = false;
  let message = "";
  let guardIsOpen = false;
  let why: Refusal | null = null;
  let command: Command | null = null;
  let cycles = 0;
  let skipped = 0;
  let isClosed = false;
  const begun_s = scheduler.now_s();

  const isMoving = (): boolean => command !== null && (command.begun ? command.moving : override > 0);

  function finish(outcome: CommandOutcome): void {
    const ended = command;
    command = null;
    if (outcome.kind !== "done") message = outcome.why.sentence;
    ended?.resolve(outcome);
  }

  /** One cycle of motion; what ended with it, if anything did. */
  function move(at: Command): CommandOutcome | null {
    const { begun } = at;
    let state: StepperState;
    try {
      state = at.stepper.advance(cycle_s, override * maxSpeed, q_rad);
    } catch (reason) {
      // Steps may come from a running program text, and that may fault: the program ends, the robot goes on being a
      // robot.
      return { kind: "stopped", why: programFault(reason) };
    }
    gripperClosed = state.gripperClosed;
    if (state.message !== "") message = state.message;
    at.begun = true;
    at.moving = state.moving;
    at.step = state.step;
    if (state.kind === "running") return null;
    if (state.kind === "fault" && state.fault) return { kind: begun ? "stopped" : "refused", why: state.fault };
    return at.stopping ? { kind: "stopped", why: at.stopping } : DONE;
  }

  function cycle(): void {
    cycles++;
    const outcome = command && move(command);
    if (outcome) finish(outcome);
    lent.sequence = cycles;
    lent.time_s = (cycles + skipped) * cycle_s;
    lent.q_rad.set(q_rad);
    lent.moving = isMoving();
    lent.mode = mode;
    lent.safety = safety;
    lent.override = override;
    lent.gripperClosed = gripperClosed;
    lent.message = message;
    lent.step = command?.step ?? "";
    samples.call(lent);
  }

  options.initialize?.();
  const stopCycle = scheduler.every(cycle_s, () => {
    const due = Math.floor((scheduler.now_s() - begun_s) / cycle_s + 1e-6) - skipped;
    const late = due - cycles - Math.ceil(CATCH_UP_S / cycle_s);
    if (late > 0) skipped += late;
    const until = due - Math.max(0, late);
    while (cycles < until && !isClosed) cycle();
  });

  const unfit = (): Refusal | null =>
    isClosed ? closed(name) : safety !== "normal" ? why : command ? busy(robot) : null;
  const notNow = (): Refusal | null =>
    !isClosed && safety === "normal" && mode === "manual" ? manualMode(robot) : unfit();

  function refuse(reason: Refusal): CommandOutcome {
    message = reason.sentence;
    return refused(reason);
  }

  /** A stop cleared, by a command or by the key at the robot itself. */
  function resetHere(): CommandOutcome {
    if (isClosed) return refused(closed(name));
    if (command) return refuse(stillBraking(robot));
    if (guardIsOpen) return refuse(guardStillOpen(robot));
    safety = "normal";
    why = null;
    message = "";
    return DONE;
  }

  /** Carries out steps from standstill. Everything that moves the virtual robot goes through here. */
  function start(steps: Iterator<Step>, context: Pick<Program, "tools" | "frames">): Promise<CommandOutcome> {
    message = "";
    const plan = options.worldFromBase ? { ...context, worldFromBase: options.worldFromBase } : context;
    const stepper = new Stepper(robot, plan, steps, q_rad, { gripperClosed, signals });
    return new Promise(resolve => {
      command = { stepper, resolve, stopping: null, begun: false, moving: false, step: "" };
    });
  }

  /** The one motion primitive (rows T-12, T-13): joint targets, checked, then carried out over many cycles. */
  async function moveRobotJoints(
    target_rad: ArrayLike<number>,
    fit: () => Refusal | null = notNow,
    ratio = 1,
  ): Promise<CommandOutcome> {
    const reason = fit() ?? jointRefusal(robot, target_rad);
    if (reason) return refuse(reason);
    options.onMotion?.(target_rad);
    const step: Step = {
      id: "",
      type: "move",
      path: "ptp",
      target: { q: Array.from(target_rad) },
      speed: { ratio },
      blend_m: 0,
    };
    return start([step][Symbol.iterator](), { tools: {}, frames: {} });
  }

  function brake(state: SafetyState, reason: Refusal): void {
    if (state !== "normal") {
      safety = state;
      why = reason;
    }
    message = reason.sentence;
    if (command && !command.stopping) {
      command.stopping = reason;
      command.stepper.stop(true);
    }
    // Held where it stands there is nothing to brake, now or when the override comes back.
    if (command && command.begun && !command.moving && override === 0) finish({ kind: "stopped", why: reason });
  }

  return {
    kind: "virtual",
    name,
    robot,
    brakingTime_s,
    signals,
    onSample: listen => samples.add(listen),
    close() {
      if (isClosed) return;
      isClosed = true;
      stopCycle();
      if (command) finish({ kind: "stopped", why: closed(name) });
      samples.clear();
    },
    isMoving,
    setSpeed(percent) {
      const reason = percentRefusal(percent);
      if (reason) return refuse(reason);
      override = percent / 100;
      return DONE;
    },
    jointAngle: joint => q_rad[joint - 1] ?? NaN,
    jointAngles(out = new Float64Array(n)) {
      out.set(q_rad);
      return out;
    },
    async moveJoint(joint, angle_rad) {
      const reason = jointNumberRefusal(robot, joint);
      if (reason) return refuse(reason);
      const target = Float64Array.from(q_rad);
      target[joint - 1] = angle_rad;
      return moveRobotJoints(target);
    },
    moveJoints: target_rad => moveRobotJoints(target_rad),
    moveToZero: () => moveRobotJoints(new Float64Array(n)),
    cannotCarryOut: () => null,
    async moveToPose(baseFromFlange) {
      if (!solve) {
        return refuse({
          code: "controller.no-solver",
          sentence: `${name} has no solver for poses.`,
          hint: "Attach one, or command joint angles.",
        });
      }
      const reach = solve(baseFromFlange, q_rad);
      const nearest = reach.kind === "reached" ? reach.solutions[0] : undefined;
      if (!nearest)
        return refuse({
          code: `reach.${reach.kind}`,
          sentence: explainReach(reach),
          hint: "Choose a pose within reach.",
        });
      return moveRobotJoints(nearest.q_rad);
    },
    async run(steps, context) {
      const reason = notNow();
      return reason ? refuse(reason) : start(steps[Symbol.iterator](), context);
    },
    stop(emergency = false) {
      if (emergency) brake("emergency-stop", drivesOff(robot));
      else brake("normal", stopped("controller.stopped", `${robot.name} was stopped.`));
    },
    reset: () => Promise.resolve(resetHere()),
    jumpTo(target_rad) {
      const reason = unfit() ?? jointRefusal(robot, target_rad);
      if (reason) return refuse(reason);
      q_rad.set(Float64Array.from(target_rad));
      return DONE;
    },
    atTheRobot: {
      reset: resetHere,
      setMode(to) {
        if (to === mode) return;
        mode = to;
        brake("normal", stopped("controller.mode-changed", `${robot.name} was switched to ${to} mode.`));
      },
      jog: (target_rad, ratio = 1) =>
        moveRobotJoints(
          target_rad,
          () =>
            mode === "manual"
              ? unfit()
              : {
                  code: "controller.not-manual",
                  sentence: `${robot.name} is in ${mode} mode; its pendant jogs in manual mode only.`,
                  hint: "Turn the mode switch to manual.",
                },
          ratio,
        ),
      setOverride(percent) {
        const reason = percentRefusal(percent);
        if (reason) return refuse(reason);
        override = percent / 100;
        return DONE;
      },
      setGuardOpen(open) {
        guardIsOpen = open;
        if (open && safety === "normal") brake("guard-stop", guardOpen(robot));
        if (!open && safety === "guard-stop") {
          safety = "normal";
          why = null;
          message = "";
        }
      },
      setInput(signal, value) {
        signals.write(signal, value);
      },
      protectiveStop(because) {
        if (safety !== "emergency-stop") brake("protective-stop", protective(because));
      },
    },
  };
}
