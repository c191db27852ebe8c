/** Productions by HTTP: held before the first step, so that nothing depends on how busy the machine is. */
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { emptyProgram, robotById, type Program } from "@twincell/core";
import { afterEach, expect, test } from "vitest";
import { serve, type Served } from "../index.ts";

const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");
let served: Served | undefined;
afterEach(async () => {
  await served?.close();
  served = undefined;
});
const home = robotById("ur10e")!.home_rad;
const program = (name: string, by_rad: number): Program => ({
  ...emptyProgram("ur10e", name),
  steps: [
    {
      id: "s1",
      type: "move",
      path: "ptp",
      speed: { ratio: 0.5 },
      blend_m: 0,
      target: { q: home.map((q, i) => (i === 0 ? q + by_rad : q)) },
    },
  ],
});

test("T-53 X-56 by HTTP a production is held before its first step and its state is read; nobody without the lease steps it, a red program is refused, anyone holds it, and a stop ends it with its reason", async () => {
  served = await serve({ studio, port: 0, version: "test" });
  const ask = async (method: string, path: string, body: unknown = {}, lease = "") => {
    const answer = await fetch(new URL(`/api/v1/robots${path}`, served!.url), {
      method,
      headers: { "content-type": "application/json", "twincell-lease": lease },
      ...(method === "GET" ? {} : { body: JSON.stringify(body) }),
    });
    return { status: answer.status, body: (await answer.json()) as Record<string, unknown> };
  };
  await ask("POST", "", { id: "arm", driver: "ur", model: "ur10e" });
  const lease = String((await ask("POST", "/arm/lease")).body["lease"]);
  expect((await ask("POST", "/arm/production/hold")).body).toMatchObject({ why: { code: "production.none" } });
  const going = ask("POST", "/arm/production", { program: program("p", 0.2), cycles: 2, stepping: true }, lease);
  const state = async (): Promise<unknown> => (await ask("GET", "/arm/state")).body["production"];
  await expect.poll(state).toMatchObject({ state: "held", cycle: 1, of: 2, program: "p", step: "s1", next: null });
  expect(await ask("POST", "/arm/production/step")).toMatchObject({
    status: 409,
    body: { why: { code: "lease.unknown" } },
  });
  expect(await ask("PUT", "/arm/production/program", { program: program("red", 99) }, lease)).toMatchObject({
    status: 409,
    body: { kind: "refused" },
  });
  expect(await ask("PUT", "/arm/production/breakpoints", { steps: [] }, lease)).toMatchObject({ status: 200 });
  expect(await ask("POST", "/arm/production", { program: program("other", 0) }, lease)).toMatchObject({
    body: { why: { code: "production.exists" } },
  });
  expect(await ask("POST", "/arm/production/hold")).toMatchObject({ status: 200 });
  // What is given for the next cycle waits there, and is not lost without a word when the production ends before.
  const next = ask("PUT", "/arm/production/program", { program: program("new", 0.1) }, lease);
  await expect.poll(state).toMatchObject({ next: "new" });
  await ask("POST", "/arm/stop");
  expect(await going).toMatchObject({ status: 409, body: { kind: "stopped", why: { code: "production.stopped" } } });
  expect(await next).toMatchObject({ status: 409, body: { why: { code: "production.ended" } } });
  expect(await state()).toMatchObject({ state: "ended" });
}, 40_000);
