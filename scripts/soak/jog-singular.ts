import { writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { robotById, seededRandom } from "@twincell/core";
import { singularJogs } from "../../packages/core/src/teach/testing/singular-jogs.ts";

/**
 * 1,000 random jogs into each singularity of arms that jog by a closed form and out of it again, and some of one that
 * is jogged by damped least squares: whether all can leave, whether a joint is too fast or a number none. `node
 * scripts/soak/jog-singular.ts` takes some minutes and keeps its result in jog-singular.json.
 */
const SEED = 500;
const NAMES = { 2: "wrist over axis 1", 3: "arm stretched or folded", 5: "wrist straight" } as const;
const begun_ms = performance.now();
const results = [];
for (const [id, jogs] of [
  ["staubli_rx90l", 1000],
  ["kuka_kr6_2", 1000],
  ["ur10e", 1000],
  ["abb_crb15000_5_95", 100],
] as const) {
  for (const joint of [2, 3, 5] as const) {
    const { stuck, frame_ms, ...counts } = singularJogs(robotById(id)!, joint, jogs, seededRandom(SEED + joint), () =>
      performance.now(),
    );
    results.push({
      robot: id,
      singularity: NAMES[joint],
      ...counts,
      stuck: stuck.length,
      frameMedian_us: Math.round(1e4 * frame_ms.median) / 10,
    });
    process.stdout.write(`${JSON.stringify(results[results.length - 1])}\n`);
  }
}
const result = {
  what: "jogs that left the singularity they began on (through: went on without a pause for half of their way; explained: another joint's limit stopped them after 1 % of it, or the reach of their posture ended, and no posture near by goes on; limited: a joint's limit, named, kept them from turning in place far enough), that arrived at it from beside; frames with a number that is none, a joint over its speed, a joint outside its limits; jogs whose tip strayed by more than 1e-6 (m, rad)",
  date: new Date().toISOString().slice(0, 10),
  machine: `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`,
  seed: SEED,
  seconds: Math.round((performance.now() - begun_ms) / 1000),
  results,
};
writeFileSync(new URL("jog-singular.json", import.meta.url), `${JSON.stringify(result, null, 1)}\n`);
