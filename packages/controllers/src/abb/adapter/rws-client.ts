import type { Scheduler } from "@twincell/core";
import {
  authorization,
  fieldOf,
  formText,
  hasWord,
  latin1Bytes,
  latin1Text,
  md5Hex,
  readChallenge,
  requestBytes,
  ResponseReader,
  type Challenge,
  type HttpResponse,
  type Login,
} from "../../http/index.ts";
import type { Address, ByteStream, Network } from "../../transport/index.ts";
import { readRws, type RwsState } from "../codec/index.ts";

/** How a request ended. `lost`: no answer came, and the line is gone. */
export type RwsReply =
  | { readonly kind: "answer"; readonly status: number; readonly states: readonly RwsState[] }
  | { readonly kind: "refused"; readonly status: number; readonly sentence: string }
  | { readonly kind: "lost"; readonly sentence: string };

/** What several connections to one controller share: who is logged in. */
export class RwsSession {
  readonly login: Login;
  readonly cookies = new Map<string, string>();
  challenge: Challenge | null = null;
  private times = 0;
  constructor(login: Login) {
    this.login = login;
  }
  authorization(method: string, target: string): string | null {
    return (
      this.challenge &&
      authorization(
        this.login,
        this.challenge,
        method,
        target,
        ++this.times,
        md5Hex(`${this.challenge.nonce} ${this.times}`),
      )
    );
  }
  challenged(by: Challenge): void {
    this.challenge = by;
    this.times = 0;
  }
}
export interface RwsClientOptions {
  readonly network: Network;
  readonly to: Address;
  readonly scheduler: Scheduler;
  readonly session: RwsSession;
  /** Told once, when the line is gone and nobody asked for it. */
  readonly lost: (sentence: string) => void;
  readonly roundTrip: (seconds: number) => void;
}
interface Asked {
  readonly method: string;
  readonly target: string;
  readonly body: Uint8Array | undefined;
  readonly isForm: boolean;
  readonly answer: (reply: RwsReply) => void;
  since_s: number;
  tries: number /** Of the challenge that it answered when it was sent. */;
  nonce: string;
}

/** An answer that does not come within this time never comes [s]; that often it is looked. */
const PATIENCE_S = 2;
const LOOK_S = 0.1;
/** A login and a connection that ended between two requests may each cost one more try. */
const MOST_TRIES = 3;

/**
 * One connection to Robot Web Services: a request at a time, in order; opened again when the controller has ended it
 * between two of them.
 */
export class RwsClient {
  private readonly options: RwsClientOptions;
  private readonly stopLooking: () => void;
  private stream: ByteStream | null = null;
  private reader = new ResponseReader();
  private connecting = false;
  private isClosed = false;
  private readonly asked: Asked[] = [];
  private isSent = false;

  constructor(options: RwsClientOptions) {
    this.options = options;
    this.stopLooking = options.scheduler.every(LOOK_S, () => {
      const [first] = this.asked;
      if (first && options.scheduler.now_s() - first.since_s > PATIENCE_S)
        this.lose(`A request was not answered within ${PATIENCE_S} s.`);
    });
  }

  get isBusy(): boolean {
    return this.asked.length > 0;
  }
  get(target: string): Promise<RwsReply> {
    return this.ask("GET", withJson(target));
  }
  post(target: string, fields: Readonly<Record<string, string>> = {}): Promise<RwsReply> {
    return this.ask("POST", withJson(target), latin1Bytes(formText(fields)), true);
  }
  put(target: string, body: Uint8Array): Promise<RwsReply> {
    return this.ask("PUT", target, body);
  }

  close(): void {
    if (this.isClosed) return;
    this.isClosed = true;
    this.stopLooking();
    this.stream?.close();
    for (const { answer } of this.asked.splice(0))
      answer({ kind: "lost", sentence: "The connection was closed here." });
  }

  private ask(method: string, target: string, body?: Uint8Array, isForm = false): Promise<RwsReply> {
    if (this.isClosed) return Promise.resolve({ kind: "lost", sentence: "The connection was closed here." });
    return new Promise(answer => {
      this.asked.push({
        method,
        target,
        body,
        isForm,
        answer,
        since_s: this.options.scheduler.now_s(),
        tries: 0,
        nonce: "",
      });
      this.send();
    });
  }
  private lose(sentence: string): void {
    if (this.isClosed) return;
    this.close();
    this.options.lost(sentence);
  }

  private send(): void {
    const [first] = this.asked;
    const {
      stream,
      options: { session, to, scheduler },
    } = this;
    if (!first || this.isSent || this.isClosed) return;
    if (!stream) {
      void this.connect();
      return;
    }
    if (++first.tries > MOST_TRIES) {
      this.lose("The controller ends every connection before it answers.");
      return;
    }
    const authorized = session.authorization(first.method, first.target);
    const cookies = [...session.cookies].map(([name, value]) => `${name}=${value}`).join("; ");
    this.isSent = true;
    first.nonce = session.challenge?.nonce ?? "";
    first.since_s = scheduler.now_s();
    stream.send(
      requestBytes({
        method: first.method,
        target: first.target,
        ...(first.body ? { body: first.body } : {}),
        fields: [
          ["host", `${to.host}:${to.port}`],
          ["accept", "application/json"],
          ...(authorized === null ? [] : ([["authorization", authorized]] as const)),
          ...(cookies === "" ? [] : ([["cookie", cookies]] as const)),
          ...(first.body
            ? ([
                ["content-type", first.isForm ? "application/x-www-form-urlencoded" : "application/octet-stream"],
              ] as const)
            : []),
        ],
      }),
    );
  }
  private async connect(): Promise<void> {
    if (this.connecting) return;
    this.connecting = true;
    const connected = await this.options.network.connect(this.options.to);
    this.connecting = false;
    if (connected.kind === "refused") {
      this.lose(connected.sentence);
      return;
    }
    const { stream } = connected;
    if (this.isClosed) {
      stream.close();
      return;
    }
    this.stream = stream;
    this.reader = new ResponseReader();
    this.isSent = false;
    stream.onEnd(({ sentence }) => {
      if (this.stream === stream) this.ended(sentence);
    });
    stream.onBytes(lent => {
      if (this.stream !== stream) return;
      const why = this.reader.push(lent, response => {
        this.take(response);
        return this.stream === stream;
      });
      if (why !== null) this.lose(`The controller's answer is no HTTP: ${why}`);
    });
    this.send();
  }
  /** The other side ended the connection: between two requests that is its right. */
  private ended(sentence: string): void {
    const wasInside = this.reader.isInside;
    const [first] = this.asked;
    this.stream = null;
    if (!first) return;
    // An order that may have been carried out is not said twice.
    if (wasInside || (this.isSent && first.method !== "GET")) {
      this.lose(sentence);
      return;
    }
    this.isSent = false;
    this.send();
  }

  private take(response: HttpResponse): void {
    const { session, scheduler, roundTrip } = this.options;
    const [first] = this.asked;
    if (response.status < 200) return;
    if (!first || !this.isSent) {
      this.lose("The controller answered what nobody asked.");
      return;
    }
    this.isSent = false;
    for (const [name, value] of response.fields) {
      const pair = name === "set-cookie" ? /^([^=;\s]{1,64})=([^;]{0,256})/.exec(value) : null;
      if (pair && session.cookies.size < 8) session.cookies.set(pair[1]!, pair[2]!);
    }
    const ends = hasWord(fieldOf(response, "connection"), "close");
    const { stream } = this;
    if (ends) {
      this.stream = null;
      stream?.close();
    }
    const challenge = response.status === 401 ? readChallenge(fieldOf(response, "www-authenticate")) : null;
    if (challenge && first.tries < MOST_TRIES && first.nonce !== challenge.nonce) {
      if (session.challenge?.nonce !== challenge.nonce) {
        session.challenged(challenge);
        session.cookies.clear();
      }
    } else {
      this.asked.shift();
      roundTrip(scheduler.now_s() - first.since_s);
      first.answer(replyOf(response));
    }
    this.send();
  }
}

const withJson = (target: string): string => `${target}${target.includes("?") ? "&" : "?"}json=1`;

function replyOf({ status, reason, body }: HttpResponse): RwsReply {
  const read = body.length > 0 ? readRws(latin1Text(body)) : null;
  if (status < 300) return { kind: "answer", status, states: read?.kind === "states" ? read.states : [] };
  if (status === 401)
    return { kind: "refused", status, sentence: "The controller does not take this user and password." };
  if (status === 503) return { kind: "refused", status, sentence: "The controller has as many sessions as it takes." };
  return {
    kind: "refused",
    status,
    sentence:
      read?.kind === "error" && read.msg !== ""
        ? `${read.msg.replace(/\.?$/, "")} (${read.code}).`
        : `It answered ${status} ${reason}.`,
  };
}
