import type { Executed, Interpreted, Step } from "@twincell/core";
import { ADDED } from "../codec/index.ts";

/** Where a job is in the text that is executed: its line 0 is NOP. */
interface Stretch {
  readonly job: string;
  readonly from: number;
  readonly nop: number;
  readonly moves: readonly number[];
}
/** A text that only counts does not stop the clock: so many lines without a step take one cycle. */
const LINES_PER_CYCLE = 200;
const CYCLE_S = 0.004;
const MOST_BYTES = 4_000_000;

/** Files of a controller: jobs and the numbers they mean. Kept over a restart. */
export class Files {
  private readonly texts = new Map<string, string>();
  private bytes = 0;

  names(ending: string): string[] {
    return [...this.texts.keys()].filter(name => name.endsWith(ending)).sort();
  }
  read(name: string): string | undefined {
    return this.texts.get(name.toUpperCase());
  }
  remove(name: string): boolean {
    this.bytes -= this.read(name)?.length ?? 0;
    return this.texts.delete(name.toUpperCase());
  }
  /** Why not, as added status; 0 is well. */
  save(name: string, text: string): number {
    if (!/^[A-Z0-9_\- ]{1,32}\.(JBI|CND|DAT|LST|PRM)$/.test(name.toUpperCase())) return ADDED.badJobName;
    if (text.trim() === "") return ADDED.fileEmpty;
    if (name.toUpperCase().endsWith(".JBI")) {
      if (!text.startsWith("/JOB")) return ADDED.format;
      if (!/^\s*NOP\s*$/m.test(text) || !/^\s*END\s*$/m.test(text)) return ADDED.noNopOrEnd;
    }
    const before = this.read(name)?.length ?? 0;
    if (this.bytes - before + text.length > MOST_BYTES) return ADDED.memoryFull;
    this.bytes += text.length - before;
    this.texts.set(name.toUpperCase(), text);
    return 0;
  }

  /** The job, then the ones it may call, then tools and frames: what an interpreter is given. */
  together(job: string): { readonly text: string; readonly stretches: readonly Stretch[] } {
    const first = `${job.toUpperCase()}.JBI`;
    const others = [...this.names(".JBI").filter(name => name !== first), ...this.names(".CND")];
    const stretches: Stretch[] = [];
    let text = "";
    let line = 1;
    for (const name of [first, ...others]) {
      const own = this.read(name) ?? "";
      const lines = own.split(/\r?\n/);
      const nop = lines.findIndex(each => each.trim() === "NOP");
      const moves = lines.flatMap((each, i) => (/^\s*MOV[JLCS]\b/.test(each) ? [i - nop] : []));
      if (name.endsWith(".JBI")) stretches.push({ job: name.slice(0, -4), from: line, nop: line + nop, moves });
      text += own.endsWith("\n") ? own : `${own}\n`;
      line += lines.length - (own.endsWith("\n") ? 1 : 0);
    }
    return { text, stretches };
  }
}

/** Where a job stands: line 0 is NOP, steps count its motions. */
export interface Place {
  readonly job: string;
  readonly line: number;
  readonly step: number;
}

/** One job on its way from NOP to END; what was begun and not ended is done again when it is continued. */
export class JobRun {
  readonly job: string;
  private readonly steps: Iterator<Executed, void>;
  private readonly stretches: readonly Stretch[];
  /** Asked for and not ended yet, oldest first. */
  private readonly open: { readonly step: Step; readonly line: number }[] = [];
  private readonly from: number;
  private idle = 0;
  private times = 0;
  private at: Place;
  /** Nothing is left but what is open. */
  over = false;

  constructor(
    job: string,
    line: number,
    ready: Extract<Interpreted, { kind: "ready" }>,
    stretches: readonly Stretch[],
    signals: Parameters<typeof ready.run>[0],
  ) {
    this.job = job;
    this.stretches = stretches;
    this.from = line === 0 ? 0 : stretches[0]!.nop + line;
    this.steps = ready.run(signals);
    this.at = { job, line, step: 0 };
  }

  get place(): Place {
    return this.at;
  }
  /** Begun motions that cannot be begun again from the middle. */
  get isInsideArc(): boolean {
    const first = this.open[0]?.step;
    return first?.type === "move" && (first.path === "circ" || first.path === "spline");
  }

  /** Steps to be executed from here on: what is open first. @param single  ends after one motion. */
  *rest(single: boolean): Generator<Step, void> {
    const again = [...this.open];
    for (const { step } of again) yield step;
    if (single && again.some(({ step }) => step.type === "move")) return;
    for (let next = this.steps.next(); !next.done; next = this.steps.next()) {
      const { line, step } = next.value;
      if (step === undefined) {
        if (++this.idle % LINES_PER_CYCLE === 0) yield this.opened({ id: "", type: "wait", s: CYCLE_S }, line);
        continue;
      }
      this.idle = 0;
      if (line < this.from && this.open.length === 0 && this.times === 0) continue;
      yield this.opened(step, line);
      if (single && step.type === "move") return;
    }
    this.over = true;
  }

  /** A step is being executed: those before it have ended. */
  reached(id: string): void {
    const at = this.open.findIndex(({ step }) => step.id === id);
    if (at < 0) return;
    this.open.splice(0, at);
    this.at = this.placeOf(this.open[0]!.line);
  }
  /** What was begun has ended. */
  ended(): void {
    this.open.length = 0;
  }

  private opened(step: Step, line: number): Step {
    const named = { ...step, id: `${++this.times}` };
    this.open.push({ step: named, line });
    return named;
  }
  private placeOf(line: number): Place {
    const in_ = this.stretches.findLast(({ from }) => from <= line) ?? this.stretches[0]!;
    const own = line - in_.nop;
    return { job: in_.job, line: own, step: in_.moves.filter(move => move <= own).length };
  }
}
