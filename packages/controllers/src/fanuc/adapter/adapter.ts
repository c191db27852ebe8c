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
import type { ByteStream, Network } from "../../transport/index.ts";
import { FTP_PORT, programOf } from "../codec/ftp.ts";
import {
  jointPart,
  RMI_ERROR,
  RMI_PORT,
  RmiReader,
  rmiBytes,
  rmiJoints,
  rmiNumber,
  type RmiKey,
  type RmiPacket,
} from "../codec/rmi.ts";
import { putFiles } from "./ftp-client.ts";
import { AT_PENDANT, closedHere, noAnswer, refusal, said } from "./words.ts";
import { JOINTS } from "../codec/configuration.ts";
import { stoppedInReset } from "../../refusals.ts";
import { DONE, refused, stopped } from "../../outcomes.ts";

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

/**
 * A FANUC controller over its Remote Motion Interface: states by two questions a poll, motions one instruction at a
 * time, a stop by ending the program RMI_MOVE. The interface has no way to the servos: after an emergency stop from
 * here this client, the only one that is let in, refuses to move until it is reset. It says nothing of the robot's
 * model.
 */
export function createFanucAdapter(options: FanucAdapterOptions): ControllerAdapter {
  return fanucAdapterOf(new FanucWire(options));
}

class FanucWire extends DriverStates<Moving> {
  protected readonly closedBecause = closedHere;
  readonly options: FanucAdapterOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly joints: VendorSection | undefined;
  readonly period_s: number;
  readonly values = new Map<string, boolean | number>();
  readonly inputs: string[];
  readonly j_deg = new Float64Array(JOINTS).fill(NaN);
  readonly before_deg = new Float64Array(JOINTS);
  readonly lent: Lent;
  stream: ByteStream | null = null;
  stopPolling: (() => void) | null = null;
  polling = false;
  readonly asked: {
    readonly key: RmiKey;
    readonly name: string;
    readonly since_s: number;
    readonly answer: (fields: Fields | null) => void;
  }[] = [];
  stops = 0;
  running = false;
  paused = false;
  locked = false;
  servos = true;
  pendant = false;
  fault = "";
  next = 1;
  time_ms = NaN;
  polls = 0;

  constructor(options: FanucAdapterOptions) {
    super();
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.joints = sectionForDriver(this.robot, "fanuc");
    this.period_s = this.options.period_s ?? 0.02;
    this.inputs = (this.options.signals ?? []).filter(signal => /^DI\[[0-9]+\]$/.test(signal));
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

  wasStopped(): Refusal {
    return refusal(
      "controller.stopped",
      `${this.robot.name} was stopped.`,
      "Command the move again when the way is clear.",
    );
  }

  ask(key: RmiKey, name: string, fields: Fields = {}): Promise<Fields | null> {
    return new Promise(resolve => {
      if (!this.stream) {
        resolve(null);
        return;
      }
      this.asked.push({ key, name, since_s: this.scheduler.now_s(), answer: resolve });
      this.stream.send(rmiBytes({ key, name, fields }));
    });
  }

  async order(name: string, fields: Fields = {}): Promise<number> {
    const reply = await this.ask("Command", name, fields);
    return reply ? rmiNumber(reply, "ErrorID") : NaN;
  }

  take({ key, name, fields }: RmiPacket): void {
    if (key === "Communication" && name === "FRC_SystemFault") {
      this.running = false;
      void this.ask("Command", "FRC_ReadError", { Count: 1 }).then(reply => {
        const text = typeof reply?.["ErrorData"] === "string" ? reply["ErrorData"] : "";
        if (text !== "") this.fault = text;
        this.settle(
          stopped(
            refusal(
              "fanuc.fault",
              this.fault === ""
                ? "The controller stopped the program."
                : `The controller stopped the program: ${this.fault}.`,
              AT_PENDANT,
            ),
          ),
        );
      });
      return;
    }
    // Commands are answered in order, an instruction when it has been carried out.
    const sequence = rmiNumber(fields, "SequenceID");
    const at = this.asked.findIndex(each => each.key === key && each.name === name);
    if (at >= 0) {
      const [mine] = this.asked.splice(at, 1);
      this.events?.roundTrip(this.scheduler.now_s() - mine!.since_s);
      mine!.answer(fields);
    } else if (key === "Instruction" && this.moving?.sequence === sequence) {
      const id = rmiNumber(fields, "ErrorID");
      const outcome =
        id === RMI_ERROR.ok
          ? DONE
          : id === RMI_ERROR.position
            ? stopped(said(id, AT_PENDANT))
            : refused(said(id, AT_PENDANT));
      // Where it stands is told by a state that was asked for afterwards.
      this.moving.outcome = outcome;
      this.moving.asOf = this.polls;
    }
  }

  protected release(): void {
    this.stopPolling?.();
    this.stopPolling = null;
    this.stream?.close();
    this.stream = null;
    this.polling = this.running = this.paused = false;
    for (const { answer } of this.asked.splice(0)) answer(null);
  }

  listen(to: ByteStream, isMine: () => boolean): void {
    const reader = new RmiReader();
    to.onEnd(({ sentence }) => {
      if (isMine()) this.lose(sentence);
    });
    to.onBytes(bytes => {
      if (!isMine()) return;
      const why = reader.push(bytes, packet => {
        this.take(packet);
        return isMine();
      });
      if (why) this.lose(why);
    });
  }

  /** One state out of the answers of a poll; false when it holds none, null when it is not new. */
  understand(status: Fields, angles: Fields): boolean | null {
    this.before_deg.set(this.j_deg);
    const tag_ms = rmiNumber(angles, "TimeTag");
    const override = rmiNumber(status, "Override");
    if (!rmiJoints(angles, this.j_deg) || Number.isNaN(rmiNumber(status, "ServoReady"))) return false;
    if (tag_ms === this.time_ms) return null;
    this.time_ms = tag_ms;
    this.servos = rmiNumber(status, "ServoReady") === 1;
    this.pendant = rmiNumber(status, "TPMode") === 1;
    this.running = rmiNumber(status, "RMIMotionStatus") !== 0;
    if (!this.moving) this.next = rmiNumber(status, "NextSequenceID");
    if (this.servos && !this.locked) this.fault = "";
    this.lent.sequence++;
    this.lent.time_s = Number.isNaN(tag_ms) ? this.scheduler.now_s() : tag_ms / 1000;
    jointsOfAxes(this.joints!, this.j_deg, this.lent.q_rad);
    this.lent.mode = this.pendant ? "manual" : "remote";
    this.lent.override = this.paused ? 0 : Number.isNaN(override) ? this.lent.override : override / 100;
    this.lent.safety = this.locked ? "emergency-stop" : this.servos ? "normal" : "protective-stop";
    this.lent.message = this.fault !== "" ? this.fault : this.servos ? "" : "The servos are off.";
    const moved = this.j_deg.some((value, i) => Math.abs(value - this.before_deg[i]!) > STANDS_DEG);
    this.lent.moving =
      (this.moving !== null &&
        !this.moving.isText &&
        this.moving.sequence > 0 &&
        !this.paused &&
        !this.moving.aborted &&
        !this.moving.outcome) ||
      moved;
    if (this.moving?.aborted && !moved) this.settle(stopped(this.wasStopped()));
    return true;
  }

  poll(isMine: () => boolean): void {
    const oldest = this.asked.find(({ key }) => key === "Command");
    if (oldest && this.scheduler.now_s() - oldest.since_s > PATIENCE_S) {
      this.lose(`A question was not answered within ${PATIENCE_S} s.`);
      return;
    }
    if (this.polling) return;
    this.polling = true;
    const number = ++this.polls;
    for (const signal of this.inputs)
      void this.ask("Command", "FRC_ReadDIN", { PortNumber: Number(signal.slice(3, -1)) }).then(reply => {
        if (reply) this.values.set(signal, rmiNumber(reply, "PortValue") === 1 || reply["PortValue"] === "ON");
      });
    void Promise.all([
      this.ask("Command", "FRC_GetStatus"),
      this.ask("Command", "FRC_ReadJointAngles", { Group: 1 }),
    ]).then(([status, angles]) => {
      if (!isMine()) return;
      this.polling = false;
      if (!status || !angles || this.understand(status, angles) !== true) return;
      if (!this.servos && this.fault === "")
        void this.ask("Command", "FRC_ReadError", { Count: 1 }).then(reply => {
          if (typeof reply?.["ErrorData"] === "string" && !this.servos) this.fault = reply["ErrorData"];
        });
      this.events?.sample(this.lent);
      if (this.moving?.outcome && number > this.moving.asOf) this.settle(this.moving.outcome);
    });
  }

  readonly open = async (to: AdapterEvents): Promise<Opened> => {
    const isMine = this.connecting();
    const fail = (why: Refusal, again: boolean): Opened => this.failed(isMine, why, again);
    if (this.robot.arm.joints.length !== JOINTS)
      return fail(
        refusal(
          "link.other-robot",
          `${this.robot.name} has ${this.robot.arm.joints.length} joints; a FANUC controller was expected to move ${JOINTS}.`,
          "Choose the robot that is there.",
        ),
        false,
      );
    if (!this.joints)
      return fail(
        refusal(
          "link.joints",
          `How a FANUC controller shows the joints of ${this.robot.name} is not known.`,
          "Give its file a vendor section with the driver fanuc.",
        ),
        false,
      );
    const route = await this.network.connect({ host: this.host, port: this.options.port ?? RMI_PORT });
    if (route.kind === "refused") return fail(noAnswer(route.sentence), true);
    if (!isMine()) {
      route.stream.close();
      return fail(closedHere, true);
    }
    this.stream = route.stream;
    this.listen(route.stream, isMine);
    const reply = await this.ask("Communication", "FRC_Connect");
    const port = reply ? rmiNumber(reply, "PortNumber") : NaN;
    const id = reply ? rmiNumber(reply, "ErrorID") : NaN;
    if (!isMine() || !reply) return fail(noAnswer("The connection was closed."), true);
    if (id !== RMI_ERROR.ok || !(port > 0))
      return fail(said(id, "One client at a time is let in: close the other one."), true);
    const isHere = this.renewed();
    route.stream.close();
    const connected = await this.network.connect({ host: this.host, port });
    if (connected.kind === "refused") {
      this.stream = null;
      return this.failed(isHere, noAnswer(connected.sentence), true);
    }
    if (!isHere()) {
      connected.stream.close();
      return { kind: "failed", why: closedHere, again: true };
    }
    this.stream = connected.stream;
    this.listen(this.stream, isHere);
    const [status, angles] = await Promise.all([
      this.ask("Command", "FRC_GetStatus"),
      this.ask("Command", "FRC_ReadJointAngles", { Group: 1 }),
    ]);
    this.time_ms = NaN;
    if (!isHere() || !status || !angles || this.understand(status, angles) !== true) {
      return this.failed(isHere, noAnswer("The controller does not tell its state."), true);
    }
    this.stopPolling = this.scheduler.every(this.period_s, () => {
      this.poll(isHere);
    });
    return this.ready(to);
  };

  readonly cannotSay = (order: AdapterOrder): Refusal | null => {
    if (order.kind === "signal")
      return OUTPUT.test(order.signal) && typeof order.value === "boolean"
        ? null
        : refusal(
            "fanuc.line",
            `“${order.signal}” is no digital output of the controller.`,
            "Name it DO[1] and so on.",
          );
    if (order.kind === "gripper")
      return this.options.gripperOutput === undefined
        ? refusal("fanuc.gripper", "Which output the gripper hangs on is not given.", "Give the number of its DO.")
        : null;
    return order.path === "arc"
      ? refusal(
          "fanuc.arc",
          "Arcs are not sent over this interface: their points need FANUC's words for a posture, which have not been tried.",
          "Run the program as text of the controller's own language, or use lines.",
        )
      : null;
  };

  readonly move = async (motion: AdapterMotion): Promise<CommandOutcome> => {
    const why = this.cannotSay(motion);
    if (why) return refused(why);
    const isLine = motion.path !== "joints";
    const shown = axesOfJoints(this.joints!, motion.q_rad, new Float64Array(JOINTS));
    return this.instruct(
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
  };

  /**
   * Appends an instruction to RMI_MOVE, which is started where it does not run, and waits until it has been carried
   * out.
   */
  async instruct(name: string, fields: Fields, isText: boolean): Promise<CommandOutcome> {
    if (!this.stream) return refused(closedHere);
    if (!this.servos)
      return refused(
        refusal(
          "fanuc.servo-off",
          this.fault === "" ? "The servos are off." : `The servos are off: ${this.fault}.`,
          "Reset the robot, then command the move again.",
        ),
      );
    const make = (resolve: Moving["resolve"]): Moving => ({
      resolve,
      isText,
      sequence: 0,
      cancelled: false,
      aborted: false,
      outcome: null,
      asOf: 0,
    });
    return this.execute(make, mine => {
      void (async () => {
        if (!this.running) {
          const id = await this.order("FRC_Initialize", { GroupMask: 1 });
          if (this.moving !== mine) return;
          if (id !== RMI_ERROR.ok) {
            this.settle(refused(said(id, AT_PENDANT)));
            return;
          }
          this.running = true;
          this.next = 1;
        }
        if (this.paused) await this.order("FRC_Pause");
        if (this.moving !== mine) return;
        if (mine.cancelled) {
          this.settle(stopped(this.wasStopped()));
          return;
        }
        mine.sequence = this.next++;
        this.stream?.send(rmiBytes({ key: "Instruction", name, fields: { SequenceID: mine.sequence, ...fields } }));
      })();
    });
  }

  /** Puts the listings on the controller; started, the first one is called and runs to its end. */
  readonly handText = async (files: readonly EmittedFile[]): Promise<UploadedProgram> => {
    const listings = files
      .filter(({ name }) => /\.ls$/i.test(name))
      .map(({ text }) => ({ program: programOf(text), text }));
    const [first] = listings;
    const before = this.stops;
    if (!first || listings.some(({ program }) => program === ""))
      return {
        kind: "refused",
        why: refusal(
          "fanuc.no-listing",
          "There is no TP listing among the files that begins with /PROG and a name.",
          "Hand over .LS files, the program to be run first.",
        ),
      };
    if (!this.stream) return { kind: "refused", why: closedHere };
    const login = this.options.login ?? { user: "anonymous", password: "" };
    const why = await putFiles(
      {
        network: this.network,
        scheduler: this.scheduler,
        to: { host: this.host, port: this.options.ftpPort ?? FTP_PORT },
        ...login,
      },
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
      start: () => this.call(first.program, before),
      drop() {
        /* A listing that lies there moves nothing. */
      },
    };
  };

  async call(program: string, before: number): Promise<CommandOutcome> {
    if (this.stops !== before) return stopped(this.wasStopped());
    const outcome = await this.instruct("FRC_Call", { ProgramName: program }, true);
    if (outcome.kind !== "refused" || !this.stream) return outcome;
    const reply = await this.ask("Command", "FRC_ReadError", { Count: 1 });
    const text = typeof reply?.["ErrorData"] === "string" ? reply["ErrorData"] : "";
    return text === ""
      ? outcome
      : refused({ ...outcome.why, sentence: `${outcome.why.sentence.replace(/\.$/, "")}: ${text}` });
  }
}

function fanucAdapterOf(wire: FanucWire): ControllerAdapter {
  return {
    brand: "FANUC",
    robot: wire.robot,
    stale_s: wire.options.stale_s ?? Math.max(STALE_S, 4 * wire.period_s),
    open: wire.open,
    close: () => {
      wire.close();
    },
    cannotSay: wire.cannotSay,
    move: wire.move,
    handText: wire.handText,
    async runText(files: readonly EmittedFile[]) {
      const handed = await wire.handText(files);
      return handed.kind === "refused" ? handed : handed.start();
    },
    watchdog: {
      kind: "none",
      because:
        "The interface carries a motion that was sent out to its end, whoever is still there: streamed motion is refused.",
    },
    stop(emergency) {
      if (emergency) wire.locked = true;
      wire.stops++;
      if (wire.moving) wire.moving.cancelled = true;
      void wire.order("FRC_Abort").then(() => {
        wire.running = false;
        // It is over when the robot stands, which the states tell.
        if (wire.moving) wire.moving.aborted = true;
      });
    },
    setOverride(ratio) {
      if (ratio === 0) {
        wire.paused = true;
        void wire.order("FRC_Pause");
        return null;
      }
      void wire.order("FRC_SetOverRide", { Value: Math.max(1, Math.round(100 * ratio)) });
      if (wire.paused) {
        wire.paused = false;
        void wire.order("FRC_Continue");
      }
      return null;
    },
    async reset(wanted) {
      const id = await wire.order("FRC_Reset");
      if (id !== RMI_ERROR.ok) return refused(said(id, "Clear the cause at the robot first."));
      if (!wanted()) return refused(stoppedInReset(wire.robot));
      wire.locked = false;
      wire.fault = "";
      return DONE;
    },
    setSignal(signal, value) {
      const why = wire.cannotSay({ kind: "signal", signal, value });
      if (why) return why;
      void wire.order("FRC_WriteDOUT", {
        PortNumber: Number(OUTPUT.exec(signal)![1]),
        PortValue: value ? "ON" : "OFF",
      });
      wire.values.set(signal, value);
      return null;
    },
    setGripper(closed) {
      const why = wire.cannotSay({ kind: "gripper", closed });
      if (why) return why;
      void wire.order("FRC_WriteDOUT", { PortNumber: wire.options.gripperOutput, PortValue: closed ? "ON" : "OFF" });
      wire.lent.gripperClosed = closed;
      return null;
    },
  };
}
