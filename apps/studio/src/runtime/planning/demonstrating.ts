import {
  FILTER_DEFAULTS,
  freshGroupIds,
  freshStepIds,
  pose,
  stepsOfDemonstration,
  type FilterOptions,
  type Step,
} from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { closeDialog, dialogStore, openDialog } from "../../stores/dialogs.ts";
import { demonstrationStore, hideDemonstration, showDemonstration } from "../../stores/demonstration.ts";
import { notify } from "../../stores/notices.ts";
import { addSteps } from "../../stores/program.ts";
import { words } from "../../messages/index.ts";
import type { FromDemonstrator, ToDemonstrator } from "../../workers/demonstration-messages.ts";

/** A share of full joint speed, for the way to where the hand began. */
const APPROACH_RATIO = 0.3;

let worker: Worker | null = null;
let asked = 0;

/** A worker that reads and filters away from the page; what it says of a question that is over is not heard. */
function hired(name: string): Worker {
  const fresh = new Worker(new URL("../../workers/demonstration.worker.ts", import.meta.url), { type: "module" });
  const failed = (sentence: string): void => {
    notify("bad", words.demonstration.notFiltered(name, sentence || words.demonstration.workerEnded));
    closeDemonstration();
  };
  fresh.addEventListener("message", ({ data }: MessageEvent<FromDemonstrator>) => {
    if (data.id !== asked) return;
    const { open } = demonstrationStore.getState();
    switch (data.kind) {
      case "read":
        showDemonstration(name, data.demonstration, data.dropped);
        openDialog("demonstration");
        return;
      case "unreadable":
        notify(
          "bad",
          words.demonstration.unreadable(name, data.why.line, data.why.sentence),
          words.demonstration.unreadableHint,
        );
        closeDemonstration();
        return;
      case "filtered":
        if (open) demonstrationStore.setState({ open: { ...open, working: false, filtered: data.filtered } });
        return;
      case "trouble":
        failed(data.sentence);
    }
  });
  fresh.addEventListener("error", event => {
    failed(event.message);
  });
  return fresh;
}

function ask(text: string | null, options: FilterOptions): void {
  worker?.postMessage({ id: ++asked, text, options } satisfies ToDemonstrator);
}

/** Opens a table of a recorded hand: it is filtered, laid over the cell, and steps are made of it when told to. */
export function openDemonstration(text: string, name: string): void {
  worker?.terminate();
  worker = hired(name);
  ask(text, FILTER_DEFAULTS);
}

/** Filters what is open again, with other numbers; what was made of it before is shown until then. */
export function refilter(changes: Partial<FilterOptions>): void {
  const { open } = demonstrationStore.getState();
  if (!open) return;
  const options = { ...open.options, ...changes };
  demonstrationStore.setState({ open: { ...open, options, working: true } });
  ask(null, options);
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
      group = freshGroupIds(program, 1, "demonstration-")[0]!;
      const ids = freshStepIds(program, made.length, "d");
      return made.map((step, i): Step => ({ ...step, id: ids[i]!, group }));
    },
    program => ({ ...program, groups: { ...program.groups, [group]: { name: name.replace(/\.[a-z]+$/i, "") } } }),
  );
  if (!added) return;
  notify("done", words.demonstration.taught(made.length));
  closeDemonstration();
}

/** Takes the overlay and the dialog away; what was taught stays. */
export function closeDemonstration(): void {
  worker?.terminate();
  worker = null;
  hideDemonstration();
  if (dialogStore.getState().open === "demonstration") closeDialog();
}
