import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  angleBetween,
  compose,
  distance,
  frameFromThreePoints,
  fromAxisAngle,
  fromMatrix,
  inverse,
  multiply,
  pose,
  registerPoints,
  rotate,
  seededRandom,
  symmetricEigen,
  tcpFromTouches,
  tcpOrientation,
  toMatrix,
  transformPoint,
  type Matrix3,
  type Pose,
  type Quaternion,
  type Vector3,
} from "../index.ts";

interface Golden {
  registrations: { known: Vector3[]; measured: Vector3[]; matrix: Matrix3; position: Vector3; rms_m: number }[];
  tips: {
    touches: Pose<"base", "flange">[];
    true_tip: Vector3;
    noise_m: number;
    tip: Vector3;
    fixed: Vector3;
    rms_m: number;
  }[];
}
const golden = JSON.parse(
  readFileSync(new URL("../../../../fixtures/calibration/calibration.json", import.meta.url), "utf8"),
) as Golden;
const random = seededRandom(4);
const any = (size: number): number => size * (random() - 0.5);
const anyTurn = (most = 2 * Math.PI): Quaternion => {
  const [x, y, z] = [any(1), any(1), any(1)];
  const n = Math.hypot(x, y, z);
  return fromAxisAngle([x / n, y / n, z / n], most * (2 * random() - 1));
};
const determinant = ([a, b, c, d, e, f, g, h, i]: Matrix3): number =>
  a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);

describe("tool tip from touches of one point", () => {
  test("agrees with LAPACK's least squares, in tip, point and residual", () => {
    expect(golden.tips.length).toBe(30);
    for (const { touches, tip, fixed, rms_m, true_tip, noise_m } of golden.tips) {
      const answer = tcpFromTouches(touches);
      if (answer.kind !== "calibrated") throw new Error(answer.sentence);
      expect(distance(answer.tip, tip)).toBeLessThan(1e-12);
      expect(distance(answer.fixedPoint, fixed)).toBeLessThan(1e-12);
      expect(Math.abs(answer.residual.rms_m - rms_m)).toBeLessThan(1e-12);
      expect(answer.residual.each_m.length).toBe(touches.length);
      if (noise_m === 0) {
        expect(distance(answer.tip, true_tip)).toBeLessThan(1e-9);
        expect(answer.residual.rms_m).toBeLessThan(1e-12);
      }
    }
  });

  test("the stated uncertainty is what noise does to the tip, and a careless touch is named", () => {
    const flangeFromTip: Vector3 = [0.02, -0.05, 0.18];
    const fixed: Vector3 = [0.7, 0.1, 0.4];
    const noise_m = 2e-4;
    let squares = 0;
    let stated = 0;
    for (let n = 0; n < 300; n++) {
      const touches = Array.from({ length: 6 }, () => {
        const q = anyTurn(0.6);
        return pose<"base", "flange">(
          fixed.map((value, i) => value - rotate(q, flangeFromTip)[i]! + gaussian() * noise_m) as Vector3,
          q,
        );
      });
      const answer = tcpFromTouches(touches);
      if (answer.kind !== "calibrated") continue;
      squares +=
        (answer.weakest.reduce((sum, value, i) => sum + value * (answer.tip[i]! - flangeFromTip[i]!), 0) /
          answer.uncertainty_m) **
        2;
      stated++;
    }
    expect(stated).toBeGreaterThan(250);
    expect(Math.sqrt(squares / stated)).toBeGreaterThan(0.7); // in units of its own standard deviation; six touches tell it only roughly
    expect(Math.sqrt(squares / stated)).toBeLessThan(1.4);
    const touches = Array.from({ length: 8 }, () => {
      const q = anyTurn(0.8);
      return pose<"base", "flange">(fixed.map((value, i) => value - rotate(q, flangeFromTip)[i]!) as Vector3, q);
    });
    touches[4]!.position[0] += 0.005;
    const answer = tcpFromTouches(touches);
    if (answer.kind !== "calibrated") throw new Error(answer.sentence);
    expect(answer.residual.worst).toBe(5);
    expect(answer.sentence).toMatch(
      /^The touches meet in one point to \d\.\d\d mm \(root mean square\); touch 5 is worst with \d\.\d\d mm\.$/,
    );
  });

  test("poses too alike are refused, and the missing tilt is named", () => {
    const tip: Vector3 = [0, 0.03, 0.2];
    const at = (q: Quaternion): Pose<"base", "flange"> => pose(rotate(q, tip).map(value => 0.5 - value) as Vector3, q);
    const aboutZ = tcpFromTouches(
      [0, 0.5, 1, 1.5, 2].map(angle => at(multiply(anyTilt, fromAxisAngle([0, 0, 1], angle)))),
    );
    expect(aboutZ).toMatchObject({ kind: "too-alike" });
    if (aboutZ.kind !== "too-alike" || aboutZ.about === null) throw new Error("A turn about z does not see z.");
    expect(Math.abs(aboutZ.about[2])).toBeCloseTo(1, 9);
    expect(aboutZ.sentence).toBe(
      "The poses turn about one direction only, nearly the flange's z; the tip along it is not seen. Tilt the tool about the flange's x or y as well.",
    );
    const nearlySame = tcpFromTouches([0, 0.01, -0.01, 0.02].map(angle => at(fromAxisAngle([1, 0, 0], angle))));
    expect(nearlySame).toMatchObject({ kind: "too-alike", about: null });
    expect(nearlySame.sentence).toMatch(/^The poses differ by 0\.\d° only; tilt the tool/);
    expect(tcpFromTouches([at(anyTilt), at(anyTilt)])).toMatchObject({
      kind: "too-few",
      got: 2,
      sentence: "4 touches are the least; 2 were given.",
    });
    expect(tcpFromTouches([at(anyTilt), pose([0, NaN, 0])])).toMatchObject({ kind: "not-a-pose" });
  });
  const anyTilt = fromAxisAngle([0.6, 0, 0.8], 2.1);

  test("its orientation comes from touching with a point on +x and one in the xy plane", () => {
    for (let n = 0; n < 50; n++) {
      const flangeFromTcp = pose<"flange", "tcp">([any(0.2), any(0.2), 0.2], anyTurn());
      const fixed: Vector3 = [any(2), any(2), 0.4];
      const touchWith = (inTcp: Vector3): Pose<"base", "flange"> => {
        const q = anyTurn();
        const inFlange = rotate(q, transformPoint(flangeFromTcp, inTcp));
        return pose([fixed[0] - inFlange[0], fixed[1] - inFlange[1], fixed[2] - inFlange[2]], q);
      };
      const answer = tcpOrientation(flangeFromTcp.position, fixed, touchWith([0.1, 0, 0]), touchWith([0.03, 0.12, 0]));
      if (answer.kind !== "frame") throw new Error(answer.sentence);
      expect(angleBetween(answer.intoFromFrame.quaternion, flangeFromTcp.quaternion)).toBeLessThan(1e-9);
      expect(distance(answer.intoFromFrame.position, flangeFromTcp.position)).toBe(0);
    }
  });
});

describe("frame from three points", () => {
  test("is the frame the points were taken from, and says how far from square they are", () => {
    for (let n = 0; n < 100; n++) {
      const baseFromFrame = pose<"base", "frame">([any(3), any(3), any(1)], anyTurn());
      const off: Vector3 = [0.05 * (n % 3), 0.3, 0];
      const answer = frameFromThreePoints(
        baseFromFrame.position,
        transformPoint(baseFromFrame, [0.4, 0, 0]),
        transformPoint(baseFromFrame, off),
      );
      if (answer.kind !== "frame") throw new Error(answer.sentence);
      expect(angleBetween(answer.intoFromFrame.quaternion, baseFromFrame.quaternion)).toBeLessThan(1e-12);
      expect(answer.offSquare_rad).toBeCloseTo(Math.atan2(off[0], off[1]), 9);
      expect(answer.alongX_m).toBeCloseTo(0.4, 12);
    }
    expect(frameFromThreePoints([0, 0, 0], [1, 0, 0], [0.1, 1, 0]).sentence).toBe(
      "The two directions are 84.29° apart; square would be 90.00°.",
    );
  });

  test("points in one line, on one spot or without numbers are refused with a sentence", () => {
    expect(frameFromThreePoints([0, 0, 0], [1, 0, 0], [-2, 0.01, 0])).toMatchObject({
      kind: "in-line",
      sentence: "The three points open 0.3°; a plane needs 5°.",
    });
    expect(frameFromThreePoints([0, 0, 0], [0.001, 0, 0], [0, 1, 0])).toMatchObject({
      kind: "too-near",
      which: "x",
      sentence: "The point on +x is 1.0 mm from the origin; 5 mm are the least.",
    });
    expect(frameFromThreePoints([0, 0, 0], [1, 0, 0], [0, 0, 0])).toMatchObject({ kind: "too-near", which: "plane" });
    expect(frameFromThreePoints([0, 0, 0], [Infinity, 0, 0], [0, 1, 0])).toMatchObject({ kind: "not-a-point" });
  });
});

describe("registration by known points", () => {
  test("T-64 agrees with SciPy's Kabsch, in turn, place and registration error, and never mirrors", () => {
    expect(golden.registrations.length).toBe(30);
    for (const { known, measured, matrix, position, rms_m } of golden.registrations) {
      const answer = registerPoints(known.map((point, i) => ({ known: point, measured: measured[i]! })));
      if (answer.kind !== "registered") throw new Error(answer.sentence);
      expect(angleBetween(answer.intoFromFrame.quaternion, fromMatrix(matrix))).toBeLessThan(1e-9);
      expect(distance(answer.intoFromFrame.position, position)).toBeLessThan(1e-9);
      expect(Math.abs(answer.residual.rms_m - rms_m)).toBeLessThan(1e-9);
      expect(determinant(toMatrix(answer.intoFromFrame.quaternion))).toBeCloseTo(1, 12);
    }
  });

  test("points seen in a mirror come out as a turn with a residual, not as a mirror", () => {
    const known: Vector3[] = [
      [0, 0, 0],
      [0.4, 0, 0],
      [0, 0.3, 0],
      [0, 0, 0.2],
    ];
    const answer = registerPoints(known.map(point => ({ known: point, measured: [-point[0], point[1], point[2]] })));
    if (answer.kind !== "registered") throw new Error(answer.sentence);
    expect(determinant(toMatrix(answer.intoFromFrame.quaternion))).toBeCloseTo(1, 12);
    expect(answer.residual.rms_m).toBeGreaterThan(0.03);
  });

  test("two frames of the same points undo each other", () => {
    const known = Array.from({ length: 5 }, (): Vector3 => [any(1), any(1), any(1)]);
    const into = pose<"into", "frame">([any(2), any(2), any(2)], anyTurn());
    const pairs = known.map(point => ({ known: point, measured: transformPoint(into, point) }));
    const there = registerPoints(pairs);
    const back = registerPoints(pairs.map(pair => ({ known: pair.measured, measured: pair.known })));
    if (there.kind !== "registered" || back.kind !== "registered") throw new Error("Five points in space are enough.");
    const round = compose(
      there.intoFromFrame,
      pose<"frame", "into">(back.intoFromFrame.position, back.intoFromFrame.quaternion),
    );
    expect(distance(round.position, [0, 0, 0])).toBeLessThan(1e-12);
    expect(distance(inverse(into).position, back.intoFromFrame.position)).toBeLessThan(1e-12);
  });

  test("too few points, points in one line and no numbers are refused with a sentence", () => {
    const same = (points: Vector3[]) => registerPoints(points.map(point => ({ known: point, measured: point })));
    expect(
      same([
        [0, 0, 0],
        [1, 0, 0],
      ]),
    ).toMatchObject({ kind: "too-few", sentence: "3 points are the least; 2 were given." });
    expect(
      same([
        [0, 0, 0],
        [1, 0, 0],
        [2, 0.001, 0],
      ]),
    ).toMatchObject({ kind: "in-line" });
    expect(
      same([
        [0, 0, 0],
        [1, 0, 0],
        [2, NaN, 0],
      ]),
    ).toMatchObject({ kind: "not-a-point", sentence: "A coordinate of point 3 is not a finite number." });
  });
});

test("eigenvalues are in order, their vectors square to each other, and together they are the matrix", () => {
  for (let n = 0; n < 200; n++) {
    const size = 2 + (n % 4);
    const root = Array.from({ length: size * size }, () => any(2));
    const A = Array.from({ length: size * size }, (_, at) =>
      Array.from(
        { length: size },
        (__, k) => root[Math.trunc(at / size) * size + k]! * root[(at % size) * size + k]!,
      ).reduce((sum, value) => sum + value, 0),
    );
    const { values, vectors } = symmetricEigen(A);
    for (let i = 1; i < size; i++) expect(values[i]!).toBeLessThanOrEqual(values[i - 1]!);
    for (let i = 0; i < size; i++)
      for (let j = 0; j < size; j++) {
        expect(values.reduce((sum, value, k) => sum + value * vectors[k]![i]! * vectors[k]![j]!, 0)).toBeCloseTo(
          A[i * size + j]!,
          12,
        );
        expect(vectors[i]!.reduce((sum, value, k) => sum + value * vectors[j]![k]!, 0)).toBeCloseTo(
          i === j ? 1 : 0,
          12,
        );
      }
  }
});

/** Box–Muller. */
function gaussian(): number {
  return Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
}
