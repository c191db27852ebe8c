import {
  identity,
  type CommandOutcome,
  type Interpreted,
  type Program,
  type Refusal,
  type Robot,
  type Step,
} from "@twincell/core";
import { jointMoveSpeed } from "../../guard/index.ts";
import type { VirtualController } from "../../virtual/index.ts";
import { ADDED, CYCLE, noStatus, type Alarm, type Status } from "../codec/index.ts";
import { stamp } from "./clock.ts";
import { JobRun, type Files, type Place } from "./jobs.ts";

export type KeySwitch = "teach" | "play" | "remote";
export type Interpret = (text: string) => Interpreted;
export interface MachineOptions {
  readonly robot: Robot;
  readonly neutral: VirtualController;
  readonly files: Files;
  readonly interpret?: Interpret;
  readonly mode: KeySwitch;
  readonly servo: boolean;
  /** From the command until the drives are on [s]. */
  readonly servoOn_s: number;
  /** Time of day [s since 1970]. */
  readonly unix_s: () => number;
}
type Context = Pick<Program, "tools" | "frames">;
type Running = { readonly kind: "move" } | { readonly kind: "job"; readonly run: JobRun };

/** Codes of this virtual controller's own: a person sees the name beside it. */
const ALARM = { motion: 4400, job: 4401 } as const;
const MOST_ALARMS = 100;
const TEACH_MPS = 0.25;
const FLANGE = identity<"flange", "tcp">();

/**
 * The states of a controller in front of the neutral virtual robot: key switch and command remote, servo power, three
 * holds, alarms and errors, one motion or one job. Every order is answered by 0 or by the added status of its refusal.
 * A hold slows the robot down along its path; a job goes on from there when it is started again, a single move is given
 * up.
 */
export class Machine {
  readonly status: Status = noStatus();
  cycle: number = CYCLE.once;
  alarms: Alarm[] = [];
  readonly history: Alarm[] = [];
  /** Why a job or a move ended, in words for the pendant. */
  message = "";
  readonly time_s = { servo: 0, playback: 0, motion: 0 };
  private readonly options: MachineOptions;
  private mode: KeySwitch;
  private commandRemote = true;
  private servoAt_s = Infinity;
  private override = 1;
  private pressed = false;
  private guardOpen = false;
  private running: Running | null = null;
  private selected: { readonly job: string; readonly line: number } | null = null;
  private interrupted: JobRun | null = null;
  private now_s = 0;
  /** A hold came while something ran: a job waits for its start, a move for its end. */
  private paused = false;
  /** The neutral robot carries something out; what is to come after it. */
  private isCarrying = false;
  private next: (() => void) | null = null;

  constructor(options: MachineOptions) {
    this.options = options;
    this.mode = options.mode;
    this.status.servo = options.servo;
    this.turn(options.mode);
    options.neutral.onSample(lent => {
      const dt_s = lent.time_s - this.now_s;
      this.now_s = lent.time_s;
      if (this.now_s >= this.servoAt_s) this.servoIsOn();
      if (this.status.servo) this.time_s.servo += dt_s;
      if (lent.moving) this.time_s.motion += dt_s;
      if (this.running?.kind === "job") {
        this.running.run.reached(lent.step);
        this.time_s.playback += dt_s;
      }
      this.standing(lent.moving);
    });
    this.refresh();
  }

  get isBusy(): boolean {
    return this.status.running;
  }
  get speedOverride(): number {
    return this.override;
  }
  get servoIsComing(): boolean {
    return this.servoAt_s !== Infinity;
  }
  get keySwitch(): KeySwitch {
    return this.mode;
  }
  get place(): Place {
    const run = this.running?.kind === "job" ? this.running.run : this.interrupted;
    return run?.place ?? { job: this.selected?.job ?? "", line: this.selected?.line ?? 0, step: 0 };
  }

  /** Whether a command from outside that changes something is heard now. */
  fromOutside(): number {
    return this.mode !== "remote" ? ADDED.wrongMode : this.commandRemote ? 0 : ADDED.noCommandRemote;
  }

  // At the robot itself
  // ---------------------------------------------------------------------------------------------------

  turn(to: KeySwitch): void {
    this.mode = to;
    this.options.neutral.atTheRobot.setMode(to === "teach" ? "manual" : to === "play" ? "automatic" : "remote");
    this.refresh();
  }
  setCommandRemote(on: boolean): void {
    this.commandRemote = on;
    this.refresh();
  }
  setOverride(ratio: number): void {
    this.override = Math.min(1, Math.max(0, ratio));
    this.refresh();
  }
  /** True presses the button in; false lets it out again: alarms, servo and start wait for a person. */
  pressEmergencyStop(pressed: boolean): void {
    this.pressed = pressed;
    if (!pressed) return;
    this.status.error = true;
    this.powerOff();
  }
  openGuard(open: boolean): void {
    this.guardOpen = open;
    this.status.heldOutside = open;
    this.options.neutral.atTheRobot.setGuardOpen(open);
    this.refresh();
  }
  raise(code: number, name: string, data = 0, major = true): void {
    const alarm: Alarm = { code, data, type: 0, time: stamp(this.options.unix_s()), name: name.slice(0, 32) };
    this.alarms = [alarm, ...this.alarms].slice(0, 4);
    this.history.unshift(alarm);
    this.history.length = Math.min(this.history.length, MOST_ALARMS);
    this.status.alarm = true;
    if (major) this.powerOff();
    else this.refresh();
  }
  /** A joint move with the pendant: TEACH only, the flange no faster than 250 mm/s. */
  jog(q_rad: ArrayLike<number>, most = 1): Promise<CommandOutcome> {
    const { neutral, robot } = this.options;
    const full_mps = jointMoveSpeed(robot, neutral.jointAngles(), q_rad, FLANGE);
    return neutral.atTheRobot.jog(q_rad, Math.min(most, full_mps > 0 ? TEACH_MPS / full_mps : 1));
  }
  reboot(): void {
    this.give("The controller was switched off.");
    this.status.heldByCommand = this.status.heldByPendant = this.status.alarm = this.status.error = false;
    this.alarms = [];
    this.drop();
    this.selected = null;
    this.servo(false);
  }

  // Orders
  // ----------------------------------------------------------------------------------------------------------------

  hold(by: "heldByPendant" | "heldByCommand", on: boolean): number {
    this.status[by] = on;
    this.paused ||= on && this.running !== null;
    this.refresh();
    this.standing(this.options.neutral.isMoving());
    return 0;
  }
  servo(on: boolean): number {
    if (!on) {
      this.powerOff();
      return 0;
    }
    if (this.pressed || this.guardOpen || this.status.alarm || this.status.error)
      return this.pressed || this.guardOpen ? ADDED.servoRefuses : ADDED.alarm;
    if (!this.status.servo && this.servoAt_s === Infinity) this.servoAt_s = this.now_s + this.options.servoOn_s;
    return 0;
  }
  resetAlarm(): number {
    this.alarms = [];
    this.status.alarm = false;
    return this.cancelError();
  }
  cancelError(): number {
    if (!this.pressed) this.status.error = false;
    this.refresh();
    return 0;
  }
  select(job: string, line: number): number {
    if (this.status.running) return ADDED.moving;
    if (this.options.files.read(`${job}.JBI`) === undefined) return ADDED.noSuchJob;
    this.drop();
    this.selected = { job: job.toUpperCase(), line };
    return 0;
  }
  choose(cycle: number): void {
    this.cycle = cycle;
    this.refresh();
  }
  start(): number {
    const why = this.unfit();
    if (why !== 0) return why;
    if (this.running?.kind === "job") {
      this.paused = false;
      this.refresh();
      return 0;
    }
    if (this.interrupted === null) {
      if (this.selected === null) return ADDED.noJobSelected;
      const opened = this.open(this.selected);
      if (typeof opened === "number") return opened;
      this.interrupted = opened;
    } else if (this.interrupted.isInsideArc) return ADDED.confirmPosition;
    const run = this.interrupted;
    this.interrupted = null;
    this.begin({ kind: "job", run }, run.rest(this.cycle === CYCLE.step), this.context);
    return 0;
  }
  /** One motion from rest to rest. */
  move(step: Step, context: Context): number {
    const why = this.unfit();
    if (why !== 0) return why;
    this.drop();
    this.begin({ kind: "move" }, [step][Symbol.iterator](), context);
    return 0;
  }

  // Inside
  // ----------------------------------------------------------------------------------------------------------------

  private context: Context = { tools: {}, frames: {} };

  private unfit(): number {
    const { status } = this;
    if (status.running) return ADDED.moving;
    if (status.alarm || status.error) return ADDED.alarm;
    if (status.heldByPendant) return ADDED.heldByPendant;
    if (status.heldOutside) return ADDED.heldOutside;
    if (status.heldByCommand) return ADDED.heldByCommand;
    if (!status.servo) return ADDED.servoOff;
    if (this.mode === "teach") return ADDED.wrongMode;
    return this.running?.kind === "move" ? ADDED.moving : 0;
  }
  private get held(): boolean {
    return this.status.heldByPendant || this.status.heldByCommand || this.status.heldOutside;
  }

  private open({ job, line }: { readonly job: string; readonly line: number }): JobRun | number {
    const { files, interpret, neutral } = this.options;
    if (!interpret) {
      this.message = "This virtual controller was given no interpreter of INFORM.";
      return ADDED.syntax;
    }
    const { text, stretches } = files.together(job);
    const ready = interpret(text);
    if (ready.kind === "not-understood") {
      this.message = `${job}, line ${ready.faults[0]?.line ?? 0}: ${ready.faults[0]?.sentence ?? "not understood."}`;
      return ADDED.syntax;
    }
    this.context = ready.context;
    return new JobRun(job, line, ready, stretches, neutral.signals);
  }

  private begin(running: Running, steps: Iterator<Step>, context: Context): void {
    this.running = running;
    this.message = "";
    this.refresh();
    this.next = () => {
      this.isCarrying = true;
      void this.options.neutral.run({ [Symbol.iterator]: () => steps }, context).then(outcome => {
        this.isCarrying = false;
        this.finish(running, outcome);
        if (!this.isCarrying) this.goOn();
      });
    };
    if (!this.isCarrying) this.goOn();
  }
  private goOn(): void {
    const { next } = this;
    this.next = null;
    next?.();
    this.refresh();
  }
  /** Forgets the job that waits to be continued. */
  private drop(): void {
    this.interrupted = null;
    if (this.running === null) return;
    this.running = null;
    this.paused = false;
    this.options.neutral.stop();
    this.refresh();
  }

  private finish(running: Running, outcome: CommandOutcome): void {
    if (this.running !== running) return;
    this.running = null;
    this.paused = false;
    if (outcome.kind === "done") {
      if (running.kind === "job") {
        running.run.ended();
        if (!running.run.over) this.interrupted = running.run;
        else if (this.cycle === CYCLE.continuous && this.selected && !this.held) {
          this.refresh();
          this.start();
          return;
        }
      }
    } else {
      this.message = outcome.why.sentence;
      if (running.kind === "job" && isBrake(outcome.why)) this.interrupted = running.run;
      else if (!isBrake(outcome.why))
        this.raise(
          running.kind === "job" ? ALARM.job : ALARM.motion,
          outcome.why.code.toUpperCase(),
          outcome.why.joint ?? 0,
        );
    }
    this.refresh();
  }
  /** Ends what is under way, because of that. */
  private give(because: string): void {
    this.message = because;
    this.options.neutral.stop();
  }

  private standing(moving: boolean): void {
    if (!this.paused || moving || this.running === null) return;
    if (this.running.kind === "move") this.give("The move was given up by a hold.");
    this.refresh();
  }
  private powerOff(): void {
    this.servoAt_s = Infinity;
    this.status.servo = false;
    this.options.neutral.stop(true);
    this.refresh();
  }
  private servoIsOn(): void {
    const answer = this.options.neutral.atTheRobot.reset();
    // The robot is still braking: the drives come on when it stands.
    if (answer.kind !== "done") return;
    this.servoAt_s = Infinity;
    this.status.servo = true;
    this.refresh();
  }

  private refresh(): void {
    const {
      status,
      mode,
      options: { neutral },
    } = this;
    status.step = this.cycle === CYCLE.step;
    status.once = this.cycle === CYCLE.once;
    status.continuous = this.cycle === CYCLE.continuous;
    status.teach = mode === "teach";
    status.play = mode !== "teach";
    status.remote = mode === "remote" && this.commandRemote;
    status.slow = mode === "teach";
    neutral.setSpeed(this.held || this.paused ? 0 : 100 * this.override);
    status.running = this.running !== null && !(this.paused && !neutral.isMoving());
  }
}

/** Ended from outside, not by a fault of its own. */
const isBrake = ({ code }: Refusal): boolean =>
  code === "controller.stopped" ||
  code === "controller.mode-changed" ||
  code.startsWith("safety.") ||
  code === "controller.closed";
