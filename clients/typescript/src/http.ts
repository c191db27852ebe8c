import { ROUTES, type Answer, type Body, type Outcome, type RouteId } from "./api.ts";

/** What the server refused or stopped: a code for programs, a sentence, and the way out. */
export class TwincellError extends Error {
  readonly code: string;
  readonly hint: string;
  /** HTTP status; 0 when no server answered. */
  readonly status: number;
  constructor(code: string, sentence: string, hint: string, status: number) {
    super(sentence);
    this.name = new.target.name;
    this.code = code;
    this.hint = hint;
    this.status = status;
  }
}
/** It was not done. */
export class Refused extends TwincellError {}
/** It was begun and did not come to its end. */
export class Stopped extends TwincellError {}

export interface ClientOptions {
  /** Of `twincell token add`, or the access code of `serve --lan`. */
  readonly token?: string;
  /** Another `fetch`, for tests and for certificates of your own. */
  readonly fetch?: typeof fetch;
}
export interface CallOptions {
  /** Parts of the path, such as `{ id: "arm" }`. */
  readonly params?: Readonly<Record<string, string>>;
  readonly lease?: string;
  /** Ends the request; of a motion it stops the robot. */
  readonly signal?: AbortSignal | undefined;
}
interface Response {
  readonly status: number;
  readonly bytes: Uint8Array;
}

/** One server by HTTP. */
export class Connection {
  readonly url: URL;
  readonly token: string | undefined;
  private readonly otherFetch: typeof fetch | undefined;
  constructor(url: string | URL, { token, fetch: other }: ClientOptions = {}) {
    this.url = new URL(url);
    this.token = token;
    this.otherFetch = other;
  }

  headers(): Record<string, string> {
    return this.token === undefined ? {} : { authorization: `Bearer ${this.token}` };
  }

  /** Asks one route of the API; throws `Refused` or `Stopped` with the reason. */
  async call<Id extends RouteId>(id: Id, body?: Body<Id>, options: CallOptions = {}): Promise<Answer<Id>> {
    const [method, path] = ROUTES[id];
    const filled = path.replace(/\{(\w+)\}/g, (_, name: string) => encodeURIComponent(options.params?.[name] ?? ""));
    const headers = {
      ...this.headers(),
      ...(options.lease === undefined ? {} : { "twincell-lease": options.lease }),
      ...(body === undefined ? {} : { "content-type": "application/json" }),
    };
    const text = body === undefined ? undefined : JSON.stringify(body);
    const address = new URL(filled, this.url);
    let found: Response;
    try {
      found = await (!this.otherFetch && isNode
        ? byNode(address, method, headers, text, options.signal)
        : byFetch(this.otherFetch ?? fetch, address, method, headers, text, options.signal));
    } catch (problem) {
      if (options.signal?.aborted) throw problem;
      const why = problem instanceof Error ? problem.message : String(problem);
      throw new Refused("client.silent", `${this.url.host} does not answer: ${why}.`, "Is the server started?", 0);
    }
    return answered<Answer<Id>>(found, id);
  }
}

/** Routes whose answer is what the text or the bytes say. */
const TEXTS: ReadonlySet<RouteId> = new Set(["apiPage", "healthz", "metrics"]);
const BYTES: ReadonlySet<RouteId> = new Set(["getRecording"]);

function answered<T>({ status, bytes }: Response, id: RouteId): T {
  if (status < 300 && BYTES.has(id)) return bytes as T;
  const text = new TextDecoder().decode(bytes);
  if (status < 300 && TEXTS.has(id)) return text as T;
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    throw new Refused(
      "client.no-api",
      `What answers there is no Twincell server (HTTP ${status}).`,
      "Check the address.",
      status,
    );
  }
  if (status < 300) return value as T;
  const outcome = value as Exclude<Outcome, { readonly kind: "done" }>;
  const { code = "client.unknown", sentence = `HTTP ${status}`, hint = "" } = outcome.why ?? {};
  throw outcome.kind === "stopped"
    ? new Stopped(code, sentence, hint, status)
    : new Refused(code, sentence, hint, status);
}

async function byFetch(
  ask: typeof fetch,
  url: URL,
  method: string,
  headers: Record<string, string>,
  body: string | undefined,
  signal: AbortSignal | undefined,
): Promise<Response> {
  const answer = await ask(url, { method, headers, body: body ?? null, signal: signal ?? null });
  return { status: answer.status, bytes: new Uint8Array(await answer.arrayBuffer()) };
}

const isNode = typeof globalThis === "object" && "process" in globalThis && !("window" in globalThis);
/** `fetch` of Node gives up a motion that lasts longer than five minutes, and its end would stop the robot. */
async function byNode(
  url: URL,
  method: string,
  headers: Record<string, string>,
  body: string | undefined,
  signal: AbortSignal | undefined,
): Promise<Response> {
  interface Incoming extends AsyncIterable<Uint8Array> {
    readonly statusCode?: number;
  }
  interface Outgoing {
    once(event: "error", listen: (problem: Error) => void): Outgoing;
    once(event: "response", listen: (response: Incoming) => void): Outgoing;
    end(text?: string): void;
  }
  // The name is put together so that bundlers for browsers do not look for it.
  const module = `node:${url.protocol === "https:" ? "https" : "http"}`;
  const { request } = (await import(module)) as {
    request(url: URL, options: { method: string; headers: object; signal: AbortSignal | undefined }): Outgoing;
  };
  const response = await new Promise<Incoming>((resolve, reject) => {
    const length = body === undefined ? {} : { "content-length": new TextEncoder().encode(body).length };
    const asked = request(url, { method, headers: { ...headers, ...length }, signal });
    asked.once("error", reject);
    asked.once("response", resolve);
    asked.end(body);
  });
  const parts: Uint8Array[] = [];
  for await (const part of response) parts.push(part);
  const bytes = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return { status: response.statusCode ?? 0, bytes };
}
