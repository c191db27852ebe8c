import {
  axesOfJoints,
  type CommandOutcome,
  type EmittedFile,
  type UploadedProgram,
  type Refusal,
  type Robot,
  type Scheduler,
} from "@twincell/core";
import type { ControllerAdapter, AdapterEvents, AdapterMotion, AdapterOrder, Opened } from "../../driver/index.ts";
import type { Network } from "../../transport/index.ts";
import { AXES, e6axis, e6pos, kukaAxes } from "../axes.ts";
import { C3_COMMAND, C3_PORT, C3_TYPE } from "../codec-c3.ts";
import { krlReal, numberIn, textIn } from "../codec-values.ts";
import { LOOP_NAME, LOOP_VERSION, TWC, TWC_KIND, TWC_RESULT, WATCH_TIMER } from "../loop.ts";
import { isKukaModel } from "../models.ts";
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
  const { robot, scheduler, network, host } = options;
  const axes = kukaAxes(robot);
  const port = options.port ?? C3_PORT;
  const program = options.program ?? LOOP_NAME;
  const period_s = options.period_s ?? 0.012;
  const watch_s = options.watch_s ?? 0.5;
  const gripper = options.gripperOutput === undefined ? "" : `$OUT[${options.gripperOutput}]`;
  const lines = [...new Set([...(options.signals ?? []), ...(gripper === "" ? [] : [gripper])])];
  const names = [...POLLED, ...lines];
  let client: C3Client | null = null;
  let state: KukaState | null = null;
  let stopPolling: (() => void) | null = null;
  let waiting: Waiting | null = null;
  let types: readonly number[] = [];
  let loop: Refusal | null = say.noLoop;
  let polling = false;
  let fed_s = 0;
  let life = 0;
  let stops = 0;
  let drives = { on: 0, off: 0 };
  let text: { stop: () => void } | null = null;
  /** The last text that was handed over from here: where the link broke it may still be selected, and makes room. */
  let handed = "";

  function settle(outcome: CommandOutcome): void {
    const ended = waiting;
    waiting = null;
    ended?.resolve(outcome);
  }

  /** What a state means for the motion under way. */
  function look(now: KukaState): void {
    if (!waiting?.taken) return;
    if (now.done === waiting.number) {
      switch (now.result) {
        case TWC_RESULT.done:
          settle(DONE);
          return;
        case TWC_RESULT.refused:
          settle(refused(say.refusedThere));
          return;
        case TWC_RESULT.silent:
          settle(stopped(say.linkSilent));
          return;
        default:
          settle(stopped(say.stoppedHere(robot)));
          return;
      }
    }
    if (now.loopRuns || now.command !== waiting.number) return;
    // Whoever starts the program again must not find the rest of this motion in it.
    brake(false);
    settle(
      stopped(now.sample.message === "" ? say.notCarriedOut : { ...say.notCarriedOut, sentence: now.sample.message }),
    );
  }

  function poll(mine: C3Client, now: KukaState, events: AdapterEvents): void {
    const at_s = scheduler.now_s();
    if (waiting?.taken && at_s - fed_s >= watch_s / FEEDS - 1e-9 && !mine.isCrowded) {
      fed_s = at_s;
      void mine.ask({
        kind: "write",
        wide: true,
        name: `$TIMER[${WATCH_TIMER}]`,
        value: String(-Math.round(1000 * watch_s)),
      });
    }
    if (polling || mine.isCrowded) return;
    polling = true;
    void mine.ask({ kind: "read-many", names }).then(reply => {
      polling = false;
      if (client !== mine || reply?.kind !== "values") return;
      if (now.take(reply.items, scheduler.now_s()) !== true) return;
      look(now);
      events.sample(now.sample);
    });
  }

  function brake(emergency: boolean): void {
    const pairs: (readonly [string, string])[] = [[TWC.stop, "TRUE"]];
    if (emergency) pairs.unshift([TWC.lock, "TRUE"]);
    if (emergency && drives.off > 0) pairs.push([`$OUT[${drives.off}]`, "TRUE"]);
    void client?.write(pairs);
  }

  function close(): void {
    life++;
    stopPolling?.();
    stopPolling = null;
    client?.close();
    client = null;
    polling = false;
    settle(stopped(say.closedHere));
  }

  async function open(events: AdapterEvents): Promise<Opened> {
    close();
    const mine = life;
    const fail = (why: Refusal, again: boolean): Opened => {
      if (mine === life) close();
      return { kind: "failed", why, again };
    };
    if (robot.arm.joints.length !== AXES) return fail(say.otherJoints(robot), false);
    if (!axes) return fail(say.unknownAxes(robot), false);
    const connected = await network.connect({ host, port });
    if (connected.kind === "refused") return fail(say.noProxy(connected.sentence), true);
    if (mine !== life) {
      connected.stream.close();
      return fail(say.closedHere, true);
    }
    let isOpen = false;
    let brokeBy = "";
    const own = (client = new C3Client(
      connected.stream,
      scheduler,
      sentence => {
        brokeBy = sentence;
        if (client === own) {
          close();
          if (isOpen) events.lost(sentence);
        }
      },
      seconds => {
        events.roundTrip(seconds);
      },
    ));
    const first = await own.ask({ kind: "read-many", names: [...HEAD, ...names] });
    if (first === null) return fail(say.noProxy(brokeBy === "" ? "The connection was closed." : brokeBy), true);
    if (first.kind !== "values") return fail(say.oldProxy, false);
    const model = textIn(first.items[0]?.value ?? "");
    const version = first.items[1]!;
    if (options.model === undefined ? !isKukaModel(robot, model) : options.model !== model) {
      // Told twice: a name that was spoilt on its way is no other robot.
      const again = await own.ask({ kind: "read", wide: true, name: "$MODEL_NAME[]" });
      return fail(
        say.otherRobot(robot, model === "" ? "robot without a name" : model),
        again?.kind !== "value" || textIn(again.value) !== model,
      );
    }
    const now = (state = new KukaState(program, axes, lines, gripper));
    const wired = (i: number): number => {
      const n = numberIn(first.items[i]?.value ?? "");
      return n > 0 ? n : 0;
    };
    drives = { on: wired(2), off: wired(3) };
    if (now.take(first.items.slice(HEAD.length), scheduler.now_s()) !== true) return fail(say.unreadable, true);
    loop =
      version.error !== 1 ? say.noLoop : version.value === String(LOOP_VERSION) ? null : say.otherLoop(version.value);
    const features = await own.ask({ kind: "features" });
    types = features?.kind === "features" ? features.types : [];
    if (mine !== life) return { kind: "failed", why: say.noProxy(brokeBy), again: true };
    isOpen = true;
    stopPolling = scheduler.every(period_s, () => {
      poll(own, now, events);
    });
    return { kind: "open" };
  }

  const pause = (seconds: number): Promise<void> =>
    new Promise(resolve => {
      const stop = scheduler.every(seconds, () => {
        stop();
        resolve();
      });
    });

  const hindrance = (): Refusal | null =>
    loop ?? (!state?.ready ? say.drivesOff : state.loopRuns ? null : say.loopRests(state.programState, state.program));

  /** Everything the loop needs for a motion but the number that starts it. */
  function orders(motion: AdapterMotion): (readonly [string, string])[] {
    const percent = (ratio: number): string => String(Math.min(100, Math.max(1, Math.round(100 * ratio))));
    const common: (readonly [string, string])[] = [
      [TWC.acceleration, percent(motion.acceleration)],
      [TWC.watch, String(Math.round(1000 * watch_s))],
    ];
    if (motion.path === "joints")
      return [
        ...common,
        [TWC.kind, String(TWC_KIND.joints)],
        [TWC.ratio, percent(motion.ratio)],
        [TWC.axis, e6axis(axesOfJoints(axes!, motion.q_rad, new Float64Array(AXES)), DIGITS)],
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

  function cannotSay(order: AdapterOrder): Refusal | null {
    if (order.kind === "gripper") return gripper === "" ? say.noGripper : null;
    if (order.kind !== "signal") return null;
    const match = OUTPUT.exec(order.signal);
    return match && (match[1] === "OUT") === (typeof order.value === "boolean") ? null : say.noSuchLine(order.signal);
  }
  async function move(motion: AdapterMotion): Promise<CommandOutcome> {
    const own = client;
    const now = state;
    const why = hindrance();
    if (!own || !now || why) return refused(why ?? say.closedHere);
    return new Promise(resolve => {
      const mine: Waiting = { number: (now.command + 1) & 0x7fffffff, resolve, taken: false, cancelled: false };
      waiting = mine;
      void (async () => {
        // The number that starts the motion goes out only when everything else has arrived: an old target is never
        // driven to.
        const taken = await own.write(orders(motion));
        if (waiting !== mine) return;
        if (mine.cancelled || !taken) {
          settle(mine.cancelled ? stopped(say.stoppedHere(robot)) : refused(say.notTaken));
          return;
        }
        mine.taken = true;
        fed_s = scheduler.now_s();
        if (!(await own.write([[TWC.command, String(mine.number)]])) && waiting === mine) {
          brake(false);
          settle(stopped(say.notTaken));
        }
      })();
    });
  }

  /**
   * A person's word that it may go on: what is left of a motion is taken back, the lock opened, messages confirmed, the
   * program started.
   */
  async function reset(wanted: () => boolean): Promise<CommandOutcome> {
    const own = client;
    const now = state;
    if (!own || !now) return refused(say.closedHere);
    if (loop) return refused(loop);
    if (!(await own.write([[TWC.stop, "TRUE"]]))) return refused(say.notTaken);
    if (!wanted()) return refused(stoppedInReset(robot));
    if (!now.ready) await switchOn(own, now, wanted);
    if (!wanted()) return refused(stoppedInReset(robot));
    if (!now.ready) return refused(say.drivesOff);
    if (types.includes(C3_TYPE.confirmAll)) await own.order({ kind: "confirm-all" });
    const started = now.loopRuns ? DONE : await startLoop(own, now);
    if (started.kind !== "done") return started;
    if (!wanted()) return refused(stoppedInReset(robot));
    return (await own.write([[TWC.lock, "FALSE"]])) ? DONE : refused(say.notTaken);
  }
  /** Over the wires of the cell, where there are any: heard in EXT only. */
  async function switchOn(own: C3Client, now: KukaState, wanted: () => boolean): Promise<void> {
    if (drives.on === 0 || now.mode !== "EX") return;
    const out = (n: number, value: string): (readonly [string, string])[] => (n > 0 ? [[`$OUT[${n}]`, value]] : []);
    const until_s = scheduler.now_s() + DRIVES_S;
    // What still brakes does not hear it: it is said until the drives are on.
    for (
      await own.write(out(drives.off, "FALSE"));
      !now.ready && wanted() && client === own && scheduler.now_s() < until_s;
      await pause(LOOK_S)
    ) {
      await own.write([...out(drives.on, "FALSE"), ...out(drives.on, "TRUE")]);
    }
    await own.write(out(drives.on, "FALSE"));
  }
  async function startLoop(own: C3Client, now: KukaState): Promise<CommandOutcome> {
    if (!types.includes(C3_TYPE.control)) return refused(say.noProgramControl);
    if (now.sample.mode === "manual") return refused(say.notAtPendant);
    const ours = now.program === program;
    const left = now.programState === "P_STOP" && handed !== "" && now.program === handed;
    const free = left || now.programState === "P_FREE" || now.programState === "P_END";
    if (!ours && !free) return refused(say.loopRests(now.programState, now.program));
    if (left) await own.order({ kind: "control", command: C3_COMMAND.cancel, interpreter: 1 });
    if (!ours && !(await own.order({ kind: "select", run: false, name: program, parameters: "", force: false })))
      return refused(say.startRefused(now.programState));
    // From its first line: what it was stopped in is forgotten, and its first motion is none.
    else if (ours) await own.order({ kind: "control", command: C3_COMMAND.reset, interpreter: 1 });
    const start = (): Promise<boolean> => own.order({ kind: "control", command: C3_COMMAND.start, interpreter: 1 });
    if (!(await start())) return refused(say.startRefused(now.programState));
    if (now.mode === "EX") return DONE;
    // Outside EXT the controller rests on the path and asks for the start key once more.
    await pause(ON_PATH_S);
    return now.loopRuns || (await start()) ? DONE : refused(say.startRefused(now.programState));
  }

  /** Our own program has its place again; it moves nothing by itself. */
  const back = async (own: C3Client): Promise<void> => {
    if (client === own && loop === null)
      await own.order({ kind: "select", run: true, name: program, parameters: "", force: true });
  };
  async function handText(files: readonly EmittedFile[]): Promise<UploadedProgram> {
    const own = client;
    const now = state;
    const before = stops;
    if (!own || !now) return { kind: "refused", why: say.closedHere };
    if (!types.includes(C3_TYPE.fileWrite)) return { kind: "refused", why: say.noFiles };
    if (!types.includes(C3_TYPE.control)) return { kind: "refused", why: say.noProgramControl };
    handed = programOf(files);
    const selected = await handKrl(files, own);
    if (selected.kind === "refused") {
      await back(own);
      return selected;
    }
    return {
      kind: "handed",
      drop() {
        void back(own);
      },
      async start() {
        if (client !== own || stops !== before) {
          await back(own);
          return stopped(client === own ? say.stoppedHere(robot) : say.closedHere);
        }
        const run = runKrl(selected.name, own, now, scheduler, robot);
        text = run;
        const outcome = await run.outcome;
        text = null;
        await back(own);
        return outcome;
      },
    };
  }

  return {
    brand: "KUKA",
    robot,
    stale_s: options.stale_s ?? Math.max(STALE_S, 4 * period_s),
    watchdog: { kind: "robot", within_s: watch_s },
    open,
    close,
    cannotSay,
    move,
    reset,
    stop(emergency) {
      stops++;
      if (waiting && !waiting.taken) waiting.cancelled = true;
      brake(emergency);
      text?.stop();
      // A program of somebody else's does not listen to our variables.
      if (!text && state?.programState === "P_ACTIVE" && !state.loopRuns && types.includes(C3_TYPE.control))
        void client?.order({ kind: "control", command: C3_COMMAND.stop, interpreter: 1 });
    },
    setOverride(ratio) {
      void client?.ask({ kind: "write", wide: true, name: "$OV_PRO", value: String(Math.round(100 * ratio)) });
      return null;
    },
    setSignal(signal, value) {
      const why = cannotSay({ kind: "signal", signal, value });
      if (why) return why;
      void client?.ask({
        kind: "write",
        wide: true,
        name: signal,
        value: typeof value === "boolean" ? (value ? "TRUE" : "FALSE") : krlReal(value, DIGITS),
      });
      return null;
    },
    setGripper(closed) {
      const why = cannotSay({ kind: "gripper", closed });
      if (why) return why;
      void client?.ask({ kind: "write", wide: true, name: gripper, value: closed ? "TRUE" : "FALSE" });
      return null;
    },
    handText,
    async runText(files: readonly EmittedFile[]) {
      const ready = await handText(files);
      return ready.kind === "refused" ? ready : ready.start();
    },
  };
}
