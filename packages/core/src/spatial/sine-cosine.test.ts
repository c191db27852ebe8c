import { expect, test } from "vitest";
import { seededRandom } from "../random.ts";
import { sineCosine } from "./sine-cosine.ts";

const out = new Float64Array(2);
/** One unit in the last place below 1; the engine's own functions are allowed as much. */
const ULP = 1.2e-16;

test("sine and cosine agree with the engine's over many turns, at quarter turns and near zero", () => {
  const random = seededRandom(3);
  const angles = Array.from({ length: 20_000 }, () => (random() - 0.5) * 10 ** (random() * 12 - 8));
  for (let quarter = -40; quarter <= 40; quarter++) angles.push((quarter * Math.PI) / 2, (quarter * Math.PI) / 4);
  let worst = 0;
  for (const angle of [...angles, 0, 1e5, -1e5, 3e7]) {
    sineCosine(angle, out);
    worst = Math.max(worst, Math.abs(out[0]! - Math.sin(angle)), Math.abs(out[1]! - Math.cos(angle)));
  }
  expect(worst).toBeLessThanOrEqual(ULP);
});

test("sine and cosine of NaN and of infinity are NaN", () => {
  for (const angle of [NaN, Infinity, -Infinity]) {
    sineCosine(angle, out);
    expect([...out]).toEqual([NaN, NaN]);
  }
});
