import type { Pose } from "../spatial/pose.ts";
import type { LinkSolid } from "../mesh/link-solid.ts";
import type { TriangleMesh } from "../mesh/mesh.ts";
import type { PairMatrix } from "./pairs.ts";

/** A solid in the cell that does not belong to the robot. */
export interface CellObject {
  readonly id: string;
  readonly name: string;
  readonly worldFromObject: Pose<"world", "object">;
  readonly mesh: TriangleMesh;
  /** What may stand on it, where that is known [kg]. */
  readonly carries_kg?: number;
  /** What it weighs, where that is known [kg]. */
  readonly mass_kg?: number;
  /** A work piece that a gripper may take and carry (row M-19). */
  readonly graspable?: true;
}

/**
 * Everything a collision check must know; JSON-able apart from the typed arrays, so it can be sent to a worker once.
 */
export interface CellGeometry {
  readonly worldFromBase: Pose<"world", "base">;
  readonly links: readonly LinkSolid[];
  /** Solid of the tool in the flange frame. */
  readonly tool?: { readonly name: string; readonly mesh: TriangleMesh };
  /** What the tool weighs, where that is known [kg]. */
  readonly toolMass_kg?: number;
  /** Where the fingers of the tool meet, or where it sucks. */
  readonly flangeFromGrip?: Pose<"flange", "grip">;
  readonly objects: readonly CellObject[];
  /** The object that the gripper holds already, and how: it moves with the flange from the beginning. */
  readonly held?: { readonly id: string; readonly flangeFromObject: Pose<"flange", "object"> };
  /**
   * Pairs that may touch, by link name, "tool" or object id (the tool tip and the work piece it traces, for instance).
   */
  readonly allowedPairs: readonly (readonly [string, string])[];
  /**
   * Which parts of the robot are checked against which, as learnt and edited. What it says of a pair is final; other
   * pairs are checked.
   */
  readonly pairs?: PairMatrix;
  /** Uncertainty of the drawn robot shape [m], added to every margin. */
  readonly shapeError_m: number;
  /**
   * How far the robot may be from where it is drawn among the objects [m]: the residual of the registration and the
   * error of the twin. Added to the distance between what the arm moves and what stands. 0 when left out.
   */
  readonly placeError_m?: number;
  /** What `placeError_m` is the sum of, where that is known [m]; only said. */
  readonly placeErrors?: { readonly registration_m: number; readonly twin_m: number };
}

/** Two solids that touch. Names are those of links ("link 4"), "tool", or ids of objects. */
export interface Contact {
  readonly a: string;
  readonly b: string;
  /** "self": two parts of the robot, its tool among them; "other": one of them is an object, held or not (row X-12). */
  readonly between: "self" | "other";
}
