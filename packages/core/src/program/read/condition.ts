import { isFields, type Reader } from "../../json/reader.ts";
import type { Condition, Predicate } from "../program.ts";
import { readExpression } from "./expression.ts";
import type { ProgramScope } from "./scope.ts";

/** One line compared with something, or an expression that is yes or no. */
export function readPredicate(
  reader: Reader,
  value: unknown,
  path: string,
  what: string,
  around: ProgramScope,
): Predicate | undefined {
  if (!isFields(value) || !("expression" in value)) return readCondition(reader, value, path, what);
  reader.onlyKeys(value, path, `the condition of ${what}`, ["expression"]);
  const place = `${path}.expression`;
  const expression = readExpression(reader, value.expression, place, what, { type: "bool" }, around);
  return expression === undefined ? undefined : { expression };
}

/**
 * A signal and what it is compared with. That the signal exists is for the checker to say: it can be connected later.
 */
export function readCondition(reader: Reader, value: unknown, path: string, what: string): Condition | undefined {
  const fields = reader.object(value, path, `the condition of ${what}`);
  if (fields === undefined) return undefined;
  reader.onlyKeys(fields, path, `the condition of ${what}`, ["signal", "is", "above", "below"]);
  const signal = reader.name(fields.signal, `${path}.signal`, `the signal of ${what}`);
  const given = (["is", "above", "below"] as const).filter(key => fields[key] !== undefined);
  const key = given[0];
  if (key === undefined || given.length !== 1)
    return reader.fault(
      path,
      `the condition of ${what} has exactly one of is, above and below; here are ${given.length} of them.`,
    );
  if (key === "is") {
    const { is } = fields;
    if (typeof is !== "boolean")
      return reader.fault(`${path}.is`, `“is” of ${what} is true or false; here it is ${reader.shown(is)}.`);
    return signal === undefined ? undefined : { signal, is };
  }
  const level = reader.number(fields[key], `${path}.${key}`, `“${key}” of ${what}`, "");
  if (signal === undefined || level === undefined) return undefined;
  return key === "above" ? { signal, above: level } : { signal, below: level };
}
