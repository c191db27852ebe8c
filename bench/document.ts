import { seededRandom, type Vector3 } from "@twincell/core";
import {
  createHistory,
  edgeTraceCell,
  followObjects,
  openDocument,
  saveDocument,
  type CellDocument,
} from "@twincell/project";
import { figure, type Bench } from "./figure.ts";

const OBJECTS = 500;
const ROUNDS = 15;
const EDITS = 10_000;

/** A work cell as large as the budget says: boxes in rows around the example. */
function largeCell(): CellDocument {
  const example = edgeTraceCell();
  const [first] = example.objects;
  if (!first) throw new Error("The example is empty.");
  const more = Array.from({ length: OBJECTS - example.objects.length }, (_, i) => ({
    ...first,
    id: `part-${i}`,
    name: `Part ${i}`,
    worldFromObject: {
      ...first.worldFromObject,
      position: [3 + (i % 25) * 0.5, Math.floor(i / 25) * 0.5, 0.2] as Vector3,
    },
  }));
  return { ...example, objects: [...example.objects, ...more] };
}

const moved = (document: CellDocument, at: number, x_m: number): CellDocument => ({
  ...document,
  objects: document.objects.map((object, i) => {
    const { worldFromObject } = object;
    const [, y, z] = worldFromObject.position;
    return i === at ? { ...object, worldFromObject: { ...worldFromObject, position: [x_m, y, z] as Vector3 } } : object;
  }),
});
const timed = (call: () => unknown): number => {
  const began = performance.now();
  call();
  return performance.now() - began;
};

/**
 * The cell document: a cell of 500 objects read and written as text, one edit and one undo in it, and 10,000 random
 * moves taken back: the text is that of the beginning, or this is a fault.
 */
export const run: Bench = () => {
  const cell = largeCell();
  const text = saveDocument(cell);
  const opened = Array.from({ length: ROUNDS }, () =>
    timed(() => {
      if (openDocument(text).kind !== "opened") throw new Error("The cell is not read back.");
    }),
  );
  const saved = Array.from({ length: ROUNDS }, () => timed(() => saveDocument(cell)));
  const random = seededRandom(1);
  let history = createHistory(cell);
  const edits: number[] = [];
  for (let n = 0; n < EDITS; n++) {
    const at = Math.floor(random() * OBJECTS);
    const x_m = random();
    edits.push(
      timed(() => {
        history = history.commit("Move", followObjects(moved(history.document, at, x_m)));
      }),
    );
  }
  const undone: number[] = [];
  while (history.undoLabels.length > 0) undone.push(timed(() => (history = history.undo())));
  if (saveDocument(history.document) !== text) throw new Error("10,000 edits were not taken back to the byte.");
  return Promise.resolve([
    figure("document/open-500", "ms", opened, "budget 2000"),
    figure("document/save-500", "ms", saved),
    figure("document/edit-500", "ms", edits),
    figure("document/undo-500", "ms", undone, `budget 16; ${EDITS} edits taken back to the byte`),
  ]);
};
