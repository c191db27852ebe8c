/** Somebody who may do nothing, and tries everything; scripts/soak/hostile-requests.ts sends a hundred thousand. */
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { emptyCell, openDocument, saveDocument } from "@twincell/project";
import { expect, test } from "vitest";
import { addCellLink, auditFile, readAudit, serve } from "../index.ts";
import { hostileFlood } from "../testing/hostile.ts";

const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");

test("3,000 forged, broken and oversized requests by somebody without an account, a third of them with a read-only link, have no effect and end nothing: nobody is let in but to look at the cell of the link, which does not change, nothing answers 5xx, no act is written down, and the server still answers", async () => {
  const data = mkdtempSync(join(tmpdir(), "twincell-data-"));
  const cell = saveDocument(emptyCell());
  for (const folder of ["cells", "editing"]) mkdirSync(join(data, folder));
  writeFileSync(join(data, "cells", "line.json"), cell);
  const link = {
    cell: "line",
    cookie: `twincell_link=${addCellLink(data, "line", new Date(Date.now() + 86_400_000))}`,
  };
  const served = await serve({ studio, port: 0, version: "test", data, accounts: true });
  try {
    const before = readdirSync(data).toSorted();
    const { requests, answers, letIn, faults } = await hostileFlood(served.url, 3000, 17, link);
    expect(requests).toBe(3000);
    expect(letIn).toEqual([]);
    expect(answers["looked"]).toBeGreaterThan(0);
    const after = openDocument(readFileSync(join(data, "cells", "line.json"), "utf8"));
    expect(after.kind === "opened" && saveDocument(after.document)).toBe(cell);
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
