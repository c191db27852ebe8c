import { type Executed, type SignalLine, type Signals, type Step, type TextFault } from "@twincell/core";
import { TextError, textFault } from "../parser/faults.ts";
import { WaitsOutside } from "../parser/waits-outside.ts";

/** Executions of the text, and steps and lines in all of them together. */
const EXECUTIONS = 600;
const STEPS = 400_000;
const LINES = 4_000_000;
/** Steps of one execution after which a program is taken to repeat itself for ever. */
const STEPS_OF_ONE = 200_000;

/** A step as a text executed it. Blocks that were made of decisions stand in the line before them. */
export interface WrittenStep {
  readonly step: Step;
  readonly line: number;
  readonly then?: readonly WrittenStep[];
  readonly otherwise?: readonly WrittenStep[];
  /** Waits where the text goes round until an input changes. */
  readonly waits?: boolean;
}
export type WrittenOut =
  | {
      readonly kind: "written-out";
      readonly steps: readonly WrittenStep[];
      /** Lines that were executed more than once. */
      readonly repeated: ReadonlySet<number>;
    }
  | { readonly kind: "cannot"; readonly fault: TextFault };

type Trace = readonly TraceEvent[];
type TraceEvent =
  | { readonly kind: "step"; readonly key: string; readonly line: number; readonly step: Step }
  /** An input is asked for the first time since the last step. */
  | {
      readonly kind: "read";
      readonly key: string;
      readonly line: number;
      readonly signal: string;
      readonly value: boolean;
    }
  /** The text goes round until an input changes. */
  | { readonly kind: "waits"; readonly key: string; readonly line: number };

/**
 * Executes a text and writes down what it does as steps: loops and calls as what they amount to, and a decision where
 * an input was asked and the answer makes a difference. Each answer is turned round once; what is done alike behind
 * both answers stands behind the decision. Where one decision changes what a later one does, `merged: false` keeps all
 * that follows inside each branch.
 *
 * @returns why not, with a line, where the text does not end, decides by levels, or branches more than the bounds
 *   allow.
 */
export function writtenOut(
  run: (signals: Signals) => Iterator<Executed, unknown>,
  kinds: Readonly<Record<string, SignalLine>>,
  { merged, called }: { readonly merged: boolean; readonly called: string },
): WrittenOut {
  const writer = new Writer(run, kinds, merged, called);
  try {
    const steps = writer.write();
    return { kind: "written-out", steps, repeated: writer.repeated };
  } catch (cause) {
    if (cause instanceof TextError) return { kind: "cannot", fault: cause.fault };
    throw cause;
  }
}

class Writer {
  readonly repeated = new Set<number>();
  private readonly run: (signals: Signals) => Iterator<Executed, unknown>;
  private readonly kinds: Readonly<Record<string, SignalLine>>;
  private readonly merged: boolean;
  private readonly called: string;
  private readonly traces = new Map<string, Trace>();
  private executions = 0;
  private steps = 0;
  private lines = 0;

  constructor(
    run: (signals: Signals) => Iterator<Executed, unknown>,
    kinds: Readonly<Record<string, SignalLine>>,
    merged: boolean,
    called: string,
  ) {
    this.run = run;
    this.kinds = kinds;
    this.merged = merged;
    this.called = called;
  }

  write(): readonly WrittenStep[] {
    const trace = this.trace([]);
    return this.assemble(trace, 0, trace.length);
  }

  /** Executes the text; the first answers are given, all others are no. */
  private trace(answers: readonly boolean[]): Trace {
    const name = answers.map(Number).join("");
    const known = this.traces.get(name) ?? this.execute(answers);
    this.traces.set(name, known);
    return known;
  }

  private execute(answers: readonly boolean[]): Trace {
    const events: TraceEvent[] = [];
    const seen = new Set<number>();
    const outputs = new Map<string, boolean | number>();
    let fresh = new Map<string, boolean>();
    let line = 1;
    let reads = 0;
    let made = 0;
    const bound = (what: string): never => {
      throw new TextError(
        { line, column: 1 },
        "a program that can be written out",
        `${what} \`run\` executes the text as it stands.`,
      );
    };
    if (++this.executions > EXECUTIONS) bound(`The ${this.called} decides by inputs in more than ${EXECUTIONS} ways.`);
    const signals: Signals = {
      read: signal => {
        const written = outputs.get(signal);
        if (written !== undefined) return written;
        const known = fresh.get(signal);
        if (known !== undefined) return known;
        const kind = this.kinds[signal]?.kind;
        if (kind?.startsWith("analogue") === true)
          bound(`The ${this.called} computes with the analogue line ${signal}, which steps cannot.`);
        const value = answers[reads++] ?? false;
        fresh.set(signal, value);
        events.push({ kind: "read", key: `read ${signal}`, line, signal, value });
        return value;
      },
      write: (signal, value) => {
        outputs.set(signal, value);
      },
    };
    try {
      const run = this.run(signals);
      for (let next = run.next(); next.done !== true; next = run.next()) {
        const { step } = next.value;
        ({ line } = next.value);
        if (++this.lines > LINES) bound(`The ${this.called} takes more than ${LINES} statements to write out.`);
        if (step === undefined) continue;
        fresh = new Map();
        if (seen.has(line)) this.repeated.add(line);
        seen.add(line);
        events.push({ kind: "step", key: `${line} ${JSON.stringify({ ...step, id: "" })}`, line, step });
        if (++made > STEPS_OF_ONE)
          bound(`The ${this.called} has more than ${STEPS_OF_ONE} steps: it repeats itself for ever.`);
        if (++this.steps > STEPS) bound(`Writing the ${this.called} out takes more than ${STEPS} steps.`);
      }
    } catch (cause) {
      if (!(cause instanceof WaitsOutside)) throw cause;
      events.push({ kind: "waits", key: "waits", line });
    }
    return events;
  }

  /**
   * Both branches of a decision without the events that they end with alike; undefined where these hang on decisions
   * inside.
   */
  private branches(
    trace: Trace,
    turned: Trace,
    from: number,
    same: number,
  ):
    | {
        readonly then: readonly WrittenStep[];
        readonly otherwise: readonly WrittenStep[];
        readonly end: number;
      }
    | undefined {
    const end = trace.length - same;
    try {
      return {
        then: this.assemble(turned, from, turned.length - same),
        otherwise: this.assemble(trace, from, end),
        end,
      };
    } catch (cause) {
      if (cause instanceof ChangesWhatFollows && same > 0) return undefined;
      throw cause;
    }
  }

  private assemble(trace: Trace, from: number, to: number): readonly WrittenStep[] {
    const out: WrittenStep[] = [];
    for (let i = from; i < to; ) {
      const event = trace[i]!;
      if (event.kind === "step") {
        out.push({ step: event.step, line: event.line });
        i++;
        continue;
      }
      if (event.kind === "waits")
        throw new TextError(
          { line: event.line, column: 1 },
          `a ${this.called} that goes on by itself`,
          `The ${this.called} goes round until an input changes, which its steps cannot say here. \`run\` executes the text as it stands.`,
        );
      const turned = this.trace([...answersBefore(trace, i), true]);
      if (trace[i + 1]?.kind === "waits") {
        // Nothing is done until the line is on.
        out.push(waitFor(event, true));
        out.push(...this.assemble(turned, i + 1, turned.length));
        return out;
      }
      if (turned[i + 1]?.kind === "waits") {
        out.push(waitFor(event, false));
        i++;
        continue;
      }
      const same = this.merged ? sameEnd(trace, turned, i + 1) : 0;
      const branches = this.branches(trace, turned, i + 1, same) ?? this.branches(trace, turned, i + 1, 0)!;
      const { then, otherwise, end } = branches;
      if (end > to) throw new ChangesWhatFollows();
      if (then.length > 0 || otherwise.length > 0)
        out.push({
          line: event.line,
          step: { id: "", type: "if", when: { signal: event.signal, is: true }, then: [] },
          then,
          otherwise,
        });
      i = Math.max(end, i + 1);
    }
    return out;
  }
}

/** A decision inside a branch changes what is done behind the end of the branch. Never leaves the writer. */
class ChangesWhatFollows extends Error {}

const waitFor = ({ line, signal }: Extract<TraceEvent, { kind: "read" }>, is: boolean): WrittenStep => ({
  line,
  waits: true,
  step: { id: "", type: "wait-for", when: { signal, is } },
});

const answersBefore = (trace: Trace, end: number): boolean[] =>
  trace.slice(0, end).flatMap(event => (event.kind === "read" ? [event.value] : []));

/** How many events two traces end with alike, both from an index on. */
function sameEnd(a: Trace, b: Trace, from: number): number {
  const most = Math.min(a.length, b.length) - from;
  let same = 0;
  while (same < most && a[a.length - 1 - same]!.key === b[b.length - 1 - same]!.key) same++;
  return same;
}

/**
 * The steps of what was written out, with ids of their own in the order of the text: s1, s2 and so on.
 *
 * @param from  receives the line of each step, by its id.
 */
export function numberedSteps(
  written: readonly WrittenStep[],
  from: Map<string, number> = new Map(),
  waits: Set<string> = new Set(),
): Step[] {
  let count = 0;
  const number = (list: readonly WrittenStep[]): Step[] =>
    list.map(each => {
      const id = `s${++count}`;
      from.set(id, each.line);
      if (each.waits === true) waits.add(id);
      if (each.step.type !== "if") return { ...each.step, id };
      const otherwise = each.otherwise ?? [];
      return {
        ...each.step,
        id,
        then: number(each.then ?? []),
        ...(otherwise.length === 0 ? {} : { else: number(otherwise) }),
      };
    });
  return number(written);
}

/** That lines were executed more than once, each said once. */
export const repeatedWarnings = (repeated: Iterable<number>, statement: string): TextFault[] =>
  [...repeated].map(line =>
    textFault(
      { line, column: 1 },
      `${statement} that is executed once`,
      `Line ${line} is executed more than once: every time became a step of its own.`,
    ),
  );
