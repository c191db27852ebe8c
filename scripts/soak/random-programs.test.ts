import { ALL_DRIVER_KINDS } from "@twincell/controllers";
import { describe, expect, test } from "vitest";
import { soak } from "./random-programs/soak.ts";

const SEED = 11;
const COLLIDING = 12;
const CLEAR = 12;

/** A seeded slice; by the thousand it is `npm run soak -- random-programs`. */
describe.each(ALL_DRIVER_KINDS.map(kind => [kind.name, kind.id, kind] as const))("%s (%s)", (_, __, kind) => {
  test("T-43 T-63 of 12 random programs that collide, sent without the check, none touches anything; of 12 clear ones all end", async () => {
    const { colliding, touched, stopped, clear, ended, failed } = await soak(
      kind,
      { colliding: COLLIDING, clear: CLEAR },
      SEED,
      () => 0,
    );
    expect({ touched, unended: clear - ended, failed }).toEqual({ touched: 0, unended: 0, failed: [] });
    expect([colliding >= COLLIDING, clear >= CLEAR]).toEqual([true, true]);
    // Whatever else ends a program before it touches anything, it is the guard that is tried here.
    expect(stopped).toBeGreaterThan(0.9 * colliding);
  }, 300_000);
});
