import { addCoords, editCoords, pose, removeCoords } from "@twincell/core";
import { expect, test } from "vitest";
import { createHistory, emptyCell, openDocument, saveDocument, savedPosesOf, withSavedPoses } from "./index.ts";

const tip = pose<"world", "tcp">([0.8, 0.1, 0.5], [0.6, 0, 0, 0.8]), far = pose<"world", "tcp">([900, 1, 1], [0.6, 0, 0, 0.8]);

test("L-44 L-45 L-48 poses are kept among the frames of the cell, edited, erased, and brought back by undo", () => {
  const start = { ...emptyCell(), frames: [{ name: "carton", worldFromFrame: pose<"world", "frame">([1, 2, 3]) }] };
  const added = withSavedPoses(start, addCoords(savedPosesOf(start), tip, "above"));
  expect(added.frames.map(({ name }) => name)).toEqual(["carton", "pose/above"]);
  const edited = withSavedPoses(added, editCoords(savedPosesOf(added), "above", { name: "far", worldFromTcp: far }));
  const erased = withSavedPoses(edited, removeCoords(savedPosesOf(edited)));
  expect(erased.frames).toEqual(start.frames);

  const history = createHistory(start).commit("Save pose", added).commit("Edit pose", edited).commit("Erase poses", erased);
  expect(savedPosesOf(history.document)).toEqual([]);
  expect(savedPosesOf(history.undo().document)).toEqual([{ name: "far", worldFromTcp: far }]);
  expect(savedPosesOf(history.undo().undo().document)).toEqual([{ name: "above", worldFromTcp: tip }]);
});

test("a saved cell has its poses when it is opened again", () => {
  const cell = withSavedPoses(emptyCell(), addCoords(addCoords([], tip), far)), opened = openDocument(saveDocument(cell));
  if (!("document" in opened)) throw new Error(JSON.stringify(opened));
  expect(savedPosesOf(opened.document)).toEqual([{ name: "P1", worldFromTcp: tip }, { name: "P2", worldFromTcp: far }]);
});
