import { seededRandom, type Vector3 } from "@twincell/core";
import { expect, test } from "vitest";
import { KEYPAD_AT } from "./keypad-panel.tsx";
import { WORDS_PX } from "./keys.tsx";
import { FARTHEST_M, HIGHEST_M, LOWEST_M, MOST_TILT_RAD, NEAREST_M, settledPlace } from "./panel-place.ts";
import { ROOM_METRES_PER_PIXEL } from "./room-panel.tsx";
import { STANDS_AT as STAND_AT } from "./step-stand.tsx";
import { capital_arcmin, farthest_m, LEAST_CAPITAL_ARCMIN } from "./text-size.ts";
import { SMALL_PX, PLATE_METRES_PER_PIXEL, PLATE_READ_FROM_M } from "./wrist-panel.tsx";

const EYE: Vector3 = [0, 1.6, 0];

test("M-16 a panel that is let go anywhere stands within reading distance, turned to the eyes, tilted by at most 20°", () => {
  const random = seededRandom(4);
  for (let i = 0; i < 500; i++) {
    const at: Vector3 = [6 * (random() - 0.5), 4 * random() - 0.5, 6 * (random() - 0.5)];
    const { at: stands, turn_rad, tilt_rad } = settledPlace(at, EYE);
    const [x, z] = [stands[0] - EYE[0], stands[2] - EYE[2]];
    const away_m = Math.hypot(x, z);
    expect(away_m).toBeGreaterThanOrEqual(NEAREST_M - 1e-9);
    expect(away_m).toBeLessThanOrEqual(FARTHEST_M + 1e-9);
    expect(stands[1]).toBeGreaterThanOrEqual(LOWEST_M);
    expect(stands[1]).toBeLessThanOrEqual(HIGHEST_M);
    // Its face, +z turned by the angle, looks at the eyes.
    expect(Math.sin(turn_rad) * -x + Math.cos(turn_rad) * -z).toBeCloseTo(away_m, 9);
    expect(Math.abs(tilt_rad)).toBeLessThanOrEqual(MOST_TILT_RAD);
    // Below the eyes its face is tilted up to them.
    if (stands[1] < EYE[1] - 0.01) expect(tilt_rad).toBeLessThan(0);
  }
});

test("M-16 where it stands well it is left to the millimetre", () => {
  const { at } = settledPlace([0.4, 1.3, -0.9], EYE);
  for (const [k, value] of [0.4, 1.3, -0.9].entries()) expect(at[k]).toBeCloseTo(value, 9);
  expect(settledPlace([0, 1.9, 0], EYE).at[2], "over the head is no place").toBeCloseTo(-NEAREST_M, 9);
});

test("UX capitals on stand, keypad and plate are 50 minutes of arc high or more from where they are read", () => {
  const room = (top: readonly [number, number, number], hangs_m: number): number =>
    capital_arcmin(WORDS_PX, ROOM_METRES_PER_PIXEL, farthest_m(EYE, [...top], hangs_m));
  expect(room(STAND_AT, 0.72)).toBeGreaterThanOrEqual(LEAST_CAPITAL_ARCMIN);
  expect(room(KEYPAD_AT, 0.6)).toBeGreaterThanOrEqual(LEAST_CAPITAL_ARCMIN);
  expect(room([0, HIGHEST_M, -FARTHEST_M], 0.6)).toBeGreaterThanOrEqual(LEAST_CAPITAL_ARCMIN);
  expect(capital_arcmin(SMALL_PX, PLATE_METRES_PER_PIXEL, PLATE_READ_FROM_M)).toBeGreaterThanOrEqual(
    LEAST_CAPITAL_ARCMIN,
  );
  expect(capital_arcmin(22 / 0.727, 0.001, 1.5), "22 mm at 1.5 m").toBeCloseTo(50.4, 1);
});
