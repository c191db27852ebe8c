import {
  bestResult,
  emptyProgram,
  judgeLesson,
  lessonOf,
  readLesson,
  type Lesson,
  type LessonResult,
  type Verdict,
} from "@twincell/core";
import { addProgram } from "@twincell/project";
import { createStore } from "zustand/vanilla";
import { words } from "../messages/index.ts";
import { fixed } from "../messages/numbers.ts";
import { cellStore } from "./cell.ts";
import { commit, theProgram, theRobot } from "./document.ts";
import { notify } from "./notices.ts";
import { playStore } from "./play.ts";
import { select } from "./selection.ts";

/** A lesson under way. What the learner teaches is a program of the cell like any other. */
export interface LessonState {
  readonly lesson: Lesson | null;
  readonly attempts: readonly LessonResult[];
  /** Guided: goals and hints are shown, fewer with each attempt. Otherwise the learner is left alone (row L-64). */
  readonly guided: boolean;
}
export const MOST_ATTEMPTS = 3;
export const lessonStore = createStore<LessonState>(() => ({ lesson: null, attempts: [], guided: true }));

/** What is shown of the goals: all with a hint, all, the next one only, or none. */
export type Help = "hints" | "goals" | "next" | "none";
export const helpOf = ({ attempts, guided }: LessonState): Help =>
  guided ? (["hints", "goals", "next"] as const)[Math.min(attempts.length, MOST_ATTEMPTS - 1)]! : "none";

function begin(lesson: Lesson): void {
  const robot = theRobot();
  if (!robot) return;
  commit(words.lesson.undo(lesson.name), document =>
    addProgram(document, emptyProgram(robot.id, words.lesson.programName(lesson.name))),
  );
  select(null);
  lessonStore.setState({ lesson, attempts: [], guided: true });
}
/** Makes a lesson of the program being worked on, and begins it with an empty program beside it. */
export function makeLesson(): boolean {
  const program = theProgram();
  const robot = theRobot();
  const { document } = cellStore.getState();
  const { plan, verdict, stale } = playStore.getState();
  if (!program || !robot || !document) return false;
  if (stale || !plan || !verdict?.ok) {
    notify("warn", stale ? words.lesson.stillChecked : words.lesson.notOk, stale ? undefined : words.lesson.notOkHint);
    return false;
  }
  const lesson = lessonOf(program, robot, document.robot.worldFromBase, plan);
  if (lesson === undefined) {
    notify("warn", words.lesson.noGoals);
    return false;
  }
  begin(lesson);
  return true;
}
/** Opens a lesson that was saved. False when it is none, or of another robot; says so. */
export function openLesson(text: string, file: string): boolean {
  const lesson = readLesson(text);
  if (typeof lesson === "string") notify("bad", words.lesson.unreadable(file), lesson);
  else if (lesson.robot !== theRobot()?.id) notify("bad", words.lesson.otherRobot(file, lesson.robot));
  else {
    begin(lesson);
    return true;
  }
  return false;
}
export const lessonText = (): string => `${JSON.stringify(lessonStore.getState().lesson, undefined, 1)}\n`;
export const leaveLesson = (): void => lessonStore.setState({ lesson: null, attempts: [] });

/** How the program stands against the lesson; null while there is no plan. */
export function judgedNow(lesson: Lesson): LessonResult | null {
  const program = theProgram();
  const robot = theRobot();
  const { document } = cellStore.getState();
  const { plan, verdict } = playStore.getState();
  if (!program || !robot || !document || !plan) return null;
  const steps: Pick<Verdict, "steps"> = { steps: verdict?.steps ?? [] };
  return judgeLesson(lesson, program, robot, document.robot.worldFromBase, plan, steps);
}
/** The program as it is counts as an attempt. At most three do. */
export function handIn(): boolean {
  const { lesson, attempts } = lessonStore.getState();
  if (!lesson || attempts.length >= MOST_ATTEMPTS) return false;
  const { stale, plan } = playStore.getState();
  if (stale || !plan) {
    notify("warn", stale ? words.lesson.stillChecked : words.lesson.nothing);
    return false;
  }
  const result = judgedNow(lesson);
  if (result === null) return false;
  lessonStore.setState({ attempts: [...attempts, result] });
  return true;
}

/** What is shown to whoever wants to see it: each attempt with its numbers, and the best. */
export function reportText({ lesson, attempts }: LessonState, when: string): string {
  if (!lesson) return "";
  const best = bestResult(attempts);
  const rows = attempts.map(
    (each, i) =>
      `| ${i + 1}${i === best ? " *" : ""} | ${fixed(each.score, 0)} | ${each.passed ? words.lesson.passed : words.lesson.failed} | ` +
      `${each.met.filter(Boolean).length}/${each.met.length} | ${fixed(meanOf(each) * 1000, 1)} | ${each.bad} | ` +
      `${fixed(each.duration_s, 1)} | ${fixed(each.length_m, 2)} | ${each.lacks.map(lack => words.lesson.lacks[lack]).join(" ")} |`,
  );
  const { duration_s, length_m } = lesson.expert;
  return [
    `# ${words.lesson.reportTitle(lesson.name)}`,
    "",
    `${when} · ${lesson.robot} · ${words.lesson.expert(fixed(duration_s, 1), fixed(length_m, 2))}`,
    "",
    `| ${words.lesson.columns.join(" | ")} |`,
    `|${words.lesson.columns.map(() => "---").join("|")}|`,
    ...rows,
    "",
    best < 0 ? words.lesson.noAttempt : words.lesson.best(best + 1),
    "",
  ].join("\n");
}
/** Mean distance from the goals [m]; of those that the tool came near to at all. */
export const meanOf = ({ distances_m }: LessonResult): number => {
  const near = distances_m.filter(Number.isFinite);
  return near.length === 0 ? 0 : near.reduce((sum, off) => sum + off, 0) / near.length;
};
