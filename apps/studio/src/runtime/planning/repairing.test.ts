import { checkProgram, linkSolids, robotById, type MoveStep, type Program } from "@twincell/core";
import { cellGeometry, selectedProgram, tracedCartonCell, type CellDocument } from "@twincell/project";
import { afterEach, beforeEach, describe, expect, test } from "vitest";
import { checkCommands } from "../../commands/check.ts";
import { cellStore } from "../../stores/cell.ts";
import { connectionStore } from "../../stores/connection.ts";
import { showDocument, undo } from "../../stores/document.ts";
import { noticeStore } from "../../stores/notices.ts";
import { playStore } from "../../stores/play.ts";
import { repairStore } from "../../stores/repairs.ts";
import { showMode } from "../../stores/view.ts";
import type { FromPlanner, ToPlanner } from "../../workers/plan-messages.ts";
import { planTask } from "./plan-task.ts";
import { applyRepair, cancelRepairing, explainStep, repairProgram, startRepairing } from "./repairing.ts";

const cell = tracedCartonCell();
const robot = robotById(cell.robot.id)!;
const far: MoveStep = {
  id: "far",
  type: "move",
  path: "ptp",
  speed: { ratio: 0.3 },
  blend_m: 0,
  target: { pose: { position: [1.9, 0, 0.5], quaternion: [0, 1, 0, 0] }, frame: "world", tool: "torch" },
};
const program = cell.programs[0] as Program;
const broken: CellDocument = {
  ...cell,
  programs: [{ ...program, steps: [...program.steps.slice(0, 1), far, ...program.steps.slice(1)] }],
};
const now = (): CellDocument => cellStore.getState().document!;
/** The verdict of the cell as it is now, as the page's checker gives it. */
const judge = (): void => {
  const document = now();
  const { verdict, plan } = checkProgram(selectedProgram(document)!, robot, {
    cell: cellGeometry(document, linkSolids(robot)),
    margin_m: 0,
  });
  playStore.setState({ verdict, plan, stale: false });
};
const isBad = (): readonly string[] =>
  playStore
    .getState()
    .verdict!.steps.filter(({ verdict }) => verdict === "bad")
    .map(({ id }) => id);

/** Answers what it is asked when told to. */
class Double {
  readonly asked: ToPlanner[] = [];
  closed = 0;
  private hear: (message: FromPlanner) => void = () => undefined;
  hire = () => ({
    post: (message: ToPlanner) => void this.asked.push(message),
    listen: (hear: (message: FromPlanner) => void) => {
      this.hear = hear;
    },
    close: () => void this.closed++,
  });
  answer(): void {
    for (const message of this.asked.splice(0))
      this.hear(
        planTask(
          message,
          () => 0,
          told => this.hear(told),
        ),
      );
  }
}

let planner: Double;
let stop: () => void;
beforeEach(() => {
  planner = new Double();
  playStore.setState({ verdict: null, plan: null, stale: false });
  connectionStore.setState({ station: null });
  showDocument(broken);
  judge();
  stop = startRepairing(planner.hire);
});
afterEach(() => stop());

describe("ways out of a bad step", () => {
  test("are found away from the page, and one that is applied mends the step as one edit", () => {
    expect(isBad()).toContain("far");
    explainStep("far");
    expect(repairStore.getState().searching).toEqual({ kind: "explain", step: "far" });
    planner.answer();
    const { explanations, searching } = repairStore.getState();
    expect(searching).toBeNull();
    const { repairs, cause } = explanations.get("far")!;
    expect(cause).toBe("reach");
    expect(repairs.length).toBeGreaterThan(0);
    for (const repair of repairs) {
      expect(applyRepair("far", repair)).toBe(true);
      judge();
      expect(isBad()).not.toContain("far");
      undo();
      expect(now().programs).toEqual(broken.programs);
      judge();
      // What was found belonged to the verdict before.
      expect(repairStore.getState().explanations.size).toBe(0);
    }
  });

  test("are shown by their numbers in Check mode only, and Escape hides them", () => {
    explainStep("far");
    planner.answer();
    const command = (id: string) =>
      checkCommands({ now: () => undefined, cancel: () => undefined, stop: () => undefined }).find(
        each => each.id === id,
      )!;
    showMode("teach");
    expect(command("check.show-repair-1").can!()).toBe(false);
    showMode("check");
    expect(command("check.show-repair-1").can!()).toBe(true);
    command("check.show-repair-1").run();
    expect(repairStore.getState().shown).toMatchObject({ step: "far", index: 0, pinned: true });
    command("check.hide-repair").run();
    expect(repairStore.getState().shown).toBeNull();
    expect(command("check.hide-repair").can!()).toBe(false);
    expect(command("check.show-repair-3").can!()).toBe(
      repairStore.getState().explanations.get("far")!.repairs.length > 2,
    );
  });

  test("never move a robot that is connected", () => {
    connectionStore.setState({ station: "arm-1" });
    explainStep("far");
    expect(planner.asked[0]!.task).toMatchObject({ kind: "explain", movesBase: false });
  });

  test("are given up when the program changes under the search, or when told to", () => {
    explainStep("far");
    playStore.setState({ stale: true });
    expect(planner.closed).toBe(1);
    expect(repairStore.getState()).toMatchObject({ searching: null, verdict: null });
    planner.answer();
    expect(repairStore.getState().explanations.size).toBe(0);
    judge();
    explainStep("far");
    cancelRepairing();
    expect(planner.closed).toBe(2);
    expect(repairStore.getState().searching).toBeNull();
  });
});

describe("repair all", () => {
  test("mends every bad step as one edit and says so", () => {
    const bad = isBad();
    repairProgram();
    planner.answer();
    judge();
    expect(bad.length).toBeGreaterThan(0);
    expect(isBad()).toEqual([]);
    expect(noticeStore.getState().notices.at(-1)!.sentence).toMatch(
      /^\d+ repairs? applied\. Every step can be carried out\.$/,
    );
    undo();
    expect(now().programs).toEqual(broken.programs);
  });
});
