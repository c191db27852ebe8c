import type { Joint } from "../model/arm.ts";
import type { Robot } from "../model/robot.ts";

const TURN = 2 * Math.PI;
/** Rounding of limits given in degrees. */
export const LIMIT_SLACK_RAD = 1e-9;

/**
 * Whether a joint turns, so that it stands the same after a whole turn. One that slides does not, whatever its range.
 */
export const turns = (joint: Pick<Joint, "axis"> & { readonly kind?: "revolute" | "prismatic" }): boolean =>
  joint.kind !== "prismatic";

/** The angle plus whole turns that lies inside the limits and nearest to `near`; NaN when none does. */
export function nearestTurn(angle: number, near: number, lower: number, upper: number): number {
  let turned = angle + TURN * Math.round((near - angle) / TURN);
  if (turned < lower - LIMIT_SLACK_RAD) turned += TURN * Math.ceil((lower - LIMIT_SLACK_RAD - turned) / TURN);
  else if (turned > upper + LIMIT_SLACK_RAD) turned -= TURN * Math.ceil((turned - upper - LIMIT_SLACK_RAD) / TURN);
  return turned >= lower - LIMIT_SLACK_RAD && turned <= upper + LIMIT_SLACK_RAD ? turned : NaN;
}

/** All copies of q by whole turns of each joint that turns, as far as they lie inside the limits. */
export function revolutionsInside(robot: Pick<Robot, "arm">, q: Float64Array): Float64Array[] {
  let copies: Float64Array[] = [new Float64Array(q.length)];
  for (let j = 0; j < q.length; j++) {
    const joint = robot.arm.joints[j]!;
    const { lower_rad, upper_rad } = joint.limits;
    const turn = turns(joint) ? TURN : Number.POSITIVE_INFINITY;
    const next: Float64Array[] = [];
    for (let k = turn < Number.POSITIVE_INFINITY ? Math.ceil((lower_rad - LIMIT_SLACK_RAD - q[j]!) / turn) : 0; ; k++) {
      const value = k === 0 ? q[j]! : q[j]! + turn * k;
      if (value > upper_rad + LIMIT_SLACK_RAD) break;
      if (value >= lower_rad - LIMIT_SLACK_RAD)
        for (const copy of copies) {
          const more = copy.slice();
          more[j] = value;
          next.push(more);
        }
    }
    copies = next;
  }
  return copies;
}
