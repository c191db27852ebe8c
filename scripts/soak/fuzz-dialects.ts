import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { LIBRARY, pose, seededRandom } from "@twincell/core";
import { DIALECTS, dialectsFor } from "@twincell/languages";
import { randomProgram } from "../../packages/languages/src/testing/programs.ts";
import { damaged, expectSane } from "../../packages/languages/src/testing/damage.ts";

/**
 * A million damaged texts for the reader and the interpreter of every dialect: no exception, no text that keeps them busy
 * for a second, a place and an expectation in every fault, no growth of memory. `node --expose-gc scripts/soak/fuzz-dialects.ts
 * [inputs] [dialect]` keeps its result in fuzz-dialects.json.
 */
const SEED = 11, INPUTS = Number(process.argv[2] ?? 1_000_000), ONLY = process.argv[3];
const collect = (): number => { (globalThis as { gc?: () => void }).gc?.(); return process.memoryUsage().heapUsed / 1e6; };
const file = new URL("fuzz-dialects.json", import.meta.url);
// What is not run again keeps its last result.
const results: Record<string, unknown> = existsSync(file) ? (JSON.parse(readFileSync(file, "utf8")) as { results: Record<string, unknown> }).results : {};
for (const dialect of DIALECTS) {
  if (ONLY !== undefined && dialect.id !== ONLY) continue;
  const robot = LIBRARY.find(each => dialectsFor(each).includes(dialect));
  if (robot === undefined) continue;
  const worldFromBase = pose<"world", "base">([0.3, -0.2, 0.75]), cannot = dialect.cannot.map(({ what }) => what);
  const paths = (["ptp", "lin", "circ", "spline"] as const).filter(path => !cannot.includes(path));
  const sources = [1, 2, 3, 4].flatMap(seed => {
    const emitted = dialect.emit(randomProgram(robot, { seed, steps: 12, worldFromBase, paths, cannot }), robot, worldFromBase);
    return emitted.kind === "emitted" ? [(dialect.runnable?.(emitted.files) ?? emitted.files[0]!).text] : [];
  });
  const random = seededRandom(SEED), before_MB = collect(), begun_ms = performance.now();
  let slowest_ms = 0, understood = 0;
  for (let i = 0; i < INPUTS; i++) {
    const text = damaged(sources[i % sources.length]!, random), started_ms = performance.now();
    const answer = i % 2 === 0 ? dialect.parse(text, robot, worldFromBase) : dialect.interpret(text, robot, worldFromBase);
    slowest_ms = Math.max(slowest_ms, performance.now() - started_ms);
    if (answer.kind === "not-understood") expectSane(answer.faults, text); else understood++;
  }
  results[dialect.id] = { inputs: INPUTS, understood, slowest_ms: Math.round(slowest_ms), grown_MB: Math.round((collect() - before_MB) * 10) / 10, seconds: Math.round((performance.now() - begun_ms) / 1000) };
  process.stdout.write(`${dialect.id}: ${JSON.stringify(results[dialect.id])}\n`);
}
writeFileSync(file, `${JSON.stringify({
  what: "damaged texts read or executed beforehand; understood: those that still mean something", date: new Date().toISOString().slice(0, 10),
  machine: `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`, seed: SEED, results,
}, null, 2)}\n`);
