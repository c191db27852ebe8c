import { describe, expect, test } from "vitest";
import {
  applyRepair,
  boxMesh,
  checkProgram,
  emptyProgram,
  linkSolids,
  pose,
  robotById,
  detour,
  type CellGeometry,
  type MoveStep,
  type Program,
  type Vector3,
} from "../index.ts";

const robot = robotById("staubli_rx90l")!;
const object = (id: string, name: string, position: Vector3, size_m: Vector3): CellGeometry["objects"][number] => ({
  id,
  name,
  worldFromObject: pose(position),
  mesh: boxMesh(size_m),
});
const cell: CellGeometry = {
  worldFromBase: pose(),
  links: linkSolids(robot),
  allowedPairs: [],
  shapeError_m: 0,
  tool: { name: "torch", mesh: boxMesh([0.02, 0.02, 0.28]) },
  objects: [
    object("post", "Post", [0.55, 0, 0.25], [0.04, 0.04, 0.7]),
    object("plate", "Plate", [0.55, 0, 0.2], [0.3, 0.6, 0.02]),
  ],
};
const target = (position: Vector3): MoveStep["target"] => ({
  pose: { position, quaternion: [1, 0, 0, 0] },
  frame: "world",
  tool: "torch",
});
const move = (
  id: string,
  path: MoveStep["path"],
  position: Vector3,
  speed: MoveStep["speed"] = { ratio: 0.5 },
): MoveStep => ({ id, type: "move", path, target: target(position), speed, blend_m: 0 });
const programOf = (...steps: MoveStep[]): Program => ({
  ...emptyProgram(robot.id),
  tools: { torch: pose([0, 0, 0.15]) },
  steps,
});
const left = move("left", "ptp", [0.55, 0.2, 0.4]);
const across = move("across", "lin", [0.55, -0.2, 0.4], { mps: 0.2 });
const right = move("right", "ptp", [0.55, -0.2, 0.6]);

describe("a way round for a step that collides", () => {
  const program = programOf(left, across, right);

  test.each([1, 2, 3])(
    "points are inserted with which the whole program is ok, one edit, the target as it was taught (seed %i)",
    seed => {
      expect(checkProgram(program, robot, { cell }).verdict.ok).toBe(false);
      const found = detour(program, "across", robot, { cell, seed });
      if (found.kind !== "found") throw new Error(JSON.stringify(found));
      expect(found.points).toBeGreaterThan(0);
      expect(found.repair.insertBefore).toHaveLength(found.points);
      const mended = applyRepair(program, "across", found.repair);
      const { verdict, certificate } = checkProgram(mended, robot, { cell, certify: true });
      expect(verdict.ok).toBe(true);
      expect(mended.steps.map(({ id }) => id).filter(id => ["left", "across", "right"].includes(id))).toEqual([
        "left",
        "across",
        "right",
      ]);
      expect(mended.steps.find(({ id }) => id === "across")).toMatchObject({ path: "ptp", target: across.target });
      expect(certificate!.segments.length).toBeGreaterThanOrEqual(3);
      expect(verdict.clearance_m).toBeGreaterThan(0);
    },
  );

  test("inside a loop the step is led round as well", () => {
    const looped: Program = {
      ...program,
      steps: [{ id: "twice", type: "repeat", times: 2, steps: [left, across, right] }],
    };
    const found = detour(looped, "across", robot, { cell, seed: 1 });
    if (found.kind !== "found") throw new Error(JSON.stringify(found));
    expect(checkProgram(applyRepair(looped, "across", found.repair), robot, { cell }).verdict.ok).toBe(true);
  });

  test("a target in contact is named with both solids; so is a start", () => {
    const into = move("into", "ptp", [0.55, 0.2, 0.19]);
    expect(detour(programOf(left, into), "into", robot, { cell })).toMatchObject({
      kind: "none",
      why: {
        code: "way.goal-in-contact",
        sentence: "At the target the tool is in contact with “Plate”; no way leads into that.",
      },
    });
    expect(detour(programOf(into, right), "right", robot, { cell })).toMatchObject({
      kind: "none",
      why: { code: "way.start-in-contact" },
    });
  });

  test("cancelled it says nothing; a step that is no move says so; a limit that is used up is named", () => {
    expect(detour(program, "across", robot, { cell, cancelled: () => true })).toEqual({ kind: "cancelled" });
    const waits: Program = { ...program, steps: [left, { id: "w", type: "wait", s: 1 }] };
    expect(detour(waits, "w", robot, { cell })).toMatchObject({ kind: "none", why: { code: "way.no-move" } });
    expect(detour(program, "across", robot, { cell, maxLooks: 1 })).toMatchObject({
      kind: "none",
      why: { code: "way.not-found" },
    });
  });
});
