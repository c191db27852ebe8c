import { X509Certificate } from "node:crypto";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createServer, request } from "node:https";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, beforeEach, expect, test } from "vitest";
import { certificate, type Certificate } from "./authority.ts";
import { trustPage } from "./trust-page.ts";

let folder: string;
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), "twincell-authority-"));
});
afterEach(() => {
  rmSync(folder, { recursive: true, force: true });
});

/** What a client that trusts only this authority gets from a server with that certificate. */
async function ask(own: Certificate, trusted: string): Promise<string> {
  const server = createServer({ key: own.key, cert: own.cert }, (_, response) => response.end("hello"));
  await new Promise<void>(resolve => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address() as AddressInfo;
  try {
    return await new Promise((resolve, reject) => {
      request({ host: "127.0.0.1", port, ca: trusted, agent: false }, response => {
        let text = "";
        response.on("data", (part: Buffer) => (text += part.toString()));
        response.on("end", () => {
          resolve(text);
        });
      })
        .on("error", reject)
        .end();
    });
  } finally {
    server.close();
  }
}

test("a device that trusts the authority meets no warning, and one that trusts another authority refuses", async () => {
  const own = await certificate(folder, ["192.168.7.20"], "cell-pc");
  expect(await ask(own, own.authority)).toBe("hello");
  const other = await certificate(undefined, [], "other");
  await expect(ask(own, other.authority)).rejects.toThrow(/certificate/i);
});

test("both are kept, readable by their owner alone; another address gets another certificate of the same authority", async () => {
  const first = await certificate(folder, ["192.168.7.20"], "cell-pc");
  expect(await certificate(folder, ["192.168.7.20"], "cell-pc")).toEqual(first);
  const moved = await certificate(folder, ["10.1.2.3"], "cell-pc");
  expect(moved.authority).toBe(first.authority);
  expect(moved.cert).not.toBe(first.cert);
  expect(new X509Certificate(moved.cert).subjectAltName).toContain("IP Address:10.1.2.3");
  expect(await ask(moved, first.authority)).toBe("hello");
  for (const name of ["authority.json", "certificate.json"]) expect(statSync(join(folder, name)).mode & 0o77).toBe(0);
});

test("the authority may sign for private networks and localhost only, signs no further authority, and lasts ten years", async () => {
  const { authority, cert } = await certificate(folder, ["192.168.7.20"], "cell-pc");
  const parsed = new X509Certificate(authority);
  expect(parsed.ca).toBe(true);
  expect(parsed.subject).toBe("CN=Twincell on cell-pc");
  expect(new X509Certificate(cert).checkIssued(parsed)).toBe(true);
  const days = (Date.parse(new X509Certificate(cert).validTo) - Date.now()) / 86_400_000;
  expect(days).toBeLessThan(825);
  // 10.0.0.0/8 and 192.168.0.0/16 as they stand in the extension; no entry that allows everything.
  const raw = parsed.raw.toString("hex");
  expect(raw).toContain("87080a000000ff000000");
  expect(raw).toContain("8708c0a80000ffff0000");
  expect(raw).not.toContain("87080000000000000000");
});

test("a damaged file is said with the way out, one that has run out or is of an earlier version is made anew", async () => {
  writeFileSync(join(folder, "authority.json"), "{");
  await expect(certificate(folder, [], "cell-pc")).rejects.toThrow(/authority\.json/);
  writeFileSync(join(folder, "authority.json"), JSON.stringify({ key: "x", until: 1 }));
  writeFileSync(join(folder, "certificate.json"), JSON.stringify({ key: "x", cert: "y", addresses: [], until: 9e15 }));
  const made = await certificate(folder, [], "cell-pc");
  expect(await ask(made, made.authority)).toBe("hello");
  expect(JSON.parse(readFileSync(join(folder, "authority.json"), "utf8"))).toHaveProperty("cert");
});

test("the page says how in English and German, with the fingerprint to compare", () => {
  expect(trustPage("de-AT,de;q=0.9", "AA:BB")).toMatch(/lang="de"[\s\S]*vertrauen[\s\S]*AA:BB/);
  expect(trustPage("fr", "AA:BB")).toMatch(/lang="en"[\s\S]*Certificate Trust Settings[\s\S]*Quest/);
});
