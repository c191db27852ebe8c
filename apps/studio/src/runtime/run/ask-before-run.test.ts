import type { StepReport, Verdict } from "@twincell/core";
import { addProgram, edgeTraceCell, emptyCell, textFileOf, tracedCartonCell } from "@twincell/project";
import { afterEach, beforeEach, expect, test } from "vitest";
import { registerCommands } from "../../stores/commands.ts";
import { dialogStore, openDialog } from "../../stores/dialogs.ts";
import { showDocument } from "../../stores/document.ts";
import { playStore } from "../../stores/play.ts";
import { runQuestionStore } from "../../stores/run-question.ts";
import { stationStore, type StationState } from "../../stores/stations.ts";
import { stopEverything } from "../../stores/stop.ts";
import { textStore } from "../../stores/text.ts";
import type { ReadTextProgram } from "../../workers/text-messages.ts";
import { askBeforeRun, leaveRunQuestion, linesAssumed, seenFindings, startRunQuestions } from "./ask-before-run.ts";

const verdictOf = (ok: boolean): Verdict => ({
  ok,
  steps: [] as readonly StepReport[],
  duration_s: 1,
  clearance_m: null,
  torque: { kind: "unknown", sentence: "" } as unknown as Verdict["torque"],
  assumptions: [],
});
let begun = 0;
const begin = (): void => {
  begun++;
};
let end = (): void => undefined;
beforeEach(() => {
  begun = 0;
  showDocument(tracedCartonCell());
  end = startRunQuestions();
});
afterEach(() => {
  end();
  leaveRunQuestion();
});
const asked = (): string | undefined => runQuestionStore.getState().question?.kind;

test("a program whose check is content begins at once; a red one asks, and begins only when told to", () => {
  playStore.setState({ stale: false, checking: null, trouble: null, verdict: verdictOf(true) });
  askBeforeRun(begin);
  expect([begun, asked(), dialogStore.getState().open]).toEqual([1, undefined, null]);
  playStore.setState({ verdict: verdictOf(false) });
  askBeforeRun(begin);
  expect([begun, asked(), dialogStore.getState().open]).toEqual([1, "red", "run-question"]);
  leaveRunQuestion();
  expect([begun, dialogStore.getState().open]).toEqual([1, null]);
  askBeforeRun(begin);
  runQuestionStore.getState().question!.proceed([]);
  expect(begun).toBe(2);
});

test("a green check of a vendor's text with lines that only the controller knows asks; without such lines it begins", () => {
  playStore.setState({ stale: false, checking: null, trouble: null, verdict: verdictOf(true) });
  const bytes = new TextEncoder().encode("/PROG MAIN\n/MN\n1: CALL PICK ;\n/END\n");
  const opened = addProgram(emptyCell("fanuc_lrmate200id"), {
    format: "twincell.text-program",
    version: 1,
    robot: "fanuc_lrmate200id",
    name: "main",
    language: "fanuc-ls",
    main: "main.ls",
    files: [textFileOf("main.ls", bytes)],
  });
  showDocument(opened);
  const read = { points: { kind: "none" as const, sentence: "" }, program: null, places: [], findings: [] };
  const line = {
    file: 0,
    line: 3,
    verdict: "warn" as const,
    sentence: "What PICK does, motions too, is not executed.",
  };
  textStore.setState({ read: { ...read, assumed: [line] } as unknown as ReadTextProgram });
  askBeforeRun(begin);
  expect([begun, asked(), linesAssumed()]).toEqual([0, "assumed", { assumed: [line], files: ["main.ls"] }]);
  leaveRunQuestion();
  textStore.setState({ read: { ...read, assumed: [] } as unknown as ReadTextProgram });
  askBeforeRun(begin);
  expect([begun, asked()]).toEqual([1, undefined]);
});

test("who goes on in spite of a red check goes on in spite of what was shown, and of nothing when it is green", () => {
  const finding = (code: string) => ({ code }) as StepReport["findings"][number];
  const told: (readonly string[])[] = [];
  const proceed = (despite: readonly string[]): void => {
    told.push(despite);
  };
  playStore.setState({
    stale: false,
    checking: null,
    trouble: null,
    verdict: {
      ...verdictOf(false),
      steps: [
        { id: "a", verdict: "bad", findings: [finding("torque.joint")] },
        { id: "b", verdict: "warn", findings: [finding("singular.near")] },
        { id: "c", verdict: "bad", findings: [finding("torque.joint"), finding("collision.contact")] },
      ],
    },
  });
  askBeforeRun(proceed);
  expect(told).toEqual([]);
  runQuestionStore.getState().question!.proceed(seenFindings());
  leaveRunQuestion();
  playStore.setState({ verdict: verdictOf(true) });
  askBeforeRun(proceed);
  expect(told).toEqual([["torque.joint", "collision.contact"], []]);
});

test("a verdict of what was there before the last change does not count: the check is waited for, then it begins or asks", () => {
  playStore.setState({ stale: true, checking: 0.5, trouble: null, verdict: verdictOf(true) });
  askBeforeRun(begin);
  expect([begun, asked()]).toEqual([0, "checking"]);
  playStore.setState({ stale: false, checking: null, verdict: verdictOf(true) });
  expect([begun, asked()]).toEqual([1, undefined]);
  playStore.setState({ stale: true, checking: 0.5 });
  askBeforeRun(begin);
  playStore.setState({ stale: false, checking: null, verdict: verdictOf(false) });
  expect([begun, asked()]).toEqual([1, "red"]);
});

test("robots that are no virtual ones are named in the question, also after the check was waited for", () => {
  const station = (id: string, virtual: boolean): StationState => ({ id, name: `Cell ${id}`, virtual }) as StationState;
  stationStore.setState({ stations: [station("a", true), station("b", false)] });
  playStore.setState({ stale: true, checking: 0.5, trouble: null, verdict: null });
  askBeforeRun(begin, ["a", "b"]);
  playStore.setState({ stale: false, checking: null, verdict: verdictOf(false) });
  expect([asked(), runQuestionStore.getState().question?.real]).toEqual(["red", ["Cell b"]]);
  askBeforeRun(begin, ["a"]);
  expect(runQuestionStore.getState().question?.real).toEqual([]);
  stationStore.setState({ stations: [] });
});

test("STOP while the check is waited for takes the start away: a green check afterwards moves nothing", () => {
  playStore.setState({ stale: true, checking: 0.5, trouble: null, verdict: null });
  askBeforeRun(begin);
  expect(stopEverything()).toEqual([]);
  expect([asked(), dialogStore.getState().open]).toEqual([undefined, null]);
  playStore.setState({ stale: false, checking: null, verdict: verdictOf(true) });
  expect(begun).toBe(0);
});

test("another dialog in the place of the question takes the start away", () => {
  playStore.setState({ stale: true, checking: 0.5, trouble: null, verdict: null });
  askBeforeRun(begin);
  openDialog("palette");
  expect([asked(), dialogStore.getState().open]).toEqual([undefined, "palette"]);
  playStore.setState({ stale: false, checking: null, verdict: verdictOf(true) });
  expect(begun).toBe(0);
});

test("a check that was cancelled begins anew, and one that could not be done is no green light", () => {
  let checks = 0;
  const off = registerCommands([{ id: "check.now", group: "program", words: "Check now", run: () => checks++ }]);
  playStore.setState({ stale: true, checking: null, trouble: null, verdict: verdictOf(true) });
  askBeforeRun(begin);
  expect([checks, begun, asked()]).toEqual([1, 0, "checking"]);
  playStore.setState({ stale: false, trouble: "The check stopped.", verdict: null });
  expect([begun, asked(), runQuestionStore.getState().question?.sentence]).toEqual([
    0,
    "unchecked",
    "The check stopped.",
  ]);
  off();
});

test("a program without steps has nothing to be checked", () => {
  showDocument(edgeTraceCell());
  playStore.setState({ stale: false, checking: null, trouble: null, verdict: null });
  askBeforeRun(begin);
  expect(begun).toBe(1);
});
