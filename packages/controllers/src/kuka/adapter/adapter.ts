import {
  axesOfJoints,
  type CommandOutcome,
  type EmittedFile,
  type UploadedProgram,
  type Refusal,
  type Robot,
  type Scheduler,
  type VendorSection,
} from "@twincell/core";
import {
  DriverStates,
  type ControllerAdapter,
  type AdapterEvents,
  type AdapterMotion,
  type AdapterOrder,
  type Opened,
} from "../../driver/index.ts";
import type { Network } from "../../transport/index.ts";
import { AXES, e6axis, e6pos, kukaAxes } from "../codec/axes.ts";
import { C3_COMMAND, C3_PORT, C3_TYPE } from "../codec/c3.ts";
import { krlReal, numberIn, textIn } from "../codec/values.ts";
import { LOOP_NAME, LOOP_VERSION, TWC, TWC_KIND, TWC_RESULT, WATCH_TIMER } from "../codec/loop.ts";
import { isKukaModel } from "../codec/models.ts";
import { C3Client } from "./client.ts";
import { KukaState, POLLED } from "./state.ts";
import { handKrl, programOf, runKrl } from "./text.ts";
import { stoppedInReset } from "../../refusals.ts";
import * as say from "./words.ts";
import { DONE, refused, stopped } from "../../outcomes.ts";

export interface KukaAdapterOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly port?: number;
  /** States are read this often [s]; 12 ms, the controller's own cycle, when left out. */
  readonly period_s?: number;
  /** What the controller calls the robot in $MODEL_NAME[], where that is not its name in the library. */
  readonly model?: string;
  /** $OUT of the gripper; TRUE closes. */
  readonly gripperOutput?: number;
  /** Lines to be read with every state: `$IN[3]`, `$OUT[1]`, `$ANIN[2]`. */
  readonly signals?: readonly string[];
  /** The robot brakes by itself when it hears nothing for so long during a motion [s]. */
  readonly watch_s?: number;
  /** Without a new state for so long the link counts as lost [s]; 80 ms, or four periods, when left out. */
  readonly stale_s?: number;
  /** The program that moves the robot for us; TWINCELL when left out. */
  readonly program?: string;
}
interface Waiting {
  readonly number: number;
  readonly resolve: (outcome: CommandOutcome) => void;
  taken: boolean;
  cancelled: boolean;
}

const OUTPUT = /^\$(OUT|ANOUT)\[([0-9]{1,4})\]$/;
/** Numbers are sent with more digits than a REAL keeps: rounding is left to the controller. */
const DIGITS = 12;
/** With the watches behind it a stop is commanded within 100 ms of the last state (row X-41) [s]. */
const STALE_S = 0.08;
/** So often is the robot's own watchdog set back in its time. */
const FEEDS = 5;
/** Asked for once, in front of the state. */
const HEAD = ["$MODEL_NAME[]", TWC.version, TWC.drivesOn, TWC.drivesOff] as const;
/** Drives that do not come on within this time do not come [s]. */
const DRIVES_S = 3;
const LOOK_S = 0.02;
/** The controller reaches the path of a program that begins where it stands within this time [s]. */
const ON_PATH_S = 0.3;

/**
 * A KUKA controller over the variables of its proxy: states by one question for all of them, motions by the globals of
 * the program TWINCELL. The protocol knows no stop, no drives and no watchdog: stop and lock are globals of that
 * program, which brakes by interrupt and whose timer is the watchdog. An emergency stop locks the program; it takes the
 * drives off where the cell has wired an output for that, and says nothing to them elsewhere.
 */
export function createKukaAdapter(options: KukaAdapterOptions): ControllerAdapter {
  return kukaAdapterOf(new KukaWire(options));
}

class KukaWire extends DriverStates<Waiting> {
  protected readonly closedBecause = say.closedHere;
  readonly options: KukaAdapterOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly axes: VendorSection | undefined;
  readonly port: number;
  readonly program: string;
  readonly period_s: number;
  readonly watch_s: number;
  readonly gripper: string;
  readonly lines: string[];
  readonly names: string[];
  client: C3Client | null = null;
  state: KukaState | null = null;
  stopPolling: (() => void) | null = null;
  types: readonly number[] = [];
  loop: Refusal | null = say.noLoop;
  polling = false;
  fed_s = 0;
  stops = 0;
  drives = { on: 0, off: 0 };
  text: { stop: () => void } | null = null;
  /** The last text that was handed over from here: where the link broke it may still be selected, and makes room. */
  handed = "";

  constructor(options: KukaAdapterOptions) {
    super();
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.axes = kukaAxes(this.robot);
    this.port = this.options.port ?? C3_PORT;
    this.program = this.options.program ?? LOOP_NAME;
    this.period_s = this.options.period_s ?? 0.012;
    this.watch_s = this.options.watch_s ?? 0.5;
    this.gripper = this.options.gripperOutput === undefined ? "" : `$OUT[${this.options.gripperOutput}]`;
    this.lines = [...new Set([...(this.options.signals ?? []), ...(this.gripper === "" ? [] : [this.gripper])])];
    this.names = [...POLLED, ...this.lines];
  }

  /** What a state means for the motion under way. */
  look(now: KukaState): void {
    if (!this.moving?.taken) return;
    if (now.done === this.moving.number) {
      switch (now.result) {
        case TWC_RESULT.done:
          this.settle(DONE);
          return;
        case TWC_RESULT.refused:
          this.settle(refused(say.refusedThere));
          return;
        case TWC_RESULT.silent:
          this.settle(stopped(say.linkSilent));
          return;
        default:
          this.settle(stopped(say.stoppedHere(this.robot)));
          return;
      }
    }
    if (now.loopRuns || now.command !== this.moving.number) return;
    // Whoever starts the program again must not find the rest of this motion in it.
    this.brake(false);
    this.settle(
      stopped(now.sample.message === "" ? say.notCarriedOut : { ...say.notCarriedOut, sentence: now.sample.message }),
    );
  }

  poll(mine: C3Client, now: KukaState, events: AdapterEvents): void {
    const at_s = this.scheduler.now_s();
    if (this.moving?.taken && at_s - this.fed_s >= this.watch_s / FEEDS - 1e-9 && !mine.isCrowded) {
      this.fed_s = at_s;
      void mine.ask({
        kind: "write",
        wide: true,
        name: `$TIMER[${WATCH_TIMER}]`,
        value: String(-Math.round(1000 * this.watch_s)),
      });
    }
    if (this.polling || mine.isCrowded) return;
    this.polling = true;
    void mine.ask({ kind: "read-many", names: this.names }).then(reply => {
      this.polling = false;
      if (this.client !== mine || reply?.kind !== "values") return;
      if (now.take(reply.items, this.scheduler.now_s()) !== true) return;
      this.look(now);
      events.sample(now.sample);
    });
  }

  brake(emergency: boolean): void {
    const pairs: (readonly [string, string])[] = [[TWC.stop, "TRUE"]];
    if (emergency) pairs.unshift([TWC.lock, "TRUE"]);
    if (emergency && this.drives.off > 0) pairs.push([`$OUT[${this.drives.off}]`, "TRUE"]);
    void this.client?.write(pairs);
  }

  protected release(): void {
    this.stopPolling?.();
    this.stopPolling = null;
    this.client?.close();
    this.client = null;
    this.polling = false;
  }

  readonly open = async (events: AdapterEvents): Promise<Opened> => {
    const isMine = this.connecting();
    const fail = (why: Refusal, again: boolean): Opened => this.failed(isMine, why, again);
    if (this.robot.arm.joints.length !== AXES) return fail(say.otherJoints(this.robot), false);
    if (!this.axes) return fail(say.unknownAxes(this.robot), false);
    const connected = await this.network.connect({ host: this.host, port: this.port });
    if (connected.kind === "refused") return fail(say.noProxy(connected.sentence), true);
    if (!isMine()) {
      connected.stream.close();
      return fail(say.closedHere, true);
    }
    let brokeBy = "";
    const own = (this.client = new C3Client(
      connected.stream,
      this.scheduler,
      sentence => {
        brokeBy = sentence;
        if (this.client === own) {
          this.lose(sentence);
        }
      },
      seconds => {
        events.roundTrip(seconds);
      },
    ));
    const first = await own.ask({ kind: "read-many", names: [...HEAD, ...this.names] });
    if (first === null) return fail(say.noProxy(brokeBy === "" ? "The connection was closed." : brokeBy), true);
    if (first.kind !== "values") return fail(say.oldProxy, false);
    const model = textIn(first.items[0]?.value ?? "");
    const version = first.items[1]!;
    if (this.options.model === undefined ? !isKukaModel(this.robot, model) : this.options.model !== model) {
      // Told twice: a name that was spoilt on its way is no other robot.
      const again = await own.ask({ kind: "read", wide: true, name: "$MODEL_NAME[]" });
      return fail(
        say.otherRobot(this.robot, model === "" ? "robot without a name" : model),
        again?.kind !== "value" || textIn(again.value) !== model,
      );
    }
    const now = (this.state = new KukaState(this.program, this.axes, this.lines, this.gripper));
    const wired = (i: number): number => {
      const n = numberIn(first.items[i]?.value ?? "");
      return n > 0 ? n : 0;
    };
    this.drives = { on: wired(2), off: wired(3) };
    if (now.take(first.items.slice(HEAD.length), this.scheduler.now_s()) !== true) return fail(say.unreadable, true);
    this.loop =
      version.error !== 1 ? say.noLoop : version.value === String(LOOP_VERSION) ? null : say.otherLoop(version.value);
    const features = await own.ask({ kind: "features" });
    this.types = features?.kind === "features" ? features.types : [];
    if (!isMine()) return { kind: "failed", why: say.noProxy(brokeBy), again: true };
    this.stopPolling = this.scheduler.every(this.period_s, () => {
      this.poll(own, now, events);
    });
    return this.ready(events);
  };

  pause(seconds: number): Promise<void> {
    return new Promise(resolve => {
      const stop = this.scheduler.every(seconds, () => {
        stop();
        resolve();
      });
    });
  }

  hindrance(): Refusal | null {
    return (
      this.loop ??
      (!this.state?.ready
        ? say.drivesOff
        : this.state.loopRuns
          ? null
          : say.loopRests(this.state.programState, this.state.program))
    );
  }

  /** Everything the loop needs for a motion but the number that starts it. */
  orders(motion: AdapterMotion): (readonly [string, string])[] {
    const percent = (ratio: number): string => String(Math.min(100, Math.max(1, Math.round(100 * ratio))));
    const common: (readonly [string, string])[] = [
      [TWC.acceleration, percent(motion.acceleration)],
      [TWC.watch, String(Math.round(1000 * this.watch_s))],
    ];
    if (motion.path === "joints")
      return [
        ...common,
        [TWC.kind, String(TWC_KIND.joints)],
        [TWC.ratio, percent(motion.ratio)],
        [TWC.axis, e6axis(axesOfJoints(this.axes!, motion.q_rad, new Float64Array(AXES)), DIGITS)],
      ];
    const path: (readonly [string, string])[] = [
      ...common,
      [TWC.speed, krlReal(motion.speed_mps, DIGITS)],
      [TWC.position, e6pos(motion.baseFromFlange, null, DIGITS)],
    ];
    return motion.path === "line"
      ? [...path, [TWC.kind, String(TWC_KIND.line)]]
      : [...path, [TWC.kind, String(TWC_KIND.arc)], [TWC.via, e6pos(motion.baseFromVia, null, DIGITS)]];
  }

  readonly cannotSay = (order: AdapterOrder): Refusal | null => {
    if (order.kind === "gripper") return this.gripper === "" ? say.noGripper : null;
    if (order.kind !== "signal") return null;
    const match = OUTPUT.exec(order.signal);
    return match && (match[1] === "OUT") === (typeof order.value === "boolean") ? null : say.noSuchLine(order.signal);
  };

  readonly move = async (motion: AdapterMotion): Promise<CommandOutcome> => {
    const own = this.client;
    const now = this.state;
    const why = this.hindrance();
    if (!own || !now || why) return refused(why ?? say.closedHere);
    const make = (resolve: Waiting["resolve"]): Waiting => ({
      number: (now.command + 1) & 0x7fffffff,
      resolve,
      taken: false,
      cancelled: false,
    });
    return this.execute(make, mine => {
      void (async () => {
        // The number that starts the motion goes out only when everything else has arrived: an old target is never
        // driven to.
        const taken = await own.write(this.orders(motion));
        if (this.moving !== mine) return;
        if (mine.cancelled || !taken) {
          this.settle(mine.cancelled ? stopped(say.stoppedHere(this.robot)) : refused(say.notTaken));
          return;
        }
        mine.taken = true;
        this.fed_s = this.scheduler.now_s();
        if (!(await own.write([[TWC.command, String(mine.number)]])) && this.moving === mine) {
          this.brake(false);
          this.settle(stopped(say.notTaken));
        }
      })();
    });
  };

  /**
   * A person's word that it may go on: what is left of a motion is taken back, the lock opened, messages confirmed, the
   * program started.
   */
  readonly reset = async (wanted: () => boolean): Promise<CommandOutcome> => {
    const own = this.client;
    const now = this.state;
    if (!own || !now) return refused(say.closedHere);
    if (this.loop) return refused(this.loop);
    if (!(await own.write([[TWC.stop, "TRUE"]]))) return refused(say.notTaken);
    if (!wanted()) return refused(stoppedInReset(this.robot));
    if (!now.ready) await this.switchOn(own, now, wanted);
    if (!wanted()) return refused(stoppedInReset(this.robot));
    if (!now.ready) return refused(say.drivesOff);
    if (this.types.includes(C3_TYPE.confirmAll)) await own.order({ kind: "confirm-all" });
    const started = now.loopRuns ? DONE : await this.startLoop(own, now);
    if (started.kind !== "done") return started;
    if (!wanted()) return refused(stoppedInReset(this.robot));
    return (await own.write([[TWC.lock, "FALSE"]])) ? DONE : refused(say.notTaken);
  };

  /** Over the wires of the cell, where there are any: heard in EXT only. */
  async switchOn(own: C3Client, now: KukaState, wanted: () => boolean): Promise<void> {
    if (this.drives.on === 0 || now.mode !== "EX") return;
    const out = (n: number, value: string): (readonly [string, string])[] => (n > 0 ? [[`$OUT[${n}]`, value]] : []);
    const until_s = this.scheduler.now_s() + DRIVES_S;
    // What still brakes does not hear it: it is said until the drives are on.
    for (
      await own.write(out(this.drives.off, "FALSE"));
      !now.ready && wanted() && this.client === own && this.scheduler.now_s() < until_s;
      await this.pause(LOOK_S)
    ) {
      await own.write([...out(this.drives.on, "FALSE"), ...out(this.drives.on, "TRUE")]);
    }
    await own.write(out(this.drives.on, "FALSE"));
  }

  async startLoop(own: C3Client, now: KukaState): Promise<CommandOutcome> {
    if (!this.types.includes(C3_TYPE.control)) return refused(say.noProgramControl);
    if (now.sample.mode === "manual") return refused(say.notAtPendant);
    const ours = now.program === this.program;
    const left = now.programState === "P_STOP" && this.handed !== "" && now.program === this.handed;
    const free = left || now.programState === "P_FREE" || now.programState === "P_END";
    if (!ours && !free) return refused(say.loopRests(now.programState, now.program));
    if (left) await own.order({ kind: "control", command: C3_COMMAND.cancel, interpreter: 1 });
    if (!ours && !(await own.order({ kind: "select", run: false, name: this.program, parameters: "", force: false })))
      return refused(say.startRefused(now.programState));
    // From its first line: what it was stopped in is forgotten, and its first motion is none.
    else if (ours) await own.order({ kind: "control", command: C3_COMMAND.reset, interpreter: 1 });
    const start = (): Promise<boolean> => own.order({ kind: "control", command: C3_COMMAND.start, interpreter: 1 });
    if (!(await start())) return refused(say.startRefused(now.programState));
    if (now.mode === "EX") return DONE;
    // Outside EXT the controller rests on the path and asks for the start key once more.
    await this.pause(ON_PATH_S);
    return now.loopRuns || (await start()) ? DONE : refused(say.startRefused(now.programState));
  }

  /** Our own program has its place again; it moves nothing by itself. */
  async back(own: C3Client): Promise<void> {
    if (this.client === own && this.loop === null)
      await own.order({ kind: "select", run: true, name: this.program, parameters: "", force: true });
  }

  readonly handText = async (files: readonly EmittedFile[]): Promise<UploadedProgram> => {
    const own = this.client;
    const now = this.state;
    const before = this.stops;
    if (!own || !now) return { kind: "refused", why: say.closedHere };
    if (!this.types.includes(C3_TYPE.fileWrite)) return { kind: "refused", why: say.noFiles };
    if (!this.types.includes(C3_TYPE.control)) return { kind: "refused", why: say.noProgramControl };
    this.handed = programOf(files);
    const selected = await handKrl(files, own);
    if (selected.kind === "refused") {
      await this.back(own);
      return selected;
    }
    return {
      kind: "handed",
      drop: () => {
        void this.back(own);
      },
      start: async () => {
        if (this.client !== own || this.stops !== before) {
          await this.back(own);
          return stopped(this.client === own ? say.stoppedHere(this.robot) : say.closedHere);
        }
        const run = runKrl(selected.name, own, now, this.scheduler, this.robot);
        this.text = run;
        const outcome = await run.outcome;
        this.text = null;
        await this.back(own);
        return outcome;
      },
    };
  };
}

function kukaAdapterOf(wire: KukaWire): ControllerAdapter {
  return {
    brand: "KUKA",
    robot: wire.robot,
    stale_s: wire.options.stale_s ?? Math.max(STALE_S, 4 * wire.period_s),
    watchdog: { kind: "robot", within_s: wire.watch_s },
    open: wire.open,
    close: () => {
      wire.close();
    },
    cannotSay: wire.cannotSay,
    move: wire.move,
    reset: wire.reset,
    stop(emergency) {
      wire.stops++;
      if (wire.moving && !wire.moving.taken) wire.moving.cancelled = true;
      wire.brake(emergency);
      wire.text?.stop();
      // A program of somebody else's does not listen to our variables.
      if (
        !wire.text &&
        wire.state?.programState === "P_ACTIVE" &&
        !wire.state.loopRuns &&
        wire.types.includes(C3_TYPE.control)
      )
        void wire.client?.order({ kind: "control", command: C3_COMMAND.stop, interpreter: 1 });
    },
    setOverride(ratio) {
      void wire.client?.ask({ kind: "write", wide: true, name: "$OV_PRO", value: String(Math.round(100 * ratio)) });
      return null;
    },
    setSignal(signal, value) {
      const why = wire.cannotSay({ kind: "signal", signal, value });
      if (why) return why;
      void wire.client?.ask({
        kind: "write",
        wide: true,
        name: signal,
        value: typeof value === "boolean" ? (value ? "TRUE" : "FALSE") : krlReal(value, DIGITS),
      });
      return null;
    },
    setGripper(closed) {
      const why = wire.cannotSay({ kind: "gripper", closed });
      if (why) return why;
      void wire.client?.ask({ kind: "write", wide: true, name: wire.gripper, value: closed ? "TRUE" : "FALSE" });
      return null;
    },
    handText: wire.handText,
    async runText(files: readonly EmittedFile[]) {
      const ready = await wire.handText(files);
      return ready.kind === "refused" ? ready : ready.start();
    },
  };
}
