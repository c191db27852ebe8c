import { request as httpRequest, type IncomingMessage } from "node:http";
import { connect } from "node:net";
import { seededRandom } from "@twincell/core";
import { API_ROUTES, SOCKETS, type ApiRoute } from "@twincell/protocol";
import { WebSocket } from "ws";

/** What came of a flood of requests by somebody who may do nothing. */
export interface HostileReport {
  readonly requests: number;
  /** By class of status, "refused" for connections that were ended without one. */
  readonly answers: Readonly<Record<string, number>>;
  /** Requests that were answered as done although nobody was let in; with what was sent. */
  readonly letIn: readonly string[];
  /** Answers of 500 and more. */
  readonly faults: readonly string[];
}
/** A read-only link, which lets in to look at one cell: everything else that its holder asks for is hostile too. */
export interface HeldLink {
  /** As the cookie of a page. */
  readonly cookie: string;
  readonly cell: string;
}
const TOKENS = [
  "",
  "twincell_",
  `twincell_${"A".repeat(43)}`,
  "000000",
  "Bearer",
  "\u00ff".repeat(20),
  "A".repeat(4000),
];
const NAMES = [
  "arm",
  "line",
  "..",
  "%2e%2e%2f",
  "a".repeat(300),
  "%00",
  "__proto__",
  "constructor",
  "arm%0d%0aX: 1",
  "☃",
];
const BODIES: readonly string[] = [
  "",
  "{}",
  "null",
  "[]",
  "{",
  '{"__proto__":{"role":"admin"}}',
  '{"q_rad":[1e999,0,0,0,0,0]}',
  '{"role":"admin"}',
  '{"name":"Ada","password":"x"}',
  '{"link":"x","name":"Eve","password":"correct horse"}',
  '{"id":"x","response":{}}',
  `${"[".repeat(5000)}`,
  '{"id":"forged-00001","token":"twincell_x","robot":"arm","act":{"type":"move","q_rad":[0]}}',
  '{"emergency":true}',
];
const RAW: readonly string[] = [
  "GET / HTTP/1.1\r\n\r\n",
  "GET /api/v1/robots HTTP/1.1\r\nHost: elsewhere.example\r\n\r\n",
  "POST /api/v1/stop HTTP/1.1\r\nHost: localhost\r\nOrigin: http://elsewhere.example\r\nContent-Length: 2\r\n\r\n{}",
  "POST /api/v1/stop HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\nContent-Length: 4\r\n\r\nzz\r\n",
  "\u0000\u0001\u0002\u0003",
  `GET /${"a".repeat(20_000)} HTTP/1.1\r\nHost: localhost\r\n\r\n`,
  "GET //localhost/../../../../etc/passwd HTTP/1.1\r\nHost: localhost\r\n\r\n",
];
const WORDS: readonly string[] = [
  '{"type":"move","station":"arm","q_rad":[0,0,0,0,0,0],"id":0}',
  '{"type":"take","station":"arm","id":1}',
  '{"type":"join","epoch":null,"vector":""}',
  '{"type":"update","number":1,"update":"AAA="}',
  '{"type":"update","number":2,"update":"AQGZAAAEAQRjZWxsBG5hbWUBdwRldmlsAA=="}',
  '{"type":"stop","emergency":true}',
  "not JSON",
];

/**
 * Sends requests of every route and socket with forged, broken and oversized parts, as somebody without an account. A
 * seed gives the same flood.
 */
export async function hostileFlood(
  url: string,
  count: number,
  seed: number,
  link: HeldLink | null = null,
  atOnce = 16,
): Promise<HostileReport> {
  const random = seededRandom(seed);
  const pick = <T>(from: readonly T[]): T => from[Math.floor(random() * from.length)]!;
  const { hostname, port } = new URL(url);
  const routes = (Object.values(API_ROUTES) as readonly ApiRoute[]).filter(({ access }) => access !== "open");
  const answers: Record<string, number> = {};
  const letIn: string[] = [];
  const faults: string[] = [];
  const note = (sent: string, status: number | null): void => {
    const kind = status === null ? "refused" : `${Math.floor(status / 100)}xx`;
    answers[kind] = (answers[kind] ?? 0) + 1;
    if (status === null) return;
    if (status >= 200 && status < 300) letIn.push(`${sent}: ${status}`);
    if (status >= 500) faults.push(`${sent}: ${status}`);
  };
  const http = (): Promise<void> => {
    const route = pick(routes);
    const holds = link !== null && random() < 0.3;
    // Whoever has a link mostly asks for what stands beside its cell.
    const names = holds ? [link.cell] : NAMES;
    const path = route.path.replace(/\{\w+\}/g, () => pick(names));
    const token = pick(TOKENS);
    const body = pick(BODIES);
    const looks = holds && route.method === "get" && path === `/api/v1/cells/${link.cell}`;
    const sent = `${route.method} ${path} ${body.slice(0, 40)}`;
    return new Promise(resolve => {
      const end = (status: number | null): void => {
        if (looks && status === 200) answers["looked"] = (answers["looked"] ?? 0) + 1;
        else note(sent, status);
        resolve();
      };
      try {
        const request = httpRequest({
          host: hostname,
          port,
          method: route.method.toUpperCase(),
          path: encodeURI(path).replaceAll("%25", "%"),
          headers: {
            "content-type": pick(["application/json", "text/plain", "application/json; charset=utf-16"]),
            ...(token === "" || holds ? {} : { authorization: `Bearer ${encodeURI(token)}` }),
            ...(holds ? { cookie: link.cookie } : {}),
            ...(!holds && random() < 0.3
              ? {
                  cookie: `twincell_session=${encodeURI(token)}; twincell_access=${encodeURI(token)}; twincell_link=${encodeURI(token)}`,
                }
              : {}),
            ...(random() < 0.2 ? { "twincell-lease": "A".repeat(32) } : {}),
            ...(random() < 0.1 ? { origin: "http://elsewhere.example" } : {}),
          },
        });
        request.on("response", (response: IncomingMessage) => {
          response.resume();
          response.on("end", () => {
            end(response.statusCode ?? null);
          });
          response.on("error", () => {
            end(null);
          });
        });
        request.on("error", () => {
          end(null);
        });
        request.end(body);
      } catch {
        // What cannot even be sent is no request.
        end(null);
      }
    });
  };
  const raw = (): Promise<void> => {
    const sent = pick(RAW);
    return new Promise(resolve => {
      let heard = "";
      const socket = connect({ host: hostname, port: Number(port) });
      socket.setTimeout(500, () => socket.destroy());
      socket.on("error", () => undefined);
      socket.on("data", part => {
        heard += part.toString("latin1");
        socket.destroy();
      });
      socket.on("close", () => {
        const status = /^HTTP\/1\.1 (\d+)/.exec(heard)?.[1];
        note(`raw ${sent.slice(0, 40)}`, status === undefined ? null : Number(status));
        resolve();
      });
      socket.end(sent, "latin1");
    });
  };
  const socket = (): Promise<void> => {
    const editing = `${SOCKETS.editing}?cell=${pick(["line", "line", "arm", ".."])}`;
    const path = pick([SOCKETS.commands, SOCKETS.stream, editing, "/camera", "/nothing"]);
    const holds = link !== null && random() < 0.3;
    const looks = holds && path === `${SOCKETS.editing}?cell=${link.cell}`;
    const token = pick(TOKENS.filter(each => /^[\w]*$/.test(each)));
    return new Promise(resolve => {
      const client = new WebSocket(`ws://${hostname}:${port}${path}`, {
        headers: holds ? { cookie: link.cookie } : token === "" ? {} : { authorization: `Bearer ${token}` },
        ...(random() < 0.2 ? { origin: "http://elsewhere.example" } : {}),
      });
      client.on("open", () => {
        if (looks) answers["looked"] = (answers["looked"] ?? 0) + 1;
        else letIn.push(`socket ${path} ${token}`);
        for (const word of WORDS) client.send(word);
        client.close();
      });
      client.on("unexpected-response", (_request, response) => {
        note(`socket ${path}`, response.statusCode ?? null);
        client.terminate();
        resolve();
      });
      client.on("error", () => {
        resolve();
      });
      client.on("close", () => {
        resolve();
      });
    });
  };
  let sent = 0;
  const work = async (): Promise<void> => {
    while (sent < count) {
      sent++;
      const kind = random();
      await (kind < 0.9 ? http() : kind < 0.95 ? raw() : socket());
    }
  };
  await Promise.all(Array.from({ length: atOnce }, work));
  return { requests: sent, answers, letIn, faults };
}
