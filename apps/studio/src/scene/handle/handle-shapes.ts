import {
  type BufferGeometry,
  ConeGeometry,
  CylinderGeometry,
  PlaneGeometry,
  SphereGeometry,
  TorusGeometry,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { HandlePart } from "../interaction.ts";
import { AXIS_COLOURS } from "../triad-geometry.ts";

/** One part of the handle, in units of the ring's radius: what is seen, and the larger body that can be hit. */
export interface HandleShape {
  readonly part: HandlePart;
  readonly color: string;
  readonly seen: BufferGeometry;
  readonly hit: BufferGeometry;
}

const ARROW = 1.42;

function along(axis: number, geometry: BufferGeometry): BufferGeometry {
  if (axis === 0) geometry.rotateZ(-Math.PI / 2);
  if (axis === 2) geometry.rotateX(Math.PI / 2);
  return geometry;
}
/** A torus lies in the xy plane: turned so that it goes round the axis. */
function around(axis: number, geometry: BufferGeometry): BufferGeometry {
  if (axis === 0) geometry.rotateY(Math.PI / 2);
  if (axis === 1) geometry.rotateX(Math.PI / 2);
  return geometry;
}
function across(axis: number, geometry: BufferGeometry): BufferGeometry {
  geometry.translate(0.42, 0.42, 0);
  if (axis === 0) geometry.rotateY(-Math.PI / 2);
  if (axis === 1) geometry.rotateX(Math.PI / 2);
  return geometry;
}

/** Rings to turn, arrows to move along, small squares to move in a plane, and a ball to move freely. */
export function handleShapes(): HandleShape[] {
  const axes = ["x", "y", "z"] as const;
  const rings = ["rx", "ry", "rz"] as const;
  const planes = ["yz", "zx", "xy"] as const;
  const shapes: HandleShape[] = [];
  for (let axis = 0; axis < 3; axis++) {
    const color = AXIS_COLOURS[axis]!;
    shapes.push({
      part: rings[axis]!,
      color,
      seen: around(axis, new TorusGeometry(1, 0.017, 10, 72)),
      hit: around(axis, new TorusGeometry(1, 0.085, 8, 40)),
    });
    const shaft = new CylinderGeometry(0.02, 0.02, ARROW - 0.42, 10).translate(0, (ARROW - 0.22 + 0.2) / 2, 0);
    const head = new ConeGeometry(0.072, 0.24, 18).translate(0, ARROW - 0.12, 0);
    shapes.push({
      part: axes[axis]!,
      color,
      seen: along(axis, mergeGeometries([shaft, head])),
      hit: along(axis, new CylinderGeometry(0.13, 0.1, ARROW - 0.15, 8).translate(0, (ARROW + 0.2) / 2, 0)),
    });
    shapes.push({
      part: planes[axis]!,
      color,
      seen: across(axis, new PlaneGeometry(0.2, 0.2)),
      hit: across(axis, new PlaneGeometry(0.26, 0.26)),
    });
  }
  shapes.push({
    part: "free",
    color: "#ffffff",
    seen: new SphereGeometry(0.085, 20, 14),
    hit: new SphereGeometry(0.17, 12, 8),
  });
  return shapes;
}
