import { everyStep, type Finding, type Program, type Repair, type StepVerdict, type Verdict } from "@twincell/core";

/** Findings that say the same of steps that follow one another: one card. */
export interface Why {
  readonly key: string;
  readonly step: string;
  readonly group: string | undefined;
  readonly finding: Finding;
  readonly verdict: StepVerdict;
  readonly steps: readonly string[];
  readonly repairs: readonly { readonly id: string; readonly repair: Repair }[];
}

/** One card for each cause: same code, same joint, same group, steps in a row. The worst value speaks for all. */
export function whyCards(verdict: Verdict, program: Program): readonly Why[] {
  const groups = new Map(Array.from(everyStep(program), step => [step.id, step.group]));
  const cards: Why[] = [];
  for (const report of verdict.steps) {
    const group = groups.get(report.id);
    for (const finding of report.findings) {
      const repairs = finding.repairs.map(repair => ({ id: report.id, repair }));
      const at = cards.findIndex(
        card =>
          card.finding.code === finding.code &&
          card.finding.joint === finding.joint &&
          (card.group !== undefined ? card.group === group : card.step === report.id),
      );
      const card = cards[at];
      if (!card) {
        cards.push({
          key: `${report.id} ${finding.code} ${finding.joint ?? ""}`,
          step: report.id,
          group,
          finding,
          verdict: report.verdict,
          steps: [report.id],
          repairs,
        });
        continue;
      }
      const worse = Math.abs(finding.value - finding.limit) > Math.abs(card.finding.value - card.finding.limit);
      cards[at] = {
        ...card,
        steps: card.steps.includes(report.id) ? card.steps : [...card.steps, report.id],
        repairs: [...card.repairs, ...repairs],
        ...(worse ? { finding, step: report.id, verdict: report.verdict } : {}),
      };
    }
  }
  return cards.sort((a, b) => Number(b.verdict === "bad") - Number(a.verdict === "bad"));
}
