import { everyStep, type PathPiece, type Plan, type Program, type StepVerdict, type Verdict } from "@twincell/core";
import { worse } from "../../stores/play.ts";
import { stepWords } from "../../stores/program.ts";

/** A stretch of the time line: one step, or the steps of one group that follow one another. */
export interface Block {
  readonly key: string;
  /** First step in it. */
  readonly step: string;
  readonly name: string;
  readonly start_s: number;
  readonly duration_s: number;
  readonly verdict: StepVerdict;
  readonly rest: boolean;
  readonly findings: number;
  /** Where in it the verdict is another than "ok", in parts of its own length. */
  readonly pieces: readonly BlockPiece[];
}
export interface BlockPiece {
  readonly from: number;
  readonly to: number;
  readonly verdict: StepVerdict;
}

/** Blocks thinner than this part of the whole are drawn together. */
const THIN = 0.004;

export function timelineBlocks(
  program: Program,
  plan: Plan,
  verdict: Verdict | null,
  path: readonly PathPiece[] = [],
): readonly Block[] {
  const reports = new Map(verdict?.steps.map(report => [report.id, report]));
  const places = new Map(Array.from(everyStep(program), (step, index) => [step.id, { step, index }]));
  const blocks: Block[] = [];
  let group: string | undefined;
  let lastStep = "";
  for (const segment of plan.segments) {
    const place = places.get(segment.step);
    const last = blocks.at(-1);
    const report = reports.get(segment.step);
    const judged = report?.verdict ?? "unknown";
    const count = segment.step === lastStep ? 0 : (report?.findings.length ?? 0);
    const mine = place?.step.group;
    const rest = segment.kind === "rest";
    const joins =
      last !== undefined &&
      (segment.step === lastStep ||
        (mine !== undefined && mine === group) ||
        (rest === last.rest &&
          segment.duration_s < THIN * plan.duration_s &&
          last.duration_s < THIN * plan.duration_s));
    if (joins) {
      blocks[blocks.length - 1] = {
        ...last,
        duration_s: segment.start_s + segment.duration_s - last.start_s,
        verdict: worse(last.verdict, judged),
        findings: last.findings + count,
      };
    } else {
      const name =
        mine !== undefined
          ? (program.groups[mine]?.name ?? mine)
          : place
            ? stepWords(place.step, place.index)
            : segment.step;
      blocks.push({
        key: `${segment.step} ${segment.start_s}`,
        step: segment.step,
        name,
        start_s: segment.start_s,
        duration_s: segment.duration_s,
        verdict: judged,
        rest,
        findings: count,
        pieces: [],
      });
    }
    group = mine;
    lastStep = segment.step;
  }
  return withPieces(blocks, path);
}

/** Gives each block the pieces of the path that lie in it and are not "ok". */
function withPieces(blocks: readonly Block[], path: readonly PathPiece[]): readonly Block[] {
  const marked = path.filter(({ verdict, from_s, to_s }) => verdict !== "ok" && to_s > from_s);
  return blocks.map(block => {
    const share = (t_s: number): number => Math.min(1, Math.max(0, (t_s - block.start_s) / block.duration_s));
    const pieces = marked.flatMap(({ from_s, to_s, verdict }) => {
      const [from, to] = [share(from_s), share(to_s)];
      return to > from ? [{ from, to, verdict }] : [];
    });
    return pieces.length === 0 ? block : { ...block, pieces };
  });
}
