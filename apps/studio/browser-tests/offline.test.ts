import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize, sep } from "node:path";
import { fileURLToPath } from "node:url";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

const DIST = fileURLToPath(new URL("../dist/", import.meta.url));
const TYPES: Readonly<Record<string, string>> = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".json": "application/json",
  ".webmanifest": "application/manifest+json",
  ".wasm": "application/wasm",
  ".png": "image/png",
  ".glb": "model/gltf-binary",
  ".woff2": "font/woff2",
};
const FOLDER = "/robots/studio/";

/** Any web server: files of one folder below a path, without a header of Twincell's, and a count of what was asked. */
class PlainServer {
  readonly asked: string[] = [];
  readonly folder = mkdtempSync(join(tmpdir(), "twincell-static-"));
  #server: Server | null = null;
  port = 0;

  constructor() {
    cpSync(DIST, this.folder, { recursive: true });
  }
  get url(): string {
    return `http://127.0.0.1:${this.port}${FOLDER}`;
  }
  async start(): Promise<void> {
    const server = createServer((request, response) => {
      const path = new URL(request.url ?? "/", "http://here").pathname;
      this.asked.push(path);
      const file = normalize(join(this.folder, path.slice(FOLDER.length - 1)));
      const wanted = path.endsWith("/") ? join(file, "index.html") : file;
      try {
        if (!path.startsWith(FOLDER) || !wanted.startsWith(this.folder + sep)) throw new Error("outside");
        const body = readFileSync(wanted);
        response.writeHead(200, {
          "content-type": TYPES[extname(wanted)] ?? "application/octet-stream",
          "cache-control": "no-cache",
        });
        response.end(body);
      } catch {
        response.writeHead(404).end();
      }
    });
    await new Promise<void>(resolve => {
      server.listen(this.port, "127.0.0.1", resolve);
    });
    const address = server.address();
    this.port = typeof address === "object" && address ? address.port : 0;
    this.#server = server;
  }
  /** As if it had been unplugged: open connections end as well. */
  async stop(): Promise<void> {
    this.#server?.closeAllConnections();
    await new Promise(resolve => {
      if (this.#server) this.#server.close(resolve);
      else resolve(undefined);
    });
    this.#server = null;
  }
}

let studio: Studio;
let web: PlainServer;
beforeAll(async () => {
  studio = await Studio.start();
  web = new PlainServer();
  await web.start();
});
afterAll(async () => {
  await studio.stop();
  await web.stop();
  rmSync(web.folder, { recursive: true });
});

const kept = (page: Page): Promise<unknown> =>
  page.waitForFunction(() => window.twincell.stores.offlineStore.getState().state === "kept", null, {
    timeout: 120_000,
    polling: 200,
  });
const record = (page: Page): Promise<void> =>
  page.evaluate(() => {
    window.twincell.run("program.record-ptp");
  });
const points = (page: Page): Promise<number> =>
  page.evaluate(() => {
    const { document } = window.twincell.stores.cellStore.getState();
    return document!.programs.flatMap(each => (each.format === "twincell.program" ? each.steps : [])).length;
  });

test("L-01 from any web server, below a path: installable, and without a network from the second visit on it teaches, checks, exports and connects its virtual controller", async () => {
  const { page, context } = await studio.open({ offline: true });
  page.setDefaultTimeout(120_000);
  await page.goto(web.url);
  await drawn(page);
  const session = await context.newCDPSession(page);
  const { installabilityErrors } = await session.send("Page.getInstallabilityErrors");
  // A private window may not install anything, and that is all that is held against it.
  expect(installabilityErrors.map(({ errorId }) => errorId).filter(id => id !== "in-incognito")).toEqual([]);
  await kept(page);
  await record(page);
  await page.waitForFunction(() => window.twincell.stores.cellStore.getState().saving.kind === "saved");

  await web.stop();
  await page.reload();
  await drawn(page);
  expect(await points(page), "what was taught is still there").toBe(1);
  await page.evaluate(() => {
    const { live } = window.twincell;
    const q = Array.from(live.now().q_rad);
    q[0]! += 0.3;
    live.showJoints(q);
  });
  await record(page);
  await page.waitForFunction(
    () => {
      const { verdict, checking } = window.twincell.stores.playStore.getState();
      return verdict?.steps.length === 2 && checking === null;
    },
    null,
    { timeout: 60_000 },
  );
  const saving = page.waitForEvent("download", { timeout: 60_000 });
  await page.evaluate(() => window.twincell.run("export.save"));
  const file = await saving;
  expect(readFileSync((await file.path())!, "utf8")).toMatch(/\.PROGRAM/);
  await page.evaluate(() => window.twincell.run("connection.connect"));
  await page.waitForFunction(
    () => window.twincell.stores.stationStore.getState().stations.some(({ link }) => link.state === "open"),
    null,
    { timeout: 60_000 },
  );
  await page.screenshot({ path: picture("offline") });
  await context.close();
  await web.start();
}, 600_000);

test("a newer version waits for the person, takes nothing that was made, and fetches only what changed", async () => {
  const { page, context } = await studio.open({ offline: true });
  page.setDefaultTimeout(120_000);
  await page.goto(web.url);
  await drawn(page);
  await kept(page);
  await page.reload();
  await drawn(page);
  await kept(page);
  const worker = readFileSync(join(web.folder, "sw.js"), "utf8");
  const version = `newer-${Date.now()}`;
  writeFileSync(join(web.folder, "sw.js"), worker.replace(/const VERSION = "[^"]*"/, `const VERSION = "${version}"`));
  web.asked.length = 0;
  await page.evaluate(async () => {
    await (await navigator.serviceWorker.getRegistration())!.update();
  });
  const bar = page.locator(".update-bar");
  await bar.waitFor({ timeout: 60_000 });
  // The browser also looks for a newer worker by itself after a page was opened: how often is its own affair.
  expect([...new Set(web.asked)]).toEqual([`${FOLDER}sw.js`]);
  // Changed a moment before: not on the disk yet.
  await record(page);
  await page.screenshot({ path: picture("offline-update") });
  await Promise.all([
    page.waitForEvent("load", { timeout: 60_000 }),
    bar.getByRole("button", { name: "Use it now" }).click(),
  ]);
  await drawn(page);
  expect(await points(page)).toBe(1);
  expect(await page.evaluate(() => caches.keys())).toEqual([`twincell-${version}`]);
  await context.close();
}, 600_000);
