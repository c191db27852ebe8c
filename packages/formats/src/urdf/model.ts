import type { Pose, Vector3 } from "@twincell/core";

/** What a URDF says, link by link; lengths in metres, angles in radians. Plain data. */
export interface UrdfRobot {
  readonly name: string;
  /** The one link that is nobody's child. */
  readonly root: string;
  readonly links: readonly UrdfLink[];
  readonly joints: readonly UrdfJoint[];
}

export interface UrdfLink {
  readonly name: string;
  readonly visuals: readonly UrdfShape[];
  readonly collisions: readonly UrdfShape[];
  readonly inertial?: {
    readonly linkFromInertial: Pose<"link", "inertial">;
    readonly mass_kg: number;
    readonly inertia_kg_m2: readonly number[];
  };
}

export type UrdfGeometry =
  | { readonly kind: "mesh"; readonly reference: string; readonly scale: Vector3 }
  | { readonly kind: "box"; readonly size_m: Vector3 }
  | { readonly kind: "cylinder"; readonly radius_m: number; readonly length_m: number }
  | { readonly kind: "sphere"; readonly radius_m: number };

export interface UrdfShape {
  readonly linkFromShape: Pose<"link", "shape">;
  readonly geometry: UrdfGeometry;
  /** Red, green, blue, opacity, 0 … 1, when the file gives a colour. */
  readonly rgba?: readonly number[];
}

export interface UrdfJoint {
  readonly name: string;
  readonly type: "revolute" | "continuous" | "prismatic" | "fixed" | "floating" | "planar";
  readonly parent: string;
  readonly child: string;
  readonly parentFromJoint: Pose<"parent", "joint">;
  /** Unit vector in the joint's frame. */
  readonly axis: Vector3;
  readonly limit?: {
    readonly lower: number;
    readonly upper: number;
    readonly velocity: number;
    readonly effort: number;
  };
  readonly mimic?: { readonly joint: string; readonly multiplier: number; readonly offset: number };
  readonly line: number;
}

export type UrdfRead = { readonly kind: "read"; readonly robot: UrdfRobot; readonly warnings: readonly string[] };
