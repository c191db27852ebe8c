import { robotById } from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { FLOW_GRAMMARS, flowText, randomFlow } from "../../packages/languages/src/testing/control-flow.ts";
import { disagreement } from "../../packages/languages/src/testing/import-agreement.ts";
import { keptResults } from "./kept.ts";

/**
 * A thousand generated texts with counters, state, inputs, loops and calls per language, imported as steps, and both
 * sides executed with the same inputs: how many are imported, how many of them do something else. `node
 * scripts/soak/imports.ts [programs] [language]` keeps its result in imports.json.
 */
const PROGRAMS = Number(process.argv[2] ?? 1000);
const ONLY = process.argv[3];
const INPUTS = [11, 12, 13, 14, 15, 16, 17, 18];
interface Imported {
  programs: number;
  imported: number;
  disagreements: number;
  examples: string[];
  seconds: number;
}
const kept = keptResults<Imported>(new URL("imports.json", import.meta.url), {
  what: "generated texts with control flow, imported and compared with interpreting them",
  seeds: `1 … ${PROGRAMS}`,
});

for (const [id, { robot: robotId, grammar }] of Object.entries(FLOW_GRAMMARS)) {
  if (ONLY !== undefined && id !== ONLY) continue;
  const dialect = dialectById(id)!;
  const robot = robotById(robotId)!;
  const begun_ms = performance.now();
  const examples: string[] = [];
  let imported = 0;
  let disagreements = 0;
  for (let seed = 1; seed <= PROGRAMS; seed++) {
    const text = flowText(randomFlow(seed), grammar);
    const parsed = dialect.parse(text, robot);
    if (parsed.kind === "not-understood") {
      examples.push(`${seed}: line ${parsed.faults[0]!.line}: ${parsed.faults[0]!.sentence}`);
      continue;
    }
    imported++;
    const differs = disagreement(dialect, text, parsed, robot, INPUTS);
    if (differs === undefined) continue;
    disagreements++;
    examples.unshift(`${seed}: ${differs}`);
  }
  const seconds = Math.round((performance.now() - begun_ms) / 1000);
  kept.keep(id, { programs: PROGRAMS, imported, disagreements, examples: examples.slice(0, 3), seconds });
  console.log(`${id}: ${imported} of ${PROGRAMS} imported, ${disagreements} disagree, ${seconds} s`);
  if (disagreements > 0) process.exitCode = 1;
}
