import type { RunSession } from "../live/run-session.ts";
import { postProgram } from "../live/posting.ts";
import type { TravelBack } from "../live/travel-back.ts";
import type { Command } from "../stores/commands.ts";
import { controlStore } from "../stores/control.ts";
import { theProgram } from "../stores/document.ts";
import { historyStore } from "../stores/history.ts";
import { postStore } from "../stores/post.ts";
import { runStore } from "../stores/run.ts";
import { showMode } from "../stores/view.ts";
import { words } from "../words/index.ts";

const running = (): boolean => controlStore.getState().running;

export const runCommands = (session: RunSession, back: TravelBack): readonly Command[] => [
  {
    id: "run.start", group: "play", words: words.commands.startRun, keys: ["Mod+Shift+Enter"], can: () => !running() && (theProgram()?.steps.length ?? 0) > 0,
    run: () => { showMode("run"); back.close(); void started(session); },
  },
  { id: "run.hold", group: "play", words: words.run.hold, can: running, run: () => session.hold(!runStore.getState().held) },
  { id: "run.stop", group: "play", words: words.run.stop, can: running, run: () => session.stop() },
  { id: "run.reset", group: "play", words: words.control.reset, run: () => session.reset() },
  { id: "history.play", group: "play", words: words.history.play, can: () => historyStore.getState().open !== null, run: () => (historyStore.getState().playing ? back.pause() : back.play()) },
  { id: "history.close", group: "play", words: words.history.back, can: () => historyStore.getState().open !== null, run: () => back.close() },
];

/** The text that runs is the one of the program as it is now. */
async function started(session: RunSession): Promise<void> {
  postProgram();
  await new Promise<void>(resolve => {
    if (!postStore.getState().working) { resolve(); return; }
    const stop = postStore.subscribe(state => { if (!state.working) { stop(); resolve(); } });
  });
  await session.start();
}
