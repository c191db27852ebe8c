import { describe, expect, test } from "vitest";
import {
  boxMesh,
  CellCollider,
  checkJointLine,
  checkMotion,
  fromAxisAngle,
  LIBRARY,
  pose,
  seededRandom,
  SolidCache,
  sphereMesh,
  transformMesh,
  type CellObject,
  type Contact,
} from "../index.ts";
import { box, planarArm, planarCell } from "./testing/test-arm.ts";

const names = (contacts: readonly Contact[]): string[] => contacts.map(({ a, b }) => `${a} / ${b}`);
const STRAIGHT = [0, 0, 0];
const LEFT = Math.PI / 2;
const FOLDED = [0, 2.5, 2.5];

describe("N-68 links, tool and every object around are watched, and each alert names its solids", () => {
  const collider = new CellCollider(
    planarCell(
      [
        box("wall", [0, 3.15, 0], [6, 0.1, 2]),
        box("box", [2.5, -0.5, 0], [0.2, 0.2, 0.2]),
        box("table", [0, 0, -0.15], [6, 6, 0.1]),
      ],
      { tool: { name: "torch", mesh: boxMesh([0.3, 0.02, 0.02]) } },
    ),
    planarArm,
  );

  test("nothing at rest", () => {
    expect(collider.check(STRAIGHT)).toEqual([]);
  });
  test("wall", () => {
    expect(names(collider.check([LEFT, 0, 0]))).toEqual(["tool / wall"]);
  });
  test("box", () => {
    expect(names(collider.check([-0.19, 0, 0]))).toEqual(["link 3 / box"]);
  });
  test("table, sunk into the arm", () => {
    collider.moveObject("table", pose([0, 0, -0.065]));
    expect(names(collider.check(STRAIGHT))).toEqual(["link 1 / table", "link 2 / table", "link 3 / table"]);
    collider.moveObject("table", pose([0, 0, -0.15]));
    expect(collider.check(STRAIGHT)).toEqual([]);
  });
  test("collides says the same in the same posture", () => {
    const random = seededRandom(21);
    let bad = 0;
    for (let i = 0; i < 500; i++) {
      const q = [random() * 6 - 3, random() * 6 - 3, random() * 6 - 3];
      const found = collider.check(q).length > 0;
      expect(collider.collides(q)).toBe(found);
      if (found) bad++;
    }
    expect(bad).toBeGreaterThan(20);
    expect(bad).toBeLessThan(450);
  });
});

describe("X-13 the robot with itself", () => {
  const collider = new CellCollider(planarCell([], { tool: { name: "ball", mesh: sphereMesh(0.1) } }), planarArm);

  test("parts two links apart alert, neighbours do not", () => {
    expect(collider.check(STRAIGHT)).toEqual([]);
    // Folded: bar 3 crosses bar 1.
    expect(names(collider.check(FOLDED))).toEqual(["link 1 / link 3"]);
    expect(names(collider.check([0, (2 * Math.PI) / 3, (2 * Math.PI) / 3]))).toContain("link 0 / tool");
  });

  test("allowed pairs and what is learnt at home alert no more", () => {
    const allowing = new CellCollider(planarCell([], { allowedPairs: [["link 3", "link 1"]] }), planarArm);
    expect(allowing.check(FOLDED)).toEqual([]);
    const learning = new CellCollider(planarCell([]), planarArm);
    expect(names(learning.allowContactsAt(FOLDED))).toEqual(["link 1 / link 3"]);
    expect(learning.check(FOLDED)).toEqual([]);
    expect(learning.allowContactsAt(STRAIGHT)).toEqual([]);
  });
});

describe("clearance", () => {
  const collider = new CellCollider(
    planarCell([box("near", [2.5, 0.32, 0], [0.2, 0.2, 0.2]), box("far", [0.5, -2, 0], [0.2, 0.2, 0.2])]),
    planarArm,
  );

  test("names the nearest pair, its distance and its points in the world", () => {
    const found = collider.clearance(STRAIGHT, 1);
    expect([found.a, found.b]).toEqual(["link 3", "near"]);
    expect(found.distance_m).toBeCloseTo(0.2, 12);
    expect(found.pointA[1]).toBeCloseTo(0.02, 12);
    expect(found.pointB[1]).toBeCloseTo(0.22, 12);
  });

  test("is Infinity beyond the cut-off and 0 in contact", () => {
    expect(collider.clearance(STRAIGHT, 0.19)).toMatchObject({ distance_m: Infinity, a: "", b: "" });
    expect(collider.clearance([0.13, 0, 0], 1).distance_m).toBe(0);
    expect(names(collider.near(STRAIGHT, 0.21))).toEqual(["link 3 / near"]);
    expect(collider.near(STRAIGHT, 0.2 - 1e-9)).toEqual([]);
  });

  test("follows the base", () => {
    const moved = new CellCollider(
      planarCell([box("near", [0, 1.3, 0.5], [0.2, 0.2, 0.2])], {
        worldFromBase: pose([0, -1.5, 0.5], fromAxisAngle([0, 0, 1], LEFT)),
      }),
      planarArm,
    );
    expect(names(moved.check(STRAIGHT))).toEqual(["link 3 / near"]);
  });
});

describe("objects come, go and are gripped", () => {
  test("added, moved, removed", () => {
    const collider = new CellCollider(planarCell([]), planarArm);
    const cube: CellObject = box("cube", [1.5, 0, 0], [0.1, 0.1, 0.1]);
    collider.setObject(cube);
    expect(names(collider.check(STRAIGHT))).toEqual(["link 2 / cube"]);
    collider.setObject({ ...cube, worldFromObject: pose([1.5, 1, 0]) });
    expect(collider.check(STRAIGHT)).toEqual([]);
    collider.moveObject("cube", pose([2.5, 0, 0]));
    expect(names(collider.check(STRAIGHT))).toEqual(["link 3 / cube"]);
    collider.removeObject("cube");
    expect(collider.check(STRAIGHT)).toEqual([]);
  });

  test("a gripped object no longer meets its gripper, but meets the wall it is carried to", () => {
    const wall = box("wall", [0, 3.2, 0], [6, 0.1, 2]);
    const cube = box("cube", [3.05, 0, 0], [0.12, 0.1, 0.1]);
    const collider = new CellCollider(planarCell([wall, cube]), planarArm);
    expect(names(collider.check(STRAIGHT))).toEqual(["link 3 / cube"]);
    collider.attach("cube", pose([0.1, 0, 0]));
    expect(collider.check(STRAIGHT)).toEqual([]);
    expect(names(collider.check([LEFT, 0, 0]))).toEqual(["wall / cube"]);
    collider.detach("cube", pose([0, 2, 0]));
    expect(names(collider.check([LEFT, 0, 0]))).toEqual(["link 2 / cube", "link 3 / cube"]);
  });

  test("trees are built once for a mesh", () => {
    const solidCache = new SolidCache();
    const mesh = sphereMesh(0.1);
    expect(solidCache.of(mesh)).toBe(solidCache.of(mesh));
  });
});

test("N-51 the tool touches a work piece at 0.5 mm, also one it may touch", () => {
  const cell = (gap_m: number) =>
    new CellCollider(
      planarCell([box("carton", [3.2 + gap_m, 0, 0], [0.2, 0.2, 0.2])], {
        tool: { name: "pin", mesh: transformMesh(boxMesh([0.1, 0.01, 0.01]), pose([0.05, 0, 0])) },
        allowedPairs: [["tool", "carton"]],
      }),
      planarArm,
    );
  expect(cell(0.00051).touches(STRAIGHT)).toEqual([]);
  expect(cell(0.00049).touches(STRAIGHT)).toEqual(["carton"]);
  expect(cell(-0.01).touches(STRAIGHT)).toEqual(["carton"]);
  expect(cell(-0.01).check(STRAIGHT)).toEqual([]);
});

describe("whole motions", () => {
  test("T-42 a plate 0.1 mm thin between two samples stops a fast move at the analytic angle", () => {
    const collider = new CellCollider(planarCell([box("plate", [0, 2.9, 0], [0.0001, 0.1, 1])]), planarArm);
    expect(collider.check([0, 0, 0])).toEqual([]);
    expect(collider.check([Math.PI, 0, 0])).toEqual([]);
    const verdict = checkJointLine(collider, [0, 0, 0], [Math.PI, 0, 0]);
    if (verdict.kind !== "contact") throw new Error(verdict.kind);
    expect([verdict.a, verdict.b]).toEqual(["link 3", "plate"]);
    // The leading side of the bar is the line y' = 0.02 of the turned frame; it meets the plate's near edge at the far
    // end.
    const radius = Math.hypot(2.95, 0.00005);
    const angle = Math.atan2(2.95, 0.00005) - Math.asin(0.02 / radius);
    expect(verdict.at * Math.PI).toBeGreaterThan(angle - 3e-4);
    expect(verdict.at * Math.PI).toBeLessThan(angle + 3e-4);
  });

  test("a motion past an obstacle is proven clear, but not with a margin that is too wide, nor with the shape error", () => {
    const plate = box("plate", [0, 3.02, 0], [0.5, 0.02, 1]);
    const past = (shapeError_m: number, margin_m: number) =>
      checkJointLine(new CellCollider(planarCell([plate], { shapeError_m }), planarArm), [0, 0, 0], [Math.PI, 0, 0], {
        margin_m,
      }).kind;
    // The end of the bar swings at hypot(2.99, 0.02) = 2.990067 m; the plate begins at 3.01 m.
    expect(past(0, 0)).toBe("clear");
    expect(past(0, 0.019)).toBe("clear");
    expect(past(0, 0.0205)).toBe("contact");
    expect(past(0.005, 0.015)).toBe("contact");
    expect(past(0.005, 0)).toBe("clear");
  });

  test("the verdict agrees with dense sampling on random moves, and the first contact is the first", () => {
    const random = seededRandom(22);
    const objects = [box("a", [1.8, 1.2, 0], [0.3, 0.3, 0.3]), box("b", [-1.5, -1, 0], [0.5, 0.02, 0.5])];
    const collider = new CellCollider(planarCell(objects), planarArm);
    const verdicts = { clear: 0, contact: 0 };
    for (let i = 0; i < 60; i++) {
      const from = [0, 1, 2].map(() => random() * 4 - 2);
      const to = from.map(q => q + random() * 2 - 1);
      const verdict = checkJointLine(collider, from, to);
      let first = Infinity;
      for (let s = 0; s <= 2000 && first === Infinity; s++)
        if (collider.collides(from.map((q, k) => q + ((to[k]! - q) * s) / 2000))) first = s / 2000;
      if (verdict.kind === "undecided") throw new Error("undecided");
      verdicts[verdict.kind]++;
      if (verdict.kind === "clear") expect(first).toBe(Infinity);
      else {
        expect(verdict.at).toBeLessThanOrEqual(first + 1e-3);
        if (verdict.distance_m === 0 && first < Infinity) expect(verdict.at).toBeGreaterThan(first - 2e-3);
        expect(verdict.distance_m).toBeLessThan(0.0005);
      }
    }
    expect(verdicts.clear).toBeGreaterThan(5);
    expect(verdicts.contact).toBeGreaterThan(5);
  });

  test("a start in contact is contact at the start, a limit on checks is said", () => {
    const collider = new CellCollider(planarCell([box("cube", [2.5, 0, 0], [0.1, 0.1, 0.1])]), planarArm);
    expect(checkJointLine(collider, [0, 0, 0], [1, 0, 0])).toMatchObject({ kind: "contact" });
    const from = checkJointLine(collider, [0, 0, 0], [1, 0, 0]);
    expect(from.kind === "contact" && from.at).toBeLessThan(1e-3);
    expect(checkJointLine(collider, [0.5, 0, 0], [-0.5, 0, 0], { maxChecks: 3 })).toMatchObject({
      kind: "undecided",
      checks: 3,
    });
  });

  test("curved motions are checked from their speed bound", () => {
    const collider = new CellCollider(planarCell([box("cube", [2.5, 0.5, 0], [0.1, 0.1, 0.1])]), planarArm);
    const swing = (reach: number) =>
      checkMotion(
        collider,
        {
          sample: (t, out) => {
            out.fill(0);
            out[0] = reach * Math.sin(t);
          },
          maxRate: [reach, 0, 0],
        },
        0,
        2 * Math.PI,
      ).kind;
    expect(swing(0.15)).toBe("clear");
    expect(swing(0.25)).toBe("contact");
  });
});

test("bounds on how far points are from axes hold for every posture of a real arm", () => {
  const robot = LIBRARY.find(({ id }) => id === "staubli_rx90l")!;
  const n = robot.arm.joints.length;
  const links = Array.from({ length: n + 1 }, (_, link) => ({
    link,
    name: "",
    mesh: transformMesh(boxMesh([0.1, 0.1, 0.3]), pose([0.02, 0, 0.1])),
  }));
  const collider = new CellCollider(
    { worldFromBase: pose(), links, objects: [box("cube", [0, 0, 9], [1, 1, 1])], allowedPairs: [], shapeError_m: 0 },
    robot.arm,
  );
  const random = seededRandom(23);
  const step = 1e-4;
  for (let i = 0; i < 100; i++) {
    const q = robot.home_rad.map(() => random() * 6 - 3);
    const k = i % n;
    const corner = (pair: (typeof collider.pairs)[number]): number[] => Array.from(pair.a.worldFromBody.slice(9));
    collider.place(q);
    const before = collider.pairs.map(corner);
    collider.place(q.map((v, j) => (j === k ? v + step : v)));
    collider.pairs.forEach((pair, p) => {
      const moved = Math.hypot(...corner(pair).map((v, c) => v - before[p]![c]!));
      expect(moved).toBeLessThanOrEqual(step * (pair.a.reach_m[k] ?? 0) + 1e-12);
    });
  }
});
