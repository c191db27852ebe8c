import { angleBetween, fromAxisAngle, multiply, seededRandom, type Quaternion } from "@twincell/core";
import { expect, test } from "vitest";
import { fixedXyz, fromFixedXyz } from "./fixed-xyz.ts";

const X: [number, number, number] = [1, 0, 0];
const Y: [number, number, number] = [0, 1, 0];
const Z: [number, number, number] = [0, 0, 1];
const product = (rx: number, ry: number, rz: number): Quaternion =>
  multiply(fromAxisAngle(Z, rz), multiply(fromAxisAngle(Y, ry), fromAxisAngle(X, rx)));

test("is the product of the three turns about fixed axes, and comes back", () => {
  const random = seededRandom(11);
  const out = new Float64Array(3);
  for (let i = 0; i < 500; i++) {
    const rx = (random() * 2 - 1) * Math.PI;
    const ry = (random() - 0.5) * Math.PI;
    const rz = (random() * 2 - 1) * Math.PI;
    expect(angleBetween(fromFixedXyz(rx, ry, rz), product(rx, ry, rz))).toBeLessThan(1e-9);
    fixedXyz(product(rx, ry, rz), out);
    expect(angleBetween(fromFixedXyz(out[0]!, out[1]!, out[2]!), product(rx, ry, rz))).toBeLessThan(1e-7);
  }
});
test("at ry = ±90° the rotation is still the same", () => {
  const out = new Float64Array(3);
  for (const ry of [Math.PI / 2, -Math.PI / 2])
    for (const [rx, rz] of [
      [0.3, 1.1],
      [-2, 2.5],
      [3, -3],
    ] as const) {
      fixedXyz(product(rx, ry, rz), out);
      expect(angleBetween(fromFixedXyz(out[0]!, out[1]!, out[2]!), product(rx, ry, rz))).toBeLessThan(1e-5);
    }
});
