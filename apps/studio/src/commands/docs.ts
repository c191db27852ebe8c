import { notify } from "../stores/notices.ts";
import { viewStore, type StudioMode } from "../stores/view.ts";
import { words } from "../messages/index.ts";

/** The page that speaks of what a mode shows. */
export const PAGE_OF: Readonly<Record<StudioMode, string>> = {
  cell: "robot-files.html",
  teach: "tour.html",
  check: "tour.html",
  run: "controllers/",
  history: "recording/",
};

/** Opens the documentation beside the studio, at the page of the mode; says so where there is none. */
export async function openDocs(): Promise<void> {
  const page = new URL(`docs/${PAGE_OF[viewStore.getState().mode]}`, document.baseURI).href;
  const found = await fetch(page, { method: "HEAD" }).then(
    answer => answer.ok,
    () => false,
  );
  if (found) window.open(page, "_blank", "noopener");
  else notify("info", words.commands.docsMissing, words.commands.docsHint);
}
