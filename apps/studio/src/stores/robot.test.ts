import { LIBRARY, robotById } from "@twincell/core";
import { openDocument, saveDocument, tracedCartonCell } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { startFollowing } from "../runtime/robot/follow.ts";
import { theLive } from "../runtime/live.ts";
import { cellStore } from "./cell.ts";
import { showDocument, theProgram, undo } from "./document.ts";
import { noticeStore } from "./notices.ts";
import { changeRobot, shortName } from "./robot.ts";

beforeEach(() => {
  noticeStore.setState({ notices: [] });
  showDocument(tracedCartonCell());
});

test("another robot is one undo step: the cell stays, every program goes over, and the notice counts the points", () => {
  const before = cellStore.getState().document!;
  expect(changeRobot("ur10e")).toBe(true);
  const after = cellStore.getState().document!;
  expect(after.robot).toEqual({ ...before.robot, id: "ur10e" });
  expect(after.objects).toBe(before.objects);
  expect(after.programs.map(program => program.robot)).toEqual(["ur10e"]);
  expect(theProgram()!.steps[0]).toMatchObject({ target: { q: [...robotById("ur10e")!.home_rad] } });
  expect(noticeStore.getState().notices.at(-1)?.sentence).toContain(
    `${theProgram()!.steps.filter(step => step.type === "move").length} points`,
  );
  expect(undo()).toContain("UR10e");
  expect(cellStore.getState().document).toEqual(before);
});

test("a robot that reaches less says how many points it cannot reach, and keeps them", () => {
  changeRobot("abb_irb120");
  const [notice] = noticeStore.getState().notices;
  expect(notice?.tone).toBe("warn");
  expect(notice?.sentence).toMatch(
    /^The IRB 120-3\/0\.6 is in the cell; \d+ of 18 points were kept, \d+ cannot be reached\.$/,
  );
  expect(theProgram()!.steps).toHaveLength(18);
});

test("the robot on screen has the joints of the robot in the cell, at its home, whatever came before; every cell can be saved and opened", () => {
  const stop = startFollowing();
  for (const robot of [...LIBRARY, ...LIBRARY.toReversed()]) {
    changeRobot(robot.id);
    expect(Array.from(theLive().q_rad)).toEqual([...robot.home_rad]);
    expect(theLive().worldFromTcp.position.every(Number.isFinite)).toBe(true);
    expect(openDocument(saveDocument(cellStore.getState().document!)).kind).toBe("opened");
  }
  stop();
});

test("the same robot or none changes nothing", () => {
  expect(changeRobot("staubli_rx90l")).toBe(false);
  expect(changeRobot("nobody")).toBe(false);
  expect(shortName(robotById("kuka_kr6r900sixx")!)).toBe("KR 6 R900 sixx");
});
