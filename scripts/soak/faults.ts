import { parseArgs } from "node:util";
import { SOAKED } from "./faults/brands.ts";
import { FAULTS } from "./faults/kinds.ts";
import { soak, type Soaked } from "./faults/soak.ts";
import { keptResults } from "./kept.ts";

/**
 * Faults by the thousand between every driver and its virtual controller, through the station that people have, on a
 * virtual clock: `node scripts/soak/faults.ts [COUNT] [--seed N] [--brand ID]… [--fault NAME]… [--keep]`. COUNT is for
 * each brand. What a law says is broken is found again with its seed: `--brand ID --seed N 12`. Exit 1 when one did not
 * hold.
 */
const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    seed: { type: "string", default: "1" },
    brand: { type: "string", multiple: true, default: [] },
    fault: { type: "string", multiple: true, default: [] },
    keep: { type: "boolean", default: false },
  },
});
const count = Number(positionals[0] ?? 2000);
const seed = Number(values.seed);
const names = values.fault.length > 0 ? values.fault : Object.keys(FAULTS);
const brands = SOAKED.filter(({ id }) => values.brand.length === 0 || values.brand.includes(id));
const unknown = names.filter(name => !(name in FAULTS));
if (!(count > 0) || !Number.isInteger(seed) || brands.length === 0 || unknown.length > 0) {
  process.stderr.write(
    `COUNT is a number above 0, a seed a whole number; brands are ${SOAKED.map(({ id }) => id).join(", ")}; faults are ${Object.keys(FAULTS).join(", ")}.\n`,
  );
  process.exit(2);
}
let adrift = 0;
process.on("unhandledRejection", reason => {
  adrift++;
  process.stderr.write(
    `A promise that nobody waited for: ${reason instanceof Error ? (reason.stack ?? "") : String(reason)}\n`,
  );
});

const kept = keptResults<Soaked & { readonly seed: number }>(new URL("faults.json", import.meta.url), {
  what: "faults at a random moment of a motion, a text or rest; laws that did not hold, with the seed; at worst: seconds and counts; what became of the command",
});
let broken = 0;
for (const brand of brands) {
  const result = { seed, ...(await soak(brand, count, seed, () => performance.now(), names)) };
  broken += result.broken.length;
  if (values.keep) kept.keep(brand.id, result);
  process.stdout.write(`${brand.id} ${JSON.stringify(result, null, 1)}\n`);
}
process.exit(broken + adrift > 0 ? 1 : 0);
