import { parseArgs } from "node:util";
import { ALL_DRIVER_KINDS } from "@twincell/controllers";
import { keptResults } from "./kept.ts";
import { soak, type Soaked } from "./random-programs/soak.ts";

/**
 * Random programs among random objects on every driver, the check before the run switched off, on a virtual clock:
 * `node scripts/soak/random-programs.ts [COUNT] [--seed N] [--driver ID]… [--keep]`. COUNT is of colliding and of clear
 * ones for each driver, 10,000 when left out. In none of them may the arm touch anything; of the clear ones 99.9 % must
 * be carried out to the end. Exit 1 when that did not hold.
 */
const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    seed: { type: "string", default: "1" },
    driver: { type: "string", multiple: true, default: [] },
    keep: { type: "boolean", default: false },
  },
});
const count = Number(positionals[0] ?? 10000);
const seed = Number(values.seed);
const drivers = ALL_DRIVER_KINDS.filter(({ id }) => values.driver.length === 0 || values.driver.includes(id));
if (!(count > 0) || !Number.isInteger(seed) || drivers.length === 0) {
  process.stderr.write(
    `COUNT is a number above 0, a seed a whole number; drivers are ${ALL_DRIVER_KINDS.map(({ id }) => id).join(", ")}.\n`,
  );
  process.exit(2);
}
const kept = keptResults<Soaked & { readonly seed: number }>(new URL("random-programs.json", import.meta.url), {
  what: "random programs among random objects, the check before the run switched off: in how many the arm touched anything, how many clear ones ended; what failed, with the seed",
});
let isBroken = false;
for (const driver of drivers) {
  const result = { seed, ...(await soak(driver, { colliding: count, clear: count }, seed, () => performance.now())) };
  isBroken ||= result.touched > 0 || result.ended < 0.999 * result.clear;
  if (values.keep) kept.keep(driver.id, result);
  process.stdout.write(`${driver.id} ${JSON.stringify(result, null, 1)}\n`);
}
process.exit(isBroken ? 1 : 0);
