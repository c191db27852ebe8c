import { readFileSync } from "node:fs";
import { compose, flangePose, pose, posesAgree, robotById, type MoveStep, type Pose } from "@twincell/core";
import { expect, test } from "vitest";
import {
  attachFrame,
  attachSteps,
  followObjects,
  objectOfTarget,
  placeFrame,
  removeFrame,
  usesOfFrame,
} from "./attach.ts";
import type { CellDocument } from "./document.ts";
import { tracedCartonCell } from "./example/index.ts";
import { openDocument } from "./open.ts";
import { stepPrograms } from "./programs.ts";
import { saveDocument } from "./save.ts";
import { cellJsonSchema } from "./schema-text.ts";

const half = Math.SQRT1_2;
const worldFromMoved: Pose<"world", "object"> = pose([0.3, -0.2, 0.9], [0, 0, half, half]);
const moved = (cell: CellDocument, id: string): CellDocument =>
  followObjects({
    ...cell,
    objects: cell.objects.map(object => (object.id === id ? { ...object, worldFromObject: worldFromMoved } : object)),
  });
const objectOf = (cell: CellDocument, id: string) => cell.objects.find(object => object.id === id)!;

/** The moves of the first program, with where each puts the tool in the world. */
function reached(cell: CellDocument): { readonly step: MoveStep; readonly worldFromTcp: Pose }[] {
  const program = stepPrograms(cell)[0]!;
  const robot = robotById(cell.robot.id)!;
  return program.steps.flatMap(step => {
    if (step.type !== "move") return [];
    const { target } = step;
    const tool = program.tools[target.tool ?? cell.tool]!;
    const worldFromTcp =
      "q" in target
        ? compose(compose(cell.robot.worldFromBase, flangePose(robot.arm, target.q)), tool)
        : compose(program.frames[target.frame]!, target.pose);
    return [{ step, worldFromTcp }];
  });
}

test("an attached frame keeps its pose relative to the object: it moves with it and says where it is now", () => {
  const cell = tracedCartonCell();
  const object = cell.objects.at(-1)!;
  const frame = cell.frames[0]!;
  const attached = attachFrame(cell, frame.name, object.id);
  expect(followObjects(attached).frames[0]!.worldFromFrame).toEqual(frame.worldFromFrame);
  const after = moved(attached, object.id);
  const relative = attached.frames[0]!.attachedTo!.objectFromFrame;
  expect(after.frames[0]!.worldFromFrame).toEqual(compose(worldFromMoved, relative));
  expect(stepPrograms(after)[0]!.frames[frame.name]).toEqual(after.frames[0]!.worldFromFrame);
  expect(followObjects(after)).toBe(after);
  expect(attachFrame(after, frame.name, null).frames[0]).not.toHaveProperty("attachedTo");
  expect(attachFrame(cell, frame.name, "nobody")).toBe(cell);
});

test("taught points of joint angles and of poses are attached where they stand, and then follow the object", () => {
  const cell = tracedCartonCell();
  const object = cell.objects.at(-1)!;
  const program = cell.programs[0]!;
  const ids = program.steps.map(step => step.id);
  const attached = attachSteps(cell, program.name, ids, object.id);
  const before = reached(cell);
  const now = reached(attached);
  now.forEach(({ step, worldFromTcp }, i) => {
    expect(objectOfTarget(attached, step.target)).toBe(object.id);
    expect(posesAgree(worldFromTcp, before[i]!.worldFromTcp, 1e-9, 1e-9), step.id).toBe(true);
  });
  const newFromOld = compose(worldFromMoved, { position: [0, 0, 0], quaternion: [0, 0, 0, 1] } as Pose<
    "object",
    "object"
  >);
  const after = moved(attached, object.id);
  reached(after).forEach(({ step, worldFromTcp }, i) => {
    const { target } = now[i]!.step;
    if ("q" in target) throw new Error("a point is still of joint angles");
    expect(
      posesAgree(worldFromTcp, compose(newFromOld, target.pose as Pose as Pose<"object", "tcp">), 1e-9, 1e-9),
      step.id,
    ).toBe(true);
  });
  const opened = openDocument(saveDocument(after));
  expect(opened).toMatchObject({ kind: "opened", lifted: [] });
  expect(opened.kind === "opened" && saveDocument(opened.document)).toBe(saveDocument(after));
});

test("an attached frame that is placed elsewhere stays there and still follows its object", () => {
  const cell = tracedCartonCell();
  const object = cell.frames[0]!.attachedTo!.object;
  const there: Pose<"world", "frame"> = pose([0.5, 0.1, 0.7], [0, 0, half, half]);
  const placed = followObjects(placeFrame(cell, cell.frames[0]!.name, there));
  expect(posesAgree(placed.frames[0]!.worldFromFrame, there, 1e-12, 1e-12)).toBe(true);
  expect(posesAgree(moved(placed, object).frames[0]!.worldFromFrame, there, 1e-3, 1e-3)).toBe(false);
  expect(placeFrame(cell, "nobody", there)).toBe(cell);
});

test("a frame whose object is taken out stays where it is; a file that names an object it does not have is refused", () => {
  const cell = tracedCartonCell();
  const object = cell.objects.at(-1)!;
  const attached = attachFrame(cell, cell.frames[0]!.name, object.id);
  const without = { ...attached, objects: attached.objects.filter(each => each.id !== object.id) };
  expect(followObjects(without).frames[0]).toEqual({
    name: cell.frames[0]!.name,
    worldFromFrame: cell.frames[0]!.worldFromFrame,
  });
  const opened = openDocument(saveDocument(without));
  expect(opened).toEqual({
    kind: "not-a-cell",
    why: [`frames[0].attachedTo.object: the cell has no object with the id "${object.id}".`],
  });
  expect(objectOf(cell, object.id)).toBe(object);
});

test("docs/cell.schema.json is what the code says; after a change run scripts/write-schemas.mjs", () => {
  const kept: unknown = JSON.parse(readFileSync(new URL("../../../docs/cell.schema.json", import.meta.url), "utf8"));
  expect(kept).toEqual(JSON.parse(JSON.stringify(cellJsonSchema())));
});

test("a frame that nothing counts from is removed with its copies in the programs; one in use stays, and its uses are counted", () => {
  const cell = tracedCartonCell();
  const [program] = stepPrograms(cell);
  const used = cell.frames.find(({ name }) => usesOfFrame(cell, name) > 0)!.name;
  const counted = program!.steps.filter(
    step => step.type === "move" && "frame" in step.target && step.target.frame === used,
  ).length;
  expect(usesOfFrame(cell, used)).toBe(counted);
  expect(counted).toBeGreaterThan(0);
  expect(removeFrame(cell, used)).toBe(cell);
  expect(removeFrame(cell, "nowhere")).toBe(cell);
  const free = { name: "Unused", worldFromFrame: pose<"world", "frame">([1, 0, 0]) };
  const more: CellDocument = {
    ...cell,
    frames: [...cell.frames, free],
    programs: cell.programs.map(each =>
      "frames" in each ? { ...each, frames: { ...each.frames, Unused: free.worldFromFrame } } : each,
    ),
  };
  const less = removeFrame(more, "Unused");
  expect(less.frames).toEqual(cell.frames);
  expect(stepPrograms(less).map(each => each.frames)).toEqual(stepPrograms(cell).map(each => each.frames));
  const pallet = {
    ...more,
    programs: stepPrograms(more).map(each => ({
      ...each,
      pallets: {
        P: {
          frame: "Unused",
          origin: pose<"frame", "place">(),
          rowEnd: [1, 0, 0] as [number, number, number],
          columnEnd: [0, 1, 0] as [number, number, number],
          rows: 2,
          columns: 2,
          layers: 1,
          layer_m: 0,
        },
      },
    })),
  };
  expect(usesOfFrame(pallet, "Unused")).toBe(1);
  expect(removeFrame(pallet, "Unused")).toBe(pallet);
});
