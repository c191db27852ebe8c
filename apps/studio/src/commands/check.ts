import type { Checking } from "../runtime/planning/checking.ts";
import type { Command } from "../stores/commands.ts";
import { theProgram } from "../stores/document.ts";
import { notify } from "../stores/notices.ts";
import { playStore } from "../stores/play.ts";
import { firstRepairs, repairAll } from "../stores/program.ts";
import { words } from "../messages/index.ts";

export const checkCommands = (checking: Checking): readonly Command[] => [
  {
    id: "check.now",
    group: "program",
    words: words.commands.checkNow,
    keys: ["Mod+Enter"],
    can: () => (theProgram()?.steps.length ?? 0) > 0,
    run: () => checking.now(),
  },
  {
    id: "check.cancel",
    group: "program",
    words: words.check.cancel,
    can: () => playStore.getState().checking !== null,
    run: () => {
      checking.cancel();
      notify("info", words.check.cancelled);
    },
  },
  {
    id: "check.repair-all",
    group: "program",
    words: words.commands.repairAll,
    can: () => repairsNow().length > 0,
    run: () => {
      const repairs = repairsNow();
      if (repairAll(repairs)) notify("done", words.check.repaired(repairs.length));
    },
  },
];
const repairsNow = (): ReturnType<typeof firstRepairs> => firstRepairs(playStore.getState().verdict);
