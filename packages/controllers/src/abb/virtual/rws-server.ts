import type { Scheduler } from "@twincell/core";
import {
  challengeText,
  fieldOf,
  hasWord,
  isAuthorized,
  md5Hex,
  RequestReader,
  responseBytes,
  type Challenge,
  type Fields,
  type HttpRequest,
} from "../../http/index.ts";
import type { ByteStream, Listening, Network } from "../../transport/index.ts";
import { RWS_CODE, RWS_LOGIN, RWS_REALM, SESSION_COOKIES, errorJson, statesHtml, statesJson } from "../codec/index.ts";
import { createResources, type Answer, type ResourceOptions } from "./rws-resources.ts";
import { Sessions, type Session } from "./sessions.ts";

export interface RwsServerOptions extends ResourceOptions {
  readonly network: Network;
  readonly host: string;
  readonly port: number;
  readonly scheduler: Scheduler;
  readonly log: (sentence: string) => void;
  readonly isOff: () => boolean;
}
export interface RwsServer {
  readonly listening: Listening;
  grantRemote(granted: boolean): void /** Off and on again: everybody has to log in anew. */;
  boot(): void;
  close(): void;
  /** Those that are connected are cut and nobody is let in, while it is true. */
  setRefusing(refusing: boolean): void;
}

const MOST_CLIENTS = 100;
const MAX_WAITING = 8_000_000;
const MOST_LOGGED = 100;
/** A connection carries so many requests; the client opens another one then. */
const MOST_REQUESTS = 400;
const REASONS: Readonly<Record<number, string>> = {
  200: "OK",
  201: "Created",
  202: "Accepted",
  204: "No Content",
  400: "Bad Request",
  401: "Unauthorized",
  403: "Forbidden",
  404: "Not Found",
  405: "Method Not Allowed",
  503: "Service Unavailable",
};

/** Robot Web Services of a virtual controller. Whoever sends what is no request is logged once and cut off. */
export function serveRws(options: RwsServerOptions): Promise<RwsServer> {
  return new RwsServing(options).open();
}

class RwsServing {
  readonly options: RwsServerOptions;
  readonly scheduler: Scheduler;
  readonly host: string;
  readonly isOff: () => boolean;
  readonly streams = new Set<ByteStream>();
  readonly logged = new Set<string>();
  readonly sessions: Sessions;
  readonly resources: (session: Session, request: HttpRequest) => Answer;
  readonly challenge: Challenge;
  refusing = false;
  listening!: Listening;

  constructor(options: RwsServerOptions) {
    this.options = options;
    this.scheduler = this.options.scheduler;
    this.host = this.options.host;
    this.isOff = this.options.isOff;
    this.sessions = new Sessions(() => this.scheduler.now_s());
    this.resources = createResources(this.options, this.sessions);
    this.challenge = {
      realm: RWS_REALM,
      nonce: md5Hex(`${this.host}:${this.options.port}:${this.scheduler.now_s()}`),
      opaque: "8798",
      counted: true,
    };
  }

  async open(): Promise<RwsServer> {
    this.listening = await this.options.network.listen({ host: this.host, port: this.options.port }, this.accept);
    return rwsServerOf(this);
  }

  readonly accept = (stream: ByteStream): void => {
    if (this.streams.size >= MOST_CLIENTS || this.refusing || this.isOff()) {
      stream.close();
      return;
    }
    this.streams.add(stream);
    const reader = new RequestReader();
    let asked = 0;
    const end = (): void => {
      this.streams.delete(stream);
      stream.close();
    };
    stream.onEnd(() => {
      this.streams.delete(stream);
    });
    stream.onBytes(lent => {
      if (!this.streams.has(stream)) return;
      const why = reader.push(lent, request => {
        const last = ++asked >= MOST_REQUESTS || hasWord(fieldOf(request, "connection"), "close");
        this.answer(stream, request, last);
        if (stream.waiting > MAX_WAITING) {
          this.note(stream, "Answers are not read.");
          end();
        }
        if (last) end();
        return this.streams.has(stream);
      });
      if (why === null) return;
      this.note(stream, why);
      stream.send(responseBytes({ status: 400, reason: REASONS[400]!, fields: [["connection", "close"]] }));
      end();
    });
  };

  note(stream: ByteStream, sentence: string): void {
    const line = `${stream.peer.host}: ${sentence} The connection is reset.`;
    if (this.logged.size < MOST_LOGGED && !this.logged.has(line)) {
      this.logged.add(line);
      this.options.log(line);
    }
  }

  answer(stream: ByteStream, request: HttpRequest, last: boolean): void {
    const send = (status: number, fields: Fields, body?: Uint8Array): void => {
      stream.send(
        responseBytes({
          status,
          reason: REASONS[status] ?? "",
          fields: [
            ["server", "Twincell virtual controller"],
            ...fields,
            ...(last ? ([["connection", "close"]] as const) : []),
          ],
          ...(body ? { body } : {}),
        }),
      );
    };
    let session = this.sessions.find(fieldOf(request, "cookie"));
    const fields: (readonly [string, string])[] = [];
    if (!session) {
      if (!isAuthorized(fieldOf(request, "authorization"), RWS_LOGIN, this.challenge, request.method, request.target)) {
        send(401, [["www-authenticate", challengeText(this.challenge)]]);
        return;
      }
      session = this.sessions.begin();
      if (!session) {
        send(503, []);
        return;
      }
      for (const name of SESSION_COOKIES) fields.push(["set-cookie", `${name}=${session.id}; path=/; httponly`]);
    }
    const { status, body, type } = this.written(this.resources(session, request), request.target);
    send(status, [...fields, ...(status === 204 ? [] : ([["content-type", type]] as const))], body);
  }

  written(
    given: Answer,
    target: string,
  ): { readonly status: number; readonly body?: Uint8Array; readonly type: string } {
    const isJson = /[?&]json=1(?:&|$)/.test(target);
    if (given.file) return { status: given.status, body: given.file, type: "application/octet-stream" };
    if (given.refusal !== undefined)
      return {
        status: given.status,
        body: errorJson(given.code ?? RWS_CODE.refused, given.refusal),
        type: "application/json",
      };
    if (!given.states) return { status: given.status, type: "application/xhtml+xml;v=1.0" };
    return isJson
      ? {
          status: given.status,
          body: statesJson(given.states, `http://${this.host}${target.split("?")[0]!}`),
          type: "application/json",
        }
      : { status: given.status, body: statesHtml(given.states), type: "application/xhtml+xml;v=1.0" };
  }

  cut(): void {
    for (const stream of [...this.streams]) {
      this.streams.delete(stream);
      stream.close();
    }
  }
}

function rwsServerOf(own: RwsServing): RwsServer {
  return {
    listening: own.listening,
    boot() {
      own.cut();
      own.sessions.clear();
    },
    setRefusing(is) {
      own.refusing = is;
      if (is) own.cut();
    },
    grantRemote(granted) {
      own.sessions.answerRemote(granted);
    },
    close() {
      if (own.listening.kind === "listening") own.listening.close();
      own.cut();
    },
  };
}
