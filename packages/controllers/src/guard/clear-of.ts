import {
  CellCollider,
  marginOf,
  keptApart,
  PathValidator,
  type CarriedPart,
  type CellGeometry,
  type Contact,
  type Robot,
} from "@twincell/core";
import { PartInGripper } from "./part-in-gripper.ts";

export interface ClearOfOptions {
  /** Room to keep between robot and cell [m]; 0 asks for no contact only. */
  readonly margin_m?: number;
  /**
   * How far the cell's objects may stand from where they are drawn, as the registration says [m]; added to the margin
   * (row T-64).
   */
  readonly registrationError_m?: number;
}

export interface ClearOf {
  /** For `GuardOptions.isSafe`. */
  readonly isSafe: (q_rad: ArrayLike<number>) => boolean;
  /** The pairs that touch at q, each as one text: what a robot that begins too near to something must not add to. */
  readonly contactsAt: (q_rad: ArrayLike<number>) => readonly string[];
  /** What comes too near at q; null where q is safe. */
  readonly inTheWay: (q_rad: ArrayLike<number>) => Contact | null;
  /** The gripper closed or opened at q: what it closes on moves with the flange and is kept from the rest. */
  readonly gripper: (closed: boolean, q_rad: ArrayLike<number>) => void;
  /** A program that was checked begins, which carries these parts; and ends. */
  readonly begin: (carried: readonly CarriedPart[]) => void;
  readonly end: () => void;
  /** What the gripper holds. */
  readonly held: () => CellGeometry["held"] | null;
  /** Takes over what another cell's gripper held. */
  readonly goOnFrom: (before: ClearOf) => void;
  /**
   * What is kept between a link and an object, all errors in it [m]: never less than they are, unless nothing is to be
   * kept.
   */
  readonly kept_m: number;
}

/**
 * Protection from the model alone (rows T-45, T-68): one call makes of a robot's and a cell's meshes what the guard
 * asks. The robot's own shape error and the error of registration are added to the margin, so that what is kept is
 * never less than what is not known.
 */
export function clearOf(
  cell: CellGeometry,
  robot: Robot,
  { margin_m = 0, registrationError_m = 0 }: ClearOfOptions = {},
): ClearOf {
  const collider = new CellCollider(cell, robot.arm);
  const wanted_m = margin_m + registrationError_m;
  collider.allowContactsAt(robot.home_rad);
  const parts = new PartInGripper(collider, cell, robot, wanted_m + (cell.placeError_m ?? 0));
  let asked_rad: ArrayLike<number> = robot.home_rad;
  const checker = new PathValidator(collider, robot.arm, {
    margin_m: wanted_m,
    keepsMargin: keptApart,
    excused: each => parts.excuses(each, asked_rad),
  });
  const inTheWay = (q_rad: ArrayLike<number>): Contact | null => {
    asked_rad = q_rad;
    return checker.inTheWay(q_rad);
  };
  const pair = collider.pairs.find(each => each.a.kind === "link" && each.b.kind === "object");
  const clear: ClearOf = {
    isSafe: q_rad => inTheWay(q_rad) === null,
    contactsAt(q_rad) {
      collider.place(q_rad);
      return collider.pairs
        .filter(each => collider.touchOf(each) && !parts.excuses(each, q_rad))
        .map(({ contact: { a, b } }) => `${a}|${b}`);
    },
    inTheWay,
    gripper: (closed, q_rad) => {
      parts.gripper(closed, q_rad);
    },
    begin: carried => {
      parts.begin(carried);
    },
    end: () => {
      parts.end();
    },
    held: () => parts.held,
    goOnFrom(before) {
      const other = partsOf.get(before);
      if (other) parts.goOnFrom(other);
    },
    kept_m: pair === undefined ? wanted_m : marginOf(pair, wanted_m, cell),
  };
  partsOf.set(clear, parts);
  return clear;
}
const partsOf = new WeakMap<ClearOf, PartInGripper>();
