import {
  CellCollider,
  HandGuard,
  linkSolids,
  PathValidator,
  robotAndCell,
  type SerialArm,
  type Contact,
  type HandStep,
} from "@twincell/core";
import { cellGeometry, type CellDocument } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { collideStore } from "../../stores/collide.ts";
import { robotOf } from "../../stores/document.ts";
import { sound } from "../../stores/sound.ts";
import { words } from "../../messages/index.ts";
import { solidName } from "../../messages/phrases.ts";
import { interpolateTo } from "./joint-interpolation.ts";
import type { FreeWay } from "../robot/held-jog.ts";
import { showJoints, theLive } from "../live.ts";

interface Made {
  readonly document: CellDocument;
  readonly collider: CellCollider;
  readonly arm: SerialArm;
  readonly guard: HandGuard;
}
let made: Made | null = null;
let revision = -1;
let next = new Float64Array(6);

const same = (a: CellDocument, b: CellDocument): boolean =>
  a.objects === b.objects &&
  a.tools === b.tools &&
  a.tool === b.tool &&
  a.robot === b.robot &&
  a.allowedPairs === b.allowedPairs &&
  a.pairs === b.pairs &&
  a.errors === b.errors;

/** What guards the hand in the open cell; made when it is first needed, and again when solids change. */
function guardNow(): Made | null {
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  if (!document || !robot) return null;
  if (made && same(made.document, document)) return made;
  const collider = new CellCollider(cellGeometry(document, linkSolids(robot)), robot.arm);
  collider.allowContactsAt(robot.home_rad);
  made = { document, collider, arm: robot.arm, guard: new HandGuard(collider, robot.arm) };
  revision = -1;
  return made;
}

/** The two solids in contact at q; null where it is free. */
export function contactAt(q_rad: ArrayLike<number>): Contact | null {
  return guardNow()?.collider.check(q_rad)[0] ?? null;
}

/**
 * How many postures of a way are free from its beginning, with so much room kept between robot and cell on top of the
 * errors of shape and place, and what is met behind them. Looks at the postures one by one; proves nothing.
 */
export const freeWay: FreeWay = (way, room_m) => {
  const now = guardNow();
  if (!now) return { free: way.length, met: null };
  const validator = new PathValidator(now.collider, now.arm, { margin_m: room_m, keepsMargin: robotAndCell });
  for (const [free, q_rad] of way.entries()) {
    const met = validator.inTheWay(q_rad);
    if (met) return { free, met };
  }
  return { free: way.length, met: null };
};

/** How many postures of a way lead out of what is nearer to `from` than the room; see `PathValidator.wayOut`. */
export function wayOut(from_rad: ArrayLike<number>, way: readonly (readonly number[])[], room_m: number): number {
  const now = guardNow();
  if (!now) return 0;
  return new PathValidator(now.collider, now.arm, { margin_m: room_m, keepsMargin: robotAndCell }).wayOut(
    from_rad,
    way,
  );
}

/** A contact as a person reads it. */
export function namesOf({ a, b }: Contact): readonly [string, string] {
  const objects = cellStore.getState().document?.objects ?? [];
  return [solidName(a, objects), solidName(b, objects)];
}

/**
 * Moves the robot on screen by hand, from where it stands towards q, as the chosen behaviour wants it. Stopped, it goes
 * back to the last posture with room around it; the sentence says what was met.
 */
export function moveByHand(
  q_rad: Float64Array,
): { readonly kind: "moved" } | { readonly kind: "stopped"; readonly sentence: string } {
  const { behaviour } = collideStore.getState();
  if (behaviour === "alert" || behaviour === "refuse") {
    showJoints(q_rad);
    return { kind: "moved" };
  }
  const on = guardNow();
  const live = theLive();
  if (!on) return { kind: "moved" };
  if (next.length !== live.q_rad.length) next = new Float64Array(live.q_rad.length);
  // Somebody else moved it since: where it stands now is where it was safe.
  if (live.revision !== revision) on.guard.begin(live.q_rad);
  const answer: HandStep = on.guard.step(behaviour, live.q_rad, q_rad, next);
  if (answer.kind !== "stopped") {
    showJoints(next);
    revision = theLive().revision;
    return { kind: "moved" };
  }
  revision = live.revision;
  const [a, b] = namesOf(answer.contact);
  const robot = robotOf(on.document);
  sound("limit");
  if (behaviour !== "stop") return { kind: "stopped", sentence: words.collide.held(a, b) };
  if (robot) interpolateTo(robot, answer.safe_rad.slice());
  return { kind: "stopped", sentence: words.collide.back(a, b) };
}
