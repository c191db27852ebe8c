import type { Contact } from "../collision/cell.ts";
import { robotAndCell, type CellCollider, type SolidPair } from "../collision/cell-collider.ts";
import type { MotionVerdict } from "../collision/motion.ts";
import type { SerialArm } from "../model/arm.ts";
import { alongLine, distanceBetween, PathValidator } from "./path-validator.ts";

/**
 * What a motion by hand does where it would touch something: only an alert (rows N-47 … N-50); the same, but the point
 * cannot be taught (T-42); stop and go back to the last safe posture (T-43); slide along the surface; or, where a
 * target is known, find another way to it, and slide where none is.
 */
export type CollisionBehaviour = "alert" | "refuse" | "stop" | "slide" | "untangle";
export const COLLISION_BEHAVIOURS: readonly CollisionBehaviour[] = ["alert", "refuse", "stop", "slide", "untangle"];

export type HandStep =
  | { readonly kind: "moved" }
  /** Went along the surface of what it met. */
  | { readonly kind: "slid"; readonly contact: Contact }
  /** Did not move; `safe_rad` is the last posture with room around it: lent, copy it to keep it. */
  | { readonly kind: "stopped"; readonly contact: Contact; readonly safe_rad: Float64Array };

/**
 * Kept between robot and cell while stopping or sliding, with the robot's shape error on top as `marginOf` says [m].
 */
const KEPT_M = 0.002;
/** A posture with this much room is one to go back to [m]. */
const SAFE_M = 0.01;
/** Joint angles differ by this when the slope of a distance is taken [rad]. */
const PROBE_RAD = 1e-4;
/**
 * Surfaces slid along at once: a corner has three, and a face that lies flat against another changes its nearest
 * corner.
 */
const MOST_SURFACES = 6;
/** Outwards in each of them, so that a curved surface is not met by the next step [m]. */
const PUSH_M = 0.0001;
const HALVINGS = 3;
const MOVED: HandStep = { kind: "moved" };

/**
 * Guards steps that a hand makes. Only for what is shown or simulated: real robots have the guard of their controller.
 */
export class HandGuard {
  readonly #collider: CellCollider;
  /** With the margin, with ample room, and without any. */
  readonly #kept: PathValidator;
  readonly #safe: PathValidator;
  readonly #bare: PathValidator;
  readonly #wanted: Float64Array;
  readonly #probe: Float64Array;
  readonly #slope: Float64Array;
  readonly #safe_rad: Float64Array;

  constructor(collider: CellCollider, arm: SerialArm) {
    const n = arm.joints.length;
    this.#collider = collider;
    this.#kept = new PathValidator(collider, arm, { margin_m: KEPT_M, keepsMargin: robotAndCell });
    this.#safe = new PathValidator(collider, arm, { margin_m: SAFE_M, keepsMargin: robotAndCell });
    this.#bare = new PathValidator(collider, arm);
    this.#wanted = new Float64Array(n);
    this.#probe = new Float64Array(n);
    this.#slope = new Float64Array(n);
    this.#safe_rad = new Float64Array(n);
  }

  /** Where to go back to when a motion begins here; call it before the first step. */
  begin(q: ArrayLike<number>): void {
    this.#safe_rad.set(q);
  }

  /**
   * Takes a small step from `from` towards `to` as the behaviour wants it; writes where to. Who stands nearer than the
   * margin already only may not touch, and who stands in contact may always move: there must be a way out.
   */
  step(behaviour: CollisionBehaviour, from: ArrayLike<number>, to: ArrayLike<number>, out: Float64Array): HandStep {
    const wanted = this.#wanted;
    wanted.set(to);
    if (behaviour === "alert" || behaviour === "refuse" || !this.#bare.free(from)) {
      out.set(wanted);
      return MOVED;
    }
    const rules = this.#kept.free(from) ? this.#kept : this.#bare;
    const verdict = rules.prove(from, wanted);
    if (verdict.kind === "clear") {
      if (this.#safe.free(wanted)) this.#safe_rad.set(wanted);
      out.set(wanted);
      return MOVED;
    }
    const contact = contactOf(verdict);
    if (contact === null || behaviour === "stop" || !this.#slide(rules, from, wanted)) {
      for (let i = 0; i < out.length; i++) out[i] = from[i]!;
      return { kind: "stopped", contact: contact ?? rules.inTheWay(to) ?? UNNAMED, safe_rad: this.#safe_rad };
    }
    out.set(wanted);
    return { kind: "slid", contact };
  }

  /**
   * Takes out of the step what leads into each surface it meets:
   *   dq ← dq − (∇d · dq / |∇d|²) ∇d  where ∇d · dq < 0, with ∇d the
   * slope of the pair's distance over the joints. Returns whether something is left that is proven clear.
   */
  #slide(rules: PathValidator, from: ArrayLike<number>, wanted: Float64Array): boolean {
    const asked = distanceBetween(from, wanted);
    for (let surface = 0; surface < MOST_SURFACES; surface++) {
      const verdict = rules.prove(from, wanted);
      if (verdict.kind === "clear") return distanceBetween(from, wanted) > 1e-3 * asked;
      if (verdict.kind !== "contact") return false;
      const pair = this.#collider.pairs.find(({ contact }) => contact.a === verdict.a && contact.b === verdict.b);
      if (pair === undefined || !this.#takeOut(pair, from, wanted)) return false;
    }
    for (let i = 0; i < HALVINGS; i++) {
      alongLine(from, wanted, 0.5, wanted);
      if (rules.prove(from, wanted).kind === "clear") return distanceBetween(from, wanted) > 1e-3 * asked;
    }
    return false;
  }

  #takeOut(pair: SolidPair, from: ArrayLike<number>, wanted: Float64Array): boolean {
    const slope = this.#slope;
    const probe = this.#probe;
    const here = this.#gap(pair, from);
    let along = 0;
    let square = 0;
    for (let k = 0; k < slope.length; k++) {
      for (let i = 0; i < probe.length; i++) probe[i] = from[i]!;
      probe[k] = probe[k]! + PROBE_RAD;
      slope[k] = (this.#gap(pair, probe) - here) / PROBE_RAD;
      along += slope[k]! * (wanted[k]! - from[k]!);
      square += slope[k]! * slope[k]!;
    }
    if (!(square > 1e-12) || !Number.isFinite(square)) return false;
    const out = Math.min(0, along) - PUSH_M;
    for (let k = 0; k < slope.length; k++) wanted[k] = wanted[k]! - (out / square) * slope[k]!;
    return true;
  }

  #gap(pair: SolidPair, q: ArrayLike<number>): number {
    this.#collider.place(q);
    return this.#collider.distanceOf(pair, 1);
  }
}

const contactOf = (verdict: MotionVerdict): Contact | null =>
  verdict.kind === "contact" ? { a: verdict.a, b: verdict.b, between: verdict.between } : null;
/** A motion that could not be decided and ends in no contact: it is not taken, and nothing can be named. */
const UNNAMED: Contact = { a: "", b: "", between: "other" };
