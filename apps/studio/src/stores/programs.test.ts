import { manualScheduler, robotById } from "@twincell/core";
import { emptyCell } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { showJoints, theLive } from "../runtime/live.ts";
import { controlCell } from "../runtime/run/run.ts";
import { writeProgram } from "../runtime/run/written-program.ts";
import { cellStore } from "./cell.ts";
import { showDocument, theProgram, undo } from "./document.ts";
import { languageOf } from "./languages.ts";
import { addWait, recordPoint } from "./program.ts";
import { chooseProgram, copyProgram, deleteProgram, nameProgram, newProgram } from "./programs.ts";

const robot = robotById("staubli_rx90l")!;
const names = (): readonly string[] => cellStore.getState().document!.programs.map(program => program.name);
beforeEach(() => {
  showDocument(emptyCell());
});

test("T-71 three programs are stored, the second is selected: the second is what runs", async () => {
  const turn = (angle: number): void => {
    recordPoint(
      "ptp",
      robot.home_rad.map((q, j) => (j === 0 ? angle : q)),
      "flange",
    );
  };
  turn(0.1);
  nameProgram("first");
  newProgram();
  nameProgram("second");
  turn(0.2);
  newProgram();
  nameProgram("third");
  turn(0.3);
  chooseProgram("second");
  expect(names()).toEqual(["first", "second", "third"]);
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
  const outcome = control.run(theProgram()!, "Cell");
  await scheduler.elapse(10);
  expect(await outcome).toEqual({ kind: "done" });
  expect(theLive().q_rad[0]).toBeCloseTo(0.2, 5);
  control.close();
});

test("a copy has a name of its own; deleting selects the neighbour; each is one undo step", () => {
  addWait(1);
  copyProgram();
  expect(new Set(names()).size).toBe(2);
  expect(theProgram()!.steps).toHaveLength(1);
  deleteProgram();
  expect(names()).toHaveLength(1);
  undo();
  expect(names()).toHaveLength(2);
});
