import type { Scheduler } from "@twincell/core";
import type { ByteStream } from "../../transport/index.ts";
import { C3Reader, C3Writer } from "../codec/c3.ts";
import { readC3Reply, type C3Reply } from "../codec/c3-replies.ts";
import { writeC3Request, type C3Request } from "../codec/c3-requests.ts";

type Question = Exclude<C3Request, { readonly kind: "malformed" }>;
interface Asked {
  readonly type: number;
  readonly since_s: number;
  readonly answer: (reply: C3Reply | null) => void;
}

/** A question without an answer for this long ends the connection [s]. */
const PATIENCE_S = 2;
const LOOK_S = 0.1;
/** Bytes that wait to be sent; questions that can be left out are, above this. */
const MAX_WAITING = 65_536;

/** One connection to a proxy: questions by tag, each answered once, or by null when the connection ends first. */
export class C3Client {
  private readonly stream: ByteStream;
  private readonly scheduler: Scheduler;
  private readonly ended: (sentence: string) => void;
  private readonly roundTrip: (seconds: number) => void;
  private readonly writer = new C3Writer();
  private readonly asked = new Map<number, Asked>();
  private readonly stopLooking: () => void;
  private tag = 0;
  private isOpen = true;

  constructor(
    stream: ByteStream,
    scheduler: Scheduler,
    ended: (sentence: string) => void,
    roundTrip: (seconds: number) => void,
  ) {
    this.stream = stream;
    this.scheduler = scheduler;
    this.ended = ended;
    this.roundTrip = roundTrip;
    const reader = new C3Reader();
    stream.onEnd(({ sentence }) => {
      this.lose(sentence);
    });
    stream.onBytes(lent => {
      const why = reader.push(lent, (tag, type, payload) => {
        this.take(tag, type, payload);
        return this.isOpen;
      });
      if (why) this.lose(why);
    });
    this.stopLooking = scheduler.every(LOOK_S, () => {
      const oldest = this.asked.values().next();
      if (!oldest.done && scheduler.now_s() - oldest.value.since_s > PATIENCE_S)
        this.lose(`A question was not answered within ${PATIENCE_S} s.`);
    });
  }

  get isClosed(): boolean {
    return !this.isOpen;
  }
  /** Whether what is sent now waits behind what was sent before. */
  get isCrowded(): boolean {
    return this.stream.waiting > MAX_WAITING;
  }

  /** Sends at once. The data of a file in the answer is copied. */
  ask(question: Question): Promise<C3Reply | null> {
    return new Promise(resolve => {
      let tag = this.tag;
      do tag = (tag + 1) & 0xffff;
      while (this.asked.has(tag));
      this.tag = tag;
      const bytes = this.isOpen ? writeC3Request(this.writer, tag, question) : null;
      if (!bytes) {
        resolve(null);
        return;
      }
      this.asked.set(tag, { type: bytes[4]!, since_s: this.scheduler.now_s(), answer: resolve });
      this.stream.send(bytes);
    });
  }
  /** Whether every variable took its value. */
  async write(pairs: readonly (readonly [string, string])[]): Promise<boolean> {
    const reply = await this.ask({ kind: "write-many", pairs: pairs.map(([name, value]) => ({ name, value })) });
    return (
      reply?.kind === "values" && reply.items.length === pairs.length && reply.items.every(({ error }) => error === 1)
    );
  }
  /** Whether it was done. */
  async order(question: Question): Promise<boolean> {
    const reply = await this.ask(question);
    return reply !== null && reply.kind !== "malformed" && reply.error === 1;
  }

  close(): void {
    if (!this.isOpen) return;
    this.isOpen = false;
    this.stopLooking();
    this.stream.close();
    for (const { answer } of this.asked.values()) answer(null);
    this.asked.clear();
  }

  private lose(sentence: string): void {
    if (!this.isOpen) return;
    this.close();
    this.ended(sentence);
  }
  private take(tag: number, type: number, payload: Uint8Array): void {
    const asked = this.asked.get(tag);
    if (asked?.type !== type) {
      this.lose("An answer came to no question.");
      return;
    }
    this.asked.delete(tag);
    const reply = readC3Reply(type, payload);
    if (reply.kind === "malformed") {
      asked.answer(null);
      this.lose("An answer was not well formed.");
      return;
    }
    this.roundTrip(this.scheduler.now_s() - asked.since_s);
    asked.answer(reply.kind === "file" ? { ...reply, data: reply.data.slice() } : reply);
  }
}
