import type { CommandOutcome, JointSample, Refusal, Robot, Scheduler } from "@twincell/core";
import { DONE, refused, stopped } from "../../outcomes.ts";
import {
  DriverStates,
  type ControllerAdapter,
  type AdapterEvents,
  type AdapterMotion,
  type AdapterOrder,
  type Opened,
} from "../../driver/index.ts";
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
} from "../codec/simple-message.ts";
import { JOINTS, speaksSimpleMessage } from "../codec/robots.ts";
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
  return staubliAdapterOf(new StaubliWire(options));
}

class StaubliWire extends DriverStates<Moving> {
  protected readonly closedBecause = closedHere;
  readonly options: StaubliAdapterOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly status = noStatus();
  readonly raw = new Float64Array(AXES);
  readonly before_rad = new Float64Array(JOINTS).fill(NaN);
  readonly answer = noPoint();
  readonly lent: Lent = {
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
  motionLine: ByteStream | null = null;
  feedback: ByteStream | null = null;
  statuses = 0;
  states = 0;
  ratio = 1;
  left = false;
  locked = false;
  next = NOT_YET + 1;
  halts = 0;
  begun_s = 0;
  probed_s = 0;
  isProbing = false;
  onState: (() => void) | null = null;

  constructor(options: StaubliAdapterOptions) {
    super();
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
  }

  send(sequence: number, q_rad: ArrayLike<number> | null, velocity: number, duration_s: number): void {
    const point = { ...noPoint(), sequence, velocity, duration_s };
    if (q_rad) for (let i = 0; i < JOINTS; i++) point.q_rad[i] = within(q_rad[i]!, this.robot.arm.joints[i]!.limits);
    this.motionLine?.send(pointBytes(point, COMM.request, REPLY.none));
  }

  halt(): void {
    this.halts++;
    this.send(SEQUENCE.stop, null, 0, 0);
  }

  say(at: Moving): void {
    const { motion } = at;
    at.sent_s = at.stood_s = this.scheduler.now_s();
    at.saidBy = "us";
    at.braking = false;
    // A point on the heels of a stop would be forgotten with the others: it follows the answer.
    at.sequence = this.halts > 0 ? NOT_YET : this.next++;
    if (at.sequence === NOT_YET) return;
    this.send(
      at.sequence,
      motion.q_rad,
      Math.max(LEAST_RATIO, motion.path === "joints" ? motion.ratio * this.ratio : 0),
      motion.duration_s,
    );
  }

  protected release(): void {
    this.left ||= this.moving !== null;
    for (const stream of [this.motionLine, this.feedback]) stream?.close();
    this.motionLine = this.feedback = null;
    this.onState = null;
    this.states = this.statuses = this.halts = 0;
    this.isProbing = false;
    this.before_rad.fill(NaN);
  }

  listen(to: ByteStream, isMine: () => boolean, take: (message: Message) => void): void {
    const reader = new MessageReader();
    to.onEnd(({ sentence }) => {
      if (isMine()) this.lose(sentence);
    });
    to.onBytes(bytes => {
      if (!isMine()) return;
      const why = reader.push(bytes, message => {
        if (!message.fits) {
          this.lose(
            `A message of type ${message.type} came with the length of another: the controller runs another version of the program.`,
          );
          return false;
        }
        take(message);
        return isMine();
      });
      if (why && isMine()) this.lose(why);
    });
  }

  readonly onReply = (message: Message): void => {
    if (message.type !== MESSAGE.point || message.comm !== COMM.reply) return;
    const at = this.moving;
    readPoint(message, this.answer);
    if (this.answer.sequence === PROBE) {
      this.events?.roundTrip(this.scheduler.now_s() - this.probed_s);
      this.isProbing = false;
      return;
    }
    if (this.answer.sequence === SEQUENCE.stop) {
      this.halts = Math.max(0, this.halts - 1);
      if (this.halts === 0 && at?.saidBy === "us" && at.sequence === NOT_YET) this.say(at);
      return;
    }
    if (!at || this.answer.sequence !== at.sequence || at.saidBy !== "us") return;
    this.events?.roundTrip(this.scheduler.now_s() - at.sent_s);
    if (message.reply !== REPLY.success) {
      this.settle(refused(notTaken));
      return;
    }
    at.saidBy = "taken";
    at.statuses = this.statuses;
    at.stood_s = this.scheduler.now_s();
  };

  readonly onFeedback = (message: Message): void => {
    if (message.type === MESSAGE.status) {
      readStatus(message, this.status);
      this.statuses++;
      // Lost power keeps motions in the controller's stack; they are not to go on when it is back.
      const why = sentenceOf(this.status);
      if (this.moving && this.phase === "executing" && (why !== "" || isByHand(this.status))) {
        this.end(this.moving, stopped(lostPower(why !== "" ? why : "The robot was switched to manual mode.")));
      }
      this.onState?.();
      return;
    }
    if (message.type !== MESSAGE.joints) return;
    readJoints(message, this.raw);
    this.states++;
    for (let i = 0; i < JOINTS; i++) this.lent.q_rad[i] = this.raw[i]!;
    const stands = this.lent.q_rad.every((value, i) => Math.abs(value - this.before_rad[i]!) < STANDS_RAD);
    this.before_rad.set(this.lent.q_rad);
    this.look(stands);
    this.lent.sequence++;
    this.lent.time_s = this.scheduler.now_s() - this.begun_s;
    this.lent.mode = modeOf(this.status);
    this.lent.safety = safetyOf(this.status, this.locked);
    this.lent.message = sentenceOf(this.status);
    this.lent.moving = !stands || (this.moving !== null && !this.moving.braking && this.moving.saidBy !== "nobody");
    this.onState?.();
    this.events?.sample(this.lent);
    if (this.events) this.probe(stands);
  };

  probe(stands: boolean): void {
    const t = this.scheduler.now_s();
    if (this.isProbing && t - this.probed_s > PATIENCE_S)
      this.lose(`The socket of the motions has not answered for ${PATIENCE_S} s.`);
    else if (!this.isProbing && stands && !this.moving && t - this.probed_s > PROBE_S) {
      this.isProbing = true;
      this.probed_s = t;
      this.send(PROBE, this.lent.q_rad, 0, 0);
    }
  }

  /** Where the motion under way is, with every state that comes. */
  look(stands: boolean): void {
    const at = this.moving;
    const t = this.scheduler.now_s();
    if (!at) return;
    if (!stands) {
      at.stood_s = t;
      return;
    }
    if (at.braking) {
      if (this.ending) this.settle(this.ending);
      else if (this.ratio > 0) this.say(at);
      else at.saidBy = "nobody";
      return;
    }
    if (at.saidBy === "us" && t - at.sent_s > PATIENCE_S) {
      this.lose(`A point was not answered within ${PATIENCE_S} s.`);
      return;
    }
    if (at.saidBy !== "taken" || this.status.moving || this.statuses === at.statuses) return;
    let away_rad = 0;
    for (let i = 0; i < JOINTS; i++) away_rad = Math.max(away_rad, Math.abs(this.lent.q_rad[i]! - at.motion.q_rad[i]!));
    if (away_rad < THERE_RAD) {
      this.settle(DONE);
      return;
    }
    const isNear = away_rad < NEAR_RAD && t - at.stood_s > NEAR_S;
    if (!isNear && t - at.stood_s <= SHORT_S) return;
    // Held at its pendant it may still have a little to go.
    this.end(at, isNear ? DONE : stopped(stoodShort(SHORT_S)));
  }

  brake(at: Moving): void {
    at.braking = true;
    // Two states that are the same, both from after it.
    this.before_rad.fill(NaN);
    this.halt();
  }

  /** Over as soon as it stands and nothing is left in the controller's stack. */
  end(at: Moving, outcome: CommandOutcome): void {
    this.ending = outcome;
    this.brake(at);
  }

  async connect(port: number, isMine: () => boolean): Promise<ByteStream | Refusal> {
    const connected = await this.network.connect({ host: this.host, port });
    if (connected.kind === "refused") return notReached(connected.sentence);
    if (!isMine()) {
      connected.stream.close();
      return closedHere;
    }
    return connected.stream;
  }

  readonly open = async (to: AdapterEvents): Promise<Opened> => {
    const isMine = this.connecting();
    const fail = (why: Refusal, again: boolean): Opened => this.failed(isMine, why, again);
    if (this.robot.arm.joints.length !== JOINTS) return fail(otherCount(this.robot), false);
    if (!speaksSimpleMessage(this.robot)) return fail(otherZero(this.robot), false);
    const states_ = await this.connect(this.options.ports?.feedback ?? FEEDBACK_PORT, isMine);
    if ("code" in states_) return fail(states_, true);
    this.feedback = states_;
    this.listen(states_, isMine, this.onFeedback);
    const orders = await this.connect(this.options.ports?.motion ?? MOTION_PORT, isMine);
    if ("code" in orders) return fail(orders, true);
    this.motionLine = orders;
    this.listen(orders, isMine, this.onReply);
    // What was on its way when the line broke is not to go on; what others started is theirs.
    if (this.left) this.halt();
    this.left = false;
    this.begun_s = this.scheduler.now_s();
    // The program waits for a second before it tells anything.
    await new Promise<void>(resolve => {
      const stop = this.scheduler.every(FIRST_S, () => {
        over();
      });
      const over = (): void => {
        stop();
        this.onState = null;
        resolve();
      };
      this.onState = () => {
        if (this.states > 0 && this.statuses > 0) over();
      };
    });
    if (!isMine()) return { kind: "failed", why: closedHere, again: true };
    if (this.states === 0 || this.statuses === 0) return fail(saysNothing(FIRST_S), true);
    for (let i = JOINTS; i < AXES; i++) if (this.raw[i] !== 0) return fail(moreJoints(this.robot, i + 1), false);
    const joints = this.robot.arm.joints;
    const odd = joints.findIndex(
      ({ limits }, i) =>
        this.lent.q_rad[i]! < limits.lower_rad - BEYOND_RAD || this.lent.q_rad[i]! > limits.upper_rad + BEYOND_RAD,
    );
    if (odd >= 0) return fail(beyond(this.robot, odd + 1, this.lent.q_rad[odd]!), false);
    return this.ready(to);
  };
}

function staubliAdapterOf(wire: StaubliWire): ControllerAdapter {
  return {
    brand: "Stäubli",
    robot: wire.robot,
    stale_s: wire.options.stale_s ?? STALE_S,
    open: wire.open,
    close: () => {
      wire.close();
    },
    watchdog: {
      kind: "none",
      because:
        "The VAL 3 program stops the robot as soon as one of its connections is closed, but a cable that is pulled closes none for minutes: streamed motion is refused.",
    },
    cannotSay,
    move(motion) {
      const why = wire.motionLine ? cannotSay(motion) : closedHere;
      if (why) return Promise.resolve(refused(why));
      return wire.execute(
        resolve => ({
          motion,
          resolve,
          sequence: 0,
          sent_s: wire.scheduler.now_s(),
          saidBy: "nobody",
          braking: false,
          statuses: wire.statuses,
          stood_s: wire.scheduler.now_s(),
        }),
        moving => {
          if (wire.ratio > 0) wire.say(moving);
          else moving.braking = true;
        },
      );
    },
    stop(emergency) {
      if (emergency) wire.locked = true;
      if (wire.moving) wire.end(wire.moving, stopped(wasStopped(wire.robot)));
      else wire.halt();
    },
    setOverride(to) {
      if (to === wire.ratio) return null;
      wire.ratio = wire.lent.override = to;
      if (wire.moving && wire.phase === "executing" && !wire.moving.braking) wire.brake(wire.moving);
      return null;
    },
    reset() {
      const why = sentenceOf(wire.status);
      if (why !== "") return Promise.resolve(refused(noPower(why)));
      wire.locked = false;
      return Promise.resolve(DONE);
    },
    setSignal: () => noSignals,
    setGripper: () => noSignals,
  };
}
