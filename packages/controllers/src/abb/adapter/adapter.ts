import type { CommandOutcome, EmittedFile, UploadedProgram, JointSample, Refusal, SafetyState } from "@twincell/core";
import { DONE, refused } from "../../outcomes.ts";
import { pathText, type Login } from "../../http/index.ts";
import type { ControllerAdapter, AdapterEvents, Opened } from "../../driver/index.ts";
import { COMM_TIMEOUT_S, EGM_STATE, isAbbModel, MOTORS, RWS_LOGIN, RWS_PORT } from "../codec/index.ts";
import { createSetpointStream, type SetpointStreamOptions } from "./guide.ts";
import { RwsClient, RwsSession, type RwsReply } from "./rws-client.ts";
import { PanelState } from "./rws-state.ts";
import { bringUp } from "./bring-up.ts";
import { SampleClock } from "./sample-clock.ts";
import { handRapid, startProgram, stopProgram, type TextRun } from "./text.ts";
import * as say from "./words.ts";

export interface AbbAdapterOptions extends SetpointStreamOptions {
  readonly ports?: { readonly egm?: number; readonly rws?: number };
  /** ABB's own default user when left out. */
  readonly login?: Login;
  /** Without an EGM message for so long, in the middle of a motion, the line counts as lost [s]. */
  readonly stale_s?: number;
  /** Resources are asked for this often [s]. */
  readonly period_s?: number;
  /** What the controller calls its robot, where that is not its name in the library. */
  readonly model?: string;
  /** The output that closes the gripper. */
  readonly gripperSignal?: string;
  /** Asked when it is opened: nothing is taken then from whoever commands the controller, not even what EGM tells. */
  readonly isWatched?: () => boolean;
}
type Lent = { -readonly [K in keyof Omit<JointSample, "step">]: JointSample[K] };

const STALE_S = 0.08;
const PANEL_STALE_S = 0.5;
const FILL_S = 0.02;
const PERIOD_S = 0.02;
const WATCH_S = 0.01;
/** A controller that guides says so within this time of being opened; one that does not is opened all the same [s]. */
const GUIDES_S = 0.3;
/** The robot has come to rest within this time, or is not heard any more [s]. */
const BRAKES_S = 2;
/** An axis that moved by less between two answers stands [rad]. */
const STANDS_RAD = 2e-6;
const PANEL = {
  ctrlstate: "/rw/panel/ctrlstate",
  opmode: "/rw/panel/opmode",
  ctrlexecstate: "/rw/rapid/execution",
  speedratio: "/rw/panel/speedratio",
} as const;
type Resource = keyof typeof PANEL | "lines";
/** What matters for safety is asked for most often. */
const TURNS: readonly Resource[] = [
  "ctrlstate",
  "ctrlexecstate",
  "ctrlstate",
  "opmode",
  "lines",
  "ctrlstate",
  "ctrlexecstate",
  "speedratio",
];
const SIGNALS = "/rw/iosystem/signals";
const JOINTS = "/rw/motionsystem/mechunits/ROB_1/jointtarget";

/**
 * An ABB controller over both of its interfaces: motions are guided by EGM, everything else (motors, mode, programs,
 * signals, files) goes over Robot Web Services 1.0. While EGM is silent states come from there. When either line is
 * lost in the middle of a motion the robot is stopped over the other one, and both are opened anew.
 */
export function abbAdapter(options: AbbAdapterOptions): ControllerAdapter {
  const { robot, scheduler, network, host } = options;
  const n = robot.arm.joints.length;
  const port = options.ports?.rws ?? RWS_PORT;
  const stale_s = options.stale_s ?? STALE_S;
  const gripper = options.gripperSignal ?? "doGripper";
  const guide = createSetpointStream(options);
  const { message } = guide;
  const clock = new SampleClock(() => scheduler.now_s());
  const before_rad = new Float64Array(n);
  const left = new Set<string>();
  // One session for as long as this driver lives: a controller has seventy, and what it holds is given back in it.
  const session = new RwsSession(options.login ?? RWS_LOGIN);
  let panel = new PanelState(robot);
  let events: AdapterEvents | null = null;
  let life = 0;
  let polling = false;
  let turn = 0;
  let hasLines = true;
  let axes = 0;
  let poll: RwsClient | null = null;
  let act: RwsClient | null = null;
  let brake: RwsClient | null = null;
  let timers: readonly (() => void)[] = [];
  let broken: { readonly why: Refusal; readonly since_s: number } | null = null;
  let severed = false;
  let rising = false;
  let text: TextRun | null = null;
  let complaint = "";
  const sample: Lent = {
    sequence: 0,
    time_s: 0,
    q_rad: new Float64Array(n),
    moving: false,
    mode: "manual",
    safety: "normal",
    override: 1,
    gripperClosed: false,
    message: "",
    signals: panel.lines,
  };

  const guides = (): boolean => scheduler.now_s() - guide.heard_s <= stale_s;
  /** Sooner than EGM counts as silent its place is taken by answers, so that nobody misses a state. */
  const isFresh = (): boolean => scheduler.now_s() - guide.heard_s <= Math.min(stale_s, FILL_S);
  const isGuided = (): boolean => guides() && say.notStreamedBecause(message) === "";
  function safetyOf(): SafetyState {
    if (severed || rising) return "emergency-stop";
    if (panel.safety !== "normal" || panel.mode === "manual" || !guides()) return panel.safety;
    return message.motors === MOTORS.off
      ? "emergency-stop"
      : message.state === EGM_STATE.error
        ? "protective-stop"
        : "normal";
  }
  function tell(q_rad: Float64Array, moving: boolean): void {
    const isByEgm = guides();
    const because = say.notStreamedBecause(message);
    sample.q_rad.set(q_rad);
    sample.sequence = clock.sequence;
    sample.time_s = clock.time_s;
    sample.moving = moving;
    sample.mode = panel.mode;
    sample.safety = safetyOf();
    sample.override = isByEgm && !text ? guide.override : panel.speedRatio / 100;
    sample.gripperClosed = panel.lines.get(gripper) === true;
    sample.message =
      panel.words !== ""
        ? panel.words
        : complaint !== ""
          ? complaint
          : panel.mode === "manual" || text
            ? ""
            : isByEgm
              ? because
              : "EGM is silent: no program there waits for targets.";
    events?.sample(sample);
  }

  /** The line is gone: the robot comes to rest first where it can still be told. */
  function breakBy(why: Refusal): void {
    if (broken || !events) return;
    broken = { why, since_s: scheduler.now_s() };
    if (guide.isGoing) guide.stop(false, why);
    else lose();
  }
  function lose(): void {
    const told = events;
    const { why } = broken!;
    close(why);
    told?.lost(why.sentence);
  }
  function watch(): void {
    const now_s = scheduler.now_s();
    if (broken) {
      if (!guide.isGoing || !guides() || now_s - broken.since_s > BRAKES_S) lose();
      return;
    }
    if (!guide.isGoing || guides()) return;
    broken = { why: say.guidingLost(robot, now_s - guide.heard_s), since_s: now_s };
    lose();
  }
  function close(why: Refusal = say.linkClosed(robot)): void {
    life++;
    // Nobody will be there to end what is under way.
    if (brake && (guide.isGoing || text)) void stopProgram(brake, true);
    for (const stop of timers) stop();
    timers = [];
    for (const client of [poll, act, brake]) client?.close();
    poll = act = brake = events = null;
    polling = rising = false;
    broken = null;
    guide.close(why);
  }

  async function round(client: RwsClient, mine: number): Promise<void> {
    const resource = TURNS[turn++ % TURNS.length]!;
    if (resource !== "lines" || hasLines) {
      const reply = await client.get(resource === "lines" ? SIGNALS : PANEL[resource]);
      if (mine !== life) return;
      const flaw = take(resource, reply);
      if (flaw !== null) {
        breakBy(say.servicesLost(robot, flaw));
        return;
      }
    }
    if (isFresh()) return;
    const reply = await client.get(JOINTS);
    if (mine !== life || isFresh()) return;
    before_rad.set(panel.q_rad);
    if (reply.kind !== "answer" || panel.takeJoints(reply.states) !== n) {
      breakBy(
        say.servicesLost(robot, reply.kind === "answer" ? "it does not say where the robot is." : reply.sentence),
      );
      return;
    }
    clock.ours();
    tell(
      panel.q_rad,
      panel.q_rad.some((q, i) => Math.abs(q - before_rad[i]!) > STANDS_RAD),
    );
  }
  /** Why the answer is none, or null. */
  function take(resource: Resource, reply: RwsReply): string | null {
    if (reply.kind !== "answer") return reply.sentence;
    if (resource === "lines") panel.takeLines(reply.states);
    else if (!panel.takePanel(resource, reply.states)) return `it does not tell its ${resource}.`;
    return null;
  }

  async function open(heard: AdapterEvents): Promise<Opened> {
    close();
    const mine = life;
    const fail = (why: Refusal, again: boolean): Opened => {
      if (mine === life) close();
      return { kind: "failed", why, again };
    };
    const client = (): RwsClient =>
      new RwsClient({
        network,
        scheduler,
        session,
        to: { host, port },
        lost(sentence) {
          breakBy(say.servicesLost(robot, sentence));
        },
        roundTrip(seconds) {
          events?.roundTrip(seconds);
        },
      });
    const own = (poll = client());
    const type = await own.get("/rw/system/robottype");
    if (mine !== life) return fail(say.linkClosed(robot), true);
    if (type.kind !== "answer" && (type.kind === "lost" || type.status !== 404))
      return fail(say.noServices(host, port, type.sentence), type.kind === "lost" || type.status === 503);
    const model = type.kind === "answer" ? type.states[0]?.fields["robot-type"] : undefined;
    if (model !== undefined && !isAbbModel(options.model ?? robot.vendorSection?.model ?? robot.name, model))
      return fail(say.otherRobot(robot, model), false);
    const now = (panel = new PanelState(robot));
    sample.signals = now.lines;
    for (const resource of ["ctrlstate", "opmode", "ctrlexecstate", "speedratio"] as const) {
      const flaw = take(resource, await own.get(PANEL[resource]));
      if (flaw !== null) return fail(say.noServices(host, port, flaw), true);
    }
    const joints = await own.get(JOINTS);
    const count = joints.kind === "answer" ? now.takeJoints(joints.states) : null;
    if (count === null)
      return fail(
        say.noServices(host, port, joints.kind === "answer" ? "it does not say where the robot is." : joints.sentence),
        true,
      );
    if (count !== n) return fail(say.otherAxes(robot, count), false);
    // Each of the other lines is there before it is needed.
    act = client();
    brake = client();
    const lines = await act.get(SIGNALS);
    await brake.get(PANEL.ctrlstate);
    hasLines = take("lines", lines) === null;
    if (mine !== life) return fail(say.linkClosed(robot), true);
    axes = n;
    const watched = options.isWatched?.() ?? false;
    const deaf = watched
      ? null
      : await guide.open({
          state(_, got) {
            axes = got;
            if (got !== n) {
              breakBy(say.otherAxes(robot, got));
              return;
            }
            clock.theirs(message.sequence, message.time_ms);
            tell(guide.q_rad, guide.isMoving);
          },
        });
    if (deaf) return fail(deaf, true);
    for (
      const from_s = scheduler.now_s();
      !watched && !guides() && axes === n && mine === life && scheduler.now_s() - from_s < GUIDES_S;
    )
      await pause(WATCH_S);
    if (mine !== life) return fail(say.linkClosed(robot), true);
    if (axes !== n) return fail(say.otherAxes(robot, axes), false);
    severed = false;
    complaint = "";
    events = heard;
    timers = [
      scheduler.every(WATCH_S, watch),
      scheduler.every(options.period_s ?? PERIOD_S, () => {
        if (polling) return;
        polling = true;
        void round(own, mine).then(() => {
          if (mine === life) polling = false;
        });
      }),
    ];
    return { kind: "open" };
  }
  const pause = (seconds: number): Promise<void> =>
    new Promise(resolve => {
      const stop = scheduler.every(seconds, () => {
        stop();
        resolve();
      });
    });

  /** Orders that nobody waits for: what the controller says against them is told with the states. */
  function order(answered: Promise<RwsReply>, what: string): void {
    void answered.then(reply => {
      complaint = reply.kind === "refused" ? say.refusedThere(what, reply.sentence).sentence : "";
    });
  }
  const cannotWrite = (signal: string): Refusal | null => (panel.places.has(signal) ? null : say.noSuchLine(signal));
  function setSignal(signal: string, value: boolean | number): Refusal | null {
    if (!act) return say.linkClosed(robot);
    const why = cannotWrite(signal);
    if (why) return why;
    const place = panel.places.get(signal)!;
    order(
      act.post(`${SIGNALS}${pathText(place.split("/"))}?action=set`, { lvalue: String(Number(value)) }),
      `Writing "${signal}"`,
    );
    return null;
  }
  async function handText(files: readonly EmittedFile[]): Promise<UploadedProgram> {
    const mine = life;
    const client = act;
    if (!client) return { kind: "refused", why: say.linkClosed(robot) };
    setSpeedRatio(client, guide.override);
    const run = (text = handRapid(
      files,
      client,
      panel,
      scheduler,
      robot,
      left,
      () => sample.moving,
      async well => {
        if (text === run) text = null;
        if (!well || mine !== life || severed || panel.ctrl !== "motoron") return;
        // It moves nothing by itself.
        await startProgram(client, "forever");
        for (const from_s = scheduler.now_s(); !isGuided() && mine === life && scheduler.now_s() - from_s < GUIDES_S; )
          await pause(WATCH_S);
      },
    ));
    const handed = await run.handed;
    if (handed.kind === "refused" && text === run) text = null;
    return handed;
  }
  const setSpeedRatio = (client: RwsClient, ratio: number): void => {
    order(
      client.post(`${PANEL.speedratio}?action=setspeedratio`, { "speed-ratio": String(Math.round(100 * ratio)) }),
      "Setting the speed",
    );
  };

  return {
    brand: "ABB",
    robot,
    watchdog: { kind: "robot", within_s: COMM_TIMEOUT_S },
    // A robot that nobody moves from here may be heard of seldom; one that carries out our text may not (row X-41).
    get stale_s() {
      return events && !guides() && !text ? Math.max(stale_s, PANEL_STALE_S) : stale_s;
    },
    open,
    close() {
      close();
    },
    cannotSay: order =>
      order.kind === "signal" ? cannotWrite(order.signal) : order.kind === "gripper" ? cannotWrite(gripper) : null,
    move(motion) {
      if (!events) return Promise.resolve(refused(say.linkClosed(robot)));
      return guides() ? guide.move(motion) : Promise.resolve(refused(say.notStreamed(robot, "EGM is silent.")));
    },
    stop(emergency) {
      severed ||= emergency;
      if (emergency && brake) void brake.post(`${PANEL.ctrlstate}?action=setctrlstate`, { "ctrl-state": "motoroff" });
      guide.stop(emergency);
      text?.stop();
    },
    setOverride(ratio) {
      guide.setOverride(ratio);
      if (act && (text || !guides())) setSpeedRatio(act, ratio);
      return null;
    },
    async reset(wanted): Promise<CommandOutcome> {
      if (!act) return refused(say.linkClosed(robot));
      complaint = "";
      guide.rearm();
      const mine = life;
      const up = panel.safety === "normal" && isGuided();
      if (up && !severed) return DONE;
      rising = severed || safetyOf() === "emergency-stop";
      const outcome = await bringUp({
        client: act,
        panel,
        scheduler,
        robot,
        ctrlstate: PANEL.ctrlstate,
        execution: PANEL.ctrlexecstate,
        left,
        isGuided,
        wanted,
      });
      if (mine === life) {
        rising = false;
        if (outcome.kind === "done") severed = false;
      }
      return outcome;
    },
    setSignal,
    setGripper: closed => setSignal(gripper, closed),
    handText,
    async runText(files: readonly EmittedFile[]) {
      const handed = await handText(files);
      return handed.kind === "refused" ? handed : handed.start();
    },
  };
}
