import type { Reader } from "../../json/reader.ts";
import { MOST_WHOLE, type Value, type ValueType, type Variable } from "../expression/expression.ts";
import { KEYWORDS } from "../expression/words.ts";
import { readValueType, VALUE_TYPE_KEYS } from "./expression.ts";

/** Names that every language can say, and that expressions can be typed with. */
const NAME = /^[A-Za-z][A-Za-z0-9_]{0,23}$/;

export function readVariables(
  reader: Reader,
  value: unknown,
  signals: Readonly<Record<string, unknown>>,
): Readonly<Record<string, Variable>> {
  if (value === undefined) return {};
  const table = reader.object(value, "variables", "the table of variables");
  const entries: [string, Variable][] = [];
  for (const [name, entry] of Object.entries(table ?? {})) {
    const path = `variables.${name}`;
    const what = `the variable “${name}”`;
    named(reader, name, path, what, signals);
    const fields = reader.object(entry, path, what);
    if (fields === undefined) continue;
    reader.onlyKeys(fields, path, what, [...VALUE_TYPE_KEYS, "initial"]);
    const type = readValueType(reader, fields, path, what);
    if (type === undefined) continue;
    if (fields.initial === undefined) {
      entries.push([name, type]);
      continue;
    }
    const initial = readInitial(reader, fields.initial, `${path}.initial`, what, type);
    if (initial !== undefined) entries.push([name, { ...type, initial }]);
  }
  return Object.fromEntries(entries);
}

/** Values that routines are given, by the routine's name. */
export function readParameters(
  reader: Reader,
  value: unknown,
  routines: ReadonlySet<string>,
  taken: Readonly<Record<string, unknown>>,
): Readonly<Record<string, Readonly<Record<string, ValueType>>>> {
  if (value === undefined) return {};
  const table = reader.object(value, "parameters", "the table of parameters");
  const entries: [string, Readonly<Record<string, ValueType>>][] = [];
  for (const [routine, entry] of Object.entries(table ?? {})) {
    const path = `parameters.${routine}`;
    if (!routines.has(routine)) reader.fault(path, `There is no routine “${routine}” that could take parameters.`);
    const fields = reader.object(entry, path, `the parameters of “${routine}”`);
    const own: [string, ValueType][] = [];
    for (const [name, type] of Object.entries(fields ?? {})) {
      const place = `${path}.${name}`;
      const what = `the parameter “${name}” of “${routine}”`;
      named(reader, name, place, what, taken);
      const found = reader.object(type, place, what);
      if (found === undefined) continue;
      reader.onlyKeys(found, place, what, VALUE_TYPE_KEYS);
      const read = readValueType(reader, found, place, what);
      if (read !== undefined) own.push([name, read]);
    }
    if (own.length > 0) entries.push([routine, Object.fromEntries(own)]);
  }
  return Object.fromEntries(entries);
}

/** Why a name cannot be a variable's: not every language can say it, expressions have the word, it is taken. */
export type VariableNameFault = "form" | "keyword" | "taken";

/**
 * Why a name cannot be that of a variable; undefined when it can. A code, for whoever asks to put into words.
 *
 * @param taken  names of signals and other variables; upper and lower case are the same.
 */
export function variableNameFault(
  name: string,
  taken: Readonly<Record<string, unknown>>,
): VariableNameFault | undefined {
  if (!NAME.test(name)) return "form";
  if (KEYWORDS.has(name.toLowerCase())) return "keyword";
  return Object.keys(taken).some(other => other.toLowerCase() === name.toLowerCase()) ? "taken" : undefined;
}

/** What is said of a variable in a file whose name cannot be one. */
const OF_NAME: Readonly<Record<VariableNameFault, string>> = {
  form: "has a name of letters, digits and _, 24 at most, that begins with a letter",
  keyword: "has a name that means something else in expressions",
  taken: "has a name that is taken; a signal or another variable has it",
};

function named(
  reader: Reader,
  name: string,
  path: string,
  what: string,
  taken: Readonly<Record<string, unknown>>,
): void {
  const fault = variableNameFault(name, taken);
  if (fault !== undefined) reader.fault(path, `${what} ${OF_NAME[fault]}.`);
}

function readInitial(reader: Reader, value: unknown, path: string, what: string, type: ValueType): Value | undefined {
  if (type.type === "bool")
    return typeof value === "boolean"
      ? value
      : reader.fault(path, `${what} begins with true or false; here it is ${reader.shown(value)}.`);
  const number = reader.number(value, path, `the first value of ${what}`, (type.type === "num" && type.unit) || "");
  if (number === undefined || type.type === "num") return number;
  return Number.isInteger(number) && Math.abs(number) <= MOST_WHOLE
    ? number
    : reader.fault(path, `${what} begins with a whole number up to ±${MOST_WHOLE}; here it is ${number}.`);
}
