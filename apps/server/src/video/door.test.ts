import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import {
  createClient,
  PICTURE_HEAD_BYTES,
  readPictureHead,
  writePictureHead,
  writeVideo,
  type VideoRequest,
} from "@twincell/protocol";
import { afterEach, expect, test } from "vitest";
import { WebSocket } from "ws";
import { serve, type Served } from "../index.ts";

const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");

let served: Served | undefined;
const lines: WebSocket[] = [];
afterEach(async () => {
  for (const line of lines.splice(0)) line.terminate();
  await served?.close();
  served = undefined;
});

async function line(path: string, headers: Record<string, string> = {}): Promise<WebSocket> {
  const socket = new WebSocket(new URL(path, served!.url.replace("http", "ws")), { headers, perMessageDeflate: false });
  lines.push(socket);
  socket.on("error", () => {
    /* A line that is turned away says so by closing. */
  });
  await new Promise<void>(resolve => {
    socket.once("open", resolve);
    socket.once("close", () => {
      resolve();
    });
  });
  return socket;
}
const say = (socket: WebSocket, ask: VideoRequest): void => {
  socket.send(writeVideo(ask));
};
function picture(sequence: number, bytes: number): Uint8Array {
  const all = new Uint8Array(PICTURE_HEAD_BYTES + bytes);
  writePictureHead(all, { camera: 0, sequence, captured_s: 1, sent_s: 1, relayed_s: 0, uncertain_s: 0 });
  all.set([0xff, 0xd8], PICTURE_HEAD_BYTES);
  return all;
}
async function until(so: () => boolean): Promise<void> {
  for (let i = 0; i < 500 && !so(); i++)
    await new Promise(resolve => {
      setTimeout(resolve, 10);
    });
  expect(so()).toBe(true);
}

test("X-40 pictures go through the server to who looks; one that takes none gets the newest when it looks up again", async () => {
  served = await serve({ studio, port: 0 });
  const camera = await line("/video");
  const quick = await line("/video");
  const slow = await line("/video");
  const seen: Record<"quick" | "slow", number[]> = { quick: [], slow: [] };
  for (const [name, socket] of [
    ["quick", quick],
    ["slow", slow],
  ] as const) {
    socket.on("message", (data, binary) => {
      if (!binary) return;
      const head = readPictureHead(data as Buffer)!;
      seen[name].push(head.sequence);
      if (name === "quick") say(socket, { type: "seen", camera: head.camera, sequence: head.sequence });
    });
  }
  say(camera, { type: "camera", name: "Phone", key: "a key of ours" });
  for (const socket of [quick, slow]) say(socket, { type: "viewer" });
  await until(() => camera.readyState === WebSocket.OPEN);
  let arrived = -1;
  let watchers = 0;
  camera.on("message", data => {
    const told = JSON.parse(String(data as Buffer)) as { sequence?: number; watchers: number };
    arrived = told.sequence ?? arrived;
    ({ watchers } = told);
  });
  say(quick, { type: "watch", camera: 1 });
  say(slow, { type: "watch", camera: 1 });
  await until(() => watchers === 2);
  for (let sequence = 0; sequence < 60; sequence++) {
    camera.send(picture(sequence, 100_000));
    await until(() => arrived === sequence);
  }
  await until(() => seen.quick.at(-1) === 59);
  expect(seen.slow).toEqual([0, 1]);
  say(slow, { type: "seen", camera: 1, sequence: 1 });
  await until(() => seen.slow.length === 3);
  expect(seen.slow).toEqual([0, 1, 59]);
}, 30_000);

test("X-40 X-41 a flood of pictures and rubbish leaves the line of the stations alone", async () => {
  served = await serve({ studio, port: 0 });
  const stations = await line("/stations");
  const trips_ms: number[] = [];
  const client = createClient(
    {
      send: text => {
        stations.send(text);
      },
      close: () => {
        stations.close();
      },
    },
    () => performance.now() / 1000,
    () => {
      /* Only the round trip counts. */
    },
  );
  stations.on("message", data => {
    client.hear(String(data as Buffer));
  });
  let seed = 7;
  let ended = 0;
  const random = (below: number): number => {
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    return Math.floor((seed / 2 ** 32) * below);
  };
  for (let round = 0; round < 40; round++) {
    const rubbish = await line("/video");
    const bytes = Uint8Array.from({ length: 1 + random(4000) }, () => random(256));
    rubbish.on("close", () => {
      ended++;
    });
    if (random(2) === 0) rubbish.send(bytes);
    else rubbish.send(Buffer.from(bytes).toString("latin1"));
    const flood = await line("/video");
    say(flood, { type: "camera", name: "Flood", key: "a key of ours" });
    for (let i = 0; i < 20; i++) flood.send(picture(i, 200_000));
    for (let i = 0; i < 5; i++) trips_ms.push(1000 * (await client.ping()));
  }
  await until(() => ended === 40);
  trips_ms.sort((a, b) => a - b);
  expect(trips_ms[Math.floor(trips_ms.length * 0.5)]).toBeLessThan(10);
  expect(stations.readyState).toBe(WebSocket.OPEN);
  const after = await line("/video");
  expect(after.readyState).toBe(WebSocket.OPEN);
}, 60_000);

test("X-40 a message too long is not kept; a page of another origin and another path are turned away", async () => {
  served = await serve({ studio, port: 0 });
  const camera = await line("/video");
  let code = 0;
  camera.on("close", why => {
    code = why;
  });
  camera.send(new Uint8Array(3 * 1024 * 1024));
  await until(() => code === 1009);
  expect((await line("/video", { origin: "https://evil.example" })).readyState).toBe(WebSocket.CLOSED);
  expect((await line("/nothing")).readyState).toBe(WebSocket.CLOSED);
}, 30_000);
