import {
  explainReach,
  solveAll,
  type CommandOutcome,
  type EmittedFile,
  type UploadedProgram,
  type JointSample,
  type Pose,
  type RealController,
  type Refusal,
  type Scheduler,
  type Signals,
  type Step,
  type Robot,
} from "@twincell/core";
import { listeners } from "../listeners.ts";
import {
  busy,
  closed,
  drivesOff,
  guardOpen,
  jointNumberRefusal,
  jointRefusal,
  manualMode,
  percentRefusal,
  programFault,
  protective,
  stoppedInReset,
} from "../refusals.ts";
import type { ControllerAdapter } from "./adapter.ts";
import { keepLink, type Link } from "./link.ts";
import { stepRefusal } from "./sayable.ts";
import { sendSteps } from "./steps.ts";
import { linkDown, notOpen, resetUnseen, wasStopped } from "./words.ts";
import { DONE, refused } from "../outcomes.ts";

export interface RealOptions {
  readonly face: ControllerAdapter;
  readonly scheduler: Scheduler;
  readonly name?: string;
  /** Where the robot stands in the cell; frames of a program are seen from the world. */
  readonly worldFromBase?: Pose<"world", "base">;
  /** Called once, before the first connection (row T-11). */
  readonly initialize?: () => void;
  /** Called with the target of every motion that is sent: the one primitive behind all moves (row T-12). */
  readonly onMotion?: (q_rad: ArrayLike<number>) => void;
}

type Lent = { -readonly [K in keyof JointSample]: JointSample[K] };
interface Command {
  readonly settle: (outcome: CommandOutcome) => void;
  stopping: Refusal | null;
  seenMoving: boolean;
  moves: boolean;
  step: string;
  over: boolean;
}

/** Longest time between the end of a reset and the first sample that says so [s]: drives and brakes take seconds. */
const RESET_SEEN_S = 20;
/** How often it is looked whether a reset was seen [s]. */
const RESET_LOOK_S = 0.01;

/** A stop is over when the robot says so this many times, should the answer to the motion itself be lost. */
const STANDS = 3;

/** What all drivers have in common, in front of one brand's face. Nothing here waits for the wire. */
export function createRealController(options: RealOptions): RealController {
  return realControllerOf(new RealControllerState(options));
}

class RealControllerState {
  readonly options: RealOptions;
  readonly adapter: ControllerAdapter;
  readonly scheduler: Scheduler;
  readonly robot: Robot;
  readonly n: number;
  readonly name: string;
  readonly samples = listeners<JointSample>();
  readonly q_rad: Float64Array;
  readonly lent: Lent;
  command: Command | null = null;
  isClosed = false;
  said = "";
  moving = false;
  standing = 0;
  override = 1;
  /** Stops so far, and emergency stops among them: a reset that began before one of them is over. */
  stops = 0;
  emergencies = 0;
  resetting: Promise<CommandOutcome> | null = null;
  readonly link: Link;
  readonly signals: Signals;

  constructor(options: RealOptions) {
    this.options = options;
    this.adapter = this.options.face;
    this.scheduler = this.options.scheduler;
    this.robot = this.adapter.robot;
    this.n = this.robot.arm.joints.length;
    this.name = this.options.name ?? `${this.adapter.brand} ${this.robot.name}`;
    this.q_rad = Float64Array.from(this.robot.home_rad);
    this.lent = {
      sequence: 0,
      time_s: 0,
      q_rad: this.q_rad,
      moving: false,
      mode: "automatic",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      step: "",
      message: "",
    };
    this.link = keepLink(this.adapter, this.scheduler, this.name, {
      losing: () => {
        if (this.command) this.adapter.stop(false);
      },
      lost: why => {
        this.end({ kind: "stopped", why });
      },
      sample: sample => {
        this.q_rad.set(sample.q_rad);
        this.lent.sequence = sample.sequence;
        this.lent.time_s = sample.time_s;
        this.lent.mode = sample.mode;
        this.lent.safety = sample.safety;
        this.lent.override = sample.override;
        this.lent.gripperClosed = sample.gripperClosed;
        if (sample.signals) this.lent.signals = sample.signals;
        if (sample.target_rad) this.lent.target_rad = sample.target_rad;
        this.lent.message = sample.message === "" ? this.said : sample.message;
        this.lent.step = this.command?.step ?? "";
        if (this.command && sample.moving) this.command.seenMoving = true;
        this.moving = sample.moving;
        this.standing = this.moving ? 0 : this.standing + 1;
        this.lent.moving = this.isMoving();
        this.samples.call(this.lent);
        if (this.command?.stopping && this.standing >= STANDS)
          this.end({ kind: "stopped", why: this.command.stopping });
      },
    });
    this.signals = {
      read: signal => this.lent.signals?.get(signal) ?? false,
      write: (signal, value) => {
        const why = this.link.isOpen ? this.adapter.setSignal(signal, value) : notOpen(this.name);
        if (why) this.said = why.sentence;
      },
    };
    this.options.initialize?.();
  }

  readonly isMoving = (): boolean => {
    return (
      this.moving ||
      (this.command !== null &&
        this.command.moves &&
        !this.command.seenMoving &&
        this.override > 0 &&
        !this.command.stopping)
    );
  };

  end(outcome: CommandOutcome): void {
    const ended = this.command;
    this.command = null;
    if (!ended) return;
    ended.over = true;
    if (outcome.kind !== "done") this.said = outcome.why.sentence;
    ended.settle(outcome);
  }

  unfit(): Refusal | null {
    if (this.isClosed) return closed(this.name);
    if (!this.link.isOpen)
      return this.link.report.state === "closed" ? notOpen(this.name) : linkDown(this.name, this.link.report.sentence);
    if (this.lent.safety === "emergency-stop") return drivesOff(this.robot);
    if (this.lent.safety === "protective-stop") return protective(this.lent.message);
    if (this.lent.safety === "guard-stop") return guardOpen(this.robot);
    if (this.lent.mode === "manual") return manualMode(this.robot);
    return this.command ? busy(this.robot) : null;
  }

  refuse(why: Refusal): CommandOutcome {
    this.said = why.sentence;
    return refused(why);
  }

  /** One command at a time; its promise ends with the robot's own word, a stop, or the link. */
  carryOut(body: (mine: Command) => Promise<CommandOutcome>): Promise<CommandOutcome> {
    this.said = "";
    return new Promise(resolve => {
      const mine: Command = { settle: resolve, stopping: null, seenMoving: false, moves: false, step: "", over: false };
      this.command = mine;
      body(mine).then(
        outcome => {
          if (this.command === mine)
            this.end(mine.stopping && outcome.kind !== "refused" ? { kind: "stopped", why: mine.stopping } : outcome);
        },
        // Steps may come from a running program text, and that may fault.
        (reason: unknown) => {
          if (this.command === mine) {
            this.adapter.stop(false);
            this.end({ kind: "stopped", why: programFault(reason) });
          }
        },
      );
    });
  }

  /** Everything that moves the robot move by move goes through here (rows T-12, T-13). */
  send(steps: Iterable<Step>, context: Parameters<RealController["run"]>[1]): Promise<CommandOutcome> {
    const plan = this.options.worldFromBase ? { ...context, worldFromBase: this.options.worldFromBase } : context;
    return this.carryOut(mine =>
      sendSteps(steps, {
        robot: this.robot,
        face: this.adapter,
        scheduler: this.scheduler,
        signals: this.signals,
        context: plan,
        measured_rad: () => this.q_rad.slice(),
        ended: () => mine.over || mine.stopping !== null,
        onStep(id) {
          mine.step = id;
        },
        onMessage: text => {
          this.said = text;
        },
        onMotion: target_rad => {
          mine.moves = true;
          mine.seenMoving = false;
          this.options.onMotion?.(target_rad);
        },
      }),
    );
  }

  async moveRobotJoints(target_rad: ArrayLike<number>): Promise<CommandOutcome> {
    const why = this.unfit() ?? jointRefusal(this.robot, target_rad);
    if (why) return this.refuse(why);
    return this.send(
      [{ id: "", type: "move", path: "ptp", target: { q: Array.from(target_rad) }, speed: { ratio: 1 }, blend_m: 0 }],
      { tools: {}, frames: {} },
    );
  }

  /** Resolves when a sample says that the stop is over; why not, after the time is up or when the link went. */
  stopCleared(wanted: () => boolean): Promise<Refusal | null> {
    const until_s = this.scheduler.now_s() + RESET_SEEN_S;
    const look = (): Refusal | "wait" | null => {
      if (this.isClosed) return closed(this.name);
      if (!this.link.isOpen) return linkDown(this.name, this.link.report.sentence);
      if (!wanted()) return stoppedInReset(this.robot);
      if (this.lent.safety !== "emergency-stop" && this.lent.safety !== "protective-stop") return null;
      return this.scheduler.now_s() >= until_s ? resetUnseen(this.robot, RESET_SEEN_S) : "wait";
    };
    return new Promise(resolve => {
      const first = look();
      if (first !== "wait") {
        resolve(first);
        return;
      }
      const cancel = this.scheduler.every(RESET_LOOK_S, () => {
        const now = look();
        if (now === "wait") return;
        cancel();
        resolve(now);
      });
    });
  }

  async carryOutReset(): Promise<CommandOutcome> {
    if (!this.link.isOpen) return this.refuse(this.isClosed ? closed(this.name) : notOpen(this.name));
    this.said = "";
    const stopsBefore = this.stops;
    const emergenciesBefore = this.emergencies;
    const wanted = (): boolean => this.stops === stopsBefore;
    const outcome = await this.adapter.reset(wanted);
    // An order that was on its way when the stop came may have switched on what the stop had switched off.
    if (this.emergencies !== emergenciesBefore) this.adapter.stop(true);
    if (!wanted()) return this.refuse(stoppedInReset(this.robot));
    if (outcome.kind !== "done") return this.refuse(outcome.why);
    const why = await this.stopCleared(wanted);
    return why ? this.refuse(why) : DONE;
  }
}

function realControllerOf(own: RealControllerState): RealController {
  return {
    kind: "real",
    name: own.name,
    robot: own.robot,
    signals: own.signals,
    watchdog: own.adapter.watchdog,
    link: own.link.report,
    get isConnected() {
      return own.link.isOpen;
    },
    connect: () => (own.isClosed ? Promise.resolve(refused(closed(own.name))) : own.link.open()),
    disconnect() {
      own.link.close();
    },
    onLink: listen => own.link.onChange(listen),
    onSample: listen => own.samples.add(listen),
    close() {
      if (own.isClosed) return;
      own.isClosed = true;
      own.link.close();
      own.end({ kind: "stopped", why: closed(own.name) });
      own.samples.clear();
    },
    isMoving: own.isMoving,
    setSpeed(percent) {
      const why = percentRefusal(percent) ?? (own.link.isOpen ? own.adapter.setOverride(percent / 100) : own.unfit());
      if (why) return own.refuse(why);
      own.override = percent / 100;
      return DONE;
    },
    jointAngle: joint => own.q_rad[joint - 1] ?? NaN,
    jointAngles(out = new Float64Array(own.n)) {
      out.set(own.q_rad);
      return out;
    },
    async moveJoint(joint, angle_rad) {
      const why = jointNumberRefusal(own.robot, joint);
      if (why) return own.refuse(why);
      const target_rad = own.q_rad.slice();
      target_rad[joint - 1] = angle_rad;
      return own.moveRobotJoints(target_rad);
    },
    moveJoints: target_rad => own.moveRobotJoints(target_rad),
    moveToZero: () => own.moveRobotJoints(new Float64Array(own.n)),
    async moveToPose(baseFromFlange) {
      const reach = solveAll(own.robot, baseFromFlange, { near: own.q_rad });
      const nearest = reach.kind === "reached" ? reach.solutions[0] : undefined;
      if (!nearest)
        return own.refuse({
          code: `reach.${reach.kind}`,
          sentence: explainReach(reach),
          hint: "Choose a pose within reach.",
        });
      return own.moveRobotJoints(nearest.q_rad);
    },
    async run(steps, context) {
      const why = own.unfit();
      return why ? own.refuse(why) : own.send(steps, context);
    },
    cannotCarryOut: step => stepRefusal(step, own.adapter, own.robot),
    stop(emergency = false) {
      // Even when the link looks closed: a word too many does no harm.
      own.adapter.stop(emergency);
      own.stops++;
      if (emergency) own.emergencies++;
      if (!own.command) return;
      own.command.stopping ??= emergency ? drivesOff(own.robot) : wasStopped(own.robot);
      own.standing = 0;
    },
    reset() {
      own.resetting ??= own.carryOutReset().finally(() => {
        own.resetting = null;
      });
      return own.resetting;
    },
    ...textCommandsOf(own),
  };
}

/** What only drivers have whose protocol takes program texts. */
function textCommandsOf(own: RealControllerState): Pick<RealController, "runText" | "handText"> {
  const { runText, handText } = own.adapter;
  return {
    ...(runText
      ? {
          async runText(files: readonly EmittedFile[]): Promise<CommandOutcome> {
            const why = own.unfit();
            return why
              ? own.refuse(why)
              : own.carryOut(mine => {
                  mine.moves = true;
                  return runText.call(own.adapter, files);
                });
          },
        }
      : {}),
    ...(handText
      ? {
          async handText(files: readonly EmittedFile[]): Promise<UploadedProgram> {
            const why = own.unfit();
            if (why) {
              own.said = why.sentence;
              return { kind: "refused", why };
            }
            const handed = await handText.call(own.adapter, files);
            if (handed.kind === "refused") {
              own.said = handed.why.sentence;
              return handed;
            }
            return {
              kind: "handed",
              drop: () => {
                handed.drop();
              },
              start() {
                const unready = own.unfit();
                if (unready) {
                  handed.drop();
                  return Promise.resolve(own.refuse(unready));
                }
                return own.carryOut(mine => {
                  mine.moves = true;
                  return handed.start();
                });
              },
            };
          },
        }
      : {}),
  };
}
