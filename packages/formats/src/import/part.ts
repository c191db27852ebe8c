import type { TriangleMesh, Vector3 } from "@twincell/core";

/** Red, green, blue from 0 to 1, as shown on a screen (sRGB). */
export type Rgb = readonly [number, number, number];

/** A part as a reader found it, in the file's units. */
export interface RawPart {
  readonly name: string;
  /** Names of the assemblies, groups or nodes above it, the outermost first. */
  readonly path: readonly string[];
  /** Undefined where the file gives it none. */
  readonly color: Rgb | undefined;
  readonly mesh: TriangleMesh;
}

/** What a reader hands on: parts in the file's units and what it had to do. */
export interface RawParts {
  readonly format: ImportFormat;
  readonly parts: readonly RawPart[];
  /** Metres per unit where the format or the file states it. */
  readonly statedUnit_m?: number | undefined;
  readonly notes: readonly string[];
}

export type ImportFormat = "STL" | "OBJ" | "PLY" | "PLY point cloud" | "COLLADA" | "glTF" | "GLB" | "STEP" | "URDF";

/** A part of what was imported, in metres, z up. */
export interface ImportedPart {
  readonly name: string;
  readonly path: readonly string[];
  /** `#rrggbb`. */
  readonly color: string;
  readonly mesh: TriangleMesh;
}

/** How long a unit of the file is, and how that is known. `doubtful` is what a person should be asked about. */
export interface UnitGuess {
  readonly metresPerUnit: number;
  readonly certainty: "stated" | "chosen" | "likely" | "doubtful";
  readonly sentence: string;
}

/** What was read, what it measures and every mend. Counts are of the triangles that were kept. */
export interface ImportReport {
  readonly format: ImportFormat;
  /** Triangles in the file, before any were left out. */
  readonly trianglesInFile: number;
  readonly triangles: number;
  readonly vertices: number;
  readonly parts: number;
  /** Different colours. */
  readonly materials: number;
  readonly openEdges: number;
  readonly crowdedEdges: number;
  readonly lower_m: Vector3;
  readonly upper_m: Vector3;
  readonly size_m: Vector3;
  /** Every mend and everything that was passed over, one sentence each. */
  readonly fixes: readonly string[];
}

export interface Imported {
  readonly kind: "imported";
  readonly name: string;
  readonly parts: readonly ImportedPart[];
  readonly unit: UnitGuess;
  readonly report: ImportReport;
}

/** `#rrggbb` of a colour; what is beyond 0 … 1 is taken for the nearer end. */
export const hexOf = (color: Rgb): string =>
  `#${color
    .map(value =>
      Math.round(Math.min(1, Math.max(0, value || 0)) * 255)
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;

/** A linear colour, as glTF writes it, as sRGB. IEC 61966-2-1. */
export const fromLinear = ([r, g, b]: readonly [number, number, number, ...number[]]): Rgb => [
  encoded(r),
  encoded(g),
  encoded(b),
];
const encoded = (value: number): number =>
  value <= 0.0031308 ? 12.92 * value : 1.055 * Math.max(0, value) ** (1 / 2.4) - 0.055;
