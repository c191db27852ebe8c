import type { CommandOutcome, EmittedFile, UploadedProgram, Refusal, Robot, Scheduler } from "@twincell/core";
import type { ControllerAdapter, AdapterEvents, AdapterMotion, Opened } from "../../driver/index.ts";
import type { Network } from "../../transport/index.ts";
import {
  COMMAND,
  DIVISION,
  FILE_PORT,
  ROBOT_PORT,
  SERVICE,
  EXAMPLE_OUTPUTS,
  exampleScale,
  ownScale,
  readAlarm,
  readJob,
  textAt,
  type PulseScale,
} from "../codec/index.ts";
import { hsesClient, type Answer, type Client } from "./client.ts";
import { fileClient, type FileClient } from "./files.ts";
import { Hand, unsayableMotion } from "./hand.ts";
import { handJob } from "./job.ts";
import { lineTable, watchedLines, type LineTable } from "./lines.ts";
import { robotState, type RobotState } from "./state.ts";
import { badAnswer, noGripper, noPulses, noWay, otherAxes, otherModel, unknownPulses } from "./words.ts";

export interface YaskawaAdapterOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly ports?: { readonly robot: number; readonly files: number };
  /** From where to ask; every address of this machine when left out. */
  readonly local?: string;
  /**
   * From the parameter file of the controller: nothing here guesses it. Left out, only a virtual controller is driven,
   * which says of itself that it is one and counts as the example does.
   */
  readonly scale?: PulseScale;
  /** Part of what the controller answers as its model; the name of the robot without its maker when left out. */
  readonly model?: string;
  /** From one state to the next [s]. */
  readonly poll_s?: number;
  readonly stale_s?: number;
  /**
   * Logical numbers of lines by name. Others are found by INFORM's own names and by their numbers. Left out, the first
   * sixteen general inputs and outputs are watched, and a virtual controller has those of its example ladder.
   */
  readonly signals?: Readonly<Record<string, number>>;
  /**
   * Network input that the ladder passes on to OT#(1), the next one to OT#(2): outputs are switched in no other way.
   * The example's for a virtual controller.
   */
  readonly outputsFrom?: number;
  /** The line that closes the gripper. */
  readonly gripper?: number;
}
/** The face, and what else the wire can do. */
export interface YaskawaAdapter extends ControllerAdapter {
  /** Files of the controller, while the link is open. */
  readonly files: FileClient | null;
}

/** Asking again does no harm and a lost answer costs time, so reads are said again sooner than orders [s]. */
const READ_PATIENCE_S = [0.025, 0.025, 0.05, 0.3, 0.5];
const OPEN_PATIENCE_S = [0.3, 0.5, 0.8];
const POLL_S = 0.01;
const STALE_S = 0.08;
const BESIDE_S = 0.02;
const GRIPPER = "gripper";
/**
 * What a virtual controller answers as its software; and its lines: sixteen in, sixteen out, and one for the gripper.
 */
const VIRTUAL = "VIRTUAL";
const EXAMPLE_GRIPPER = 29_567;
const EXAMPLE_SIGNALS = Object.fromEntries(
  Array.from({ length: 16 }, (_, i) => [i, 10 * Math.floor(i / 8) + (i % 8)] as const).flatMap(([i, at]) => [
    [`in_${i + 1}`, 27_010 + at],
    [`IN#(${i + 1})`, 10 + at],
    [`ot_${i + 1}`, 10_010 + at],
  ]),
);

/** The high-speed Ethernet server as a face: states by asking, motion by commands, stop by hold. */
export function yaskawaAdapter(options: YaskawaAdapterOptions): YaskawaAdapter {
  return yaskawaAdapterOf(new YaskawaWire(options));
}

class YaskawaWire {
  readonly options: YaskawaAdapterOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly known: PulseScale | undefined;
  readonly scale: PulseScale;
  readonly n: number;
  readonly state: RobotState;
  readonly to: { host: string; port: number };
  readonly filesAt: { host: string; port: number };
  outputsFrom: number | undefined;
  lines: LineTable;
  hasGripper: boolean;
  readonly hand: Hand;
  line: { readonly orders: Client; readonly files: FileClient; readonly close: () => void } | null = null;
  life = 0;
  begun_s = 0;
  beside_s = 0;
  beside = 0;

  constructor(options: YaskawaAdapterOptions) {
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.known = this.options.scale ?? ownScale(this.robot);
    this.scale = this.known ?? exampleScale(this.robot);
    this.n = this.robot.arm.joints.length;
    this.state = robotState(this.robot, this.scale);
    this.to = { host: this.host, port: this.options.ports?.robot ?? ROBOT_PORT };
    this.filesAt = { host: this.host, port: this.options.ports?.files ?? FILE_PORT };
    this.outputsFrom = this.options.outputsFrom;
    this.lines = this.tableOf(this.options.signals ?? watchedLines(), this.options.gripper);
    this.hasGripper = this.options.gripper !== undefined;
    this.hand = new Hand({ robot: this.robot, scheduler: this.scheduler, scale: this.scale, state: this.state });
  }

  tableOf(signals: Readonly<Record<string, number>>, gripper: number | undefined): LineTable {
    return lineTable(
      { ...signals, ...(gripper === undefined ? {} : { [GRIPPER]: gripper }) },
      this.outputsFrom,
      (signal, on) => {
        if (signal === GRIPPER) this.state.sample.gripperClosed = on;
        else this.state.sample.signals.set(signal, on);
      },
    );
  }

  isWell(answer: Answer): answer is Extract<Answer, { kind: "answer" }> {
    return answer.kind === "answer" && answer.reply.status === 0;
  }

  ask(
    client: Client,
    command: number,
    instance: number,
    patience_s: readonly number[],
    attribute = 0,
  ): Promise<Answer> {
    return client.ask({
      command,
      instance,
      attribute,
      service: attribute === 0 ? SERVICE.getAll : SERVICE.getOne,
      patience_s,
    });
  }

  /** One question beside the state, taken in turn: the job with the override, and the groups of lines. */
  async askBeside(client: Client): Promise<void> {
    const { groups } = this.lines;
    const which = this.beside++ % (groups.length + 1);
    if (which === 0) {
      const answer = await this.ask(client, COMMAND.job, 1, READ_PATIENCE_S);
      const job = this.isWell(answer) ? readJob(answer.reply.data) : undefined;
      if (job) this.state.pendantOverride = Math.min(1, job.override);
      return;
    }
    const group = groups[which - 1]!;
    const answer = await this.ask(client, COMMAND.io, group, READ_PATIENCE_S, 1);
    if (this.isWell(answer) && answer.reply.data.length > 0) this.lines.take(group, answer.reply.data[0]!);
  }

  /** Status, then position: a state. Why not, when the controller does not say. */
  async poll(client: Client): Promise<Refusal | null> {
    const number = this.hand.beginPoll();
    const status = await this.ask(client, COMMAND.status, 1, READ_PATIENCE_S);
    if (!this.isWell(status)) return noWay(this.to, status);
    if (!this.state.takeStatus(status.reply.data)) return badAnswer(this.to);
    if (!this.state.status.alarm) this.state.alarm = "";
    else if (this.state.alarm === "") {
      const answer = await this.ask(client, COMMAND.alarm, 1, READ_PATIENCE_S);
      const alarm = this.isWell(answer) ? readAlarm(answer.reply.data) : undefined;
      this.state.alarm = alarm
        ? `Alarm ${alarm.code}: ${alarm.name}${alarm.data === 0 ? "" : ` [${alarm.data}]`}`
        : "An alarm is present.";
    }
    const position = await this.ask(client, COMMAND.position, 1, READ_PATIENCE_S);
    if (!this.isWell(position)) return noWay(this.to, position);
    if (
      !this.state.takePosition(
        position.reply.data,
        this.scheduler.now_s() - this.begun_s,
        this.hand.override,
        this.hand.emergency,
      )
    )
      return badAnswer(this.to);
    if (this.hand.complaint !== "" && this.state.sample.message === "") this.state.sample.message = this.hand.complaint;
    this.hand.look(number);
    return null;
  }

  keepPolling(client: Client, events: AdapterEvents, mine: number): () => void {
    let isBusy = false;
    const turn = async (): Promise<void> => {
      const why = await this.poll(client);
      if (mine !== this.life) return;
      if (why?.code === "link.no-answer") {
        events.lost(why.sentence);
        return;
      }
      // One odd answer is no state; when no state comes any more, that is noticed.
      if (why) return;
      events.sample(this.state.sample);
      if (this.scheduler.now_s() - this.beside_s < BESIDE_S) return;
      this.beside_s = this.scheduler.now_s();
      await this.askBeside(client);
    };
    return this.scheduler.every(this.options.poll_s ?? POLL_S, () => {
      if (isBusy) return;
      isBusy = true;
      void turn().then(() => {
        isBusy = false;
      });
    });
  }

  async open(events: AdapterEvents): Promise<Opened> {
    this.close();
    const mine = this.life;
    const failed = (why: Refusal, again: boolean): Opened => ({ kind: "failed", why, again });
    if (this.scale.pulsesPerDegree.length !== this.n)
      return failed(noPulses(this.robot, this.scale.pulsesPerDegree.length), false);
    const here = this.options.local ?? "0.0.0.0";
    const open: Client[] = [];
    const shut = (): void => {
      for (const client of open) client.close();
    };
    // A controller hears one question at a time of each sender: who watches does not wait behind an order whose
    // answer was lost.
    for (const [address, division] of [
      [this.to, DIVISION.robot],
      [this.to, DIVISION.robot],
      [this.filesAt, DIVISION.file],
    ] as const) {
      const bound = await this.network.bind({ host: here, port: 0 });
      if (bound.kind === "taken" || mine !== this.life) {
        shut();
        if (bound.kind === "bound") bound.socket.close();
        return failed(
          {
            code: "link.no-port",
            sentence: bound.kind === "taken" ? bound.sentence : "The link was closed.",
            hint: "Look at the network of this machine.",
          },
          true,
        );
      }
      open.push(
        hsesClient({
          socket: bound.socket,
          to: address,
          division,
          scheduler: this.scheduler,
          ...(open.length === 0
            ? {
                onRoundTrip: seconds => {
                  events.roundTrip(seconds);
                },
              }
            : {}),
        }),
      );
    }
    const [watch, orders, fileLine] = open as [Client, Client, Client];
    this.begun_s = this.scheduler.now_s();
    const wrong = await this.strange(watch);
    if (wrong || mine !== this.life) {
      shut();
      return wrong
        ? failed(wrong.why, wrong.again)
        : failed({ code: "link.closed", sentence: "The link was closed.", hint: "Connect it again." }, false);
    }
    const stopPolling = this.keepPolling(watch, events, mine);
    this.line = {
      orders,
      files: fileClient(fileLine),
      close() {
        stopPolling();
        shut();
      },
    };
    this.hand.take(orders);
    return { kind: "open" };
  }

  /** Whether the right robot answers; null when it does. */
  async strange(client: Client): Promise<{ readonly why: Refusal; readonly again: boolean } | null> {
    const info = await this.ask(client, COMMAND.systemInfo, 11, OPEN_PATIENCE_S);
    if (info.kind === "silent") return { why: noWay(this.to, info), again: true };
    const isVirtual = this.isWell(info) && textAt(info.reply.data, 0, 24).startsWith(VIRTUAL);
    if (this.known === undefined && !isVirtual) return { why: unknownPulses(this.robot), again: false };
    if (isVirtual && this.options.signals === undefined && this.options.gripper === undefined) {
      this.outputsFrom ??= EXAMPLE_OUTPUTS;
      this.lines = this.tableOf(EXAMPLE_SIGNALS, EXAMPLE_GRIPPER);
      this.hasGripper = true;
    }
    const model = this.isWell(info) ? textAt(info.reply.data, 24, 16).trim() : "";
    const wanted =
      this.options.model ??
      this.robot.vendorSection?.model ??
      this.robot.name.replace(new RegExp(`^${this.robot.vendor}\\s+`, "i"), "");
    if (model !== "" && !plain(model).includes(plain(wanted)))
      return { why: otherModel(this.robot, wanted, model), again: false };
    const names = await this.ask(client, COMMAND.axisNames, 1, OPEN_PATIENCE_S);
    if (names.kind === "silent") return { why: noWay(this.to, names), again: true };
    // Eight names, or seven of an older controller, of four letters each; an answer of another size names none.
    const axes =
      this.isWell(names) && names.reply.data.length <= 32
        ? Array.from({ length: 8 }, (_, i) => textAt(names.reply.data, 4 * i, 4).trim()).filter(name => name !== "")
            .length
        : 0;
    if (axes !== 0 && axes !== this.n) return { why: otherAxes(this.robot, model || "robot", axes), again: false };
    const first = await this.poll(client);
    return first ? { why: first, again: true } : null;
  }

  readonly handText = (files: readonly EmittedFile[]): Promise<UploadedProgram> =>
    this.line
      ? handJob(files, this.line.orders, this.line.files, this.hand)
      : Promise.resolve({ kind: "refused", why: noWay(this.to, { kind: "silent", after_s: 0 }) });

  readonly close = (): void => {
    this.life++;
    const was = this.line;
    this.line = null;
    this.hand.letDrop();
    was?.close();
  };
}

function yaskawaAdapterOf(wire: YaskawaWire): YaskawaAdapter {
  return {
    brand: "Yaskawa",
    robot: wire.robot,
    stale_s: wire.options.stale_s ?? STALE_S,
    watchdog: {
      kind: "none",
      because:
        "the Ethernet server has no watchdog: a robot that was sent to a target goes on to it when the line breaks, and streams of targets are not sent for that reason",
    },
    get files() {
      return wire.line?.files ?? null;
    },
    open: events => wire.open(events),
    close: wire.close,
    cannotSay(order) {
      if (order.kind === "signal") return wire.lines.cannotWrite(order.signal, order.value);
      if (order.kind === "gripper")
        return wire.hasGripper ? wire.lines.cannotWrite(GRIPPER, order.closed) : noGripper(wire.robot);
      return unsayableMotion(order, wire.robot);
    },
    move: (motion: AdapterMotion): Promise<CommandOutcome> => wire.hand.move(motion),
    stop(emergency) {
      wire.hand.stop(emergency);
    },
    setOverride: ratio => wire.hand.setOverride(ratio),
    reset: () => wire.hand.reset(),
    setSignal: (signal, value) =>
      wire.line
        ? wire.lines.write(wire.line.orders, signal, value, why => {
            wire.hand.complaint = why.sentence;
          })
        : noWay(wire.to, { kind: "silent", after_s: 0 }),
    setGripper(closed) {
      if (!wire.hasGripper) return noGripper(wire.robot);
      return wire.line
        ? wire.lines.write(wire.line.orders, GRIPPER, closed, why => {
            wire.hand.complaint = why.sentence;
          })
        : noWay(wire.to, { kind: "silent", after_s: 0 });
    },
    handText: wire.handText,
    async runText(files: readonly EmittedFile[]): Promise<CommandOutcome> {
      const handed = await wire.handText(files);
      return handed.kind === "refused" ? handed : handed.start();
    },
  };
}

/** Models are compared by their letters and digits. */
const plain = (text: string): string => text.toUpperCase().replace(/[^A-Z0-9]/g, "");
