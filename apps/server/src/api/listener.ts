import type { IncomingMessage, ServerResponse } from "node:http";
import { once } from "node:events";
import { diskWords } from "../files/recordings-folder.ts";
import { sameOrigin } from "../sockets/doors.ts";
import type { AuditLog } from "../people/audit-log.ts";
import { findRoute, json, readBody, refusal, type Answer, type Call, type Entered, type Handlers } from "./calls.ts";
import type { ApiRoute, ApiRouteId } from "@twincell/protocol";
import { LEASE_HEADER } from "@twincell/protocol";

export interface ApiOptions {
  readonly handlers: Handlers;
  readonly headers: Readonly<Record<string, string>>;
  readonly enter: (request: IncomingMessage, route: ApiRoute, subject: string | undefined) => Entered;
  readonly counts: Map<number, number>;
  /** Where changes of documents are written down; acts at robots are by their host. */
  readonly audit: AuditLog | null;
  /** Whether the server closes: nothing is commanded or kept any more. */
  readonly closing: () => boolean;
  /** Told of each answer, by the name of its route: where requests are traced. */
  readonly observe?: (route: string, method: string, status: number, began_ms: number) => void;
}
/** What the disk of the data folder did not take, in words; null for anything else. */
function diskRefusal(problem: unknown): ReturnType<typeof refusal> | null {
  const why = diskWords(problem);
  return why === null
    ? null
    : refusal("server.disk", `Nothing was kept: ${why}.`, "Make room in the data folder of the server, and ask again.");
}
const isLoopback = (address = ""): boolean => address === "::1" || /^(::ffff:)?127\./.test(address);

/** Answers one request at an address of the API. */
export function apiListener({ handlers, headers, enter, counts, audit, closing, observe }: ApiOptions) {
  return async function answer(request: IncomingMessage, response: ServerResponse, path: string): Promise<void> {
    const gone = new Set<() => void>();
    const began_ms = Date.now();
    response.on("close", () => {
      if (!response.writableFinished) for (const listen of gone) listen();
    });
    const { answer: found, more } = await respond(request, path, gone);
    gone.clear();
    const status = found.kind === "json" ? (found.status ?? 200) : 200;
    counts.set(Math.floor(status / 100), (counts.get(Math.floor(status / 100)) ?? 0) + 1);
    const method = request.method ?? "GET";
    if (observe) {
      const route = findRoute(method, path);
      observe(route.kind === "found" ? route.id : "none", method, status, began_ms);
    }
    await write(response, found, { ...headers, "cache-control": "no-store", ...more }, request.method === "HEAD");
  };

  async function respond(
    request: IncomingMessage,
    path: string,
    gone: Set<() => void>,
  ): Promise<{ readonly answer: Answer; readonly more?: Record<string, string> }> {
    const found = findRoute(request.method ?? "GET", path);
    if (found.kind === "none")
      return {
        answer: json(refusal("api.none", `There is nothing at ${path}.`, "GET /api lists what there is."), 404),
      };
    if (found.kind === "method")
      return {
        answer: json(
          refusal("api.method", `${request.method} is not possible at ${path}.`, `Possible: ${found.allow}.`),
          405,
        ),
        more: { allow: found.allow },
      };
    // A page of another origin could ride on a cookie, or on this machine being loopback.
    if (!sameOrigin(request))
      return {
        answer: json(
          refusal(
            "api.origin",
            "Pages of other servers may not ask here.",
            "Ask from a page of this server, or from a program.",
          ),
          403,
        ),
      };
    const entered = enter(request, found.route, found.params["id"] ?? found.params["name"]);
    if (entered.kind === "out")
      return {
        answer: json(refusal("api.access", entered.sentence, entered.hint), entered.status),
        ...(entered.status === 401 ? { more: { "www-authenticate": "Bearer" } } : {}),
      };
    if (closing() && (found.route.access === "command" || found.route.access === "write"))
      return { answer: json(refusal("server.closing", "This server closes.", "Ask again when it is back."), 503) };
    let body: unknown;
    if (found.route.body) {
      const read = await readBody(request);
      if (read.kind === "fault")
        return { answer: json(refusal("api.body", read.sentence, "/api/openapi.json says what is asked for."), 400) };
      const parsed = found.route.body.safeParse(read.value);
      if (!parsed.success) {
        const [issue] = parsed.error.issues;
        const place = issue && issue.path.length > 0 ? ` at “${issue.path.join(".")}”` : "";
        return {
          answer: json(
            refusal(
              "api.body",
              `The body cannot be understood${place}: ${issue?.message ?? "it is another shape"}.`,
              "/api/openapi.json says what is asked for.",
            ),
            400,
          ),
        };
      }
      body = parsed.data;
    }
    const call: Call<never> = {
      params: found.params,
      body: body as never,
      lease: String(request.headers[LEASE_HEADER] ?? ""),
      who: entered.who,
      named: entered.named,
      cookies: request.headers.cookie,
      address: request.socket.remoteAddress,
      origin: `${"encrypted" in request.socket ? "https" : "http"}://${request.headers.host ?? ""}`,
      remote: !isLoopback(request.socket.remoteAddress),
      onGone(listen) {
        if (request.socket.destroyed) listen();
        else gone.add(listen);
      },
    };
    const handle = handlers[found.id as ApiRouteId] as (call: Call<never>) => Answer | Promise<Answer>;
    let answered: Answer;
    try {
      answered = await handle(call);
    } catch (problem) {
      const full = diskRefusal(problem);
      if (full === null) throw problem;
      answered = json(full, 507);
    }
    if (found.route.access === "write" || found.route.access === "people")
      audit?.write({
        who: entered.who,
        action: found.id,
        robot: "",
        detail: path,
        outcome: answered.kind === "json" && (answered.status ?? 200) >= 400 ? "refused" : "done",
      });
    return { answer: answered };
  }
}

async function write(
  response: ServerResponse,
  answer: Answer,
  headers: Record<string, string>,
  head: boolean,
): Promise<void> {
  if (response.destroyed) return;
  if (answer.kind !== "bytes") {
    const text = answer.kind === "json" ? JSON.stringify(answer.value) : answer.text;
    response.writeHead(answer.kind === "json" ? (answer.status ?? 200) : 200, {
      ...headers,
      ...(answer.kind === "json" ? answer.headers : {}),
      "content-type": answer.kind === "json" ? "application/json" : answer.type,
      "content-length": String(Buffer.byteLength(text)),
    });
    response.end(head ? undefined : text);
    return;
  }
  response.writeHead(200, {
    ...headers,
    "content-type": "application/octet-stream",
    "content-length": String(answer.length),
    "content-disposition": `attachment; filename="${answer.name.replace(/[^\w.-]/g, "_")}"`,
  });
  if (!head)
    for await (const part of answer.parts) {
      if (response.destroyed) return;
      if (!response.write(part)) await Promise.race([once(response, "drain"), once(response, "close")]);
    }
  response.end();
}
