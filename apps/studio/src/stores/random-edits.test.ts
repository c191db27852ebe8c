import { seededRandom, type Vector3 } from "@twincell/core";
import { edgeTraceCell, saveDocument, type CellDocument } from "@twincell/project";
import { expect, test } from "vitest";
import { cellStore } from "./cell.ts";
import { commit, showDocument, undo, withObject } from "./document.ts";
import {
  addCopies,
  deleteObjects,
  duplicateObject,
  groupObjects,
  renameObject,
  toggleHidden,
  toggleLocked,
  ungroupObjects,
} from "./objects.ts";

const EDITS = 10_000;
const OBJECTS = 500;

const cell = (): CellDocument => cellStore.getState().document!;
const text = (): string => saveDocument(cell());
/** The example with boxes in rows, as many as are asked for. */
function largeCell(objects: number): CellDocument {
  const example = edgeTraceCell();
  const [first] = example.objects;
  const more = Array.from({ length: objects - example.objects.length }, (_, i) => ({
    ...first!,
    id: `part-${i}`,
    name: `Part ${i}`,
    worldFromObject: {
      ...first!.worldFromObject,
      position: [3 + (i % 25) * 0.5, Math.floor(i / 25) * 0.5, 0.2] as Vector3,
    },
  }));
  return { ...example, objects: [...example.objects, ...more] };
}

/** One edit as a person does them; some of them change nothing, as a locked or missing thing does not. */
function edit(random: () => number): void {
  const { objects } = cell();
  const { id } = objects[Math.floor(random() * objects.length)]!;
  const other = objects[Math.floor(random() * objects.length)]!.id;
  const place: Vector3 = [random() * 2, random() * 2 - 1, random()];
  const acts: readonly (() => unknown)[] = [
    () =>
      commit("Move", document =>
        withObject(document, id, object => ({
          ...object,
          worldFromObject: { ...object.worldFromObject, position: place },
        })),
      ),
    () => commit("Colour", document => withObject(document, id, object => ({ ...object, color: "#336699" }))),
    () => renameObject(id, `Name ${Math.floor(random() * 1e6)}`),
    () => (objects.length < 60 ? duplicateObject(id) : deleteObjects([id, other])),
    () => (objects.length > 3 ? deleteObjects([id]) : duplicateObject(id)),
    () => toggleHidden(id),
    () => toggleLocked(id),
    () => groupObjects([id, other]),
    () => ungroupObjects([id]),
    () => objects.length < 60 && addCopies(id, "Pattern", ({ worldFromObject }) => [worldFromObject, worldFromObject]),
  ];
  acts[Math.floor(random() * acts.length)]!();
}

test("10,000 random edits are taken back one by one to the byte-equal start", () => {
  showDocument(largeCell(12));
  const before = text();
  const random = seededRandom(20261127);
  for (let n = 0; n < EDITS; n++) edit(random);
  const steps = cellStore.getState().undo.length;
  expect(steps).toBeGreaterThan(EDITS / 2);
  expect(text()).not.toBe(before);
  for (let n = 0; n < steps; n++) expect(undo()).not.toBeNull();
  expect(undo()).toBeNull();
  expect(text()).toBe(before);
}, 120_000);

test("in a cell of 500 objects an undo takes less than 16 ms", () => {
  showDocument(largeCell(OBJECTS));
  expect(cell().objects).toHaveLength(OBJECTS);
  const random = seededRandom(7);
  for (let n = 0; n < 200; n++) {
    const { id } = cell().objects[Math.floor(random() * OBJECTS)]!;
    renameObject(id, `Named ${n}`);
  }
  const times = Array.from({ length: 200 }, () => {
    const began = performance.now();
    undo();
    return performance.now() - began;
  }).sort((a, b) => a - b);
  // The median: on a machine that others use, single calls wait for the processor.
  expect(times[100]!).toBeLessThan(16);
});
