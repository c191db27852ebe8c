import {
  sectionForDriver,
  type CommandOutcome,
  type JointSample,
  type Refusal,
  type Robot,
  type Scheduler,
  axesOfJoints,
  jointsOfAxes,
  type VendorSection,
} from "@twincell/core";
import { stoppedInReset } from "../../refusals.ts";
import { DONE, refused, stopped } from "../../outcomes.ts";
import {
  DriverStates,
  type ControllerAdapter,
  type AdapterEvents,
  type AdapterMotion,
  type AdapterOrder,
  type Opened,
} from "../../driver/index.ts";
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
} from "../codec/monitor.ts";
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
  return cs7AdapterOf(new Cs7Wire(options));
}

class Cs7Wire extends DriverStates<Moving> {
  protected readonly closedBecause = closedHere;
  readonly options: Cs7FaceOptions;
  readonly stale_s: number;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly joints: VendorSection | undefined;
  readonly period_s: number;
  readonly j_deg = new Float64Array(JOINTS).fill(NaN);
  readonly values = new Map<string, boolean | number>();
  readonly known = new Map<string, number>();
  readonly lent: Lent;
  line: Line | null = null;
  stopPolling: (() => void) | null = null;
  polling = false;
  state: number = STATE.powerOff;
  motion = 0;
  done = 0;
  next = 1;
  begun_s = 0;
  ratio = 1;
  left = false;
  locked = false;
  resetting = false;
  aside = "";

  constructor(options: Cs7FaceOptions) {
    super();
    this.options = options;
    this.stale_s =
      this.options.stale_s ??
      Math.max(
        STALE_S,
        4 * (this.options.period_s ?? PERIOD_S),
        this.options.baud === undefined ? 0 : (MISSED * POLL_LETTERS * LETTER_BITS) / this.options.baud,
      );
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.joints = sectionForDriver(this.robot, "staubli-cs7");
    this.period_s = this.options.period_s ?? PERIOD_S;
    this.lent = {
      sequence: 0,
      time_s: 0,
      q_rad: new Float64Array(JOINTS),
      moving: false,
      mode: "remote",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      message: "",
      signals: this.values,
    };
  }

  protected release(): void {
    this.left ||= this.moving !== null;
    this.stopPolling?.();
    this.stopPolling = null;
    this.line?.close();
    this.line = null;
    this.polling = false;
    this.known.clear();
    this.j_deg.fill(NaN);
  }

  halt(): void {
    void this.line?.ask("DO BRAKE");
    void this.line?.ask(`ABORT ${TASK}`);
  }

  /** Null, or the error that one of the lines was answered with. */
  async tell(commands: readonly string[]): Promise<string | null> {
    for (const lines of await Promise.all(commands.map(command => this.line?.ask(command) ?? Promise.resolve(null)))) {
      if (!lines) return "*no answer*";
      const error = errorOf(lines.slice(1));
      if (error !== "") return error;
    }
    return null;
  }

  /** Reals are said again only when they change: a slow line has other things to carry. */
  reals(wanted: readonly (readonly [string, number])[]): string[] {
    return wanted
      .filter(([name, value]) => this.known.get(name) !== value)
      .map(([name, value]) => {
        this.known.set(name, value);
        return `DO ${name} = ${value}`;
      });
  }

  async say(at: Moving): Promise<void> {
    const isMine = this.current();
    const { motion: wanted } = at;
    const isLine = wanted.path !== "joints";
    const shown = axesOfJoints(this.joints!, wanted.q_rad, new Float64Array(JOINTS));
    at.id = this.next++;
    at.begun = at.over = at.held = false;
    this.aside = "";
    const speed = isLine ? 1000 * wanted.speed_mps : Math.max(0.01, 100 * wanted.ratio);
    const error =
      (await this.tell([
        ...this.reals([
          [TWC.line, isLine ? -1 : 0],
          [TWC.speed, Number(speed.toFixed(3))],
          [TWC.accel, Math.max(1, Math.round(100 * wanted.acceleration))],
          [TWC.id, at.id],
        ]),
        `DO SET ${POINT} = ${pointText(shown)}`,
      ])) ??
      (isMine() && this.moving === at && !this.ending && !at.held
        ? await this.tell([`EXECUTE ${TASK} ${PROGRAM}`])
        : null);
    if (!isMine() || this.moving !== at) return;
    if (error !== null) {
      this.known.clear();
      this.settle(refused(saidNo(error)));
      return;
    }
    at.begun = true;
    at.stood_s = this.scheduler.now_s();
    // A stop that came while the lines were on their way may have come before the motion.
    if (this.ending || at.held) this.halt();
  }

  end(at: Moving, outcome: CommandOutcome): void {
    this.ending = outcome;
    at.looks = 0;
    this.halt();
  }

  /** Where the motion under way is, with every state that comes. */
  look(stands: boolean): void {
    const at = this.moving;
    const t = this.scheduler.now_s();
    if (!at) return;
    if (!stands) {
      at.stood_s = t;
      at.looks = 0;
      return;
    }
    if (this.ending) {
      if (++at.looks > 1) this.settle(this.ending);
      return;
    }
    if (at.held) {
      if (this.ratio > 0 && ++at.looks > 1) void this.say(at);
      return;
    }
    if (!at.begun) return;
    if (at.over) this.settle(DONE);
    else if (this.motion !== 1 && t - at.stood_s > SHORT_S) this.end(at, stopped(stoodShort(this.aside)));
  }

  understand(where: readonly string[], listed: readonly string[]): boolean {
    const at_deg = readWhere(where);
    const [first, second, last] = readValues(listed);
    if (at_deg?.length !== JOINTS || first === undefined || second === undefined || last === undefined) return false;
    let stands = true;
    for (let i = 0; i < JOINTS; i++) {
      stands &&= Math.abs(at_deg[i]! - this.j_deg[i]!) < STANDS_DEG;
      this.j_deg[i] = at_deg[i]!;
    }
    this.state = first;
    this.motion = second;
    this.done = last;
    if (this.resetting && this.state === STATE.program) {
      this.resetting = this.locked = false;
    }
    const words = stateWords(this.state);
    if (this.moving && this.phase === "executing" && words !== "") this.end(this.moving, stopped(taken(words)));
    if (this.moving?.begun && this.done === this.moving.id) this.moving.over = true;
    this.look(stands);
    jointsOfAxes(this.joints!, this.j_deg, this.lent.q_rad);
    this.lent.sequence++;
    this.lent.time_s = this.scheduler.now_s() - this.begun_s;
    this.lent.mode = this.state === STATE.manual ? "manual" : "remote";
    this.lent.safety = this.locked
      ? "emergency-stop"
      : this.state === STATE.program || this.state === STATE.manual
        ? "normal"
        : "protective-stop";
    this.lent.message = words;
    this.lent.moving = !stands || (this.moving !== null && !this.moving.held && this.phase === "executing");
    return true;
  }

  poll(isMine: () => boolean): void {
    if ((this.line?.waited_s ?? 0) > PATIENCE_S) {
      this.lose(`A command was not answered within ${PATIENCE_S} s.`);
      return;
    }
    if (this.polling) return;
    this.polling = true;
    // What is listed is from before the joints: an end that is told was reached in them.
    void Promise.all([this.line?.ask(QUESTION) ?? null, this.line?.ask("WHERE") ?? null]).then(([listed, where]) => {
      if (!isMine()) return;
      this.polling = false;
      if (listed && where && this.understand(where, listed)) this.events?.sample(this.lent);
    });
  }

  readonly open = async (to: AdapterEvents): Promise<Opened> => {
    const isMine = this.connecting();
    const fail = (why: Refusal, again: boolean): Opened => this.failed(isMine, why, again);
    if (this.robot.arm.joints.length !== JOINTS) return fail(otherCount(this.robot, JOINTS), false);
    if (!this.joints) return fail(unknownJoints(this.robot), false);
    const connected = await this.network.connect({ host: this.host, port: this.options.port ?? LINE_PORT });
    if (connected.kind === "refused") return fail(notReached(connected.sentence), true);
    if (!isMine()) {
      connected.stream.close();
      return fail(closedHere, true);
    }
    const own = openLine(connected.stream, this.scheduler, {
      roundTrip: seconds => {
        this.events?.roundTrip(seconds);
      },
      aside: lines => {
        const error = errorOf(lines);
        if (error !== "") this.aside = error;
      },
      lost: sentence => {
        if (isMine()) this.lose(sentence);
      },
    });
    this.line = own;
    let late = false;
    const stop = this.scheduler.every(PATIENCE_S, () => {
      stop();
      late = true;
      own.close();
    });
    // What was on its way when the line broke is not to go on; what others started is theirs.
    if (this.left) this.halt();
    this.left = false;
    await this.tell([`DO ${TWC.done} = 0`]);
    const [listed, where] = await Promise.all([own.ask(QUESTION), own.ask("WHERE")]);
    stop();
    if (!isMine() && !late) return { kind: "failed", why: closedHere, again: true };
    if (!listed || !where) return fail(saysNothing(PATIENCE_S), true);
    const count = readWhere(where)?.length ?? 0;
    if (count !== JOINTS)
      return count === 0 ? fail(saysNothing(PATIENCE_S), true) : fail(otherCount(this.robot, count), false);
    this.begun_s = this.scheduler.now_s();
    if (!this.understand(where, listed)) return fail(saysNothing(PATIENCE_S), true);
    const limits = this.robot.arm.joints;
    const odd = limits.findIndex(
      ({ limits: { lower_rad, upper_rad } }, i) =>
        this.lent.q_rad[i]! < lower_rad - BEYOND_RAD || this.lent.q_rad[i]! > upper_rad + BEYOND_RAD,
    );
    if (odd >= 0) return fail(beyond(this.robot, odd + 1, this.lent.q_rad[odd]!), false);
    await this.tell([`SPEED ${Math.max(1, Math.round(100 * this.ratio))}`]);
    if (!isMine()) return { kind: "failed", why: closedHere, again: true };
    this.stopPolling = this.scheduler.every(this.period_s, () => {
      this.poll(isMine);
    });
    return this.ready(to);
  };
}

function cs7AdapterOf(wire: Cs7Wire): ControllerAdapter {
  return {
    brand: "Stäubli CS7",
    robot: wire.robot,
    stale_s: wire.stale_s,
    open: wire.open,
    close: () => {
      wire.close();
    },
    watchdog: {
      kind: "none",
      because: `The monitor has no watchdog: a motion that was started goes on to its end when the line breaks, and streamed motion is refused.${wire.stale_s > STALE_S ? ` Over this slow line a break is noticed after ${wire.stale_s.toFixed(1)} s and not within 100 ms.` : ""}`,
    },
    cannotSay,
    move(wanted) {
      if (!wire.line) return Promise.resolve(refused(closedHere));
      const why = cannotSay(wanted);
      if (why) return Promise.resolve(refused(why));
      return wire.execute(
        resolve => ({
          motion: wanted,
          resolve,
          id: 0,
          begun: false,
          over: false,
          held: wire.ratio === 0,
          looks: 0,
          stood_s: wire.scheduler.now_s(),
        }),
        moving => {
          if (wire.ratio > 0) void wire.say(moving);
        },
      );
    },
    stop(emergency) {
      if (emergency) {
        wire.locked = true;
        wire.resetting = false;
        void wire.line?.ask("PANIC");
      }
      if (wire.moving) wire.end(wire.moving, stopped(wasStopped(wire.robot)));
      else wire.halt();
    },
    setOverride(to) {
      if (to === wire.ratio) return null;
      wire.ratio = wire.lent.override = to;
      if (to > 0) void wire.line?.ask(`SPEED ${Math.max(1, Math.round(100 * to))}`);
      else if (wire.moving && wire.phase === "executing") {
        wire.moving.held = true;
        wire.moving.looks = 0;
        wire.halt();
      }
      return null;
    },
    async reset(wanted) {
      if (wire.state === STATE.notCalibrated || wire.state === STATE.fatal || wire.state === STATE.manual)
        return refused(noReset(stateWords(wire.state)));
      const error = await wire.tell(["ENABLE POWER"]);
      if (error !== null) return refused(noReset(`The controller refused: ${error}`));
      if (!wanted()) return refused(stoppedInReset(wire.robot));
      wire.resetting = true;
      return DONE;
    },
    setSignal(signal, value) {
      const why = cannotSay({ kind: "signal", signal, value });
      if (why) return why;
      void wire.line?.ask(`SIGNAL ${value ? "" : "-"}${OUTPUT.exec(signal)![1]}`);
      wire.values.set(signal, value);
      return null;
    },
    setGripper(closed) {
      void wire.line?.ask(closed ? "DO CLOSEI" : "DO OPENI");
      wire.lent.gripperClosed = closed;
      return null;
    },
  };
}
