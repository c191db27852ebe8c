import { CellCollider, linkSolids, PathValidator, type Robot } from "@twincell/core";
import { cellGeometry } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { collideStore } from "../../stores/collide.ts";
import { isLive } from "../../stores/connection.ts";
import { notify } from "../../stores/notices.ts";
import { words } from "../../messages/index.ts";
import { interpolateTo } from "./joint-interpolation.ts";
import { namesOf } from "./hand-motion.ts";
import { theLive } from "../live.ts";
import { goLive } from "../robot/cell-connection.ts";
import { goAround } from "../planning/planning.ts";

/** Looks that the straight way may cost before the page answers; more is left to the worker. */
const MOST_CHECKS = 1000;

/**
 * Goes to a posture as the chosen behaviour wants it: straight where a contact is only an alert; not at all where the
 * way is blocked and contacts stop; by another way where they are to be untangled.
 */
export function goThere(
  robot: Robot,
  q_rad: ArrayLike<number>,
  done: (arrived: boolean) => void = () => undefined,
): void {
  if (isLive()) {
    goLive(q_rad, done);
    return;
  }
  const { behaviour } = collideStore.getState();
  const { document } = cellStore.getState();
  if (behaviour === "alert" || behaviour === "refuse" || !document) {
    interpolateTo(robot, q_rad, done);
    return;
  }
  const collider = new CellCollider(cellGeometry(document, linkSolids(robot)), robot.arm);
  collider.allowContactsAt(robot.home_rad);
  const checker = new PathValidator(collider, robot.arm);
  const from = theLive().q_rad;
  const verdict = checker.free(from) ? checker.prove(from, q_rad, MOST_CHECKS) : null;
  // Who stands in contact already may always leave.
  if (verdict === null || verdict.kind === "clear") {
    interpolateTo(robot, q_rad, done);
    return;
  }
  if (behaviour === "untangle") {
    goAround(robot, q_rad, done);
    return;
  }
  if (verdict.kind === "undecided") {
    notify("bad", words.collide.tooNear, words.collide.goHint);
    return;
  }
  const [a, b] = namesOf(verdict);
  notify("bad", words.collide.onTheWay(a, b, Math.round(verdict.at * 100)), words.collide.goHint);
}
