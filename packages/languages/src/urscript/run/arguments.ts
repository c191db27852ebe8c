import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Argument, Expression } from "../../parser/structured/index.ts";
import type { Value } from "./values.ts";

/** The arguments of one call: by place, or by name as in `r=0.01`. */
export class Arguments {
  readonly at: TextPlace;
  private readonly name: string;
  private readonly args: readonly Argument[];
  private readonly free: readonly Argument[];
  private readonly evaluate: (expression: Expression) => Value;

  constructor(name: string, args: readonly Argument[], at: TextPlace, evaluate: (expression: Expression) => Value) {
    this.name = name;
    this.args = args;
    this.free = args.filter(argument => argument.name === undefined);
    this.at = at;
    this.evaluate = evaluate;
  }

  private find(place: number, name: string): Expression | undefined {
    return (this.args.find(argument => argument.name === name) ?? this.free[place])?.value;
  }

  /** The argument as it is written. */
  given(place: number, name: string): Expression {
    const found = this.find(place, name);
    if (found === undefined)
      throw new TextError(this.at, `the argument ${name}`, `${this.name} is called without its argument ${name}.`);
    return found;
  }

  required(place: number, name: string): Value {
    return this.evaluate(this.given(place, name));
  }

  optional(place: number, name: string): Value | undefined {
    const found = this.find(place, name);
    return found === undefined ? undefined : this.evaluate(found);
  }

  all(): Value[] {
    return this.args.flatMap(({ value }) => (value === undefined ? [] : [this.evaluate(value)]));
  }

  count(least: number, most: number): void {
    const count = this.args.length;
    if (count >= least && count <= most) return;
    const wanted = least === most ? `${most}` : `${least} to ${most}`;
    throw new TextError(
      this.at,
      `${wanted} argument${most === 1 ? "" : "s"}`,
      `${this.name} takes ${wanted} argument${most === 1 ? "" : "s"}; ${count} are given.`,
    );
  }
}
