import type { Robot } from "../robots/robot.ts";

const TURN = 2 * Math.PI;
/** Rounding of limits given in degrees. */
export const LIMIT_SLACK_RAD = 1e-9;

/** The angle plus whole turns that lies inside the limits and nearest to `near`; NaN when none does. */
export function nearestTurn(angle: number, near: number, lower: number, upper: number): number {
  let turned = angle + TURN * Math.round((near - angle) / TURN);
  if (turned < lower - LIMIT_SLACK_RAD) turned += TURN * Math.ceil((lower - LIMIT_SLACK_RAD - turned) / TURN);
  else if (turned > upper + LIMIT_SLACK_RAD) turned -= TURN * Math.ceil((turned - upper - LIMIT_SLACK_RAD) / TURN);
  return turned >= lower - LIMIT_SLACK_RAD && turned <= upper + LIMIT_SLACK_RAD ? turned : NaN;
}

/** All copies of q by whole turns of each joint that lie inside the limits. */
export function turnsInside(robot: Robot, q: Float64Array): Float64Array[] {
  let copies: Float64Array[] = [new Float64Array(q.length)];
  for (let j = 0; j < q.length; j++) {
    const { lower_rad, upper_rad } = robot.arm.joints[j]!.limits;
    const next: Float64Array[] = [];
    for (let turns = Math.ceil((lower_rad - LIMIT_SLACK_RAD - q[j]!) / TURN); q[j]! + TURN * turns <= upper_rad + LIMIT_SLACK_RAD; turns++) {
      for (const copy of copies) { const more = copy.slice(); more[j] = q[j]! + TURN * turns; next.push(more); }
    }
    copies = next;
  }
  return copies;
}
