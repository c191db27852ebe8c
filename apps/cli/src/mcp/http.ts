import { createServer, type IncomingMessage, type ServerResponse } from "node:http";
import type { AddressInfo } from "node:net";
import {
  createMcpHandler,
  hostHeaderValidationResponse,
  localhostAllowedHostnames,
  localhostAllowedOrigins,
  originValidationResponse,
} from "@modelcontextprotocol/server";
import { mayUse, tokenReader } from "@twincell/server";
import type { CellFolder } from "./cell-folder.ts";
import { mcpServer } from "./server.ts";

export const MCP_PATH = "/mcp";
const LONGEST_BODY = 8 << 20;

export interface McpHttpOptions {
  readonly folder: CellFolder;
  /** 0 takes any free one. */
  readonly port: number;
  /** Folder whose tokens let in; left out: everybody of this machine. */
  readonly data?: string | undefined;
  readonly say: (sentence: string) => void;
}
export interface McpHttp {
  readonly url: string;
  close(): Promise<void>;
}

/**
 * The same tools by streamable HTTP, on loopback alone: pages of other servers and names that point here from elsewhere
 * are refused. Rejects when the port is taken.
 */
export async function serveMcp({ folder, port, data, say }: McpHttpOptions): Promise<McpHttp> {
  const handler = createMcpHandler(() => mcpServer(folder));
  const known = tokenReader(data, () => Date.now(), say);
  const refusal = (request: Request): Response | null => {
    const elsewhere =
      hostHeaderValidationResponse(request, localhostAllowedHostnames()) ??
      originValidationResponse(request, localhostAllowedOrigins());
    if (elsewhere) return elsewhere;
    if (new URL(request.url).pathname !== MCP_PATH) return said(404, `There is nothing here; ask ${MCP_PATH}.`);
    if (data === undefined) return null;
    const answer = known(/^Bearer (.+)$/.exec(request.headers.get("authorization") ?? "")?.[1] ?? "");
    if (answer.kind !== "known") return said(401, "This asks for a token: twincell token add NAME --role programmer.");
    return mayUse(answer.role, "write") ? null : said(403, `${answer.name} may look, and not change cells.`);
  };
  const server = createServer((incoming, response) => {
    answer(incoming, response).catch((problem: unknown) => {
      say(problem instanceof Error ? problem.message : String(problem));
      if (!response.headersSent) response.writeHead(500);
      response.end();
    });
  });
  async function answer(incoming: IncomingMessage, response: ServerResponse): Promise<void> {
    const ending = new AbortController();
    response.once("close", () => {
      ending.abort();
    });
    const body = await bodyOf(incoming);
    if (body === null) {
      await write(response, said(413, `A body longer than ${LONGEST_BODY} bytes is not read.`));
      return;
    }
    const headers = new Headers();
    for (const [name, value] of Object.entries(incoming.headers))
      for (const each of [value ?? []].flat()) headers.append(name, each);
    const request = new Request(new URL(incoming.url ?? "/", `http://${incoming.headers.host ?? "localhost"}`), {
      method: incoming.method ?? "GET",
      headers,
      signal: ending.signal,
      ...(body.length === 0 ? {} : { body }),
    });
    await write(response, refusal(request) ?? (await handler.fetch(request)));
  }
  await new Promise<void>((resolve, reject) => {
    server.once("error", reject);
    server.listen(port, "127.0.0.1", resolve);
  });
  return {
    url: `http://127.0.0.1:${(server.address() as AddressInfo).port}${MCP_PATH}`,
    close: () =>
      new Promise<void>(resolve => {
        server.closeAllConnections();
        server.close(() => {
          resolve();
        });
      }),
  };
}

const said = (status: number, sentence: string): Response =>
  new Response(JSON.stringify({ sentence }), {
    status,
    headers: { "content-type": "application/json", ...(status === 401 ? { "www-authenticate": "Bearer" } : {}) },
  });

/** Null for one that is too long. */
async function bodyOf(incoming: IncomingMessage): Promise<Buffer<ArrayBuffer> | null> {
  const parts: Buffer[] = [];
  let length = 0;
  for await (const part of incoming as AsyncIterable<Buffer>) {
    length += part.length;
    if (length > LONGEST_BODY) return null;
    parts.push(part);
  }
  return Buffer.concat(parts);
}

async function write(response: ServerResponse, answer: Response): Promise<void> {
  response.writeHead(answer.status, Object.fromEntries(answer.headers));
  if (answer.body)
    for await (const part of answer.body as unknown as AsyncIterable<Uint8Array>) {
      if (response.destroyed) return;
      response.write(part);
    }
  response.end();
}
