import type { Scheduler } from "@twincell/core";
import type { Address, DatagramSocket } from "../../transport/index.ts";
import {
  HEADER_BYTES,
  MAX_DATA_BYTES,
  readReply,
  writeRequest,
  type Division,
  type HsesReply,
  type HsesRequest,
} from "../codec/index.ts";

/** What came back, or nothing after so long. `data` of the reply is the receiver's to keep. */
export type Answer =
  | { readonly kind: "answer"; readonly reply: HsesReply }
  | { readonly kind: "silent"; readonly after_s: number };
export interface Question {
  readonly command?: number;
  readonly instance?: number;
  readonly attribute?: number;
  readonly service: number;
  readonly data?: Uint8Array;
  /** Pauses after which it is said again with the same id, and after the last of which it is given up [s]. */
  readonly patience_s: readonly number[];
  /** Goes out at once beside what is under way, before anything that waits. */
  readonly urgent?: boolean;
  /** A block or an acknowledgement of a file, by its number. */
  readonly block?: number;
}
interface Asked {
  readonly id: number;
  readonly question: Question;
  readonly bytes: Uint8Array;
  readonly resolve: (answer: Answer) => void;
  readonly begun_s: number;
  said: number;
  next_s: number;
}

const NOTHING = new Uint8Array(0);
/** How often patience is looked at [s]. */
const LOOK_S = 0.005;
const MOST_WAITING = 64;

export interface Client {
  /** One at a time and one urgent one beside it. Never rejects. */
  ask(question: Question): Promise<Answer>;
  /** Said once; nobody waits for the answer. */
  say(question: Omit<Question, "patience_s">): void;
  close(): void;
}
export interface ClientOptions {
  readonly socket: DatagramSocket;
  readonly to: Address;
  readonly division: Division;
  readonly scheduler: Scheduler;
  readonly onRoundTrip?: ((seconds: number) => void) | undefined;
}

/** Asks a controller over UDP: an answer belongs to its question by the request id, and what is lost is said again. */
export function hsesClient(options: ClientOptions): Client {
  return hsesClientOf(new HsesClient(options));
}

class HsesClient {
  readonly socket: DatagramSocket;
  readonly to: Address;
  readonly division: Division;
  readonly scheduler: Scheduler;
  readonly onRoundTrip: ((seconds: number) => void) | undefined;
  readonly out = new Uint8Array(HEADER_BYTES + MAX_DATA_BYTES);
  waiting: Asked[] = [];
  current: Asked | null = null;
  urgent: Asked | null = null;
  lastId = 0;
  isClosed = false;
  readonly stop: () => void;

  constructor({ socket, to, division, scheduler, onRoundTrip }: ClientOptions) {
    this.socket = socket;
    this.to = to;
    this.division = division;
    this.scheduler = scheduler;
    this.onRoundTrip = onRoundTrip;
    this.socket.onDatagram((lent, from) => {
      if (this.isClosed || from.port !== this.to.port) return;
      const read = readReply(lent);
      if (read.kind === "flawed" || read.packet.division !== this.division) return;
      const { packet: reply } = read;
      for (const asked of [this.current, this.urgent]) {
        if (asked === null || asked.id !== reply.id || asked.question.service !== reply.service) continue;
        // A block that was answered before its turn is the answer to an older packet.
        if (asked.question.block !== undefined && !belongs(asked.question, reply)) continue;
        this.onRoundTrip?.(this.scheduler.now_s() - (asked.next_s - asked.question.patience_s[asked.said - 1]!));
        this.end(asked, { kind: "answer", reply: { ...reply, data: reply.data.slice() } });
        return;
      }
    });
    this.stop = this.scheduler.every(LOOK_S, () => {
      const now_s = this.scheduler.now_s();
      for (const asked of [this.current, this.urgent]) {
        if (asked === null || now_s < asked.next_s - 1e-9) continue;
        if (asked.said < asked.question.patience_s.length) this.send(asked);
        else this.end(asked, { kind: "silent", after_s: now_s - asked.begun_s });
      }
    });
  }

  /** @param id  of a file transfer: the same for all its packets. */
  packet(
    { command = 0, instance = 0, attribute = 0, service, data = NOTHING, block }: Omit<Question, "patience_s">,
    id: number,
  ): Uint8Array {
    const request: HsesRequest = {
      division: this.division,
      ack: block !== undefined,
      id,
      block: block ?? 0,
      command,
      instance,
      attribute,
      service,
      data,
    };
    return this.out.subarray(0, writeRequest(request, this.out));
  }

  nextId(): number {
    return (this.lastId = (this.lastId + 1) & 255);
  }

  send(asked: Asked): void {
    this.socket.send(asked.bytes, this.to);
    asked.next_s = this.scheduler.now_s() + asked.question.patience_s[asked.said]!;
    asked.said++;
  }

  goOn(): void {
    if (this.isClosed) return;
    if (this.urgent === null) {
      const at = this.waiting.findIndex(({ question }) => question.urgent);
      if (at >= 0) this.send((this.urgent = this.waiting.splice(at, 1)[0]!));
    }
    if (this.current === null && this.waiting.length > 0 && !this.waiting[0]!.question.urgent)
      this.send((this.current = this.waiting.shift()!));
  }

  end(asked: Asked, answer: Answer): void {
    if (asked === this.current) this.current = null;
    else this.urgent = null;
    asked.resolve(answer);
    this.goOn();
  }
}

function hsesClientOf(own: HsesClient): Client {
  return {
    ask: question =>
      new Promise(resolve => {
        if (own.isClosed || own.waiting.length >= MOST_WAITING) {
          resolve({ kind: "silent", after_s: 0 });
          return;
        }
        const id = question.block === undefined ? own.nextId() : own.lastId;
        own.waiting.push({
          id,
          question,
          bytes: own.packet(question, id).slice(),
          resolve,
          begun_s: own.scheduler.now_s(),
          said: 0,
          next_s: 0,
        });
        own.goOn();
      }),
    say(question) {
      if (!own.isClosed)
        own.socket.send(own.packet(question, question.block === undefined ? own.nextId() : own.lastId), own.to);
    },
    close() {
      if (own.isClosed) return;
      own.isClosed = true;
      own.stop();
      const left = [own.current, own.urgent, ...own.waiting];
      own.waiting = [];
      own.current = own.urgent = null;
      for (const asked of left) asked?.resolve({ kind: "silent", after_s: 0 });
      own.socket.close();
    },
  };
}

/** Sent blocks are answered by their own number; an acknowledged one by the next. */
function belongs(question: Question, reply: HsesReply): boolean {
  if (reply.status !== 0) return true;
  const asked = question.block! & 0x7fff_ffff;
  const got = reply.block & 0x7fff_ffff;
  return question.data === undefined ? got === asked + 1 : got === asked;
}
