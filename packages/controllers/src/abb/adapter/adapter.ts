import type { Network } from "../../transport/index.ts";
import type { EgmRobot } from "../codec/egm.ts";
import type {
  CommandOutcome,
  EmittedFile,
  UploadedProgram,
  JointSample,
  Refusal,
  SafetyState,
  Robot,
  Scheduler,
} from "@twincell/core";
import { DONE, refused } from "../../outcomes.ts";
import { pathText, type Login } from "../../http/index.ts";
import type { ControllerAdapter, AdapterEvents, Opened } from "../../driver/index.ts";
import { COMM_TIMEOUT_S, EGM_STATE, isAbbModel, MOTORS, RWS_LOGIN, RWS_PORT } from "../codec/index.ts";
import { createSetpointStream, type SetpointStreamOptions, type SetpointStream } from "./guide.ts";
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
  return abbAdapterOf(new AbbWire(options));
}

class AbbWire {
  readonly options: AbbAdapterOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly n: number;
  readonly port: number;
  readonly stale_s: number;
  readonly gripper: string;
  readonly guide: SetpointStream;
  readonly message: EgmRobot;
  readonly clock: SampleClock;
  readonly before_rad: Float64Array;
  readonly left = new Set<string>();
  // One session for as long as this driver lives: a controller has seventy, and what it holds is given back in it.
  readonly session: RwsSession;
  panel: PanelState;
  events: AdapterEvents | null = null;
  life = 0;
  polling = false;
  turn = 0;
  hasLines = true;
  axes = 0;
  poll: RwsClient | null = null;
  act: RwsClient | null = null;
  brake: RwsClient | null = null;
  timers: readonly (() => void)[] = [];
  broken: { readonly why: Refusal; readonly since_s: number } | null = null;
  severed = false;
  rising = false;
  text: TextRun | null = null;
  complaint = "";
  readonly sample: Lent;

  constructor(options: AbbAdapterOptions) {
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.n = this.robot.arm.joints.length;
    this.port = this.options.ports?.rws ?? RWS_PORT;
    this.stale_s = this.options.stale_s ?? STALE_S;
    this.gripper = this.options.gripperSignal ?? "doGripper";
    this.guide = createSetpointStream(this.options);
    this.message = this.guide.message;
    this.clock = new SampleClock(() => this.scheduler.now_s());
    this.before_rad = new Float64Array(this.n);
    this.session = new RwsSession(this.options.login ?? RWS_LOGIN);
    this.panel = new PanelState(this.robot);
    this.sample = {
      sequence: 0,
      time_s: 0,
      q_rad: new Float64Array(this.n),
      moving: false,
      mode: "manual",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      message: "",
      signals: this.panel.lines,
    };
  }

  guides(): boolean {
    return this.scheduler.now_s() - this.guide.heard_s <= this.stale_s;
  }

  /** Sooner than EGM counts as silent its place is taken by answers, so that nobody misses a state. */
  isFresh(): boolean {
    return this.scheduler.now_s() - this.guide.heard_s <= Math.min(this.stale_s, FILL_S);
  }

  readonly isGuided = (): boolean => this.guides() && say.notStreamedBecause(this.message) === "";

  safetyOf(): SafetyState {
    if (this.severed || this.rising) return "emergency-stop";
    if (this.panel.safety !== "normal" || this.panel.mode === "manual" || !this.guides()) return this.panel.safety;
    return this.message.motors === MOTORS.off
      ? "emergency-stop"
      : this.message.state === EGM_STATE.error
        ? "protective-stop"
        : "normal";
  }

  tell(q_rad: Float64Array, moving: boolean): void {
    const isByEgm = this.guides();
    const because = say.notStreamedBecause(this.message);
    this.sample.q_rad.set(q_rad);
    this.sample.sequence = this.clock.sequence;
    this.sample.time_s = this.clock.time_s;
    this.sample.moving = moving;
    this.sample.mode = this.panel.mode;
    this.sample.safety = this.safetyOf();
    this.sample.override = isByEgm && !this.text ? this.guide.override : this.panel.speedRatio / 100;
    this.sample.gripperClosed = this.panel.lines.get(this.gripper) === true;
    this.sample.message =
      this.panel.words !== ""
        ? this.panel.words
        : this.complaint !== ""
          ? this.complaint
          : this.panel.mode === "manual" || this.text
            ? ""
            : isByEgm
              ? because
              : "EGM is silent: no program there waits for targets.";
    this.events?.sample(this.sample);
  }

  /** The line is gone: the robot comes to rest first where it can still be told. */
  breakBy(why: Refusal): void {
    if (this.broken || !this.events) return;
    this.broken = { why, since_s: this.scheduler.now_s() };
    if (this.guide.isGoing) this.guide.stop(false, why);
    else this.lose();
  }

  lose(): void {
    const told = this.events;
    const { why } = this.broken!;
    this.close(why);
    told?.lost(why.sentence);
  }

  readonly watch = (): void => {
    const now_s = this.scheduler.now_s();
    if (this.broken) {
      if (!this.guide.isGoing || !this.guides() || now_s - this.broken.since_s > BRAKES_S) this.lose();
      return;
    }
    if (!this.guide.isGoing || this.guides()) return;
    this.broken = { why: say.guidingLost(this.robot, now_s - this.guide.heard_s), since_s: now_s };
    this.lose();
  };

  close(why: Refusal = say.linkClosed(this.robot)): void {
    this.life++;
    // Nobody will be there to end what is under way.
    if (this.brake && (this.guide.isGoing || this.text)) void stopProgram(this.brake, true);
    for (const stop of this.timers) stop();
    this.timers = [];
    for (const client of [this.poll, this.act, this.brake]) client?.close();
    this.poll = this.act = this.brake = this.events = null;
    this.polling = this.rising = false;
    this.broken = null;
    this.guide.close(why);
  }

  async round(client: RwsClient, mine: number): Promise<void> {
    const resource = TURNS[this.turn++ % TURNS.length]!;
    if (resource !== "lines" || this.hasLines) {
      const reply = await client.get(resource === "lines" ? SIGNALS : PANEL[resource]);
      if (mine !== this.life) return;
      const flaw = this.take(resource, reply);
      if (flaw !== null) {
        this.breakBy(say.servicesLost(this.robot, flaw));
        return;
      }
    }
    if (this.isFresh()) return;
    const reply = await client.get(JOINTS);
    if (mine !== this.life || this.isFresh()) return;
    this.before_rad.set(this.panel.q_rad);
    if (reply.kind !== "answer" || this.panel.takeJoints(reply.states) !== this.n) {
      this.breakBy(
        say.servicesLost(this.robot, reply.kind === "answer" ? "it does not say where the robot is." : reply.sentence),
      );
      return;
    }
    this.clock.ours();
    this.tell(
      this.panel.q_rad,
      this.panel.q_rad.some((q, i) => Math.abs(q - this.before_rad[i]!) > STANDS_RAD),
    );
  }

  /** Why the answer is none, or null. */
  take(resource: Resource, reply: RwsReply): string | null {
    if (reply.kind !== "answer") return reply.sentence;
    if (resource === "lines") this.panel.takeLines(reply.states);
    else if (!this.panel.takePanel(resource, reply.states)) return `it does not tell its ${resource}.`;
    return null;
  }

  readonly open = async (heard: AdapterEvents): Promise<Opened> => {
    this.close();
    const mine = this.life;
    const fail = (why: Refusal, again: boolean): Opened => {
      if (mine === this.life) this.close();
      return { kind: "failed", why, again };
    };
    const client = (): RwsClient =>
      new RwsClient({
        network: this.network,
        scheduler: this.scheduler,
        session: this.session,
        to: { host: this.host, port: this.port },
        lost: sentence => {
          this.breakBy(say.servicesLost(this.robot, sentence));
        },
        roundTrip: seconds => {
          this.events?.roundTrip(seconds);
        },
      });
    const own = (this.poll = client());
    const type = await own.get("/rw/system/robottype");
    if (mine !== this.life) return fail(say.linkClosed(this.robot), true);
    if (type.kind !== "answer" && (type.kind === "lost" || type.status !== 404))
      return fail(say.noServices(this.host, this.port, type.sentence), type.kind === "lost" || type.status === 503);
    const model = type.kind === "answer" ? type.states[0]?.fields["robot-type"] : undefined;
    if (
      model !== undefined &&
      !isAbbModel(this.options.model ?? this.robot.vendorSection?.model ?? this.robot.name, model)
    )
      return fail(say.otherRobot(this.robot, model), false);
    const now = (this.panel = new PanelState(this.robot));
    this.sample.signals = now.lines;
    for (const resource of ["ctrlstate", "opmode", "ctrlexecstate", "speedratio"] as const) {
      const flaw = this.take(resource, await own.get(PANEL[resource]));
      if (flaw !== null) return fail(say.noServices(this.host, this.port, flaw), true);
    }
    const joints = await own.get(JOINTS);
    const count = joints.kind === "answer" ? now.takeJoints(joints.states) : null;
    if (count === null)
      return fail(
        say.noServices(
          this.host,
          this.port,
          joints.kind === "answer" ? "it does not say where the robot is." : joints.sentence,
        ),
        true,
      );
    if (count !== this.n) return fail(say.otherAxes(this.robot, count), false);
    // Each of the other lines is there before it is needed.
    this.act = client();
    this.brake = client();
    const lines = await this.act.get(SIGNALS);
    await this.brake.get(PANEL.ctrlstate);
    this.hasLines = this.take("lines", lines) === null;
    if (mine !== this.life) return fail(say.linkClosed(this.robot), true);
    this.axes = this.n;
    const watched = this.options.isWatched?.() ?? false;
    const deaf = watched
      ? null
      : await this.guide.open({
          state: (_, got) => {
            this.axes = got;
            if (got !== this.n) {
              this.breakBy(say.otherAxes(this.robot, got));
              return;
            }
            this.clock.theirs(this.message.sequence, this.message.time_ms);
            this.tell(this.guide.q_rad, this.guide.isMoving);
          },
        });
    if (deaf) return fail(deaf, true);
    for (
      const from_s = this.scheduler.now_s();
      !watched &&
      !this.guides() &&
      this.axes === this.n &&
      mine === this.life &&
      this.scheduler.now_s() - from_s < GUIDES_S;
    )
      await this.pause(WATCH_S);
    if (mine !== this.life) return fail(say.linkClosed(this.robot), true);
    if (this.axes !== this.n) return fail(say.otherAxes(this.robot, this.axes), false);
    this.severed = false;
    this.complaint = "";
    this.events = heard;
    this.timers = [
      this.scheduler.every(WATCH_S, this.watch),
      this.scheduler.every(this.options.period_s ?? PERIOD_S, () => {
        if (this.polling) return;
        this.polling = true;
        void this.round(own, mine).then(() => {
          if (mine === this.life) this.polling = false;
        });
      }),
    ];
    return { kind: "open" };
  };

  pause(seconds: number): Promise<void> {
    return new Promise(resolve => {
      const stop = this.scheduler.every(seconds, () => {
        stop();
        resolve();
      });
    });
  }

  /** Orders that nobody waits for: what the controller says against them is told with the states. */
  order(answered: Promise<RwsReply>, what: string): void {
    void answered.then(reply => {
      this.complaint = reply.kind === "refused" ? say.refusedThere(what, reply.sentence).sentence : "";
    });
  }

  cannotWrite(signal: string): Refusal | null {
    return this.panel.places.has(signal) ? null : say.noSuchLine(signal);
  }

  readonly setSignal = (signal: string, value: boolean | number): Refusal | null => {
    if (!this.act) return say.linkClosed(this.robot);
    const why = this.cannotWrite(signal);
    if (why) return why;
    const place = this.panel.places.get(signal)!;
    this.order(
      this.act.post(`${SIGNALS}${pathText(place.split("/"))}?action=set`, { lvalue: String(Number(value)) }),
      `Writing "${signal}"`,
    );
    return null;
  };

  readonly handText = async (files: readonly EmittedFile[]): Promise<UploadedProgram> => {
    const mine = this.life;
    const client = this.act;
    if (!client) return { kind: "refused", why: say.linkClosed(this.robot) };
    this.setSpeedRatio(client, this.guide.override);
    const run = (this.text = handRapid(
      files,
      client,
      this.panel,
      this.scheduler,
      this.robot,
      this.left,
      () => this.sample.moving,
      async well => {
        if (this.text === run) this.text = null;
        if (!well || mine !== this.life || this.severed || this.panel.ctrl !== "motoron") return;
        // It moves nothing by itself.
        await startProgram(client, "forever");
        for (
          const from_s = this.scheduler.now_s();
          !this.isGuided() && mine === this.life && this.scheduler.now_s() - from_s < GUIDES_S;
        )
          await this.pause(WATCH_S);
      },
    ));
    const handed = await run.handed;
    if (handed.kind === "refused" && this.text === run) this.text = null;
    return handed;
  };

  setSpeedRatio(client: RwsClient, ratio: number): void {
    this.order(
      client.post(`${PANEL.speedratio}?action=setspeedratio`, { "speed-ratio": String(Math.round(100 * ratio)) }),
      "Setting the speed",
    );
  }
}

function abbAdapterOf(wire: AbbWire): ControllerAdapter {
  return {
    brand: "ABB",
    robot: wire.robot,
    watchdog: { kind: "robot", within_s: COMM_TIMEOUT_S },
    // A robot that nobody moves from here may be heard of seldom; one that carries out our text may not (row X-41).
    get stale_s() {
      return wire.events && !wire.guides() && !wire.text ? Math.max(wire.stale_s, PANEL_STALE_S) : wire.stale_s;
    },
    open: wire.open,
    close() {
      wire.close();
    },
    cannotSay: order =>
      order.kind === "signal"
        ? wire.cannotWrite(order.signal)
        : order.kind === "gripper"
          ? wire.cannotWrite(wire.gripper)
          : null,
    move(motion) {
      if (!wire.events) return Promise.resolve(refused(say.linkClosed(wire.robot)));
      return wire.guides()
        ? wire.guide.move(motion)
        : Promise.resolve(refused(say.notStreamed(wire.robot, "EGM is silent.")));
    },
    stop(emergency) {
      wire.severed ||= emergency;
      if (emergency && wire.brake)
        void wire.brake.post(`${PANEL.ctrlstate}?action=setctrlstate`, { "ctrl-state": "motoroff" });
      wire.guide.stop(emergency);
      wire.text?.stop();
    },
    setOverride(ratio) {
      wire.guide.setOverride(ratio);
      if (wire.act && (wire.text || !wire.guides())) wire.setSpeedRatio(wire.act, ratio);
      return null;
    },
    async reset(wanted): Promise<CommandOutcome> {
      if (!wire.act) return refused(say.linkClosed(wire.robot));
      wire.complaint = "";
      wire.guide.rearm();
      const mine = wire.life;
      const up = wire.panel.safety === "normal" && wire.isGuided();
      if (up && !wire.severed) return DONE;
      wire.rising = wire.severed || wire.safetyOf() === "emergency-stop";
      const outcome = await bringUp({
        client: wire.act,
        panel: wire.panel,
        scheduler: wire.scheduler,
        robot: wire.robot,
        ctrlstate: PANEL.ctrlstate,
        execution: PANEL.ctrlexecstate,
        left: wire.left,
        isGuided: wire.isGuided,
        wanted,
      });
      if (mine === wire.life) {
        wire.rising = false;
        if (outcome.kind === "done") wire.severed = false;
      }
      return outcome;
    },
    setSignal: wire.setSignal,
    setGripper: closed => wire.setSignal(wire.gripper, closed),
    handText: wire.handText,
    async runText(files: readonly EmittedFile[]) {
      const handed = await wire.handText(files);
      return handed.kind === "refused" ? handed : handed.start();
    },
  };
}
