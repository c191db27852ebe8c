import type { Executed, MoveStep, Signals, Step, TextFault, TextPlace } from "@twincell/core";
import { TextError, WaitsOutside, textFault, type DeclaredCell } from "../../parser/index.ts";
import type { Expression, Motion, Source, Statement } from "../read/syntax.ts";
import type { Frame } from "./frame.ts";
import { Lines } from "./signals.ts";
import type { ControllerState } from "./state.ts";
import type { Value } from "./values.ts";

/** Statements without a motion or a wait after which the program is taken to run on the spot for ever. */
const STATEMENTS_WITHOUT_MOTION = 100_000;

/** What comes out of a KRL program: steps in the order in which the robot carries them out. */
export abstract class ExecutedSteps {
  readonly lines: Lines;
  protected readonly source: Source;
  protected readonly state: ControllerState;
  protected readonly globals = new Map<string, Value>();
  protected readonly types = new Map<string, string>();
  protected readonly stack: Frame[] = [];
  protected readonly times = new Map<number, number>();
  protected readonly interrupts = new Map<
    number,
    { readonly condition: Expression; readonly routine: string; on: boolean }
  >();
  protected spline: { readonly settings: Motion["settings"]; any: boolean } | undefined;
  /** A motion of which it is not yet known whether the robot stops at its end, and what was executed since. */
  protected pending:
    | {
        readonly line: number;
        readonly step: MoveStep;
        readonly passing: Partial<Pick<MoveStep, "blend_m" | "blend_ratio">>;
      }
    | undefined;
  private readonly since: Executed[] = [];
  protected ready: Executed[] = [];
  protected idle = 0;
  protected stopped = false;
  /** What the next motion does at its start and at its end. */
  protected triggers: Extract<Statement, { kind: "trigger" }>[] = [];
  /** Depth of the routine that a trigger calls; what it does leaves the motion alone. */
  protected onPath: number | undefined;
  protected defining = "";
  /** Cyclic flags: what each of them is at any time. */
  protected readonly cyclic = new Map<string, Expression>();
  /** Why nobody knows where the robot is: a sentence. */
  protected lost: string | undefined;
  /** Names that modules declare for themselves, with the modules; names that all know. */
  protected readonly owners = new Map<string, string[]>();
  protected readonly shared = new Set<string>();
  /** What a person should know of a run: by what it is about. */
  readonly notes = new Map<string, TextFault>();

  constructor(source: Source, state: ControllerState, signals: Signals | undefined, met: DeclaredCell["signals"]) {
    this.source = source;
    this.state = state;
    this.lines = new Lines(source.signals, signals, met);
    for (const { name, data } of source.modules.values())
      for (const declared of data) {
        if (declared.isGlobal) this.shared.add(declared.name);
        else if (!(this.owners.get(declared.name) ?? []).includes(name))
          this.owners.set(declared.name, [...(this.owners.get(declared.name) ?? []), name]);
      }
  }

  /** Says something once. */
  protected remark(about: string, at: TextPlace, expected: string, sentence: string): void {
    if (!this.notes.has(about)) this.notes.set(about, textFault(at, expected, sentence));
  }

  /** Hands out the motion that was waiting for what comes after it. */
  protected settle(goesOn: boolean): void {
    const { pending } = this;
    if (pending === undefined || (this.onPath !== undefined && !goesOn)) return;
    this.pending = undefined;
    this.ready.push(
      { line: pending.line, step: goesOn ? { ...pending.step, ...pending.passing } : pending.step },
      ...this.since.splice(0),
    );
  }

  protected note({ line }: TextPlace): void {
    if (this.pending === undefined) this.ready.push({ line });
    else this.since.push({ line });
  }

  protected step({ line }: TextPlace, step: Step): void {
    this.idle = 0;
    if (this.pending === undefined) this.ready.push({ line, step });
    else this.since.push({ line, step });
  }

  /** L12, and L12.2 when line 12 is executed again. */
  protected stepId(line: number): string {
    const time = (this.times.get(line) ?? 0) + 1;
    this.times.set(line, time);
    return time === 1 ? `L${line}` : `L${line}.${time}`;
  }

  protected spend(at: TextPlace): void {
    if (++this.idle <= STATEMENTS_WITHOUT_MOTION) return;
    if (this.lines.asked) throw new WaitsOutside(at);
    throw new TextError(
      at,
      "a motion, a wait or an end",
      `The program has executed ${STATEMENTS_WITHOUT_MOTION} statements without a motion: it runs on the spot for ever.`,
    );
  }
}
