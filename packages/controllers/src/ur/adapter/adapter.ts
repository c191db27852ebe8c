import type { CommandOutcome, EmittedFile, UploadedProgram, Refusal } from "@twincell/core";
import type {
  ControllerAdapter,
  AdapterEvents,
  AdapterMotion,
  AdapterOptions,
  AdapterOrder,
  Opened,
} from "../../driver/index.ts";
import type { ByteStream } from "../../transport/index.ts";
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
  const { robot, scheduler, network, host } = options;
  const ports = { ...UR_PORTS, ...options.ports };
  let open: Open | null = null;
  let life = 0;
  let textRunning = false;
  let stops = 0;
  let settle: ((outcome: CommandOutcome) => void) | null = null;
  let awaited = 0;
  let goal: CommandOutcome = DONE;

  const end = (outcome: CommandOutcome): void => {
    const is = settle;
    settle = null;
    is?.(outcome);
  };
  function closeAll(): void {
    const was = open;
    open = null;
    life++;
    for (const stop of was?.stops ?? []) stop();
    was?.rtde.close();
    was?.dashboard.close();
    was?.primary.close();
    end(stopped(words.ended(robot, "the connection was closed.")));
  }
  /** Looks again and again until it is so, or time is up, or the connection is another. */
  const until = (so: () => boolean, patience_s: number): Promise<boolean> =>
    new Promise(resolve => {
      if (so()) {
        resolve(true);
        return;
      }
      const mine = life;
      const end_s = scheduler.now_s() + patience_s;
      const stop = scheduler.every(LOOK_S, () => {
        const is = life === mine && so();
        if (!is && life === mine && scheduler.now_s() < end_s) return;
        stop();
        resolve(is);
      });
    });
  const message = (at: Open): string =>
    at.said !== ""
      ? at.said
      : at.reading.mayMove
        ? ""
        : at.reading.safetyMode === SAFETY_MODE.NORMAL
          ? `Robot mode ${robotModeName(at.reading.robotMode)}.`
          : `Safety mode ${safetyModeName(at.reading.safetyMode)}.`;

  function onMessage(at: () => Open | null, said: PrimaryMessage): void {
    const is = at();
    if (!is) return;
    if (said.kind === "exception") is.said = `Line ${said.line}: ${said.text}`;
    else if (said.kind === "error" && said.text !== "") is.said = said.text;
    else if (said.kind === "safety-mode" && (said.mode === SAFETY_MODE.NORMAL || said.mode === SAFETY_MODE.REDUCED))
      is.said = "";
  }

  /** What an order waits for: its number among those that have ended, or the end of the program. */
  function onState(at: Open): void {
    if (at.reading.echo !== at.echo) {
      at.echo = at.reading.echo;
      at.unheard = 0;
    }
    if (!settle) return;
    const { reading } = at;
    if (textRunning) return;
    if (!reading.listens) {
      // Whatever the state is worth: nothing is to move when a motion is said to have ended. A program that a safeguard
      // holds would go on when the guard closes; it is ended, so that only a new command moves the robot.
      stop(false);
      if (!reading.isIdle) void at.dashboard.ask("stop");
      end(stopped(words.ended(robot, message(at))));
    } else if (reading.ended === awaited) end(goal);
  }

  async function connected(port: number): Promise<ByteStream | string> {
    const answer = await network.connect({ host, port });
    return answer.kind === "connected" ? answer.stream : answer.sentence;
  }
  async function attempt(events: AdapterEvents): Promise<Opened> {
    const watched = options.isWatched?.() ?? false;
    const mine = ++life;
    const isMine = (): boolean => mine === life;
    const streams: ByteStream[] = [];
    const failed = (why: Refusal, again = true): Opened => {
      for (const stream of streams) stream.close();
      if (isMine()) life++;
      return { kind: "failed", why, again };
    };
    const lost = (sentence: string): void => {
      if (isMine()) {
        closeAll();
        events.lost(sentence);
      }
    };
    if (robot.arm.joints.length !== JOINTS) return failed(words.jointCount(robot, JOINTS), false);
    for (const port of [ports.dashboard, ports.primary, ports.rtde]) {
      const stream = await connected(port);
      if (typeof stream === "string") return failed(words.noAnswer(stream));
      streams.push(stream);
      if (!isMine()) return failed(words.noAnswer("The attempt was given up."));
    }
    const [first, second, third] = streams;
    const dashboard = dashboardClient(
      first!,
      scheduler,
      seconds => {
        if (isMine()) events.roundTrip(seconds);
      },
      lost,
    );
    const model = await dashboard.ask("get robot model");
    const wanted = modelOf(robot);
    if (model === null) return failed(words.noAnswer("The dashboard does not answer."));
    if (model.trim() !== wanted) return failed(words.otherModel(robot, wanted, model.trim()), false);
    const isRemote = await dashboard.ask("is in remote control");
    let at: Open | null = null;
    const rtde = await openRtde(third!, scheduler, OUTPUTS, watched ? [] : INPUTS, RATE_HZ, {
      state() {
        if (!at || !isMine()) return;
        events.sample(at.reading.read(at.remote, message(at)));
        if (open === at) onState(at);
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
    const reading = new UrReading(client.state, robot);
    at = {
      rtde: client,
      dashboard,
      reading,
      orders: new Orders(client.inputs, robot, Math.floor(scheduler.now_s() * 1000) % 1_000_000),
      stops: [],
      primary: primaryClient(
        second!,
        said => {
          if (isMine()) onMessage(() => at, said);
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
    open = at;
    at.stops.push(
      scheduler.every(BEAT_S, () => {
        if (!at) return;
        at.orders.beat();
        at.rtde.send(GROUPS.heartbeat);
        if (!watched && ++at.unheard > DEAF) lost("The controller sends states and does not hear what is sent to it.");
      }),
    );
    let asking = false;
    at.stops.push(
      scheduler.every(ASK_REMOTE_S, () => {
        if (asking) return;
        asking = true;
        void dashboard.ask("is in remote control").then(answer => {
          asking = false;
          if (at && answer !== null) at.remote = answer !== "false";
        });
      }),
    );
    if (!(await until(() => reading.robotMode !== 0 || reading.runtime !== 0, STALE_S * 10))) {
      closeAll();
      return { kind: "failed", why: words.noAnswer("RTDE sends no states."), again: true };
    }
    // A program of somebody else's is left alone; it is told when a motion is asked for.
    if (!watched && reading.mayMove && at.remote && reading.isIdle) await program();
    return open === at
      ? { kind: "open" }
      : { kind: "failed", why: words.noAnswer("The connection broke while it was being opened."), again: true };
  }

  /** Makes sure that our program listens; why not, else. */
  async function program(): Promise<Refusal | null> {
    const at = open;
    if (!at) return words.noAnswer("There is no connection.");
    const { reading } = at;
    if (reading.listens) return null;
    if (!at.remote) return words.inLocal(robot);
    if (!reading.mayMove)
      return words.notReady(robot, robotModeName(reading.robotMode), safetyModeName(reading.safetyMode));
    if (!reading.isIdle) return words.otherProgram(robot);
    at.said = "";
    at.orders.beat();
    at.rtde.send(GROUPS.heartbeat);
    at.rtde.send(GROUPS.order);
    at.primary.script(CONTROL_PROGRAM);
    return (await until(() => (reading.listens && reading.ended === at.orders.number) || at.said !== "", PROGRAM_S)) &&
      reading.listens
      ? null
      : words.noStart(robot, at.said);
  }

  async function order(send: (orders: Orders) => number): Promise<CommandOutcome> {
    const before = stops;
    const why = await program();
    const at = open;
    if (why || !at) return refused(why ?? words.noAnswer("There is no connection."));
    // While the program was being started a stop may have come: what it stopped is not sent after it.
    if (stops !== before) return stopped(words.ended(robot, "it was stopped."));
    at.said = "";
    return new Promise(resolve => {
      end(stopped(words.ended(robot, "another order came.")));
      settle = resolve;
      goal = DONE;
      awaited = send(at.orders);
      at.rtde.send(GROUPS.order);
    });
  }

  /** A command of the dashboard whose answer begins as it should. */
  async function tell(at: Open, command: string, wanted: string): Promise<Refusal | null> {
    const answer = await at.dashboard.ask(command);
    return answer?.startsWith(wanted) === true ? null : words.dashboardSays(command, answer);
  }
  async function reset(wanted: () => boolean): Promise<CommandOutcome> {
    const at = open;
    if (!at) return refused(words.noAnswer("There is no connection."));
    const { reading } = at;
    const { safetyMode } = reading;
    if (!at.remote) return refused(words.inLocal(robot));
    if (EMERGENCY_STOPS.has(safetyMode)) return refused(words.buttonPressed(robot));
    if (SAFEGUARD_STOPS.has(safetyMode)) return refused(words.stillGuarded(robot));
    if (safetyMode === SAFETY_MODE.PROTECTIVE_STOP) {
      const answer = await at.dashboard.ask("unlock protective stop");
      if (answer === REPLIES.tooSoon) return refused(words.tooSoon(robot));
      if (answer !== REPLIES.unlocking) return refused(words.dashboardSays("unlock protective stop", answer));
    } else if (safetyMode === SAFETY_MODE.FAULT || safetyMode === SAFETY_MODE.VIOLATION) {
      const why = await tell(at, "restart safety", "Restarting");
      if (why) return refused(why);
    }
    if (
      !(await until(
        () => !wanted() || reading.safetyMode === SAFETY_MODE.NORMAL || reading.safetyMode === SAFETY_MODE.REDUCED,
        PROGRAM_S,
      ))
    )
      return refused(words.tookTooLong(robot, "free of its safety stop", PROGRAM_S));
    if (!wanted()) return refused(stoppedInReset(robot));
    if (reading.robotMode < ROBOT_MODE.IDLE) {
      const why = await tell(at, "power on", REPLIES.poweringOn);
      if (why) return refused(why);
      if (!(await until(() => !wanted() || reading.robotMode >= ROBOT_MODE.IDLE, POWER_S)))
        return refused(words.tookTooLong(robot, "powered on", POWER_S));
    }
    if (!wanted()) return refused(stoppedInReset(robot));
    if (reading.robotMode !== ROBOT_MODE.RUNNING) {
      const why = await tell(at, "brake release", REPLIES.releasing);
      if (why) return refused(why);
      if (!(await until(() => !wanted() || reading.robotMode === ROBOT_MODE.RUNNING, POWER_S)))
        return refused(words.tookTooLong(robot, "free of its brakes", POWER_S));
    }
    if (!wanted()) return refused(stoppedInReset(robot));
    at.said = "";
    const why = reading.isIdle ? await program() : null;
    return why ? refused(why) : DONE;
  }

  /**
   * Our own program makes room for it; it is sent when it is to start, because a UR begins with a text as soon as it
   * has it.
   */
  async function handText(files: readonly EmittedFile[]): Promise<UploadedProgram> {
    const at = open;
    const text = files[0]?.text;
    const no = (why: Refusal): UploadedProgram => {
      textRunning = false;
      return { kind: "refused", why };
    };
    if (!at) return no(words.noAnswer("There is no connection."));
    if (text === undefined || text.trim() === "") return no(words.noText());
    const { reading } = at;
    const before = stops;
    if (!at.remote) return no(words.inLocal(robot));
    if (!reading.mayMove)
      return no(words.notReady(robot, robotModeName(reading.robotMode), safetyModeName(reading.safetyMode)));
    textRunning = true;
    if (reading.listens) {
      const why = await tell(at, "stop", REPLIES.stopped);
      if (why || !(await until(() => reading.isIdle, PROGRAM_S))) return no(why ?? words.otherProgram(robot));
    }
    if (!reading.isIdle) return no(words.otherProgram(robot));
    return {
      kind: "handed",
      drop() {
        textRunning = false;
      },
      start: () => startText(at, text, before),
    };
  }
  async function startText(at: Open, text: string, before: number): Promise<CommandOutcome> {
    const { reading } = at;
    try {
      if (open !== at || stops !== before)
        return stopped(words.ended(robot, open === at ? "it was stopped." : "the connection was closed."));
      if (!reading.isIdle) return refused(words.otherProgram(robot));
      at.said = "";
      at.primary.script(text);
      const began = await until(() => reading.isPlaying || at.said !== "", PROGRAM_S);
      if (!began) return refused(words.noStart(robot, at.said));
      await until(() => reading.isIdle, Infinity);
      // What went wrong may be told just after the program has ended.
      await until(() => at.said !== "", 2 * LOOK_S);
      if (at.said !== "") return stopped(words.programFailed(at.said));
      return open === at && reading.mayMove ? DONE : stopped(words.ended(robot, message(at)));
    } finally {
      textRunning = false;
    }
  }
  async function runText(files: readonly EmittedFile[]): Promise<CommandOutcome> {
    const handed = await handText(files);
    return handed.kind === "refused" ? handed : handed.start();
  }

  function stop(emergency: boolean): void {
    const at = open;
    stops++;
    if (!at) return;
    // Whatever program runs there: of one that is only watched nothing else is known.
    if (textRunning || at.watched || at.rtde.waiting > 0) void at.dashboard.ask("stop");
    const number = at.orders.stop();
    at.rtde.send(GROUPS.order);
    awaited = number;
    goal = stopped(words.ended(robot, "it was stopped."));
    if (emergency) {
      void at.dashboard.ask("power off");
      return;
    }
    const look = scheduler.every(STOP_CONFIRMED_S, () => {
      look();
      if (
        open === at &&
        at.reading.isPlaying &&
        at.reading.ended !== number &&
        at.reading.sample.moving &&
        at.orders.number === number
      )
        void at.dashboard.ask("stop");
    });
  }

  return {
    brand: "Universal Robots",
    robot,
    stale_s: STALE_S,
    watchdog: { kind: "robot", within_s: WATCHDOG_S },
    open: attempt,
    close: closeAll,
    cannotSay,
    move: (motion: AdapterMotion) => order(orders => orders.motion(motion)),
    stop,
    setOverride(ratio) {
      if (!open) return words.noAnswer("There is no connection.");
      if (!open.remote) return words.inLocal(robot);
      open.orders.slider(ratio);
      open.rtde.send(GROUPS.slider);
      return null;
    },
    reset,
    setSignal(signal, value) {
      const why = cannotSay({ kind: "signal", signal, value });
      if (why) return why;
      if (!open) return words.noAnswer("There is no connection.");
      open.rtde.send(open.orders.line(signal, value));
      return null;
    },
    setGripper(closed) {
      return this.setSignal(`digital_out_${GRIPPER_LINE}`, closed);
    },
    setPayload(mass_kg, center_m) {
      if (!open) return words.noAnswer("There is no connection.");
      open.orders.payload(mass_kg, center_m);
      open.rtde.send(GROUPS.order);
      return null;
    },
    runText,
    handText,
  };
}
