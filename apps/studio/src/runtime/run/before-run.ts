import type { Finding } from "@twincell/core";
import { playStore, type PlayState } from "../../stores/play.ts";
import { answerToRun, askToRun, type RunQuestion } from "../../stores/run-question.ts";
import { onStop } from "../../stores/stop.ts";

// STOP answers the question as well.
onStop(() => {
  answerToRun(false);
});

/** A finding that keeps a program from being run without a word, with the step it belongs to. */
export interface RedFinding {
  readonly step: string;
  readonly finding: Finding;
}
/** What the check says of the program as it is now. Only "green" runs unasked. */
export type CheckState =
  | { readonly kind: "green" }
  | { readonly kind: "red"; readonly findings: readonly RedFinding[]; readonly count: number }
  /** Under way; its share 0 … 1. */
  | { readonly kind: "under-way"; readonly share: number }
  | { readonly kind: "not-checked"; readonly why: string }
  /** So many steps could not be judged. */
  | { readonly kind: "unjudged"; readonly count: number };

/** What may break something comes before what is only refused. */
const RANK = ["collision", "reach", "limits", "branch", "speed"];
const rank = ({ finding }: RedFinding): number => {
  const at = RANK.findIndex(word => finding.code.startsWith(word));
  return at < 0 ? RANK.length : at;
};

/** A verdict counts only for the program and the cell it was made for. */
export function checkState({ verdict, checking, trouble, current }: PlayState): CheckState {
  if (checking !== null) return { kind: "under-way", share: checking };
  if (trouble !== null || verdict === null || !current) return { kind: "not-checked", why: trouble ?? "" };
  if (verdict.ok) return { kind: "green" };
  const bad = verdict.steps.filter(step => step.verdict === "bad");
  if (bad.length === 0)
    return { kind: "unjudged", count: verdict.steps.filter(step => step.verdict === "unknown").length };
  const findings = bad.flatMap(({ id, findings: of }) => of.map(finding => ({ step: id, finding })));
  return {
    kind: "red",
    findings: findings.toSorted((a, b) => rank(a) - rank(b)),
    count: findings.length || bad.length,
  };
}

/** Whether the present program may run: at once where its check is green for every robot, otherwise as the person answers. */
export function mayRun(question: RunQuestion): Promise<boolean> {
  const green =
    checkState(playStore.getState()).kind === "green" && question.otherModels.length === 0 && !question.otherText;
  return green ? Promise.resolve(true) : askToRun(question);
}
