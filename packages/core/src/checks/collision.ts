import { CellCollider, clearance as noClearance, robotAndCell } from "../collision/cell-collider.ts";
import type { CellGeometry } from "../collision/cell.ts";
import type { MotionVerdict } from "../collision/motion.ts";
import { resolveMove, type Move } from "../trajectory/moves.ts";
import type { MotionSegment, Segment } from "../trajectory/plan.ts";
import { RunPlanner } from "../trajectory/run.ts";
import { sampleSegment } from "../trajectory/sample.ts";
import type { SegmentCertificate } from "./certificate.ts";
import { cornerArea, type CornerArea } from "./corner-area.ts";
import type { CornerCertificate } from "./corner-certificate.ts";
import { certifyCorner, cornersOf, judgeCorner, type InCorner, type PassedCorner } from "./corners.ts";
import { freshStepIds } from "../program/edit.ts";
import { GraspedParts, type CarriedPart, type Stretch } from "./grasped-parts.ts";
import { Prover } from "./prover.ts";
import type { MoveStep } from "../program/program.ts";
import type { Repair } from "./verdict.ts";
import { raised } from "./repairs.ts";
import { nameOf } from "./solid-names.ts";
import { motions, seconds, type CheckScene } from "./scene.ts";

export interface CollisionOptions {
  readonly cell: CellGeometry;
  /** Distance the robot keeps from the cell and its own parts from each other, as `marginOf` says [m]. */
  readonly margin_m: number;
  /** Receives the proof of every motion that is clear. */
  readonly certificates?: SegmentCertificate[] | undefined;
  /** Receives the proof of every corner that is clear whatever curve a controller takes in it. */
  readonly corners?: CornerCertificate[] | undefined;
  /** Receives the area of every corner, clear or not. */
  readonly areas?: CornerArea[] | undefined;
  readonly onProgress?: ((share: number) => void) | undefined;
  readonly cancelled?: (() => boolean) | undefined;
}

/** Heights a target is raised by to get clear [m]. */
const RAISES_M = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2];
/** Findings that get repairs tried on them: each attempt plans and proves a motion. */
const MOST_REPAIRED = 4;
/** Postures at which the clearance is measured: so many over the whole program. */
const CLEARANCE_LOOKS = 200;
/** Clearance above this is plenty and not measured [m]. */
const CLEARANCE_CUTOFF_M = 0.5;

/** What was found beside the findings. */
export interface Collisions {
  /** The least clearance seen between robot and cell [m]; null when there is nothing to keep clear of. */
  readonly clearance_m: number | null;
  readonly unproven: ReadonlySet<string>;
  /** Times the gripper closed on a part, and on nothing. */
  readonly taken: number;
  readonly missed: number;
  readonly carried: readonly CarriedPart[];
}

/**
 * Proves every motion of the plan free of contact, between the nodes as well, with the parts that are held on the way
 * (`GraspedParts`); standing still is covered by the motions that end there.
 */
export function checkCollision(scene: CheckScene, options: CollisionOptions): Collisions {
  const { cell, margin_m } = options;
  const collider = new CellCollider(cell, scene.robot.arm);
  const prover = new Prover(collider, margin_m, scene.robot.arm);
  collider.allowContactsAt(scene.robot.home_rad);
  const parts = new GraspedParts(collider, cell, scene.program, scene.robot.arm, scene.layout.plan.segments, margin_m);
  const unproven = new Set<string>();
  const found = new Set<string>();
  const all = [...motions(scene)];
  const corners = cornersOf(scene);
  const rounded: { readonly corner: PassedCorner; readonly found: InCorner; readonly held: string | undefined }[] = [];
  const unreached: PassedCorner[] = [];
  let before: readonly Stretch[] = [];
  let repaired = 0;
  let i = 0;
  for (const segment of scene.layout.plan.segments) {
    const stretches = parts.enter(segment);
    if (segment !== all[i]) continue;
    const corner = corners.get(segment);
    if (corner !== undefined) {
      const judged = proveCorner(corner, prover, [before.at(-1), stretches[0]], options);
      if (judged.found !== undefined) rounded.push({ corner, found: judged.found, held: parts.held });
      else if (judged.isUnproven) unreached.push(corner);
    }
    before = stretches;
    if (options.cancelled?.() === true) {
      for (const rest of all.slice(i)) unproven.add(rest.step);
      break;
    }
    options.onProgress?.(i / all.length);
    i++;
    const verdict = prove(prover, segment, stretches, options.certificates);
    if (verdict.kind === "undecided") unproven.add(segment.step);
    if (verdict.kind !== "contact" || found.has(segment.step)) continue;
    found.add(segment.step);
    const sentence = sentenceOf(verdict, cell, parts.held, segment.start_s + verdict.at, margin_m);
    addContact(scene, segment, verdict, sentence, repaired < MOST_REPAIRED ? prover : undefined);
    repaired++;
  }
  for (const { corner, found: inCorner, held } of rounded)
    if (!found.has(corner.step) && !found.has(corner.next))
      addCorner(scene, corner, inCorner, sentenceOf(inCorner.contact, cell, held, corner.at_s, margin_m));
  const stuck = new Set(scene.layout.obstacles.map(({ move }) => move.step.id));
  for (const corner of unreached)
    if ([corner.step, corner.next].every(step => !found.has(step) && !stuck.has(step))) {
      unproven.add(corner.step);
      addUnreached(scene, corner);
    }
  const { taken, missed, carried } = parts;
  return {
    clearance_m:
      cell.objects.length === 0
        ? null
        : leastClearance(collider, parts, scene.layout.plan.segments, all, options.cancelled),
    unproven,
    taken,
    missed,
    carried,
  };
}

type Contact = Extract<MotionVerdict, { kind: "contact" }>;

/** The verdict on one corner; its area and, when it is clear, its proof go to where the options want them. */
function proveCorner(
  corner: PassedCorner,
  prover: Prover,
  sides: readonly [Stretch | undefined, Stretch | undefined],
  { corners, areas }: CollisionOptions,
): ReturnType<typeof judgeCorner> {
  const judged = judgeCorner(corner, prover, ...sides);
  const { step, at_s } = corner;
  if (corners !== undefined && judged.found === undefined && !judged.isUnproven) {
    const pieces = certifyCorner(corner, judged, prover, ...sides);
    if (pieces !== undefined) corners.push({ step, at_s, pieces });
  }
  const area = areas && cornerArea(corner);
  if (area !== undefined) areas?.push(area);
  return judged;
}

/** The verdict on one motion; the proof of a clear one goes to `certificates`, where these are wanted. */
function prove(
  prover: Prover,
  segment: MotionSegment,
  stretches: readonly Stretch[],
  certificates: SegmentCertificate[] | undefined,
): MotionVerdict {
  if (certificates === undefined) return prover.prove(segment, stretches);
  const { verdict, certificate } = prover.certify(segment, stretches);
  if (certificate !== null) certificates.push({ step: segment.step, start_s: segment.start_s, ...certificate });
  return verdict;
}

/** A motion that touches something or comes too near; with a prover, with ways out that it proves to be free. */
function addContact(
  scene: CheckScene,
  segment: MotionSegment,
  contact: Contact,
  sentence: string,
  prover: Prover | undefined,
): void {
  const move = scene.layout.moves.get(segment.step);
  scene.add(segment.step, "bad", {
    code: "collision.contact",
    value: contact.distance_m,
    limit: contact.margin_m,
    unit: "m",
    at_s: segment.start_s + contact.at,
    sentence,
    repairs: move === undefined || !prover ? [] : collisionRepairs(scene, move, prover, segment, contact.at),
  });
}

/** What a corner may come too near to, where neither the motion before it nor the one behind does as planned. */
function addCorner(
  scene: CheckScene,
  { step, at_s }: PassedCorner,
  { contact, isFreeSharp }: InCorner,
  what: string,
): void {
  const move = scene.layout.moves.get(step)!.step;
  scene.add(step, "bad", {
    code: "collision.corner",
    value: contact.distance_m,
    limit: contact.margin_m,
    unit: "m",
    at_s,
    sentence: `${what} The controller may round this corner otherwise than planned: use zone 0, or leave more room.`,
    repairs: isFreeSharp
      ? [{ kind: "zone", sentence: "Stop at the point: zone 0.", replace: { ...move, blend_m: 0, blend_ratio: 0 } }]
      : [],
  });
}

/** A corner that is not proven all over, because the arm does not reach all of it in the posture of the plan. */
function addUnreached(scene: CheckScene, { step, at_s }: PassedCorner): void {
  const move = scene.layout.moves.get(step)!.step;
  scene.add(step, "warn", {
    code: "collision.corner-out-of-reach",
    value: 0,
    limit: 0,
    unit: "m",
    at_s,
    sentence: `The corner at ${seconds(at_s)} is not proven clear all over: the arm does not reach all of what a controller may make of it in this posture. Use zone 0, or a smaller one.`,
    repairs: [
      { kind: "zone", sentence: "Stop at the point: zone 0.", replace: { ...move, blend_m: 0, blend_ratio: 0 } },
    ],
  });
}

function sentenceOf(
  contact: Contact,
  cell: CellGeometry,
  held: string | undefined,
  at_s: number,
  asked_m: number,
): string {
  const carried = held !== undefined && (contact.a === held || contact.b === held);
  const first = carried ? held : contact.a;
  const other = first === contact.a ? contact.b : contact.a;
  const a = carried ? `the held ${nameOf(first, cell)}` : nameOf(first, cell);
  const b = nameOf(other, cell);
  const shape_m = contact.margin_m - Math.max(0, asked_m) - (cell.placeError_m ?? 0);
  const parts =
    contact.between === "self"
      ? []
      : [...(shape_m > 1e-9 ? [`${mm(shape_m)} of it for the error of the drawn shape`] : []), ...placeErrors(cell)];
  const because = parts.map(part => `, ${part}`).join("");
  return contact.margin_m > 0 && contact.distance_m > 0
    ? `${capital(a)} comes within ${mm(contact.distance_m)} of ${b} at ${seconds(at_s)}; the margin is ${mm(contact.margin_m)}${because}.`
    : `${capital(a)} ${carried ? "would touch" : "touches"} ${b} at ${seconds(at_s)}.`;
}

/** The errors of place, each with what it is for. */
function placeErrors({ placeError_m = 0, placeErrors: parts }: CellGeometry): string[] {
  if (!parts) return placeError_m > 1e-9 ? [`${mm(placeError_m)} for where the robot may stand`] : [];
  return [
    ...(parts.registration_m > 1e-9 ? [`${mm(parts.registration_m)} for the registration`] : []),
    ...(parts.twin_m > 1e-9 ? [`${mm(parts.twin_m)} for the twin`] : []),
  ];
}

/** What is kept between the robot and what stands around it, and every part of that (row T-64). */
export function keptSentence(cell: CellGeometry, asked_m: number): string {
  const wanted_m = Math.max(0, asked_m);
  const total_m = wanted_m + cell.shapeError_m + (cell.placeError_m ?? 0);
  const each = [
    `${mm(wanted_m)} asked for`,
    `${mm(cell.shapeError_m)} for the drawn shape of the links`,
    ...placeErrors(cell),
  ];
  return `Between the robot and what stands around it ${mm(total_m)} are kept: ${each.join(", ")}.`;
}

/** What a held part rests on does not count as long as it may touch it or be near. */
function leastClearance(
  collider: CellCollider,
  parts: GraspedParts,
  segments: readonly Segment[],
  all: readonly MotionSegment[],
  cancelled: (() => boolean) | undefined,
): number {
  const near = noClearance();
  const total_s = all.reduce((sum, segment) => sum + segment.duration_s, 0);
  const period_s = total_s / CLEARANCE_LOOKS;
  let least = CLEARANCE_CUTOFF_M;
  let due_s = 0;
  let passed_s = 0;
  const q = new Float64Array(all[0] === undefined ? 0 : all[0].q_rad.length / all[0].times_s.length);
  parts.rewind();
  for (const segment of segments) {
    const stretches = parts.enter(segment);
    if (segment.kind !== "motion" || segment.times_s.length < 2) continue;
    if (cancelled?.() === true) break;
    for (; due_s <= passed_s + segment.duration_s; due_s += period_s) {
      const t_s = due_s - passed_s;
      const { watched, keepsMargin } = stretches.find(({ to }) => t_s <= to) ?? stretches.at(-1)!;
      sampleSegment(segment, t_s, q);
      collider.clearance(q, least, near, pair => robotAndCell(pair) && watched(pair) && keepsMargin(pair));
      least = Math.min(least, near.distance_m);
      if (!(period_s > 0)) break;
    }
    passed_s += segment.duration_s;
  }
  return least;
}

/** Targets and extra points higher up that are proven to be free, on the way there. */
function collisionRepairs(
  scene: CheckScene,
  move: Move,
  prover: Prover,
  segment: MotionSegment,
  at_s: number,
): Repair[] {
  const planner = new RunPlanner(scene.robot);
  const start = scene.layout.starts.get(move.step.id);
  if (start === undefined) return [];
  const free = (steps: readonly MoveStep[]): boolean => {
    let q = start;
    for (const step of steps) {
      const answer = planner.plan(
        [resolveMove({ ...step, blend_m: 0, blend_ratio: 0 }, scene.robot, scene.context)],
        q,
      );
      if (answer.kind === "stopped") return false;
      for (const part of answer.run.parts) {
        if (part.times_s.length > 1 && prover.prove(part).kind !== "clear") return false;
        q = part.q_rad.slice(part.q_rad.length - start.length);
      }
    }
    return true;
  };
  const found: Repair[] = [];
  const [viaId] = freshStepIds(scene.program, 1);
  const late = at_s > segment.duration_s * 0.98;
  for (const height of RAISES_M) {
    const higher = raised(scene, move, height);
    if (higher === undefined) break;
    const step: MoveStep = { ...move.step, target: higher.target };
    if (free([step])) {
      found.push({ kind: "target", sentence: `Raise the target by ${mm(height)}.`, replace: step });
      break;
    }
  }
  // Where only the way is blocked, an extra point above the target leads round.
  if (!late) {
    for (const height of RAISES_M.slice(3)) {
      const above = raised(scene, move, height);
      if (above === undefined) break;
      const via: MoveStep = {
        id: viaId!,
        type: "move",
        path: "ptp",
        target: above.target,
        speed: "ratio" in move.step.speed ? move.step.speed : { ratio: 0.25 },
        blend_m: 0,
      };
      if (free([via, move.step])) {
        found.push({
          kind: "detour",
          sentence: `Go there over a point ${mm(height)} above the target.`,
          insertBefore: [via],
        });
        break;
      }
    }
  }
  return found;
}

const mm = (length_m: number): string => `${(length_m * 1000).toFixed(length_m < 0.01 ? 1 : 0)} mm`;
const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);
