import type { CommandOutcome, EmittedFile, Robot, Scheduler } from "@twincell/core";
import { latin1Bytes, pathText } from "../../http/index.ts";
import { EGM_FILE, EGM_MODULE, TASK } from "../codec/index.ts";
import type { RwsClient, RwsReply } from "./rws-client.ts";
import type { PanelState } from "./rws-state.ts";
import { noModule, refusedThere, wasStopped } from "./words.ts";
import { DONE, refused, stopped } from "../../outcomes.ts";

export interface RunningText { readonly outcome: Promise<CommandOutcome>; stop(): void }

const FOLDER = "$HOME", LOOK_S = 0.05, STOPS_S = 5, MODULE = /^\s*MODULE\s+([A-Za-z][A-Za-z0-9_]*)/im;
const execution = (action: string): string => `/rw/rapid/execution?action=${action}`, tasks = (action: string): string => `/rw/rapid/tasks/${TASK}?action=${action}`;
const START = { regain: "continue", execmode: "continue", condition: "none", stopatbp: "disabled", alltaskbytsp: "true" } as const;
export const startProgram = (client: RwsClient, cycle: "once" | "forever"): Promise<RwsReply> => client.post(execution("start"), { ...START, cycle });
export const stopProgram = (client: RwsClient): Promise<RwsReply> => client.post(execution("stop"), { stopmode: "stop" });
export const pointToMain = (client: RwsClient): Promise<RwsReply> => client.post(execution("resetpp"));

const wrong = (what: string, reply: RwsReply): CommandOutcome | null => reply.kind === "answer" ? null : refused(refusedThere(what, reply.sentence));

/**
 * Puts modules on the controller, loads them in the place of the program that waits for targets, runs them once from PROC
 * main to their end, and gives that program its place again. Mastership of RAPID is held all the time.
 */
export function runRapid(files: readonly EmittedFile[], client: RwsClient, state: PanelState, scheduler: Scheduler, robot: Robot): RunningText {
  let wanted = true;
  const modules = files.filter(({ name }) => /\.(mod|sys)$/i.test(name)).map(file => ({ ...file, module: MODULE.exec(file.text)?.[1] ?? "" }));
  const pause = (): Promise<void> => new Promise(resolve => { const stop = scheduler.every(LOOK_S, () => { stop(); resolve(); }); });
  /** The state of the execution, asked for now. */
  const isRunning = async (): Promise<boolean | null> => {
    const reply = await client.get("/rw/rapid/execution");
    return reply.kind === "answer" && state.takePanel("ctrlexecstate", reply.states) ? state.isRunning : null;
  };
  async function stands(): Promise<boolean> {
    for (const from_s = scheduler.now_s(); scheduler.now_s() - from_s < STOPS_S; await pause()) {
      const running = await isRunning();
      if (running !== true) return running === false;
    }
    return false;
  }

  async function load(): Promise<CommandOutcome | null> {
    for (const { name, text } of modules) {
      const why = wrong(`Writing ${name}`, await client.put(pathText(["fileservice", FOLDER, name]), latin1Bytes(text)));
      if (why) return why;
    }
    // Where it is not loaded there is nothing in the way.
    await client.post(tasks("unloadmod"), { module: EGM_MODULE });
    for (const { name } of modules) {
      const why = wrong(`Loading ${name}`, await client.post(tasks("loadmod"), { modulepath: `${FOLDER}/${name}`, replace: "true" }));
      if (why) return why;
    }
    return wrong("Setting the program pointer to PROC main", await pointToMain(client));
  }
  /** Runs to the end, whoever ends it. */
  async function carriedOut(): Promise<CommandOutcome> {
    if (!wanted) return stopped(wasStopped(robot));
    const why = wrong("Starting the program", await startProgram(client, "once"));
    if (why) return why;
    for (;;) {
      await pause();
      const running = await isRunning();
      if (running === null) return stopped(refusedThere("The program", "the controller does not say whether it runs."));
      if (!running) break;
    }
    const task = await client.get("/rw/rapid/tasks"), own = task.kind === "answer" ? task.states.find(({ fields, title }) => (fields["name"] ?? title) === TASK) : undefined;
    // At its beginning again: it ended by itself.
    if (wanted && own?.fields["excstate"]?.startsWith("read")) return DONE;
    if (!wanted) return stopped(wasStopped(robot));
    const log = await client.get("/rw/elog/0?lang=en"), last = log.kind === "answer" ? log.states[0]?.fields : undefined;
    return stopped(refusedThere("The program stopped", last ? `${last["title"] ?? ""}: ${last["desc"] ?? ""}` : "the controller does not say why."));
  }
  /** Our own program has its place again; whether it is started is for who calls. */
  async function putBack(): Promise<void> {
    for (const { module } of modules) if (module !== "") await client.post(tasks("unloadmod"), { module });
    await client.post(tasks("loadmod"), { modulepath: `${FOLDER}/${EGM_FILE}`, replace: "true" });
    await pointToMain(client);
  }

  async function outcome(): Promise<CommandOutcome> {
    if (modules.length === 0) return refused(noModule());
    const mine = wrong("Mastership of RAPID", await client.post("/rw/mastership/rapid?action=request"));
    if (mine) return mine;
    const halted = wrong("Stopping the program that runs", await stopProgram(client));
    let ended = halted ?? (await stands() ? await load() : refused(refusedThere("Stopping the program that runs", "it goes on running.")));
    if (!ended) {
      ended = await carriedOut();
      await stands();
    }
    await putBack();
    await client.post("/rw/mastership/rapid?action=release");
    return ended;
  }
  return {
    outcome: outcome(),
    stop() {
      wanted = false;
      void stopProgram(client);
    },
  };
}
