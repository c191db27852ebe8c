// npm run evidence: results that take too long for every run of the tests, where they are kept, and which of them are
// missing or older than the code they judge. npm run evidence -- NAME… makes those anew, -- all makes every one.
import { spawnSync } from "node:child_process";
import { node, root } from "./prepare.mjs";
import { EVIDENCE } from "./evidence/list.mjs";
import { evidenceStates, stateSentence } from "./evidence/state.mjs";

const wanted = process.argv.slice(2);
if (wanted.length === 0) {
  for (const state of evidenceStates(EVIDENCE, root)) console.log(`${state.level.padEnd(8)}${stateSentence(state)}`);
  process.exit(0);
}
const unknown = wanted.filter(name => name !== "all" && !EVIDENCE.some(each => each.name === name));
if (unknown.length > 0) {
  console.error(
    `There is no evidence “${unknown.join(", ")}”. There is: ${EVIDENCE.map(each => each.name).join(", ")}, or all.`,
  );
  process.exit(2);
}
const failed = EVIDENCE.filter(each => wanted.includes("all") || wanted.includes(each.name)).filter(each => {
  console.log(`\n── ${each.name}`);
  return spawnSync(node, each.command, { cwd: root, stdio: "inherit" }).status !== 0;
});
if (failed.length > 0) console.error(`Not held: ${failed.map(each => each.name).join(", ")}.`);
process.exit(failed.length > 0 ? 1 : 0);
