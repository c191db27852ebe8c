import type { Vector3 } from "@twincell/core";
import { partPieces, type PartMaterial, type PartPiece, type Shape } from "@twincell/project";

/** A face of a part as it is seen: its outline on the picture, and how bright it is. */
export interface Face {
  readonly points: string;
  readonly fill: string;
}
export interface PartPicture {
  readonly viewBox: string;
  readonly faces: readonly Face[];
}

const COLOURS: Readonly<Record<PartMaterial, readonly [number, number, number]>> = {
  "paint-yellow": [242, 177, 0],
  "paint-grey": [92, 102, 110],
  "paint-blue": [57, 121, 194],
  aluminium: [190, 198, 204],
  steel: [170, 178, 184],
  rubber: [58, 64, 69],
  wood: [205, 166, 110],
  cardboard: [190, 144, 96],
  tape: [214, 182, 132],
  glass: [60, 160, 120],
  red: [200, 52, 42],
  black: [62, 69, 74],
  "fabric-orange": [239, 125, 26],
  "fabric-dark": [62, 74, 90],
  skin: [216, 165, 130],
  white: [232, 235, 237],
};

/** Seen from the front, its right and above: x to the right and down, y to the right and up, z up. */
const flat = ([x, y, z]: Vector3): readonly [number, number] => [0.87 * x + 0.42 * y, 0.34 * x - 0.5 * y - 0.94 * z];
const depth = ([x, y, z]: Vector3): number => 0.5 * x - 0.85 * y + 0.35 * z;
/** Sides of a round piece that are drawn. */
const SIDES = 14;
const ROOM = 0.06;

/** A part of the library as lit faces, the far ones first. */
export function partPicture(shape: Extract<Shape, { kind: "part" }>): PartPicture {
  const faces = partPieces(shape)
    .filter(({ only }) => only !== "solid")
    .flatMap(facesOf)
    .sort((a, b) => a.depth - b.depth);
  const all = faces.flatMap(face => face.points.map(flat));
  const left = Math.min(...all.map(([x]) => x));
  const right = Math.max(...all.map(([x]) => x));
  const top = Math.min(...all.map(([, y]) => y));
  const bottom = Math.max(...all.map(([, y]) => y));
  const size = Math.max(right - left, bottom - top);
  const room = ROOM * size;
  const number = (value: number): string => String(Math.round(value * 1000) / 1000);
  return {
    viewBox: [(left + right - size) / 2 - room, (top + bottom - size) / 2 - room, size + 2 * room, size + 2 * room]
      .map(number)
      .join(" "),
    faces: faces.map(({ points, light, material }) => ({
      points: points
        .map(flat)
        .map(([x, y]) => `${number(x)},${number(y)}`)
        .join(" "),
      fill: `rgb(${COLOURS[material].map(value => Math.round(Math.min(255, value * light))).join(" ")})`,
    })),
  };
}

interface Lit {
  readonly points: readonly Vector3[];
  readonly light: number;
  readonly depth: number;
  readonly material: PartMaterial;
}

function facesOf(piece: PartPiece): readonly Lit[] {
  const [x, y, z] = piece.at_m;
  const face = (points: readonly Vector3[], light: number): Lit => ({
    points,
    light,
    material: piece.material,
    depth: points.reduce((sum, point) => sum + depth(point), 0) / points.length + depth(piece.at_m),
  });
  if (piece.kind === "box") {
    const [a, b, c] = piece.size_m.map(value => value / 2) as [number, number, number];
    const at = (sx: number, sy: number, sz: number): Vector3 => {
      const turn = piece.turn_rad ?? 0;
      const [u, v] = [sx * a, sy * b];
      return [x + Math.cos(turn) * u - Math.sin(turn) * v, y + Math.sin(turn) * u + Math.cos(turn) * v, z + sz * c];
    };
    return [
      face([at(-1, -1, 1), at(1, -1, 1), at(1, 1, 1), at(-1, 1, 1)], 1.08),
      face([at(-1, -1, -1), at(1, -1, -1), at(1, -1, 1), at(-1, -1, 1)], 0.84),
      face([at(1, -1, -1), at(1, 1, -1), at(1, 1, 1), at(1, -1, 1)], 0.66),
    ];
  }
  if (piece.kind === "ball") {
    const r = piece.radius_m;
    const ring = Array.from({ length: SIDES }, (_, i): Vector3 => {
      const a = (2 * Math.PI * i) / SIDES;
      return [x + r * Math.cos(a) * 0.87, y + r * Math.cos(a) * 0.45, z + r * Math.sin(a)];
    });
    return [face(ring, 0.95)];
  }
  const half = piece.length_m / 2;
  const place = (a: number, end: number): Vector3 => {
    const [u, v] = [piece.radius_m * Math.cos(a), piece.radius_m * Math.sin(a)];
    if (piece.axis === 2) return [x + u, y + v, z + end * half];
    if (piece.axis === 1) return [x + v, y + end * half, z + u];
    return [x + end * half, y + u, z + v];
  };
  const angles = Array.from({ length: SIDES }, (_, i) => (2 * Math.PI * i) / SIDES);
  const near = piece.axis === 1 ? -1 : 1;
  const step = (2 * Math.PI) / SIDES;
  const sides = angles.flatMap(angle => {
    const out = place(angle + step / 2, 0).map((value, k) => value - piece.at_m[k]!) as Vector3;
    if (depth(out) <= 0) return [];
    const light = 0.7 + 0.35 * (out[2] / piece.radius_m) - 0.12 * (out[0] / piece.radius_m);
    return [face([place(angle, -1), place(angle + step, -1), place(angle + step, 1), place(angle, 1)], light)];
  });
  const lid = piece.axis === 2 ? 1.08 : piece.axis === 1 ? 0.84 : 0.66;
  return [
    ...sides,
    face(
      angles.map(angle => place(angle, near)),
      lid,
    ),
  ];
}
