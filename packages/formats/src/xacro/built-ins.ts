import { Refusal } from "../refusal.ts";
import { shorten } from "../xml.ts";
import type { Budget } from "./budget.ts";
import { mathFunctions, namesOf, plainFunctions } from "./expression/functions.ts";
import { Callable, List, numberOf, textOf, type Arguments, type Value } from "./expression/values.ts";
import { readYaml } from "./yaml.ts";

/** What the functions of `xacro.…` need of the expansion around them. */
export interface Helpers {
  readonly budget: Budget;
  readonly warnings: Set<string>;
  bytes(reference: string): Uint8Array;
  argument(name: string): string | undefined;
  expression(text: string): Value;
}

/** Names every expression knows: `math.…` and `python.…`, also bare, and `xacro.…`. */
export function builtIns(helpers: Helpers): ReadonlyMap<string, Value> {
  const plain = plainFunctions(helpers.budget);
  const math = mathFunctions();
  const xacro = new Map<string, Value>();
  const define = (name: string, call: (given: Arguments) => Value): void => {
    xacro.set(name, new Callable(`${name}()`, call));
  };
  const said = ({ values }: Arguments): string => values.map(textOf).join(" ");
  define("load_yaml", ({ values }) =>
    readYaml(helpers.bytes(textOf(values[0] ?? "")), text => {
      const amount = numberOf(helpers.expression(text));
      if (amount === undefined) throw new Refusal(`“${shorten(text)}” is not an amount.`);
      return amount;
    }),
  );
  define("arg", ({ values }) => {
    const name = textOf(values[0] ?? "");
    const value = helpers.argument(name);
    if (value === undefined) throw new Refusal(`The argument ${shorten(name)} has no value.`);
    return value;
  });
  define("dotify", ({ values }) => values[0] ?? null);
  define("tokenize", ({ values }) => {
    const letters = textOf(values[1] ?? ",; ");
    const pieces: string[] = [""];
    for (const letter of textOf(values[0] ?? ""))
      if (letters.includes(letter)) pieces.push("");
      else pieces.push(`${pieces.pop() ?? ""}${letter}`);
    helpers.budget.spend(pieces.length);
    return new List(pieces.filter(piece => piece !== ""));
  });
  define("fatal", given => {
    throw new Refusal(`The file itself stops: ${shorten(said(given))}.`);
  });
  for (const name of ["warning", "error"])
    define(name, given => {
      helpers.warnings.add(said(given));
      return "";
    });
  for (const name of ["message", "print_location"]) define(name, () => "");
  return new Map<string, Value>([
    ...math,
    ...plain,
    ["load_yaml", xacro.get("load_yaml") ?? null],
    ["dotify", xacro.get("dotify") ?? null],
    ["math", namesOf("math", math)],
    ["python", namesOf("python", plain)],
    ["xacro", namesOf("xacro", xacro)],
  ]);
}
