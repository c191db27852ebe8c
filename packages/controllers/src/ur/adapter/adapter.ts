import type { CommandOutcome, EmittedFile, UploadedProgram, Refusal, Robot, Scheduler } from "@twincell/core";
import {
  Execution,
  type ControllerAdapter,
  type AdapterEvents,
  type AdapterMotion,
  type AdapterOptions,
  type AdapterOrder,
  type Opened,
  type Underway,
} from "../../driver/index.ts";
import type { ByteStream, Network } from "../../transport/index.ts";
import { REPLIES } from "../codec/dashboard.ts";
import { JOINTS, modelOf, UR_PORTS } from "../codec/models.ts";
import {
  EMERGENCY_STOPS,
  ROBOT_MODE,
  robotModeName,
  SAFEGUARD_STOPS,
  SAFETY_MODE,
  safetyModeName,
} from "../codec/modes.ts";
import type { PrimaryMessage } from "../codec/primary.ts";
import { CONTROL_PROGRAM, WATCHDOG_S } from "./control-program.ts";
import { dashboardClient, type DashboardClient } from "./dashboard-client.ts";
import { GROUPS, INPUTS, isOutput, Orders } from "./orders.ts";
import { primaryClient, type PrimaryClient } from "./primary-client.ts";
import { openRtde, type RtdeClient } from "./rtde-client.ts";
import { GRIPPER_LINE, OUTPUTS, RATE_HZ, UrReading } from "./state.ts";
import { stoppedInReset } from "../../refusals.ts";
import * as words from "./words.ts";
import { DONE, refused, stopped } from "../../outcomes.ts";

/** Without a state for this long the link is lost; the heartbeat goes five times as often as the robot wants it [s]. */
const STALE_S = 0.08;
const BEAT_S = WATCHDOG_S / 5;
/** A stop that the program on the robot does not confirm in this time goes through the dashboard as well [s]. */
const STOP_CONFIRMED_S = 0.05;
/**
 * So many heartbeats that the controller does not hear, while its states come, and the line is good in one direction
 * only.
 */
const DEAF = 40;
const LOOK_S = 0.004;
const ASK_REMOTE_S = 0.1;
/** The program on the robot takes so long to begin at most; drives and brakes [s]. */
const PROGRAM_S = 3;
const POWER_S = 60;

interface Open {
  readonly rtde: RtdeClient;
  readonly dashboard: DashboardClient;
  readonly primary: PrimaryClient;
  readonly reading: UrReading;
  readonly orders: Orders;
  /** Timers that end with the connection. */
  readonly stops: (() => void)[];
  /** Opened to watch: no inputs are taken and no program is uploaded. */
  readonly watched: boolean;
  remote: boolean;
  said: string;
  /** Heartbeats since the controller last told that it heard one, and the one that it told. */
  unheard: number;
  echo: number;
}

const cannotSay = (order: AdapterOrder): Refusal | null =>
  order.kind === "signal" && !isOutput(order.signal) ? words.noSuchLine(order.signal) : null;

/**
 * Drives a robot of Universal Robots: states over RTDE at 500 Hz, motions as orders in RTDE's registers to a small
 * program that is uploaded to the robot, power and safety over the dashboard, program texts and messages over the
 * primary interface.
 */
export function createUrAdapter(options: AdapterOptions): ControllerAdapter {
  return urAdapterOf(new UrWire(options));
}

class UrWire extends Execution<Underway> {
  readonly options: AdapterOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly ports: {
    dashboard: number;
    primary: number;
    secondary: number;
    realTime: number;
    rtde: number;
    primaryCopy: number;
    secondaryCopy: number;
    realTimeCopy: number;
  };
  open: Open | null = null;
  life = 0;
  textRunning = false;
  stops = 0;
  awaited = 0;

  constructor(options: AdapterOptions) {
    super();
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.ports = { ...UR_PORTS, ...this.options.ports };
  }

  readonly closeAll = (): void => {
    const was = this.open;
    this.open = null;
    this.life++;
    for (const stop of was?.stops ?? []) stop();
    was?.rtde.close();
    was?.dashboard.close();
    was?.primary.close();
    this.settle(stopped(words.ended(this.robot, "the connection was closed.")));
  };

  /** Looks again and again until it is so, or time is up, or the connection is another. */
  until(so: () => boolean, patience_s: number): Promise<boolean> {
    return new Promise(resolve => {
      if (so()) {
        resolve(true);
        return;
      }
      const mine = this.life;
      const end_s = this.scheduler.now_s() + patience_s;
      const stop = this.scheduler.every(LOOK_S, () => {
        const is = this.life === mine && so();
        if (!is && this.life === mine && this.scheduler.now_s() < end_s) return;
        stop();
        resolve(is);
      });
    });
  }

  message(at: Open): string {
    return at.said !== ""
      ? at.said
      : at.reading.mayMove
        ? ""
        : at.reading.safetyMode === SAFETY_MODE.NORMAL
          ? `Robot mode ${robotModeName(at.reading.robotMode)}.`
          : `Safety mode ${safetyModeName(at.reading.safetyMode)}.`;
  }

  onMessage(at: () => Open | null, said: PrimaryMessage): void {
    const is = at();
    if (!is) return;
    if (said.kind === "exception") is.said = `Line ${said.line}: ${said.text}`;
    else if (said.kind === "error" && said.text !== "") is.said = said.text;
    else if (said.kind === "safety-mode" && (said.mode === SAFETY_MODE.NORMAL || said.mode === SAFETY_MODE.REDUCED))
      is.said = "";
  }

  /** What an order waits for: its number among those that have ended, or the end of the program. */
  onState(at: Open): void {
    if (at.reading.echo !== at.echo) {
      at.echo = at.reading.echo;
      at.unheard = 0;
    }
    if (!this.moving) return;
    const { reading } = at;
    if (this.textRunning) return;
    if (!reading.listens) {
      // Whatever the state is worth: nothing is to move when a motion is said to have ended. A program that a safeguard
      // holds would go on when the guard closes; it is ended, so that only a new command moves the robot.
      this.stop(false);
      if (!reading.isIdle) void at.dashboard.ask("stop");
      this.settle(stopped(words.ended(this.robot, this.message(at))));
    } else if (reading.ended === this.awaited) this.settle(this.ending ?? DONE);
  }

  async connected(port: number): Promise<ByteStream | string> {
    const answer = await this.network.connect({ host: this.host, port });
    return answer.kind === "connected" ? answer.stream : answer.sentence;
  }

  readonly attempt = async (events: AdapterEvents): Promise<Opened> => {
    const watched = this.options.isWatched?.() ?? false;
    const mine = ++this.life;
    const isMine = (): boolean => mine === this.life;
    const streams: ByteStream[] = [];
    const failed = (why: Refusal, again = true): Opened => {
      for (const stream of streams) stream.close();
      if (isMine()) this.life++;
      return { kind: "failed", why, again };
    };
    const lost = (sentence: string): void => {
      if (isMine()) {
        this.closeAll();
        events.lost(sentence);
      }
    };
    if (this.robot.arm.joints.length !== JOINTS) return failed(words.jointCount(this.robot, JOINTS), false);
    for (const port of [this.ports.dashboard, this.ports.primary, this.ports.rtde]) {
      const stream = await this.connected(port);
      if (typeof stream === "string") return failed(words.noAnswer(stream));
      streams.push(stream);
      if (!isMine()) return failed(words.noAnswer("The attempt was given up."));
    }
    const [first, second, third] = streams;
    const dashboard = dashboardClient(
      first!,
      this.scheduler,
      seconds => {
        if (isMine()) events.roundTrip(seconds);
      },
      lost,
    );
    const model = await dashboard.ask("get robot model");
    const wanted = modelOf(this.robot);
    if (model === null) return failed(words.noAnswer("The dashboard does not answer."));
    if (model.trim() !== wanted) return failed(words.otherModel(this.robot, wanted, model.trim()), false);
    const isRemote = await dashboard.ask("is in remote control");
    let at: Open | null = null;
    const rtde = await openRtde(third!, this.scheduler, OUTPUTS, watched ? [] : INPUTS, RATE_HZ, {
      state: () => {
        if (!at || !isMine()) return;
        events.sample(at.reading.read(at.remote, this.message(at)));
        if (this.open === at) this.onState(at);
      },
      says(sentence) {
        if (at) at.said = sentence;
      },
      lost,
    });
    if (rtde.kind === "failed" || !isMine()) {
      dashboard.close();
      return failed(words.noAnswer(rtde.kind === "failed" ? rtde.sentence : "The attempt was given up."));
    }
    const { client } = rtde;
    const reading = new UrReading(client.state, this.robot);
    at = {
      rtde: client,
      dashboard,
      reading,
      orders: new Orders(client.inputs, this.robot, Math.floor(this.scheduler.now_s() * 1000) % 1_000_000),
      stops: [],
      primary: primaryClient(
        second!,
        said => {
          if (isMine()) this.onMessage(() => at, said);
        },
        lost,
      ),
      // Controllers before 5.6 know no local control, and do not understand the question.
      watched,
      remote: isRemote !== "false",
      said: "",
      unheard: 0,
      echo: NaN,
    };
    this.open = at;
    at.stops.push(
      this.scheduler.every(BEAT_S, () => {
        if (!at) return;
        at.orders.beat();
        at.rtde.send(GROUPS.heartbeat);
        if (!watched && ++at.unheard > DEAF) lost("The controller sends states and does not hear what is sent to it.");
      }),
    );
    let asking = false;
    at.stops.push(
      this.scheduler.every(ASK_REMOTE_S, () => {
        if (asking) return;
        asking = true;
        void dashboard.ask("is in remote control").then(answer => {
          asking = false;
          if (at && answer !== null) at.remote = answer !== "false";
        });
      }),
    );
    if (!(await this.until(() => reading.robotMode !== 0 || reading.runtime !== 0, STALE_S * 10))) {
      this.closeAll();
      return { kind: "failed", why: words.noAnswer("RTDE sends no states."), again: true };
    }
    // A program of somebody else's is left alone; it is told when a motion is asked for.
    if (!watched && reading.mayMove && at.remote && reading.isIdle) await this.program();
    return this.open === at
      ? { kind: "open" }
      : { kind: "failed", why: words.noAnswer("The connection broke while it was being opened."), again: true };
  };

  /** Makes sure that our program listens; why not, else. */
  async program(): Promise<Refusal | null> {
    const at = this.open;
    if (!at) return words.noAnswer("There is no connection.");
    const { reading } = at;
    if (reading.listens) return null;
    if (!at.remote) return words.inLocal(this.robot);
    if (!reading.mayMove)
      return words.notReady(this.robot, robotModeName(reading.robotMode), safetyModeName(reading.safetyMode));
    if (!reading.isIdle) return words.otherProgram(this.robot);
    at.said = "";
    at.orders.beat();
    at.rtde.send(GROUPS.heartbeat);
    at.rtde.send(GROUPS.order);
    at.primary.script(CONTROL_PROGRAM);
    return (await this.until(
      () => (reading.listens && reading.ended === at.orders.number) || at.said !== "",
      PROGRAM_S,
    )) && reading.listens
      ? null
      : words.noStart(this.robot, at.said);
  }

  async order(send: (orders: Orders) => number): Promise<CommandOutcome> {
    const before = this.stops;
    const why = await this.program();
    const at = this.open;
    if (why || !at) return refused(why ?? words.noAnswer("There is no connection."));
    // While the program was being started a stop may have come: what it stopped is not sent after it.
    if (this.stops !== before) return stopped(words.ended(this.robot, "it was stopped."));
    at.said = "";
    this.settle(stopped(words.ended(this.robot, "another order came.")));
    return this.execute(
      resolve => ({ resolve }),
      () => {
        this.awaited = send(at.orders);
        at.rtde.send(GROUPS.order);
      },
    );
  }

  /** A command of the dashboard whose answer begins as it should. */
  async tell(at: Open, command: string, wanted: string): Promise<Refusal | null> {
    const answer = await at.dashboard.ask(command);
    return answer?.startsWith(wanted) === true ? null : words.dashboardSays(command, answer);
  }

  readonly reset = async (wanted: () => boolean): Promise<CommandOutcome> => {
    const at = this.open;
    if (!at) return refused(words.noAnswer("There is no connection."));
    const { reading } = at;
    const { safetyMode } = reading;
    if (!at.remote) return refused(words.inLocal(this.robot));
    if (EMERGENCY_STOPS.has(safetyMode)) return refused(words.buttonPressed(this.robot));
    if (SAFEGUARD_STOPS.has(safetyMode)) return refused(words.stillGuarded(this.robot));
    if (safetyMode === SAFETY_MODE.PROTECTIVE_STOP) {
      const answer = await at.dashboard.ask("unlock protective stop");
      if (answer === REPLIES.tooSoon) return refused(words.tooSoon(this.robot));
      if (answer !== REPLIES.unlocking) return refused(words.dashboardSays("unlock protective stop", answer));
    } else if (safetyMode === SAFETY_MODE.FAULT || safetyMode === SAFETY_MODE.VIOLATION) {
      const why = await this.tell(at, "restart safety", "Restarting");
      if (why) return refused(why);
    }
    if (
      !(await this.until(
        () => !wanted() || reading.safetyMode === SAFETY_MODE.NORMAL || reading.safetyMode === SAFETY_MODE.REDUCED,
        PROGRAM_S,
      ))
    )
      return refused(words.tookTooLong(this.robot, "free of its safety stop", PROGRAM_S));
    if (!wanted()) return refused(stoppedInReset(this.robot));
    if (reading.robotMode < ROBOT_MODE.IDLE) {
      const why = await this.tell(at, "power on", REPLIES.poweringOn);
      if (why) return refused(why);
      if (!(await this.until(() => !wanted() || reading.robotMode >= ROBOT_MODE.IDLE, POWER_S)))
        return refused(words.tookTooLong(this.robot, "powered on", POWER_S));
    }
    if (!wanted()) return refused(stoppedInReset(this.robot));
    if (reading.robotMode !== ROBOT_MODE.RUNNING) {
      const why = await this.tell(at, "brake release", REPLIES.releasing);
      if (why) return refused(why);
      if (!(await this.until(() => !wanted() || reading.robotMode === ROBOT_MODE.RUNNING, POWER_S)))
        return refused(words.tookTooLong(this.robot, "free of its brakes", POWER_S));
    }
    if (!wanted()) return refused(stoppedInReset(this.robot));
    at.said = "";
    const why = reading.isIdle ? await this.program() : null;
    return why ? refused(why) : DONE;
  };

  /**
   * Our own program makes room for it; it is sent when it is to start, because a UR begins with a text as soon as it
   * has it.
   */
  readonly handText = async (files: readonly EmittedFile[]): Promise<UploadedProgram> => {
    const at = this.open;
    const text = files[0]?.text;
    const no = (why: Refusal): UploadedProgram => {
      this.textRunning = false;
      return { kind: "refused", why };
    };
    if (!at) return no(words.noAnswer("There is no connection."));
    if (text === undefined || text.trim() === "") return no(words.noText());
    const { reading } = at;
    const before = this.stops;
    if (!at.remote) return no(words.inLocal(this.robot));
    if (!reading.mayMove)
      return no(words.notReady(this.robot, robotModeName(reading.robotMode), safetyModeName(reading.safetyMode)));
    this.textRunning = true;
    if (reading.listens) {
      const why = await this.tell(at, "stop", REPLIES.stopped);
      if (why || !(await this.until(() => reading.isIdle, PROGRAM_S))) return no(why ?? words.otherProgram(this.robot));
    }
    if (!reading.isIdle) return no(words.otherProgram(this.robot));
    return {
      kind: "handed",
      drop: () => {
        this.textRunning = false;
      },
      start: () => this.startText(at, text, before),
    };
  };

  async startText(at: Open, text: string, before: number): Promise<CommandOutcome> {
    const { reading } = at;
    try {
      if (this.open !== at || this.stops !== before)
        return stopped(words.ended(this.robot, this.open === at ? "it was stopped." : "the connection was closed."));
      if (!reading.isIdle) return refused(words.otherProgram(this.robot));
      at.said = "";
      at.primary.script(text);
      const began = await this.until(() => reading.isPlaying || at.said !== "", PROGRAM_S);
      if (!began) return refused(words.noStart(this.robot, at.said));
      await this.until(() => reading.isIdle, Infinity);
      // What went wrong may be told just after the program has ended.
      await this.until(() => at.said !== "", 2 * LOOK_S);
      if (at.said !== "") return stopped(words.programFailed(at.said));
      return this.open === at && reading.mayMove ? DONE : stopped(words.ended(this.robot, this.message(at)));
    } finally {
      this.textRunning = false;
    }
  }

  readonly runText = async (files: readonly EmittedFile[]): Promise<CommandOutcome> => {
    const handed = await this.handText(files);
    return handed.kind === "refused" ? handed : handed.start();
  };

  readonly stop = (emergency: boolean): void => {
    const at = this.open;
    this.stops++;
    if (!at) return;
    // Whatever program runs there: of one that is only watched nothing else is known.
    if (this.textRunning || at.watched || at.rtde.waiting > 0) void at.dashboard.ask("stop");
    const number = at.orders.stop();
    at.rtde.send(GROUPS.order);
    this.awaited = number;
    this.ending = stopped(words.ended(this.robot, "it was stopped."));
    if (emergency) {
      void at.dashboard.ask("power off");
      return;
    }
    const look = this.scheduler.every(STOP_CONFIRMED_S, () => {
      look();
      if (
        this.open === at &&
        at.reading.isPlaying &&
        at.reading.ended !== number &&
        at.reading.sample.moving &&
        at.orders.number === number
      )
        void at.dashboard.ask("stop");
    });
  };
}

function urAdapterOf(wire: UrWire): ControllerAdapter {
  return {
    brand: "Universal Robots",
    robot: wire.robot,
    stale_s: STALE_S,
    watchdog: { kind: "robot", within_s: WATCHDOG_S },
    open: wire.attempt,
    close: wire.closeAll,
    cannotSay,
    move: (motion: AdapterMotion) => wire.order(orders => orders.motion(motion)),
    stop: wire.stop,
    setOverride(ratio) {
      if (!wire.open) return words.noAnswer("There is no connection.");
      if (!wire.open.remote) return words.inLocal(wire.robot);
      wire.open.orders.slider(ratio);
      wire.open.rtde.send(GROUPS.slider);
      return null;
    },
    reset: wire.reset,
    setSignal(signal, value) {
      const why = cannotSay({ kind: "signal", signal, value });
      if (why) return why;
      if (!wire.open) return words.noAnswer("There is no connection.");
      wire.open.rtde.send(wire.open.orders.line(signal, value));
      return null;
    },
    setGripper(closed) {
      return this.setSignal(`digital_out_${GRIPPER_LINE}`, closed);
    },
    setPayload(mass_kg, center_m) {
      if (!wire.open) return words.noAnswer("There is no connection.");
      wire.open.orders.payload(mass_kg, center_m);
      wire.open.rtde.send(GROUPS.order);
      return null;
    },
    runText: wire.runText,
    handText: wire.handText,
  };
}
