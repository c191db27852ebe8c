import { expect, test } from "vitest";
import {
  boxMesh,
  flangeOfTcp,
  linkSolids,
  pose,
  robotById,
  solveAll,
  watchCell,
  type CellGeometry,
  type Pose,
} from "../index.ts";

const robot = robotById("staubli_rx90l")!;
const box = {
  id: "box",
  name: "Box",
  mesh: boxMesh([0.2, 0.4, 0.2]),
  worldFromObject: pose<"world", "object">([0.6, 0, 0.3]),
};
const geometry: CellGeometry = {
  worldFromBase: pose(),
  links: linkSolids(robot),
  objects: [box],
  allowedPairs: [],
  shapeError_m: 0,
};
const flangeFromTcp = pose<"flange", "tcp">([0, 0, 0.1]);
const look = watchCell({ geometry, arm: robot.arm, flangeFromTcp, free_rad: robot.home_rad, cutoff_m: 0.3 });
/** The tool point straight above the middle of the box's top, so high above it. */
function above(height_m: number): Float64Array {
  const down: Pose<"world", "tcp"> = { position: [0.6, 0, 0.4 + height_m], quaternion: [0, 1, 0, 0] };
  const reach = solveAll(robot, flangeOfTcp(pose(), down, flangeFromTcp), { near: robot.home_rad });
  if (reach.kind !== "reached") throw new Error(reach.kind);
  return reach.solutions[0]!.q_rad;
}

test("N-51 the tool point touches at 0.5 mm and not before; resting on the piece is no collision", () => {
  expect(look(above(0.0006)).touched).toEqual([]);
  expect(look(above(0.0004)).touched).toEqual(["box"]);
  expect(look(above(0)).touched).toEqual(["box"]);
  expect(look(above(-0.02)).touched).toEqual(["box"]);
  expect(look(above(0)).contacts).toEqual([]);
});

test("N-47 a link in the box is a contact with both names; at home there is none", () => {
  expect(look(robot.home_rad).contacts).toEqual([]);
  const sight = look(above(-0.11));
  expect(sight.contacts.map(({ a, b }) => [a, b])).toContainEqual(["link 6", "box"]);
  expect(sight.clearance.distance_m).toBe(0);
});

test("clearance is the distance of the flange above the box", () => {
  const { clearance } = look(above(0.02));
  expect(clearance.distance_m).toBeGreaterThan(0.1);
  expect(clearance.distance_m).toBeLessThan(0.121);
  expect([clearance.a, clearance.b]).toEqual(["link 6", "box"]);
});
