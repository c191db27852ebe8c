/**
 * Eight editors of one cell for ten minutes of virtual time: random edits with and without a connection, messages that
 * are late and messages that are lost with their connection: node scripts/soak/editors.ts [SEEDS] [SECONDS]. At the end
 * all have the same cell, it can be opened, and what each of them wanted is in it. The result is kept beside this file.
 */
import { writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { runEditors } from "../../packages/project/src/sharing/testing/editors.ts";

const SEEDS = Number(process.argv[2] ?? 3);
const SECONDS = Number(process.argv[3] ?? 600);
const EDITORS = 8;
const began_s = performance.now() / 1000;
const runs = Array.from({ length: SEEDS }, (_, i) => {
  const seed = i + 1;
  const run = runEditors({ editors: EDITORS, seed, seconds: SECONDS, edits_per_s: 0.5, offline: 0.5 });
  const result = {
    seed,
    edits: run.edits,
    disconnections: run.disconnections,
    lostIntents: run.lost.length,
    differentDocuments: run.different - 1,
    refused: run.refused.length,
    opens: run.opens,
    bytes: run.bytes,
  };
  console.log(JSON.stringify(result));
  for (const each of [...run.lost, ...run.refused].slice(0, 10)) console.error(each);
  return result;
});
const isHeld = runs.every(run => run.lostIntents + run.differentDocuments + run.refused === 0 && run.opens);
if (isHeld && SECONDS >= 600)
  writeFileSync(
    new URL("./editors.json", import.meta.url),
    `${JSON.stringify(
      {
        date: new Date().toISOString().slice(0, 10),
        machine: `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`,
        editors: EDITORS,
        virtualSeconds: SECONDS,
        seconds: Math.round(performance.now() / 1000 - began_s),
        runs,
      },
      null,
      2,
    )}\n`,
  );
process.exit(isHeld ? 0 : 1);
