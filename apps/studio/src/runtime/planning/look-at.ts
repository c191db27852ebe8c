import { playStore, verdictOf } from "../../stores/play.ts";
import { seek } from "../../stores/seek.ts";
import { select } from "../../stores/selection.ts";
import { canRepair, explainStep } from "./repairing.ts";

/** Goes to a moment of a step; of one that cannot be carried out it says why, and what would help. */
export function lookAt(step: string, at_s: number): void {
  select({ kind: "step", id: step });
  seek(at_s);
  if (verdictOf(playStore.getState().verdict, step) === "bad" && canRepair()) explainStep(step);
}

interface Problem {
  readonly step: string;
  readonly at_s: number;
}
/** The first finding of every step that has one, in order of time; where steps are bad, of those alone. */
export function problems(): readonly Problem[] {
  const steps = playStore.getState().verdict?.steps.filter(({ findings }) => findings.length > 0) ?? [];
  const bad = steps.filter(({ verdict }) => verdict === "bad");
  return (bad.length > 0 ? bad : steps)
    .map(({ id, findings }) => ({ step: id, at_s: findings[0]!.at_s }))
    .toSorted((a, b) => a.at_s - b.at_s);
}

/** The problem after the one that was looked at, or before it; round again at the end. */
export function nextProblem(current: string | null, forward: boolean): Problem | undefined {
  const all = problems();
  const at = all.findIndex(({ step }) => step === current);
  if (at < 0) return forward ? all[0] : all.at(-1);
  return all[(at + (forward ? 1 : -1) + all.length) % all.length];
}
