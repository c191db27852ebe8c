import { manualScheduler, replaceStep, robotById, type Program } from "@twincell/core";
import { emptyCell } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { showJoints, theLive } from "../runtime/live.ts";
import { controlCell } from "../runtime/run/run.ts";
import { writeProgram } from "../runtime/run/written-program.ts";
import { cellStore } from "./cell.ts";
import { commit, showDocument, theProgram, undo, withProgram } from "./document.ts";
import { languageOf } from "./languages.ts";
import { addAssign, addIf, addWhile, recordPoint, removeVariables, setVariable, stepWords } from "./program.ts";
import { select } from "./selection.ts";

const robot = robotById("staubli_rx90l")!;
const turn = (angle: number): void => {
  recordPoint(
    "ptp",
    robot.home_rad.map((q, j) => (j === 0 ? angle : q)),
    "flange",
  );
};
beforeEach(() => {
  showDocument(emptyCell());
});

test("a counted loop is put together step by step, named as it reads, and runs on the virtual controller as its text says", async () => {
  addWhile();
  const loop = theProgram()!.steps[0]!.id;
  commit("condition", document =>
    withProgram(document, program => {
      const step = program.steps[0]!;
      return step.type === "while"
        ? replaceStep(program, loop, { ...step, when: { expression: { op: "<", of: [{ variable: "count" }, 3] } } })
        : program;
    }),
  );
  select({ kind: "step", id: loop });
  addAssign();
  select({ kind: "step", id: loop });
  turn(0.1);
  select({ kind: "step", id: loop });
  turn(0.2);
  setVariable("count", { type: "int", initial: 1 });
  const program: Program = theProgram()!;
  const [step] = program.steps;
  if (step?.type !== "while") throw new Error("a loop was expected");
  expect(step.steps.map(({ type }) => type)).toEqual(["assign", "move", "move"]);
  expect(stepWords(step, 0)).toBe("While count < 3");
  expect(stepWords(step.steps[0]!, 1)).toBe("count = count + 1");
  const scheduler = manualScheduler();
  showJoints(robot.home_rad);
  const control = controlCell(
    {
      dialect: () => languageOf(robot),
      write: async wanted =>
        writeProgram(languageOf(robot), wanted, robot, cellStore.getState().document!.robot.worldFromBase),
      scheduler,
      shelf: {
        set: async () => undefined,
        get: async () => undefined,
        keys: async () => [],
        remove: async () => undefined,
      },
      clock_ms: () => 0,
    },
    {
      robot,
      worldFromBase: cellStore.getState().document!.robot.worldFromBase,
      flangeFromTcp: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
    },
  );
  const running = control.run(program, "cell");
  let turns = 0;
  let isThere = false;
  for (let i = 0; i < 4000; i++) {
    await Promise.resolve();
    scheduler.advance(0.01);
    const angle = theLive().q_rad[0]!;
    if (!isThere && angle > 0.199) turns++;
    if (angle > 0.199) isThere = true;
    if (angle < 0.101) isThere = false;
  }
  expect(await running).toEqual({ kind: "done" });
  // From 1 to 3: two rounds.
  expect(turns).toBe(2);
  control.close();
});

test("a decision has two sides, and what was added is taken back step by step", () => {
  addIf();
  expect(theProgram()!.steps[0]).toMatchObject({ type: "if", then: [], else: [] });
  addAssign();
  expect(theProgram()!.variables).toEqual({ count: { type: "int" } });
  undo();
  expect(theProgram()!.variables).toBeUndefined();
  undo();
  expect(theProgram()!.steps).toEqual([]);
});

test("a variable that no step names is removed; with the last of them the program has none", () => {
  addAssign();
  setVariable("spare", { type: "bool" });
  removeVariables(["spare"]);
  expect(theProgram()!.variables).toEqual({ count: { type: "int" } });
  removeVariables(["count"]);
  expect(theProgram()!.variables).toBeUndefined();
  undo();
  expect(theProgram()!.variables).toEqual({ count: { type: "int" } });
});
