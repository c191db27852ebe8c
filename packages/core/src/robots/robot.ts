import type { Pose } from "../spatial/pose.ts";
import type { SerialArm } from "./arm.ts";

/**
 * Ortho-parallel basis with spherical wrist, seven lengths (Brandstötter, Angerer, Hofbaur 2014).
 * Joint angles of the robot and of the formula:  q_formula = sign · q − offset.
 */
export interface OrthoParallelGeometry {
  readonly kind: "ortho-parallel";
  readonly a1_m: number; readonly a2_m: number; readonly b_m: number;
  readonly c1_m: number; readonly c2_m: number; readonly c3_m: number; readonly c4_m: number;
  readonly offsets_rad: readonly [number, number, number, number, number, number];
  readonly signs: readonly [number, number, number, number, number, number];
  /** The formula's flange (z out of the flange, all formula angles 0) to this robot's flange frame. */
  readonly formulaFromFlange: Pose<"formula", "flange">;
}

/** How the inverse of an arm is solved. Grows by new kinds. */
export type KinematicFamily = OrthoParallelGeometry | { readonly kind: "general" };

/** A robot of the library: one data file each, every number with its source. */
export interface Robot {
  readonly id: string;
  readonly name: string;
  readonly vendor: string;
  readonly arm: SerialArm;
  readonly family: KinematicFamily;
  /** Names of the root link, of the tip frame and of the vendor's world, as URDFs of this robot call them. */
  readonly frames: { readonly base: string; readonly tip: string };
  /** The vendor's world origin seen from the root link: V+ counts from the shoulder. */
  readonly baseFromVendorWorld: Pose<"base", "vendor-world">;
  readonly home_rad: readonly number[];
  readonly payload_kg: number;
  readonly payloadMax_kg: number;
  /** Published reach and what it is measured to. */
  readonly reach_m: number;
  readonly reachMeasuredTo: "flange" | "wrist";
  readonly repeatability_m: number;
  readonly maxTcpSpeed_mps: number;
  /** quantity → where the number comes from. */
  readonly sources: Readonly<Record<string, string>>;
  /** What is not published and was assumed, one sentence each; shown beside every result that rests on it. */
  readonly assumptions: readonly string[];
  /** How far a drawn shape may be from the real casting [m]; added to every clearance margin. */
  readonly shapeError_m: number;
}
