import {
  branchOf,
  degrees,
  solveAll,
  type Branch,
  type Pose,
  type Robot,
  sectionForDriver,
  axesOfJoints,
  wristAboveZero,
} from "@twincell/core";
import { rmiNumber, rmiPart } from "./rmi.ts";

export const JOINTS = 6;

/**
 * The posture of a position as the interface says it: wrist flipped, elbow up, wrist in front; the turns of axes 4, 5
 * and 6.
 */
export interface Configuration {
  readonly Front: number;
  readonly Up: number;
  readonly Left: number;
  readonly Flip: number;
  readonly Turn4: number;
  readonly Turn5: number;
  readonly Turn6: number;
}

/** Turn 0 is within half a turn of zero, 1 and −1 are the turns beside it. */
const turnOf = (angle_deg: number): number => {
  const turn = Math.trunc((Math.abs(angle_deg) + 180) / 360);
  return turn === 0 ? 0 : Math.sign(angle_deg) * turn;
};

/**
 * Pure. Arms without the names of a posture are up and in front. `Left` is that of arms that choose their elbow to the
 * side.
 */
export function configurationOf(robot: Robot, q_rad: ArrayLike<number>): Configuration {
  const branch = branchOf(robot, q_rad);
  const section = sectionForDriver(robot, "fanuc");
  const axes =
    section === undefined ? Array.from(q_rad, degrees) : axesOfJoints(section, q_rad, new Float64Array(JOINTS));
  return {
    Front: branch?.shoulder === "back" ? 0 : 1,
    Up: branch?.elbow === "down" ? 0 : 1,
    Left: 0,
    Flip: branch?.wrist === wristAboveZero(robot) ? 1 : 0,
    Turn4: turnOf(axes[3]!),
    Turn5: turnOf(axes[4]!),
    Turn6: turnOf(axes[5]!),
  };
}

/**
 * The posture that a packet asks for: none where it names none; undefined where what it names is nothing of the kind.
 */
export function askedConfiguration(fields: Readonly<Record<string, unknown>>): Configuration | null | undefined {
  const part = rmiPart(fields, "Configuration");
  if (!("Front" in part || "Up" in part || "Flip" in part)) return null;
  const flag = (name: string): number => rmiNumber(part, name);
  const turn = (name: string): number => (name in part ? rmiNumber(part, name) : 0);
  const asked = {
    Front: flag("Front"),
    Up: flag("Up"),
    Left: 0,
    Flip: flag("Flip"),
    Turn4: turn("Turn4"),
    Turn5: turn("Turn5"),
    Turn6: turn("Turn6"),
  };
  const { Front, Up, Flip, Turn4, Turn5, Turn6 } = asked;
  return [Front, Up, Flip].every(value => value === 0 || value === 1) && [Turn4, Turn5, Turn6].every(Number.isInteger)
    ? asked
    : undefined;
}

export const branchOfConfiguration = (robot: Robot, { Front, Up, Flip }: Configuration): Branch => ({
  shoulder: Front === 1 ? "front" : "back",
  elbow: Up === 1 ? "up" : "down",
  wrist: (Flip === 1) === (wristAboveZero(robot) === "positive") ? "positive" : "negative",
});

/**
 * Joint angles at that pose of the flange in that posture and those turns, the nearest to `near` [rad]; undefined where
 * the arm cannot stand so.
 */
export function jointsIn(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  asked: Configuration,
  near?: ArrayLike<number>,
): readonly number[] | undefined {
  const reach = solveAll(robot, baseFromFlange, near ? { near } : {});
  if (reach.kind !== "reached") return undefined;
  return reach.solutions
    .map(({ q_rad }) => Array.from(q_rad))
    .find(q => {
      const { Front, Up, Flip, Turn4, Turn5, Turn6 } = configurationOf(robot, q);
      return (
        Front === asked.Front &&
        Up === asked.Up &&
        Flip === asked.Flip &&
        Turn4 === asked.Turn4 &&
        Turn5 === asked.Turn5 &&
        Turn6 === asked.Turn6
      );
    });
}
