import {
  samplePlan,
  type CarriedPart,
  type CommandOutcome,
  type EmittedFile,
  type Finding,
  type JointSample,
  type LinkReport,
  type Plan,
  type Pose,
  type Program,
  type RealController,
  type Refusal,
  type RobotController,
  type Scheduler,
  type Step,
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
}

/** A program that a controller has and is ready for. */
export type PreparedRun =
  | {
      readonly kind: "armed" /** Its program begins with a motion: whether it begins can be seen. */;
      readonly movesAtOnce: boolean /** Why it would be turned down now. */;
      readiness(): Refusal | null;
      start(): Promise<CommandOutcome> /** It is not started after all. */;
      drop(): void;
    }
  | { readonly kind: "refused"; readonly why: Refusal };

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
  const { controller, scheduler } = options;
  const { robot } = controller;
  const n = robot.arm.joints.length;
  const alarm_rad = options.alarm_rad ?? ALARM_RAD;
  const name = options.name ?? controller.name;
  const notices = listeners<Refusal>();
  const real: RealController | null = "link" in controller ? controller : null;
  let path: PlannedPath | null = null;
  let alarmed = false;
  let override = 1;
  /** The same controller, which takes a text where steps are asked for. */
  const handing: RobotController =
    real?.runText === undefined
      ? controller
      : {
          ...controller,
          isMoving: () => controller.isMoving(),
          run: (steps, context) => (steps instanceof TextOnItsWay ? steps.start() : controller.run(steps, context)),
        };
  const deviation: Deviation = { plan_rad: NaN, command_rad: NaN };

  // First of all: the guard asks where on its path the robot is.
  const unwatch = controller.onSample(sample => {
    ({ override } = sample);
    path?.take(sample.q_rad);
    deviation.plan_rad = path?.off_rad ?? NaN;
    deviation.command_rad = sample.target_rad ? largest(sample.q_rad, sample.target_rad, n) : NaN;
    const worst_rad = Math.max(orZero(deviation.plan_rad), orZero(deviation.command_rad));
    if (worst_rad > alarm_rad && !alarmed) notices.call(deviates(name, worst_rad, alarm_rad));
    alarmed = worst_rad > alarm_rad;
  });
  const guard = createGuard({
    controller: handing,
    scheduler,
    ...(options.flangeFromTcp ? { flangeFromTcp: options.flangeFromTcp } : {}),
    ...(real ? { linkDelay_s: LINK_DELAY_S } : {}),
    ...(options.isSafe ? { isSafe: options.isSafe } : {}),
    ...(options.place ? { place: options.place } : {}),
    ...(options.watching === undefined ? {} : { watching: options.watching }),
    ...(options.deadMan === undefined ? {} : { deadMan: options.deadMan }),
    ...(options.silence_s === undefined ? {} : { silence_s: options.silence_s }),
    ...(options.heartbeat_s === undefined ? {} : { heartbeat_s: options.heartbeat_s }),
    ...(options.brakingTime_s === undefined ? {} : { brakingTime_s: options.brakingTime_s }),
  });
  const twin = createTwin({ real: controller, scheduler, name });
  const ahead = createAhead({ robot, name, scheduler, place: options.place ?? null });
  const unlink = real?.onLink(({ state }) => {
    if (state === "lost") guard.linkLost();
  });
  const unnotice = guard.onNotice(why => {
    notices.call(why);
  });

  /**
   * Calls `then` at once when the robot stands, else stops it and waits until it does, or until its braking time is
   * over.
   */
  function atStandstill(then: () => void): void {
    if (guard.state.watching || !controller.isMoving()) {
      then();
      return;
    }
    guard.stop();
    const until_s = options.scheduler.now_s() + (options.brakingTime_s ?? BRAKING_S);
    const off = options.scheduler.every(LOOK_S, () => {
      if (controller.isMoving() && real?.isConnected !== false && options.scheduler.now_s() < until_s) return;
      off();
      then();
    });
  }

  /** Its text, where there is one and the controller takes texts. */
  const textOf = ({ files }: RobotJob): readonly EmittedFile[] | null => (real?.runText && files ? files : null);
  /** Lets the robot do it, compared with its plan all the way. */
  async function follow(
    seat: Commander,
    steps: Iterable<Step>,
    { program, plan, findings = [] }: RobotJob,
  ): Promise<CommandOutcome> {
    const following = plan ? new PlannedPath(plan, n) : null;
    path = following;
    guard.follow(following);
    if (options.place && plan && following) {
      options.place.path = (in_s, out) => {
        samplePlan(plan, Math.min(plan.duration_s, following.at + in_s * override), out);
        return true;
      };
    }
    const progress = { at_s: 0, rate: 1 };
    const stopLooking =
      plan && following
        ? ahead.follow(plan, findings, () => {
            progress.at_s = following.at;
            progress.rate = override;
            return progress;
          })
        : null;
    try {
      return await seat.robot.run(steps, program);
    } finally {
      stopLooking?.();
      path = null;
      guard.follow(null);
      if (options.place) options.place.path = null;
    }
  }

  return {
    name,
    controller,
    guard,
    twin,
    deviation,
    ahead,
    link: real?.link ?? null,
    commander: who => guard.seat(who),
    connect: () => real?.connect() ?? Promise.resolve(DONE),
    disconnect() {
      atStandstill(() => {
        real?.disconnect();
        if (real) guard.linkLost(disconnected(name));
      });
    },
    async carryOut(seat, job) {
      const files = textOf(job);
      return follow(seat, files ? new TextOnItsWay(() => real!.runText!(files)) : job.steps(), job);
    },
    async arm(seat, job) {
      const why = seat.readiness();
      if (why) return { kind: "refused", why };
      const files = textOf(job);
      const handed = files ? await real?.handText?.(files) : undefined;
      if (handed?.kind === "refused") return handed;
      if (!handed) {
        // No step of it is carried out: it only says whether one would be.
        const unfit = await controller.run([], job.program);
        if (unfit.kind !== "done") return { kind: "refused", why: unfit.why };
      }
      const start = handed ? handed.start : files ? () => real!.runText!(files) : null;
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
        start: () => follow(seat, start ? new TextOnItsWay(start) : job.steps(), job),
      };
    },
    onSample: listen => twin.onSample(listen),
    onLink: listen => real?.onLink(listen) ?? (() => undefined),
    onGuard: listen => guard.onChange(listen),
    onNotice: listen => notices.add(listen),
    close(then) {
      atStandstill(() => {
        unwatch();
        unlink?.();
        unnotice();
        ahead.close();
        guard.close();
        twin.close();
        controller.close();
        notices.clear();
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
