import {
  boxMesh,
  cylinderMesh,
  doubleArea,
  massProperties,
  meshBounds,
  pose,
  revolvedMesh,
  sphereMesh,
  transformMesh,
  type MassProperties,
  type Point2,
  type SolidShape,
  type TriangleMesh,
  type Vector3,
} from "@twincell/core";
import { convexPieces } from "./convex-profile.ts";
import { voxelBoxes } from "./voxels.ts";

/** One convex piece of a solid, as the engine takes it. */
export type Geom =
  | { readonly kind: "box"; readonly size_m: Vector3; readonly at_m: Vector3 }
  | { readonly kind: "sphere"; readonly radius_m: number; readonly at_m: Vector3 }
  | { readonly kind: "cylinder"; readonly radius_m: number; readonly height_m: number; readonly at_m: Vector3 }
  | { readonly kind: "hull"; readonly points_m: readonly number[] };

/** Sectors of a turned solid with a hole: the hole is met to 0.9 % of its radius. */
const SECTORS = 24;
const CELLS = 16;
/** A vertex may stand out of a face by this share of the size before a mesh counts as concave. */
const CONVEX_WITHIN = 1e-4;
const FACES_PER_TURN = 48;

/** The closed outline of a turned solid, counter-clockwise, its ends closed with flat discs. */
function outlineOf({ profile_m, ring }: Extract<SolidShape, { kind: "revolved" }>): Point2[] {
  const rows: Point2[] = [...profile_m];
  if (ring !== true && rows[0]![0] > 0) rows.unshift([0, rows[0]![1]]);
  if (ring !== true && rows.at(-1)![0] > 0) rows.push([0, rows.at(-1)![1]]);
  return doubleArea(rows) < 0 ? rows.reverse() : rows;
}

/** The solid cut into convex pieces, none of which closes a hole of it (row L-72). */
export function solidGeoms(shape: SolidShape): Geom[] {
  switch (shape.kind) {
    case "box":
      return [{ kind: "box", size_m: shape.size_m, at_m: [0, 0, 0] }];
    case "sphere":
      return [{ kind: "sphere", radius_m: shape.radius_m, at_m: [0, 0, 0] }];
    case "cylinder":
      return [
        { kind: "cylinder", radius_m: shape.radius_m, height_m: shape.height_m, at_m: [0, 0, shape.height_m / 2] },
      ];
    case "revolved": {
      const outline = outlineOf(shape);
      return convexPieces(outline).flatMap(turned);
    }
    case "mesh":
      return isConvexMesh(shape.mesh)
        ? [{ kind: "hull", points_m: Array.from(shape.mesh.positions) }]
        : voxelBoxes(shape.mesh, CELLS).boxes.map(({ center_m, size_m }) => ({ kind: "box", size_m, at_m: center_m }));
  }
}

/**
 * A convex piece turned about z: whole where it lies along the axis over all its height, in sectors where it leaves a
 * hole.
 */
function turned(piece: readonly Point2[]): Geom[] {
  const heights = piece.map(([, z]) => z);
  const onAxis = piece.filter(([r]) => r <= 1e-9).map(([, z]) => z);
  const whole =
    onAxis.length >= 2 && Math.min(...onAxis) <= Math.min(...heights) && Math.max(...onAxis) >= Math.max(...heights);
  const around = (from: number, steps: number): Geom => ({
    kind: "hull",
    points_m: Array.from(
      { length: steps },
      (_, s) => 2 * Math.PI * (from + s / (whole ? FACES_PER_TURN : SECTORS)),
    ).flatMap(angle => piece.flatMap(([r, z]) => [r * Math.cos(angle), r * Math.sin(angle), z])),
  });
  return whole ? [around(0, FACES_PER_TURN)] : Array.from({ length: SECTORS }, (_, s) => around(s / SECTORS, 2));
}

function isConvexMesh({ positions: p, indices }: TriangleMesh): boolean {
  const { lower, upper } = meshBounds({ positions: p, indices });
  const within = CONVEX_WITHIN * Math.max(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]);
  for (let t = 0; t < indices.length; t += 3) {
    const a = 3 * indices[t]!;
    const b = 3 * indices[t + 1]!;
    const c = 3 * indices[t + 2]!;
    const ux = p[b]! - p[a]!;
    const uy = p[b + 1]! - p[a + 1]!;
    const uz = p[b + 2]! - p[a + 2]!;
    const vx = p[c]! - p[a]!;
    const vy = p[c + 1]! - p[a + 1]!;
    const vz = p[c + 2]! - p[a + 2]!;
    const x = uy * vz - uz * vy;
    const y = uz * vx - ux * vz;
    const z = ux * vy - uy * vx;
    const size = Math.sqrt(x * x + y * y + z * z);
    if (size < 1e-15) continue;
    for (let k = 0; k < p.length; k += 3)
      if (((p[k]! - p[a]!) * x + (p[k + 1]! - p[a + 1]!) * y + (p[k + 2]! - p[a + 2]!) * z) / size > within)
        return false;
  }
  return true;
}

/** The solid as triangles, for its mass and for drawing. */
export function solidMesh(shape: SolidShape): TriangleMesh {
  switch (shape.kind) {
    case "box":
      return boxMesh(shape.size_m);
    case "sphere":
      return sphereMesh(shape.radius_m, FACES_PER_TURN, FACES_PER_TURN / 2);
    case "cylinder":
      return transformMesh(
        cylinderMesh(shape.radius_m, shape.height_m, FACES_PER_TURN),
        pose([0, 0, shape.height_m / 2]),
      );
    case "revolved":
      return revolvedMesh(shape.profile_m, FACES_PER_TURN, { ring: shape.ring === true });
    case "mesh":
      return shape.mesh;
  }
}

/** What the solid weighs per unit of density; exact for simple solids, of its triangles otherwise. */
export function solidMass(shape: SolidShape): MassProperties {
  switch (shape.kind) {
    case "sphere": {
      const r = shape.radius_m;
      const volume_m3 = (4 / 3) * Math.PI * r ** 3;
      const i = (2 / 5) * volume_m3 * r * r;
      return { volume_m3, center_m: [0, 0, 0], inertia_m5: [i, i, i, 0, 0, 0] };
    }
    case "cylinder": {
      const { radius_m: r, height_m: h } = shape;
      const volume_m3 = Math.PI * r * r * h;
      const across = (volume_m3 * (3 * r * r + h * h)) / 12;
      return { volume_m3, center_m: [0, 0, h / 2], inertia_m5: [across, across, (volume_m3 * r * r) / 2, 0, 0, 0] };
    }
    default:
      return massProperties(solidMesh(shape));
  }
}
