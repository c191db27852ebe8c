import { withRobots } from "../hire.ts";
import type { Program } from "@twincell/core";
import type { CellDocument } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { programOf } from "../../stores/document.ts";
import { theLanguage } from "../../stores/languages.ts";
import { postStore, type PostState } from "../../stores/post.ts";
import type { FromPoster, ToPoster } from "../../workers/post-messages.ts";
import type { Written } from "../run/written-program.ts";

type Answered = (answer: FromPoster) => void;
const asked = new Map<number, Answered>();
let worker: Worker | null = null;
let count = 0;
let shown = 0;

function hired(): Worker {
  if (worker) return worker;
  worker = withRobots(new Worker(new URL("../../workers/post.worker.ts", import.meta.url), { type: "module" }));
  worker.addEventListener("message", ({ data }: MessageEvent<FromPoster>) => {
    asked.get(data.id)?.(data);
  });
  worker.addEventListener("error", event => {
    for (const [id, answered] of asked)
      answered({ kind: "trouble", id, sentence: event.message || "The text could not be written." });
  });
  return worker;
}

function ask(
  program: Program,
  document: CellDocument,
  form: string | null,
  prove: boolean,
  answered: Answered,
): number {
  const id = ++count;
  const message: ToPoster = {
    id,
    dialect: theLanguage()?.id ?? null,
    form,
    program,
    robot: document.robot.id,
    worldFromBase: document.robot.worldFromBase,
    prove,
  };
  asked.set(id, answer => {
    if (answer.kind !== "written" || !prove) asked.delete(id);
    answered(answer);
  });
  hired().postMessage(message);
  return id;
}

/** The program as it is to be run, written away from the page. Rejects with what kept it from being written. */
export function writtenProgram(program: Program, document: CellDocument): Promise<Written> {
  return new Promise((resolve, reject) => {
    ask(program, document, null, false, answer => {
      if (answer.kind === "written") resolve(answer.written);
      else if (answer.kind === "trouble") reject(new Error(answer.sentence));
    });
  });
}

const NOTHING: PostState = { working: false, emitted: null, proof: null, trouble: null };

/**
 * Shows the present program in the chosen language, written and where wanted proven away from the page; the answer
 * comes through the store.
 *
 * @param form  another text that its controller takes; null for a program of the language.
 */
export function postProgram(prove: boolean, form: string | null = null): void {
  const { document } = cellStore.getState();
  const program = programOf(document);
  if (!document || !program || !theLanguage() || program.steps.length === 0) {
    shown = 0;
    postStore.setState(NOTHING);
    return;
  }
  postStore.setState({ working: true });
  const id = (shown = ask(program, document, form, prove, answer => {
    if (id !== shown) return;
    if (answer.kind === "written")
      postStore.setState({ working: prove, emitted: answer.written.emitted, proof: null, trouble: null });
    else if (answer.kind === "proven") postStore.setState({ working: false, proof: answer.proof });
    else postStore.setState({ ...NOTHING, trouble: answer.sentence });
  }));
}
