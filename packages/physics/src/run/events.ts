import type { GraspSignal, Refusal } from "@twincell/core";

/** Something that happened in a run, with its time and the sentence for the log. */
export type PhysicsEvent = { readonly at_s: number; readonly sentence: string } & (
  | { readonly kind: "grasp"; readonly part: string; readonly signal: GraspSignal }
  /** Row X-55: what is between the fingers weighs this, before it is lifted. */
  | { readonly kind: "weighed"; readonly part: string; readonly mass_kg: number }
  /** The fingers are closed and the part is not between them any more. */
  | { readonly kind: "dropped"; readonly part: string }
  | { readonly kind: "sensor"; readonly sensor: string; readonly tripped: boolean }
  | { readonly kind: "zone"; readonly zone: string; readonly person: string; readonly inside: boolean }
  /** The robot is slowed down, stopped or let go on. */
  | { readonly kind: "override"; readonly override: number }
  | { readonly kind: "paused"; readonly why: Refusal }
  | { readonly kind: "done" }
);
