/** Somebody who may do nothing, and tries everything; scripts/soak/hostile-requests.ts sends a hundred thousand. */
import { mkdtempSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { expect, test } from "vitest";
import { auditFile, readAudit, serve } from "../index.ts";
import { hostileFlood } from "../testing/hostile.ts";

const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");

test("3,000 forged, broken and oversized requests by somebody without an account have no effect and end nothing: nobody is let in, nothing answers 5xx, no act is written down, and the server still answers", async () => {
  const data = mkdtempSync(join(tmpdir(), "twincell-data-"));
  const served = await serve({ studio, port: 0, version: "test", data, accounts: true });
  try {
    const before = readdirSync(data).toSorted();
    const { requests, answers, letIn, faults } = await hostileFlood(served.url, 3000, 17);
    expect(requests).toBe(3000);
    expect(letIn).toEqual([]);
    expect(faults).toEqual([]);
    expect(answers["4xx"]).toBeGreaterThan(2000);
    const { lines, verdict } = readAudit(readFileSync(auditFile(data), "utf8"));
    expect(verdict.kind).toBe("whole");
    expect(lines.filter(({ outcome }) => outcome !== "refused")).toEqual([]);
    expect(readdirSync(data).toSorted()).toEqual(before);
    const { status } = await fetch(new URL("/healthz", served.url));
    expect(status).toBe(200);
  } finally {
    await served.close();
  }
}, 120_000);
