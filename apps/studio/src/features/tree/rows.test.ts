import { emptyProgram, type Program, type Step } from "@twincell/core";
import { expect, test } from "vitest";
import { anchorOf, behind, idsOf, pathOf, programRows } from "./rows.ts";

const point = (id: string, group?: string): Step => ({
  id,
  type: "move",
  path: "lin",
  target: { q: [0, 0, 0, 0, 0, 0] },
  speed: { mps: 0.1 },
  blend_m: 0,
  ...(group ? { group } : {}),
});
const program = {
  ...emptyProgram("staubli_rx90l"),
  groups: { e1: { name: "Edge 1" } },
  steps: [point("a"), point("b", "e1"), point("c", "e1"), { id: "w", type: "wait" as const, s: 0.5 }, point("d", "e1")],
};

test("a run of one group is one line with the worst verdict of its steps", () => {
  const rows = programRows(
    program,
    {
      ok: false,
      duration_s: 1,
      clearance_m: null,
      torque: { kind: "unknown", sentence: "" },
      assumptions: [],
      steps: [
        { id: "b", verdict: "ok", findings: [] },
        { id: "c", verdict: "bad", findings: [] },
      ],
    },
    new Set(),
  );
  expect(rows.map(row => row.key)).toEqual(["a", "group e1 b", "w", "group e1 d"]);
  expect(rows[1]).toMatchObject({ name: "Edge 1", verdict: "bad" });
  expect(idsOf(rows[1]!)).toEqual(["b", "c"]);
  expect(pathOf(rows[1]!)).toBe("lin");
});
test("an opened group shows its steps with their place in the whole program", () => {
  const rows = programRows(program, null, new Set(["b"]));
  expect(rows.flatMap(row => (row.kind === "step" ? [[row.step.id, row.index, row.inside]] : []))).toEqual([
    ["a", 0, false],
    ["b", 1, true],
    ["c", 2, true],
    ["w", 3, false],
  ]);
});

test("steps inside blocks stand below them, deeper; the other side of a decision and routines have a head", () => {
  const nested: Program = {
    ...program,
    routines: { pick: [point("p")] },
    steps: [
      {
        id: "r",
        type: "repeat",
        times: 2,
        steps: [
          point("a"),
          { id: "i", type: "if", when: { signal: "part", is: true }, then: [point("b")], else: [point("c", "e1")] },
        ],
      },
      point("d"),
    ],
  };
  const rows = programRows(nested, null, new Set());
  expect(
    rows.map(row => `${"  ".repeat(row.depth)}${row.kind === "step" ? `${row.index} ${row.step.id}` : row.name}`),
  ).toEqual(["0 r", "  1 a", "  2 i", "    3 b", "  Otherwise", "    Edge 1", "5 d", "Routine pick", "  6 p"]);
  // A block is stepped over whole, and what is put on a head goes to the end of the list above it.
  expect([behind(rows, 0), behind(rows, 2), behind(rows, 6)]).toEqual([6, 6, 7]);
  expect([anchorOf(rows[1]), anchorOf(rows[4]), anchorOf(rows[7]), anchorOf(undefined)]).toEqual([
    "a",
    { block: "i", side: "then" },
    "main",
    null,
  ]);
});
