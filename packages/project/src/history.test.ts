import fc from "fast-check";
import { expect, test } from "vitest";
import { createHistory, emptyCell, type CellDocument } from "./index.ts";

const named = (name: string): CellDocument => ({ ...emptyCell(), name });

test("undo and redo walk to and fro over what was committed", () => {
  const start = named("0");
  const one = named("1");
  const two = named("2");
  const history = createHistory(start).commit("First", one).commit("Second", two);
  expect(history.undoLabels).toEqual(["Second", "First"]);
  const back = history.undo();
  expect(back.document).toBe(one);
  expect(back.redoLabels).toEqual(["Second"]);
  expect(back.undo().undo().undo().document).toBe(start);
  expect(back.redo().document).toBe(two);
  expect(back.commit("Third", named("3")).redoLabels).toEqual([]);
  expect(history.document).toBe(two);
});

test("one gesture is one change, and an unchanged document is none", () => {
  const history = createHistory(named("0"))
    .commit("Tilt", named("1"), "drag 1")
    .commit("Tilt", named("2"), "drag 1")
    .commit("Tilt", named("3"), "drag 2");
  expect(history.undoLabels).toEqual(["Tilt", "Tilt"]);
  expect(history.undo().document.name).toBe("2");
  expect(history.undo().undo().document.name).toBe("0");
  expect(history.commit("Nothing", history.document)).toBe(history);
  // After an undo the same gesture starts anew: it must not swallow the step before.
  expect(history.undo().commit("Tilt", named("4"), "drag 1").undo().document.name).toBe("2");
});

test("agrees with a plain list and a cursor, whatever is done, and never keeps more than its depth", () => {
  const action = fc.oneof(
    fc.constant("undo" as const),
    fc.constant("redo" as const),
    fc.nat(1000).map(n => ({ name: String(n) })),
  );
  fc.assert(
    fc.property(fc.array(action, { maxLength: 60 }), actions => {
      const depth = 5;
      let history = createHistory(named("start"), depth);
      let list = [history.document];
      let cursor = 0;
      for (const act of actions) {
        if (act === "undo") {
          history = history.undo();
          cursor = Math.max(0, cursor - 1);
        } else if (act === "redo") {
          history = history.redo();
          cursor = Math.min(list.length - 1, cursor + 1);
        } else {
          const next = named(act.name);
          history = history.commit("x", next);
          list = [...list.slice(0, cursor + 1), next].slice(-(depth + 1));
          cursor = list.length - 1;
        }
        expect(history.document).toBe(list[cursor]);
        expect(history.undoLabels).toHaveLength(cursor);
        expect(history.redoLabels).toHaveLength(list.length - 1 - cursor);
      }
    }),
    { seed: 3, numRuns: 100 },
  );
});
