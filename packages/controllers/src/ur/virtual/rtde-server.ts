import type { ByteStream } from "../../transport/index.ts";
import {
  accepted,
  dataBuffer,
  namesIn,
  outputsAsked,
  packData,
  readText,
  recipeAnswer,
  recipeOf,
  RTDE,
  rtdeFrames,
  textFrame,
  unpackData,
  versionAnswer,
  viewOf,
  type NotHad,
  type Recipe,
  type Version,
} from "../codec/rtde.ts";
import { INPUT_FIELDS, OUTPUT_FIELDS, type Field } from "../codec/rtde-fields.ts";
import { MOST_WAITING, type Outbox } from "./faults.ts";
import type { Memory } from "./memory.ts";

export interface RtdeServerOptions {
  readonly memory: Memory;
  readonly outbox: Outbox;
  readonly version: Version;
  readonly cycle_s: number;
  now_s(): number;
  /** Inputs were written. */
  onInputs(fields: readonly Field[]): void;
  log(sentence: string): void;
}

/** More recipes or names than any client has: an attack, or a fault. */
const MOST_RECIPES = 255;
const MOST_NAMES = 400;
/** A client that has not read for this long is gone, and its inputs are free again [s]. */
const GONE_S = 2;

interface Connection {
  readonly stream: ByteStream;
  protocol: number;
  outputs: Recipe | null;
  buffer: Uint8Array;
  view: DataView;
  /** Cycles from one package to the next. */
  every: number;
  started: boolean;
  sent: number;
  /** Cycles in which the client has not read. */
  stuck: number;
  readonly inputs: Map<number, Recipe>;
}

/** The controller's end of RTDE: any number of clients, each with its own recipes. */
export class RtdeServer {
  private readonly options: RtdeServerOptions;
  private readonly connections = new Set<Connection>();
  /** Who writes an input. */
  private readonly owners = new Map<string, Connection>();
  private outputIds = 0;

  constructor(options: RtdeServerOptions) {
    this.options = options;
  }

  get clients(): number {
    return this.connections.size;
  }

  accept(stream: ByteStream): void {
    const frames = rtdeFrames();
    const bytes = new Uint8Array(0);
    const connection: Connection = {
      stream,
      protocol: 1,
      outputs: null,
      buffer: bytes,
      view: viewOf(bytes),
      every: 1,
      started: false,
      sent: 0,
      stuck: 0,
      inputs: new Map(),
    };
    this.connections.add(connection);
    stream.onEnd(() => {
      this.forget(connection);
    });
    stream.onBytes(lent => {
      if (!this.connections.has(connection)) return;
      const why = frames.push(lent, (type, payload) => {
        if (this.connections.has(connection)) this.take(connection, type, payload);
      });
      if (why !== null) this.reset(connection, why);
    });
  }

  closeAll(): void {
    for (const connection of [...this.connections]) {
      connection.stream.close();
      this.forget(connection);
    }
  }

  private forget(connection: Connection): void {
    this.connections.delete(connection);
    for (const [name, owner] of this.owners) if (owner === connection) this.owners.delete(name);
  }
  private reset(connection: Connection, why: string): void {
    this.options.log(`RTDE: ${why}`);
    connection.stream.close();
    this.forget(connection);
  }

  private take(connection: Connection, type: number, payload: Uint8Array): void {
    const { outbox } = this.options;
    const say = (bytes: Uint8Array): void => {
      outbox.send(connection.stream, bytes);
    };
    switch (type) {
      case RTDE.protocolVersion: {
        const wanted = payload.length < 2 ? 0 : viewOf(payload).getUint16(0);
        const yes = wanted === 1 || (wanted === 2 && !outbox.faults.oldProtocol);
        if (yes) connection.protocol = wanted;
        say(accepted(type, yes));
        return;
      }
      case RTDE.controllerVersion:
        say(versionAnswer(this.options.version));
        return;
      case RTDE.text:
        this.options.log(`RTDE: a client says: ${readText(payload, connection.protocol).message}`);
        return;
      case RTDE.outputs:
        this.setOutputs(connection, payload, say);
        return;
      case RTDE.inputs:
        this.setInputs(connection, payload, say);
        return;
      case RTDE.start: {
        const yes = connection.outputs !== null || connection.inputs.size > 0;
        connection.started = yes;
        say(accepted(type, yes));
        return;
      }
      case RTDE.pause:
        connection.started = false;
        say(accepted(type, true));
        return;
      case RTDE.data:
        this.setData(connection, payload);
        return;
      default:
        this.reset(connection, `no frame has the type ${type}.`);
    }
  }

  private setOutputs(connection: Connection, payload: Uint8Array, say: (bytes: Uint8Array) => void): void {
    const { frequency_Hz, names } = outputsAsked(payload, connection.protocol);
    const withId = connection.protocol >= 2;
    if (names.length > MOST_NAMES) {
      this.reset(connection, `${names.length} outputs were asked for.`);
      return;
    }
    const fields = names.map(name => OUTPUT_FIELDS.get(name));
    const known = fields.filter(field => field !== undefined);
    const whole = known.length === names.length && names.length > 0;
    const id = whole ? (this.outputIds = (this.outputIds % 255) + 1) : 0;
    if (whole) {
      connection.outputs = recipeOf(id, known);
      connection.buffer = dataBuffer(connection.outputs, withId);
      connection.view = viewOf(connection.buffer);
      const most_Hz = 1 / this.options.cycle_s;
      connection.every =
        frequency_Hz > 0 && frequency_Hz < most_Hz ? Math.max(1, Math.round(most_Hz / frequency_Hz)) : 1;
    } else {
      connection.outputs = null;
      connection.started = false;
    }
    say(
      recipeAnswer(
        RTDE.outputs,
        withId ? id : null,
        fields.map(field => field?.type ?? "NOT_FOUND"),
      ),
    );
  }

  private setInputs(connection: Connection, payload: Uint8Array, say: (bytes: Uint8Array) => void): void {
    const names = namesIn(payload);
    if (names.length > MOST_NAMES || connection.inputs.size >= MOST_RECIPES) {
      this.reset(connection, "more inputs were set up than there are.");
      return;
    }
    const had = names.map((name): Field | NotHad => {
      const field = INPUT_FIELDS.get(name);
      const owner = this.owners.get(name);
      return !field
        ? "NOT_FOUND"
        : this.options.outbox.faults.inUse || (owner && owner !== connection)
          ? "IN_USE"
          : field;
    });
    const fields = had.filter(entry => typeof entry !== "string");
    const whole = fields.length === names.length && names.length > 0;
    const id = whole ? connection.inputs.size + 1 : 0;
    if (whole) {
      connection.inputs.set(id, recipeOf(id, fields));
      for (const name of names) this.owners.set(name, connection);
    }
    say(
      recipeAnswer(
        RTDE.inputs,
        id,
        had.map(entry => (typeof entry === "string" ? entry : entry.type)),
      ),
    );
  }

  private setData(connection: Connection, payload: Uint8Array): void {
    const recipe = connection.inputs.get(payload[0] ?? 0);
    const { memory } = this.options;
    if (!recipe) {
      this.warn(connection, `There is no input recipe ${payload[0] ?? 0}.`);
      return;
    }
    if (!unpackData(recipe, payload.subarray(1), memory.slots)) {
      this.reset(
        connection,
        `a package of recipe ${recipe.id} has ${payload.length - 1} bytes instead of ${recipe.bytes}.`,
      );
      return;
    }
    memory.touch(recipe.fields, this.options.now_s());
    this.options.onInputs(recipe.fields);
  }
  private warn(connection: Connection, message: string): void {
    this.options.outbox.send(
      connection.stream,
      textFrame({ message, source: "RTDE", level: "warning" }, connection.protocol),
    );
  }

  /** Sends the state of this cycle to every client that is due. */
  cycle(cycles: number): void {
    const { memory, outbox } = this.options;
    for (const connection of this.connections) {
      const { outputs } = connection;
      if (!connection.started || !outputs || cycles % connection.every !== 0) continue;
      connection.stuck = connection.stream.waiting > MOST_WAITING ? connection.stuck + connection.every : 0;
      if (connection.stuck * this.options.cycle_s > GONE_S) {
        this.reset(connection, `a client has not read for ${GONE_S} s.`);
        continue;
      }
      packData(outputs, memory.slots, connection.buffer, connection.view);
      outbox.send(connection.stream, connection.buffer, true);
      if (outbox.faults.dropAfter > 0 && ++connection.sent >= outbox.faults.dropAfter) {
        connection.stream.close();
        this.forget(connection);
      }
    }
  }
}
