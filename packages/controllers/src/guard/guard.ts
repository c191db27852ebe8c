import {
  brakingTime_s,
  distance,
  hardBrakingTime_s,
  identity,
  type CommandOutcome,
  type JointSample,
  type Pose,
  type Refusal,
  type RobotController,
  type Scheduler,
  type Signals,
  type Robot,
} from "@twincell/core";
import type { CellMember } from "../cell/index.ts";
import { listeners } from "../listeners.ts";
import { jointNumberRefusal, jointRefusal, percentRefusal, stoppedInReset } from "../refusals.ts";
import { PathAhead, StraightPath } from "./known-path.ts";
import { jointMoveSpeed, speedBound, tcpOf } from "./speed.ts";
import type { Commander, Guard, GuardedCell, GuardOptions } from "./interface.ts";
import { AT_FIRST, guardStep, type GuardEvent, type GuardState } from "./state.ts";
import { StopForecast } from "./stop-forecast.ts";
import {
  cameTooNear,
  commanderWentSilent,
  denialRefusal,
  leaseGivenBack,
  linkWentDown,
  nowhereSafe,
  switchLetGo,
  targetTooNear,
  tooFast,
  watchedLinkDown,
} from "./words.ts";
import { DONE, refused } from "../outcomes.ts";

/** To be shown wherever the guard's state is shown. */
export const GUARD_NOTICE =
  "Not a certified safety function: it may refuse or stop a motion, it can never guarantee one.";

const WATCH_S = 0.02;
/**
 * A look that comes later than this was held up by its own thread [s]. What was sent meanwhile waits to be read: nobody
 * listened, so it is no silence, and it is counted from there on. Nothing can be told to the robot either in that time;
 * its own watchdog counts on.
 */
const HELD_UP_S = 0.005;
/** Where a robot would come to rest is looked at in steps no longer than this [rad], and in no more than so many. */
const LOOK_RAD = 0.05;
const MOST_LOOKS = 8;
const MANUAL_CAP_MPS = 0.25;
/** Measured over one cycle the speed is a little noisy. */
const SPEED_SLACK = 1.1;

/**
 * Stands between any input and any robot. Everything it does on its own can only stop the robot or lead it back where
 * it was safe.
 */
export function createGuard(options: GuardOptions): Guard {
  return guardOf(new GuardedController(options));
}

class GuardedController {
  readonly options: GuardOptions;
  readonly controller: RobotController;
  readonly scheduler: Scheduler;
  readonly place: CellMember | undefined;
  readonly robot: Robot;
  readonly jumpTo: ((q_rad: ArrayLike<number>) => CommandOutcome) | undefined;
  readonly n: number;
  readonly rules: { deadMan: boolean };
  isSafe: (q_rad: Float64Array) => boolean;
  readonly silence_s: () => number;
  readonly delay_s: number;
  readonly cap_mps: number;
  // Of a robot that nobody knows, it is not said that it brakes as hard as it can.
  readonly braking_s: number;
  contactsAt: GuardedCell["contactsAt"];
  gripper: GuardedCell["gripper"];
  gripperClosed = false;
  /** Stops by a person so far: a reset that began before one of them does not end it. */
  stops = 0;
  flangeFromTcp: Pose<"flange", "tcp">;
  tcp: (q_rad: ArrayLike<number>, out: Pose<"base", "tcp">) => Pose<"base", "tcp">;
  bound_mps: number;
  readonly changes = listeners<GuardState>();
  readonly notices = listeners<Refusal>();
  // A link that never was cannot be lost: silence counts from the first sample.
  state: GuardState;
  heard_s = Infinity;
  alive_s: number;
  because: Refusal | null = null;
  manual = false;
  /** Wanted override, and the part of it that the cap leaves in this move. */
  percent = 100;
  capped = 1;
  applied = 100;
  // What is known of the motion: latest angles, where it would stand if stopped now, the last pose that was safe with
  // room to stop.
  readonly forecast: StopForecast;
  readonly q_rad: Float64Array;
  readonly ahead_rad: Float64Array;
  readonly between_rad: Float64Array;
  planned: PathAhead | null = null;
  straight: PathAhead | null = null;
  readonly safe_rad: Float64Array;
  time_s = NaN;
  leaving = false;
  touchedAtStart: readonly string[] = [];
  tip = identity<"base", "tcp">();
  tipBefore = identity<"base", "tcp">();
  readonly unsubscribe: () => void;
  looked_s: number;
  readonly stopWatching: () => void;

  constructor(options: GuardOptions) {
    this.options = options;
    this.controller = this.options.controller;
    this.scheduler = this.options.scheduler;
    this.place = this.options.place;
    this.robot = this.controller.robot;
    this.jumpTo = this.controller.jumpTo;
    this.n = this.robot.arm.joints.length;
    this.rules = { deadMan: this.options.deadMan ?? this.controller.kind !== "virtual" };
    this.isSafe = this.options.isSafe ?? (() => true);
    const silence = this.options.silence_s ?? 0.06;
    this.silence_s = typeof silence === "number" ? (): number => silence : silence;
    this.delay_s = this.options.linkDelay_s ?? 0;
    this.cap_mps = this.options.manualCap_mps ?? MANUAL_CAP_MPS;
    this.braking_s =
      this.options.brakingTime_s ??
      (this.controller.kind === "virtual" ? hardBrakingTime_s(this.robot) : brakingTime_s(this.robot));
    this.flangeFromTcp = this.options.flangeFromTcp ?? identity<"flange", "tcp">();
    this.tcp = tcpOf(this.robot.arm, this.flangeFromTcp);
    this.bound_mps = speedBound(this.robot, this.flangeFromTcp);
    this.state = { ...AT_FIRST, watching: this.options.watching ?? false };
    this.alive_s = this.scheduler.now_s();
    this.forecast = new StopForecast(this.robot, this.controller.jointAngles(), this.braking_s, this.delay_s);
    this.q_rad = this.forecast.q_rad;
    this.ahead_rad = this.forecast.ahead_rad;
    this.between_rad = new Float64Array(this.n);
    this.safe_rad = Float64Array.from(this.q_rad);
    this.unsubscribe = this.controller.onSample(this.watch);
    this.looked_s = this.scheduler.now_s();
    this.stopWatching = this.scheduler.every(WATCH_S, () => {
      const now_s = this.scheduler.now_s();
      const late_s = now_s - this.looked_s - WATCH_S;
      this.looked_s = now_s;
      if (late_s > HELD_UP_S) {
        this.heard_s = Math.min(now_s, this.heard_s + late_s);
        this.alive_s = Math.min(now_s, this.alive_s + late_s);
      }
      if (this.state.link === "lost") return;
      if (now_s - this.heard_s > this.silence_s()) {
        this.notice(this.silent(now_s - this.heard_s));
        this.send({ type: "link-lost" });
        return;
      }
      const { heartbeat_s } = this.options;
      const { holder } = this.state;
      if (
        heartbeat_s !== undefined &&
        holder !== null &&
        this.state.link === "up" &&
        now_s - this.alive_s > heartbeat_s
      ) {
        this.notice(commanderWentSilent(holder, now_s - this.alive_s));
        this.send({ type: "link-lost" });
      }
    });
  }

  /** Only when it changes: an override set at the pendant is not overwritten by the way. */
  applySpeed(): CommandOutcome {
    const wanted = this.percent * (this.manual ? this.capped : 1);
    if (wanted === this.applied) return DONE;
    const outcome = this.controller.setSpeed(wanted);
    if (outcome.kind === "done") this.applied = wanted;
    return outcome;
  }

  send(event: GuardEvent): Refusal | null {
    const answer = guardStep(this.state, event, this.rules);
    const changed = answer.state !== this.state;
    const holder = this.state.holder;
    this.state = answer.state;
    for (const effect of answer.effects) {
      if (effect === "stop") this.controller.stop();
      else if (effect === "emergency-stop") this.controller.stop(true);
      else if (effect === "return") void this.goBack();
    }
    if (changed) this.changes.call(this.state);
    return answer.denied ? denialRefusal(answer.denied, this.robot.name, holder) : null;
  }

  notice(why: Refusal): void {
    this.because = why;
    this.notices.call(why);
  }

  async goBack(): Promise<void> {
    // The cell may have changed since that pose was safe.
    if (!this.isSafe(this.safe_rad)) {
      this.notice(nowhereSafe);
      this.send({ type: "ended" });
      return;
    }
    this.capped = this.cappedFor(this.safe_rad);
    this.applySpeed();
    const outcome = await this.controller.moveJoints(Float64Array.from(this.safe_rad));
    if (outcome.kind !== "done") this.send({ type: "stop", emergency: false });
    this.send({ type: "ended" });
    this.capped = 1;
    this.applySpeed();
  }

  cappedFor(target_rad: ArrayLike<number> | null): number {
    const speed_mps = target_rad
      ? jointMoveSpeed(this.robot, this.q_rad, target_rad, this.flangeFromTcp)
      : this.bound_mps;
    return speed_mps > this.cap_mps ? this.cap_mps / speed_mps : 1;
  }

  /** Asks, then lets the robot do it, then says how it ended and why. */
  async command(
    who: string,
    target_rad: ArrayLike<number> | null,
    go: () => Promise<CommandOutcome>,
  ): Promise<CommandOutcome> {
    const why =
      this.watchedOnly() ??
      (target_rad
        ? (jointRefusal(this.robot, target_rad) ??
          this.pointRefusal(target_rad) ??
          this.place?.targetRefusal(target_rad) ??
          null)
        : null);
    if (why) return refused(why);
    const denied = this.send({ type: "ask", who });
    if (denied) return refused(denied);
    this.because = null;
    this.beginLeaving();
    this.place?.begin();
    this.straight = target_rad
      ? new PathAhead(new StraightPath(this.controller.jointAngles(), target_rad), this.n)
      : null;
    this.capped = this.cappedFor(target_rad);
    this.applySpeed();
    let outcome: CommandOutcome | null = null;
    try {
      outcome = await go();
    } finally {
      // A driver that throws leaves nobody to say what the robot does: it is stopped.
      if (!outcome) {
        this.send({ type: "stop", emergency: false });
        this.send({ type: "ended" });
      }
    }
    this.straight = null;
    const reason: Refusal | null = this.because;
    if (this.state.motion !== "returning") {
      this.capped = 1;
      this.applySpeed();
    }
    this.send({ type: "ended" });
    return outcome.kind === "stopped" && reason ? { kind: "stopped", why: reason } : outcome;
  }

  /** A robot that stands too near to something may go away from there. */
  beginLeaving(): void {
    this.leaving = !this.isSafe(this.q_rad);
    this.touchedAtStart = this.leaving ? (this.contactsAt?.(this.q_rad) ?? []) : [];
  }

  readonly addsNone = (at_rad: Float64Array): boolean =>
    this.contactsAt?.(at_rad).every(pair => this.touchedAtStart.includes(pair)) ?? true;

  /** Whether it would come to rest without anything on the way there, if it were stopped now. */
  freeAhead(isFree: (at_rad: Float64Array) => boolean): boolean {
    const path = this.state.motion === "moving" ? (this.planned ?? this.straight) : null;
    const seen = path?.look(this.q_rad, this.ahead_rad, this.forecast.reach_s, isFree) ?? "off";
    if (seen !== "off") return seen === "free";
    let most_rad = 0;
    for (let i = 0; i < this.n; i++) most_rad = Math.max(most_rad, Math.abs(this.ahead_rad[i]! - this.q_rad[i]!));
    const looks = Math.min(MOST_LOOKS, Math.max(1, Math.ceil(most_rad / LOOK_RAD)));
    // The far end first: what is in the way is met there first.
    for (let look = looks; look > 0; look--) {
      for (let i = 0; i < this.n; i++)
        this.between_rad[i] = this.q_rad[i]! + (look / looks) * (this.ahead_rad[i]! - this.q_rad[i]!);
      if (!isFree(this.between_rad)) return false;
    }
    return true;
  }

  readonly jumped = (): void => {
    this.forecast.standAt(this.controller.jointAngles());
    // Speeds of the tool are measured from one sample to the next.
    this.tcp(this.q_rad, this.tip);
  };

  readonly lookAgain = (): void => {
    this.planned?.forget();
    this.straight?.forget();
  };

  watchedOnly(): Refusal | null {
    return this.state.watching ? denialRefusal("watching", this.robot.name, null) : null;
  }

  silent(silent_s: number): Refusal {
    return (this.state.watching ? watchedLinkDown : linkWentDown)(this.robot.name, silent_s);
  }

  readonly pointRefusal = (target_rad: ArrayLike<number>): Refusal | null => {
    return jointRefusal(this.robot, target_rad) ?? (this.isSafe(Float64Array.from(target_rad)) ? null : targetTooNear);
  };

  /** In manual mode the tool is no faster than its cap. */
  private watchSpeed(dt_s: number): void {
    const speed_mps = distance(this.tip.position, this.tipBefore.position) / dt_s;
    if (speed_mps > SPEED_SLACK * this.cap_mps) {
      this.notice(tooFast(speed_mps, this.cap_mps));
      this.send({ type: "stop", emergency: false });
    }
  }
  /** A robot that stood too near may only go away from there. */
  private watchLeaving(here: boolean): void {
    this.leaving = !here;
    if (!this.leaving) this.lookAgain();
    if (!this.leaving || this.state.motion !== "moving" || (this.addsNone(this.q_rad) && this.freeAhead(this.addsNone)))
      return;
    this.notice(cameTooNear);
    this.send({ type: "too-near" });
  }

  /** Looks at one sample: link, clearance here and where a stop would end, speed of the tool. */
  readonly watch = (lent: JointSample): void => {
    this.heard_s = this.scheduler.now_s();
    if (this.state.link === "lost") this.send({ type: "link-back" });
    const dt_s = lent.time_s - this.time_s;
    const known = dt_s > 0;
    this.manual = lent.mode === "manual";
    this.forecast.take(lent, dt_s);
    this.time_s = lent.time_s;
    if (lent.gripperClosed !== this.gripperClosed) {
      ({ gripperClosed: this.gripperClosed } = lent);
      this.gripper?.(this.gripperClosed, this.q_rad);
      this.lookAgain();
    }
    [this.tip, this.tipBefore] = [this.tipBefore, this.tip];
    this.tcp(this.q_rad, this.tip);
    const underWay = this.state.motion === "moving" || this.state.motion === "returning";
    if (underWay && this.manual && known) this.watchSpeed(dt_s);
    if (this.place) {
      this.place.guarded = this.state.motion !== "at-rest";
      this.place.tell(this.q_rad, this.ahead_rad);
      const near = underWay ? this.place.tooNear() : null;
      if (near) {
        this.notice(near);
        this.send({ type: "stop", emergency: false });
      }
    }
    const here = this.isSafe(this.q_rad);
    if (this.leaving) {
      this.watchLeaving(here);
      return;
    }
    const kept =
      here &&
      (!underWay ||
        ((!lent.target_rad || this.isSafe(lent.target_rad as Float64Array)) && this.freeAhead(this.isSafe)));
    if (kept) {
      if (this.state.trip === "none") this.safe_rad.set(this.q_rad);
      return;
    }
    if (this.state.motion === "moving") {
      this.notice(cameTooNear);
      this.send({ type: "too-near" });
    }
  };

  /** Lines of a robot that is only watched are read; who writes one is told. */
  linesOf(signals: Signals): Signals {
    return {
      read: signal => signals.read(signal),
      write: (signal, value) => {
        const why = this.watchedOnly();
        if (why) this.notices.call(why);
        else signals.write(signal, value);
      },
    };
  }

  act(event: GuardEvent): CommandOutcome {
    const denied = this.send(event);
    return denied ? refused(denied) : DONE;
  }

  halt(emergency: boolean): void {
    this.stops++;
    this.send({ type: "stop", emergency });
  }
  readonly seat = (who: string): Commander => {
    return {
      name: who,
      acquireLease: () => {
        this.alive_s = this.scheduler.now_s();
        return this.act({ type: "take", who });
      },
      releaseLease: () => {
        if (this.state.holder === who && this.state.motion === "moving") this.because = leaseGivenBack;
        return this.act({ type: "release", who });
      },
      setEnabled: pressed => {
        if (!pressed && this.rules.deadMan && this.state.holder === who && this.state.motion === "moving")
          this.because = switchLetGo;
        return this.act({ type: pressed ? "press" : "let-go", who });
      },
      watch: on => {
        if (on && this.state.holder === who && this.state.motion === "moving") this.because = leaseGivenBack;
        return this.act({ type: "watch", who, on });
      },
      readiness: () => {
        const { denied } = guardStep(this.state, { type: "ask", who }, this.rules);
        return denied ? denialRefusal(denied, this.robot.name, this.state.holder) : null;
      },
      acknowledge: () => {
        this.alive_s = this.scheduler.now_s();
        return this.act({ type: "confirm", who });
      },
      alive: () => {
        if (this.state.holder === who) this.alive_s = this.scheduler.now_s();
      },
      robot: this.robotOf(who),
    };
  };

  /** The controller as one who commands it sees it. */
  private robotOf(who: string): RobotController {
    const { jumpTo } = this;
    return {
      kind: this.controller.kind,
      name: this.controller.name,
      robot: this.robot,
      ...(this.controller.signals === undefined ? {} : { signals: this.linesOf(this.controller.signals) }),
      onSample: listen => this.controller.onSample(listen),
      close: () => {
        this.act({ type: "release", who });
      },
      isMoving: () => this.controller.isMoving(),
      jointAngle: joint => this.controller.jointAngle(joint),
      jointAngles: out => this.controller.jointAngles(out),
      setSpeed: to => {
        const why =
          percentRefusal(to) ??
          this.watchedOnly() ??
          (this.state.holder === who
            ? null
            : denialRefusal(
                this.state.holder === null ? "no-lease" : "lease-taken",
                this.robot.name,
                this.state.holder,
              ));
        if (why) return refused(why);
        this.percent = to;
        return this.applySpeed();
      },
      moveJoint: async (joint, angle_rad) => {
        const why = jointNumberRefusal(this.robot, joint);
        if (why) return refused(why);
        const target_rad = this.controller.jointAngles();
        target_rad[joint - 1] = angle_rad;
        return this.command(who, target_rad, () => this.controller.moveJoint(joint, angle_rad));
      },
      moveJoints: target_rad => {
        const target = Float64Array.from(target_rad);
        return this.command(who, target, () => this.controller.moveJoints(target));
      },
      moveToPose: baseFromFlange => this.command(who, null, () => this.controller.moveToPose(baseFromFlange)),
      moveToZero: () => this.command(who, new Float64Array(this.n), () => this.controller.moveToZero()),
      run: (steps, context) => this.command(who, null, () => this.controller.run(steps, context)),
      cannotCarryOut: step => this.controller.cannotCarryOut(step),
      stop: emergency => {
        this.halt(emergency ?? false);
      },
      reset: async () => {
        const watched = this.watchedOnly();
        if (watched) return refused(watched);
        // Whether it may is asked before the controller is told: its drives would be on already.
        const { denied } = guardStep(this.state, { type: "reset", who }, this.rules);
        if (denied) return refused(denialRefusal(denied, this.robot.name, this.state.holder));
        const before = this.stops;
        const outcome = await this.controller.reset();
        if (outcome.kind !== "done") return outcome;
        // The lease may be another's by now, which `act` asks; a stop that came meanwhile stays in force.
        return before === this.stops ? this.act({ type: "reset", who }) : refused(stoppedInReset(this.robot));
      },
      ...(jumpTo
        ? {
            jumpTo: (target_rad: ArrayLike<number>): CommandOutcome => {
              const why = this.watchedOnly() ?? this.pointRefusal(target_rad) ?? this.send({ type: "ask", who });
              if (why) return refused(why);
              const outcome = jumpTo(target_rad);
              if (outcome.kind === "done") this.jumped();
              this.send({ type: "ended" });
              return outcome;
            },
          }
        : {}),
    };
  }
}

function guardOf(own: GuardedController): Guard {
  const guard: Guard = {
    get state() {
      return own.state;
    },
    seat: own.seat,
    stop(emergency = false) {
      own.halt(emergency);
    },
    linkLost(why) {
      if (own.state.link !== "lost") {
        own.notice(why ?? own.silent(own.scheduler.now_s() - Math.min(own.heard_s, own.scheduler.now_s())));
        own.send({ type: "link-lost" });
      }
    },
    follow(path) {
      own.planned = path && new PathAhead(path, own.n);
    },
    lookAgain: own.lookAgain,
    jumped: own.jumped,
    setCell(cell) {
      own.lookAgain();
      ({ isSafe: own.isSafe, contactsAt: own.contactsAt, gripper: own.gripper } = cell);
      if (own.gripperClosed) own.gripper?.(true, own.q_rad);
      own.flangeFromTcp = cell.flangeFromTcp ?? identity<"flange", "tcp">();
      own.tcp = tcpOf(own.robot.arm, own.flangeFromTcp);
      own.bound_mps = speedBound(own.robot, own.flangeFromTcp);
      // Speeds of the tool are measured from one sample to the next: not from the old tool to the new.
      own.tcp(own.q_rad, own.tip);
      if (own.state.trip === "none" && own.isSafe(own.q_rad)) own.safe_rad.set(own.q_rad);
      // What stands too near because something was put there may be led away from it.
      if (own.state.motion === "at-rest") own.beginLeaving();
    },
    pointRefusal: own.pointRefusal,
    onChange: listen => own.changes.add(listen),
    onNotice: listen => own.notices.add(listen),
    close() {
      if (own.state.motion !== "at-rest") own.controller.stop();
      own.unsubscribe();
      own.place?.leave();
      own.stopWatching();
      own.changes.clear();
      own.notices.clear();
    },
  };
  return guard;
}
