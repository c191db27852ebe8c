import {
  Stepper,
  type CommandOutcome,
  type EmittedFile,
  type JointSample,
  type Refusal,
  axesOfJoints,
  jointsOfAxes,
} from "@twincell/core";
import {
  stepOfMotion,
  type ControllerAdapter,
  type AdapterEvents,
  type AdapterOrder,
  type Opened,
} from "../../driver/index.ts";
import type { DatagramSocket } from "../../transport/index.ts";
import { AXES, kukaAxes } from "../axes.ts";
import { readRsi, rsiAxes, rsiWriter, type RsiConfig } from "../codec-rsi.ts";
import { RSI_NAME } from "../loop.ts";
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
  stopping: boolean;
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
  const { robot, scheduler, network, config } = options;
  const cycle_s = options.cycle_s ?? 0.004;
  const base = createKukaAdapter({ ...options, program: RSI_NAME });
  const axes = kukaAxes(robot);
  const write = rsiWriter("Sen", config.senType, config.receive, options.decimals ?? 6);
  const a_deg = new Float64Array(AXES);
  const before_deg = new Float64Array(AXES);
  const now_deg = new Float64Array(AXES);
  const next_deg = new Float64Array(AXES);
  const commanded_rad = new Float64Array(AXES);
  const next_rad = new Float64Array(AXES);
  const values = new Map<string, number>();
  const KEYS = Array.from({ length: AXES }, (_, i) => `AKorr.A${i + 1}`);
  let socket: DatagramSocket | null = null;
  let listener: AdapterEvents | null = null;
  let streaming: Streaming | null = null;
  let override = 1;
  let ipoc = NaN;
  let heard_s = -Infinity;
  let texts = 0;
  const lent: Lent = {
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

  const runs = (): boolean => scheduler.now_s() - heard_s <= SILENT_S;
  function settle(outcome: CommandOutcome): void {
    const ended = streaming;
    streaming = null;
    ended?.resolve(outcome);
  }

  /** The increments of the next cycle [°] into `values`. */
  function correct(): void {
    for (const key of KEYS) values.set(key, 0);
    const mine = streaming;
    if (!mine) return;
    const state = mine.stepper.advance(cycle_s, override, next_rad);
    axesOfJoints(axes!, commanded_rad, now_deg);
    axesOfJoints(axes!, next_rad, next_deg);
    commanded_rad.set(next_rad);
    for (let i = 0; i < AXES; i++) values.set(KEYS[i]!, next_deg[i]! - now_deg[i]!);
    if (state.kind === "running") return;
    if (state.kind === "fault" && state.fault) {
      settle({ kind: "stopped", why: state.fault });
      return;
    }
    mine.resting++;
    if (mine.stopping) {
      if (mine.resting >= UNDER_WAY) settle({ kind: "stopped", why: say.stoppedHere(robot) });
      return;
    }
    axesOfJoints(axes!, mine.target_rad, next_deg);
    const off_deg = next_deg.reduce((most, value, i) => Math.max(most, Math.abs(value - a_deg[i]!)), 0);
    // The last increments are still under way in the first telegrams.
    if (mine.resting < UNDER_WAY) return;
    if (off_deg <= NEAR_DEG) {
      settle({ kind: "done" });
      return;
    }
    if (mine.again++ >= MOST_AGAIN) {
      settle({ kind: "stopped", why: say.notReached(off_deg) });
      return;
    }
    // Increments were lost on the way: what is missing is driven as a motion of its own.
    mine.resting = 0;
    jointsOfAxes(axes!, a_deg, commanded_rad);
    mine.stepper = new Stepper(
      robot,
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
      commanded_rad,
    );
  }

  function telegram(bytes: Uint8Array, from: Parameters<Parameters<DatagramSocket["onDatagram"]>[0]>[1]): void {
    let text = "";
    for (const byte of bytes) text += String.fromCharCode(byte);
    const read = readRsi(text, "Rob");
    if (read.kind !== "telegram" || read.type !== "KUKA" || !listener) return;
    const elapsed = Math.round((read.ipoc - ipoc) / (1000 * cycle_s));
    // Sent twice, or overtaken by a later one; a clock that jumped is a controller that began anew.
    if (elapsed <= 0 && elapsed > -1000) return;
    before_deg.set(a_deg);
    if (!rsiAxes(read.values, "AIPos", a_deg)) return;
    const first = !runs();
    ipoc = read.ipoc;
    heard_s = scheduler.now_s();
    if (!config.onlySend) {
      correct();
      socket?.send(
        Uint8Array.from(write(values, ipoc), sign => sign.charCodeAt(0) & 255),
        from,
      );
    }
    lent.sequence += first || !(elapsed > 0) ? 1 : elapsed;
    lent.time_s = ipoc / 1000;
    jointsOfAxes(axes!, a_deg, lent.q_rad);
    lent.override = override;
    lent.moving =
      a_deg.some((value, i) => Math.abs(value - before_deg[i]!) > STANDS_DEG) ||
      KEYS.some(key => Math.abs(values.get(key) ?? 0) > STANDS_DEG);
    listener.sample(lent);
  }

  async function open(events: AdapterEvents): Promise<Opened> {
    close();
    const bound = await network.bind({ host: config.ip, port: config.port });
    if (bound.kind === "taken") return { kind: "failed", again: true, why: say.noProxy(bound.sentence) };
    socket = bound.socket;
    const opened = await base.open({
      roundTrip(seconds) {
        events.roundTrip(seconds);
      },
      lost(sentence) {
        close();
        events.lost(sentence);
      },
      sample(slow) {
        lent.mode = slow.mode;
        lent.safety = slow.safety;
        lent.message = slow.message;
        lent.gripperClosed = slow.gripperClosed;
        if (slow.signals) lent.signals = slow.signals;
        if (runs()) return;
        // While RSI rests the variables speak alone.
        if (streaming)
          settle({
            kind: "stopped",
            why: slow.message === "" ? say.rsiEnded : { ...say.rsiEnded, sentence: slow.message },
          });
        lent.sequence++;
        lent.time_s = slow.time_s;
        lent.moving = slow.moving;
        lent.override = override;
        lent.q_rad.set(slow.q_rad);
        events.sample(lent);
      },
    });
    if (opened.kind === "failed") {
      close();
      return opened;
    }
    listener = events;
    bound.socket.onDatagram(telegram);
    return opened;
  }
  function close(): void {
    listener = null;
    base.close();
    socket?.close();
    socket = null;
    heard_s = -Infinity;
    ipoc = NaN;
    settle({ kind: "stopped", why: say.closedHere });
  }

  const { runText, handText } = base;
  async function counted(running: Promise<CommandOutcome>): Promise<CommandOutcome> {
    texts++;
    const outcome = await running;
    texts--;
    return outcome;
  }

  const cannotSay = (order: AdapterOrder): Refusal | null =>
    order.kind === "signal" || order.kind === "gripper"
      ? base.cannotSay(order)
      : config.onlySend
        ? say.onlySends
        : null;

  return {
    brand: "KUKA",
    robot,
    stale_s: base.stale_s,
    open,
    close,
    watchdog: config.onlySend
      ? { kind: "none", because: "RSI only sends; nothing from here moves the robot." }
      : { kind: "robot", within_s: (options.timeout ?? 100) * cycle_s },
    cannotSay,
    move(motion) {
      const why = cannotSay(motion);
      if (why) return Promise.resolve({ kind: "refused", why });
      if (!runs()) return Promise.resolve({ kind: "refused", why: say.rsiRests });
      commanded_rad.set(lent.q_rad);
      return new Promise(resolve => {
        streaming = {
          stepper: new Stepper(robot, NOTHING, [stepOfMotion(motion)], commanded_rad),
          target_rad: motion.q_rad.slice(),
          resolve,
          stopping: false,
          resting: 0,
          again: 0,
        };
      });
    },
    stop(emergency) {
      if (streaming && !streaming.stopping) {
        streaming.stopping = true;
        streaming.stepper.stop(true);
      }
      // A text is run by the controller: what is stopped here would not reach it.
      if (emergency || texts > 0) base.stop(emergency);
    },
    // RSI knows no override: the path made here follows ours.
    setOverride(ratio) {
      override = ratio;
      return null;
    },
    reset: wanted => base.reset(wanted),
    setSignal: (signal, value) => base.setSignal(signal, value),
    setGripper: closed => base.setGripper(closed),
    ...(runText ? { runText: files => counted(runText.call(base, files)) } : {}),
    ...(handText
      ? {
          async handText(files: readonly EmittedFile[]) {
            const handed = await handText.call(base, files);
            return handed.kind === "handed" ? { ...handed, start: () => counted(handed.start()) } : handed;
          },
        }
      : {}),
  };
}
