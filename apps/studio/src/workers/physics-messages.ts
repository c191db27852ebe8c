import type { GraspSignal, Program } from "@twincell/core";
import type { CellDocument } from "@twincell/project";

/**
 * What the page tells the physics worker. Time passes only when the page lets it: one "advance" is under way at a time.
 */
export type ToPhysics =
  | { readonly kind: "start"; readonly edition: number; readonly document: CellDocument; readonly program: Program }
  | { readonly kind: "advance"; readonly edition: number; readonly dt_s: number; readonly override: number }
  | { readonly kind: "resume"; readonly edition: number };

/** The cell at one instant. */
export interface PhysicsFrame {
  readonly t_s: number;
  readonly q_rad: Float64Array;
  /** Seven numbers of each part: x y z [m], quaternion x y z w. */
  readonly parts: Float64Array;
  readonly opening_m: number;
  readonly grasp: readonly GraspSignal[];
  /** 1 where a sensor is tripped, in the order of the document. */
  readonly tripped: Uint8Array;
  /** x, y [m] and heading [rad] of each person. */
  readonly people: Float64Array;
  readonly step: string;
}

export type FromPhysics =
  | {
      readonly kind: "ready";
      readonly edition: number;
      readonly parts: readonly string[];
      readonly assumptions: readonly string[];
      readonly frame: PhysicsFrame;
    }
  | {
      readonly kind: "frame";
      readonly edition: number;
      readonly state: "running" | "paused" | "done";
      readonly stopped: boolean;
      readonly frame: PhysicsFrame;
      readonly said: readonly string[];
      readonly why: string;
    }
  | { readonly kind: "refused"; readonly edition: number; readonly sentence: string; readonly hint: string };
