/** Webhooks to a receiver that is none of ours: http.server of Python. */
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, expect, test } from "vitest";
import { foreignScript, isMissing, plant, type Plant, type Script } from "../testing/foreign.ts";
import { readHooks } from "./hooks-file.ts";

let open: Plant | undefined;
let script: Script | undefined;
afterEach(async () => {
  script?.process.kill("SIGKILL");
  await open?.close();
  open = undefined;
});
const path = join(mkdtempSync(join(tmpdir(), "twincell-hooks-")), "hooks.json");
const write = (hooks: unknown): string => {
  writeFileSync(path, JSON.stringify({ format: "twincell.webhooks", version: 1, hooks }));
  return path;
};

test.skipIf(isMissing("http.server"))(
  "a receiver is told signed events in their order, those it would not take again, and only those it asked for",
  async () => {
    script = foreignScript("hook_receiver.py", "1");
    const { port } = await script.next();
    const secret = "a secret of the plant";
    open = await plant({
      webhooks: write([
        { url: `http://127.0.0.1:${String(port)}/plant`, events: ["opened", "done", "refused", "safety"], secret },
      ]),
    });
    expect(await script.next()).toMatchObject({
      signed: true,
      event: "opened",
      body: { robot: "arm", model: "ur10e" },
    });
    const lease = await open.lease();
    await open.ask("POST", "/robots/arm/move", { q_rad: [99, 0, 0, 0, 0, 0] }, lease);
    await open.ask("POST", "/robots/arm/stop", { emergency: true });
    const told: Record<string, unknown>[] = [];
    while (!told.some(({ event }) => event === "safety")) told.push(await script.next());
    expect(told.every(each => each["signed"] === true && each["type"] === "application/json")).toBe(true);
    expect(told.map(({ event }) => event)).toContain("refused");
    expect(told.find(({ event }) => event === "refused")).toMatchObject({
      body: { action: "moves the joints", why: { sentence: expect.any(String) as string } },
    });
    expect(told.at(-1)).toMatchObject({ body: { safety: "emergency-stop", robot: "arm" } });
  },
  60_000,
);

test("a file of webhooks that cannot be read is refused with its place", () => {
  expect(readHooks(write([{ url: "http://127.0.0.1/a" }]))).toHaveLength(1);
  expect(() => readHooks(write([{ url: "file:///etc/passwd" }]))).toThrow("hooks[0].url is no http or https address.");
  expect(() => readHooks(write([{ url: "http://a", events: ["everything"] }]))).toThrow("hooks[0].events wants");
  expect(() => readHooks(write([{ url: "http://a", secret: "short" }]))).toThrow("hooks[0].secret");
  expect(() => readHooks(write([{ url: "http://a", token: "x" }]))).toThrow("a key “token” that nothing reads");
});
