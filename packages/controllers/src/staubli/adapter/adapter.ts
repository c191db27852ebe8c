import type { CommandOutcome, JointSample, Refusal, Robot, Scheduler } from "@twincell/core";
import { DONE, refused, stopped } from "../../outcomes.ts";
import type { ControllerAdapter, AdapterEvents, AdapterMotion, AdapterOrder, Opened } from "../../driver/index.ts";
import type { ByteStream, Network } from "../../transport/index.ts";
import {
  AXES,
  COMM,
  FEEDBACK_PORT,
  MESSAGE,
  MessageReader,
  MOTION_PORT,
  noPoint,
  noStatus,
  pointBytes,
  readJoints,
  readPoint,
  readStatus,
  REPLY,
  SEQUENCE,
  type Message,
} from "../codec.ts";
import { JOINTS, speaksSimpleMessage } from "../robots.ts";
import { isByHand, modeOf, safetyOf, sentenceOf } from "./state.ts";
import {
  beyond,
  closedHere,
  lostPower,
  moreJoints,
  noAcceleration,
  noPath,
  noPower,
  noSignals,
  notReached,
  notTaken,
  otherCount,
  otherZero,
  saysNothing,
  stoodShort,
  wasStopped,
} from "./words.ts";

export interface StaubliAdapterOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly ports?: { readonly motion?: number; readonly feedback?: number };
  /** Joint angles come every 20 ms. */
  readonly stale_s?: number;
}
type Lent = { -readonly [K in keyof Omit<JointSample, "step">]: Omit<JointSample, "step">[K] };
/** One motion: said, braked for another speed, held, or stopped. */
interface Moving {
  readonly motion: AdapterMotion;
  readonly resolve: (outcome: CommandOutcome) => void;
  sequence: number;
  sent_s: number;
  saidBy: "nobody" | "us" | "taken";
  braking: boolean;
  ending: CommandOutcome | null;
  statuses: number;
  stood_s: number;
}

const NOT_YET = 0;
const STALE_S = 0.08;
const FIRST_S = 4;
const PATIENCE_S = 2;
const SHORT_S = 5;
/** At its target a 32-bit number is this near, and an arm that has settled is near enough [rad]. */
const THERE_RAD = 1e-6;
const NEAR_RAD = 2e-4;
const NEAR_S = 0.3;
/** Between two states a standing arm turns less [rad]. */
const STANDS_RAD = 2e-6;
/** The program takes a share of exactly 0.001 for something else, and none of 0 or below. */
const LEAST_RATIO = 0.002;
/**
 * A point without speed, which the program refuses and answers: so long is the way there and back, and the socket of
 * the motions is alive. It names where the robot stands, and is sent only while it does: a program that took it all the
 * same would move nothing.
 */
const PROBE = -9;
const PROBE_S = 0.5;
/** A robot that stands so far beyond its limits is another one [rad]. */
const BEYOND_RAD = 0.02;

/** As a 32-bit number that is not beyond a limit on which the angle stands. */
function within(
  q_rad: number,
  { lower_rad, upper_rad }: { readonly lower_rad: number; readonly upper_rad: number },
): number {
  const said = Math.fround(q_rad);
  return said > upper_rad ? Math.fround(q_rad - STEP_RAD) : said < lower_rad ? Math.fround(q_rad + STEP_RAD) : said;
}
/** From one 32-bit number below 8 to the next. */
const STEP_RAD = 2 ** -21;

/** A joint point is all that the protocol says. */
function cannotSay(order: AdapterOrder): Refusal | null {
  if (order.kind === "signal" || order.kind === "gripper") return noSignals;
  if (order.path !== "joints") return noPath(order.path === "line" ? "A straight line" : "An arc");
  return order.acceleration < 1 ? noAcceleration : null;
}

/**
 * A CS8 or CS9 over simple_message: joint angles 50 times a second, a status with every fifth, motions one joint point
 * at a time. A stop makes the program forget all motions. It has no override: another speed, or a hold, brakes the
 * motion and says the rest of it again. Whenever power, chain or mode take the robot away, the stack is emptied:
 * nothing goes on when they come back.
 */
export function createStaubliAdapter(options: StaubliAdapterOptions): ControllerAdapter {
  const { robot, scheduler, network, host } = options;
  const status = noStatus();
  const raw = new Float64Array(AXES);
  const before_rad = new Float64Array(JOINTS).fill(NaN);
  const answer = noPoint();
  const lent: Lent = {
    sequence: 0,
    time_s: 0,
    q_rad: new Float64Array(JOINTS),
    moving: false,
    mode: "manual",
    safety: "normal",
    override: 1,
    gripperClosed: false,
    message: "",
  };
  let motionLine: ByteStream | null = null;
  let feedback: ByteStream | null = null;
  let events: AdapterEvents | null = null;
  let life = 0;
  let statuses = 0;
  let states = 0;
  let moving: Moving | null = null;
  let ratio = 1;
  let left = false;
  let locked = false;
  let next = NOT_YET + 1;
  let halts = 0;
  let begun_s = 0;
  let probed_s = 0;
  let isProbing = false;
  let onState: (() => void) | null = null;

  const settle = (outcome: CommandOutcome): void => {
    const ended = moving;
    moving = null;
    ended?.resolve(outcome);
  };
  const send = (sequence: number, q_rad: ArrayLike<number> | null, velocity: number, duration_s: number): void => {
    const point = { ...noPoint(), sequence, velocity, duration_s };
    if (q_rad) for (let i = 0; i < JOINTS; i++) point.q_rad[i] = within(q_rad[i]!, robot.arm.joints[i]!.limits);
    motionLine?.send(pointBytes(point, COMM.request, REPLY.none));
  };
  const halt = (): void => {
    halts++;
    send(SEQUENCE.stop, null, 0, 0);
  };
  function say(at: Moving): void {
    const { motion } = at;
    at.sent_s = at.stood_s = scheduler.now_s();
    at.saidBy = "us";
    at.braking = false;
    // A point on the heels of a stop would be forgotten with the others: it follows the answer.
    at.sequence = halts > 0 ? NOT_YET : next++;
    if (at.sequence === NOT_YET) return;
    send(
      at.sequence,
      motion.q_rad,
      Math.max(LEAST_RATIO, motion.path === "joints" ? motion.ratio * ratio : 0),
      motion.duration_s,
    );
  }

  function close(): void {
    life++;
    left ||= moving !== null;
    for (const stream of [motionLine, feedback]) stream?.close();
    motionLine = feedback = null;
    events = null;
    onState = null;
    states = statuses = halts = 0;
    isProbing = false;
    before_rad.fill(NaN);
    settle(stopped(closedHere));
  }
  function lose(sentence: string): void {
    const told = events;
    close();
    told?.lost(sentence);
  }
  function listen(to: ByteStream, mine: number, take: (message: Message) => void): void {
    const reader = new MessageReader();
    to.onEnd(({ sentence }) => {
      if (mine === life) lose(sentence);
    });
    to.onBytes(bytes => {
      if (mine !== life) return;
      const why = reader.push(bytes, message => {
        if (!message.fits) {
          lose(
            `A message of type ${message.type} came with the length of another: the controller runs another version of the program.`,
          );
          return false;
        }
        take(message);
        return mine === life;
      });
      if (why && mine === life) lose(why);
    });
  }

  function onReply(message: Message): void {
    if (message.type !== MESSAGE.point || message.comm !== COMM.reply) return;
    const at = moving;
    readPoint(message, answer);
    if (answer.sequence === PROBE) {
      events?.roundTrip(scheduler.now_s() - probed_s);
      isProbing = false;
      return;
    }
    if (answer.sequence === SEQUENCE.stop) {
      halts = Math.max(0, halts - 1);
      if (halts === 0 && at?.saidBy === "us" && at.sequence === NOT_YET) say(at);
      return;
    }
    if (!at || answer.sequence !== at.sequence || at.saidBy !== "us") return;
    events?.roundTrip(scheduler.now_s() - at.sent_s);
    if (message.reply !== REPLY.success) {
      settle(refused(notTaken));
      return;
    }
    at.saidBy = "taken";
    at.statuses = statuses;
    at.stood_s = scheduler.now_s();
  }
  function onFeedback(message: Message): void {
    if (message.type === MESSAGE.status) {
      readStatus(message, status);
      statuses++;
      // Lost power keeps motions in the controller's stack; they are not to go on when it is back.
      const why = sentenceOf(status);
      if (moving && !moving.ending && (why !== "" || isByHand(status))) {
        end(moving, stopped(lostPower(why !== "" ? why : "The robot was switched to manual mode.")));
      }
      onState?.();
      return;
    }
    if (message.type !== MESSAGE.joints) return;
    readJoints(message, raw);
    states++;
    for (let i = 0; i < JOINTS; i++) lent.q_rad[i] = raw[i]!;
    const stands = lent.q_rad.every((value, i) => Math.abs(value - before_rad[i]!) < STANDS_RAD);
    before_rad.set(lent.q_rad);
    look(stands);
    lent.sequence++;
    lent.time_s = scheduler.now_s() - begun_s;
    lent.mode = modeOf(status);
    lent.safety = safetyOf(status, locked);
    lent.message = sentenceOf(status);
    lent.moving = !stands || (moving !== null && !moving.braking && moving.saidBy !== "nobody");
    onState?.();
    events?.sample(lent);
    if (events) probe(stands);
  }
  function probe(stands: boolean): void {
    const t = scheduler.now_s();
    if (isProbing && t - probed_s > PATIENCE_S) lose(`The socket of the motions has not answered for ${PATIENCE_S} s.`);
    else if (!isProbing && stands && !moving && t - probed_s > PROBE_S) {
      isProbing = true;
      probed_s = t;
      send(PROBE, lent.q_rad, 0, 0);
    }
  }

  /** Where the motion under way is, with every state that comes. */
  function look(stands: boolean): void {
    const at = moving;
    const t = scheduler.now_s();
    if (!at) return;
    if (!stands) {
      at.stood_s = t;
      return;
    }
    if (at.braking) {
      if (at.ending) settle(at.ending);
      else if (ratio > 0) say(at);
      else at.saidBy = "nobody";
      return;
    }
    if (at.saidBy === "us" && t - at.sent_s > PATIENCE_S) {
      lose(`A point was not answered within ${PATIENCE_S} s.`);
      return;
    }
    if (at.saidBy !== "taken" || status.moving || statuses === at.statuses) return;
    let away_rad = 0;
    for (let i = 0; i < JOINTS; i++) away_rad = Math.max(away_rad, Math.abs(lent.q_rad[i]! - at.motion.q_rad[i]!));
    if (away_rad < THERE_RAD) {
      settle(DONE);
      return;
    }
    const isNear = away_rad < NEAR_RAD && t - at.stood_s > NEAR_S;
    if (!isNear && t - at.stood_s <= SHORT_S) return;
    // Held at its pendant it may still have a little to go.
    end(at, isNear ? DONE : stopped(stoodShort(SHORT_S)));
  }
  function brake(at: Moving): void {
    at.braking = true;
    // Two states that are the same, both from after it.
    before_rad.fill(NaN);
    halt();
  }
  /** Over as soon as it stands and nothing is left in the controller's stack. */
  function end(at: Moving, outcome: CommandOutcome): void {
    at.ending = outcome;
    brake(at);
  }

  async function connect(port: number, mine: number): Promise<ByteStream | Refusal> {
    const connected = await network.connect({ host, port });
    if (connected.kind === "refused") return notReached(connected.sentence);
    if (mine !== life) {
      connected.stream.close();
      return closedHere;
    }
    return connected.stream;
  }
  async function open(to: AdapterEvents): Promise<Opened> {
    close();
    const mine = life;
    const fail = (why: Refusal, again: boolean): Opened => {
      if (mine === life) close();
      return { kind: "failed", why, again };
    };
    if (robot.arm.joints.length !== JOINTS) return fail(otherCount(robot), false);
    if (!speaksSimpleMessage(robot)) return fail(otherZero(robot), false);
    const states_ = await connect(options.ports?.feedback ?? FEEDBACK_PORT, mine);
    if ("code" in states_) return fail(states_, true);
    feedback = states_;
    listen(states_, mine, onFeedback);
    const orders = await connect(options.ports?.motion ?? MOTION_PORT, mine);
    if ("code" in orders) return fail(orders, true);
    motionLine = orders;
    listen(orders, mine, onReply);
    // What was on its way when the line broke is not to go on; what others started is theirs.
    if (left) halt();
    left = false;
    begun_s = scheduler.now_s();
    // The program waits for a second before it tells anything.
    await new Promise<void>(resolve => {
      const stop = scheduler.every(FIRST_S, () => {
        over();
      });
      const over = (): void => {
        stop();
        onState = null;
        resolve();
      };
      onState = () => {
        if (states > 0 && statuses > 0) over();
      };
    });
    if (mine !== life) return { kind: "failed", why: closedHere, again: true };
    if (states === 0 || statuses === 0) return fail(saysNothing(FIRST_S), true);
    for (let i = JOINTS; i < AXES; i++) if (raw[i] !== 0) return fail(moreJoints(robot, i + 1), false);
    const joints = robot.arm.joints;
    const odd = joints.findIndex(
      ({ limits }, i) =>
        lent.q_rad[i]! < limits.lower_rad - BEYOND_RAD || lent.q_rad[i]! > limits.upper_rad + BEYOND_RAD,
    );
    if (odd >= 0) return fail(beyond(robot, odd + 1, lent.q_rad[odd]!), false);
    events = to;
    return { kind: "open" };
  }

  return {
    brand: "Stäubli",
    robot,
    stale_s: options.stale_s ?? STALE_S,
    open,
    close,
    watchdog: {
      kind: "none",
      because:
        "The VAL 3 program stops the robot as soon as one of its connections is closed, but a cable that is pulled closes none for minutes: streamed motion is refused.",
    },
    cannotSay,
    move(motion) {
      const why = motionLine ? cannotSay(motion) : closedHere;
      if (why) return Promise.resolve(refused(why));
      return new Promise(resolve => {
        moving = {
          motion,
          resolve,
          sequence: 0,
          sent_s: scheduler.now_s(),
          saidBy: "nobody",
          braking: false,
          ending: null,
          statuses,
          stood_s: scheduler.now_s(),
        };
        if (ratio > 0) say(moving);
        else moving.braking = true;
      });
    },
    stop(emergency) {
      if (emergency) locked = true;
      if (moving) end(moving, stopped(wasStopped(robot)));
      else halt();
    },
    setOverride(to) {
      if (to === ratio) return null;
      ratio = lent.override = to;
      if (moving && !moving.ending && !moving.braking) brake(moving);
      return null;
    },
    reset() {
      const why = sentenceOf(status);
      if (why !== "") return Promise.resolve(refused(noPower(why)));
      locked = false;
      return Promise.resolve(DONE);
    },
    setSignal: () => noSignals,
    setGripper: () => noSignals,
  };
}
