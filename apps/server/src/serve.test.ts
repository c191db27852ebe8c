import { mkdtempSync, mkdirSync, writeFileSync } from "node:fs";
import { get as httpGet, request as httpRequest } from "node:http";
import { get as httpsGet } from "node:https";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, expect, test } from "vitest";
import { serve, type Served } from "./index.ts";

const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");
mkdirSync(join(studio, "assets"));
writeFileSync(join(studio, "assets", "a-1234.js"), "export const a = 1;".repeat(100));
writeFileSync(join(studio, "assets", "physics.worker-Ab_1-2.js"), "1;");
writeFileSync(join(studio, "..", "secret.txt"), "secret");

let served: Served | undefined;
afterEach(async () => {
  await served?.close();
  served = undefined;
});

function get(
  path: string,
  headers: Record<string, string> = {},
  method = "GET",
): Promise<{ status: number; headers: Record<string, string | string[] | undefined>; body: string }> {
  const url = new URL(served!.url);
  return new Promise((resolve, reject) => {
    const options = { host: "127.0.0.1", port: url.port, path, headers, method, rejectUnauthorized: false };
    const listen = (response: import("node:http").IncomingMessage) => {
      const parts: Buffer[] = [];
      response.on("data", (part: Buffer) => parts.push(part));
      response.on("end", () => {
        resolve({
          status: response.statusCode ?? 0,
          headers: response.headers,
          body: Buffer.concat(parts).toString("latin1"),
        });
      });
    };
    const asked =
      url.protocol === "https:"
        ? httpsGet(options, listen)
        : method === "GET"
          ? httpGet(options, listen)
          : httpRequest(options, listen).end();
    asked.on("error", reject);
  });
}

test("serves the studio on loopback with isolation headers, and compresses it", async () => {
  served = await serve({ studio, port: 0 });
  const page = await get("/");
  expect(page.status).toBe(200);
  expect(page.body).toContain("studio");
  expect(page.headers["cross-origin-opener-policy"]).toBe("same-origin");
  const script = await get("/assets/a-1234.js", { "accept-encoding": "gzip" });
  expect(script.headers["content-encoding"]).toBe("gzip");
  expect(script.headers["cache-control"]).toContain("immutable");
  expect((await get("/assets/a-1234.js", { "if-none-match": String(script.headers["etag"]) })).status).toBe(304);
});

test("only the workers that hold the physics engine and the CAD kernel may write code; the page and every other script may not", async () => {
  served = await serve({ studio, port: 0 });
  const policy = async (path: string): Promise<string> => String((await get(path)).headers["content-security-policy"]);
  expect(await policy("/assets/physics.worker-Ab_1-2.js")).toContain("'unsafe-eval'");
  expect(await policy("/assets/step.worker-Ab_1-2.js")).toContain("'unsafe-eval'");
  for (const path of [
    "/",
    "/assets/a-1234.js",
    "/assets/shape.worker-Ab_1-2.js",
    "/assets/physics.worker.js",
    "/assets/x/physics.worker-a.js",
    "/physics.worker-a.js",
  ])
    expect((await policy(path)).replace("'wasm-unsafe-eval'", ""), path).not.toContain("unsafe-eval");
});

test.each(["/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/assets/../../secret.txt", "/%00", "/nothing"])(
  "nothing outside the folder exists: %s",
  async path => {
    served = await serve({ studio, port: 0 });
    const answer = await get(path);
    expect(answer.status).toBe(404);
    expect(answer.body).not.toContain("secret");
  },
);

test("an unreadable address, a foreign name and a write are answered with one sentence", async () => {
  served = await serve({ studio, port: 0 });
  expect((await get("/%zz")).status).toBe(400);
  expect((await get("/", { host: "evil.example" })).status).toBe(421);
  expect((await get("/", {}, "POST")).status).toBe(405);
});

test("a taken port is an error, not a silence", async () => {
  served = await serve({ studio, port: 0 });
  await expect(serve({ studio, port: Number(new URL(served.url).port) })).rejects.toThrow("EADDRINUSE");
});

test("on the local network: HTTPS, and no page without the access code", async () => {
  const data = mkdtempSync(join(tmpdir(), "twincell-data-"));
  served = await serve({ studio, port: 0, lan: true, host: "127.0.0.1", data });
  expect(served.url).toMatch(/^https:/);
  expect((await get("/")).status).toBe(401);
  expect((await get("/?code=000000x")).status).toBe(401);
  const entered = await get(`/?code=${served.code}`);
  expect(entered.status).toBe(303);
  const cookie = String(entered.headers["set-cookie"]).split(";")[0]!;
  expect((await get("/", { cookie })).body).toContain("studio");
  // The authority has a page of its own, behind the code as everything is.
  expect((await get("/trust/")).status).toBe(401);
  expect((await get("/trust/", { cookie })).body).toContain(served.fingerprint!);
  expect((await get("/trust/twincell-authority.crt", { cookie })).body).toMatch(/^-----BEGIN CERTIFICATE-----/);
  // The code opens the page it was put behind, and never one elsewhere.
  for (const [path, location] of [
    ["/", "/"],
    ["/camera/", "/camera/"],
    ["/camera/?name=Phone", "/camera/?name=Phone"],
    ["/.//evil.example/", "/evil.example/"],
  ] as const) {
    expect((await get(`${path}${path.includes("?") ? "&" : "?"}code=${served.code}`)).headers["location"]).toBe(
      location,
    );
  }
}, 30_000);

test("twenty wrong codes close the door", async () => {
  served = await serve({ studio, port: 0, lan: true, host: "127.0.0.1" });
  for (let i = 0; i < 20; i++) await get("/?code=wrong!");
  expect((await get(`/?code=${served.code}`)).status).toBe(429);
}, 30_000);
