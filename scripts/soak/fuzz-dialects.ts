import { LIBRARY, pose, seededRandom } from "@twincell/core";
import { DIALECTS, dialectsFor, runnableFile } from "@twincell/languages";
import { randomProgram } from "../../packages/languages/src/testing/programs.ts";
import { damaged, expectSane } from "../../packages/languages/src/testing/damage.ts";
import { keptResults } from "./kept.ts";

/**
 * A million damaged texts for the reader and the interpreter of every dialect: no exception, no text that keeps them
 * busy for a second, a place and an expectation in every fault, no growth of memory. `node --expose-gc
 * scripts/soak/fuzz-dialects.ts [inputs] [dialect]` keeps its result in fuzz-dialects.json after every chunk.
 */
const SEED = 11;
const INPUTS = Number(process.argv[2] ?? 1_000_000);
const ONLY = process.argv[3];
const CHUNK = 50_000;
const STEPS = 5;
const collect = (): number => {
  (globalThis as { gc?: () => void }).gc?.();
  return process.memoryUsage().heapUsed / 1e6;
};
interface Fuzzed {
  inputs: number;
  understood: number;
  slowest_ms: number;
  grown_MB: number;
  seconds: number;
}
const kept = keptResults<Fuzzed>(new URL("fuzz-dialects.json", import.meta.url), {
  what: "damaged texts read or executed beforehand; understood: those that still mean something",
  seed: SEED,
});

for (const dialect of DIALECTS) {
  if (ONLY !== undefined && dialect.id !== ONLY) continue;
  const robot = LIBRARY.find(each => dialectsFor(each).includes(dialect));
  if (robot === undefined) continue;
  const worldFromBase = pose<"world", "base">([0.3, -0.2, 0.75]);
  const cannot = dialect.cannot.map(({ what }) => what);
  const paths = (["ptp", "lin", "circ", "spline"] as const).filter(path => !cannot.includes(path));
  // Many short texts: a place in a long one is damaged as seldom as the text is long.
  const sources = Array.from({ length: 24 }, (_, i) =>
    dialect.emit(
      randomProgram(robot, { seed: i + 1, steps: STEPS, worldFromBase, paths, cannot }),
      robot,
      worldFromBase,
    ),
  ).flatMap(emitted => (emitted.kind === "emitted" ? [runnableFile(dialect, emitted.files)!.text] : []));
  const random = seededRandom(SEED);
  const before_MB = collect();
  const begun_ms = performance.now();
  let slowest_ms = 0;
  let understood = 0;
  for (let i = 0; i < INPUTS; i++) {
    const text = damaged(sources[i % sources.length]!, random);
    const started_ms = performance.now();
    const answer =
      random() < 0.5 ? dialect.parse(text, robot, worldFromBase) : dialect.interpret(text, robot, worldFromBase);
    const took_ms = performance.now() - started_ms;
    // Busy with other work, the machine may be slow once: what is slow again is slow.
    if (took_ms > slowest_ms) {
      const again_ms = performance.now();
      dialect.parse(text, robot, worldFromBase);
      dialect.interpret(text, robot, worldFromBase);
      slowest_ms = Math.max(slowest_ms, Math.min(took_ms, performance.now() - again_ms));
      if (slowest_ms > 1000)
        throw new Error(`${dialect.id} is busy for ${Math.round(slowest_ms)} ms with ${JSON.stringify(text)}`);
    }
    if (answer.kind === "not-understood") expectSane(answer.faults, text);
    else understood++;
    if ((i + 1) % CHUNK === 0 || i + 1 === INPUTS) {
      kept.keep(dialect.id, {
        inputs: i + 1,
        understood,
        slowest_ms: Math.round(slowest_ms),
        grown_MB: Math.round((collect() - before_MB) * 10) / 10,
        seconds: Math.round((performance.now() - begun_ms) / 1000),
      });
    }
  }
  process.stdout.write(`${dialect.id}: ${JSON.stringify(kept.of(dialect.id))}\n`);
}
