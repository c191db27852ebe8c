import type { Payload } from "../dynamics/model.ts";
import type { TriangleMesh } from "../mesh/mesh.ts";
import type { Robot } from "../model/robot.ts";
import type { Point2 } from "../mesh/polygon.ts";
import type { Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";
import type { Person, PeopleZone } from "./people.ts";

/** A solid in its own frame, z up. */
export type SolidShape =
  /** Centred on the origin. */
  | { readonly kind: "box"; readonly size_m: Vector3 }
  /** Around the origin. */
  | { readonly kind: "sphere"; readonly radius_m: number }
  /** Axis z, from z = 0 to height. */
  | { readonly kind: "cylinder"; readonly radius_m: number; readonly height_m: number }
  /** Turned about z: [radius, z] from bottom to top; with `ring` a closed outline that stays off the axis. */
  | { readonly kind: "revolved"; readonly profile_m: readonly Point2[]; readonly ring?: boolean }
  | { readonly kind: "mesh"; readonly mesh: TriangleMesh };

/** A belt: the whole upper side of an object moves what lies on it (row M-54). */
export interface Belt {
  /** Unit vector in the object's frame. */
  readonly direction: Vector3;
  readonly speed_mps: number;
  /** Runs while this signal is as said; always when left out. */
  readonly runs?: { readonly signal: string; readonly is: boolean };
}

/** Something in the cell that can be touched. */
export interface PhysicalObject {
  readonly id: string;
  readonly name: string;
  readonly worldFromObject: Pose<"world", "object">;
  readonly shape: SolidShape;
  /** A part falls, is pushed and may be grasped; a fixture stands still and never is (row M-19). */
  readonly role: "part" | "fixture";
  /** Of a part. Left out, it follows from the volume and `density_kgm3`. */
  readonly mass_kg?: number;
  readonly density_kgm3?: number;
  /**
   * Coulomb's coefficient of its surface (row X-16). Where two surfaces say one, the larger counts; where none does,
   * `FRICTION`.
   */
  readonly friction?: number;
  /**
   * Time in which a contact of its surface gives way [s]: the softer the longer (row X-16). `CONTACT_S` when left out.
   */
  readonly softness_s?: number;
  readonly belt?: Belt;
}

/** Two parallel fingers on the flange that close towards each other and hold by friction. */
export interface Gripper {
  readonly name: string;
  /** Where the middle between the finger tips is: z points away from the flange, the fingers move along x. */
  readonly flangeFromGrip: Pose<"flange", "grip">;
  /** Between the fingers, fully open and fully closed [m]. */
  readonly open_m: number;
  readonly closed_m: number;
  /** Of each finger on what it closes on. */
  readonly force_N: number;
  /** Of a finger [m]: thickness along x, width along y, length along z up to the grip point and `beyond_m` past it. */
  readonly finger_m: Vector3;
  readonly beyond_m: number;
  /** Of each finger. */
  readonly speed_mps: number;
  readonly friction: number;
  /** Whole gripper; it counts as payload. */
  readonly mass_kg: number;
}

/** What trips a sensor. */
export type Seen = "part" | "robot" | "person";

/** A sensor that drives a line (rows T-27, T-55). All places are in the world. */
export type Sensor = {
  readonly id: string;
  readonly name: string;
  /** The line is true while the sensor is tripped. */
  readonly signal: string;
  readonly sees: readonly Seen[];
  /** Tripped, it also stops the robot until a person lets it go on (row T-27). */
  readonly stops?: true;
} /** A photo-cell: tripped while something is between its two ends. */ & (
  | { readonly kind: "beam"; readonly from_m: Vector3; readonly to_m: Vector3 }
  /** Tripped while something is nearer than its range. */
  | { readonly kind: "proximity"; readonly at_m: Vector3; readonly range_m: number }
);

/** How the arm follows what it is told. */
export type ArmControl =
  /** It is where it is told to be, whatever it touches: for robots whose masses nobody publishes. */
  | { readonly kind: "moved" }
  /**
   * Row L-12: a spring and a damper on every joint beside what holds the arm's own weight; torques saturate (row L-70).
   */
  | { readonly kind: "drives"; readonly bandwidth_rad_s: number }
  /** Row L-68. */
  | { readonly kind: "computed-torque"; readonly bandwidth_rad_s: number };

/** Everything a physical cell is made of; crosses a worker's border by structured clone. */
export interface PhysicalScene {
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  /** Posture at the start [rad; m of slides], at rest. */
  readonly q_rad: readonly number[];
  readonly control: ArmControl;
  readonly gripper?: Gripper;
  /** What the flange carries for good, beside the gripper. */
  readonly payload?: Payload;
  readonly objects: readonly PhysicalObject[];
  readonly sensors: readonly Sensor[];
  readonly people: readonly Person[];
  readonly zones: readonly PeopleZone[];
  /** The floor is at this height [m]; none when left out. */
  readonly floor_m?: number;
  /** One step of the integration [s]; `PHYSICS_STEP_S` when left out. */
  readonly step_s?: number;
}

/** Dry contact of machined parts, cardboard and rubber lies around it; nobody's data, said beside the results. */
export const FRICTION = 0.6;
/** Of a part whose mass nobody says: packed goods; assumed. */
export const DENSITY_KGM3 = 500;
/** A hard contact: two steps of the integration. */
export const CONTACT_S = 0.004;
export const PHYSICS_STEP_S = 0.002;

/** A light electric gripper for parts up to 100 mm: the pads of its fingers end 12 mm past the grip point. */
export const PARALLEL_GRIPPER: Gripper = {
  name: "Parallel gripper",
  flangeFromGrip: { position: [0, 0, 0.14], quaternion: [0, 0, 0, 1] },
  open_m: 0.11,
  closed_m: 0,
  force_N: 140,
  finger_m: [0.012, 0.03, 0.07],
  beyond_m: 0.012,
  speed_mps: 0.25,
  friction: 0.9,
  mass_kg: 0.08,
};
