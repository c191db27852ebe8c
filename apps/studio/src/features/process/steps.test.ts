import { conveyorPalletCell, emptyCell, type CellDocument, type ObjectRecord } from "@twincell/project";
import { pose } from "@twincell/core";
import { expect, test } from "vitest";
import { nextStep, PROCESS_STEPS, stepsDone, type Progress } from "./steps.ts";

const boxObject = (id: string, role: ObjectRecord["role"]): ObjectRecord => ({
  id,
  name: id,
  role,
  worldFromObject: pose([1, 0, 0.5]),
  shape: { kind: "box", size_m: [1, 1, 1] },
  color: "#888888",
});
const at = (document: CellDocument, more: Partial<Progress> = {}): Progress => ({
  document,
  steps: 0,
  simulated: false,
  judged: null,
  runs: 0,
  ...more,
});

test("N-01 six steps, each done by what is in the cell: objects, kinematics, interactions, scenario, run, execute and correct", () => {
  expect(PROCESS_STEPS).toEqual(["objects", "kinematics", "interactions", "scenario", "run", "execute"]);
  const empty = emptyCell();
  expect([...stepsDone(at(empty))]).toEqual([]);
  expect(nextStep(stepsDone(at(empty)))).toBe("objects");
  const full = conveyorPalletCell();
  const table = boxObject("table", "furniture");
  const withTable = { ...empty, objects: [table] };
  expect([...stepsDone(at(withTable))]).toEqual(["objects"]);
  expect(nextStep(stepsDone(at(withTable)))).toBe("kinematics");
  const withTool = { ...withTable, tools: full.tools, tool: full.tool };
  expect(nextStep(stepsDone(at(withTool)))).toBe("interactions");
  expect(nextStep(stepsDone(at(full)))).toBe("scenario");
  expect(nextStep(stepsDone(at(full, { steps: 3 })))).toBe("run");
  expect(nextStep(stepsDone(at(full, { steps: 3, simulated: true, judged: "bad" })))).toBe("execute");
  // A run of a program in which something is left to correct does not end it.
  expect(nextStep(stepsDone(at(full, { steps: 3, simulated: true, judged: "bad", runs: 1 })))).toBe("execute");
  expect(nextStep(stepsDone(at(full, { steps: 3, simulated: true, judged: "clear", runs: 1 })))).toBeNull();
});
