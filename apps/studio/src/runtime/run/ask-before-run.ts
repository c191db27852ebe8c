import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { closeDialog, dialogStore, openDialog } from "../../stores/dialogs.ts";
import { programOf, textOf } from "../../stores/document.ts";
import { playStore } from "../../stores/play.ts";
import { stationLive } from "../robot/stations.ts";
import { runQuestionStore } from "../../stores/run-question.ts";
import { stationOf } from "../../stores/stations.ts";
import { onStop } from "../../stores/stop.ts";
import { textStore } from "../../stores/text.ts";
import type { TextFinding } from "../../workers/text-messages.ts";

/**
 * Begins a run when the check of what the cell holds now is content with it; otherwise asks first. A check that is
 * under way is waited for, since the verdict of what was there before says nothing of what is there now. A program
 * without steps has nothing to be checked.
 *
 * @param proceed  is given the codes of the red findings that the person has seen and goes on in spite of.
 * @param ids      connected robots that it would move.
 */
export function askBeforeRun(proceed: (despite: readonly string[]) => void, ids: readonly string[] = []): void {
  const { stale, checking, verdict, trouble } = playStore.getState();
  const program = programOf(cellStore.getState().document);
  const isGreen = !stale && verdict?.ok === true;
  const { assumed } = linesAssumed();
  if (program?.steps.length === 0 || (isGreen && assumed.length === 0)) {
    proceed([]);
    return;
  }
  const kind = stale ? "checking" : isGreen ? "assumed" : verdict ? "red" : "unchecked";
  runQuestionStore.setState({ question: { kind, sentence: trouble ?? "", ids, real: realAmong(ids), proceed } });
  openDialog("run-question");
  // One that was cancelled begins anew.
  if (stale && checking === null) runCommand("check.now");
}

/**
 * The same before a program goes to connected controllers. The check speaks of the cell's robot: a controller of
 * another model gets a program that was taught anew for it, which its own connection checks before it is sent.
 */
export function askBeforeSending(ids: readonly string[], proceed: (despite: readonly string[]) => void): void {
  const robot = cellStore.getState().document?.robot.id;
  if (ids.some(id => stationLive(id)?.robot.id === robot)) askBeforeRun(proceed, ids);
  else proceed([]);
}

/** Lines of the vendor's text in use of which the check knows only a part, and the files they stand in. */
export function linesAssumed(): { readonly assumed: readonly TextFinding[]; readonly files: readonly string[] } {
  const text = textOf(cellStore.getState().document);
  const { read } = textStore.getState();
  return text && read
    ? { assumed: read.assumed, files: text.files.map(({ name }) => name) }
    : { assumed: [], files: [] };
}

const realAmong = (ids: readonly string[]): string[] =>
  ids.flatMap(id => {
    const station = stationOf(id);
    return station && !station.virtual ? [station.name] : [];
  });

/** Codes of what makes the check red that is shown: who goes on all the same has seen these. */
export function seenFindings(): readonly string[] {
  const red = playStore.getState().verdict?.steps.filter(({ verdict }) => verdict === "bad") ?? [];
  return [...new Set(red.flatMap(({ findings }) => findings.map(({ code }) => code)))];
}

/** Takes the question away; the run does not begin. */
export function leaveRunQuestion(): void {
  if (runQuestionStore.getState().question) runQuestionStore.setState({ question: null });
  if (dialogStore.getState().open === "run-question") closeDialog();
}

/**
 * Goes on with a question that waits for the check as soon as that is done. STOP takes the question away, and so does
 * another dialog in its place: nothing begins to move that nobody is asked about any more.
 */
export function startRunQuestions(): () => void {
  const ends = [
    playStore.subscribe(({ stale }, before) => {
      const { question } = runQuestionStore.getState();
      if (stale || !before.stale || question?.kind !== "checking") return;
      leaveRunQuestion();
      askBeforeRun(question.proceed, question.ids);
    }),
    dialogStore.subscribe(({ open }) => {
      if (open !== "run-question") leaveRunQuestion();
    }),
    onStop(leaveRunQuestion),
  ];
  return () => {
    for (const end of ends) end();
  };
}
