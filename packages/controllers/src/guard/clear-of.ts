import {
  CellCollider,
  marginOf,
  robotAndCell,
  PathValidator,
  type CellGeometry,
  type Contact,
  type Robot,
} from "@twincell/core";

export interface ClearOfOptions {
  /** Room to keep between robot and cell [m]; 0 asks for no contact only. */
  readonly margin_m?: number;
  /** How far the cell's objects may stand from where they are drawn, as the registration says [m]; added to the margin (row T-64). */
  readonly registrationError_m?: number;
}

export interface ClearOf {
  /** For `GuardOptions.isSafe`. */
  readonly isSafe: (q_rad: ArrayLike<number>) => boolean;
  /** The pairs that touch at q, each as one text: what a robot that begins too near to something must not add to. */
  readonly contactsAt: (q_rad: ArrayLike<number>) => readonly string[];
  /** What comes too near at q; null where q is safe. */
  readonly inTheWay: (q_rad: ArrayLike<number>) => Contact | null;
  /** What is kept between a link and an object, all errors in it [m]: never less than they are, unless nothing is to be kept. */
  readonly kept_m: number;
}

/**
 * Protection from the model alone (rows T-45, T-68): one call makes of a robot's and a cell's meshes what the guard asks. The robot's own
 * shape error and the error of registration are added to the margin, so that what is kept is never less than what is not known.
 */
export function clearOf(
  cell: CellGeometry,
  robot: Robot,
  { margin_m = 0, registrationError_m = 0 }: ClearOfOptions = {},
): ClearOf {
  const collider = new CellCollider(cell, robot.arm);
  const wanted_m = margin_m + registrationError_m;
  collider.allowContactsAt(robot.home_rad);
  const checker = new PathValidator(collider, robot.arm, { margin_m: wanted_m, keepsMargin: robotAndCell });
  const pair = collider.pairs.find(each => each.a.kind === "link" && each.b.kind === "object");
  return {
    isSafe: q_rad => checker.free(q_rad),
    contactsAt: q_rad => collider.check(q_rad).map(({ a, b }) => `${a}|${b}`),
    inTheWay: q_rad => checker.inTheWay(q_rad),
    kept_m: pair === undefined ? wanted_m : marginOf(pair, wanted_m, cell),
  };
}
