import { identity } from "@twincell/core";
import { expect, test } from "vitest";
import type { CellDocument, ObjectRecord } from "./document.ts";
import { tracedCartonCell } from "./example/index.ts";
import { framesWith, nameOfFrame, objectsOfFrame } from "./repair.ts";

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
