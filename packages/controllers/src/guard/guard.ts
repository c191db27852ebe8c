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
} from "@twincell/core";
import type { CellMember } from "../cell/index.ts";
import { listeners } from "../listeners.ts";
import { jointNumberRefusal, jointRefusal, percentRefusal, stoppedInReset } from "../refusals.ts";
import { PathAhead, StraightPath, type KnownPath } from "./known-path.ts";
import { jointMoveSpeed, speedBound, tcpOf } from "./speed.ts";
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

export interface GuardOptions {
  /** The robot behind the guard. Nothing else may command it. */
  readonly controller: RobotController;
  readonly scheduler: Scheduler;
  /**
   * Motion only while the commander keeps a switch pressed. Robots that are not virtual need it unless told otherwise.
   */
  readonly deadMan?: boolean;
  /** Whether the clearance margin is kept at those joint angles; asked for targets and along the motion. */
  readonly isSafe?: (q_rad: Float64Array) => boolean;
  /**
   * Without a sample for this long the link counts as lost. With the watch's own period it stays below 100 ms (row
   *
   */
  readonly silence_s?: number | (() => number);
  /** When given, the commander must call `alive` at least this often. */
  readonly heartbeat_s?: number;
  /** Longest time the robot needs to stop; how far ahead the clearance is looked at follows from it. */
  readonly brakingTime_s?: number;
  /**
   * On top of the guard's own reaction: how old samples are and how long a stop is under way, over the link to the
   * controller [s].
   */
  readonly linkDelay_s?: number;
  readonly flangeFromTcp?: Pose<"flange", "tcp">;
  /** The other robots of the cell; see `createSharedCell`. */
  readonly place?: CellMember;
  /** Begins as one that is only watched; see `Seat.watch`. */
  readonly watching?: boolean;
  /** Speed of the tool in manual mode. */
  readonly manualCap_mps?: number;
}

/** What a guard asks of a cell, and the tool whose speed it measures. */
export interface GuardedCell {
  readonly isSafe: (q_rad: Float64Array) => boolean;
  /** The pairs that touch: a motion that begins too near to something is stopped before it adds one. */
  readonly contactsAt?: (q_rad: Float64Array) => readonly string[];
  /** Told when the gripper closes or opens, and where: what it holds moves with the flange. */
  readonly gripper?: (closed: boolean, q_rad: Float64Array) => void;
  readonly flangeFromTcp?: Pose<"flange", "tcp">;
}

/** One who may command: mouse, headset, gamepad, server. */
export interface Commander {
  readonly name: string;
  /** Takes the motion lease. One at a time has it. */
  acquireLease(): CommandOutcome;
  releaseLease(): CommandOutcome;
  /** The enabling switch: pressed or let go. */
  setEnabled(pressed: boolean): CommandOutcome;
  /** A person's word that motion is wanted again, after a lost link or beside an obstacle. */
  acknowledge(): CommandOutcome;
  /** Only to look at what others do with the robot, or to command it again. While it is watched only a stop is sent. */
  watch(on: boolean): CommandOutcome;
  /** Why a command would be turned down now; nothing is sent and nothing changes. */
  readiness(): Refusal | null;
  /** Sign of life, where heartbeats are asked for. */
  alive(): void;
  /** The robot as this seat may command it. */
  readonly robot: RobotController;
}

export interface Guard {
  readonly state: GuardState;
  seat(name: string): Commander;
  /** Anyone may stop. */
  stop(emergency?: boolean): void;
  /** Who keeps the link knows that it is gone, maybe before it was silent for long, and maybe back before that. */
  linkLost(why?: Refusal): void;
  /**
   * The path of the motion that begins now, as a plan knows it; null when it is over. As long as the robot is on it,
   * that is where it is looked ahead, and not where its joints happen to point.
   */
  follow(path: KnownPath | null): void;
  /** What was safe on the way ahead may not be any more: something is carried now that was not, or the reverse. */
  lookAgain(): void;
  /** A virtual robot was put where it stands now without moving there: that is no speed, and no way ahead. */
  jumped(): void;
  /** The cell or the tool is another from now on; what moves is judged by it from its next sample on. */
  setCell(cell: GuardedCell): void;
  /** Why a point may not be added to a program (row T-42); null when it may. */
  pointRefusal(q_rad: ArrayLike<number>): Refusal | null;
  onChange(listen: (state: GuardState) => void): () => void;
  /** What the guard did on its own, in words. */
  onNotice(listen: (why: Refusal) => void): () => void;
  close(): void;
}

/** To be shown wherever the guard's state is shown. */
export const GUARD_NOTICE =
  "Not a certified safety function: it may refuse or stop a motion, it can never guarantee one.";

const WATCH_S = 0.02;
/**
 * A look that comes later than this was held up by its own thread [s]. What was sent meanwhile waits to be read: nobody
 * listened, so it is no silence, and it is counted from there on. Nothing can be told to the robot either in that time;
 * its own watchdog counts on.
 */
const HELD_UP_S = 0.05;
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
  const { controller, scheduler, place } = options;
  const { robot, jumpTo } = controller;
  const n = robot.arm.joints.length;
  const rules = { deadMan: options.deadMan ?? controller.kind !== "virtual" };
  let isSafe = options.isSafe ?? (() => true);
  const silence = options.silence_s ?? 0.06;
  const silence_s = typeof silence === "number" ? (): number => silence : silence;
  const delay_s = options.linkDelay_s ?? 0;
  const cap_mps = options.manualCap_mps ?? MANUAL_CAP_MPS;
  // Of a robot that nobody knows, it is not said that it brakes as hard as it can.
  const braking_s =
    options.brakingTime_s ?? (controller.kind === "virtual" ? hardBrakingTime_s(robot) : brakingTime_s(robot));
  let contactsAt: GuardedCell["contactsAt"];
  let gripper: GuardedCell["gripper"];
  let gripperClosed = false;
  /** Stops by a person so far: a reset that began before one of them does not end it. */
  let stops = 0;
  let flangeFromTcp = options.flangeFromTcp ?? identity<"flange", "tcp">();
  let tcp = tcpOf(robot.arm, flangeFromTcp);
  let bound_mps = speedBound(robot, flangeFromTcp);
  const changes = listeners<GuardState>();
  const notices = listeners<Refusal>();

  // A link that never was cannot be lost: silence counts from the first sample.
  let state: GuardState = { ...AT_FIRST, watching: options.watching ?? false };
  let heard_s = Infinity;
  let alive_s = scheduler.now_s();
  let because: Refusal | null = null;
  let manual = false;
  /** Wanted override, and the part of it that the cap leaves in this move. */
  let percent = 100;
  let capped = 1;
  let applied = 100;
  // What is known of the motion: latest angles, where it would stand if stopped now, the last pose that was safe with
  // room to stop.
  const forecast = new StopForecast(robot, controller.jointAngles(), braking_s, delay_s);
  const { q_rad, ahead_rad } = forecast;
  const between_rad = new Float64Array(n);
  let planned: PathAhead | null = null;
  let straight: PathAhead | null = null;
  const safe_rad = Float64Array.from(q_rad);
  let time_s = NaN;
  let leaving = false;
  let touchedAtStart: readonly string[] = [];
  let tip = identity<"base", "tcp">();
  let tipBefore = identity<"base", "tcp">();

  /** Only when it changes: an override set at the pendant is not overwritten by the way. */
  function applySpeed(): CommandOutcome {
    const wanted = percent * (manual ? capped : 1);
    if (wanted === applied) return DONE;
    const outcome = controller.setSpeed(wanted);
    if (outcome.kind === "done") applied = wanted;
    return outcome;
  }

  function send(event: GuardEvent): Refusal | null {
    const answer = guardStep(state, event, rules);
    const changed = answer.state !== state;
    const holder = state.holder;
    state = answer.state;
    for (const effect of answer.effects) {
      if (effect === "stop") controller.stop();
      else if (effect === "emergency-stop") controller.stop(true);
      else if (effect === "return") void goBack();
    }
    if (changed) changes.call(state);
    return answer.denied ? denialRefusal(answer.denied, robot.name, holder) : null;
  }
  function notice(why: Refusal): void {
    because = why;
    notices.call(why);
  }

  async function goBack(): Promise<void> {
    // The cell may have changed since that pose was safe.
    if (!isSafe(safe_rad)) {
      notice(nowhereSafe);
      send({ type: "ended" });
      return;
    }
    capped = cappedFor(safe_rad);
    applySpeed();
    const outcome = await controller.moveJoints(Float64Array.from(safe_rad));
    if (outcome.kind !== "done") send({ type: "stop", emergency: false });
    send({ type: "ended" });
    capped = 1;
    applySpeed();
  }

  const cappedFor = (target_rad: ArrayLike<number> | null): number => {
    const speed_mps = target_rad ? jointMoveSpeed(robot, q_rad, target_rad, flangeFromTcp) : bound_mps;
    return speed_mps > cap_mps ? cap_mps / speed_mps : 1;
  };

  /** Asks, then lets the robot do it, then says how it ended and why. */
  async function command(
    who: string,
    target_rad: ArrayLike<number> | null,
    go: () => Promise<CommandOutcome>,
  ): Promise<CommandOutcome> {
    const why =
      watchedOnly() ??
      (target_rad
        ? (jointRefusal(robot, target_rad) ?? pointRefusal(target_rad) ?? place?.targetRefusal(target_rad) ?? null)
        : null);
    if (why) return refused(why);
    const denied = send({ type: "ask", who });
    if (denied) return refused(denied);
    because = null;
    beginLeaving();
    place?.begin();
    straight = target_rad ? new PathAhead(new StraightPath(controller.jointAngles(), target_rad), n) : null;
    capped = cappedFor(target_rad);
    applySpeed();
    let outcome: CommandOutcome | null = null;
    try {
      outcome = await go();
    } finally {
      // A driver that throws leaves nobody to say what the robot does: it is stopped.
      if (!outcome) {
        send({ type: "stop", emergency: false });
        send({ type: "ended" });
      }
    }
    straight = null;
    const reason: Refusal | null = because;
    if (state.motion !== "returning") {
      capped = 1;
      applySpeed();
    }
    send({ type: "ended" });
    return outcome.kind === "stopped" && reason ? { kind: "stopped", why: reason } : outcome;
  }

  /** A robot that stands too near to something may go away from there. */
  function beginLeaving(): void {
    leaving = !isSafe(q_rad);
    touchedAtStart = leaving ? (contactsAt?.(q_rad) ?? []) : [];
  }
  const addsNone = (at_rad: Float64Array): boolean =>
    contactsAt?.(at_rad).every(pair => touchedAtStart.includes(pair)) ?? true;

  /** Whether it would come to rest without anything on the way there, if it were stopped now. */
  function freeAhead(isFree: (at_rad: Float64Array) => boolean): boolean {
    const path = state.motion === "moving" ? (planned ?? straight) : null;
    const seen = path?.look(q_rad, ahead_rad, forecast.reach_s, isFree) ?? "off";
    if (seen !== "off") return seen === "free";
    let most_rad = 0;
    for (let i = 0; i < n; i++) most_rad = Math.max(most_rad, Math.abs(ahead_rad[i]! - q_rad[i]!));
    const looks = Math.min(MOST_LOOKS, Math.max(1, Math.ceil(most_rad / LOOK_RAD)));
    // The far end first: what is in the way is met there first.
    for (let look = looks; look > 0; look--) {
      for (let i = 0; i < n; i++) between_rad[i] = q_rad[i]! + (look / looks) * (ahead_rad[i]! - q_rad[i]!);
      if (!isFree(between_rad)) return false;
    }
    return true;
  }
  const lookAgain = (): void => {
    planned?.forget();
    straight?.forget();
  };
  const jumped = (): void => {
    forecast.standAt(controller.jointAngles());
    // Speeds of the tool are measured from one sample to the next.
    tcp(q_rad, tip);
  };

  const watchedOnly = (): Refusal | null => (state.watching ? denialRefusal("watching", robot.name, null) : null);
  const silent = (silent_s: number): Refusal => (state.watching ? watchedLinkDown : linkWentDown)(robot.name, silent_s);

  function pointRefusal(target_rad: ArrayLike<number>): Refusal | null {
    return jointRefusal(robot, target_rad) ?? (isSafe(Float64Array.from(target_rad)) ? null : targetTooNear);
  }

  /** Looks at one sample: link, clearance here and where a stop would end, speed of the tool. */
  function watch(lent: JointSample): void {
    heard_s = scheduler.now_s();
    if (state.link === "lost") send({ type: "link-back" });
    const dt_s = lent.time_s - time_s;
    const known = dt_s > 0;
    manual = lent.mode === "manual";
    forecast.take(lent, dt_s);
    time_s = lent.time_s;
    if (lent.gripperClosed !== gripperClosed) {
      ({ gripperClosed } = lent);
      gripper?.(gripperClosed, q_rad);
      lookAgain();
    }
    [tip, tipBefore] = [tipBefore, tip];
    tcp(q_rad, tip);
    const underWay = state.motion === "moving" || state.motion === "returning";
    if (underWay && manual && known) {
      const speed_mps = distance(tip.position, tipBefore.position) / dt_s;
      if (speed_mps > SPEED_SLACK * cap_mps) {
        notice(tooFast(speed_mps, cap_mps));
        send({ type: "stop", emergency: false });
      }
    }
    if (place) {
      place.guarded = state.motion !== "at-rest";
      place.tell(q_rad, ahead_rad);
      const near = underWay ? place.tooNear() : null;
      if (near) {
        notice(near);
        send({ type: "stop", emergency: false });
      }
    }
    const here = isSafe(q_rad);
    if (leaving) {
      leaving = !here;
      if (!leaving) lookAgain();
      if (!leaving || state.motion !== "moving" || (addsNone(q_rad) && freeAhead(addsNone))) return;
      notice(cameTooNear);
      send({ type: "too-near" });
      return;
    }
    const kept =
      here && (!underWay || ((!lent.target_rad || isSafe(lent.target_rad as Float64Array)) && freeAhead(isSafe)));
    if (kept) {
      if (state.trip === "none") safe_rad.set(q_rad);
      return;
    }
    if (state.motion === "moving") {
      notice(cameTooNear);
      send({ type: "too-near" });
    }
  }

  const unsubscribe = controller.onSample(watch);
  let looked_s = scheduler.now_s();
  const stopWatching = scheduler.every(WATCH_S, () => {
    const now_s = scheduler.now_s();
    const late_s = now_s - looked_s - WATCH_S;
    looked_s = now_s;
    if (late_s > HELD_UP_S) {
      heard_s = Math.min(now_s, heard_s + late_s);
      alive_s = Math.min(now_s, alive_s + late_s);
    }
    if (state.link === "lost") return;
    if (now_s - heard_s > silence_s()) {
      notice(silent(now_s - heard_s));
      send({ type: "link-lost" });
      return;
    }
    const { heartbeat_s } = options;
    const { holder } = state;
    if (heartbeat_s !== undefined && holder !== null && state.link === "up" && now_s - alive_s > heartbeat_s) {
      notice(commanderWentSilent(holder, now_s - alive_s));
      send({ type: "link-lost" });
    }
  });

  /** Lines of a robot that is only watched are read; who writes one is told. */
  const linesOf = (signals: Signals): Signals => ({
    read: signal => signals.read(signal),
    write(signal, value) {
      const why = watchedOnly();
      if (why) notices.call(why);
      else signals.write(signal, value);
    },
  });

  const act = (event: GuardEvent): CommandOutcome => {
    const denied = send(event);
    return denied ? refused(denied) : DONE;
  };

  function seat(who: string): Commander {
    return {
      name: who,
      acquireLease() {
        alive_s = scheduler.now_s();
        return act({ type: "take", who });
      },
      releaseLease() {
        if (state.holder === who && state.motion === "moving") because = leaseGivenBack;
        return act({ type: "release", who });
      },
      setEnabled(pressed) {
        if (!pressed && rules.deadMan && state.holder === who && state.motion === "moving") because = switchLetGo;
        return act({ type: pressed ? "press" : "let-go", who });
      },
      watch(on) {
        if (on && state.holder === who && state.motion === "moving") because = leaseGivenBack;
        return act({ type: "watch", who, on });
      },
      readiness() {
        const { denied } = guardStep(state, { type: "ask", who }, rules);
        return denied ? denialRefusal(denied, robot.name, state.holder) : null;
      },
      acknowledge() {
        alive_s = scheduler.now_s();
        return act({ type: "confirm", who });
      },
      alive() {
        if (state.holder === who) alive_s = scheduler.now_s();
      },
      robot: {
        kind: controller.kind,
        name: controller.name,
        robot,
        ...(controller.signals === undefined ? {} : { signals: linesOf(controller.signals) }),
        onSample: listen => controller.onSample(listen),
        close: () => {
          act({ type: "release", who });
        },
        isMoving: () => controller.isMoving(),
        jointAngle: joint => controller.jointAngle(joint),
        jointAngles: out => controller.jointAngles(out),
        setSpeed(to) {
          const why =
            percentRefusal(to) ??
            watchedOnly() ??
            (state.holder === who
              ? null
              : denialRefusal(state.holder === null ? "no-lease" : "lease-taken", robot.name, state.holder));
          if (why) return refused(why);
          percent = to;
          return applySpeed();
        },
        async moveJoint(joint, angle_rad) {
          const why = jointNumberRefusal(robot, joint);
          if (why) return refused(why);
          const target_rad = controller.jointAngles();
          target_rad[joint - 1] = angle_rad;
          return command(who, target_rad, () => controller.moveJoint(joint, angle_rad));
        },
        moveJoints(target_rad) {
          const target = Float64Array.from(target_rad);
          return command(who, target, () => controller.moveJoints(target));
        },
        moveToPose: baseFromFlange => command(who, null, () => controller.moveToPose(baseFromFlange)),
        moveToZero: () => command(who, new Float64Array(n), () => controller.moveToZero()),
        run: (steps, context) => command(who, null, () => controller.run(steps, context)),
        cannotCarryOut: step => controller.cannotCarryOut(step),
        stop: emergency => {
          guard.stop(emergency);
        },
        async reset() {
          const watched = watchedOnly();
          if (watched) return refused(watched);
          // Whether it may is asked before the controller is told: its drives would be on already.
          const { denied } = guardStep(state, { type: "reset", who }, rules);
          if (denied) return refused(denialRefusal(denied, robot.name, state.holder));
          const before = stops;
          const outcome = await controller.reset();
          if (outcome.kind !== "done") return outcome;
          // The lease may be another's by now, which `act` asks; a stop that came meanwhile stays in force.
          return before === stops ? act({ type: "reset", who }) : refused(stoppedInReset(robot));
        },
        ...(jumpTo
          ? {
              jumpTo(target_rad: ArrayLike<number>): CommandOutcome {
                const why = watchedOnly() ?? pointRefusal(target_rad) ?? send({ type: "ask", who });
                if (why) return refused(why);
                const outcome = jumpTo(target_rad);
                if (outcome.kind === "done") jumped();
                send({ type: "ended" });
                return outcome;
              },
            }
          : {}),
      },
    };
  }

  const guard: Guard = {
    get state() {
      return state;
    },
    seat,
    stop(emergency = false) {
      stops++;
      send({ type: "stop", emergency });
    },
    linkLost(why) {
      if (state.link !== "lost") {
        notice(why ?? silent(scheduler.now_s() - Math.min(heard_s, scheduler.now_s())));
        send({ type: "link-lost" });
      }
    },
    follow(path) {
      planned = path && new PathAhead(path, n);
    },
    lookAgain,
    jumped,
    setCell(cell) {
      lookAgain();
      ({ isSafe, contactsAt, gripper } = cell);
      if (gripperClosed) gripper?.(true, q_rad);
      flangeFromTcp = cell.flangeFromTcp ?? identity<"flange", "tcp">();
      tcp = tcpOf(robot.arm, flangeFromTcp);
      bound_mps = speedBound(robot, flangeFromTcp);
      // Speeds of the tool are measured from one sample to the next: not from the old tool to the new.
      tcp(q_rad, tip);
      if (state.trip === "none" && isSafe(q_rad)) safe_rad.set(q_rad);
      // What stands too near because something was put there may be led away from it.
      if (state.motion === "at-rest") beginLeaving();
    },
    pointRefusal,
    onChange: listen => changes.add(listen),
    onNotice: listen => notices.add(listen),
    close() {
      if (state.motion !== "at-rest") controller.stop();
      unsubscribe();
      place?.leave();
      stopWatching();
      changes.clear();
      notices.clear();
    },
  };
  return guard;
}
