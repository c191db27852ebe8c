import type { Scheduler } from "@twincell/core";
import { faultyLine, type ByteStream, type Listening, type Network } from "../../transport/index.ts";
import { C3_COMMAND, C3_ERROR, C3_TYPE, C3Reader, C3Writer, FILE_STEP, isC3Type } from "../codec/c3.ts";
import { writeC3Reply, type C3Reply } from "../codec/c3-replies.ts";
import { readC3Request, type C3Request } from "../codec/c3-requests.ts";
import type { KukaFaults } from "./faults.ts";
import type { Machine } from "./machine.ts";
import type { Programs } from "./programs.ts";
import type { Variables } from "./variables.ts";

/** Clients at once, bytes of a file, and bytes that wait for a client that does not read. */
const MOST_CLIENTS = 16;
const MAX_FILE = 4_000_000;
const MAX_WAITING = 1_000_000;
const CHUNK = 32_768;
export const C3_TYPES: readonly number[] = Object.values(C3_TYPE).sort((a, b) => a - b);
/** Version 1.5, of the open kind. */
const VERSION = [1, 5, 0] as const;

export interface C3ServerOptions {
  readonly network: Network;
  readonly host: string;
  readonly port: number;
  readonly scheduler: Scheduler;
  readonly faults: KukaFaults;
  readonly variables: Variables;
  readonly machine: Machine;
  readonly programs: Programs;
  readonly hostName: string;
  readonly log: (sentence: string) => void;
}
export interface C3Server {
  readonly listening: Listening;
  cut(): void;
  close(): void;
}
type Answer = Exclude<C3Reply, { readonly kind: "malformed" }>;

const plain = (error: number): Answer => ({ kind: "plain", error });
const code = (done: boolean): number => (done ? C3_ERROR.success : C3_ERROR.general);

/** The proxy in front of a virtual controller. Whoever sends what is no message is logged once and cut off. */
export async function serveC3(options: C3ServerOptions): Promise<C3Server> {
  const { faults, scheduler, log } = options;
  const open = new Set<ByteStream>();
  let seed = 1;

  function accept(stream: ByteStream): void {
    if (faults.refusing || open.size >= MOST_CLIENTS) {
      stream.close();
      return;
    }
    open.add(stream);
    const reader = new C3Reader();
    const writer = new C3Writer();
    const line = faultyLine(faults, scheduler, seed++);
    const client = new C3Session(options);
    const end = (): void => {
      open.delete(stream);
      stream.close();
    };
    const reset = (sentence: string): void => {
      log(`${stream.peer.host}:${stream.peer.port}: ${sentence} The connection is reset.`);
      end();
    };
    const out = (bytes: Uint8Array): void => {
      stream.send(bytes);
    };
    stream.onEnd(() => {
      open.delete(stream);
    });
    stream.onBytes(lent => {
      if (!open.has(stream)) return;
      const why = reader.push(lent, (tag, type, payload) => {
        const reply = isC3Type(type) ? client.answer(readC3Request(type, payload)) : plain(C3_ERROR.notImplemented);
        line.send(writeC3Reply(writer, tag, type, reply), out);
        if (!isC3Type(type)) {
          reset(`Message type ${type} is none of the protocol.`);
          return false;
        }
        if (stream.waiting > MAX_WAITING) {
          reset("Answers are not read.");
          return false;
        }
        if (--faults.dropAfter <= 0) {
          faults.dropAfter = Infinity;
          end();
          return false;
        }
        return true;
      });
      if (why) reset(why);
    });
  }

  const listening = await options.network.listen({ host: options.host, port: options.port }, accept);
  const cut = (): void => {
    for (const stream of [...open]) {
      open.delete(stream);
      stream.close();
    }
  };
  return {
    listening,
    cut,
    close() {
      if (listening.kind === "listening") listening.close();
      cut();
    },
  };
}

/** Answers the questions of one client, who has his own file buffers. */
class C3Session {
  private readonly options: C3ServerOptions;
  private put: Uint8Array | null = null;
  private got: Uint8Array | null = null;

  constructor(options: C3ServerOptions) {
    this.options = options;
  }

  answer(request: C3Request): Answer {
    switch (request.kind) {
      case "read": {
        const { error, value } = this.read(request.name);
        return { kind: "value", value, error };
      }
      case "write": {
        const { error, value } = this.write(request.name, request.value);
        return { kind: "value", value, error };
      }
      case "read-many":
        return { kind: "values", items: request.names.map(name => this.read(name)), error: C3_ERROR.success };
      case "write-many":
        return {
          kind: "values",
          items: request.pairs.map(({ name, value }) => this.write(name, value)),
          error: C3_ERROR.success,
        };
      case "control":
        return {
          kind: "control",
          command: request.command,
          error: code(this.control(request.command, request.interpreter)),
        };
      case "select": {
        if (request.force && this.options.programs.state === "ACTIVE") this.options.programs.cancel();
        const selected = this.options.programs.select(request.name) === null;
        return {
          kind: "control",
          command: request.run ? C3_COMMAND.run : C3_COMMAND.select,
          error: code(selected && (!request.run || this.start())),
        };
      }
      case "confirm-all":
        this.options.machine.confirm();
        return plain(C3_ERROR.success);
      case "info":
        return { kind: "info", version: VERSION, host: this.options.hostName, error: C3_ERROR.success };
      case "features":
        return { kind: "features", types: C3_TYPES, error: C3_ERROR.success };
      case "unknown":
        return plain(C3_ERROR.notImplemented);
      case "malformed":
        return plain(C3_ERROR.protocol);
      default:
        return this.files(request);
    }
  }

  private files(request: Extract<C3Request, { readonly kind: `${"file" | "put" | "get"}-${string}` }>): Answer {
    switch (request.kind) {
      case "file-create":
        return plain(code(this.options.programs.write(request.name, "") === null));
      case "file-delete":
        return plain(code(this.options.programs.delete(request.name)));
      case "put-begin":
        if (request.size > MAX_FILE) return this.file(FILE_STEP.begin, C3_ERROR.memory);
        this.put = new Uint8Array(request.size);
        return this.file(FILE_STEP.begin, C3_ERROR.success, this.put.length);
      case "put-size":
        return this.file(FILE_STEP.size, C3_ERROR.success, this.put?.length ?? 0);
      case "put-data":
        if (!this.put || request.offset + request.data.length > this.put.length)
          return this.file(FILE_STEP.data, C3_ERROR.argument, 0, request.offset);
        this.put.set(request.data, request.offset);
        return this.file(FILE_STEP.data, C3_ERROR.success, request.data.length, request.offset);
      case "put-end": {
        const text = this.put && latin1(this.put);
        this.put = null;
        return this.file(
          FILE_STEP.end,
          code(text !== null && this.options.programs.write(request.name, text) === null),
        );
      }
      case "get-begin": {
        const text = this.options.programs.read(request.name);
        this.got = text === undefined ? null : Uint8Array.from(text, sign => sign.charCodeAt(0) & 255);
        return this.file(FILE_STEP.begin, code(this.got !== null), this.got?.length ?? 0);
      }
      case "get-size":
        return this.file(FILE_STEP.size, C3_ERROR.success, this.got?.length ?? 0);
      case "get-data": {
        const data = this.got?.subarray(request.offset, request.offset + Math.min(request.most, CHUNK)) ?? NOTHING;
        return this.file(FILE_STEP.data, code(this.got !== null), data.length, request.offset, data);
      }
      case "get-end":
        this.got = null;
        return this.file(FILE_STEP.end, C3_ERROR.success);
    }
  }
  private file(step: number, error: number, size = 0, offset = 0, data = NOTHING): Answer {
    return { kind: "file", step, offset, size, data, error };
  }

  private write(name: string, value: string): { error: number; value: string } {
    const { variables } = this.options;
    const done = variables.write(name, value);
    return { error: code(done), value: done ? (variables.read(name) ?? value) : "" };
  }
  private read(name: string): { error: number; value: string } {
    const value = this.options.variables.read(name);
    return { error: code(value !== undefined), value: value ?? "" };
  }
  /** From outside a program starts in AUT and EXT only: in T1 and T2 a hand is on the start key. */
  private start(): boolean {
    return !this.options.machine.isManual && this.options.programs.start() === null;
  }
  private control(command: number, interpreter: number): boolean {
    const { programs } = this.options;
    // There is no submit interpreter.
    if (interpreter !== 1) return false;
    if (command === C3_COMMAND.start) return this.start();
    if (command === C3_COMMAND.stop) {
      programs.hold();
      return true;
    }
    return command === C3_COMMAND.reset ? programs.reset() === null : programs.cancel() === null;
  }
}
const NOTHING: Uint8Array = new Uint8Array();

function latin1(bytes: Uint8Array): string {
  let text = "";
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return text;
}
