import { pose, type Vector3 } from "@twincell/core";
import { expect, test } from "vitest";
import { closeCameraPosition } from "./close-camera.ts";

const worldFromTcp = pose<"world", "tcp">([0.7, 0.2, 0.55]), out: Vector3 = [0, 0, 0];

test("N-42 the close camera keeps 0.5, 0.5, 0.1 m from the TCP", () => {
  closeCameraPosition(worldFromTcp, "offset", 0, out);
  expect(Math.abs(out[0] - 0.7)).toBeCloseTo(0.5, 12);
  expect(Math.abs(out[1] - 0.2)).toBeCloseTo(0.5, 12);
  expect(out[2] - 0.55).toBeCloseTo(0.1, 12);
});

test("N-45 by default it looks horizontally at the height of the TCP", () => {
  closeCameraPosition(worldFromTcp, "level", 0, out);
  expect(out[2]).toBeCloseTo(0.55, 12);
});

test("N-44 half of the tilt is 45°, all of it looks straight down", () => {
  const elevation = (tilt_rad: number): number => {
    closeCameraPosition(worldFromTcp, "level", tilt_rad, out);
    return Math.atan2(out[2] - 0.55, Math.hypot(out[0] - 0.7, out[1] - 0.2));
  };
  expect(elevation(0.5 * (Math.PI / 2))).toBeCloseTo(Math.PI / 4, 12);
  expect(elevation(Math.PI / 2)).toBeCloseTo(Math.PI / 2, 12);
});
