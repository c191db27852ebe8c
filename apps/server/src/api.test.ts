/**
 * The documented API by HTTP and by its read-only socket. Documents are held against validators that nobody here wrote;
 * the Python that has them is named by TWINCELL_PYTHON: `npm run clients`.
 */
import { spawnSync } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, writeFileSync } from "node:fs";
import { request as httpRequest } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { emptyProgram, robotById, type Program } from "@twincell/core";
import { API_ROUTES, createClient, type ApiRoute, type ConnectionEvent } from "@twincell/protocol";
import { afterEach, expect, test } from "vitest";
import { WebSocket } from "ws";
import { serve, type Served, type ServeOptions } from "./index.ts";

const python = process.env["TWINCELL_PYTHON"] ?? "python3";
const has = (module: string): boolean => spawnSync(python, ["-c", `import ${module}`]).status === 0;
const noValidator = !has("openapi_spec_validator");
const noSchemas = !has("jsonschema");

const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");
const robot = robotById("ur10e")!;
/** Joint 1 alone turned: the arm comes near nothing of itself. */
const turned = (by_rad: number): number[] => Array.from(robot.home_rad, (q, i) => (i === 0 ? q + by_rad : q));
const near = (by_rad: number): number[] => Array.from(robot.home_rad, q => q + by_rad);

const open: { close(): unknown }[] = [];
afterEach(async () => {
  for (const each of open.splice(0).reverse()) await each.close();
});
async function server(options: Partial<ServeOptions> = {}): Promise<Served> {
  const served = await serve({ studio, port: 0, version: "test", ...options });
  open.push(served);
  return served;
}

interface Answer {
  readonly status: number;
  readonly body: Record<string, unknown>;
  readonly text: string;
}
function api(served: Served) {
  return async (
    method: string,
    path: string,
    body?: unknown,
    headers: Record<string, string> = {},
    signal?: AbortSignal,
  ): Promise<Answer> => {
    const response = await fetch(new URL(path, served.url), {
      method,
      headers: { ...(body === undefined ? {} : { "content-type": "application/json" }), ...headers },
      ...(body === undefined ? {} : { body: JSON.stringify(body) }),
      ...(signal ? { signal } : {}),
    });
    const text = await response.text();
    const isJson = response.headers.get("content-type") === "application/json";
    return { status: response.status, text, body: isJson ? (JSON.parse(text) as Record<string, unknown>) : {} };
  };
}
/** A virtual UR10e behind a lease. */
async function connected(served: Served) {
  const ask = api(served);
  expect((await ask("POST", "/api/v1/robots", { id: "arm", driver: "ur", model: "ur10e" })).body).toEqual({
    kind: "done",
  });
  const taken = await ask("POST", "/api/v1/robots/arm/lease", { who: "a test" });
  const lease = { "twincell-lease": String(taken.body["lease"]) };
  expect((await ask("POST", "/api/v1/robots/arm/connect", undefined, lease)).body).toEqual({ kind: "done" });
  return { ask, lease };
}
/** The events of the read-only socket, and the wait for one that fits. */
function stream(served: Served, query = "") {
  const socket = new WebSocket(new URL(`/api/v1/stream${query}`, served.url.replace(/^http/, "ws")));
  open.push({
    close() {
      socket.terminate();
    },
  });
  const events: ConnectionEvent[] = [];
  const waits = new Set<{ fits: (event: ConnectionEvent) => boolean; settle: (event: ConnectionEvent) => void }>();
  socket.on("message", data => {
    const event = JSON.parse(String(data as Buffer)) as ConnectionEvent;
    events.push(event);
    for (const wait of waits)
      if (wait.fits(event)) {
        waits.delete(wait);
        wait.settle(event);
      }
  });
  return {
    socket,
    events,
    next: (fits: (event: ConnectionEvent) => boolean) =>
      new Promise<ConnectionEvent>(settle => {
        waits.add({ fits, settle });
      }),
  };
}

test.skipIf(noValidator)(
  "the OpenAPI document is valid to openapi-spec-validator, the AsyncAPI document says version 3.0 and each of its messages is a JSON Schema to jsonschema",
  async () => {
    const ask = api(await server());
    const openapi = await ask("GET", "/api/openapi.json");
    const asyncapi = await ask("GET", "/api/asyncapi.json");
    const run = spawnSync(
      python,
      [
        "-c",
        `import json, sys
from openapi_spec_validator import OpenAPIV31SpecValidator, validate
from jsonschema import Draft7Validator
openapi, asyncapi = json.loads(sys.stdin.readline()), json.loads(sys.stdin.readline())
validate(openapi, cls=OpenAPIV31SpecValidator)
messages = asyncapi["components"]["messages"]
for message in messages.values(): Draft7Validator.check_schema(message["payload"])
for channel in asyncapi["channels"].values():
    for message in channel["messages"].values(): assert message["$ref"].rsplit("/", 1)[1] in messages, message
for operation in asyncapi["operations"].values():
    channel = asyncapi["channels"][operation["channel"]["$ref"].rsplit("/", 1)[1]]
    for message in operation["messages"]: assert message["$ref"].rsplit("/", 1)[1] in channel["messages"], message
print(asyncapi["asyncapi"], len(messages))`,
      ],
      { input: `${openapi.text}\n${asyncapi.text}\n`, encoding: "utf8" },
    );
    expect(run.stderr).toBe("");
    expect(run.stdout.trim()).toMatch(/^3\.0\.0 [3-9]\d$/);
  },
);

test.skipIf(noSchemas)(
  "every event that the read-only socket says fits its schema of the AsyncAPI document",
  async () => {
    const served = await server();
    const { events, next } = stream(served);
    await next(({ type }) => type === "hello");
    const { ask, lease } = await connected(served);
    const asyncapi = await ask("GET", "/api/asyncapi.json");
    const sampled = next(({ type }) => type === "sample");
    await ask("POST", "/api/v1/robots/arm/move", { q_rad: near(0.05) }, lease);
    await sampled;
    const run = spawnSync(
      python,
      [
        "-c",
        `import json, sys
from jsonschema import Draft7Validator
asyncapi, events = json.loads(sys.stdin.readline()), json.loads(sys.stdin.readline())
schemas = {name: Draft7Validator(m["payload"]) for name, m in asyncapi["components"]["messages"].items()}
for event in events: schemas["event-" + event["type"]].validate(event)
print(" ".join(sorted({event["type"] for event in events})))`,
      ],
      { input: `${asyncapi.text}\n${JSON.stringify(events)}\n`, encoding: "utf8" },
    );
    expect(run.stderr).toBe("");
    for (const type of ["hello", "opened", "sample", "link", "guard", "act"])
      expect(run.stdout.split(/\s/)).toContain(type);
  },
  60_000,
);

test("every route of the document is answered, and what is no route of it is not", async () => {
  const served = await server();
  const ask = api(served);
  const document = (await ask("GET", "/api/openapi.json")).body as { paths: Record<string, Record<string, unknown>> };
  const said = Object.entries(document.paths).flatMap(([path, methods]) =>
    Object.keys(methods).map(method => `${method} ${path}`),
  );
  const made = (Object.values(API_ROUTES) as ApiRoute[]).map(({ method, path }) => `${method} ${path}`);
  expect(said.toSorted()).toEqual(made.toSorted());
  for (const each of said) {
    const [method, path] = each.split(" ") as [string, string];
    const answer = await ask(
      method.toUpperCase(),
      path.replace(/\{\w+\}/g, "nobody"),
      method === "post" || method === "put" ? {} : undefined,
    );
    expect(JSON.stringify(answer.body), each).not.toMatch(/api\.(none|method)/);
    expect(answer.status, each).toBeLessThan(500);
  }
  for (const [method, path] of [
    ["GET", "/api/v1/nothing"],
    ["GET", "/api/v2"],
    ["POST", "/api/v1/robots/a/b"],
  ] as const)
    expect(await ask(method, path, method === "POST" ? {} : undefined)).toMatchObject({
      status: 404,
      body: { why: { code: "api.none" } },
    });
  expect(await ask("DELETE", "/api/v1/robots")).toMatchObject({
    status: 405,
    body: { why: { hint: "Possible: GET, POST." } },
  });
  expect((await ask("GET", "/api")).text).toContain("/api/openapi.json");
});

test("state is read without a lease and without signs of life; a motion needs the lease and ends at its target", async () => {
  const { ask, lease } = await connected(await server());
  const target = near(0.1);
  expect(await ask("POST", "/api/v1/robots/arm/move", { q_rad: target })).toMatchObject({
    status: 409,
    body: { why: { code: "lease.unknown" } },
  });
  expect(await ask("POST", "/api/v1/robots/arm/lease", { who: "a test" })).toMatchObject({
    status: 409,
    body: { kind: "refused" },
  });
  const moved = await ask("POST", "/api/v1/robots/arm/move", { q_rad: target }, lease);
  expect(moved, moved.text).toMatchObject({
    status: 200,
    body: { kind: "done" },
  });
  const state = (await ask("GET", "/api/v1/robots/arm/state")).body as {
    sample: { q_rad: number[] };
    guard: { holder: string };
    link: { state: string };
  };
  expect(Math.max(...state.sample.q_rad.map((q, i) => Math.abs(q - target[i]!)))).toBeLessThan(1e-3);
  expect(state.guard.holder).toContain("a test");
  expect(state.link.state).toBe("open");
  expect((await ask("DELETE", "/api/v1/robots/arm/lease", undefined, lease)).body).toEqual({ kind: "done" });
  expect(await ask("DELETE", "/api/v1/robots/arm")).toMatchObject({ status: 200 });
  expect(await ask("GET", "/api/v1/robots/arm/state")).toMatchObject({ status: 404 });
}, 60_000);

test("whoever ends the request of a motion stops the robot; anyone may stop it", async () => {
  const served = await server();
  const { ask, lease } = await connected(served);
  const { next } = stream(served);
  await next(({ type }) => type === "hello");
  const away = new AbortController();
  const moves = next(event => event.type === "sample" && event.moving);
  const moving = ask("POST", "/api/v1/robots/arm/move", { q_rad: turned(1.5) }, lease, away.signal);
  expect(await Promise.race([moves, moving])).toMatchObject({ type: "sample" });
  const stops = next(event => event.type === "act" && event.action === "stops the robot");
  const rests = next(event => event.type === "guard" && event.motion === "at-rest");
  away.abort();
  await expect(moving).rejects.toThrow();
  await stops;
  await rests;
  const again = next(event => event.type === "sample" && event.moving);
  const second = ask("POST", "/api/v1/robots/arm/move", { q_rad: turned(-1.5) }, lease);
  expect(await Promise.race([again, second])).toMatchObject({ type: "sample" });
  expect((await ask("POST", "/api/v1/robots/arm/stop", {})).body).toEqual({ kind: "done" });
  expect(await second).toMatchObject({ status: 409, body: { kind: "stopped" } });
}, 60_000);

test("a lease that nobody names any more ends by itself", async () => {
  const served = await server();
  const ask = api(served);
  await ask("POST", "/api/v1/robots", { id: "arm", driver: "ur", model: "ur10e" });
  const { next } = stream(served);
  await next(({ type }) => type === "hello");
  const taken = next(event => event.type === "guard" && event.holder !== null);
  const { body } = await ask("POST", "/api/v1/robots/arm/lease", { expires_s: 1 });
  await taken;
  await next(event => event.type === "guard" && event.holder === null);
  const lease = { "twincell-lease": String(body["lease"]) };
  expect(await ask("POST", "/api/v1/robots/arm/connect", undefined, lease)).toMatchObject({
    status: 409,
    body: { why: { code: "lease.unknown" } },
  });
});

test("keys that this version does not know do not cut a client off, by socket or by HTTP", async () => {
  const served = await server();
  const ask = api(served);
  expect(
    (await ask("POST", "/api/v1/robots", { id: "arm", driver: "ur", model: "ur10e", colour: "of a later version" }))
      .body,
  ).toEqual({ kind: "done" });
  const socket = new WebSocket(new URL("/stations", served.url.replace(/^http/, "ws")));
  open.push({
    close() {
      socket.terminate();
    },
  });
  await once(socket, "open");
  const answered = new Promise<unknown>(resolve => {
    socket.on("message", data => {
      const event = JSON.parse(String(data as Buffer)) as { type: string };
      if (event.type === "answer" || event.type === "fault") resolve(event);
    });
  });
  socket.send(JSON.stringify({ type: "take", id: 7, station: "arm", reason: "of a later version" }));
  expect(await answered).toEqual({ type: "answer", id: 7, outcome: { kind: "done" } });
  const told: unknown[] = [];
  const client = createClient(
    {
      send: () => undefined,
      close() {
        told.push("closed");
      },
    },
    () => 0,
    message => {
      told.push(message.type);
    },
  );
  client.hear(JSON.stringify({ type: "closed", station: "arm", later: true }));
  expect(told).toEqual(["closed"]);
  expect(told).toHaveLength(1);
});

test("a program is checked, planned and written by HTTP as on the command line; what cannot be read is said with its place", async () => {
  const ask = api(await server());
  const program: Program = {
    ...emptyProgram("ur10e", "To and fro"),
    steps: [{ id: "a", type: "move", path: "ptp", speed: { ratio: 0.3 }, blend_m: 0, target: { q: near(0.2) } }],
  };
  expect((await ask("POST", "/api/v1/check", { program })).body).toMatchObject({
    ok: true,
    steps: [{ id: "a", verdict: "ok" }],
  });
  const plan = (await ask("POST", "/api/v1/plan", { program, period_s: 0.02 })).body as {
    kind: string;
    q_rad: number[][];
    time_s: number[];
  };
  expect(plan.kind).toBe("planned");
  expect(plan.q_rad.length).toBe(plan.time_s.length);
  near(0.2).forEach((q, i) => {
    expect(plan.q_rad.at(-1)![i]).toBeCloseTo(q, 6);
  });
  const written = (await ask("POST", "/api/v1/write", { program, language: "urscript" })).body as {
    files: { text: string }[];
  };
  expect(written.files[0]?.text).toContain("movej");
  const bad = { ...program, steps: [{ ...program.steps[0], target: { q: [0, 0] } }] };
  expect(await ask("POST", "/api/v1/check", { program: bad })).toMatchObject({
    status: 409,
    body: { kind: "refused" },
  });
  expect(await ask("POST", "/api/v1/check", { program, margin_m: "wide" })).toMatchObject({
    status: 400,
    body: { why: { code: "api.body" } },
  });
}, 60_000);

test("programs are kept, listed, read and removed in the data folder; a name never leaves it; recordings are listed", async () => {
  const data = mkdtempSync(join(tmpdir(), "twincell-data-"));
  const ask = api(await server({ data }));
  const program = emptyProgram("ur10e", "Kept");
  expect((await ask("PUT", "/api/v1/programs/kept", program)).body).toEqual({ kind: "done" });
  expect((await ask("GET", "/api/v1/programs")).body).toEqual({ names: ["kept"] });
  expect((await ask("GET", "/api/v1/programs/kept")).body).toMatchObject({ name: "Kept", robot: "ur10e" });
  expect(await ask("PUT", "/api/v1/programs/bad", { format: "else" })).toMatchObject({ status: 409 });
  for (const name of ["..%2F..%2Fpasswd", ".hidden", "a%00b"])
    expect((await ask("PUT", `/api/v1/programs/${name}`, program)).status, name).toBeGreaterThanOrEqual(400);
  expect((await ask("DELETE", "/api/v1/programs/kept")).body).toEqual({ kind: "done" });
  expect(await ask("GET", "/api/v1/programs/kept")).toMatchObject({ status: 404 });
  expect((await ask("GET", "/api/v1/recordings")).body).toEqual({ recordings: [] });
});

test("pages of another origin may not ask, on the local network nobody without the code", async () => {
  const served = await server();
  const ask = api(served);
  expect(await ask("POST", "/api/v1/stop", {}, { origin: "http://evil.example" })).toMatchObject({ status: 403 });
  const lan = await server({ lan: true, host: "127.0.0.1" });
  const { request } = await import("node:https");
  const status = (headers: Record<string, string>, path = "/api/v1/robots"): Promise<number> =>
    new Promise((resolve, reject) => {
      const { port } = new URL(lan.url);
      request({ host: "127.0.0.1", port, path, headers, rejectUnauthorized: false }, response => {
        response.resume();
        resolve(response.statusCode ?? 0);
      })
        .on("error", reject)
        .end();
    });
  expect(await status({})).toBe(401);
  expect(await status({ authorization: "Bearer nothing" })).toBe(401);
  expect(await status({ authorization: `Bearer ${lan.code}` })).toBe(200);
  expect(await status({}, "/healthz")).toBe(200);
}, 30_000);

test("healthz, readyz and metrics answer as Prometheus and orchestrators ask", async () => {
  const served = await server();
  const { ask, lease } = await connected(served);
  expect(await ask("GET", "/healthz")).toMatchObject({ status: 200, text: "ok\n" });
  expect(await ask("GET", "/readyz")).toMatchObject({ status: 200, body: { ready: true, robots: 1, connected: 1 } });
  await ask("POST", "/api/v1/robots/arm/move", { q_rad: near(0.05) }, lease);
  const { text } = await ask("GET", "/metrics");
  expect(text).toMatch(/^twincell_robot_connected\{robot="arm"\} 1$/m);
  expect(Number(/^twincell_robot_samples_total\{robot="arm"\} (\d+)$/m.exec(text)?.[1])).toBeGreaterThan(10);
  for (const line of text.trim().split("\n"))
    expect(line).toMatch(/^(# (HELP|TYPE) twincell_\w+ .+|twincell_\w+(\{\w+="[^"]*"\})? [-+.e\d]+)$/);
}, 60_000);

test("a body that is no JSON, too much of one, or without its type is one sentence", async () => {
  const served = await server();
  const send = (body: string, headers: Record<string, string>): Promise<string> =>
    new Promise((resolve, reject) => {
      const asked = httpRequest(new URL("/api/v1/robots", served.url), { method: "POST", headers }, response => {
        let text = "";
        response.on("data", part => (text += String(part)));
        response.on("end", () => {
          resolve(`${response.statusCode} ${text}`);
        });
      });
      asked.on("error", reject);
      asked.end(body);
    });
  expect(await send("{", { "content-type": "application/json" })).toMatch(/^400 .*A body is JSON; this one is not/);
  expect(await send("{}", {})).toMatch(/^400 .*content-type/);
  expect(await send("{}", { "content-type": "application/json" })).toMatch(/^400 .*at “id”/);
});
