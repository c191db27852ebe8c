import { identity, linkSolids, RepairSearch, robotById, tracedEdgeOf, type Vector3 } from "@twincell/core";
import { expect, test } from "vitest";
import type { CellDocument, ObjectRecord } from "./document.ts";
import { tracedCartonCell } from "./example/index.ts";
import { selectedProgram } from "./programs.ts";
import { cellGeometry } from "./mesh/shape.ts";
import { framesWith, nameOfFrame, objectsOfFrame, repairCell } from "./repair.ts";

const like: ObjectRecord = tracedCartonCell().objects[0]!;
const cell: CellDocument = {
  ...tracedCartonCell(),
  objects: [
    { ...like, id: "a", name: "Carton", group: "stack" },
    { ...like, id: "b", name: "Lid", group: "stack" },
    { ...like, id: "c", name: "Table" },
  ],
  frames: [
    { name: "edge", worldFromFrame: identity(), attachedTo: { object: "b", objectFromFrame: identity() } },
    { name: "side", worldFromFrame: identity(), attachedTo: { object: "a", objectFromFrame: identity() } },
    { name: "corner", worldFromFrame: identity(), attachedTo: { object: "c", objectFromFrame: identity() } },
    { name: "free", worldFromFrame: identity() },
  ],
};

test("what moves with a frame: its object with the rest of its group, and the frames attached to those", () => {
  expect(objectsOfFrame(cell, "edge")).toEqual(["a", "b"]);
  expect(objectsOfFrame(cell, "corner")).toEqual(["c"]);
  expect(objectsOfFrame(cell, "free")).toEqual([]);
  expect(objectsOfFrame(cell, "nobody")).toEqual([]);
  expect(framesWith(cell, "edge")).toEqual(["edge", "side"]);
  expect(framesWith(cell, "free")).toEqual(["free"]);
});

test("a frame is called by the object it is attached to, or by its own name", () => {
  expect(nameOfFrame(cell, "edge")).toBe("Lid");
  expect(nameOfFrame(cell, "free")).toBe("free");
});

test("a part that is moved takes its group, its frames and what is taught in them along; a free frame moves alone", () => {
  const by_m: Vector3 = [0.1, -0.2, 0.05];
  const start = tracedCartonCell();
  const carton = start.frames.find(({ attachedTo }) => attachedTo !== undefined)!;
  const object = carton.attachedTo!.object;
  const at = (of: CellDocument, id: string) => of.objects.find(each => each.id === id)!.worldFromObject.position;
  const moved = repairCell(start, start.program, "", { moveFrame: { frame: carton.name, by_m } });
  for (const axis of [0, 1, 2] as const) {
    expect(at(moved, object)[axis] - at(start, object)[axis]).toBeCloseTo(by_m[axis], 12);
    for (const frame of framesWith(start, carton.name)) {
      const of = (cell: CellDocument) => cell.frames.find(({ name }) => name === frame)!.worldFromFrame.position[axis];
      expect(of(moved) - of(start)).toBeCloseTo(by_m[axis], 12);
      const taught = (cell: CellDocument) => selectedProgram(cell)!.frames[frame]?.position[axis] ?? 0;
      if (selectedProgram(start)!.frames[frame] !== undefined)
        expect(taught(moved) - taught(start)).toBeCloseTo(by_m[axis], 12);
    }
  }
  const alone = repairCell(cell, cell.program, "", { moveFrame: { frame: "free", by_m } });
  expect(alone.objects).toEqual(cell.objects);
  expect(alone.frames.map(({ name, worldFromFrame }) => [name, worldFromFrame.position])).toContainEqual([
    "free",
    [0.1, -0.2, 0.05],
  ]);
});

test("a robot that is moved leaves parts, frames and points where they are", () => {
  const start = tracedCartonCell();
  const moved = repairCell(start, start.program, "", { moveBase: { by_m: [0.3, 0, 0] } });
  expect(moved.robot.worldFromBase.position[0] - start.robot.worldFromBase.position[0]).toBeCloseTo(0.3, 12);
  expect(moved.objects).toBe(start.objects);
  expect(moved.frames).toBe(start.frames);
});

test("points that were moved off the edge they were traced on are put back onto it by one repair, also where they are out of reach", () => {
  const start = tracedCartonCell();
  const robot = robotById(start.robot.id)!;
  const program = selectedProgram(start)!;
  const judge = (document: CellDocument) => {
    const cell = cellGeometry(document, linkSolids(robot));
    return new RepairSearch(selectedProgram(document)!, robot, { cell });
  };
  const away = new Set(
    Object.values(program.groups)
      .flatMap(group => tracedEdgeOf(group)?.edgeSteps ?? [])
      .slice(0, 2),
  );
  for (const by_m of [[0.06, -0.04, 0.03] as const, [1.6, 0, 0.1] as const]) {
    const steps = program.steps.map(step => {
      if (step.type !== "move" || !("pose" in step.target) || !away.has(step.id)) return step;
      const [x, y, z] = step.target.pose.position;
      const position: Vector3 = [x + by_m[0], y + by_m[1], z + by_m[2]];
      return { ...step, target: { ...step.target, pose: { ...step.target.pose, position } } };
    });
    const broken: CellDocument = { ...start, programs: [{ ...program, steps }] };
    const search = judge(broken);
    const bad = search.bad.find(id => away.has(id))!;
    const [repair] = search.explain(bad)!.repairs;
    expect(repair).toMatchObject({ kind: "edge", reaches: { bad: 0 } });
    expect(repair!.sentence).toMatch(/^Put (the point|\d points) back onto the edge of Carton\.$/);
    expect(judge(repairCell(broken, program.name, bad, repair!)).bad).toEqual([]);
  }
});
