import { Stepper, appendStep, emptyProgram, robotById, unrolled, type Program, type Step } from "@twincell/core";
import { expect, test } from "vitest";
import type { CellDocument, StepsCell } from "./document.ts";
import { emptyCell } from "./example/index.ts";
import { openDocument } from "./open.ts";
import {
  addProgram,
  duplicateProgram,
  removeProgram,
  renameProgram,
  selectProgram,
  selectedProgram,
} from "./programs.ts";
import { saveDocument } from "./save.ts";

const robot = robotById("staubli_rx90l")!;
const point = (id: string, by_rad: number): Step => ({
  id,
  type: "move",
  path: "ptp",
  target: { q: robot.home_rad.map(q => q + by_rad) },
  speed: { ratio: 1 },
  blend_m: 0,
});
const taught = (name: string, by_rad: number): Program =>
  [
    point("p1", by_rad),
    { id: "w1", type: "wait", s: 0.1 } as const,
    { id: "g1", type: "gripper", closed: true } as const,
  ].reduce<Program>(appendStep, emptyProgram(robot.id, name));
function run(program: Program): Float64Array {
  const stepper = new Stepper(robot, program, unrolled(program), robot.home_rad);
  const q = Float64Array.from(robot.home_rad);
  while (stepper.advance(0.01, 1, q).kind === "running");
  return q;
}
const saved = (cell: CellDocument): CellDocument => {
  const opened = openDocument(saveDocument(cell));
  if (opened.kind !== "opened") throw new Error(JSON.stringify(opened));
  return opened.document;
};
const turned = (q: Float64Array): number => Math.round((q[0]! - robot.home_rad[0]!) * 1e6) / 1e6;

test("T-28 a program is stored in the cell, saved, loaded again and runs", () => {
  const cell = saved(addProgram(emptyCell(), taught("Weld", 0.2)));
  expect(selectedProgram(cell)).toEqual(taught("Weld", 0.2));
  expect(turned(run(selectedProgram(cell)!))).toBe(0.2);
});

test("T-29, T-33 a program is a list of actions, each a plain object in the file", () => {
  const cell = JSON.parse(saveDocument(addProgram(emptyCell(), taught("Weld", 0.2)))) as StepsCell;
  expect(cell.programs.find(program => program.name === "Weld")!.steps).toEqual([
    point("p1", 0.2),
    { id: "w1", type: "wait", s: 0.1 },
    { id: "g1", type: "gripper", closed: true },
  ]);
});

test("T-71 three programs stored, the second selected: only the second runs, also after saving", () => {
  const three = [taught("A", 0.1), taught("B", 0.2), taught("C", 0.3)].reduce(addProgram, emptyCell());
  expect(three.program).toBe("C");
  const cell = saved(selectProgram(three, "B"));
  expect(cell.programs.map(program => program.name).slice(-3)).toEqual(["A", "B", "C"]);
  expect(turned(run(selectedProgram(cell)!))).toBe(0.2);
  expect(selectProgram(cell, "Z")).toBe(cell);
});

test("programs are copied, renamed and taken out; names stay unique and one is always selected", () => {
  let cell = addProgram(addProgram(emptyCell(), taught("A", 0.1)), taught("A", 0.2));
  expect(cell.program).toBe("A 2");
  cell = renameProgram(cell, "A 2", " B ");
  expect(cell.program).toBe("B");
  cell = duplicateProgram(cell, "A");
  expect(selectedProgram(cell)).toMatchObject({ name: "A 2", steps: taught("A", 0.1).steps });
  cell = removeProgram(cell, "A 2");
  expect(cell.program).toBe("B");
  for (const name of cell.programs.map(program => program.name)) cell = removeProgram(cell, name);
  expect(cell.programs.length).toBe(1);
  expect(selectedProgram(cell)!.steps).toEqual([]);
});

test("a cell says version 2 of its programs that compute, and version 1 of the others, as before", () => {
  const plain = taught("Plain", 0.1);
  const computes: Program = {
    ...taught("Computes", 0.1),
    variables: { count: { type: "int" } },
    steps: [{ id: "a", type: "assign", variable: "count", to: { op: "+", of: [{ variable: "count" }, 1] } }],
  };
  const cell = addProgram(addProgram(emptyCell(), plain), computes);
  const again = saved(cell);
  expect(again.programs.map(({ name, version }) => [name, version])).toEqual(
    expect.arrayContaining([
      ["Plain", 1],
      ["Computes", 2],
    ]),
  );
  expect(saveDocument(again)).toBe(saveDocument(cell));
});
