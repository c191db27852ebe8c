import { compose, inverse, type Pose } from "../spatial/pose.ts";
import type { PlaceVisit } from "../program/flow.ts";
import type { Program, Step, Target } from "../program/program.ts";
import type { Finding, Repair, StepVerdict } from "./verdict.ts";
import type { Turn } from "../trajectory/layout.ts";
import type { Severity } from "./scene.ts";

interface Entry {
  readonly severity: Severity;
  readonly finding: Finding;
  readonly atPlace: boolean;
  more: number;
}

/** Findings by step, the worst first. What is found at a place of a pallet says at which. */
export class FindingCollector {
  private readonly program: Program;
  private readonly found = new Map<string, Entry[]>();
  constructor(program: Program) {
    this.program = program;
  }

  add(id: string, severity: Severity, finding: Finding, turn: Turn | undefined): void {
    const step = turn?.written.id ?? id;
    const list = this.found.get(step) ?? [];
    // A joint that is over its limit is not also near it, and one sentence per fact is enough.
    const same = list.find(one => one.finding.code === finding.code && one.finding.joint === finding.joint);
    if (same !== undefined) {
      if (turn !== undefined && turn.visits.length > 0) same.more++;
      return;
    }
    list.push({
      severity,
      finding: turn === undefined ? finding : this.inTurn(finding, turn, id),
      atPlace: (turn?.visits.length ?? 0) > 0,
      more: 0,
    });
    this.found.set(step, list);
  }

  of(step: string): readonly Finding[] {
    const list = this.found.get(step) ?? [];
    return [...list.filter(one => one.severity === "bad"), ...list.filter(one => one.severity === "warn")].map(told);
  }

  /** What makes steps bad, in order of time. */
  bad(): readonly Finding[] {
    return [...this.found.values()]
      .flatMap(list => list.filter(one => one.severity === "bad").map(told))
      .sort((a, b) => a.at_s - b.at_s);
  }

  verdictOf(step: string, evaluated: boolean): StepVerdict {
    const list = this.found.get(step) ?? [];
    if (list.some(one => one.severity === "bad")) return "bad";
    if (!evaluated) return "unknown";
    return list.length > 0 ? "warn" : "ok";
  }

  private inTurn(finding: Finding, { written, visits }: Turn, id: string): Finding {
    const where =
      visits.length > 0
        ? visits.map(visit => placeName(visit, visits.length > 1)).join(", ")
        : id === written.id
          ? ""
          : "The next time round";
    return {
      ...finding,
      sentence: where === "" ? finding.sentence : `${where}: ${finding.sentence}`,
      repairs: finding.repairs.map(repair => this.asWritten(repair, written, visits)),
    };
  }

  /** A repair of one carrying out as a repair of the step that was written: its id, and its place in the pallet. */
  private asWritten(repair: Repair, written: Step, visits: readonly PlaceVisit[]): Repair {
    const back = (step: Step): Step =>
      step.type !== "move"
        ? step
        : {
            ...step,
            target: this.inPlace(step.target, written, visits),
            ...(step.via === undefined || written.type !== "move" || written.via === undefined
              ? {}
              : { via: written.via }),
          };
    return {
      ...repair,
      ...(repair.replace === undefined ? {} : { replace: { ...back(repair.replace), id: written.id } }),
      ...(repair.insertBefore === undefined ? {} : { insertBefore: repair.insertBefore.map(back) }),
    };
  }

  private inPlace(target: Target, written: Step, visits: readonly PlaceVisit[]): Target {
    if (!("pose" in target) || written.type !== "move" || !("pose" in written.target)) return target;
    const { frame } = written.target;
    const visit = visits.findLast(({ pallet }) => pallet === frame);
    if (visit === undefined || this.program.pallets[frame]?.frame !== target.frame) return target;
    return {
      ...target,
      frame,
      pose: compose(inverse(visit.frameFromPlace), target.pose) as Pose as Pose<"frame", "tcp">,
    };
  }
}

const placeName = ({ pallet, number, of }: PlaceVisit, named: boolean): string =>
  `Place ${number} of ${of}${named ? ` on ${pallet}` : ""}`;

function told({ finding, atPlace, more }: Entry): Finding {
  if (!atPlace || more === 0) return finding;
  return {
    ...finding,
    sentence: `${finding.sentence} ${more === 1 ? "One more place has" : `${more} more places have`} the same finding.`,
  };
}
