import { expect, test } from "vitest";
import { diffCells, sayDifferences } from "./diff.ts";
import { isTextProgram, type CellDocument } from "./document.ts";
import { edgeTraceCell, emptyCell, tracedCartonCell } from "./example/index.ts";
import { openDocument } from "./open.ts";
import { saveDocument } from "./save.ts";

const said = (before: CellDocument, after: CellDocument): readonly string[] => sayDifferences(diffCells(before, after));

test("a cell does not differ from itself, nor from what was saved and opened again", () => {
  const cell = tracedCartonCell();
  const opened = openDocument(saveDocument(cell));
  expect(diffCells(cell, cell)).toEqual([]);
  expect(opened.kind === "opened" && diffCells(cell, opened.document)).toEqual([]);
});

test("a moved object is one line with both positions in mm and the distance", () => {
  const cell = edgeTraceCell();
  const after: CellDocument = {
    ...cell,
    objects: cell.objects.map(object => {
      if (object.id !== "carton") return object;
      const [x, y, z] = object.worldFromObject.position;
      return { ...object, worldFromObject: { ...object.worldFromObject, position: [x + 0.03, y + 0.04, z] as const } };
    }),
  };
  const lines = said(cell, after);
  expect(lines).toHaveLength(1);
  expect(lines[0]).toMatch(/^~ object Carton, pose, position: .* mm → .* mm \(moved by 50 mm\)$/);
});

test("added and removed things, a renamed cell, a removed step and a new order are named", () => {
  const cell = tracedCartonCell();
  const [program] = cell.programs;
  const without = program!.steps.slice(1);
  const after: CellDocument = {
    ...cell,
    name: "Other",
    objects: cell.objects.filter(object => object.id !== "carton"),
    frames: [...cell.frames, { name: "pallet", worldFromFrame: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] } }],
    programs: [{ ...program!, steps: [without[1]!, without[0]!, ...without.slice(2)] }],
  };
  const lines = said(cell, after);
  expect(lines).toContain("− object Carton");
  expect(lines).toContain("+ frame pallet");
  expect(lines).toContain(`~ cell, name: ${cell.name} → Other`);
  expect(
    lines.some(line => line.startsWith(`− program ${program!.name}, step “Home” (${program!.steps[0]!.id})`)),
  ).toBe(true);
  expect(lines).toContain(`~ program ${program!.name}, order of its steps`);
  expect(said(after, cell).length).toBe(lines.length);
});

test("every cell that differs gives at least one line: nothing of a document is left out of the comparison", () => {
  const cell = tracedCartonCell();
  const changes: readonly CellDocument[] = [
    { ...cell, robot: { ...cell.robot, id: "ur10e" } },
    { ...cell, tool: "flange" },
    { ...cell, tools: [] },
    { ...cell, allowedPairs: [["tool", "carton"]] },
    { ...cell, training: true },
    { ...cell, objects: cell.objects.map(object => ({ ...object, locked: true as const })) },
    { ...cell, programs: emptyCell().programs },
    {
      ...cell,
      programs: cell.programs.map(program => (isTextProgram(program) ? program : { ...program, routines: { a: [] } })),
    },
  ];
  for (const changed of changes) expect(said(cell, changed).length).toBeGreaterThan(0);
});
