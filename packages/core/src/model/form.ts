import type { TriangleMesh } from "../mesh/mesh.ts";

/** What a part is made of. "mark" is what shows a turn of a symmetrical link (row L-62). */
export type PartMaterial = "casting" | "dark" | "cover" | "metal" | "mark";

/**
 * A ring of a casting, a rectangle with four corners of their own roundness [mm]:
 * place along the loft; lower and upper u; lower and upper v; radii at (u0, v0), (u1, v0), (u1, v1), (u0, v1).
 */
export type FormRing = readonly [
  w: number,
  u0: number,
  u1: number,
  v0: number,
  v1: number,
  r00: number,
  r10: number,
  r11: number,
  r01: number,
];

/**
 * A casting drawn through rings along one axis of its link's frame. u and v are the next two axes: along y, u is z and
 * v is x.
 */
export interface FormLoft {
  readonly along: "x" | "y" | "z";
  /** How far the first and the last edge are rounded [mm]; 0 where the casting goes on in another. */
  readonly ends: readonly [number, number];
  readonly rings: readonly FormRing[];
  /** Of the link, unless said. */
  readonly material?: PartMaterial;
  /** Heads of so many screws around the rim of the rounded end. */
  readonly bolts?: number;
}

export interface FormLink {
  readonly material: PartMaterial;
  readonly lofts: readonly FormLoft[];
}

/** Colours as the maker paints the robot, `#rrggbb`. */
export interface RobotPaint {
  readonly casting: string;
  readonly dark: string;
  readonly cover: string;
}

/** One drawn part of a link that came from a file, in the frame of that link. */
export interface OwnPart {
  /** `#rrggbb`; the casting's where the file says none. */
  readonly color?: string;
  readonly mesh: TriangleMesh;
}

/** A link as the robot's own files draw it, and the solids that count in collisions: the drawn ones where left out. */
export interface OwnLink {
  readonly parts: readonly OwnPart[];
  readonly solids?: readonly TriangleMesh[];
}

/** What a robot looks like: link by link, base first. Plain data. */
export interface RobotForm {
  readonly links: readonly FormLink[];
}
