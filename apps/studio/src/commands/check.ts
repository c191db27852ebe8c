import type { Checking } from "../runtime/planning/checking.ts";
import { lookAt, nextProblem, problems } from "../runtime/planning/look-at.ts";
import { applyRepair, canRepair, explainStep, repairProgram } from "../runtime/planning/repairing.ts";
import type { Command } from "../stores/commands.ts";
import { theProgram } from "../stores/document.ts";
import { notify } from "../stores/notices.ts";
import { playStore } from "../stores/play.ts";
import { firstRepairs, repairAll } from "../stores/program.ts";
import { repairOffered, repairStore, showRepair, toggleRepair } from "../stores/repairs.ts";
import { selectionStore } from "../stores/selection.ts";
import { showMode, viewStore } from "../stores/view.ts";
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
    can: () => badSteps() > 0 || repairsNow().length > 0,
    run: () => {
      if (badSteps() > 0) {
        repairProgram();
        return;
      }
      const repairs = repairsNow();
      if (repairAll(repairs)) notify("done", words.check.repaired(repairs.length, 0));
    },
  },
  ...([true, false] as const).map(
    (forward): Command => ({
      id: forward ? "check.next-problem" : "check.previous-problem",
      group: "program",
      words: forward ? words.commands.nextProblem : words.commands.previousProblem,
      keys: [forward ? "F8" : "Shift+F8"],
      can: () => problems().length > 0,
      run: () => goToProblem(forward),
    }),
  ),
  ...[0, 1, 2].map(
    (index): Command => ({
      id: `check.show-repair-${index + 1}`,
      group: "program",
      words: words.commands.showRepair(index + 1),
      keys: [String(index + 1)],
      can: () => viewStore.getState().mode === "check" && repairOffered(index),
      run: () => void toggleRepair(index),
    }),
  ),
  {
    id: "check.explain",
    group: "program",
    words: words.check.waysOut,
    can: () => canRepair() && problemNow() !== null,
    run: () => {
      const step = problemNow();
      if (step !== null) explainStep(step);
    },
  },
  ...[0, 1, 2].map(
    (index): Command => ({
      id: `check.apply-repair-${index + 1}`,
      group: "program",
      words: words.check.applyRepair(index + 1),
      can: () => repairOffered(index),
      run: () => {
        const { current, explanations } = repairStore.getState();
        const repair = current === null ? undefined : explanations.get(current)?.repairs[index];
        if (current === null || !repair) return;
        showRepair(null);
        if (!applyRepair(current, repair)) notify("info", words.check.noRepair);
      },
    }),
  ),
  {
    id: "check.hide-repair",
    group: "program",
    words: words.commands.hideRepair,
    keys: ["Escape"],
    can: () => repairStore.getState().shown !== null,
    run: () => showRepair(null),
  },
];
const repairsNow = (): ReturnType<typeof firstRepairs> => firstRepairs(playStore.getState().verdict);
const badSteps = (): number =>
  canRepair() ? (playStore.getState().verdict?.steps.filter(({ verdict }) => verdict === "bad").length ?? 0) : 0;

/** The selected step if it cannot be carried out, else the first that cannot. */
function problemNow(): string | null {
  const { selected } = selectionStore.getState();
  const bad = playStore.getState().verdict?.steps.filter(({ verdict }) => verdict === "bad") ?? [];
  const chosen = selected?.kind === "step" ? bad.find(({ id }) => id === selected.id) : undefined;
  return (chosen ?? bad[0])?.id ?? null;
}

function goToProblem(forward: boolean): void {
  const { selected } = selectionStore.getState();
  const problem = nextProblem(selected?.kind === "step" ? selected.id : null, forward);
  if (!problem) return;
  showMode("check");
  lookAt(problem.step, problem.at_s);
}
