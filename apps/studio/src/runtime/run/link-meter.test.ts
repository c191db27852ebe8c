import { expect, test } from "vitest";
import { LinkMeter } from "./link-meter.ts";

test("ages are kept as they come and gaps in the count are samples lost", () => {
  const meter = new LinkMeter();
  for (const [sequence, age_ms] of [
    [7, 1],
    [8, 2.5],
    [11, -0.1],
    [12, 4],
  ] as const)
    meter.add(sequence, age_ms);
  expect(meter).toMatchObject({ samples: 4, lost: 2, ages_ms: [1, 2.5, 0, 4] });
  meter.reset();
  meter.add(40, 1);
  expect(meter).toMatchObject({ samples: 1, lost: 0, ages_ms: [1] });
});
