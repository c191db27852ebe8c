import { describe, expect, test } from "vitest";
import type { TriangleMesh } from "../../mesh/mesh.ts";
import { linkPoses } from "../../kinematics/forward.ts";
import { identity, transformPoint } from "../../spatial/pose.ts";
import type { Vector3 } from "../../spatial/vector.ts";
import { buildSolid, pairScratch, pointInside, rigid, surfaceDistance } from "../../collision/index.ts";
import { LIBRARY, robotById } from "../library/index.ts";
import { staubliRx90l } from "../library/staubli-rx90l.ts";
import { linkDesigns, linkShapes, linkSolids } from "./shapes.ts";

const point = (mesh: TriangleMesh, i: number): Vector3 => [
  mesh.positions[3 * i]!,
  mesh.positions[3 * i + 1]!,
  mesh.positions[3 * i + 2]!,
];

/** Signed volume of a closed mesh; positive when its triangles face outwards. */
function volume(mesh: TriangleMesh): number {
  let six = 0;
  for (let t = 0; t < mesh.indices.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map(k => point(mesh, mesh.indices[t + k]!)) as [Vector3, Vector3, Vector3];
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

/** Every directed edge must meet its reverse exactly once. */
function openEdges(mesh: TriangleMesh): number {
  const edges = new Map<string, number>();
  for (let t = 0; t < mesh.indices.length; t += 3) {
    for (let k = 0; k < 3; k++) {
      const a = mesh.indices[t + k]!;
      const b = mesh.indices[t + ((k + 1) % 3)]!;
      edges.set(`${a}>${b}`, (edges.get(`${a}>${b}`) ?? 0) + 1);
      edges.set(`${b}>${a}`, (edges.get(`${b}>${a}`) ?? 0) - 1);
    }
  }
  return [...edges.values()].filter(count => count !== 0).length;
}

/** How far a point is outside a convex shell [m]; negative inside. */
function outside(shell: TriangleMesh, p: Vector3): number {
  let worst = -Infinity;
  for (let t = 0; t < shell.indices.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map(k => point(shell, shell.indices[t + k]!)) as [Vector3, Vector3, Vector3];
    const u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]] as const;
    const v = [c[0] - a[0], c[1] - a[1], c[2] - a[2]] as const;
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]] as const;
    const size = Math.hypot(...n);
    if (size < 1e-14) continue;
    worst = Math.max(worst, (n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1]) + n[2] * (p[2] - a[2])) / size);
  }
  return worst;
}

const general = { ...staubliRx90l, family: { kind: "general" } as const };

describe.each([
  ["upright six-axis arm", staubliRx90l],
  ["arm of unknown form", general],
  ["upright arm with a shoulder ahead of axis 1", robotById("kuka_kr6_2")!],
  ["made-up geometry", robotById("lola_rl15_placeholder")!],
])("%s", (_, robot) => {
  test("every part is closed and faces outwards", () => {
    for (const shape of linkShapes(robot)) {
      for (const part of shape.parts) {
        expect(openEdges(part.mesh), `${shape.name}, ${part.name}`).toBe(0);
        expect(volume(part.mesh), `${shape.name}, ${part.name}`).toBeGreaterThan(0);
      }
    }
  });

  test("every drawn point lies inside one of the link's convex shells", () => {
    linkDesigns(robot).forEach((design, link) => {
      for (const shell of design.shells) {
        expect(openEdges(shell)).toBe(0);
        expect(volume(shell)).toBeGreaterThan(0);
      }
      for (const part of design.parts) {
        let worst = -Infinity;
        for (let i = 0; i < part.mesh.positions.length / 3; i++) {
          worst = Math.max(worst, Math.min(...design.shells.map(shell => outside(shell, point(part.mesh, i)))));
        }
        expect(worst, `link ${link}, ${part.name}`).toBeLessThan(1e-9);
      }
    });
  });

  test("solids are coarse and named as the links are", () => {
    const solids = linkSolids(robot);
    expect(solids.map(solid => solid.name)).toEqual([
      "link 0",
      "link 1",
      "link 2",
      "link 3",
      "link 4",
      "link 5",
      "link 6",
    ]);
    for (const solid of solids) expect(solid.mesh.indices.length / 3).toBeLessThan(400);
  });
});

test("the RX90L stands 1.605 m high at home and its flange face is the flange frame", () => {
  const at = Array.from({ length: 7 }, () => identity<"base", "link">());
  linkPoses(staubliRx90l.arm, staubliRx90l.home_rad, at);
  let top = -Infinity;
  for (const shape of linkShapes(staubliRx90l)) {
    for (const part of shape.parts)
      for (let i = 0; i < part.mesh.positions.length / 3; i++)
        top = Math.max(top, transformPoint(at[shape.link]!, point(part.mesh, i))[2]);
  }
  expect(top).toBeGreaterThan(0.42 + 0.45 + 0.65 + 0.085 - 0.001);
  expect(top).toBeLessThanOrEqual(0.42 + 0.45 + 0.65 + 0.085 + 1e-9);
});

describe.each(LIBRARY.filter(({ form }) => form !== undefined).map(robot => [robot.id, robot] as const))(
  "%s, drawn from castings",
  (_, robot) => {
    const n = robot.arm.joints.length;

    test("every part and every solid is closed and faces outwards", () => {
      expect(linkDesigns(robot).length).toBe(n + 1);
      for (const { parts, shells } of linkDesigns(robot))
        for (const mesh of [...parts.map(part => part.mesh), ...shells]) {
          expect(openEdges(mesh)).toBe(0);
          expect(volume(mesh)).toBeGreaterThan(0);
        }
    });

    test("every drawn point lies inside the solids that collisions are checked with", () => {
      const scratch = pairScratch();
      const points = new Float64Array(6);
      const at = rigid();
      const tiny = 1e-7;
      const speck = buildSolid({
        positions: Float64Array.of(tiny, tiny, tiny, -tiny, -tiny, tiny, -tiny, tiny, -tiny, tiny, -tiny, -tiny),
        indices: Uint32Array.of(0, 1, 3, 0, 2, 1, 0, 3, 2, 1, 2, 3),
      });
      for (const { parts, shells } of linkDesigns(robot)) {
        const solids = shells.map(buildSolid);
        for (const { mesh } of parts)
          for (let i = 0; i < mesh.positions.length / 3; i += 61) {
            const [x, y, z] = point(mesh, i);
            if (solids.some(solid => pointInside(solid, x, y, z, scratch))) continue;
            at.set([x, y, z], 9);
            scratch.witness.fill(-1);
            expect(
              Math.min(
                ...solids.map(({ bvh }) => {
                  scratch.witness.fill(-1);
                  return surfaceDistance(bvh, speck.bvh, at, 1, scratch, points);
                }),
              ),
            ).toBeLessThan(2e-5);
          }
      }
    });

    test("few triangles a link", () => {
      for (const { mesh } of linkSolids(robot)) expect(mesh.indices.length / 3).toBeLessThan(8000);
    });

    test("painted, with nothing but its own colours", () => {
      for (const colour of Object.values(robot.paint!)) expect(colour).toMatch(/^#[0-9a-f]{6}$/);
    });
  },
);

test("L-62 on every robot the last link and the one that turns the wrist carry a mark that is off their axis", () => {
  for (const robot of LIBRARY)
    for (const link of [robot.arm.joints.length - 2, robot.arm.joints.length]) {
      const marks = linkShapes(robot)[link]!.parts.filter(part => part.material === "mark");
      expect(marks.length, `${robot.id}, link ${link}`).toBe(1);
      const [{ mesh }] = marks as [(typeof marks)[0]];
      const n = mesh.positions.length / 3;
      const axis = robot.arm.joints[link - 1]!.axis;
      const middle: Vector3 = [0, 0, 0];
      for (let i = 0; i < n; i++)
        point(mesh, i).forEach((value, k) => {
          middle[k] = middle[k]! + value / n;
        });
      const along = middle.reduce((sum, value, k) => sum + value * axis[k]!, 0);
      expect(
        Math.hypot(...middle.map((value, k) => value - along * axis[k]!)),
        `${robot.id}, link ${link}`,
      ).toBeGreaterThan(0.012);
    }
});
