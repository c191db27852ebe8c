import {
  sectionForDriver,
  type CommandOutcome,
  type EmittedFile,
  type UploadedProgram,
  type JointSample,
  type Refusal,
  type Robot,
  type Scheduler,
  jointsOfAxes,
  axesOfJoints,
} from "@twincell/core";
import type { ControllerAdapter, AdapterEvents, AdapterMotion, AdapterOrder, Opened } from "../driver/index.ts";
import type { ByteStream, Network } from "../transport/index.ts";
import { FTP_PORT, programOf } from "./codec-ftp.ts";
import {
  jointPart,
  RMI_ERROR,
  RMI_PORT,
  RmiReader,
  rmiBytes,
  rmiErrorWords,
  rmiJoints,
  rmiNumber,
  type RmiKey,
  type RmiPacket,
} from "./codec-rmi.ts";
import { putFiles } from "./ftp-client.ts";
import { JOINTS } from "./configuration.ts";
import { stoppedInReset } from "../refusals.ts";
import { DONE, refused, stopped } from "../outcomes.ts";

export interface FanucAdapterOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly port?: number;
  /** Where files are put by FTP. */
  readonly ftpPort?: number;
  readonly login?: { readonly user: string; readonly password: string };
  /** States are asked for this often [s]. */
  readonly period_s?: number;
  readonly stale_s?: number;
  /** Inputs to be read with every state, `DI[3]`. */
  readonly signals?: readonly string[];
  /** DO of the gripper; ON closes. */
  readonly gripperOutput?: number;
}
type Fields = Readonly<Record<string, unknown>>;
type Lent = { -readonly [K in keyof Omit<JointSample, "step">]: Omit<JointSample, "step">[K] };
interface Moving {
  readonly resolve: (outcome: CommandOutcome) => void /** Not a motion but a program: it moves when it moves. */;
  readonly isText: boolean;
  sequence: number;
  cancelled: boolean;
  aborted: boolean;
  outcome: CommandOutcome | null;
  asOf: number;
}

const DIGITS = 12;
const PATIENCE_S = 2;
const STANDS_DEG = 2e-4;
/** With the watches behind it a stop is commanded within 100 ms of the last state (row X-41) [s]. */
const STALE_S = 0.08;
const OUTPUT = /^DO\[([0-9]{1,4})\]$/;
const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });
const noAnswer = (sentence: string): Refusal =>
  refusal("link.refused", sentence, "Look at the address, the cable, and whether option R912 is on the controller.");
const closedHere = refusal(
  "link.closed",
  "The connection was closed while the robot moved.",
  "Connect again, then command the move again.",
);
const said = (id: number, hint: string): Refusal =>
  refusal("fanuc.refused", `The controller refused: ${rmiErrorWords(id)}.`, hint);
const AT_PENDANT = "Look at the messages on its pendant, reset the robot, then command the move again.";

/**
 * A FANUC controller over its Remote Motion Interface: states by two questions a poll, motions one instruction at a
 * time, a stop by ending the program RMI_MOVE. The interface has no way to the servos: after an emergency stop from
 * here this client, the only one that is let in, refuses to move until it is reset. It says nothing of the robot's
 * model.
 */
export function createFanucAdapter(options: FanucAdapterOptions): ControllerAdapter {
  const { robot, scheduler, network, host } = options;
  const joints = sectionForDriver(robot, "fanuc");
  const period_s = options.period_s ?? 0.02;
  const values = new Map<string, boolean | number>();
  const inputs = (options.signals ?? []).filter(signal => /^DI\[[0-9]+\]$/.test(signal));
  const j_deg = new Float64Array(JOINTS).fill(NaN);
  const before_deg = new Float64Array(JOINTS);
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
  let stream: ByteStream | null = null;
  let events: AdapterEvents | null = null;
  let stopPolling: (() => void) | null = null;
  let life = 0;
  let polling = false;
  const asked: {
    readonly key: RmiKey;
    readonly name: string;
    readonly since_s: number;
    readonly answer: (fields: Fields | null) => void;
  }[] = [];
  let stops = 0;
  let moving: Moving | null = null;
  let running = false;
  let paused = false;
  let locked = false;
  let servos = true;
  let pendant = false;
  let fault = "";
  let next = 1;
  let time_ms = NaN;
  let polls = 0;

  const wasStopped = (): Refusal =>
    refusal("controller.stopped", `${robot.name} was stopped.`, "Command the move again when the way is clear.");
  const settle = (outcome: CommandOutcome): void => {
    const ended = moving;
    moving = null;
    ended?.resolve(outcome);
  };
  const ask = (key: RmiKey, name: string, fields: Fields = {}): Promise<Fields | null> =>
    new Promise(resolve => {
      if (!stream) {
        resolve(null);
        return;
      }
      asked.push({ key, name, since_s: scheduler.now_s(), answer: resolve });
      stream.send(rmiBytes({ key, name, fields }));
    });
  const order = async (name: string, fields: Fields = {}): Promise<number> => {
    const reply = await ask("Command", name, fields);
    return reply ? rmiNumber(reply, "ErrorID") : NaN;
  };

  function take({ key, name, fields }: RmiPacket): void {
    if (key === "Communication" && name === "FRC_SystemFault") {
      running = false;
      void ask("Command", "FRC_ReadError", { Count: 1 }).then(reply => {
        const text = typeof reply?.["ErrorData"] === "string" ? reply["ErrorData"] : "";
        if (text !== "") fault = text;
        settle(
          stopped(
            refusal(
              "fanuc.fault",
              fault === "" ? "The controller stopped the program." : `The controller stopped the program: ${fault}.`,
              AT_PENDANT,
            ),
          ),
        );
      });
      return;
    }
    // Commands are answered in order, an instruction when it has been carried out.
    const sequence = rmiNumber(fields, "SequenceID");
    const at = asked.findIndex(each => each.key === key && each.name === name);
    if (at >= 0) {
      const [mine] = asked.splice(at, 1);
      events?.roundTrip(scheduler.now_s() - mine!.since_s);
      mine!.answer(fields);
    } else if (key === "Instruction" && moving?.sequence === sequence) {
      const id = rmiNumber(fields, "ErrorID");
      const outcome =
        id === RMI_ERROR.ok
          ? DONE
          : id === RMI_ERROR.position
            ? stopped(said(id, AT_PENDANT))
            : refused(said(id, AT_PENDANT));
      // Where it stands is told by a state that was asked for afterwards.
      moving.outcome = outcome;
      moving.asOf = polls;
    }
  }

  function lose(sentence: string): void {
    const told = events;
    close();
    told?.lost(sentence);
  }
  function close(): void {
    life++;
    stopPolling?.();
    stopPolling = null;
    stream?.close();
    stream = null;
    events = null;
    polling = running = paused = false;
    for (const { answer } of asked.splice(0)) answer(null);
    settle(stopped(closedHere));
  }
  function listen(to: ByteStream, mine: number): void {
    const reader = new RmiReader();
    to.onEnd(({ sentence }) => {
      if (mine === life) lose(sentence);
    });
    to.onBytes(bytes => {
      if (mine !== life) return;
      const why = reader.push(bytes, packet => {
        take(packet);
        return mine === life;
      });
      if (why) lose(why);
    });
  }

  /** One state out of the answers of a poll; false when it holds none, null when it is not new. */
  function understand(status: Fields, angles: Fields): boolean | null {
    before_deg.set(j_deg);
    const tag_ms = rmiNumber(angles, "TimeTag");
    const override = rmiNumber(status, "Override");
    if (!rmiJoints(angles, j_deg) || Number.isNaN(rmiNumber(status, "ServoReady"))) return false;
    if (tag_ms === time_ms) return null;
    time_ms = tag_ms;
    servos = rmiNumber(status, "ServoReady") === 1;
    pendant = rmiNumber(status, "TPMode") === 1;
    running = rmiNumber(status, "RMIMotionStatus") !== 0;
    if (!moving) next = rmiNumber(status, "NextSequenceID");
    if (servos && !locked) fault = "";
    lent.sequence++;
    lent.time_s = Number.isNaN(tag_ms) ? scheduler.now_s() : tag_ms / 1000;
    jointsOfAxes(joints!, j_deg, lent.q_rad);
    lent.mode = pendant ? "manual" : "remote";
    lent.override = paused ? 0 : Number.isNaN(override) ? lent.override : override / 100;
    lent.safety = locked ? "emergency-stop" : servos ? "normal" : "protective-stop";
    lent.message = fault !== "" ? fault : servos ? "" : "The servos are off.";
    const moved = j_deg.some((value, i) => Math.abs(value - before_deg[i]!) > STANDS_DEG);
    lent.moving =
      (moving !== null && !moving.isText && moving.sequence > 0 && !paused && !moving.aborted && !moving.outcome) ||
      moved;
    if (moving?.aborted && !moved) settle(stopped(wasStopped()));
    return true;
  }

  function poll(mine: number): void {
    const oldest = asked.find(({ key }) => key === "Command");
    if (oldest && scheduler.now_s() - oldest.since_s > PATIENCE_S) {
      lose(`A question was not answered within ${PATIENCE_S} s.`);
      return;
    }
    if (polling) return;
    polling = true;
    const number = ++polls;
    for (const signal of inputs)
      void ask("Command", "FRC_ReadDIN", { PortNumber: Number(signal.slice(3, -1)) }).then(reply => {
        if (reply) values.set(signal, rmiNumber(reply, "PortValue") === 1 || reply["PortValue"] === "ON");
      });
    void Promise.all([ask("Command", "FRC_GetStatus"), ask("Command", "FRC_ReadJointAngles", { Group: 1 })]).then(
      ([status, angles]) => {
        if (mine !== life) return;
        polling = false;
        if (!status || !angles || understand(status, angles) !== true) return;
        if (!servos && fault === "")
          void ask("Command", "FRC_ReadError", { Count: 1 }).then(reply => {
            if (typeof reply?.["ErrorData"] === "string" && !servos) fault = reply["ErrorData"];
          });
        events?.sample(lent);
        if (moving?.outcome && number > moving.asOf) settle(moving.outcome);
      },
    );
  }

  async function open(to: AdapterEvents): Promise<Opened> {
    close();
    const mine = life;
    const fail = (why: Refusal, again: boolean): Opened => {
      if (mine === life) close();
      return { kind: "failed", why, again };
    };
    if (robot.arm.joints.length !== JOINTS)
      return fail(
        refusal(
          "link.other-robot",
          `${robot.name} has ${robot.arm.joints.length} joints; a FANUC controller was expected to move ${JOINTS}.`,
          "Choose the robot that is there.",
        ),
        false,
      );
    if (!joints)
      return fail(
        refusal(
          "link.joints",
          `How a FANUC controller shows the joints of ${robot.name} is not known.`,
          "Give its file a vendor section with the driver fanuc.",
        ),
        false,
      );
    const route = await network.connect({ host, port: options.port ?? RMI_PORT });
    if (route.kind === "refused") return fail(noAnswer(route.sentence), true);
    if (mine !== life) {
      route.stream.close();
      return fail(closedHere, true);
    }
    stream = route.stream;
    listen(route.stream, mine);
    const reply = await ask("Communication", "FRC_Connect");
    const port = reply ? rmiNumber(reply, "PortNumber") : NaN;
    const id = reply ? rmiNumber(reply, "ErrorID") : NaN;
    if (mine !== life || !reply) return fail(noAnswer("The connection was closed."), true);
    if (id !== RMI_ERROR.ok || !(port > 0))
      return fail(said(id, "One client at a time is let in: close the other one."), true);
    life++;
    route.stream.close();
    const here = life;
    const connected = await network.connect({ host, port });
    if (connected.kind === "refused") {
      stream = null;
      return { kind: "failed", why: noAnswer(connected.sentence), again: true };
    }
    if (here !== life) {
      connected.stream.close();
      return { kind: "failed", why: closedHere, again: true };
    }
    stream = connected.stream;
    listen(stream, here);
    const [status, angles] = await Promise.all([
      ask("Command", "FRC_GetStatus"),
      ask("Command", "FRC_ReadJointAngles", { Group: 1 }),
    ]);
    time_ms = NaN;
    if (here !== life || !status || !angles || understand(status, angles) !== true) {
      if (here === life) close();
      return { kind: "failed", why: noAnswer("The controller does not tell its state."), again: true };
    }
    events = to;
    stopPolling = scheduler.every(period_s, () => {
      poll(here);
    });
    return { kind: "open" };
  }

  function cannotSay(order: AdapterOrder): Refusal | null {
    if (order.kind === "signal")
      return OUTPUT.test(order.signal) && typeof order.value === "boolean"
        ? null
        : refusal(
            "fanuc.line",
            `“${order.signal}” is no digital output of the controller.`,
            "Name it DO[1] and so on.",
          );
    if (order.kind === "gripper")
      return options.gripperOutput === undefined
        ? refusal("fanuc.gripper", "Which output the gripper hangs on is not given.", "Give the number of its DO.")
        : null;
    return order.path === "arc"
      ? refusal(
          "fanuc.arc",
          "Arcs are not sent over this interface: their points need FANUC's words for a posture, which have not been tried.",
          "Run the program as text of the controller's own language, or use lines.",
        )
      : null;
  }
  async function move(motion: AdapterMotion): Promise<CommandOutcome> {
    const why = cannotSay(motion);
    if (why) return refused(why);
    const isLine = motion.path !== "joints";
    const shown = axesOfJoints(joints!, motion.q_rad, new Float64Array(JOINTS));
    return instruct(
      isLine ? "FRC_LinearMotionJRep" : "FRC_JointMotionJRep",
      {
        JointAngle: jointPart(shown, DIGITS),
        SpeedType: isLine ? "mmSec" : "Percent",
        Speed: isLine ? 1000 * motion.speed_mps : Math.min(100, Math.max(1, Math.round(100 * motion.ratio))),
        TermType: "FINE",
        TermValue: 100,
        ...(motion.acceleration < 1 ? { ACC: Math.max(1, Math.round(100 * motion.acceleration)) } : {}),
      },
      false,
    );
  }
  /**
   * Appends an instruction to RMI_MOVE, which is started where it does not run, and waits until it has been carried
   * out.
   */
  async function instruct(name: string, fields: Fields, isText: boolean): Promise<CommandOutcome> {
    if (!stream) return refused(closedHere);
    if (!servos)
      return refused(
        refusal(
          "fanuc.servo-off",
          fault === "" ? "The servos are off." : `The servos are off: ${fault}.`,
          "Reset the robot, then command the move again.",
        ),
      );
    return new Promise(resolve => {
      const mine: Moving = { resolve, isText, sequence: 0, cancelled: false, aborted: false, outcome: null, asOf: 0 };
      moving = mine;
      void (async () => {
        if (!running) {
          const id = await order("FRC_Initialize", { GroupMask: 1 });
          if (moving !== mine) return;
          if (id !== RMI_ERROR.ok) {
            settle(refused(said(id, AT_PENDANT)));
            return;
          }
          running = true;
          next = 1;
        }
        if (paused) await order("FRC_Pause");
        if (moving !== mine) return;
        if (mine.cancelled) {
          settle(stopped(wasStopped()));
          return;
        }
        mine.sequence = next++;
        stream?.send(rmiBytes({ key: "Instruction", name, fields: { SequenceID: mine.sequence, ...fields } }));
      })();
    });
  }
  /** Puts the listings on the controller; started, the first one is called and runs to its end. */
  async function handText(files: readonly EmittedFile[]): Promise<UploadedProgram> {
    const listings = files
      .filter(({ name }) => /\.ls$/i.test(name))
      .map(({ text }) => ({ program: programOf(text), text }));
    const [first] = listings;
    const before = stops;
    if (!first || listings.some(({ program }) => program === ""))
      return {
        kind: "refused",
        why: refusal(
          "fanuc.no-listing",
          "There is no TP listing among the files that begins with /PROG and a name.",
          "Hand over .LS files, the program to be run first.",
        ),
      };
    if (!stream) return { kind: "refused", why: closedHere };
    const login = options.login ?? { user: "anonymous", password: "" };
    const why = await putFiles(
      { network, scheduler, to: { host, port: options.ftpPort ?? FTP_PORT }, ...login },
      listings.map(({ program, text }) => ({
        name: `${program}.LS`,
        bytes: Uint8Array.from(text, sign => sign.charCodeAt(0) & 255),
      })),
    );
    if (why !== null)
      return {
        kind: "refused",
        why: refusal(
          "fanuc.files",
          `The program was not put on the controller: ${why}`,
          "Look at the FTP server of the controller (port 21) and at the option for ASCII programs.",
        ),
      };
    return {
      kind: "handed",
      start: () => call(first.program, before),
      drop() {
        /* A listing that lies there moves nothing. */
      },
    };
  }
  async function call(program: string, before: number): Promise<CommandOutcome> {
    if (stops !== before) return stopped(wasStopped());
    const outcome = await instruct("FRC_Call", { ProgramName: program }, true);
    if (outcome.kind !== "refused" || !stream) return outcome;
    const reply = await ask("Command", "FRC_ReadError", { Count: 1 });
    const text = typeof reply?.["ErrorData"] === "string" ? reply["ErrorData"] : "";
    return text === ""
      ? outcome
      : refused({ ...outcome.why, sentence: `${outcome.why.sentence.replace(/\.$/, "")}: ${text}` });
  }

  return {
    brand: "FANUC",
    robot,
    stale_s: options.stale_s ?? Math.max(STALE_S, 4 * period_s),
    open,
    close,
    cannotSay,
    move,
    handText,
    async runText(files: readonly EmittedFile[]) {
      const handed = await handText(files);
      return handed.kind === "refused" ? handed : handed.start();
    },
    watchdog: {
      kind: "none",
      because:
        "The interface carries a motion that was sent out to its end, whoever is still there: streamed motion is refused.",
    },
    stop(emergency) {
      if (emergency) locked = true;
      stops++;
      if (moving) moving.cancelled = true;
      void order("FRC_Abort").then(() => {
        running = false;
        // It is over when the robot stands, which the states tell.
        if (moving) moving.aborted = true;
      });
    },
    setOverride(ratio) {
      if (ratio === 0) {
        paused = true;
        void order("FRC_Pause");
        return null;
      }
      void order("FRC_SetOverRide", { Value: Math.max(1, Math.round(100 * ratio)) });
      if (paused) {
        paused = false;
        void order("FRC_Continue");
      }
      return null;
    },
    async reset(wanted) {
      const id = await order("FRC_Reset");
      if (id !== RMI_ERROR.ok) return refused(said(id, "Clear the cause at the robot first."));
      if (!wanted()) return refused(stoppedInReset(robot));
      locked = false;
      fault = "";
      return DONE;
    },
    setSignal(signal, value) {
      const why = cannotSay({ kind: "signal", signal, value });
      if (why) return why;
      void order("FRC_WriteDOUT", { PortNumber: Number(OUTPUT.exec(signal)![1]), PortValue: value ? "ON" : "OFF" });
      values.set(signal, value);
      return null;
    },
    setGripper(closed) {
      const why = cannotSay({ kind: "gripper", closed });
      if (why) return why;
      void order("FRC_WriteDOUT", { PortNumber: options.gripperOutput, PortValue: closed ? "ON" : "OFF" });
      lent.gripperClosed = closed;
      return null;
    },
  };
}
