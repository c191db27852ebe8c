import type { TriangleMesh } from "../../mesh/mesh.ts";
import { inverse, transformPoint, type Pose } from "../../spatial/pose.ts";
import { cross, type Vector3 } from "../../spatial/vector.ts";
import { circle, type Outline, type Point2 } from "./outline.ts";

/** Where a solid is drawn: u and v span its outline, w = u × v is the way it is extruded. */
export interface Frame {
  readonly origin: Vector3;
  readonly u: Vector3;
  readonly v: Vector3;
}

export const upright = (origin: Vector3): Frame => ({ origin, u: [1, 0, 0], v: [0, 1, 0] });
/** w along −y, u = x, v = z: the outer side of the upper arm. */
export const sideways = (origin: Vector3): Frame => ({ origin, u: [1, 0, 0], v: [0, 0, 1] });
/** w along +y, u = z, v = x. */
export const farSide = (origin: Vector3): Frame => ({ origin, u: [0, 0, 1], v: [1, 0, 0] });
/** w along −x, u = z, v = −y … the back of the robot. */
export const backwards = (origin: Vector3): Frame => ({ origin, u: [0, 0, 1], v: [0, 1, 0] });

/** A ring of a loft: an outline at height w. */
export interface Ring {
  readonly points: readonly Point2[];
  readonly w_m: number;
}

/**
 * Joins rings of equal count, first to last, and closes both ends with a fan: one closed, outward-facing shell.
 * Rings must rise along w where they face outwards.
 */
export function loft(frame: Frame, rings: readonly Ring[]): TriangleMesh {
  const n = rings[0]!.points.length;
  const count = rings.length * n + 2;
  const positions = new Float64Array(3 * count);
  const indices: number[] = [];
  const w = cross(frame.u, frame.v);
  let at = 0;
  const put = (a: number, b: number, c: number): void => {
    for (let k = 0; k < 3; k++) positions[at++] = frame.origin[k]! + a * frame.u[k]! + b * frame.v[k]! + c * w[k]!;
  };
  for (const ring of rings) for (const point of ring.points) put(point[0], point[1], ring.w_m);
  for (const ring of [rings[0]!, rings[rings.length - 1]!]) {
    let a = 0;
    let b = 0;
    for (const point of ring.points) {
      a += point[0] / n;
      b += point[1] / n;
    }
    put(a, b, ring.w_m);
  }
  for (let r = 0; r + 1 < rings.length; r++) {
    for (let i = 0; i < n; i++) {
      const j = (i + 1) % n;
      const low = r * n;
      const high = low + n;
      indices.push(low + i, low + j, high + j, low + i, high + j, high + i);
    }
  }
  const bottom = count - 2;
  const top = count - 1;
  const last = (rings.length - 1) * n;
  for (let i = 0; i < n; i++) {
    const j = (i + 1) % n;
    indices.push(bottom, j, i, top, last + i, last + j);
  }
  return { positions, indices: Uint32Array.from(indices) };
}

/** An outline extruded along a profile of [inset, w]: straight prisms, rounded ones, recessed ones. */
export const prism = (frame: Frame, outline: Outline, profile: readonly Point2[]): TriangleMesh =>
  loft(
    frame,
    profile.map(([inset_m, w_m]) => ({ points: outline(inset_m), w_m })),
  );

/** A profile of [radius, w] turned about w. */
export const revolve = (frame: Frame, profile: readonly Point2[], sides = 48): TriangleMesh =>
  prism(
    frame,
    circle(0, sides),
    profile.map(([radius_m, w_m]) => [-radius_m, w_m] as const),
  );

/** `count` bolt heads on a circle about the frame's w, the first at `phase_rad`. */
export function bolts(
  frame: Frame,
  count: number,
  circle_m: number,
  radius_m: number,
  height_m: number,
  phase_rad = 0,
): TriangleMesh {
  const w = cross(frame.u, frame.v);
  return merge(
    Array.from({ length: count }, (_, i) => {
      const angle = phase_rad + (2 * Math.PI * i) / count;
      const a = circle_m * Math.cos(angle);
      const b = circle_m * Math.sin(angle);
      const origin: Vector3 = [0, 0, 0];
      for (let k = 0; k < 3; k++) origin[k] = frame.origin[k]! + a * frame.u[k]! + b * frame.v[k]! - 0.001 * w[k]!;
      return prism({ origin, u: frame.u, v: frame.v }, circle(radius_m, 10), [
        [0, 0],
        [0, height_m * 0.75],
        [radius_m * 0.22, height_m],
      ]);
    }),
  );
}

/** All meshes as one, without joining vertices. */
export function merge(meshes: readonly TriangleMesh[]): TriangleMesh {
  const positions = new Float64Array(meshes.reduce((sum, mesh) => sum + mesh.positions.length, 0));
  const indices = new Uint32Array(meshes.reduce((sum, mesh) => sum + mesh.indices.length, 0));
  let p = 0;
  let i = 0;
  for (const mesh of meshes) {
    positions.set(mesh.positions, p);
    for (let k = 0; k < mesh.indices.length; k++) indices[i + k] = mesh.indices[k]! + p / 3;
    p += mesh.positions.length;
    i += mesh.indices.length;
  }
  return { positions, indices };
}

/** The mesh of the robot's base frame seen from a link. */
export function intoLink(mesh: TriangleMesh, baseFromLink: Pose<"base", "link">): TriangleMesh {
  const linkFromBase = inverse(baseFromLink);
  const point: Vector3 = [0, 0, 0];
  const positions = new Float64Array(mesh.positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    for (let k = 0; k < 3; k++) point[k] = mesh.positions[i + k]!;
    transformPoint(linkFromBase, point, point);
    positions.set(point, i);
  }
  return { positions, indices: mesh.indices };
}
