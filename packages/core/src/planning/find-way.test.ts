import { describe, expect, test } from "vitest";
import {
  boxMesh,
  CellCollider,
  certifyMotion,
  checkJointLine,
  findPath,
  jointLine,
  lengthOf,
  linkSolids,
  pose,
  robotById,
  seededRandom,
  shorten,
  transformMesh,
  verifyCertificate,
  PathValidator,
  type CellGeometry,
  type SerialArm,
  type PathOutcome,
} from "../index.ts";
import { box, planarArm, planarCell } from "../collision/testing/test-arm.ts";

/** A post beside the arm that the outer bars must fold to get past. */
const POST = box("post", [1.6, 0, 0], [0.1, 0.1, 0.2]);
const FROM = [-0.6, 0, 0];
const TO = [0.6, 0, 0];
const checkerOf = (objects = [POST], margin_m = 0): PathValidator =>
  new PathValidator(new CellCollider(planarCell(objects), planarArm), planarArm, { margin_m });
const wayOf = (outcome: PathOutcome): readonly Float64Array[] => {
  if (outcome.kind !== "found") throw new Error(outcome.kind);
  return outcome.way;
};

/** The second proof, in a cell made anew: nothing of the search is trusted. */
function confirmed(cell: CellGeometry, arm: SerialArm, way: readonly Float64Array[]): boolean {
  return way.slice(1).every((to, i) => {
    const motion = jointLine(way[i]!, to);
    const { certificate } = certifyMotion(new CellCollider(cell, arm), motion, 0, 1);
    return (
      certificate !== null &&
      verifyCertificate(new CellCollider(cell, arm), arm, motion, certificate).kind === "confirmed"
    );
  });
}

describe("a way from one posture to another that touches nothing", () => {
  test("goes round a post that the straight line meets, and a second proof confirms every line of it", () => {
    expect(checkJointLine(checkerOf().collider, FROM, TO).kind).toBe("contact");
    const way = wayOf(findPath(checkerOf(), FROM, TO, { seed: 3 }));
    expect([...way[0]!]).toEqual(FROM);
    expect([...way.at(-1)!]).toEqual(TO);
    expect(way.length).toBeGreaterThan(2);
    expect(confirmed(planarCell([POST]), planarArm, way)).toBe(true);
  });

  test("is the straight line where that is free", () => {
    expect(wayOf(findPath(checkerOf([]), FROM, TO)).length).toBe(2);
  });

  test("the same seed gives the same way, also from a checker that has worked before", () => {
    const fresh = findPath(checkerOf(), FROM, TO, { seed: 5 });
    const used = checkerOf();
    for (let seed = 10; seed < 14; seed++) findPath(used, FROM, TO, { seed });
    expect(findPath(used, FROM, TO, { seed: 5 })).toEqual(fresh);
    expect(wayOf(findPath(used, FROM, TO, { seed: 6 }))).not.toEqual(wayOf(fresh));
  });

  test("keeps the margin asked for, and says so of an end that does not", () => {
    const way = wayOf(findPath(checkerOf([POST], 0.05), FROM, TO, { seed: 3 }));
    const { collider } = checkerOf();
    for (let i = 1; i < way.length; i++)
      for (let t = 0; t <= 1; t += 0.02) {
        expect(
          collider.clearance(
            way[i]!.map((q, k) => way[i - 1]![k]! + t * (q - way[i - 1]![k]!)),
            1,
            undefined,
            ({ b }) => b.kind === "object",
          ).distance_m,
        ).toBeGreaterThan(0.05);
      }
    expect(findPath(checkerOf([box("near", [2, 0.06, 0], [0.1, 0.01, 0.1])], 0.05), [0, 0, 0], TO)).toMatchObject({
      kind: "blocked",
      end: "start",
      contact: { b: "near" },
    });
  });

  test.each([20, 21, 22, 23, 24, 25])("plates 0.1 mm thin are never stepped through (seed %i)", seed => {
    // A fence of thin plates across the outer bars' way, with a gap below it.
    const fence = [0.25, 0.35, 0.45].map((angle, i) => ({
      ...box(`plate ${i}`, [0, 0, 0], [1.2, 0.0001, 0.2]),
      worldFromObject: pose<"world", "object">(
        [2.3 * Math.cos(angle), 2.3 * Math.sin(angle), 0],
        [0, 0, Math.sin(angle / 2), Math.cos(angle / 2)],
      ),
    }));
    expect(checkJointLine(checkerOf(fence).collider, FROM, TO).kind).toBe("contact");
    const way = wayOf(findPath(checkerOf(fence), FROM, TO, { seed }));
    expect(confirmed(planarCell(fence), planarArm, way)).toBe(true);
  });
});

describe("why there is no way", () => {
  test("an end in contact is named with both solids, an end outside the limits with the joint", () => {
    expect(findPath(checkerOf(), [0, 0, 0], TO)).toEqual({
      kind: "blocked",
      end: "start",
      contact: { a: "link 2", b: "post", between: "other" },
    });
    expect(findPath(checkerOf(), FROM, [0, 0, 0])).toMatchObject({ kind: "blocked", end: "goal" });
    expect(findPath(checkerOf(), [0, 3.1, 0], TO)).toMatchObject({
      kind: "blocked",
      end: "start",
      contact: { between: "self" },
    });
    expect(findPath(checkerOf(), FROM, [0, -4.5, 0])).toEqual({
      kind: "outside-limits",
      end: "goal",
      joint: 2,
      wanted_rad: -4.5,
      limit_rad: -4,
    });
    expect(findPath(checkerOf(), [NaN, 0, 0], TO)).toMatchObject({ kind: "outside-limits", end: "start", joint: 1 });
  });

  // The first bar is shut in between two posts: no posture beyond them can be reached.
  const shut = [box("left", [0.7, 0.55, 0], [0.15, 0.15, 0.3]), box("right", [0.7, -0.55, 0], [0.15, 0.15, 0.3])];
  const OUT = [2.5, 0, 0];

  test("a goal that is shut in is given up with the looks that were spent", () => {
    const answer = findPath(checkerOf(shut), [0, 0, 0], OUT, { maxLooks: 3000 });
    expect(answer).toMatchObject({ kind: "not-found" });
    expect(answer.kind === "not-found" && answer.looks >= 3000 && answer.looks < 4000).toBe(true);
  });

  test("time runs out by the clock it is given; progress grows to the end", () => {
    const shares: number[] = [];
    let now_s = 100;
    expect(
      findPath(checkerOf(shut), [0, 0, 0], OUT, {
        now_s: () => (now_s += 0.1),
        within_s: 2,
        onProgress: share => shares.push(share),
      }),
    ).toMatchObject({ kind: "not-found", within_s: 2 });
    expect(shares.length).toBeGreaterThan(5);
    expect(shares.every((share, i) => share <= 1 && share >= (shares[i - 1] ?? 0))).toBe(true);
    expect(shares.at(-1)).toBe(1);
  });

  test("cancelled, it stops at the next question", () => {
    let asked = 0;
    const answer = findPath(checkerOf(shut), [0, 0, 0], OUT, { cancelled: () => ++asked >= 3 });
    expect(answer.kind).toBe("cancelled");
    expect(asked).toBe(3);
  });
});

test("a UR10e reaches between two shelves from 30 seeded postures without contact, proven a second time", () => {
  const robot = robotById("ur10e")!;
  const random = seededRandom(77);
  const cell: CellGeometry = {
    worldFromBase: pose(),
    links: linkSolids(robot),
    tool: { name: "pen", mesh: transformMesh(boxMesh([0.02, 0.02, 0.12]), pose([0, 0, 0.08])) },
    allowedPairs: [],
    shapeError_m: 0,
    objects: [
      box("floor", [0, 0, -0.1], [3, 3, 0.1]),
      box("shelf", [0.75, 0, 0.35], [0.5, 0.9, 0.02]),
      box("upper", [0.75, 0, 0.95], [0.5, 0.9, 0.02]),
      box("post", [0.2, 0.7, 0.5], [0.1, 0.1, 1]),
    ],
  };
  const checker = new PathValidator(new CellCollider(cell, robot.arm), robot.arm);
  const goal = robot.home_rad;
  expect(checker.inTheWay(goal)).toBe(null);
  let turned = 0;
  let tried = 0;
  while (tried < 30) {
    const q = robot.arm.joints.map(() => (2 * random() - 1) * 2.8);
    if (!checker.free(q)) continue;
    tried++;
    const way = wayOf(findPath(checker, q, goal, { seed: tried }));
    if (way.length > 2) turned++;
    if (tried % 6 === 0) expect(confirmed(cell, robot.arm, way)).toBe(true);
  }
  expect(turned).toBeGreaterThan(3);
});

test("shortening never lengthens, keeps the ends, and a line straight from end to end was allowed", () => {
  const random = seededRandom(8);
  for (let i = 0; i < 200; i++) {
    const way = Array.from({ length: 2 + Math.floor(random() * 8) }, () =>
      Float64Array.from({ length: 4 }, () => random() * 4 - 2),
    );
    const allowed = new Set<string>(way.slice(1).map((q, k) => `${way[k]!.join()} ${q.join()}`));
    const short = shorten(way, (a, b) => random() < 0.4 && allowed.add(`${a.join()} ${b.join()}`).size > 0, random);
    expect(lengthOf(short)).toBeLessThanOrEqual(lengthOf(way) + 1e-9);
    expect(short[0]).toEqual(way[0]);
    expect(short.at(-1)).toEqual(way.at(-1));
    if (short.length === 2) expect(allowed).toContain(`${short[0]!.join()} ${short[1]!.join()}`);
  }
});
