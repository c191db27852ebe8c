import { cellStore } from "../stores/cell.ts";
import { programOf } from "../stores/document.ts";
import { theLanguage } from "../stores/languages.ts";
import { postStore } from "../stores/post.ts";
import type { FromPoster, ToPoster } from "../workers/post-messages.ts";

let worker: Worker | null = null, id = 0;

function hired(): Worker {
  if (worker) return worker;
  worker = new Worker(new URL("../workers/post.worker.ts", import.meta.url), { type: "module" });
  worker.addEventListener("message", ({ data }: MessageEvent<FromPoster>) => {
    if (data.id !== id) return;
    if (data.kind === "posted") postStore.setState({ working: false, emitted: data.emitted, proof: data.proof, trouble: null });
    else postStore.setState({ working: false, emitted: null, proof: null, trouble: data.sentence });
  });
  worker.addEventListener("error", event => { postStore.setState({ working: false, trouble: event.message || "The text could not be written." }); });
  return worker;
}

/** Writes the present program in the chosen language, away from the page; the answer comes through the store. */
export function postProgram(): void {
  const { document } = cellStore.getState(), program = programOf(document), dialect = theLanguage();
  if (!document || !program || !dialect || program.steps.length === 0) { id++; postStore.setState({ working: false, emitted: null, proof: null, trouble: null }); return; }
  const message: ToPoster = { id: ++id, dialect: dialect.id, program, robot: document.robot.id, worldFromBase: document.robot.worldFromBase };
  postStore.setState({ working: true });
  hired().postMessage(message);
}
