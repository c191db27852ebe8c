import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Argument, Expression } from "../../parser/structured/index.ts";
import type { Options } from "./functions.ts";
import { asNumber, type Value } from "./values.ts";

/** The arguments of one instruction: some by place, optional ones by name. */
export class Arguments {
  readonly at: TextPlace;
  private readonly name: string;
  private readonly args: readonly Argument[];
  private readonly free: readonly Expression[];
  private readonly evaluate: (expression: Expression) => Value;

  constructor(name: string, args: readonly Argument[], at: TextPlace, evaluate: (expression: Expression) => Value) {
    this.name = name;
    this.args = args;
    this.free = args.flatMap(argument =>
      argument.name === undefined && argument.value !== undefined ? [argument.value] : [],
    );
    this.at = at;
    this.evaluate = evaluate;
  }

  /** The argument at that place, as it is written. */
  given(place: number, what: string): Expression {
    const found = this.free[place];
    if (found === undefined) throw new TextError(this.at, what, `${this.name} has no ${what}.`);
    return found;
  }

  value(place: number, what: string): Value {
    return this.evaluate(this.given(place, what));
  }
  number(place: number, what: string): number {
    return asNumber(this.value(place, what), this.given(place, what));
  }

  /** The name of a line, a tool or a work object. */
  nameOf(place: number, what: string): string {
    const found = this.given(place, what);
    if (found.kind !== "variable") throw new TextError(found, what, `${this.name} takes the name of ${what} here.`);
    return found.name;
  }

  has(name: string): boolean {
    return this.args.some(argument => argument.name === name);
  }
  optionGiven(name: string): Expression | undefined {
    return this.args.find(argument => argument.name === name)?.value;
  }
  option(name: string): number | undefined {
    const found = this.optionGiven(name);
    return found === undefined ? undefined : asNumber(this.evaluate(found), found);
  }

  /** Everything that is given, as it is written. */
  places(): readonly Expression[] {
    return this.args.flatMap(({ value }) => (value === undefined ? [] : [value]));
  }

  get count(): number {
    return this.free.length;
  }
  values(): Value[] {
    return this.free.map(each => this.evaluate(each));
  }
  options(): Options {
    return new Map(
      this.args.flatMap(({ name, value }): [string, Value | true][] =>
        name === undefined ? [] : [[name, value === undefined ? true : this.evaluate(value)]],
      ),
    );
  }
}
