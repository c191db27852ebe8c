import { describe, expect, test } from "vitest";
import {
  CellCollider,
  certifyMotion,
  jointLine,
  seededRandom,
  verifyCertificate,
  type MotionCertificate,
} from "../index.ts";
import { box, planarArm, planarCell } from "./testing/test-arm.ts";
import { thinObstacles } from "./testing/thin-obstacles.ts";

test("500 thin plates that samples 5 mm apart step over: none is missed, and clear motions are confirmed by a second proof", () => {
  const result = thinObstacles(500, 25, seededRandom(61));
  expect(result).toMatchObject({ unsampled: 500, missed: 0 });
  expect(result.certified).toBeGreaterThan(10);
  expect(result.confirmed).toBe(result.certified);
});

describe("a certificate", () => {
  const motion = jointLine([0, 0, 0], [1, 0.3, -0.2]);
  const cell = (y_m: number): CellCollider =>
    new CellCollider(planarCell([box("cube", [2, y_m, 0], [0.1, 0.1, 0.1])]), planarArm);
  const { verdict, certificate } = certifyMotion(cell(-0.2), motion, 0, 1, { margin_m: 0.02 });
  const made = (): MotionCertificate => {
    if (!certificate) throw new Error(verdict.kind);
    return certificate;
  };
  const verify = (changed: Partial<MotionCertificate>, y_m = -0.2, moved = motion): unknown =>
    verifyCertificate(cell(y_m), planarArm, moved, { ...made(), ...changed });

  test("is confirmed in a new collider and survives JSON; it proves the margin", () => {
    expect(made().clearance_m).toBeGreaterThanOrEqual(0.02);
    expect(verify({})).toMatchObject({ kind: "confirmed" });
    expect(verify(JSON.parse(JSON.stringify(made())) as MotionCertificate)).toMatchObject({ kind: "confirmed" });
  });
  test("is not given for a motion with contact", () => {
    expect(certifyMotion(cell(0.5), motion, 0, 1)).toMatchObject({ verdict: { kind: "contact" }, certificate: null });
  });
  test("is refuted when the cube has moved into the way", () => {
    expect(verify({}, 0.5)).toMatchObject({ kind: "refuted", reason: "too near" });
  });
  test("is refuted when a piece is missing, or the motion is longer", () => {
    const { pieces } = made();
    const left = pieces.findIndex(({ b }) => b === "cube");
    expect(verify({ pieces: pieces.filter((_, i) => i !== left) })).toMatchObject({
      kind: "refuted",
      reason: "gap",
      b: "cube",
    });
    expect(verify({ to: 1.5 })).toMatchObject({ kind: "refuted", reason: "gap" });
  });
  test("is refuted when it claims more than is true", () => {
    expect(
      verify({ pieces: made().pieces.map(piece => ({ ...piece, atLeast_m: piece.atLeast_m + 0.5 })) }),
    ).toMatchObject({ kind: "refuted", reason: "too near" });
  });
  test("is refuted when the joints move faster than the motion says", () => {
    expect(verify({}, -0.2, { ...motion, maxRate: [0.1, 0.1, 0.1] })).toMatchObject({
      kind: "refuted",
      reason: "too fast",
    });
  });
});
