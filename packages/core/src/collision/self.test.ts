import { describe, expect, test } from "vitest";
import {
  boxMesh,
  CellCollider,
  checkJointLine,
  checkMotion,
  distance,
  identity,
  linkPoses,
  linkSolids,
  norm,
  pose,
  robotById,
  seededRandom,
  sphereMesh,
  transformMesh,
  type CellGeometry,
  type Contact,
  type Pose,
  type Robot,
  type Vector3,
} from "../index.ts";
import { closestOn, trianglesOf } from "./testing/oracles.ts";
import { box, planarArm, planarCell } from "./testing/test-arm.ts";

const ur10e = robotById("ur10e")!;
const UPPER = [3, 4, 5, 6];
const LOWER = [0, 1, 2];
const NAMES = ["base", "shoulder", "upper arm", "lower arm", "wrist 1", "wrist 2", "wrist 3"];
const groupPairs = UPPER.flatMap(upper => LOWER.map(lower => [lower, upper] as const)).filter(
  ([lower, upper]) => upper - lower > 1,
);
const cellOf = (robot: Robot, more: Partial<CellGeometry> = {}): CellGeometry => ({
  worldFromBase: pose(),
  links: linkSolids(robot),
  objects: [],
  allowedPairs: [],
  shapeError_m: robot.shapeError_m,
  ...more,
});
const posesAt = (q: readonly number[]): Pose[] => {
  const poses = Array.from({ length: ur10e.arm.joints.length + 1 }, () => identity<"base", "link">());
  linkPoses(ur10e.arm, q, poses);
  return poses as Pose[];
};
const key = ({ a, b }: Contact): string => [a, b].sort().join(" / ");
const randomConfiguration = ({ arm }: Robot, random: () => number): number[] =>
  arm.joints.map(({ limits: { lower_rad, upper_rad } }) => lower_rad + random() * (upper_rad - lower_rad));

describe("X-13 UR10e: the upper group (lower arm, three wrists) stops at the lower group (base, shoulder, upper arm)", () => {
  test("that is 11 pairs, and all of them are watched", () => {
    expect(groupPairs.length).toBe(11);
    const watched = new Set(new CellCollider(cellOf(ur10e), ur10e.arm).pairs.map(({ contact }) => key(contact)));
    for (const [lower, upper] of groupPairs) expect(watched).toContain(`link ${lower} / link ${upper}`);
  });

  // Some of these can hardly meet with the maker's castings. A ball on either link, large enough to close the gap,
  // makes them.
  test.each(groupPairs.map(([lower, upper]) => [NAMES[lower]!, NAMES[upper]!, lower, upper] as const))(
    "%s and %s",
    (_, __, lower, upper) => {
      const random = seededRandom(31);
      const q = randomConfiguration(ur10e, random);
      const poses = posesAt(q);
      const gap_m = norm(poses[upper]!.position.map((v, k) => v - poses[lower]!.position[k]!) as Vector3);
      const cell = (radius_m: number): CellGeometry =>
        cellOf(ur10e, {
          links: [lower, upper].map(link => ({ link, name: NAMES[link]!, mesh: sphereMesh(radius_m) })),
        });
      expect(new CellCollider(cell(0.49 * gap_m), ur10e.arm).check(q)).toEqual([]);
      expect(new CellCollider(cell(0.52 * gap_m), ur10e.arm).check(q)).toEqual([
        { a: `link ${lower}`, b: `link ${upper}`, between: "self" },
      ]);
    },
  );

  test("the arm folding onto itself is stopped before it gets there, by a pair of the two groups", () => {
    const folded = [0, -1.6, 3.1, 0, 0, 0];
    const collider = new CellCollider(cellOf(ur10e), ur10e.arm);
    const verdict = checkJointLine(collider, ur10e.home_rad, folded);
    if (verdict.kind !== "contact") throw new Error(verdict.kind);
    expect(verdict.between).toBe("self");
    expect(groupPairs.map(([lower, upper]) => `link ${lower} / link ${upper}`)).toContain(key(verdict));
    expect(verdict.at).toBeGreaterThan(0.1);
  });
});

describe("X-14 connected parts never stop falsely", () => {
  test.each(["ur10e", "staubli_rx90l", "kuka_kr6_2"])("%s: no link meets the next one in 2,000 random postures", id => {
    const robot = robotById(id)!;
    const collider = new CellCollider(cellOf(robot), robot.arm);
    const random = seededRandom(32);
    let met = 0;
    for (let i = 0; i < 2000; i++)
      for (const { a, b } of collider.check(randomConfiguration(robot, random))) {
        met++;
        expect(Math.abs(Number(a.slice(5)) - Number(b.slice(5)))).toBeGreaterThan(1);
      }
    expect(met).toBeGreaterThan(10);
  });

  test("the upper arm and the lower arm of the UR10e at every angle of the elbow", () => {
    const collider = new CellCollider(cellOf(ur10e), ur10e.arm);
    for (let elbow = -3.1; elbow <= 3.1; elbow += 0.1) {
      expect(collider.check([0, -1.57, elbow, 0, 0, 0]).map(key)).not.toContain("link 2 / link 3");
    }
  });
});

describe("X-12 contact with itself and contact with others are different events", () => {
  const FOLDED = [0, 2.5, 2.5];
  const collider = new CellCollider(
    planarCell([box("wall", [0, 3.15, 0], [6, 0.1, 2]), box("cube", [0.5, 0.6, 0], [0.05, 0.05, 0.05])], {
      tool: { name: "torch", mesh: boxMesh([0.3, 0.02, 0.02]) },
    }),
    planarArm,
  );

  test("links among themselves, and the tool with a link: self", () => {
    expect(
      collider
        .check(FOLDED)
        .filter(({ between }) => between === "self")
        .map(key),
    ).toEqual(["link 1 / link 3"]);
    expect(collider.check([0, (2 * Math.PI) / 3, (2 * Math.PI) / 3]).find(({ b }) => b === "tool")?.between).toBe(
      "self",
    );
  });
  test("with a wall: other; the verdict on a motion says it too", () => {
    expect(collider.check([Math.PI / 2, 0, 0])).toEqual([{ a: "tool", b: "wall", between: "other" }]);
    expect(checkJointLine(collider, [0, 0, 0], [Math.PI / 2, 0, 0])).toMatchObject({
      kind: "contact",
      between: "other",
    });
    expect(checkJointLine(collider, [0, 0, 0], [0, 0, Math.PI])).toMatchObject({ kind: "contact", between: "self" });
  });
  test("a held object with a link of the robot that holds it: other", () => {
    collider.attach("cube", pose([0.02, 0, 0]));
    expect(
      collider
        .check([0, (2 * Math.PI) / 3, (2 * Math.PI) / 3])
        .some(({ a, b, between }) => between === "other" && [a, b].includes("cube")),
    ).toBe(true);
  });
});

describe("the shape error of the drawn links", () => {
  const still = (collider: CellCollider, margin_m: number): string =>
    checkMotion(
      collider,
      {
        sample: (_, out) => {
          out.set([0, 0.9 * Math.PI, 0]);
        },
        maxRate: [0, 0, 0],
      },
      0,
      1,
      { margin_m },
    ).kind;
  // Links 2 and 3 fold back over link 1's side: link 3's far end lies a known way off link 1.
  const gap_m = new CellCollider(planarCell([]), planarArm).clearance([0, 0.9 * Math.PI, 0], 10).distance_m;

  test("is not asked for between links: the margin alone counts there", () => {
    expect(gap_m).toBeGreaterThan(0.02);
    const collider = new CellCollider(planarCell([], { shapeError_m: 10 }), planarArm);
    expect(still(collider, gap_m - 1e-3)).toBe("clear");
    expect(still(collider, gap_m + 1e-3)).toBe("contact");
  });

  test("comes once between a link and an object, standing or held", () => {
    const beside = box("beside", [0, 0.3, 0], [0.1, 0.1, 0.1]);
    const standing = new CellCollider(planarCell([beside]), planarArm);
    const there_m = standing.clearance([0, 0, 0], 10, undefined, ({ b }) => b.kind === "object").distance_m;
    const verdict = (shapeError_m: number, margin_m: number): string =>
      checkJointLine(new CellCollider(planarCell([beside], { shapeError_m }), planarArm), [0, 0, 0], [0, 0, 0], {
        margin_m,
      }).kind;
    expect(verdict(0.02, there_m - 0.021)).toBe("clear");
    expect(verdict(0.02, there_m - 0.019)).toBe("contact");
    const holding = (shapeError_m: number): CellCollider => {
      const collider = new CellCollider(
        planarCell([beside], { shapeError_m }, transformMesh(boxMesh([0.5, 0.04, 0.04]), pose([0.3, 0, 0]))),
        planarArm,
      );
      collider.attach("beside", pose([0.1, 0, 0]));
      return collider;
    };
    const held_m = holding(0).clearance([0, 0, 2.4], 10).distance_m;
    const held = (shapeError_m: number, margin_m: number): string =>
      checkJointLine(holding(shapeError_m), [0, 0, 2.4], [0, 0, 2.4], {
        margin_m,
        keepsMargin: ({ a, b }) => a.kind === "object" || b.kind === "object",
      }).kind;
    expect(held(0, held_m - 1e-3)).toBe("clear");
    expect(held(0.02, held_m - 0.021)).toBe("clear");
    expect(held(0.02, held_m - 0.019)).toBe("contact");
  });
});

describe("a collider for every part: contact at the surface of the part's own mesh", () => {
  test.each(
    linkSolids(ur10e)
      .map(({ link }) => [NAMES[link]!, link] as const)
      .filter(([, link]) => link > 0),
  )("%s within 2 mm", (_, link) => {
    const q = ur10e.home_rad;
    const random = seededRandom(40 + link);
    const part = linkSolids(ur10e).find(solid => solid.link === link)!;
    const worldFromPart = posesAt(q)[link]!;
    // A ball comes in towards a corner of the part from three sides; a bisection finds where contact begins, and the
    // nearest point by another method tells where it should (triangles without area say nothing).
    const radius_m = 0.01;
    const net = transformMesh(part.mesh, pose(worldFromPart.position, worldFromPart.quaternion));
    const triangles = trianglesOf(net);
    const nearest_m = (point: Vector3): number =>
      Math.min(...triangles.map(triangle => distance(closestOn(point, triangle), point)).filter(d => !Number.isNaN(d)));
    const collider = new CellCollider(
      cellOf(ur10e, {
        links: [part],
        objects: [{ id: "ball", name: "Ball", worldFromObject: pose(), mesh: sphereMesh(radius_m, 48, 24) }],
      }),
      ur10e.arm,
    );
    for (let side = 0; side < 3; side++) {
      const way = [random() - 0.5, random() - 0.5, random() - 0.5] as Vector3;
      const length = norm(way);
      const corner = 3 * Math.floor((random() * net.positions.length) / 3);
      const aim = [...net.positions.slice(corner, corner + 3)];
      const at = (s: number): Vector3 => aim.map((v, k) => v + (s * way[k]!) / length) as Vector3;
      let free = 2;
      let touching = 0;
      const touches = (s: number): boolean => {
        collider.moveObject("ball", pose(at(s)));
        return collider.collides(q);
      };
      // From outside inwards in steps thinner than any part, then by halves.
      for (let s = 2; s > 0; s -= 0.01) {
        if (touches(s)) {
          touching = s;
          free = s + 0.01;
          break;
        }
      }
      expect(touching).toBeGreaterThan(0);
      for (let i = 0; i < 20; i++) {
        const half = (free + touching) / 2;
        if (touches(half)) touching = half;
        else free = half;
      }
      expect(Math.abs(nearest_m(at(free)) - radius_m)).toBeLessThan(0.002);
    }
  });
});
