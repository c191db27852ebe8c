import { type CellDocument, shapeMesh } from "@twincell/project";
import { transformPoint, type Vector3 } from "@twincell/core";

/** Free floor between a person and the nearest thing in the cell [m]. */
const ROOM_M = 0.45;
/** From the axis of the base to the person, best first [m]: 1.5 … 2 m, and farther where the cell is wide. */
const AWAY_M = [1.7, 1.6, 1.8, 1.5, 2, 2.3, 2.7, 3.2, 4];
/** Ways from the robot, nearest to its front first [rad]. */
const WAYS_RAD = [0, 0.35, -0.35, 0.7, -0.7, 1.05, -1.05, 1.4, -1.4, 1.8, -1.8, 2.4, -2.4, Math.PI];
/** So far to the person's right the tool is held: beside the line of sight to the robot, in reach of the hand [rad]. */
const ASIDE_RAD = 0.32;

export interface StandingPlace {
  readonly x: number;
  readonly y: number;
  /** Turns the way a headset looks at first (−y of the world's ground seen from the scene) towards the robot. */
  readonly turn_rad: number;
  /** The way from the base in which the tool is held so that it is between robot and person, and aside. */
  readonly tool_rad: number;
}

/**
 * Where a person stands: on the floor, 1.5 to 2 m from the axis of the robot and nearest to its front, clear of
 * everything but the walls.
 */
export function standingPlace(document: CellDocument): StandingPlace {
  const { position, quaternion } = document.robot.worldFromBase;
  const [rx, ry] = position;
  const ahead: Vector3 = transformPoint({ position: [0, 0, 0], quaternion }, [1, 0, 0]);
  const front_rad = Math.atan2(ahead[1], ahead[0]);
  const footprints = footprintsOf(document);
  const isClear = (x: number, y: number): boolean =>
    footprints.every(
      ([x0, y0, x1, y1]) => Math.hypot(Math.max(x0 - x, 0, x - x1), Math.max(y0 - y, 0, y - y1)) >= ROOM_M,
    );
  for (const away of AWAY_M)
    for (const way of WAYS_RAD) {
      const at_rad = front_rad + way;
      const x = rx + away * Math.cos(at_rad);
      const y = ry + away * Math.sin(at_rad);
      if (isClear(x, y)) return lookingBack(x, y, at_rad);
    }
  const farthest = footprints.reduce((far, [, , x1]) => Math.max(far, x1), rx + 1.2);
  return lookingBack(farthest + ROOM_M, ry, 0);
}

const lookingBack = (x: number, y: number, at_rad: number): StandingPlace => ({
  x,
  y,
  turn_rad: at_rad + Math.PI / 2,
  // Angles about z grow towards the right hand of who looks back at the robot.
  tool_rad: at_rad + ASIDE_RAD,
});

/** x0, y0, x1, y1 of everything that stands lower than a person is high. */
function footprintsOf(document: CellDocument): (readonly [number, number, number, number])[] {
  return document.objects.flatMap(object => {
    if (object.role === "wall" || object.hidden === true) return [];
    const { positions } = shapeMesh(object.shape);
    const point: Vector3 = [0, 0, 0];
    let [x0, y0, z0, x1, y1] = [Infinity, Infinity, Infinity, -Infinity, -Infinity];
    for (let i = 0; i < positions.length; i += 3) {
      point[0] = positions[i]!;
      point[1] = positions[i + 1]!;
      point[2] = positions[i + 2]!;
      transformPoint(object.worldFromObject, point, point);
      x0 = Math.min(x0, point[0]);
      y0 = Math.min(y0, point[1]);
      z0 = Math.min(z0, point[2]);
      x1 = Math.max(x1, point[0]);
      y1 = Math.max(y1, point[1]);
    }
    return z0 < 1.9 ? [[x0, y0, x1, y1] as const] : [];
  });
}
