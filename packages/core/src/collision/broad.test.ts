import { expect, test } from "vitest";
import {
  boxMesh,
  buildSolid,
  CellCollider,
  compose,
  identity,
  linkPoses,
  linkSolids,
  meshBounds,
  pairScratch,
  pose,
  rigidFromPose,
  robotById,
  seededRandom,
  solidsTouch,
  torusMesh,
  transformMesh,
  type CellObject,
  type Pose,
} from "../index.ts";
import { randomPose } from "./testing/oracles.ts";

test("M-09 bounding box first, then the mesh: the verdict is that of the meshes alone, and the boxes spare most of the work", () => {
  const robot = robotById("staubli_rx90l")!;
  const links = linkSolids(robot);
  const random = seededRandom(71);
  const scratch = pairScratch();
  const objects: CellObject[] = [
    { id: "jig", name: "Jig", mesh: torusMesh(0.2, 0.03), worldFromObject: pose([0.7, 0.1, 0.5]) },
    { id: "post", name: "Post", mesh: boxMesh([0.1, 0.1, 0.8]), worldFromObject: pose([0.4, -0.4, 0.4]) },
    {
      id: "beam",
      name: "Beam",
      mesh: boxMesh([0.08, 1.2, 0.08]),
      worldFromObject: pose([-0.5, 0, 0.9], randomPose(random, 0).quaternion),
    },
  ];
  const collider = new CellCollider(
    { worldFromBase: pose(), links, objects, allowedPairs: [], shapeError_m: 0 },
    robot.arm,
  );
  // Every mesh is moved to the world itself and asked about there: no trees of boxes that move, no boxes of bodies.
  const still = objects.map(({ mesh, worldFromObject }) => transformMesh(mesh, worldFromObject as Pose));
  const stillSolids = still.map(buildSolid);
  const poses = Array.from({ length: 7 }, () => identity<"base", "link">());
  let boxes = 0;
  let meshes = 0;
  let looked = 0;
  for (let i = 0; i < 150; i++) {
    const q = robot.arm.joints.map(
      ({ limits: { lower_rad, upper_rad } }) => lower_rad + random() * (upper_rad - lower_rad),
    );
    const found = new Set(collider.check(q).map(({ a, b }) => `${a} / ${b}`));
    linkPoses(robot.arm, q, poses);
    for (const { link, mesh } of links) {
      if (link === 0) continue;
      const moved = transformMesh(mesh, compose(identity(), poses[link] as Pose));
      const bounds = meshBounds(moved);
      const solid = buildSolid(moved);
      still.forEach((other, o) => {
        const around = meshBounds(other);
        const touching = solidsTouch(solid, stillSolids[o]!, rigidFromPose(identity()), scratch);
        const overlap = [0, 1, 2].every(
          k => bounds.lower[k]! <= around.upper[k]! && around.lower[k]! <= bounds.upper[k]!,
        );
        looked++;
        if (overlap) boxes++;
        if (touching) {
          meshes++;
          expect(overlap).toBe(true);
        }
        expect(found.has(`link ${link} / ${objects[o]!.id}`)).toBe(touching);
      });
    }
  }
  // Boxes alone would be wrong: some overlap where the meshes do not. And they answer most pairs without a look at the
  // meshes.
  expect(meshes).toBeGreaterThan(20);
  expect(boxes).toBeGreaterThan(meshes);
  expect(boxes).toBeLessThan(looked / 2);
});
