import { compose, type CarriedPart, type Pose } from "@twincell/core";

/**
 * Where a part of the cell is at a moment of the program, without physics (row L-34): where it was put last, or in the
 * gripper. Undefined while nobody has taken it yet: it stands where the cell has it.
 *
 * @param worldFromFlange  the flange at that moment.
 */
export function carriedPose(
  carried: readonly CarriedPart[],
  id: string,
  t_s: number,
  worldFromFlange: Pose<"world", "flange">,
  out: Pose<"world", "object">,
): Pose<"world", "object"> | undefined {
  const hold = carried.findLast(part => part.id === id && part.taken_s <= t_s);
  if (hold === undefined) return undefined;
  const { put, put_s, flangeFromObject } = hold;
  if (put === undefined || put_s === undefined || t_s < put_s) return compose(worldFromFlange, flangeFromObject, out);
  return put.worldFromObject;
}
