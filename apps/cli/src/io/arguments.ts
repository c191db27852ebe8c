import { parseArgs } from "node:util";
import { UseFault } from "./usage.ts";

type Options = Readonly<
  Record<string, { readonly type: "string" | "boolean"; readonly short?: string; readonly multiple?: boolean }>
>;

export interface Given {
  readonly positionals: readonly string[];
  text(name: string): string | undefined;
  flag(name: string): boolean;
  /** Every value of an option that may be given again and again. */
  list(name: string): readonly string[];
  /** A number, or the sentence that it is none. */
  number(name: string): number | undefined;
  /** Numbers with commas between them. */
  numbers(name: string): readonly number[] | undefined;
}

/** Reads the arguments of a command; an unknown option or a missing value is a `UseFault`. */
export function given(args: readonly string[], options: Options): Given {
  let parsed: { values: Record<string, string | boolean | (string | boolean)[] | undefined>; positionals: string[] };
  try {
    parsed = parseArgs({ args: joinNegativeValues(args, options), options, allowPositionals: true, strict: true });
  } catch (problem) {
    throw new UseFault(
      (problem as Error).message.split(". ")[0]!.replace(/\.?$/, "."),
      "Add --help to see the options.",
    );
  }
  const text = (name: string) => {
    const value = parsed.values[name];
    return typeof value === "string" ? value : undefined;
  };
  const number = (name: string, value: string): number => {
    const read = Number(value);
    if (value.trim() === "" || !Number.isFinite(read)) throw new UseFault(`--${name} wants a number, not "${value}".`);
    return read;
  };
  return {
    positionals: parsed.positionals,
    text,
    flag: name => parsed.values[name] === true,
    list: name => {
      const values = parsed.values[name];
      return Array.isArray(values) ? values.filter(value => typeof value === "string") : [];
    },
    number: name => {
      const value = text(name);
      return value === undefined ? undefined : number(name, value);
    },
    numbers: name =>
      text(name)
        ?.split(",")
        .map(part => number(name, part)),
  };
}

/** `--near -1,0,2` is meant as it reads: a value that begins with a minus belongs to the option before it. */
function joinNegativeValues(args: readonly string[], options: Options): string[] {
  const joined: string[] = [];
  for (let i = 0; i < args.length; i++) {
    const arg = args[i]!;
    const next = args[i + 1];
    const name = arg.startsWith("--") ? arg.slice(2) : "";
    if (options[name]?.type === "string" && next !== undefined && /^-[\d.]/.test(next)) {
      joined.push(`${arg}=${next}`);
      i++;
    } else joined.push(arg);
  }
  return joined;
}
