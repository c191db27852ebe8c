import { writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { robotById, seededRandom } from "@twincell/core";
import { singularJogs } from "../../packages/core/src/teach/testing/singular-jogs.ts";

/**
 * 1,000 random jogs into each singularity of arms with a spherical wrist and out of it again, and some of arms that are jogged by
 * damped least squares: whether all can leave, whether a joint is too fast or a number none. `node scripts/soak/jog-singular.ts`
 * takes some minutes and keeps its result in jog-singular.json.
 */
const SEED = 500, NAMES = { 2: "wrist over axis 1", 3: "arm stretched or folded", 5: "wrist straight" } as const;
const begun_ms = performance.now(), results = [];
for (const [id, jogs] of [["staubli_rx90l", 1000], ["kuka_kr6_2", 1000], ["ur10e", 100]] as const) {
  for (const joint of [2, 3, 5] as const) {
    const { left, arrived, notNumbers, tooFast, outside } = singularJogs(robotById(id)!, joint, jogs, seededRandom(SEED + joint));
    results.push({ robot: id, singularity: NAMES[joint], jogs, left, arrived, notNumbers, tooFast, outside });
    process.stdout.write(`${JSON.stringify(results[results.length - 1])}\n`);
  }
}
const result = {
  what: "jogs that left the singularity they began on, that arrived at it from beside; frames with a number that is none, a joint over its speed, a joint outside its limits",
  date: new Date().toISOString().slice(0, 10), machine: `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`, seed: SEED, seconds: Math.round((performance.now() - begun_ms) / 1000), results,
};
writeFileSync(new URL("jog-singular.json", import.meta.url), `${JSON.stringify(result, null, 1)}\n`);
