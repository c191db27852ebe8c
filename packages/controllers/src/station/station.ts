import { withBranches, type CommandOutcome, type Dialect, type EmittedFile, type JointSample, type LinkReport, type Plan, type Pose, type Program, type RealController, type Refusal, type RobotController, type Scheduler, type Step } from "@twincell/core";
import { createGuard, type Guard, type GuardState, type Seat } from "../guard/index.ts";
import { listeners } from "../listeners.ts";
import { createTwin, PlanFollower, type Deviation, type Twin } from "../twin/index.ts";
import { deviates, notEmitted } from "./words.ts";
import { DONE } from "../outcomes.ts";

export interface StationOptions {
  readonly controller: RobotController | RealController;
  readonly scheduler: Scheduler;
  readonly name?: string;
  readonly worldFromBase?: Pose<"world", "base">;
  readonly flangeFromTcp?: Pose<"flange", "tcp">;
  readonly isSafe?: (q_rad: Float64Array) => boolean;
  /** Motion only while the commander keeps a switch pressed; see the guard. */
  readonly deadMan?: boolean;
  /** Begins as one that is only watched; see the guard. */
  readonly watching?: boolean;
  /** Without a sample for this long the link counts as lost; see the guard. */
  readonly silence_s?: number;
  readonly heartbeat_s?: number;
  readonly brakingTime_s?: number;
  /** More than this far from plan or command is said aloud [rad]. */
  readonly alarm_rad?: number;
}

/** What a program is handed over with: its text where the controller takes texts, else its steps; the plan is what it is compared with. */
export interface StationJob {
  readonly program: Program;
  readonly dialect?: Dialect;
  readonly steps: () => Iterable<Step>;
  readonly plan?: Plan;
}

/** One controller of the cell as the studio has it: behind its guard, with its twin, its link and how far it is from what it should do. */
export interface Station {
  readonly name: string;
  readonly controller: RobotController | RealController;
  readonly guard: Guard;
  readonly twin: Twin;
  readonly link: LinkReport | null;
  readonly deviation: Readonly<Deviation>;
  /** A place from which it may be commanded; each has its own. */
  seat(who: string): Seat;
  connect(): Promise<CommandOutcome>;
  disconnect(): void;
  /** Runs a program from that seat: as the controller's own text where it takes one. */
  carryOut(seat: Seat, job: StationJob): Promise<CommandOutcome>;
  onSample(listen: (lent: JointSample) => void): () => void;
  onLink(listen: (report: LinkReport) => void): () => void;
  onGuard(listen: (state: GuardState) => void): () => void;
  onNotice(listen: (why: Refusal) => void): () => void;
  close(): void;
}

/** A program as text on its way through the guard: no step of it is taken here. */
class HandedText implements Iterable<Step> {
  readonly files: readonly EmittedFile[];
  constructor(files: readonly EmittedFile[]) { this.files = files; }
  [Symbol.iterator](): Iterator<Step> { return [][Symbol.iterator](); }
}

const ALARM_RAD = Math.PI / 180;

/**
 * Makes a controller a station. Programs of controllers that take texts are handed over as text and watched; the guard's
 * lease, dead-man and link rules hold for them as for any motion.
 */
export function createStation(options: StationOptions): Station {
  const { controller, scheduler } = options, { robot } = controller, n = robot.arm.joints.length, alarm_rad = options.alarm_rad ?? ALARM_RAD;
  const name = options.name ?? controller.name, notices = listeners<Refusal>();
  const real: RealController | null = "link" in controller ? controller : null;
  let follower: PlanFollower | null = null, alarmed = false;
  /** The same controller, which takes a text where steps are asked for. */
  const handing: RobotController = real?.runText === undefined ? controller : {
    ...controller,
    isMoving: () => controller.isMoving(),
    run: (steps, context) => steps instanceof HandedText ? real.runText!(steps.files) : controller.run(steps, context),
  };
  const guard = createGuard({
    controller: handing, scheduler,
    ...(options.flangeFromTcp ? { flangeFromTcp: options.flangeFromTcp } : {}), ...(options.isSafe ? { isSafe: options.isSafe } : {}),
    ...(options.watching === undefined ? {} : { watching: options.watching }),
    ...(options.deadMan === undefined ? {} : { deadMan: options.deadMan }), ...(options.silence_s === undefined ? {} : { silence_s: options.silence_s }),
    ...(options.heartbeat_s === undefined ? {} : { heartbeat_s: options.heartbeat_s }), ...(options.brakingTime_s === undefined ? {} : { brakingTime_s: options.brakingTime_s }),
  });
  const twin = createTwin({ real: controller, scheduler, name });
  const deviation: Deviation = { plan_rad: NaN, command_rad: NaN };

  const unwatch = controller.onSample(sample => {
    deviation.plan_rad = follower ? follower.take(sample.q_rad) : NaN;
    deviation.command_rad = sample.target_rad ? largest(sample.q_rad, sample.target_rad, n) : NaN;
    const worst_rad = Math.max(orZero(deviation.plan_rad), orZero(deviation.command_rad));
    if (worst_rad > alarm_rad && !alarmed) notices.call(deviates(name, worst_rad, alarm_rad));
    alarmed = worst_rad > alarm_rad;
  });
  const unlink = real?.onLink(({ state }) => { if (state === "lost") guard.linkLost(); });
  const unnotice = guard.onNotice(why => { notices.call(why); });

  return {
    name, controller, guard, twin, deviation,
    link: real?.link ?? null,
    seat: who => guard.seat(who),
    connect: () => real?.connect() ?? Promise.resolve(DONE),
    disconnect() { real?.disconnect(); },
    async carryOut(seat, job) {
      const program = withBranches(job.program, robot, { where: "needed", ...(options.worldFromBase ? { worldFromBase: options.worldFromBase } : {}) });
      const written = real?.runText && job.dialect ? job.dialect.emit(program, robot, options.worldFromBase) : null;
      if (written?.kind === "cannot") return { kind: "refused", why: notEmitted(job.dialect!.name, written.sentence, written.hint) };
      follower = job.plan ? new PlanFollower(job.plan, n) : null;
      try {
        return await seat.robot.run(written ? new HandedText(written.files) : job.steps(), program);
      } finally {
        follower = null;
      }
    },
    onSample: listen => twin.onSample(listen),
    onLink: listen => real?.onLink(listen) ?? (() => undefined),
    onGuard: listen => guard.onChange(listen),
    onNotice: listen => notices.add(listen),
    close() {
      unwatch();
      unlink?.();
      unnotice();
      guard.close();
      twin.close();
      controller.close();
      notices.clear();
    },
  };
}

const orZero = (value: number): number => Number.isNaN(value) ? 0 : value;
function largest(a: ArrayLike<number>, b: ArrayLike<number>, n: number): number {
  let most = 0;
  for (let i = 0; i < n; i++) most = Math.max(most, Math.abs(a[i]! - b[i]!));
  return most;
}
