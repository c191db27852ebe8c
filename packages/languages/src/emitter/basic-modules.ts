import { everyStep, type EmittedFile, type Step, type Variable } from "@twincell/core";
import { asciiText } from "../parser/index.ts";
import { BasicProgram, inUse, type Add, type BasicWords, type InUse } from "./basic-program.ts";
import { UnsupportedStep, called } from "./cannot.ts";
import { Names, type NameRules } from "./names.ts";
import type { Place } from "./place.ts";
import { BlockWriter } from "./text-writer.ts";

/** A BASIC whose routines stand side by side, and where constants give numbers their names. */
export interface ModuleWords extends BasicWords {
  readonly language: string;
  readonly file: string;
  /** What gives a name to a number. */
  readonly define: string;
  readonly main: string;
  /** The declaration of a variable that all routines share. */
  readonly global: (name: string, type: Variable["type"]) => string;
  readonly open: (name: string) => string;
  readonly close: string;
  /** Most frames and tools that the controller keeps, and what it calls frames. */
  readonly most: { readonly tools: number; readonly frames: number; readonly called: string };
  readonly lines: readonly [first: number, last: number];
  /** There is no word for a gripper: an output closes it. */
  readonly gripper: { readonly name: string; readonly output: number };
}

export abstract class BasicModules extends BasicProgram {
  protected readonly used: InUse;
  declare protected readonly words: ModuleWords;
  private readonly numbers = new Map<string, number>();
  private declared: string[] = [];

  constructor(place: Place, names: NameRules, words: ModuleWords) {
    super(place, new Names(names), words);
    this.used = inUse(place.program);
  }

  /** Lines above the first routine. */
  protected abstract head(): readonly string[];
  /** What the controller would keep from before, and what it shall know. */
  protected abstract beginning(): readonly string[];
  /** What is done when the program has ended. */
  protected abstract ending(): readonly string[];
  /** How variables are declared. */
  protected abstract declaration(names: readonly string[]): readonly string[];
  /** Constants that stand for places of patterns. */
  protected abstract patterns(): readonly string[];

  write(): EmittedFile {
    const { program, robot } = this.place;
    const { main, open, close, file } = this.words;
    const whole = new BlockWriter();
    for (const line of [...this.head(), ...this.constants()]) whole.add(line);
    for (const [name, { type }] of Object.entries(program.variables ?? {}))
      whole.add(this.words.global(this.variableName(name), type));
    for (const [name, steps] of [
      [main, program.steps] as const,
      ...Object.entries(program.routines).map(([routine, list]) => [this.named("routine", routine), list] as const),
    ]) {
      const inside = (this.out = new BlockWriter());
      this.declared = [];
      this.begin();
      if (name === main) for (const line of this.beginning()) inside.add(line);
      this.steps(steps);
      if (name === main) for (const line of this.ending()) inside.add(line);
      whole.block(open(name), close, "", () => {
        if (name === main) {
          whole.add(`'* ${asciiText(program.name)}`.trimEnd());
          whole.add(`'* ${asciiText(robot.name)}. Lengths in mm, angles in degrees, places in the base of the robot.`);
        }
        if (this.declared.length > 0) for (const line of this.declaration(this.declared)) whole.add(line);
        whole.append(inside);
      });
    }
    return whole.file(file, "\r\n");
  }

  protected named(sort: string, name: string): string {
    return this.names.of(sort, name.toLowerCase());
  }
  protected line(signal: string): string {
    return this.named("signal", signal);
  }
  protected variableName(name: string): string {
    return this.named("variable", name);
  }
  /** The number of a frame; 0 for the base. */
  protected numberOf(frame: string): number {
    return this.numbers.get(`frame\0${frame}`) ?? 0;
  }
  protected call(routine: string, add: Add): void {
    add(`Call ${this.named("routine", routine)}`);
  }

  protected counter(name: string): string {
    const variable = this.names.fresh(name);
    this.introduce(variable);
    return variable;
  }

  /** A variable that the routine which is written uses. */
  protected introduce(variable: string): void {
    if (!this.declared.includes(variable)) this.declared.push(variable);
  }

  private constants(): string[] {
    const { tools, frames, signals } = this.used;
    const { most, define, gripper } = this.words;
    const lines: string[] = [];
    for (const [sort, names, limit, what] of [
      ["tool", tools, most.tools, "tools"],
      ["frame", frames, most.frames, most.called],
    ] as const) {
      if (names.size > limit)
        throw new UnsupportedStep(
          "",
          `The program uses ${names.size} ${what}; a controller keeps ${limit}.`,
          "Divide the program.",
        );
      for (const [i, name] of [...names].entries()) {
        this.numbers.set(`${sort}\0${name}`, i + 1);
        lines.push(`${define} ${this.named(sort, name)} ${i + 1}`);
      }
    }
    lines.push(...this.patterns());
    const taken = new Map<number, string>();
    for (const [signal, step] of signals) {
      const address = this.address(signal, step);
      const key = this.sharesNumbers
        ? address
        : address + (this.place.program.signals[signal]!.kind === "digital-in" ? 0.5 : 0);
      const other = taken.get(key);
      if (other !== undefined)
        throw new UnsupportedStep(
          step.id,
          `${called(step)} uses the line ${signal} with the number ${address}, which ${other} has.`,
          "Give every line a number of its own.",
        );
      taken.set(key, signal);
      lines.push(`${define} ${this.line(signal)} ${address}`);
    }
    if (Array.from(everyStep(this.place.program)).some(({ type }) => type === "gripper"))
      lines.push(`${define} ${gripper.name} ${gripper.output}`);
    return lines;
  }

  /** Whether inputs and outputs are counted in one row. */
  protected abstract readonly sharesNumbers: boolean;

  private address(signal: string, step: Step): number {
    const { signals } = this.place.program;
    const line = Object.hasOwn(signals, signal) ? signals[signal] : undefined;
    const {
      language,
      lines: [first, last],
      gripper,
    } = this.words;
    if (line?.address === undefined)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} uses the line ${signal}, whose number is not known.`,
        "Give the line its number in the list of signals.",
      );
    if (!Number.isInteger(line.address) || line.address < first || line.address > last)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} uses the line ${signal} with the number ${line.address}; ${language} counts lines from ${first} to ${last}.`,
        "Give the line a number of the controller.",
      );
    if ((line.kind === "digital-out" || this.sharesNumbers) && line.address === gripper.output)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} uses the output ${gripper.output}, which is the gripper's.`,
        "Give the line another number.",
      );
    return line.address;
  }
}
