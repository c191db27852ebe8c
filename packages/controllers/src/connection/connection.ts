import {
  samplePlan,
  type CarriedPart,
  type CornerArea,
  type CommandOutcome,
  type EmittedFile,
  type Finding,
  type JointSample,
  type LinkReport,
  type Plan,
  type Pose,
  type PreparedRun,
  type Program,
  type RealController,
  type Refusal,
  type RobotController,
  type Scheduler,
  type Step,
  type Robot,
} from "@twincell/core";
import type { CellMember } from "../cell/index.ts";
import { createGuard, PlannedPath, type Guard, type GuardState, type Commander } from "../guard/index.ts";
import { listeners } from "../listeners.ts";
import { createTwin, type Deviation, type Twin } from "../twin/index.ts";
import { createAhead, type Ahead } from "./ahead.ts";
import { deviates, disconnected } from "./words.ts";
import { DONE } from "../outcomes.ts";

export interface RobotConnectionOptions {
  readonly controller: RobotController | RealController;
  readonly scheduler: Scheduler;
  readonly name?: string;
  readonly worldFromBase?: Pose<"world", "base">;
  readonly flangeFromTcp?: Pose<"flange", "tcp">;
  readonly isSafe?: (q_rad: Float64Array) => boolean;
  /** Motion only while the commander keeps a switch pressed; see the guard. */
  readonly deadMan?: boolean;
  /** Its place among the other robots of the cell. */
  readonly place?: CellMember;
  /** Begins as one that is only watched; see the guard. */
  readonly watching?: boolean;
  /** Without a sample for this long the link counts as lost; see the guard. */
  readonly silence_s?: number | (() => number);
  readonly heartbeat_s?: number;
  readonly brakingTime_s?: number;
  /** More than this far from plan or command is said aloud [rad]. */
  readonly alarm_rad?: number;
}

/** A robot that is to be let go has this long to stand when its braking time is not given [s]. */
const BRAKING_S = 2;
const LOOK_S = 0.005;

/**
 * What a program is handed over with: its text where there is one and the controller takes texts, else its steps; the
 * plan is what it is compared with.
 */
export interface RobotJob {
  readonly program: Program;
  readonly files?: readonly EmittedFile[];
  readonly steps: () => Iterable<Step>;
  readonly plan?: Plan;
  /** What the check found on the plan. */
  readonly findings?: readonly Finding[];
  /** Those of them that make the check red. */
  readonly bad?: readonly Finding[];
  /** The parts of the cell that it carries. */
  readonly carried?: readonly CarriedPart[];
  /** What its controller may make of the corners it passes without a stop; the guard looks at all of each before it. */
  readonly corners?: readonly CornerArea[];
}

/**
 * One controller of the cell as the studio has it: behind its guard, with its twin, its link and how far it is from
 * what it should do.
 */
export interface RobotConnection {
  readonly name: string;
  readonly controller: RobotController | RealController;
  readonly guard: Guard;
  readonly twin: Twin;
  readonly link: LinkReport | null;
  readonly deviation: Readonly<Deviation>;
  /** Where it will be. */
  readonly ahead: Ahead;
  /** A place from which it may be commanded; each has its own. */
  commander(who: string): Commander;
  connect(): Promise<CommandOutcome>;
  /**
   * Stops a robot that moves, and closes the connection when it stands; nothing moves after the next one without a
   * person's word.
   */
  disconnect(): void;
  /** Runs a program from that seat: as the controller's own text where it takes one. */
  carryOut(seat: Commander, job: RobotJob): Promise<CommandOutcome>;
  /** The same in two: everything that may be refused is asked and handed over first, where nothing moves. */
  arm(seat: Commander, job: RobotJob): Promise<PreparedRun>;
  onSample(listen: (lent: JointSample) => void): () => void;
  onLink(listen: (report: LinkReport) => void): () => void;
  onGuard(listen: (state: GuardState) => void): () => void;
  onNotice(listen: (why: Refusal) => void): () => void;
  /** Stops a robot that moves first; `then` is called when it stands and everything is closed. */
  close(then?: () => void): void;
}

/** A program as text on its way through the guard: no step of it is taken here. */
class TextOnItsWay implements Iterable<Step> {
  readonly start: () => Promise<CommandOutcome>;
  constructor(start: () => Promise<CommandOutcome>) {
    this.start = start;
  }
  [Symbol.iterator](): Iterator<Step> {
    return [][Symbol.iterator]();
  }
}

const ALARM_RAD = Math.PI / 180;
/**
 * A sample and a stop together are no longer under way to and from a controller than this, as the guard counts on [s].
 */
const LINK_DELAY_S = 0.02;
/** A motion that begins sooner than this and lasts longer is one to be seen [s]. */
const SOON_S = 0.1;

/**
 * Makes a controller a station. Programs of controllers that take texts are handed over as text and watched; the
 * guard's lease, enabling switch and link rules hold for them as for any motion.
 */
export function createRobotConnection(options: RobotConnectionOptions): RobotConnection {
  return robotConnectionOf(new ConnectionState(options));
}

class ConnectionState {
  readonly options: RobotConnectionOptions;
  readonly controller: RobotController | RealController;
  readonly scheduler: Scheduler;
  readonly robot: Robot;
  readonly n: number;
  readonly alarm_rad: number;
  readonly name: string;
  readonly notices = listeners<Refusal>();
  readonly real: RealController | null;
  path: PlannedPath | null = null;
  alarmed = false;
  override = 1;
  /** The same controller, which takes a text where steps are asked for. */
  readonly handing: RobotController;
  readonly deviation: Deviation = { plan_rad: NaN, command_rad: NaN };
  // First of all: the guard asks where on its path the robot is.
  readonly unwatch: () => void;
  readonly guard: Guard;
  readonly twin: Twin;
  readonly ahead: Ahead;
  readonly unlink: (() => void) | undefined;
  readonly unnotice: () => void;

  constructor(options: RobotConnectionOptions) {
    this.options = options;
    this.controller = this.options.controller;
    this.scheduler = this.options.scheduler;
    this.robot = this.controller.robot;
    this.n = this.robot.arm.joints.length;
    this.alarm_rad = this.options.alarm_rad ?? ALARM_RAD;
    this.name = this.options.name ?? this.controller.name;
    this.real = "link" in this.controller ? this.controller : null;
    this.handing =
      this.real?.runText === undefined
        ? this.controller
        : {
            ...this.controller,
            isMoving: () => this.controller.isMoving(),
            run: (steps, context) =>
              steps instanceof TextOnItsWay ? steps.start() : this.controller.run(steps, context),
          };
    this.unwatch = this.controller.onSample(sample => {
      ({ override: this.override } = sample);
      this.path?.take(sample.q_rad);
      this.deviation.plan_rad = this.path?.off_rad ?? NaN;
      this.deviation.command_rad = sample.target_rad ? largest(sample.q_rad, sample.target_rad, this.n) : NaN;
      const worst_rad = Math.max(orZero(this.deviation.plan_rad), orZero(this.deviation.command_rad));
      if (worst_rad > this.alarm_rad && !this.alarmed)
        this.notices.call(deviates(this.name, worst_rad, this.alarm_rad));
      this.alarmed = worst_rad > this.alarm_rad;
    });
    this.guard = createGuard({
      controller: this.handing,
      scheduler: this.scheduler,
      ...(this.options.flangeFromTcp ? { flangeFromTcp: this.options.flangeFromTcp } : {}),
      ...(this.real ? { linkDelay_s: LINK_DELAY_S } : {}),
      ...(this.options.isSafe ? { isSafe: this.options.isSafe } : {}),
      ...(this.options.place ? { place: this.options.place } : {}),
      ...(this.options.watching === undefined ? {} : { watching: this.options.watching }),
      ...(this.options.deadMan === undefined ? {} : { deadMan: this.options.deadMan }),
      ...(this.options.silence_s === undefined ? {} : { silence_s: this.options.silence_s }),
      ...(this.options.heartbeat_s === undefined ? {} : { heartbeat_s: this.options.heartbeat_s }),
      ...(this.options.brakingTime_s === undefined ? {} : { brakingTime_s: this.options.brakingTime_s }),
    });
    this.twin = createTwin({ real: this.controller, scheduler: this.scheduler, name: this.name });
    this.ahead = createAhead({
      robot: this.robot,
      name: this.name,
      scheduler: this.scheduler,
      place: this.options.place ?? null,
    });
    this.unlink = this.real?.onLink(({ state }) => {
      if (state === "lost") this.guard.linkLost();
    });
    this.unnotice = this.guard.onNotice(why => {
      this.notices.call(why);
    });
  }

  /**
   * Calls `then` at once when the robot stands, else stops it and waits until it does, or until its braking time is
   * over.
   */
  atStandstill(then: () => void): void {
    if (this.guard.state.watching || !this.controller.isMoving()) {
      then();
      return;
    }
    this.guard.stop();
    const until_s = this.options.scheduler.now_s() + (this.options.brakingTime_s ?? BRAKING_S);
    const off = this.options.scheduler.every(LOOK_S, () => {
      if (this.controller.isMoving() && this.real?.isConnected !== false && this.options.scheduler.now_s() < until_s)
        return;
      off();
      then();
    });
  }

  /** Its text, where there is one and the controller takes texts. */
  textOf({ files }: RobotJob): readonly EmittedFile[] | null {
    return this.real?.runText && files ? files : null;
  }

  /** Lets the robot do it, compared with its plan all the way. */
  async follow(
    seat: Commander,
    steps: Iterable<Step>,
    { program, plan, findings = [], corners = [] }: RobotJob,
  ): Promise<CommandOutcome> {
    const following = plan ? new PlannedPath(plan, this.n, corners) : null;
    this.path = following;
    this.guard.follow(following);
    if (this.options.place && plan && following) {
      this.options.place.path = (in_s, out) => {
        samplePlan(plan, Math.min(plan.duration_s, following.at + in_s * this.override), out);
        return true;
      };
    }
    const progress = { at_s: 0, rate: 1 };
    const stopLooking =
      plan && following
        ? this.ahead.follow(plan, findings, () => {
            progress.at_s = following.at;
            progress.rate = this.override;
            return progress;
          })
        : null;
    try {
      return await seat.robot.run(steps, program);
    } finally {
      stopLooking?.();
      this.path = null;
      this.guard.follow(null);
      if (this.options.place) this.options.place.path = null;
    }
  }
}

function robotConnectionOf(own: ConnectionState): RobotConnection {
  return {
    name: own.name,
    controller: own.controller,
    guard: own.guard,
    twin: own.twin,
    deviation: own.deviation,
    ahead: own.ahead,
    link: own.real?.link ?? null,
    commander: who => own.guard.seat(who),
    connect: () => own.real?.connect() ?? Promise.resolve(DONE),
    disconnect() {
      own.atStandstill(() => {
        own.real?.disconnect();
        if (own.real) own.guard.linkLost(disconnected(own.name));
      });
    },
    async carryOut(seat, job) {
      const files = own.textOf(job);
      return own.follow(seat, files ? new TextOnItsWay(() => own.real!.runText!(files)) : job.steps(), job);
    },
    async arm(seat, job) {
      const why = seat.readiness();
      if (why) return { kind: "refused", why };
      const files = own.textOf(job);
      const handed = files ? await own.real?.handText?.(files) : undefined;
      if (handed?.kind === "refused") return handed;
      if (!handed) {
        // No step of it is carried out: it only says whether one would be.
        const unfit = await own.controller.run([], job.program);
        if (unfit.kind !== "done") return { kind: "refused", why: unfit.why };
      }
      const start = handed ? handed.start : files ? () => own.real!.runText!(files) : null;
      return {
        kind: "armed",
        movesAtOnce:
          job.plan?.segments.some(
            ({ kind, start_s, duration_s }) => kind === "motion" && start_s < SOON_S && duration_s > SOON_S,
          ) ?? false,
        readiness: () => seat.readiness(),
        drop() {
          handed?.drop();
        },
        start: () => own.follow(seat, start ? new TextOnItsWay(start) : job.steps(), job),
      };
    },
    onSample: listen => own.twin.onSample(listen),
    onLink: listen => own.real?.onLink(listen) ?? (() => undefined),
    onGuard: listen => own.guard.onChange(listen),
    onNotice: listen => own.notices.add(listen),
    close(then) {
      own.atStandstill(() => {
        own.unwatch();
        own.unlink?.();
        own.unnotice();
        own.ahead.close();
        own.guard.close();
        own.twin.close();
        own.controller.close();
        own.notices.clear();
        then?.();
      });
    },
  };
}

const orZero = (value: number): number => (Number.isNaN(value) ? 0 : value);
function largest(a: ArrayLike<number>, b: ArrayLike<number>, n: number): number {
  let most = 0;
  for (let i = 0; i < n; i++) most = Math.max(most, Math.abs(a[i]! - b[i]!));
  return most;
}
