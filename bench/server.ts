import { spawn, type ChildProcess } from "node:child_process";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { WebSocket } from "ws";
import { figure, type Figure } from "./figure.ts";

/** Of a server in a process of its own, with its clients on the same cores. */
const SECONDS = Number(process.env["TWINCELL_BENCH_S"] ?? 20);
const VIEWERS = 50;
const STARTS = 3;
const ROBOTS = 4;
const folder = (): string => mkdtempSync(join(tmpdir(), "twincell-bench-"));

interface Started {
  readonly url: string;
  readonly process: ChildProcess;
  end(): Promise<void>;
}
async function started(data: string): Promise<Started> {
  const studio = folder();
  writeFileSync(join(studio, "index.html"), "<title>studio</title>");
  const main = fileURLToPath(new URL("../apps/cli/src/main.ts", import.meta.url));
  const args = [main, "serve", "--port", "0", "--log", "json", "--studio", studio, "--data", data];
  const server = spawn(process.execPath, args, { stdio: ["ignore", "pipe", "inherit"] });
  let text = "";
  const url = await new Promise<string>((resolve, reject) => {
    server.stdout.on("data", (part: Buffer) => {
      text += part.toString();
      const found = /"event":"listening".*?"url":"([^"]+)"/.exec(text);
      if (found) resolve(found[1]!);
    });
    server.once("exit", code => {
      reject(new Error(`The server ended with ${code ?? "a signal"}.`));
    });
  });
  const gone = new Promise<void>(resolve => server.once("exit", () => resolve()));
  return {
    url,
    process: server,
    end() {
      server.kill("SIGTERM");
      return gone;
    },
  };
}
async function ask(url: string, path: string, body?: unknown, lease = ""): Promise<Record<string, unknown>> {
  const answer = await fetch(new URL(path, url), {
    method: body === undefined ? "GET" : "POST",
    headers: { "content-type": "application/json", "twincell-lease": lease },
    ...(body === undefined ? {} : { body: JSON.stringify(body) }),
  });
  return (await answer.json()) as Record<string, unknown>;
}

/** From the start of the process to all robots connected again [s]. */
async function restarts(): Promise<Figure> {
  const data = folder();
  const robots = Array.from({ length: ROBOTS }, (_, i) => ({ id: `r${i}`, driver: "ur", model: "ur10e" }));
  writeFileSync(join(data, "connections.json"), JSON.stringify({ format: "twincell.connections", version: 1, robots }));
  const taken_s: number[] = [];
  for (let i = 0; i < STARTS; i++) {
    const began = performance.now();
    const server = await started(data);
    for (;;) {
      const { ready, connected } = await ask(server.url, "/readyz");
      if (ready === true && connected === ROBOTS) break;
      await new Promise(setImmediate);
    }
    taken_s.push((performance.now() - began) / 1000);
    await server.end();
  }
  return figure("server/restart", "s", taken_s, `to ${ROBOTS} robots connected again; budget 2 s`);
}

/** How many samples the server itself never got, in the controller's own count. */
function neverCame(stream: URL): Promise<number> {
  const socket = new WebSocket(new URL("/api/v1/stream?robot=arm", stream), { perMessageDeflate: false });
  return new Promise(resolve => {
    socket.on("message", data => {
      const event = JSON.parse(String(data as Buffer)) as { readonly type: string; readonly missing?: number };
      if (event.type !== "link") return;
      socket.terminate();
      resolve(event.missing ?? 0);
    });
  });
}

/** Every sample of a robot at 500 Hz to 50 viewers, in at most 60 messages a second each. */
async function viewers(): Promise<readonly Figure[]> {
  const server = await started(folder());
  await ask(server.url, "/api/v1/robots", { id: "arm", driver: "ur", model: "ur10e" });
  const { lease } = await ask(server.url, "/api/v1/robots/arm/lease", {});
  await ask(server.url, "/api/v1/robots/arm/connect", {}, String(lease));
  const address = new URL("/api/v1/stream?robot=arm&messages_per_s=60", server.url.replace(/^http/, "ws"));
  const late_ms: number[] = [];
  const counts: number[] = [];
  const lost: number[] = [];
  const messages: number[] = [];
  const sockets = Array.from({ length: VIEWERS }, (_, i) => {
    const socket = new WebSocket(address, { perMessageDeflate: false });
    let last = -1;
    counts[i] = lost[i] = messages[i] = 0;
    socket.on("message", data => {
      const now_s = performance.now() / 1000;
      messages[i]!++;
      for (const event of JSON.parse(String(data as Buffer)) as { type: string; sequence: number; sent_s: number }[]) {
        if (event.type !== "sample") continue;
        counts[i]!++;
        if (last >= 0) lost[i]! += event.sequence - last - 1;
        last = event.sequence;
        late_ms.push(1000 * (now_s - event.sent_s));
      }
    });
    return socket;
  });
  await Promise.all(sockets.map(socket => new Promise(resolve => socket.once("open", resolve))));
  const before = await neverCame(address);
  await new Promise(resolve => setTimeout(resolve, 1000 * SECONDS));
  const after = await neverCame(address);
  for (const socket of sockets) socket.terminate();
  await server.end();
  // Two processes, two clocks: what is measured is how much later than the fastest sample each one came.
  const fastest = late_ms.reduce((least, value) => Math.min(least, value), Infinity);
  const sorted = Float64Array.from(late_ms, value => value - fastest).sort();
  const p99 = sorted[Math.floor(0.99 * sorted.length)] ?? NaN;
  const of = `${VIEWERS} viewers, ${SECONDS} s, clients on the same cores`;
  return [
    figure("server/viewers/late-p99", "ms", [p99], `beyond the fastest sample; ${of}; budget 50 ms`),
    figure(
      "server/viewers/lost",
      "samples",
      lost.map(count => Math.max(0, count - (after - before))),
      `that came to the server and not to the viewer, each viewer; ${of}`,
    ),
    figure(
      "server/viewers/not-sent",
      "samples",
      [after - before],
      "cycles in which the virtual controller, in the same process, had no processor: they were never sent",
    ),
    figure(
      "server/viewers/samples",
      "1/s",
      counts.map(count => count / SECONDS),
      of,
    ),
    figure(
      "server/viewers/messages",
      "1/s",
      messages.map(count => count / SECONDS),
      `${of}; budget 60`,
    ),
  ];
}

export const run = async (): Promise<readonly Figure[]> => [await restarts(), ...(await viewers())];
