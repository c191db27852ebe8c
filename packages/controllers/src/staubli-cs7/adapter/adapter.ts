import {
  sectionForDriver,
  type CommandOutcome,
  type JointSample,
  type Refusal,
  type Robot,
  type Scheduler,
  axesOfJoints,
  jointsOfAxes,
} from "@twincell/core";
import { stoppedInReset } from "../../refusals.ts";
import { DONE, refused, stopped } from "../../outcomes.ts";
import type { ControllerAdapter, AdapterEvents, AdapterMotion, AdapterOrder, Opened } from "../../driver/index.ts";
import type { Network } from "../../transport/index.ts";
import {
  errorOf,
  LINE_PORT,
  POINT,
  pointText,
  PROGRAM,
  readValues,
  readWhere,
  STATE,
  TASK,
  TWC,
  JOINTS,
} from "../codec.ts";
import { openLine, type Line } from "./line.ts";
import {
  beyond,
  closedHere,
  noArc,
  noLine,
  noReset,
  notReached,
  otherCount,
  saidNo,
  saysNothing,
  stateWords,
  stoodShort,
  taken,
  unknownJoints,
  wasStopped,
} from "./words.ts";

export interface Cs7FaceOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly port?: number;
  /** States are asked for this often, as far as the line can carry it [s]. */
  readonly period_s?: number;
  readonly stale_s?: number;
  /** Of a serial line to the controller's terminal; a network's when left out. */
  readonly baud?: number;
}
type Lent = { -readonly [K in keyof Omit<JointSample, "step">]: Omit<JointSample, "step">[K] };
interface Moving {
  readonly motion: AdapterMotion;
  readonly resolve: (outcome: CommandOutcome) => void;
  id: number;
  begun: boolean;
  over: boolean;
  held: boolean;
  ending: CommandOutcome | null;
  looks: number;
  stood_s: number;
}

const PERIOD_S = 0.02;
const STALE_S = 0.08;
const PATIENCE_S = 4;
const SHORT_S = 1;
const BEYOND_RAD = 0.02;
const STANDS_DEG = 0.0015;
/** Letters of one poll, both ways, ten bits each; so many polls may be missed before the line counts as lost. */
const POLL_LETTERS = 340;
const LETTER_BITS = 10;
const MISSED = 2.5;
const QUESTION = `LISTR STATE(1),STATE(2),${TWC.done}`;

const OUTPUT = /^out_([1-9][0-9]{0,2})$/;

function cannotSay(order: AdapterOrder): Refusal | null {
  if (order.kind === "signal")
    return OUTPUT.test(order.signal) && typeof order.value === "boolean" ? null : noLine(order.signal);
  return order.kind !== "gripper" && order.path === "arc" ? noArc : null;
}

/**
 * A CS7 by the monitor of its V+: joints by WHERE, its state and the number of the last motion by LISTR, motions by the
 * program TWC.MOVE in a task of its own, so that the monitor stays free. An emergency stop takes high power off
 * (PANIC). A hold brakes the motion and says it again.
 */
export function createCs7Adapter(options: Cs7FaceOptions): ControllerAdapter {
  const stale_s =
    options.stale_s ??
    Math.max(
      STALE_S,
      4 * (options.period_s ?? PERIOD_S),
      options.baud === undefined ? 0 : (MISSED * POLL_LETTERS * LETTER_BITS) / options.baud,
    );
  const { robot, scheduler, network, host } = options;
  const joints = sectionForDriver(robot, "staubli-cs7");
  const period_s = options.period_s ?? PERIOD_S;
  const j_deg = new Float64Array(JOINTS).fill(NaN);
  const values = new Map<string, boolean | number>();
  const known = new Map<string, number>();
  const lent: Lent = {
    sequence: 0,
    time_s: 0,
    q_rad: new Float64Array(JOINTS),
    moving: false,
    mode: "remote",
    safety: "normal",
    override: 1,
    gripperClosed: false,
    message: "",
    signals: values,
  };
  let line: Line | null = null;
  let events: AdapterEvents | null = null;
  let stopPolling: (() => void) | null = null;
  let life = 0;
  let polling = false;
  let state: number = STATE.powerOff;
  let motion = 0;
  let done = 0;
  let next = 1;
  let begun_s = 0;
  let moving: Moving | null = null;
  let ratio = 1;
  let left = false;
  let locked = false;
  let resetting = false;
  let aside = "";

  const settle = (outcome: CommandOutcome): void => {
    const ended = moving;
    moving = null;
    ended?.resolve(outcome);
  };
  function close(): void {
    life++;
    left ||= moving !== null;
    stopPolling?.();
    stopPolling = null;
    line?.close();
    line = null;
    events = null;
    polling = false;
    known.clear();
    j_deg.fill(NaN);
    settle(stopped(closedHere));
  }
  function lose(sentence: string): void {
    const told = events;
    close();
    told?.lost(sentence);
  }
  const halt = (): void => {
    void line?.ask("DO BRAKE");
    void line?.ask(`ABORT ${TASK}`);
  };

  /** Null, or the error that one of the lines was answered with. */
  async function tell(commands: readonly string[]): Promise<string | null> {
    for (const lines of await Promise.all(commands.map(command => line?.ask(command) ?? Promise.resolve(null)))) {
      if (!lines) return "*no answer*";
      const error = errorOf(lines.slice(1));
      if (error !== "") return error;
    }
    return null;
  }
  /** Reals are said again only when they change: a slow line has other things to carry. */
  const reals = (wanted: readonly (readonly [string, number])[]): string[] =>
    wanted
      .filter(([name, value]) => known.get(name) !== value)
      .map(([name, value]) => {
        known.set(name, value);
        return `DO ${name} = ${value}`;
      });
  async function say(at: Moving): Promise<void> {
    const mine = life;
    const { motion: wanted } = at;
    const isLine = wanted.path !== "joints";
    const shown = axesOfJoints(joints!, wanted.q_rad, new Float64Array(JOINTS));
    at.id = next++;
    at.begun = at.over = at.held = false;
    aside = "";
    const speed = isLine ? 1000 * wanted.speed_mps : Math.max(0.01, 100 * wanted.ratio);
    const error =
      (await tell([
        ...reals([
          [TWC.line, isLine ? -1 : 0],
          [TWC.speed, Number(speed.toFixed(3))],
          [TWC.accel, Math.max(1, Math.round(100 * wanted.acceleration))],
          [TWC.id, at.id],
        ]),
        `DO SET ${POINT} = ${pointText(shown)}`,
      ])) ??
      (mine === life && moving === at && !at.ending && !at.held ? await tell([`EXECUTE ${TASK} ${PROGRAM}`]) : null);
    if (mine !== life || moving !== at) return;
    if (error !== null) {
      known.clear();
      settle(refused(saidNo(error)));
      return;
    }
    at.begun = true;
    at.stood_s = scheduler.now_s();
    // A stop that came while the lines were on their way may have come before the motion.
    if (at.ending || at.held) halt();
  }
  function end(at: Moving, outcome: CommandOutcome): void {
    at.ending = outcome;
    at.looks = 0;
    halt();
  }

  /** Where the motion under way is, with every state that comes. */
  function look(stands: boolean): void {
    const at = moving;
    const t = scheduler.now_s();
    if (!at) return;
    if (!stands) {
      at.stood_s = t;
      at.looks = 0;
      return;
    }
    if (at.ending) {
      if (++at.looks > 1) settle(at.ending);
      return;
    }
    if (at.held) {
      if (ratio > 0 && ++at.looks > 1) void say(at);
      return;
    }
    if (!at.begun) return;
    if (at.over) settle(DONE);
    else if (motion !== 1 && t - at.stood_s > SHORT_S) end(at, stopped(stoodShort(aside)));
  }
  function understand(where: readonly string[], listed: readonly string[]): boolean {
    const at_deg = readWhere(where);
    const [first, second, last] = readValues(listed);
    if (at_deg?.length !== JOINTS || first === undefined || second === undefined || last === undefined) return false;
    let stands = true;
    for (let i = 0; i < JOINTS; i++) {
      stands &&= Math.abs(at_deg[i]! - j_deg[i]!) < STANDS_DEG;
      j_deg[i] = at_deg[i]!;
    }
    state = first;
    motion = second;
    done = last;
    if (resetting && state === STATE.program) {
      resetting = locked = false;
    }
    const words = stateWords(state);
    if (moving && !moving.ending && words !== "") end(moving, stopped(taken(words)));
    if (moving?.begun && done === moving.id) moving.over = true;
    look(stands);
    jointsOfAxes(joints!, j_deg, lent.q_rad);
    lent.sequence++;
    lent.time_s = scheduler.now_s() - begun_s;
    lent.mode = state === STATE.manual ? "manual" : "remote";
    lent.safety = locked
      ? "emergency-stop"
      : state === STATE.program || state === STATE.manual
        ? "normal"
        : "protective-stop";
    lent.message = words;
    lent.moving = !stands || (moving !== null && !moving.held && !moving.ending);
    return true;
  }
  function poll(mine: number): void {
    if ((line?.waited_s ?? 0) > PATIENCE_S) {
      lose(`A command was not answered within ${PATIENCE_S} s.`);
      return;
    }
    if (polling) return;
    polling = true;
    // What is listed is from before the joints: an end that is told was reached in them.
    void Promise.all([line?.ask(QUESTION) ?? null, line?.ask("WHERE") ?? null]).then(([listed, where]) => {
      if (mine !== life) return;
      polling = false;
      if (listed && where && understand(where, listed)) events?.sample(lent);
    });
  }

  async function open(to: AdapterEvents): Promise<Opened> {
    close();
    const mine = life;
    const fail = (why: Refusal, again: boolean): Opened => {
      if (mine === life) close();
      return { kind: "failed", why, again };
    };
    if (robot.arm.joints.length !== JOINTS) return fail(otherCount(robot, JOINTS), false);
    if (!joints) return fail(unknownJoints(robot), false);
    const connected = await network.connect({ host, port: options.port ?? LINE_PORT });
    if (connected.kind === "refused") return fail(notReached(connected.sentence), true);
    if (mine !== life) {
      connected.stream.close();
      return fail(closedHere, true);
    }
    const own = openLine(connected.stream, scheduler, {
      roundTrip(seconds) {
        events?.roundTrip(seconds);
      },
      aside(lines) {
        const error = errorOf(lines);
        if (error !== "") aside = error;
      },
      lost(sentence) {
        if (mine === life) lose(sentence);
      },
    });
    line = own;
    let late = false;
    const stop = scheduler.every(PATIENCE_S, () => {
      stop();
      late = true;
      own.close();
    });
    // What was on its way when the line broke is not to go on; what others started is theirs.
    if (left) halt();
    left = false;
    await tell([`DO ${TWC.done} = 0`]);
    const [listed, where] = await Promise.all([own.ask(QUESTION), own.ask("WHERE")]);
    stop();
    if (mine !== life && !late) return { kind: "failed", why: closedHere, again: true };
    if (!listed || !where) return fail(saysNothing(PATIENCE_S), true);
    const count = readWhere(where)?.length ?? 0;
    if (count !== JOINTS)
      return count === 0 ? fail(saysNothing(PATIENCE_S), true) : fail(otherCount(robot, count), false);
    begun_s = scheduler.now_s();
    if (!understand(where, listed)) return fail(saysNothing(PATIENCE_S), true);
    const limits = robot.arm.joints;
    const odd = limits.findIndex(
      ({ limits: { lower_rad, upper_rad } }, i) =>
        lent.q_rad[i]! < lower_rad - BEYOND_RAD || lent.q_rad[i]! > upper_rad + BEYOND_RAD,
    );
    if (odd >= 0) return fail(beyond(robot, odd + 1, lent.q_rad[odd]!), false);
    await tell([`SPEED ${Math.max(1, Math.round(100 * ratio))}`]);
    if (mine !== life) return { kind: "failed", why: closedHere, again: true };
    events = to;
    stopPolling = scheduler.every(period_s, () => {
      poll(mine);
    });
    return { kind: "open" };
  }

  return {
    brand: "Stäubli CS7",
    robot,
    stale_s,
    open,
    close,
    watchdog: {
      kind: "none",
      because: `The monitor has no watchdog: a motion that was started goes on to its end when the line breaks, and streamed motion is refused.${stale_s > STALE_S ? ` Over this slow line a break is noticed after ${stale_s.toFixed(1)} s and not within 100 ms.` : ""}`,
    },
    cannotSay,
    move(wanted) {
      if (!line) return Promise.resolve(refused(closedHere));
      const why = cannotSay(wanted);
      if (why) return Promise.resolve(refused(why));
      return new Promise(resolve => {
        moving = {
          motion: wanted,
          resolve,
          id: 0,
          begun: false,
          over: false,
          held: ratio === 0,
          ending: null,
          looks: 0,
          stood_s: scheduler.now_s(),
        };
        if (ratio > 0) void say(moving);
      });
    },
    stop(emergency) {
      if (emergency) {
        locked = true;
        resetting = false;
        void line?.ask("PANIC");
      }
      if (moving) end(moving, stopped(wasStopped(robot)));
      else halt();
    },
    setOverride(to) {
      if (to === ratio) return null;
      ratio = lent.override = to;
      if (to > 0) void line?.ask(`SPEED ${Math.max(1, Math.round(100 * to))}`);
      else if (moving && !moving.ending) {
        moving.held = true;
        moving.looks = 0;
        halt();
      }
      return null;
    },
    async reset(wanted) {
      if (state === STATE.notCalibrated || state === STATE.fatal || state === STATE.manual)
        return refused(noReset(stateWords(state)));
      const error = await tell(["ENABLE POWER"]);
      if (error !== null) return refused(noReset(`The controller refused: ${error}`));
      if (!wanted()) return refused(stoppedInReset(robot));
      resetting = true;
      return DONE;
    },
    setSignal(signal, value) {
      const why = cannotSay({ kind: "signal", signal, value });
      if (why) return why;
      void line?.ask(`SIGNAL ${value ? "" : "-"}${OUTPUT.exec(signal)![1]}`);
      values.set(signal, value);
      return null;
    },
    setGripper(closed) {
      void line?.ask(closed ? "DO CLOSEI" : "DO OPENI");
      lent.gripperClosed = closed;
      return null;
    },
  };
}
