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
  readonly onRoundTrip?: (seconds: number) => void;
}

/** Asks a controller over UDP: an answer belongs to its question by the request id, and what is lost is said again. */
export function hsesClient({ socket, to, division, scheduler, onRoundTrip }: ClientOptions): Client {
  const out = new Uint8Array(HEADER_BYTES + MAX_DATA_BYTES);
  let waiting: Asked[] = [];
  let current: Asked | null = null;
  let urgent: Asked | null = null;
  let lastId = 0;
  let isClosed = false;

  /** @param id  of a file transfer: the same for all its packets. */
  const packet = (
    { command = 0, instance = 0, attribute = 0, service, data = NOTHING, block }: Omit<Question, "patience_s">,
    id: number,
  ): Uint8Array => {
    const request: HsesRequest = {
      division,
      ack: block !== undefined,
      id,
      block: block ?? 0,
      command,
      instance,
      attribute,
      service,
      data,
    };
    return out.subarray(0, writeRequest(request, out));
  };
  const nextId = (): number => (lastId = (lastId + 1) & 255);

  function send(asked: Asked): void {
    socket.send(asked.bytes, to);
    asked.next_s = scheduler.now_s() + asked.question.patience_s[asked.said]!;
    asked.said++;
  }
  function goOn(): void {
    if (isClosed) return;
    if (urgent === null) {
      const at = waiting.findIndex(({ question }) => question.urgent);
      if (at >= 0) send((urgent = waiting.splice(at, 1)[0]!));
    }
    if (current === null && waiting.length > 0 && !waiting[0]!.question.urgent) send((current = waiting.shift()!));
  }
  function end(asked: Asked, answer: Answer): void {
    if (asked === current) current = null;
    else urgent = null;
    asked.resolve(answer);
    goOn();
  }

  socket.onDatagram((lent, from) => {
    if (isClosed || from.port !== to.port) return;
    const read = readReply(lent);
    if (read.kind === "flawed" || read.packet.division !== division) return;
    const { packet: reply } = read;
    for (const asked of [current, urgent]) {
      if (asked === null || asked.id !== reply.id || asked.question.service !== reply.service) continue;
      // A block that was answered before its turn is the answer to an older packet.
      if (asked.question.block !== undefined && !belongs(asked.question, reply)) continue;
      onRoundTrip?.(scheduler.now_s() - (asked.next_s - asked.question.patience_s[asked.said - 1]!));
      end(asked, { kind: "answer", reply: { ...reply, data: reply.data.slice() } });
      return;
    }
  });
  const stop = scheduler.every(LOOK_S, () => {
    const now_s = scheduler.now_s();
    for (const asked of [current, urgent]) {
      if (asked === null || now_s < asked.next_s - 1e-9) continue;
      if (asked.said < asked.question.patience_s.length) send(asked);
      else end(asked, { kind: "silent", after_s: now_s - asked.begun_s });
    }
  });

  return {
    ask: question =>
      new Promise(resolve => {
        if (isClosed || waiting.length >= MOST_WAITING) {
          resolve({ kind: "silent", after_s: 0 });
          return;
        }
        const id = question.block === undefined ? nextId() : lastId;
        waiting.push({
          id,
          question,
          bytes: packet(question, id).slice(),
          resolve,
          begun_s: scheduler.now_s(),
          said: 0,
          next_s: 0,
        });
        goOn();
      }),
    say(question) {
      if (!isClosed) socket.send(packet(question, question.block === undefined ? nextId() : lastId), to);
    },
    close() {
      if (isClosed) return;
      isClosed = true;
      stop();
      const left = [current, urgent, ...waiting];
      waiting = [];
      current = urgent = null;
      for (const asked of left) asked?.resolve({ kind: "silent", after_s: 0 });
      socket.close();
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
