import { checkProgram, robotById, type Step } from "@twincell/core";
import { emptyCell } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { cellStore } from "./cell.ts";
import { commit, showDocument, theProgram, withProgram } from "./document.ts";
import {
  handIn,
  helpOf,
  judgedNow,
  leaveLesson,
  lessonStore,
  lessonText,
  makeLesson,
  openLesson,
  reportText,
} from "./lesson.ts";
import { noticeStore } from "./notices.ts";
import { playStore } from "./play.ts";

const robot = robotById("staubli_rx90l")!;
const move = (id: string, q: readonly number[]): Step => ({
  id,
  type: "move",
  path: "ptp",
  target: { q },
  speed: { ratio: 0.5 },
  blend_m: 0,
});
const TASK = [move("a", [0.4, -1, 1.7, 0, 0.87, 0]), move("b", [-0.4, -1, 1.7, 0, 0.87, 0])];
/** The steps in the program being worked on, and what the check says of them. */
function teach(steps: readonly Step[]): void {
  commit("steps", document => withProgram(document, program => ({ ...program, steps })));
  const { plan, verdict } = checkProgram(theProgram()!, robot);
  playStore.setState({ plan, verdict, stale: false });
}
beforeEach(() => {
  showDocument(emptyCell());
  leaveLesson();
  playStore.setState({ plan: null, verdict: null, stale: false });
});

test("L-64 T-70 a lesson is made of a program, taught beside it, and help fades with each attempt; an expert has none", () => {
  teach(TASK);
  const made = theProgram()!.name;
  expect(makeLesson()).toBe(true);
  expect(theProgram()!.steps).toEqual([]);
  expect(cellStore.getState().document!.programs.map(({ name }) => name)).toContain(made);
  expect(helpOf(lessonStore.getState())).toBe("hints");
  playStore.setState({ plan: null, verdict: null });
  expect(handIn()).toBe(false);
  teach([TASK[0]!]);
  expect(judgedNow(lessonStore.getState().lesson!)!.met).toEqual([true, false]);
  expect(handIn()).toBe(true);
  expect(helpOf(lessonStore.getState())).toBe("goals");
  teach(TASK);
  handIn();
  expect(helpOf(lessonStore.getState())).toBe("next");
  lessonStore.setState({ guided: false });
  expect(helpOf(lessonStore.getState())).toBe("none");
});

test("M-61 M-62 three attempts count, the best is named in the report with its numbers, and a fourth is not taken", () => {
  teach(TASK);
  makeLesson();
  for (const steps of [[TASK[0]!], TASK, [...TASK, { id: "w", type: "wait", s: 60 } as const]]) {
    teach(steps);
    expect(handIn()).toBe(true);
  }
  expect(handIn()).toBe(false);
  const state = lessonStore.getState();
  expect(state.attempts.map(({ passed }) => passed)).toEqual([false, true, false]);
  const report = reportText(state, "2026-11-27");
  expect(report).toContain("Attempt 2 is the best.");
  expect(report).toMatch(/\| 2 \* \| 100 \| passed \| 2\/2 \| 0\.0 \| 0 \|/);
  expect(report).toMatch(/\| 1 \| \d+ \| not passed \| 1\/2 .*A place is missed\./);
  expect(report).toMatch(/more than twice the time/);
});

test("a lesson that was saved is opened again; of another robot, or none at all, is said and changes nothing", () => {
  teach(TASK);
  makeLesson();
  const text = lessonText();
  leaveLesson();
  const before = cellStore.getState().document;
  expect(openLesson("{}", "notes.json")).toBe(false);
  expect(openLesson(text.replace("staubli_rx90l", "ur10e"), "ur.lesson.json")).toBe(false);
  expect(
    noticeStore
      .getState()
      .notices.map(({ sentence }) => sentence)
      .join(" "),
  ).toMatch(/ur10e/);
  expect(cellStore.getState().document).toBe(before);
  expect(openLesson(text, "task.lesson.json")).toBe(true);
  expect(lessonStore.getState().lesson!.goals).toHaveLength(2);
});

test("a program that is not checked, cannot be carried out or moves nowhere makes no lesson, and is told so", () => {
  teach(TASK);
  playStore.setState({ stale: true });
  expect(makeLesson()).toBe(false);
  teach([{ id: "w", type: "wait", s: 1 }]);
  expect(makeLesson()).toBe(false);
  teach([move("a", [9, 0, 0, 0, 0, 0])]);
  expect(makeLesson()).toBe(false);
  expect(lessonStore.getState().lesson).toBeNull();
});
