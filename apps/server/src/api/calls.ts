import type { IncomingMessage } from "node:http";
import type { CommandOutcome } from "@twincell/core";
import { API_ROUTES, LONGEST_MESSAGE, type ApiRoute, type ApiBody, type ApiRouteId } from "@twincell/protocol";

/** One request that was understood. */
export interface Call<Id extends ApiRouteId> {
  readonly params: Readonly<Record<string, string>>;
  readonly body: ApiBody<Id>;
  /** The lease that the request names, or "". */
  readonly lease: string;
  readonly who: string;
  /** Whether a token says who it is. */
  readonly named: boolean;
  /** Whether it came from another machine. */
  readonly remote: boolean;
  readonly cookies: string | undefined;
  /** Address of whoever asks. */
  readonly address: string | undefined;
  /** As the browser names this server: scheme, host and port. */
  readonly origin: string;
  /** Told when whoever asked is gone before the answer. */
  onGone(listen: () => void): void;
}
export type Answer =
  | {
      readonly kind: "json";
      readonly value: unknown;
      readonly status?: number;
      readonly headers?: Readonly<Record<string, string>>;
    }
  | { readonly kind: "text"; readonly text: string; readonly type: string }
  | {
      readonly kind: "bytes";
      readonly parts: AsyncIterable<Uint8Array>;
      readonly length: number;
      readonly name: string;
    };

/** Who asks, or why they are turned away. */
export type Entered =
  | { readonly kind: "in"; readonly who: string; readonly named: boolean }
  | { readonly kind: "out"; readonly status: 401 | 403 | 429; readonly sentence: string; readonly hint: string };
/** What each route does. */
export type Handlers = { readonly [Id in ApiRouteId]: (call: Call<Id>) => Answer | Promise<Answer> };

export const json = (value: unknown, status = 200): Answer => ({ kind: "json", value, status });
export const refusal = (code: string, sentence: string, hint: string): CommandOutcome => ({
  kind: "refused",
  why: { code, sentence, hint },
});
/** 200 only when it was done: whoever looks at nothing but the status is not told that a stopped motion arrived. */
export const outcomeAnswer = (outcome: CommandOutcome): Answer => json(outcome, outcome.kind === "done" ? 200 : 409);

interface Matcher {
  readonly id: ApiRouteId;
  readonly route: ApiRoute;
  readonly pattern: RegExp;
}
const MATCHERS: readonly Matcher[] = (Object.entries(API_ROUTES) as [ApiRouteId, ApiRoute][]).map(([id, route]) => ({
  id,
  route,
  pattern: new RegExp(`^${route.path.replace(/[.]/g, "\\.").replace(/\{(\w+)\}/g, "(?<$1>[^/]+)")}$`),
}));

export type Found =
  | {
      readonly kind: "found";
      readonly id: ApiRouteId;
      readonly route: ApiRoute;
      readonly params: Readonly<Record<string, string>>;
    }
  | { readonly kind: "method"; readonly allow: string }
  | { readonly kind: "none" };

/** The route of an address; a method that it has not is told from an address that is none. */
export function findRoute(method: string, path: string): Found {
  const allow: string[] = [];
  for (const { id, route, pattern } of MATCHERS) {
    const match = pattern.exec(path);
    if (!match) continue;
    if (route.method === (method === "HEAD" ? "get" : method.toLowerCase()))
      return { kind: "found", id, route, params: { ...match.groups } };
    allow.push(route.method.toUpperCase());
  }
  return allow.length > 0 ? { kind: "method", allow: allow.join(", ") } : { kind: "none" };
}
/** Whether an address belongs to the API, found or not. */
export const isApiPath = (path: string): boolean => /^\/(api(\/.*)?|healthz|readyz|metrics)$/.test(path);

/** The JSON that came, `{}` when nothing did, or the sentence of what is wrong with it. */
export async function readBody(
  request: IncomingMessage,
): Promise<{ readonly kind: "read"; readonly value: unknown } | { readonly kind: "fault"; readonly sentence: string }> {
  const parts: Buffer[] = [];
  let length = 0;
  for await (const part of request as AsyncIterable<Buffer>) {
    length += part.length;
    if (length > LONGEST_MESSAGE)
      return { kind: "fault", sentence: `A body longer than ${LONGEST_MESSAGE} bytes is not read.` };
    parts.push(part);
  }
  if (length === 0) return { kind: "read", value: {} };
  if (!/^application\/json\b/.test(request.headers["content-type"] ?? ""))
    return { kind: "fault", sentence: "A body is JSON and says so: content-type: application/json." };
  try {
    return { kind: "read", value: JSON.parse(Buffer.concat(parts).toString("utf8")) as unknown };
  } catch (problem) {
    return { kind: "fault", sentence: `A body is JSON; this one is not: ${(problem as Error).message}.` };
  }
}
