import { CellCollider, clearance as noClearance, robotAndCell } from "../../collision/cell-collider.ts";
import type { CellGeometry } from "../../collision/cell.ts";
import { certifyMotion } from "../../collision/certificate.ts";
import { ClearanceMaps } from "../../collision/clearance-map.ts";
import { checkMotion, type MotionVerdict } from "../../collision/motion.ts";
import type { SerialArm } from "../../robots/arm.ts";
import { resolveMove, type Move } from "../../trajectory/moves.ts";
import type { MotionSegment } from "../../trajectory/plan.ts";
import { RunPlanner } from "../../trajectory/run.ts";
import { sampleSegment } from "../../trajectory/sample.ts";
import { motionOf, type SegmentCertificate } from "../certificate.ts";
import { freshStepIds } from "../edit.ts";
import type { MoveStep } from "../program.ts";
import type { Repair } from "../verdict.ts";
import { raised } from "./repairs.ts";
import { nameOf } from "./solid-names.ts";
import { motions, seconds, type CheckScene } from "./scene.ts";

export interface CollisionOptions {
  readonly cell: CellGeometry;
  /** Distance the robot keeps from the cell [m]; 0 asks for no contact only. Its own parts must not touch. */
  readonly margin_m: number;
  /** Receives the proof of every motion that is clear. */
  readonly certificates?: SegmentCertificate[];
  readonly onProgress?: (share: number) => void;
  readonly cancelled?: () => boolean;
}

/** Heights a target is raised by to get clear [m]. */
const RAISES_M = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2];
/** Findings that get repairs tried on them: each attempt plans and proves a motion. */
const MOST_REPAIRED = 4;
/** Postures at which the clearance is measured: so many over the whole program. */
const CLEARANCE_LOOKS = 200;
/** Clearance above this is plenty and not measured [m]. */
const CLEARANCE_CUTOFF_M = 0.5;

/**
 * Proves every motion of the plan free of contact, between the nodes as well; standing still is covered by the motions
 * that end there.
 *
 * @returns the least clearance seen between robot and cell [m]; null when there is nothing to keep clear of.
 */
export function checkCollision(scene: CheckScene, options: CollisionOptions): { readonly clearance_m: number | null; readonly unproven: ReadonlySet<string> } {
  const collider = new CellCollider(options.cell, scene.robot.arm), prover = new Prover(collider, options.margin_m, scene.robot.arm);
  collider.allowContactsAt(scene.robot.home_rad);
  const unproven = new Set<string>(), found = new Set<string>(), all = [...motions(scene)];
  let repaired = 0;
  for (let i = 0; i < all.length; i++) {
    const segment = all[i]!;
    if (options.cancelled?.() === true) { for (const rest of all.slice(i)) unproven.add(rest.step); break; }
    options.onProgress?.(i / all.length);
    const { verdict, certificate } = options.certificates === undefined ? { verdict: prover.prove(segment), certificate: null } : prover.certify(segment);
    if (certificate !== null) options.certificates?.push({ step: segment.step, start_s: segment.start_s, ...certificate });
    if (verdict.kind === "undecided") unproven.add(segment.step);
    if (verdict.kind !== "contact" || found.has(segment.step)) continue;
    found.add(segment.step);
    const a = nameOf(verdict.a, options.cell), b = nameOf(verdict.b, options.cell), at_s = segment.start_s + verdict.at;
    const sentence = verdict.margin_m > 0 && verdict.distance_m > 0
      ? `${capital(a)} comes within ${mm(verdict.distance_m)} of ${b} at ${seconds(at_s)}; the margin is ${mm(verdict.margin_m)}.`
      : `${capital(a)} touches ${b} at ${seconds(at_s)}.`;
    const move = scene.layout.moves.get(segment.step);
    const repairs = move === undefined || repaired >= MOST_REPAIRED ? [] : collisionRepairs(scene, move, prover, segment, verdict.at);
    repaired++;
    scene.add(segment.step, "bad", { code: "collision.contact", value: verdict.distance_m, limit: verdict.margin_m, unit: "m", at_s, sentence, repairs });
  }
  return { clearance_m: options.cell.objects.length === 0 ? null : leastClearance(collider, all, options.cancelled), unproven };
}

/** Proves single motions; keeps the working memory of one collider. */
class Prover {
  private readonly collider: CellCollider;
  private readonly margin_m: number;
  private readonly rates: Float64Array;
  private readonly maps: ClearanceMaps;
  constructor(collider: CellCollider, margin_m: number, arm: SerialArm) {
    this.collider = collider; this.margin_m = margin_m; this.rates = new Float64Array(arm.joints.length); this.maps = new ClearanceMaps(collider, arm);
  }

  prove(segment: MotionSegment): MotionVerdict {
    return checkMotion(this.collider, motionOf(segment, this.rates), 0, segment.duration_s, { margin_m: this.margin_m, keepsMargin: robotAndCell, maps: this.maps });
  }

  /** As `prove`, and what proves it; slower, because nothing that was found before is used. */
  certify(segment: MotionSegment): ReturnType<typeof certifyMotion> {
    return certifyMotion(this.collider, motionOf(segment, this.rates), 0, segment.duration_s, { margin_m: this.margin_m, keepsMargin: robotAndCell });
  }
}

function leastClearance(collider: CellCollider, all: readonly MotionSegment[], cancelled: (() => boolean) | undefined): number {
  const near = noClearance(), total_s = all.reduce((sum, segment) => sum + segment.duration_s, 0), period_s = total_s / CLEARANCE_LOOKS;
  let least = CLEARANCE_CUTOFF_M, due_s = 0, passed_s = 0;
  const q = new Float64Array(all[0] === undefined ? 0 : all[0].q_rad.length / all[0].times_s.length);
  for (const segment of all) {
    if (cancelled?.() === true) break;
    for (; due_s <= passed_s + segment.duration_s; due_s += period_s) {
      sampleSegment(segment, due_s - passed_s, q);
      collider.clearance(q, least, near, robotAndCell);
      least = Math.min(least, near.distance_m);
      if (!(period_s > 0)) break;
    }
    passed_s += segment.duration_s;
  }
  return least;
}

/** Targets and extra points higher up that are proven to be free, on the way there. */
function collisionRepairs(scene: CheckScene, move: Move, prover: Prover, segment: MotionSegment, at_s: number): Repair[] {
  const planner = new RunPlanner(scene.robot), start = scene.layout.starts.get(move.step.id);
  if (start === undefined) return [];
  const free = (steps: readonly MoveStep[]): boolean => {
    let q = start;
    for (const step of steps) {
      const answer = planner.plan([resolveMove({ ...step, blend_m: 0, blend_ratio: 0 }, scene.robot, scene.context)], q);
      if (answer.kind === "stopped") return false;
      for (const part of answer.run.parts) {
        if (part.times_s.length > 1 && prover.prove(part).kind !== "clear") return false;
        q = part.q_rad.slice(part.q_rad.length - start.length);
      }
    }
    return true;
  };
  const found: Repair[] = [], [viaId] = freshStepIds(scene.program, 1);
  const late = at_s > segment.duration_s * 0.98;
  for (const height of RAISES_M) {
    const higher = raised(scene, move, height);
    if (higher === undefined) break;
    const step: MoveStep = { ...move.step, target: higher.target };
    if (free([step])) { found.push({ sentence: `Raise the target by ${mm(height)}.`, replace: step }); break; }
  }
  // Where only the way is blocked, an extra point above the target leads round.
  if (!late) {
    for (const height of RAISES_M.slice(3)) {
      const above = raised(scene, move, height);
      if (above === undefined) break;
      const via: MoveStep = { id: viaId!, type: "move", path: "ptp", target: above.target, speed: "ratio" in move.step.speed ? move.step.speed : { ratio: 0.25 }, blend_m: 0 };
      if (free([via, move.step])) { found.push({ sentence: `Go there over a point ${mm(height)} above the target.`, insertBefore: [via] }); break; }
    }
  }
  return found;
}

const mm = (length_m: number): string => `${(length_m * 1000).toFixed(length_m < 0.01 ? 1 : 0)} mm`;
const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);
