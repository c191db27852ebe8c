import { DRIVER_KINDS } from "@twincell/controllers";
import { describe, expect, test } from "vitest";
import { FAULTS } from "./faults/kinds.ts";
import { soak } from "./faults/soak.ts";

const SEED = 41;
const names = Object.keys(FAULTS);

/** Each fault once, with one seed; by the thousand it is `npm run soak -- faults`. */
describe.each(DRIVER_KINDS.map(kind => [kind.name, kind] as const))("%s, every fault once", (_, kind) => {
  test("X-41 T-47 stops within 100 ms, stands within its braking time, moves again only at a person's word", async () => {
    const { faults, broken, worst, counts } = await soak(kind, names.length, SEED, () => 0, names, true);
    expect(broken).toEqual([]);
    expect([faults, Object.keys(counts).length]).toEqual([names.length, names.length]);
    // A slice in which nothing was under way would prove nothing.
    expect(worst.silentWhileMoving_s).toBeGreaterThan(0.04);
    expect(worst.standsAfterStop_s + worst.standsAfterCabinet_s).toBeGreaterThan(0);
  });
});

test("the laws can be broken: a driver whose stop goes nowhere is found out", async () => {
  const kind = DRIVER_KINDS[0]!;
  const deaf = {
    ...kind,
    face: (options: Parameters<typeof kind.face>[0]) => ({ ...kind.face(options), stop: () => undefined }),
  };
  const { broken } = await soak(deaf, 20, SEED, () => 0, ["stop"]);
  expect(broken.map(({ law }) => law.split(":")[0])).toContain("it stood late after a stop");
});
