import { edgeTraceCell, openDocument, saveDocument } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { cellStore } from "./cell.ts";
import { objectOf, showDocument, undo } from "./document.ts";
import { deleteObject, duplicateObject, renameObject, toggleHidden, toggleLocked } from "./objects.ts";
import { selectionStore } from "./selection.ts";

const object = (id: string) => objectOf(cellStore.getState().document, id);
const text = (): string => saveDocument(cellStore.getState().document!);

beforeEach(() => showDocument(edgeTraceCell()));

test("rename, duplicate, hide, lock and delete are one undo step each and give back the very same cell", () => {
  const before = text();
  for (const act of [
    () => renameObject("carton", "Big carton"),
    () => duplicateObject("carton"),
    () => toggleHidden("carton"),
    () => toggleLocked("carton"),
    () => deleteObject("carton"),
  ]) {
    act();
    expect(text()).not.toBe(before);
    expect(openDocument(text()).kind).toBe("opened");
    undo();
    expect(text()).toBe(before);
  }
});

test("a copy has an id and a name of its own, stands beside the first, is not locked and is selected", () => {
  toggleLocked("carton");
  const first = duplicateObject("carton")!;
  const second = duplicateObject(first)!;
  expect([object(first)!.name, object(second)!.name]).toEqual(["Carton 2", "Carton 3"]);
  expect(object(first)!.worldFromObject.position).not.toEqual(object("carton")!.worldFromObject.position);
  expect(object(first)!.locked).toBeUndefined();
  expect(selectionStore.getState().selected).toEqual({ kind: "object", id: second });
});

test("hide and lock taken back leave no trace in the saved cell; an empty name and an unknown object change nothing", () => {
  const before = text();
  toggleHidden("carton");
  expect(object("carton")!.hidden).toBe(true);
  toggleHidden("carton");
  expect(text()).toBe(before);
  expect([renameObject("carton", "  "), toggleLocked("none"), deleteObject("none"), duplicateObject("none")]).toEqual([
    false,
    false,
    false,
    null,
  ]);
  expect(text()).toBe(before);
});
