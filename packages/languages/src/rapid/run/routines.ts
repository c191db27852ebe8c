import type { Executed, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Argument, Block, Expression, Flow, Routine } from "../../parser/structured/index.ts";
import type { Value } from "./values.ts";
import { SIGNAL_TYPE } from "./kept-data.ts";
import { Evaluation } from "./evaluation.ts";

/** Routines of RAPID, how they are called and which one is the first. */
export abstract class Routines extends Evaluation {
  *main(): Generator<Executed, Flow> {
    const main = this.entry();
    return main === undefined || !this.startsAlone(main) ? "next" : yield* this.call(main, [], main);
  }

  /** Arguments without those that hang on an optional parameter which the routine was not given. */
  protected present(args: readonly Argument[]): readonly Argument[] {
    if (!args.some(({ ifPresent }) => ifPresent === true)) return args;
    const names = this.scopes.at(-1)?.names;
    return args.filter(
      ({ ifPresent, value }) => ifPresent !== true || (value?.kind === "variable" && names?.has(value.name) === true),
    );
  }

  /** Arguments by place fill the parameters that are not optional, in their order. */
  override *call(routine: Routine, args: readonly Argument[], at: TextPlace): Generator<Executed, Flow> {
    const required = routine.parameters.filter(({ optional }) => optional !== true);
    const given = this.present(args);
    const free = given.filter(({ name }) => name === undefined).length;
    if (free > required.length)
      throw new TextError(
        at,
        `${required.length} arguments`,
        `${this.spelt(routine.name)} takes ${required.length} arguments; ${free} are given.`,
      );
    let place = 0;
    return yield* super.call(
      routine,
      this.linesByName(
        routine,
        given.map(each => (each.name === undefined ? { ...each, name: required[place++]!.name } : each)),
      ),
      at,
    );
  }

  protected override handBack(routine: Routine, names: ReadonlyMap<string, Value>, args: readonly Argument[]): void {
    for (const { name, isBack } of routine.parameters) {
      if (isBack !== true) continue;
      const given = args.find(argument => argument.name === name)?.value;
      const value = names.get(name);
      if (given === undefined || value === undefined || !isPlace(given)) continue;
      if (this.isConstantParameter(given)) continue;
      this.store(given, value);
    }
  }

  /** Data of the controller are only read. */
  private isConstantParameter(given: Expression): boolean {
    let of = given;
    while (of.kind === "index" || of.kind === "component") ({ of } = of);
    return of.kind !== "variable" || (!this.isDatum(of.name) && this.scopes.at(-1)?.names.has(of.name) !== true);
  }

  /** PROC main, or the only routine there is. */
  entry(): Routine | undefined {
    const main = this.source.routines.get("main");
    if (main !== undefined || this.source.routines.size === 0) return main;
    const all = [...this.source.routines.values()];
    const alone = all.length === 1 ? all[0]! : undefined;
    if (alone === undefined)
      this.remark(
        "main",
        all[0]!,
        "PROC main",
        "No module that is open has PROC main: no routine is run. Put the module that calls them beside it.",
      );
    return alone;
  }

  /** Whether a routine can be started by itself: one that wants arguments has nobody who gives them. */
  private startsAlone({ name, parameters, ...at }: Routine): boolean {
    const asked = parameters.filter(({ optional }) => optional !== true).map(each => this.spelt(each.name));
    if (asked.length === 0) return true;
    this.remark(
      "arguments",
      placeOnly(at),
      "the routine that calls this one",
      `${this.spelt(name)} wants to be given ${asked.join(", ")}: it is not run by itself. Open it with the module that calls it.`,
    );
    return false;
  }

  /** The body of the entry with its data made, to be written down. */
  open(): Block {
    const main = this.entry();
    if (main === undefined) return [];
    const names = new Map<string, Value>();
    this.scopes.push({ routine: main.name, names });
    this.prepare(main, names);
    return main.body;
  }

  /** Lines are handed to a routine by their names. */
  private linesByName(routine: Routine, args: readonly Argument[]): readonly Argument[] {
    if (!routine.parameters.some(({ type }) => SIGNAL_TYPE.test(type))) return args;
    return args.map(argument => {
      const { name, value } = argument;
      const type = routine.parameters.find(each => each.name === name)?.type ?? "";
      if (value?.kind !== "variable" || !SIGNAL_TYPE.test(type)) return argument;
      const { line, column } = value;
      const spelt = this.handedLine(value.name) ?? this.spelt(value.name);
      return { ...argument, value: { kind: "text", value: spelt, line, column } };
    });
  }
}

const placeOnly = ({ line, column }: TextPlace): TextPlace => ({ line, column });

const isPlace = (expression: Expression): boolean =>
  expression.kind === "variable" || expression.kind === "component" || expression.kind === "index";
