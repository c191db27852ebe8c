import { expect, test } from "vitest";
import { flangePose, pose, seededRandom, type SerialArm } from "../index.ts";

const limits = { lower_rad: -100, upper_rad: 100, speed_rad_s: 1, acceleration_rad_s2: 1 };
const turntable: SerialArm = { name: "turntable", joints: [{ name: "1", axis: [0, 0, 1], parentFromJoint: pose(), limits }], lastJointFromFlange: pose() };

test("a joint's own sine and cosine are the engine's to 5e-16 over many turns, sign included, and NaN stays NaN", () => {
  const random = seededRandom(31), angles = Array.from({ length: 20_000 }, () => (random() - 0.5) * 60);
  for (let k = -16; k <= 16; k++) for (const aside of [0, 1e-9, -1e-9, 1e-16]) angles.push((k * Math.PI) / 4 + aside);
  let worst = 0;
  for (const angle of angles) {
    const [x, y, z, w] = flangePose(turntable, [angle]).quaternion;
    expect(x === 0 && y === 0).toBe(true);
    worst = Math.max(worst, Math.abs(z - Math.sin(angle / 2)), Math.abs(w - Math.cos(angle / 2)));
  }
  expect(worst).toBeLessThan(5e-16);
  expect(flangePose(turntable, [NaN]).quaternion[3]).toBeNaN();
  expect(flangePose(turntable, [0]).quaternion).toEqual([0, 0, 0, 1]);
});
