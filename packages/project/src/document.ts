import type { Belt, Gripper, PairMatrix, PeopleZone, Person, Pose, Program, Sensor, Vector3 } from "@twincell/core";
import { TEXT_PROGRAM_FORMAT, type TextProgram } from "./text-program.ts";

/** How a solid is described in a saved cell. Origin and axes are the object's own frame, z up. */
export type Shape =
  /** Centred on the origin. */
  | { readonly kind: "box"; readonly size_m: Vector3 }
  /** Axis z, from z = 0 to height. */
  | { readonly kind: "cylinder"; readonly radius_m: number; readonly height_m: number }
  /** Turned about z: [radius, z] from bottom to top. */
  | { readonly kind: "revolved"; readonly profile_m: readonly (readonly [number, number])[] }
  /** A part of the library with its numbers: metres, metres a second, counts. */
  | { readonly kind: "part"; readonly part: string; readonly parameters: Readonly<Record<string, number>> }
  /** An imported mesh: little-endian float32 positions and uint32 indices in base64. */
  | { readonly kind: "mesh"; readonly file: string; readonly positions: string; readonly indices: string };

export interface ToolRecord {
  readonly name: string;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
  /** In the flange frame. */
  readonly shape?: Shape;
  /** What it weighs; that of its part of the library, or of its fingers, when left out. */
  readonly mass_kg?: number;
  /** Fingers that close around the TCP, for the simulation with physics. */
  readonly gripper?: Omit<Gripper, "name" | "flangeFromGrip">;
}

export interface ObjectRecord {
  readonly id: string;
  readonly name: string;
  readonly role: "workpiece" | "fixture" | "furniture" | "wall";
  readonly worldFromObject: Pose<"world", "object">;
  readonly shape: Shape;
  /** #rrggbb */
  readonly color: string;
  /** What may stand on it, as its maker says: the robot with its load is held against it. */
  readonly carries_kg?: number;
  /** What it weighs; of a work piece, for the simulation with physics (row X-55). */
  readonly mass_kg?: number;
  /** Coulomb's coefficient of its surface, and the time in which a contact gives way [s] (row X-16). */
  readonly friction?: number;
  readonly softness_s?: number;
  /** It moves what lies on it. */
  readonly belt?: Belt;
  /** Objects of one group are selected and moved together. */
  readonly group?: string;
  /** Not drawn; checks and physics still know it. */
  readonly hidden?: true;
  /** Not picked in the 3D view and not moved there. */
  readonly locked?: true;
}

/** What a frame belongs to: it moves with the object. */
export interface Attachment {
  /** Id of the object. */
  readonly object: string;
  readonly objectFromFrame: Pose<"object", "frame">;
}

/** A user frame; `saved`: a pose of the tool tip that a person saved, to go through it later (rows L-44 … L-49). */
export interface FrameRecord {
  readonly name: string;
  /** Where it is now; of an attached frame worldFromObject · objectFromFrame, which `followObjects` keeps true. */
  readonly worldFromFrame: Pose<"world", "frame">;
  readonly saved?: true;
  readonly attachedTo?: Attachment;
  readonly hidden?: true;
  readonly locked?: true;
}

/** A program of a cell: steps, or a vendor's text that is run and patched as it is. */
export type CellProgram = Program | TextProgram;

export const isTextProgram = (program: CellProgram): program is TextProgram => program.format === TEXT_PROGRAM_FORMAT;

/** Which parts of the robot are checked against which, and the robot and tool it was learnt with. */
export interface PairsRecord extends PairMatrix {
  readonly robot: string;
  readonly tool: string;
}

/** Measured on the real cell: none is known when left out. */
export interface CellErrorsRecord {
  /** Residual of the registration of robot and objects: how far an object may be from where it is drawn [m]. */
  readonly registration_m?: number;
  /** How far the tool of the real robot may be from that of the twin [m]. */
  readonly twin_m?: number;
}

/** The robot of a cell: one of the library or catalogue, or one that the cell brings with it. */
export interface RobotRecord {
  readonly id: string;
  readonly worldFromBase: Pose<"world", "base">;
  /** The robot file of a robot that is in no library; its id is the one above. */
  readonly file?: Readonly<Record<string, unknown>> & { readonly id: string };
}

/** What somebody says about a step, to the others. */
export interface StepComment {
  readonly id: string;
  /** Name of the program and id of the step in it; a comment on a step that is gone is kept and not shown. */
  readonly program: string;
  readonly step: string;
  readonly who: string;
  /** ISO 8601, UTC. */
  readonly at: string;
  readonly text: string;
  /** It was answered or done. */
  readonly done?: true;
}

/** Everything a person saves: one robot, its tools, what stands around it, and the programs taught there. */
export interface CellDocument {
  readonly format: "twincell.cell";
  readonly version: 2;
  readonly name: string;
  /** Made for people who learn: tasks to do, hints, nothing that drives a real robot. */
  readonly training?: true;
  readonly robot: RobotRecord;
  /** What the cell is not known better than; counted in every distance that is checked or guarded. */
  readonly errors?: CellErrorsRecord;
  readonly tools: readonly ToolRecord[];
  /** Name of the tool in use; "flange" for none. */
  readonly tool: string;
  readonly objects: readonly ObjectRecord[];
  readonly frames: readonly FrameRecord[];
  /** Pairs of solids that may touch, by object id, "tool" or "link n". */
  readonly allowedPairs: readonly (readonly [string, string])[];
  /** What the simulation with physics watches and lets walk; none when left out. */
  readonly sensors?: readonly Sensor[];
  readonly people?: readonly Person[];
  readonly zones?: readonly PeopleZone[];
  /**
   * The matrix of the robot's own pairs, once a person has learnt or edited it; without it what touches at home is left
   * out.
   */
  readonly pairs?: PairsRecord;
  readonly programs: readonly CellProgram[];
  /** What people say about steps; none when left out. */
  readonly comments?: readonly StepComment[];
  /** Name of the program being worked on. */
  readonly program: string;
}

/** A cell whose programs are all of steps, as the examples are. */
export interface StepsCell extends CellDocument {
  readonly programs: readonly Program[];
}
