import { stopped } from "../../outcomes.ts";
import {
  Stepper,
  type CommandOutcome,
  type EmittedFile,
  type JointSample,
  type Refusal,
  axesOfJoints,
  jointsOfAxes,
  type Robot,
  type Scheduler,
  type VendorSection,
} from "@twincell/core";
import {
  Execution,
  stepOfMotion,
  type ControllerAdapter,
  type AdapterEvents,
  type AdapterOrder,
  type Opened,
} from "../../driver/index.ts";
import type { DatagramSocket, Network } from "../../transport/index.ts";
import { AXES, kukaAxes } from "../codec/axes.ts";
import { readRsi, rsiAxes, rsiWriter, type RsiConfig, type RsiValue } from "../codec/rsi.ts";
import { RSI_NAME } from "../codec/loop.ts";
import { createKukaAdapter, type KukaAdapterOptions } from "./adapter.ts";
import * as say from "./words.ts";

export interface KukaRsiAdapterOptions extends Omit<KukaAdapterOptions, "program"> {
  /** The file that the controller has too: we listen where it says. AKorr must be among what is received. */
  readonly config: RsiConfig;
  /** 4 or 12 ms. */
  readonly cycle_s?: number;
  /** Telegrams that the controller lets come late before RSI breaks off: Timeout of its ETHERNET object. */
  readonly timeout?: number;
  readonly decimals?: number;
}
type Lent = { -readonly [K in keyof Omit<JointSample, "step">]: Omit<JointSample, "step">[K] };
interface Streaming {
  stepper: Stepper;
  readonly target_rad: Float64Array;
  readonly resolve: (outcome: CommandOutcome) => void;
  resting: number;
  again: number;
}

/** Nothing over RSI for so long: it does not run [s]. */
const SILENT_S = 0.05;
/**
 * At the end of a motion the robot stands so near to its target [°], or is brought there, so often at most, at this
 * share of its speed.
 */
const NEAR_DEG = 5e-4;
const MOST_AGAIN = 10;
const REST_RATIO = 0.2;
/** Telegrams until the last increment shows in what the robot says. */
const UNDER_WAY = 3;
const NOTHING = { tools: {}, frames: {} };
/** An axis that moved by less between two telegrams stands [°]. */
const STANDS_DEG = 2e-5;

/**
 * A KUKA controller moved by RSI: the path is made here, cycle by cycle, and goes out as increments of the axes; what
 * is lost on the way is made good at the end. States come with every telegram; mode, stops and drives over the
 * variables, as without RSI. When answers stay away the controller itself ends RSI and stops the robot.
 */
export function createKukaRsiAdapter(options: KukaRsiAdapterOptions): ControllerAdapter {
  return kukaRsiAdapterOf(new RsiWire(options));
}

class RsiWire extends Execution<Streaming> {
  readonly options: KukaRsiAdapterOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly config: RsiConfig;
  readonly cycle_s: number;
  readonly base: ControllerAdapter;
  readonly axes: VendorSection | undefined;
  readonly write: (values: ReadonlyMap<string, RsiValue>, ipoc: number) => string;
  readonly a_deg = new Float64Array(AXES);
  readonly before_deg = new Float64Array(AXES);
  readonly now_deg = new Float64Array(AXES);
  readonly next_deg = new Float64Array(AXES);
  readonly commanded_rad = new Float64Array(AXES);
  readonly next_rad = new Float64Array(AXES);
  readonly values = new Map<string, number>();
  readonly KEYS = Array.from({ length: AXES }, (_, i) => `AKorr.A${i + 1}`);
  socket: DatagramSocket | null = null;
  listener: AdapterEvents | null = null;
  override = 1;
  ipoc = NaN;
  heard_s = -Infinity;
  texts = 0;
  readonly lent: Lent = {
    sequence: 0,
    time_s: 0,
    q_rad: new Float64Array(AXES),
    moving: false,
    mode: "automatic",
    safety: "normal",
    override: 1,
    gripperClosed: false,
    message: "",
  };

  constructor(options: KukaRsiAdapterOptions) {
    super();
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.config = this.options.config;
    this.cycle_s = this.options.cycle_s ?? 0.004;
    this.base = createKukaAdapter({ ...this.options, program: RSI_NAME });
    this.axes = kukaAxes(this.robot);
    this.write = rsiWriter("Sen", this.config.senType, this.config.receive, this.options.decimals ?? 6);
  }

  runs(): boolean {
    return this.scheduler.now_s() - this.heard_s <= SILENT_S;
  }

  /** The increments of the next cycle [°] into `values`. */
  correct(): void {
    for (const key of this.KEYS) this.values.set(key, 0);
    const mine = this.moving;
    if (!mine) return;
    const state = mine.stepper.advance(this.cycle_s, this.override, this.next_rad);
    axesOfJoints(this.axes!, this.commanded_rad, this.now_deg);
    axesOfJoints(this.axes!, this.next_rad, this.next_deg);
    this.commanded_rad.set(this.next_rad);
    for (let i = 0; i < AXES; i++) this.values.set(this.KEYS[i]!, this.next_deg[i]! - this.now_deg[i]!);
    if (state.kind === "running") return;
    if (state.kind === "fault" && state.fault) {
      this.settle({ kind: "stopped", why: state.fault });
      return;
    }
    mine.resting++;
    if (this.ending) {
      if (mine.resting >= UNDER_WAY) this.settle({ kind: "stopped", why: say.stoppedHere(this.robot) });
      return;
    }
    axesOfJoints(this.axes!, mine.target_rad, this.next_deg);
    const off_deg = this.next_deg.reduce((most, value, i) => Math.max(most, Math.abs(value - this.a_deg[i]!)), 0);
    // The last increments are still under way in the first telegrams.
    if (mine.resting < UNDER_WAY) return;
    if (off_deg <= NEAR_DEG) {
      this.settle({ kind: "done" });
      return;
    }
    if (mine.again++ >= MOST_AGAIN) {
      this.settle({ kind: "stopped", why: say.notReached(off_deg) });
      return;
    }
    // Increments were lost on the way: what is missing is driven as a motion of its own.
    mine.resting = 0;
    jointsOfAxes(this.axes!, this.a_deg, this.commanded_rad);
    mine.stepper = new Stepper(
      this.robot,
      NOTHING,
      [
        {
          id: "rest",
          type: "move",
          path: "ptp",
          target: { q: [...mine.target_rad] },
          speed: { ratio: REST_RATIO },
          blend_m: 0,
        },
      ],
      this.commanded_rad,
    );
  }

  readonly telegram = (bytes: Uint8Array, from: Parameters<Parameters<DatagramSocket["onDatagram"]>[0]>[1]): void => {
    let text = "";
    for (const byte of bytes) text += String.fromCharCode(byte);
    const read = readRsi(text, "Rob");
    if (read.kind !== "telegram" || read.type !== "KUKA" || !this.listener) return;
    const elapsed = Math.round((read.ipoc - this.ipoc) / (1000 * this.cycle_s));
    // Sent twice, or overtaken by a later one; a clock that jumped is a controller that began anew.
    if (elapsed <= 0 && elapsed > -1000) return;
    this.before_deg.set(this.a_deg);
    if (!rsiAxes(read.values, "AIPos", this.a_deg)) return;
    const first = !this.runs();
    this.ipoc = read.ipoc;
    this.heard_s = this.scheduler.now_s();
    if (!this.config.onlySend) {
      this.correct();
      this.socket?.send(
        Uint8Array.from(this.write(this.values, this.ipoc), sign => sign.charCodeAt(0) & 255),
        from,
      );
    }
    this.lent.sequence += first || !(elapsed > 0) ? 1 : elapsed;
    this.lent.time_s = this.ipoc / 1000;
    jointsOfAxes(this.axes!, this.a_deg, this.lent.q_rad);
    this.lent.override = this.override;
    this.lent.moving =
      this.a_deg.some((value, i) => Math.abs(value - this.before_deg[i]!) > STANDS_DEG) ||
      this.KEYS.some(key => Math.abs(this.values.get(key) ?? 0) > STANDS_DEG);
    this.listener.sample(this.lent);
  };

  readonly open = async (events: AdapterEvents): Promise<Opened> => {
    this.close();
    const bound = await this.network.bind({ host: this.config.ip, port: this.config.port });
    if (bound.kind === "taken") return { kind: "failed", again: true, why: say.noProxy(bound.sentence) };
    this.socket = bound.socket;
    const opened = await this.base.open({
      roundTrip(seconds) {
        events.roundTrip(seconds);
      },
      lost: sentence => {
        this.close();
        events.lost(sentence);
      },
      sample: slow => {
        this.lent.mode = slow.mode;
        this.lent.safety = slow.safety;
        this.lent.message = slow.message;
        this.lent.gripperClosed = slow.gripperClosed;
        if (slow.signals) this.lent.signals = slow.signals;
        if (this.runs()) return;
        // While RSI rests the variables speak alone.
        if (this.moving)
          this.settle({
            kind: "stopped",
            why: slow.message === "" ? say.rsiEnded : { ...say.rsiEnded, sentence: slow.message },
          });
        this.lent.sequence++;
        this.lent.time_s = slow.time_s;
        this.lent.moving = slow.moving;
        this.lent.override = this.override;
        this.lent.q_rad.set(slow.q_rad);
        events.sample(this.lent);
      },
    });
    if (opened.kind === "failed") {
      this.close();
      return opened;
    }
    this.listener = events;
    bound.socket.onDatagram(this.telegram);
    return opened;
  };

  readonly close = (): void => {
    this.listener = null;
    this.base.close();
    this.socket?.close();
    this.socket = null;
    this.heard_s = -Infinity;
    this.ipoc = NaN;
    this.settle({ kind: "stopped", why: say.closedHere });
  };

  async counted(running: Promise<CommandOutcome>): Promise<CommandOutcome> {
    this.texts++;
    const outcome = await running;
    this.texts--;
    return outcome;
  }

  readonly cannotSay = (order: AdapterOrder): Refusal | null =>
    order.kind === "signal" || order.kind === "gripper"
      ? this.base.cannotSay(order)
      : this.config.onlySend
        ? say.onlySends
        : null;
}

function kukaRsiAdapterOf(wire: RsiWire): ControllerAdapter {
  const { runText, handText } = wire.base;
  return {
    brand: "KUKA",
    robot: wire.robot,
    stale_s: wire.base.stale_s,
    open: wire.open,
    close: wire.close,
    watchdog: wire.config.onlySend
      ? { kind: "none", because: "RSI only sends; nothing from here moves the robot." }
      : { kind: "robot", within_s: (wire.options.timeout ?? 100) * wire.cycle_s },
    cannotSay: wire.cannotSay,
    move(motion) {
      const why = wire.cannotSay(motion);
      if (why) return Promise.resolve({ kind: "refused", why });
      if (!wire.runs()) return Promise.resolve({ kind: "refused", why: say.rsiRests });
      wire.commanded_rad.set(wire.lent.q_rad);
      return wire.execute(
        resolve => ({
          stepper: new Stepper(wire.robot, NOTHING, [stepOfMotion(motion)], wire.commanded_rad),
          target_rad: motion.q_rad.slice(),
          resolve,
          resting: 0,
          again: 0,
        }),
        () => {
          /* The next telegram is answered with the first of its path. */
        },
      );
    },
    stop(emergency) {
      if (wire.moving && !wire.ending) {
        wire.ending = stopped(say.stoppedHere(wire.robot));
        wire.moving.stepper.stop(true);
      }
      // A text is run by the controller: what is stopped here would not reach it.
      if (emergency || wire.texts > 0) wire.base.stop(emergency);
    },
    // RSI knows no override: the path made here follows ours.
    setOverride(ratio) {
      wire.override = ratio;
      return null;
    },
    reset: wanted => wire.base.reset(wanted),
    setSignal: (signal, value) => wire.base.setSignal(signal, value),
    setGripper: closed => wire.base.setGripper(closed),
    ...(runText ? { runText: files => wire.counted(runText.call(wire.base, files)) } : {}),
    ...(handText
      ? {
          async handText(files: readonly EmittedFile[]) {
            const handed = await handText.call(wire.base, files);
            return handed.kind === "handed" ? { ...handed, start: () => wire.counted(handed.start()) } : handed;
          },
        }
      : {}),
  };
}
