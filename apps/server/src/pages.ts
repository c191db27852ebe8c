import { X509Certificate } from "node:crypto";
import type { IncomingMessage, RequestListener, ServerResponse } from "node:http";
import { askForCode, clientOf, type AccessCode } from "./access.ts";
import { isApiPath } from "./api/calls.ts";
import type { apiListener } from "./api/listener.ts";
import { AUTHORITY_PATH, TRUST_PATH, trustPage } from "./trust-page.ts";
import type { CellLinks } from "./people/links.ts";
import type { staticFiles } from "./static-files.ts";

/** Cross-origin isolation gives the studio precise clocks and shared memory; nothing is ever loaded from elsewhere. */
export const HEADERS: Readonly<Record<string, string>> = {
  "content-security-policy":
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval' blob:; worker-src 'self' blob:; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self' data: blob:; frame-ancestors 'none'; base-uri 'self'; form-action 'self'",
  "cross-origin-opener-policy": "same-origin",
  "cross-origin-embedder-policy": "require-corp",
  "x-content-type-options": "nosniff",
  "referrer-policy": "no-referrer",
  // The camera of a phone or of this computer may be asked for; nothing here listens.
  "permissions-policy": "camera=(self), microphone=()",
};

/**
 * The bindings of MuJoCo and of the CAD kernel write their own invokers when they start. Only the workers that hold
 * them may do so, which have no page to change and nobody but this origin to talk to; everything else stays without.
 */
const WRITES_CODE = /^\/assets\/(physics|step)\.worker-[\w-]+\.js$/;
const WRITER_HEADERS: Readonly<Record<string, string>> = {
  ...HEADERS,
  "content-security-policy":
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval' 'unsafe-eval'; connect-src 'self'",
};

/** The same page, without the code in its address. Two slashes in front would name another machine. */
function withoutCode(url: URL): string {
  const kept = new URLSearchParams(url.searchParams);
  kept.delete("code");
  return `/${url.pathname.replace(/^\/+/, "")}${kept.size > 0 ? `?${kept.toString()}` : ""}`;
}

/** Names that a browser may have used for this machine. */
export const LOOPBACK: readonly string[] = ["localhost", "127.0.0.1", "[::1]"];
export const isServed = (hosts: ReadonlySet<string>, request: IncomingMessage): boolean =>
  hosts.has((request.headers.host ?? "").replace(/:\d+$/, ""));

/**
 * Hands out files of the built studio to whoever asked for one of these hosts and knows the code, where there is one.
 *
 * @param authority that devices may trust, as PEM; it has a page of its own
 */
export function studioListener(
  files: ReturnType<typeof staticFiles>,
  hosts: ReadonlySet<string>,
  access: AccessCode | null,
  api: ReturnType<typeof apiListener> | null,
  say: (sentence: string) => void,
  links: CellLinks | null = null,
  authority?: string,
): RequestListener {
  const fingerprint = authority === undefined ? "" : new X509Certificate(authority).fingerprint256;
  return (request, response) => {
    answer(request, response).catch((problem: unknown) => {
      if (!response.headersSent) response.writeHead(500, { "content-type": "text/plain; charset=utf-8" });
      response.end("The server could not answer this request.\n");
      say(problem instanceof Error ? problem.message : String(problem));
    });
  };

  async function answer(request: IncomingMessage, response: ServerResponse): Promise<void> {
    const say = (status: number, text: string, headers: Record<string, string> = {}) => {
      response.writeHead(status, { ...HEADERS, "content-type": "text/plain; charset=utf-8", ...headers });
      response.end(request.method === "HEAD" ? undefined : text);
    };
    // A page elsewhere that points its own name at this machine must not be served.
    if (!isServed(hosts, request)) {
      say(421, "This address is not served here.\n");
      return;
    }
    let url: URL;
    let path: string;
    try {
      url = new URL(request.url ?? "/", "http://here");
      path = decodeURIComponent(url.pathname);
    } catch (problem) {
      say(400, `This address cannot be read: ${(problem as Error).message}.\n`);
      return;
    }
    if (api && isApiPath(path)) {
      await api(request, response, path);
      return;
    }
    if (request.method !== "GET" && request.method !== "HEAD") {
      say(405, "Only reading is possible here.\n", { allow: "GET, HEAD" });
      return;
    }
    const link = url.searchParams.get("link");
    if (links && link !== null) {
      const entered = links.enter(link, "encrypted" in request.socket);
      if (entered)
        say(303, "", { "set-cookie": entered.cookie, location: `/?watch=${encodeURIComponent(entered.cell)}` });
      else say(410, "This link has ended or was taken back.\n");
      return;
    }
    if (access && !links?.of(request.headers.cookie)) {
      const entry = access.enter(
        request.headers.cookie,
        url.searchParams.get("code"),
        clientOf(request.socket.remoteAddress),
      );
      if (entry.kind === "too-many-tries") {
        say(429, "Too many wrong codes. Wait a minute, then type it again.\n");
        return;
      }
      if (entry.kind === "ask") {
        say(401, askForCode(request.headers["accept-language"]), { "content-type": "text/html; charset=utf-8" });
        return;
      }
      if (entry.kind === "welcome-with-cookie") {
        say(303, "", { "set-cookie": entry.cookie, location: withoutCode(url) });
        return;
      }
    }
    if (authority !== undefined && path === AUTHORITY_PATH) {
      say(200, authority, { "content-type": "application/x-x509-ca-cert" });
      return;
    }
    if (authority !== undefined && (path === TRUST_PATH || `${path}/` === TRUST_PATH)) {
      const page = trustPage(request.headers["accept-language"] ?? "", fingerprint);
      say(200, page, { "content-type": "text/html; charset=utf-8" });
      return;
    }
    const found = await files(path, String(request.headers["accept-encoding"] ?? ""), request.headers["if-none-match"]);
    response.writeHead(found.status, {
      ...(WRITES_CODE.test(path) ? WRITER_HEADERS : HEADERS),
      ...found.headers,
      ...(found.status === 200 ? { "content-length": String(found.body.length) } : {}),
    });
    response.end(request.method === "HEAD" ? undefined : found.body);
  }
}
