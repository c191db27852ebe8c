import { latin1Text, type Fields, type HttpRequest, type HttpResponse } from "./message.ts";

export interface HttpLimits {
  readonly head: number;
  readonly fields: number;
  readonly body: number;
}
export const HTTP_LIMITS: HttpLimits = { head: 16_384, fields: 64, body: 4_000_000 };

/** A message whose head is known and whose body is still coming. */
interface Head {
  readonly first: readonly [string, string, string];
  readonly fields: Fields /** -1 for chunks. */;
  readonly length: number;
}

const CR = 13;
const LF = 10;
const NONE = new Uint8Array(0);
const REQUEST = /^([A-Z]{1,16}) ([\x21-\x7E]{1,8192}) HTTP\/1\.([01])$/;
const RESPONSE = /^HTTP\/1\.([01]) ([1-5][0-9]{2})(?: ([\x20-\x7E\x80-\xFF]*))?$/;
const NAME = /^[!#$%&'*+.^_`|~0-9A-Za-z-]{1,128}$/;
const CHUNK = /^([0-9A-Fa-f]{1,7})(?:;[\x20-\x7E]{0,256})?$/;
/** Longest line that gives the size of a chunk. */
const MOST_CHUNK_LINE = 300;

/**
 * HTTP/1.1 messages out of pieces of bytes: bodies of a told length or in chunks, nothing that ends with the
 * connection. What is not exactly such a message is one sentence, and the reader then takes no more. It never holds
 * more than the limits.
 */
abstract class HttpReader<T> {
  private readonly limits: HttpLimits;
  private held: Uint8Array = NONE;
  private size = 0;
  private at = 0;
  private head: Head | null = null;
  /** What chunks brought so far; null for a body of a told length. */
  private chunks: Uint8Array | null = null;
  private chunked = 0;
  /** So far no end of a head was found. */
  private looked = 0;
  private left = -1;
  private trailing = false;
  private trailers = 0;
  private broken = "";

  constructor(limits: Partial<HttpLimits> = {}) {
    this.limits = { ...HTTP_LIMITS, ...limits };
  }

  protected abstract readonly firstLine: RegExp;
  protected abstract message(first: readonly [string, string, string], fields: Fields, body: Uint8Array): T;
  /** Whether a message with that first line has no body whatever its fields say. */
  protected abstract isBare(first: readonly [string, string, string]): boolean;
  protected abstract readonly needsLength: boolean;

  /** Bytes that were not read because the taker wanted no more. */
  get rest(): Uint8Array {
    return this.held.slice(this.at, this.size);
  }
  /** Whether a message has begun. */
  get isInside(): boolean {
    return this.head !== null || this.size > this.at;
  }

  /** @param take  told each message; false takes no more. @returns why the bytes are no messages, or null. */
  push(lent: Uint8Array, take: (message: T) => boolean): string | null {
    if (this.broken !== "") return this.broken;
    this.keep(lent);
    for (;;) {
      const got = this.next();
      if (typeof got === "string") {
        this.broken = got;
        this.held = NONE;
        this.size = this.at = 0;
        return got;
      }
      if (got === null) break;
      if (!take(got.message)) return null;
    }
    return null;
  }

  private keep(lent: Uint8Array): void {
    const kept = this.size - this.at;
    const wanted = kept + lent.length;
    if (wanted > this.held.length || this.at > 65_536) {
      const room = new Uint8Array(Math.max(4096, wanted * 2));
      room.set(this.held.subarray(this.at, this.size));
      this.held = room;
      this.at = 0;
      this.size = kept;
    } else if (this.at > 0 && this.size + lent.length > this.held.length) {
      this.held.copyWithin(0, this.at, this.size);
      this.at = 0;
      this.size = kept;
    }
    this.held.set(lent, this.size);
    this.size += lent.length;
  }

  private next(): { readonly message: T } | string | null {
    if (!this.head) {
      const end = this.endOfHead();
      if (end < 0)
        return this.size - this.at > this.limits.head ? `A head of more than ${this.limits.head} bytes came.` : null;
      const head = this.readHead(latin1Text(this.held.subarray(this.at, end)));
      if (typeof head === "string") return head;
      this.at = end + 4;
      this.head = head;
      this.chunks = head.length < 0 ? NONE : null;
      this.chunked = 0;
      this.left = -1;
      this.trailing = false;
      this.trailers = 0;
    }
    const body = this.chunks ? this.readChunks() : this.readWhole(this.head.length);
    if (body === null || typeof body === "string") return body;
    const { first, fields } = this.head;
    this.head = this.chunks = null;
    if (this.at === this.size) {
      this.held = NONE;
      this.at = this.size = 0;
    }
    return { message: this.message(first, fields, body) };
  }

  private endOfHead(): number {
    const { held } = this;
    const last = Math.min(this.size, this.at + this.limits.head) - 3;
    for (let i = this.at + this.looked; i < last; i++)
      if (held[i] === CR && held[i + 1] === LF && held[i + 2] === CR && held[i + 3] === LF) {
        this.looked = 0;
        return i;
      }
    this.looked = Math.max(0, last - this.at);
    return -1;
  }

  private readHead(text: string): Head | string {
    const [line = "", ...lines] = text.split("\r\n");
    const first = this.firstLine.exec(line);
    if (!first) return "The first line is none of HTTP/1.1.";
    if (lines.length > this.limits.fields) return `More than ${this.limits.fields} fields came.`;
    const fields: (readonly [string, string])[] = [];
    for (const each of lines) {
      const colon = each.indexOf(":");
      const name = each.slice(0, Math.max(0, colon));
      const value = each.slice(colon + 1).trim();

      if (!NAME.test(name) || /[\x00-\x08\x0A-\x1F\x7F]/.test(value)) return "A field is none of HTTP/1.1.";
      fields.push([name.toLowerCase(), value]);
    }
    const triple = [first[1] ?? "", first[2] ?? "", first[3] ?? ""] as const;
    const all = (name: string): string[] => fields.filter(([is]) => is === name).map(([, value]) => value);
    const lengths = all("content-length");
    const codings = all("transfer-encoding");
    const [length] = lengths;
    if (this.isBare(triple)) return { first: triple, fields, length: 0 };
    if (codings.length > 0) {
      if (lengths.length > 0) return "A message has a length and chunks as well.";
      return codings.length === 1 && codings[0]!.toLowerCase() === "chunked"
        ? { first: triple, fields, length: -1 }
        : `The transfer coding "${codings[0]!.slice(0, 40)}" is not read here.`;
    }
    if (length === undefined)
      return this.needsLength ? "A message has neither length nor chunks." : { first: triple, fields, length: 0 };
    if (lengths.some(each => each !== length) || !/^[0-9]{1,10}$/.test(length))
      return "The length of a message is no number.";
    return Number(length) > this.limits.body
      ? `A body of more than ${this.limits.body} bytes was announced.`
      : { first: triple, fields, length: Number(length) };
  }

  private readWhole(length: number): Uint8Array | null {
    if (this.size - this.at < length) return null;
    this.at += length;
    return this.held.slice(this.at - length, this.at);
  }

  private readChunks(): Uint8Array | string | null {
    for (;;) {
      if (this.left < 0) {
        const line = this.line();
        if (line === null) return this.size - this.at > MOST_CHUNK_LINE ? "The size of a chunk is no number." : null;
        // Fields behind the last chunk are read over, up to an empty line.
        if (this.trailing) {
          if (line === "") return this.chunks!.slice(0, this.chunked);
          if (++this.trailers > this.limits.fields) return "Too many fields came behind a body.";
          continue;
        }
        const size = CHUNK.exec(line);
        if (!size) return "The size of a chunk is no number.";
        this.left = parseInt(size[1]!, 16);
        if (this.chunked + this.left > this.limits.body) return `A body of more than ${this.limits.body} bytes came.`;
        if (this.left === 0) {
          this.trailing = true;
          this.left = -1;
          continue;
        }
      }
      if (this.size - this.at < this.left + 2) return null;
      const end = this.at + this.left;
      if (this.held[end] !== CR || this.held[end + 1] !== LF) return "A chunk does not end where it should.";
      this.gather(end);
      this.at = end + 2;
      this.left = -1;
    }
  }
  private gather(end: number): void {
    const wanted = this.chunked + end - this.at;
    if (wanted > this.chunks!.length) {
      const room = new Uint8Array(Math.min(this.limits.body, Math.max(4096, wanted * 2)));
      room.set(this.chunks!.subarray(0, this.chunked));
      this.chunks = room;
    }
    this.chunks!.set(this.held.subarray(this.at, end), this.chunked);
    this.chunked = wanted;
  }
  private line(): string | null {
    const { held } = this;
    for (let i = this.at; i + 1 < this.size && i - this.at <= MOST_CHUNK_LINE; i++) {
      if (held[i] !== CR || held[i + 1] !== LF) continue;
      const text = latin1Text(held.subarray(this.at, i));
      this.at = i + 2;
      return text;
    }
    return null;
  }
}

export class RequestReader extends HttpReader<HttpRequest> {
  protected readonly firstLine = REQUEST;
  protected readonly needsLength = false;
  protected isBare(): boolean {
    return false;
  }
  protected message(
    [method, target]: readonly [string, string, string],
    fields: Fields,
    body: Uint8Array,
  ): HttpRequest {
    return { method, target, fields, body };
  }
}
export class ResponseReader extends HttpReader<HttpResponse> {
  protected readonly firstLine = RESPONSE;
  protected readonly needsLength = true;
  protected isBare([, status]: readonly [string, string, string]): boolean {
    return status.startsWith("1") || status === "204" || status === "304";
  }
  protected message(
    [, status, reason]: readonly [string, string, string],
    fields: Fields,
    body: Uint8Array,
  ): HttpResponse {
    return { status: Number(status), reason, fields, body };
  }
}
