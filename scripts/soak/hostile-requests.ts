/**
 * Forged, broken and oversized requests by somebody without an account at a server where people sign in, a third of
 * them with a read-only link: node scripts/soak/hostile-requests.ts [REQUESTS] [SEED]. Nobody is let in but to look at
 * the cell of the link, which stays as it is; nothing answers 5xx, no act is written down, the server still answers.
 * The result is kept beside this file.
 */
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { emptyCell, openDocument, saveDocument } from "@twincell/project";
import { addCellLink, auditFile, readAudit, serve } from "@twincell/server";
import { hostileFlood } from "../../apps/server/src/testing/hostile.ts";

const REQUESTS = Number(process.argv[2] ?? 100_000);
const SEED = Number(process.argv[3] ?? 17);
const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");
const data = mkdtempSync(join(tmpdir(), "twincell-data-"));
for (const folder of ["cells", "editing"]) mkdirSync(join(data, folder));
const cellFile = join(data, "cells", "line.json");
const cell = saveDocument(emptyCell());
writeFileSync(cellFile, cell);
const cookie = `twincell_link=${addCellLink(data, "line", new Date(Date.now() + 30 * 86_400_000))}`;
const served = await serve({ studio, port: 0, version: "soak", data, accounts: true });
const files = (): string =>
  readdirSync(data)
    .filter(name => name !== "audit.lock")
    .toSorted()
    .join();
const before = files();
const began_s = performance.now() / 1000;
const { requests, answers, letIn, faults } = await hostileFlood(served.url, REQUESTS, SEED, {
  cell: "line",
  cookie,
});
const { status } = await fetch(new URL("/healthz", served.url));
const { lines, verdict } = readAudit(readFileSync(auditFile(data), "utf8"));
const effects = lines.filter(({ outcome }) => outcome !== "refused").length;
await served.close();
const opened = openDocument(readFileSync(cellFile, "utf8"));
const cellChanged = opened.kind !== "opened" || saveDocument(opened.document) !== cell;
const result = {
  date: new Date().toISOString().slice(0, 10),
  machine: `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`,
  requests,
  seed: SEED,
  seconds: Math.round(performance.now() / 1000 - began_s),
  answers,
  letIn: letIn.length,
  faults: faults.length,
  effects,
  newFiles: before !== files(),
  cellChanged,
  log: verdict.kind,
  answersAfter: status === 200,
};
console.log(JSON.stringify(result, null, 2));
for (const each of [...letIn, ...faults].slice(0, 20)) console.error(each);
const isHeld =
  letIn.length + faults.length + effects === 0 &&
  verdict.kind === "whole" &&
  status === 200 &&
  !result.newFiles &&
  !cellChanged;
if (isHeld && requests >= 100_000)
  writeFileSync(new URL("./hostile-requests.json", import.meta.url), `${JSON.stringify(result, null, 2)}\n`);
process.exit(isHeld ? 0 : 1);
