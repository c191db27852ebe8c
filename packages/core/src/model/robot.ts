import type { Pose } from "../spatial/pose.ts";
import type { Quaternion } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";
import type { LinkMass, SerialArm } from "./arm.ts";
import type { OwnLink, RobotForm, RobotPaint } from "./form.ts";
import type { VendorSection } from "./vendor.ts";

/**
 * Ortho-parallel basis with spherical wrist, seven lengths (Brandstötter, Angerer, Hofbaur 2014).
 * Joint angles of the robot and of the formula:  q_formula = sign · q − offset.
 */
export interface OrthoParallelGeometry {
  readonly kind: "ortho-parallel";
  readonly a1_m: number;
  readonly a2_m: number;
  readonly b_m: number;
  readonly c1_m: number;
  readonly c2_m: number;
  readonly c3_m: number;
  readonly c4_m: number;
  readonly offsets_rad: readonly [number, number, number, number, number, number];
  readonly signs: readonly [number, number, number, number, number, number];
  /** The formula's flange (z out of the flange, all formula angles 0) to this robot's flange frame. */
  readonly formulaFromFlange: Pose<"formula", "flange">;
}

/**
 * Axes 2, 3 and 4 parallel, each next axis of the wrist square to the one before and meeting it (UR and its kin).
 *
 *   formulaFromWrist = Rz(θ1) · T(a1, b, 0) · Ry(θ2) · Tz(c2) · Ry(θ3) · Tz(c3) · Ry(θ4) · Tz(c5) · Rz(θ5) · Ry(θ6)
 *
 * The formula's origin is on axis 1 at the height of axis 2; the wrist frame is where axes 5 and 6 meet.
 */
export interface ThreeParallelGeometry {
  readonly kind: "three-parallel";
  readonly a1_m: number;
  readonly b_m: number;
  readonly c2_m: number;
  readonly c3_m: number;
  readonly c5_m: number;
  readonly offsets_rad: readonly [number, number, number, number, number, number];
  readonly signs: readonly [number, number, number, number, number, number];
  readonly baseFromFormula: Pose<"base", "formula">;
  readonly wristFromFlange: Pose<"wrist", "flange">;
}

/**
 * Ortho-parallel basis whose wrist axes need not meet in one point: axis 1 square to axis 2, axes 2 and 3 parallel,
 * axes 4 and 5 meet; axis 6 may lie anywhere (ABB GoFa, FANUC CRX). Up to 16 postures, found by a search over θ6.
 *
 *   formulaFromWrist = Rz(θ1) · T(a1, b, 0) · Ry(θ2) · Tz(c2) · Ry(θ3) · T(centre) · Rot(axis4, θ4) · Rot(axis5, θ5) ·
 *   turn · Tx(e) · Rz(θ6)
 *
 * The formula's origin is on axis 1 at the height of axis 2. The wrist frame is on axis 6, where that is nearest to the
 * centre: the point where axes 4 and 5 meet.
 */
export interface GeneralSixGeometry {
  readonly kind: "general-6r";
  readonly a1_m: number;
  readonly b_m: number;
  readonly c2_m: number;
  readonly e_m: number;
  /** x and z from axis 3 to the centre [m]. */
  readonly centre_m: readonly [number, number];
  /** Unit vectors in the frame of link 3, θ4 = 0. */
  readonly axis4: Vector3;
  readonly axis5: Vector3;
  /** Link 3 from link 5, θ4 = θ5 = 0: z along axis 6, x from the centre to it. */
  readonly turn: Quaternion;
  readonly offsets_rad: readonly [number, number, number, number, number, number];
  readonly signs: readonly [number, number, number, number, number, number];
  readonly baseFromFormula: Pose<"base", "formula">;
  readonly wristFromFlange: Pose<"wrist", "flange">;
}

/**
 * Seven joints, shoulder and wrist each three axes through one point, and an elbow between (LBR iiwa).
 *
 *   formulaFromWrist = Rz(θ1) · Ry(θ2) · Rz(θ3) · Tz(c3) · Ry(θ4) · Rz(θ5) · Tz(c5) · Ry(θ6) · Rz(θ7)
 *
 * The formula's origin is the shoulder. An arm may miss the formula by `deviation_m` (CAD offsets of less than a
 * millimetre): its postures are found by moving the formula's target until forward kinematics of the arm meets the
 * wanted pose.
 */
export interface SphericalSevenGeometry {
  readonly kind: "spherical-seven";
  readonly c3_m: number;
  readonly c5_m: number;
  readonly offsets_rad: readonly [number, number, number, number, number, number, number];
  readonly signs: readonly [number, number, number, number, number, number, number];
  readonly baseFromFormula: Pose<"base", "formula">;
  readonly wristFromFlange: Pose<"wrist", "flange">;
  /** The largest distance between flange and formula over all postures tried [m]. */
  readonly deviation_m: number;
}

/** How the inverse of an arm is solved. Grows by new kinds. */
export type KinematicFamily =
  | OrthoParallelGeometry
  | ThreeParallelGeometry
  | SphericalSevenGeometry
  | GeneralSixGeometry
  | { readonly kind: "general" };

/**
 * How far from axis 2 the maker lets the wrist centre go. Poses beyond it are refused even where the links would reach.
 */
export interface DeclaredWorkspace {
  readonly reach_m: number;
  /** The wrist centre seen from the flange [m]. */
  readonly wristInFlange_m: Vector3;
}

/** A robot of the library: one data file each, every number with its source. */
export interface Robot {
  readonly id: string;
  readonly name: string;
  /** The maker. */
  readonly vendor: string;
  /** What the maker's controllers need: without it no language and no driver takes the robot. */
  readonly vendorSection?: VendorSection;
  readonly arm: SerialArm;
  readonly family: KinematicFamily;
  /** Names of the root link, of the tip frame and of the vendor's world, as URDFs of this robot call them. */
  readonly frames: { readonly base: string; readonly tip: string };
  /** The vendor's world origin seen from the root link: V+ counts from the shoulder. */
  readonly baseFromVendorWorld: Pose<"base", "vendor-world">;
  readonly home_rad: readonly number[];
  /**
   * Nominal load and load at reduced speed; missing where no source states them, and then nothing is judged by them.
   */
  readonly payload_kg?: number;
  readonly payloadMax_kg?: number;
  /** Reach, published or computed (`sources` and `assumptions` say which), and between which points it is measured. */
  readonly reach_m: number;
  readonly reachMeasuredFrom: "axis-1" | "axis-2";
  readonly reachMeasuredTo: "flange" | "wrist";
  /** Workspace that the maker declares smaller than the geometry would allow (row X-08). */
  readonly workspace?: DeclaredWorkspace;
  /** Missing where no source states it. */
  readonly repeatability_m?: number;
  readonly maxTcpSpeed_mps: number;
  /** Mass of the whole robot, base included, without cables and controller. */
  readonly mass_kg?: number;
  /** Masses of links 1 … n, where they are published. The base does not move. */
  readonly masses?: readonly LinkMass[];
  /**
   * True when nobody publishes the lengths of the arm and they were made up: results on geometry say nothing about the
   * real robot.
   */
  readonly madeUpGeometry?: boolean;
  /** True where no program that is not this project's was held against the arm's forward kinematics. */
  readonly unverified?: true;
  /** How it looks; without it the arm is drawn from its dimensions alone. */
  readonly form?: RobotForm;
  /** Links 0 … n as the robot's own files draw them: they go before the form and the dimensions. */
  readonly links?: readonly OwnLink[];
  /** Colours as the maker paints it. */
  readonly paint?: RobotPaint;
  /** quantity → where the number comes from. */
  readonly sources: Readonly<Record<string, string>>;
  /** What is not published and was assumed, one sentence each; shown beside every result that rests on it. */
  readonly assumptions: readonly string[];
  /** How far a drawn shape may be from the real casting [m]; added to every clearance margin. */
  readonly shapeError_m: number;
}
