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
import { robotState } from "./state.ts";
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
  const { robot, scheduler, network, host } = options;
  const known = options.scale ?? ownScale(robot);
  const scale = known ?? exampleScale(robot);
  const n = robot.arm.joints.length;
  const state = robotState(robot, scale);
  const to = { host, port: options.ports?.robot ?? ROBOT_PORT };
  const filesAt = { host, port: options.ports?.files ?? FILE_PORT };
  let outputsFrom = options.outputsFrom;
  const tableOf = (signals: Readonly<Record<string, number>>, gripper: number | undefined): LineTable =>
    lineTable({ ...signals, ...(gripper === undefined ? {} : { [GRIPPER]: gripper }) }, outputsFrom, (signal, on) => {
      if (signal === GRIPPER) state.sample.gripperClosed = on;
      else state.sample.signals.set(signal, on);
    });
  let lines = tableOf(options.signals ?? watchedLines(), options.gripper);
  let hasGripper = options.gripper !== undefined;
  const hand = new Hand({ robot, scheduler, scale, state });
  let line: { readonly orders: Client; readonly files: FileClient; readonly close: () => void } | null = null;
  let life = 0;
  let begun_s = 0;
  let beside_s = 0;
  let beside = 0;

  const isWell = (answer: Answer): answer is Extract<Answer, { kind: "answer" }> =>
    answer.kind === "answer" && answer.reply.status === 0;
  const ask = (
    client: Client,
    command: number,
    instance: number,
    patience_s: readonly number[],
    attribute = 0,
  ): Promise<Answer> =>
    client.ask({
      command,
      instance,
      attribute,
      service: attribute === 0 ? SERVICE.getAll : SERVICE.getOne,
      patience_s,
    });

  /** One question beside the state, taken in turn: the job with the override, and the groups of lines. */
  async function askBeside(client: Client): Promise<void> {
    const { groups } = lines;
    const which = beside++ % (groups.length + 1);
    if (which === 0) {
      const answer = await ask(client, COMMAND.job, 1, READ_PATIENCE_S);
      const job = isWell(answer) ? readJob(answer.reply.data) : undefined;
      if (job) state.pendantOverride = Math.min(1, job.override);
      return;
    }
    const group = groups[which - 1]!;
    const answer = await ask(client, COMMAND.io, group, READ_PATIENCE_S, 1);
    if (isWell(answer) && answer.reply.data.length > 0) lines.take(group, answer.reply.data[0]!);
  }

  /** Status, then position: a state. Why not, when the controller does not say. */
  async function poll(client: Client): Promise<Refusal | null> {
    const number = hand.beginPoll();
    const status = await ask(client, COMMAND.status, 1, READ_PATIENCE_S);
    if (!isWell(status)) return noWay(to, status);
    if (!state.takeStatus(status.reply.data)) return badAnswer(to);
    if (!state.status.alarm) state.alarm = "";
    else if (state.alarm === "") {
      const answer = await ask(client, COMMAND.alarm, 1, READ_PATIENCE_S);
      const alarm = isWell(answer) ? readAlarm(answer.reply.data) : undefined;
      state.alarm = alarm
        ? `Alarm ${alarm.code}: ${alarm.name}${alarm.data === 0 ? "" : ` [${alarm.data}]`}`
        : "An alarm is present.";
    }
    const position = await ask(client, COMMAND.position, 1, READ_PATIENCE_S);
    if (!isWell(position)) return noWay(to, position);
    if (!state.takePosition(position.reply.data, scheduler.now_s() - begun_s, hand.override, hand.emergency))
      return badAnswer(to);
    if (hand.complaint !== "" && state.sample.message === "") state.sample.message = hand.complaint;
    hand.look(number);
    return null;
  }

  function keepPolling(client: Client, events: AdapterEvents, mine: number): () => void {
    let isBusy = false;
    const turn = async (): Promise<void> => {
      const why = await poll(client);
      if (mine !== life) return;
      if (why?.code === "link.no-answer") {
        events.lost(why.sentence);
        return;
      }
      // One odd answer is no state; when no state comes any more, that is noticed.
      if (why) return;
      events.sample(state.sample);
      if (scheduler.now_s() - beside_s < BESIDE_S) return;
      beside_s = scheduler.now_s();
      await askBeside(client);
    };
    return scheduler.every(options.poll_s ?? POLL_S, () => {
      if (isBusy) return;
      isBusy = true;
      void turn().then(() => {
        isBusy = false;
      });
    });
  }

  /** Whether the right robot answers; null when it does. */
  async function strange(client: Client): Promise<{ readonly why: Refusal; readonly again: boolean } | null> {
    const info = await ask(client, COMMAND.systemInfo, 11, OPEN_PATIENCE_S);
    if (info.kind === "silent") return { why: noWay(to, info), again: true };
    const isVirtual = isWell(info) && textAt(info.reply.data, 0, 24).startsWith(VIRTUAL);
    if (known === undefined && !isVirtual) return { why: unknownPulses(robot), again: false };
    if (isVirtual && options.signals === undefined && options.gripper === undefined) {
      outputsFrom ??= EXAMPLE_OUTPUTS;
      lines = tableOf(EXAMPLE_SIGNALS, EXAMPLE_GRIPPER);
      hasGripper = true;
    }
    const model = isWell(info) ? textAt(info.reply.data, 24, 16).trim() : "";
    const wanted =
      options.model ?? robot.vendorSection?.model ?? robot.name.replace(new RegExp(`^${robot.vendor}\\s+`, "i"), "");
    if (model !== "" && !plain(model).includes(plain(wanted)))
      return { why: otherModel(robot, wanted, model), again: false };
    const names = await ask(client, COMMAND.axisNames, 1, OPEN_PATIENCE_S);
    if (names.kind === "silent") return { why: noWay(to, names), again: true };
    // Eight names, or seven of an older controller, of four letters each; an answer of another size names none.
    const axes =
      isWell(names) && names.reply.data.length <= 32
        ? Array.from({ length: 8 }, (_, i) => textAt(names.reply.data, 4 * i, 4).trim()).filter(name => name !== "")
            .length
        : 0;
    if (axes !== 0 && axes !== n) return { why: otherAxes(robot, model || "robot", axes), again: false };
    const first = await poll(client);
    return first ? { why: first, again: true } : null;
  }

  const handText = (files: readonly EmittedFile[]): Promise<UploadedProgram> =>
    line
      ? handJob(files, line.orders, line.files, hand)
      : Promise.resolve({ kind: "refused", why: noWay(to, { kind: "silent", after_s: 0 }) });

  function close(): void {
    life++;
    const was = line;
    line = null;
    hand.letDrop();
    was?.close();
  }

  return {
    brand: "Yaskawa",
    robot,
    stale_s: options.stale_s ?? STALE_S,
    watchdog: {
      kind: "none",
      because:
        "the Ethernet server has no watchdog: a robot that was sent to a target goes on to it when the line breaks, and streams of targets are not sent for that reason",
    },
    get files() {
      return line?.files ?? null;
    },
    async open(events): Promise<Opened> {
      close();
      const mine = life;
      const failed = (why: Refusal, again: boolean): Opened => ({ kind: "failed", why, again });
      if (scale.pulsesPerDegree.length !== n) return failed(noPulses(robot, scale.pulsesPerDegree.length), false);
      const here = options.local ?? "0.0.0.0";
      const open: Client[] = [];
      const shut = (): void => {
        for (const client of open) client.close();
      };
      // A controller hears one question at a time of each sender: who watches does not wait behind an order whose
      // answer was lost.
      for (const [address, division] of [
        [to, DIVISION.robot],
        [to, DIVISION.robot],
        [filesAt, DIVISION.file],
      ] as const) {
        const bound = await network.bind({ host: here, port: 0 });
        if (bound.kind === "taken" || mine !== life) {
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
            scheduler,
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
      begun_s = scheduler.now_s();
      const wrong = await strange(watch);
      if (wrong || mine !== life) {
        shut();
        return wrong
          ? failed(wrong.why, wrong.again)
          : failed({ code: "link.closed", sentence: "The link was closed.", hint: "Connect it again." }, false);
      }
      const stopPolling = keepPolling(watch, events, mine);
      line = {
        orders,
        files: fileClient(fileLine),
        close() {
          stopPolling();
          shut();
        },
      };
      hand.take(orders);
      return { kind: "open" };
    },
    close,
    cannotSay(order) {
      if (order.kind === "signal") return lines.cannotWrite(order.signal, order.value);
      if (order.kind === "gripper") return hasGripper ? lines.cannotWrite(GRIPPER, order.closed) : noGripper(robot);
      return unsayableMotion(order, robot);
    },
    move: (motion: AdapterMotion): Promise<CommandOutcome> => hand.move(motion),
    stop(emergency) {
      hand.stop(emergency);
    },
    setOverride: ratio => hand.setOverride(ratio),
    reset: () => hand.reset(),
    setSignal: (signal, value) =>
      line
        ? lines.write(line.orders, signal, value, why => {
            hand.complaint = why.sentence;
          })
        : noWay(to, { kind: "silent", after_s: 0 }),
    setGripper(closed) {
      if (!hasGripper) return noGripper(robot);
      return line
        ? lines.write(line.orders, GRIPPER, closed, why => {
            hand.complaint = why.sentence;
          })
        : noWay(to, { kind: "silent", after_s: 0 });
    },
    handText,
    async runText(files: readonly EmittedFile[]): Promise<CommandOutcome> {
      const handed = await handText(files);
      return handed.kind === "refused" ? handed : handed.start();
    },
  };
}

/** Models are compared by their letters and digits. */
const plain = (text: string): string => text.toUpperCase().replace(/[^A-Z0-9]/g, "");
