import { describe, expect, test } from "vitest";
import {
  CellCollider,
  checkJointLine,
  LIBRARY,
  linkDesigns,
  linkSolids,
  boxMesh,
  meshBounds,
  pose,
  robotById,
  seededRandom,
  shapeDeviation,
  type Robot,
} from "@twincell/core";
import { vendorLinks } from "./vendor.ts";

const SAMPLES = 400;

describe.each(LIBRARY.filter(({ form }) => form !== undefined).map(robot => [robot.id, robot] as const))(
  "%s",
  (id, robot) => {
    const links = vendorLinks(id);
    test.skipIf(links === null)(
      "T-64 the drawn links, grown by the stored shape error, enclose the published meshes and stand out by no more (the meshes are not beside this checkout when skipped)",
      () => {
        // What is drawn lies inside the solids of the collision check (robots/shapes/shapes.test.ts): enclosing with it
        // is enclosing with them.
        linkDesigns(robot).forEach(({ parts }, link) => {
          const drawn = shapeDeviation(
            parts.map(({ mesh }) => mesh),
            links![link]!,
            SAMPLES,
            seededRandom(link + 1),
          );
          expect(drawn.trueOutsideDrawn_m, `link ${link}`).toBeLessThanOrEqual(robot.shapeError_m);
          expect(drawn.drawnOutsideTrue_m, `link ${link}`).toBeLessThanOrEqual(robot.shapeError_m);
        });
      },
    );
  },
);

test("a published mesh that were 30 mm larger would not be enclosed", context => {
  const links = vendorLinks("yaskawa_gp8");
  const robot = robotById("yaskawa_gp8")!;
  if (links === null) {
    context.skip("the meshes are not beside this checkout");
    return;
  }
  const { lower, upper } = meshBounds(links[2]!);
  const middle = [0, 1, 2].map(k => (lower[k]! + upper[k]!) / 2);
  const larger = {
    positions: links[2]!.positions.map(
      (value, i) => middle[i % 3]! + (value - middle[i % 3]!) * (1 + 0.06 / (upper[i % 3]! - lower[i % 3]!)),
    ),
    indices: links[2]!.indices,
  };
  expect(
    shapeDeviation(linkDesigns(robot)[2]!.shells, larger, SAMPLES, seededRandom(1)).trueOutsideDrawn_m,
  ).toBeGreaterThan(robot.shapeError_m);
});

test("T-64 the shape error comes on top of every clearance margin between links and objects", () => {
  const robot = robotById("yaskawa_gp8")!;
  const tip = 0.04 + 0.34 + 0.08;
  const gap_m = 0.05;
  const wall = {
    id: "wall",
    name: "wall",
    worldFromObject: pose<"world", "object">([tip + gap_m + 0.05, 0, 0.715]),
    mesh: boxMesh([0.1, 1, 1]),
  };
  const verdict = (one: Robot, margin_m: number): string =>
    checkJointLine(
      new CellCollider(
        {
          worldFromBase: pose(),
          links: linkSolids(one),
          objects: [wall],
          allowedPairs: [],
          shapeError_m: one.shapeError_m,
        },
        one.arm,
      ),
      [0, 0, 0, 0, 0, 0],
      [0, 0, 0, 0, 0, 0.5],
      { margin_m, keepsMargin: ({ contact }) => contact.a === "wall" || contact.b === "wall" },
    ).kind;
  // The gap is 50 mm less what the flange stands out: a margin just below it is kept by an exact shape and not by ours.
  expect(verdict({ ...robot, shapeError_m: 0 }, 0.04)).toBe("clear");
  expect(verdict({ ...robot, shapeError_m: 0.015 }, 0.04)).toBe("contact");
  expect(verdict({ ...robot, shapeError_m: 0.015 }, 0.02)).toBe("clear");
});
