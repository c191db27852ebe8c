import { type CellDocument, shapeMesh } from "@twincell/project";
import { transformPoint, type Vector3 } from "@twincell/core";

/** Free floor between a person and the nearest thing in the cell [m]. */
const ROOM_M = 0.6;

/**
 * Where a person stands: on the floor in front of the robot, looking back at it, clear of everything but the walls.
 * `turn_rad` turns the way a headset looks at first (−y of the world's ground seen from the scene) towards the robot.
 */
export function standingPlace(document: CellDocument): {
  readonly x: number;
  readonly y: number;
  readonly turn_rad: number;
} {
  const [rx, ry] = document.robot.worldFromBase.position;
  let front = rx + 0.5;
  for (const object of document.objects) {
    if (object.role === "wall") continue;
    const { positions } = shapeMesh(object.shape);
    const point: Vector3 = [0, 0, 0];
    for (let i = 0; i < positions.length; i += 3) {
      point[0] = positions[i]!;
      point[1] = positions[i + 1]!;
      point[2] = positions[i + 2]!;
      transformPoint(object.worldFromObject, point, point);
      if (Math.abs(point[1] - ry) < 1.2) front = Math.max(front, point[0]);
    }
  }
  return { x: front + ROOM_M, y: ry, turn_rad: Math.PI / 2 };
}
