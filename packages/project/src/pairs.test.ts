import { learnPairs, linkSolids, robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { cellGeometry, edgeTraceCell, openDocument, saveDocument, type CellDocument } from "./index.ts";

const plain = edgeTraceCell();
const robot = robotById(plain.robot.id)!;
const learnt: CellDocument = {
  ...plain,
  pairs: {
    robot: robot.id,
    tool: plain.tool,
    ...learnPairs(cellGeometry(plain, linkSolids(robot)), robot.arm, 1, 200, robot.home_rad),
  },
};

test("the matrix of pairs is saved with the cell and opened as it was", () => {
  const opened = openDocument(saveDocument(learnt));
  expect(opened).toEqual({ kind: "opened", document: learnt, lifted: [] });
  expect(cellGeometry(learnt, []).pairs?.entries).toEqual(learnt.pairs!.entries);
  expect(learnt.pairs!.entries.some(({ b }) => b === "tool")).toBe(true);
});

test("a matrix says nothing of another robot, and nothing of another tool", () => {
  expect(cellGeometry({ ...learnt, robot: { ...learnt.robot, id: "ur10e" } }, []).pairs).toBeUndefined();
  const other = cellGeometry({ ...learnt, tool: "flange" }, []).pairs!.entries;
  expect(other.length).toBeGreaterThan(10);
  expect(other.some(({ a, b }) => a === "tool" || b === "tool")).toBe(false);
});

test("a matrix that is not one is refused with its place", () => {
  const spoilt = saveDocument(learnt).replace('"reason": "adjacent"', '"reason": "because"');
  const opened = openDocument(spoilt);
  expect(opened.kind === "not-a-cell" && opened.why[0]).toMatch(/^pairs\.entries\[0\]\.reason: /);
});
