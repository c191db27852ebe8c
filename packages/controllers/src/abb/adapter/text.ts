import type { CommandOutcome, EmittedFile, UploadedProgram, Refusal, Robot, Scheduler } from "@twincell/core";
import { latin1Bytes, pathText } from "../../http/index.ts";
import { EGM_FILE, EGM_MODULE, TASK } from "../codec/index.ts";
import type { RwsClient, RwsReply } from "./rws-client.ts";
import type { PanelState } from "./rws-state.ts";
import { noModule, refusedThere, wasStopped } from "./words.ts";
import { DONE, stopped } from "../../outcomes.ts";

/**
 * A text from its being handed over to its end. A stop counts from the beginning, and ends it also before it was
 * started.
 */
export interface TextRun {
  readonly handed: Promise<UploadedProgram>;
  stop(): void;
}

const FOLDER = "$HOME";
const LOOK_S = 0.05;
const STOPS_S = 5;
const MODULE = /^\s*MODULE\s+([A-Za-z][A-Za-z0-9_]*)/im;
const execution = (action: string): string => `/rw/rapid/execution?action=${action}`;
const tasks = (action: string): string => `/rw/rapid/tasks/${TASK}?action=${action}`;
const START = {
  regain: "continue",
  execmode: "continue",
  condition: "none",
  stopatbp: "disabled",
  alltaskbytsp: "true",
} as const;
export const startProgram = (client: RwsClient, cycle: "once" | "forever"): Promise<RwsReply> =>
  client.post(execution("start"), { ...START, cycle });
/** @param quick  as fast as the motors can, also where a motion of the program is under way. */
export const stopProgram = (client: RwsClient, quick = false): Promise<RwsReply> =>
  client.post(execution("stop"), { stopmode: quick ? "qstop" : "stop" });
export const pointToMain = (client: RwsClient): Promise<RwsReply> => client.post(execution("resetpp"));

const wrong = (what: string, reply: RwsReply): Refusal | null =>
  reply.kind === "answer" ? null : refusedThere(what, reply.sentence);

/**
 * The program that waits for targets has its place again; whether it is started is for who calls. Why not, or null:
 * another program is never taken for it.
 */
export async function putBack(client: RwsClient, left: Set<string>): Promise<Refusal | null> {
  const modules = await client.get(`/rw/rapid/modules?task=${TASK}`);
  const names = modules.kind === "answer" ? modules.states.map(({ fields, title }) => fields["name"] ?? title) : null;
  if (!names) return wrong("Reading which modules are loaded", modules);
  for (const module of [...left]) {
    const gone = names.includes(module) ? await client.post(tasks("unloadmod"), { module }) : null;
    const why = gone && wrong(`Unloading ${module}`, gone);
    if (why) return why;
    left.delete(module);
  }
  const why = names.includes(EGM_MODULE)
    ? null
    : (wrong(
        `Loading ${EGM_FILE}`,
        await client.post(tasks("loadmod"), { modulepath: `${FOLDER}/${EGM_FILE}`, replace: "true" }),
      ) ?? wrong("Setting the program pointer to PROC main", await pointToMain(client)));
  await client.post("/rw/mastership/rapid?action=release");
  return why;
}

/**
 * Puts modules on the controller and loads them in the place of the program that waits for targets; started, they run
 * once from PROC main to their end. That program has its place again then. Mastership of RAPID is held all the time.
 *
 * @param left  modules of texts that are on the controller, kept by who calls: what could not be taken away now is
 *   taken away later.
 * @param isMoving  by the last state: what comes next begins when the robot has come to rest.
 * @param over  called when it has its place again; `well` unless the controller itself stopped the text, which a person
 *   looks at first.
 */
export function handRapid(
  files: readonly EmittedFile[],
  client: RwsClient,
  state: PanelState,
  scheduler: Scheduler,
  robot: Robot,
  left: Set<string>,
  isMoving: () => boolean,
  over: (well: boolean) => Promise<void>,
): TextRun {
  return rapidRunOf(new RapidRun(files, client, state, scheduler, robot, left, isMoving, over));
}

class RapidRun {
  readonly files: readonly EmittedFile[];
  readonly client: RwsClient;
  readonly state: PanelState;
  readonly scheduler: Scheduler;
  readonly robot: Robot;
  readonly left: Set<string>;
  readonly isMoving: () => boolean;
  readonly over: (well: boolean) => Promise<void>;
  wanted = true;
  readonly modules: { module: string; name: string; text: string; lines: readonly string[] }[];

  constructor(
    files: readonly EmittedFile[],
    client: RwsClient,
    state: PanelState,
    scheduler: Scheduler,
    robot: Robot,
    left: Set<string>,
    isMoving: () => boolean,
    over: (well: boolean) => Promise<void>,
  ) {
    this.files = files;
    this.client = client;
    this.state = state;
    this.scheduler = scheduler;
    this.robot = robot;
    this.left = left;
    this.isMoving = isMoving;
    this.over = over;
    this.modules = this.files
      .filter(({ name }) => /\.(mod|sys)$/i.test(name))
      .map(file => ({ ...file, module: MODULE.exec(file.text)?.[1] ?? "" }));
  }

  pause(): Promise<void> {
    return new Promise(resolve => {
      const stop = this.scheduler.every(LOOK_S, () => {
        stop();
        resolve();
      });
    });
  }

  /** The state of the execution, asked for now. */
  async isRunning(): Promise<boolean | null> {
    const reply = await this.client.get("/rw/rapid/execution");
    return reply.kind === "answer" && this.state.takePanel("ctrlexecstate", reply.states) ? this.state.isRunning : null;
  }

  async stands(): Promise<boolean> {
    for (const from_s = this.scheduler.now_s(); this.scheduler.now_s() - from_s < STOPS_S; await this.pause()) {
      const running = await this.isRunning();
      if (running === null) return false;
      if (!running && !this.isMoving()) return true;
    }
    return false;
  }

  async load(): Promise<Refusal | null> {
    for (const { name, text } of this.modules) {
      const why = wrong(
        `Writing ${name}`,
        await this.client.put(pathText(["fileservice", FOLDER, name]), latin1Bytes(text)),
      );
      if (why) return why;
    }
    for (const { module } of this.modules) if (module !== "") this.left.add(module);
    // Where it is not loaded there is nothing in the way.
    await this.client.post(tasks("unloadmod"), { module: EGM_MODULE });
    for (const { name } of this.modules) {
      const why = wrong(
        `Loading ${name}`,
        await this.client.post(tasks("loadmod"), { modulepath: `${FOLDER}/${name}`, replace: "true" }),
      );
      if (why) return why;
    }
    return wrong("Setting the program pointer to PROC main", await pointToMain(this.client));
  }

  /** Runs to the end, whoever ends it. */
  async carriedOut(): Promise<CommandOutcome> {
    if (!this.wanted) return stopped(wasStopped(this.robot));
    const why = wrong("Starting the program", await startProgram(this.client, "once"));
    if (why) return { kind: "refused", why };
    for (;;) {
      await this.pause();
      const running = await this.isRunning();
      if (running === null) return stopped(refusedThere("The program", "the controller does not say whether it runs."));
      if (!running) break;
    }
    const task = await this.client.get("/rw/rapid/tasks");
    const own =
      task.kind === "answer" ? task.states.find(({ fields, title }) => (fields["name"] ?? title) === TASK) : undefined;
    // At its beginning again: it ended by itself.
    if (this.wanted && own?.fields["excstate"]?.startsWith("read")) return DONE;
    if (!this.wanted) return stopped(wasStopped(this.robot));
    const log = await this.client.get("/rw/elog/0?lang=en");
    const last = log.kind === "answer" ? log.states[0]?.fields : undefined;
    return stopped(
      refusedThere(
        "The program stopped",
        last ? `${last["title"] ?? ""}: ${last["desc"] ?? ""}` : "the controller does not say why.",
      ),
    );
  }

  async giveBack(well: boolean): Promise<void> {
    await this.stands();
    await putBack(this.client, this.left);
    await this.over(well);
  }

  async handed(): Promise<UploadedProgram> {
    if (this.modules.length === 0) return { kind: "refused", why: noModule() };
    const mine = wrong("Mastership of RAPID", await this.client.post("/rw/mastership/rapid?action=request"));
    if (mine) return { kind: "refused", why: mine };
    const why =
      wrong("Stopping the program that runs", await stopProgram(this.client)) ??
      ((await this.stands())
        ? await this.load()
        : refusedThere("Stopping the program that runs", "it goes on running."));
    if (why) {
      await this.giveBack(true);
      return { kind: "refused", why };
    }
    return {
      kind: "handed",
      drop: () => {
        void this.giveBack(true);
      },
      start: async () => {
        const outcome = await this.carriedOut();
        await this.giveBack(outcome.kind === "done" || !this.wanted);
        return outcome;
      },
    };
  }
}

function rapidRunOf(run: RapidRun): TextRun {
  return {
    handed: run.handed(),
    stop() {
      run.wanted = false;
      void stopProgram(run.client, true);
    },
  };
}
