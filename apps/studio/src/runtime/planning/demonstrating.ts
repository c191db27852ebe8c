import {
  filterDemonstration,
  freshStepIds,
  pose,
  readDemonstration,
  stepsOfDemonstration,
  type FilterOptions,
  type Program,
  type Step,
} from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { closeDialog, openDialog } from "../../stores/dialogs.ts";
import { demonstrationStore, hideDemonstration, showDemonstration } from "../../stores/demonstration.ts";
import { notify } from "../../stores/notices.ts";
import { addSteps } from "../../stores/program.ts";
import { words } from "../../messages/index.ts";

/** A share of full joint speed, for the way to where the hand began. */
const APPROACH_RATIO = 0.3;

/** Opens a table of a recorded hand: it is filtered, laid over the cell, and steps are made of it when told to. */
export function openDemonstration(text: string, name: string): void {
  const answer = readDemonstration(text);
  if (answer.kind === "unreadable") {
    notify(
      "bad",
      words.demonstration.unreadable(name, answer.line, answer.sentence),
      words.demonstration.unreadableHint,
    );
    return;
  }
  showDemonstration(name, answer.demonstration, answer.dropped);
  refilter({});
  openDialog("demonstration");
}

/** Filters what is open again, with other numbers. */
export function refilter(changes: Partial<FilterOptions>): void {
  const { open } = demonstrationStore.getState();
  if (!open) return;
  const options = { ...open.options, ...changes };
  demonstrationStore.setState({
    open: { ...open, options, filtered: filterDemonstration(open.demonstration, options) },
  });
}

/** Adds the steps of the filtered demonstration to the program, as one group and one undo step. */
export function teachDemonstration(): void {
  const { open } = demonstrationStore.getState();
  const { document } = cellStore.getState();
  if (!open?.filtered || !document) return;
  const { demonstration, filtered, name } = open;
  const made = stepsOfDemonstration(demonstration, filtered, {
    frame: "world",
    worldFromFrame: pose(),
    tool: document.tool,
    approach: { ratio: APPROACH_RATIO },
    waitsFrom_s: Infinity,
  });
  let group = "";
  const added = addSteps(
    words.undo.demonstration,
    program => {
      group = freshGroup(program);
      const ids = freshStepIds(program, made.length, "d");
      return made.map((step, i): Step => ({ ...step, id: ids[i]!, group }));
    },
    program => ({ ...program, groups: { ...program.groups, [group]: { name: name.replace(/\.[a-z]+$/i, "") } } }),
  );
  if (!added) return;
  notify("done", words.demonstration.taught(made.length));
  closeDemonstration();
}

function freshGroup(program: Program): string {
  let n = 1;
  while (Object.hasOwn(program.groups, `demonstration-${n}`)) n++;
  return `demonstration-${n}`;
}

/** Takes the overlay and the dialog away; what was taught stays. */
export function closeDemonstration(): void {
  hideDemonstration();
  closeDialog();
}
