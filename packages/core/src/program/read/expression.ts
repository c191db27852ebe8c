import { keys, type Fields, type Reader } from "../../json/reader.ts";
import {
  BINARY,
  DEEPEST_EXPRESSION,
  FUNCTIONS,
  FUNCTION_NAMES,
  MOST_PARTS,
  UNARY,
  UNITS,
  everyPart,
  type Expression,
  type ValueType,
} from "../expression/expression.ts";
import { checkType } from "../expression/typing.ts";
import { scopeOf, type ProgramScope } from "./scope.ts";

const FORMS =
  "true, false, a number, {value, unit}, {variable}, {signal}, {op, of} or {call, of}; see docs/program.schema.json";

/** An expression of that type; `what` is what it is for. */
export function readExpression(
  reader: Reader,
  value: unknown,
  path: string,
  what: string,
  wanted: ValueType,
  around: ProgramScope,
): Expression | undefined {
  const expression = readPart(reader, value, path, what, 1);
  if (expression === undefined) return undefined;
  const parts = Array.from(everyPart(expression)).length;
  if (parts > MOST_PARTS)
    return reader.fault(path, `the expression of ${what} has ${parts} parts; ${MOST_PARTS} at most are read.`);
  const typed = checkType(expression, wanted, scopeOf(around));
  if (typed.kind === "typed") return expression;
  return reader.fault(
    `${path}${typed.at.map(place => `.of[${place}]`).join("")}`,
    `in the expression of ${what}: ${typed.sentence}`,
  );
}

function readPart(reader: Reader, value: unknown, path: string, what: string, depth: number): Expression | undefined {
  if (depth > DEEPEST_EXPRESSION)
    return reader.fault(path, `the expression of ${what} is ${DEEPEST_EXPRESSION} deep at most.`);
  if (typeof value === "boolean") return value;
  if (typeof value === "number") return reader.number(value, path, `a number in the expression of ${what}`, "");
  if (value === null || typeof value !== "object" || Array.isArray(value))
    return reader.fault(path, `a part of the expression of ${what} is ${FORMS}; here it is ${reader.shown(value)}.`);
  const fields = value as Fields;
  if ("value" in fields) return readQuantity(reader, fields, path, what);
  if ("variable" in fields || "signal" in fields) {
    const key = "variable" in fields ? "variable" : "signal";
    reader.onlyKeys(fields, path, `a part of the expression of ${what}`, [key]);
    const name = reader.name(fields[key], `${path}.${key}`, `the ${key} in the expression of ${what}`);
    return name === undefined ? undefined : key === "variable" ? { variable: name } : { signal: name };
  }
  return readOperation(reader, fields, path, what, depth);
}

function readQuantity(reader: Reader, fields: Fields, path: string, what: string): Expression | undefined {
  reader.onlyKeys(fields, path, `a part of the expression of ${what}`, ["value", "unit"]);
  const value = reader.number(fields.value, `${path}.value`, `a number in the expression of ${what}`, "");
  const unit = UNITS.find(known => known === fields.unit);
  if (unit === undefined)
    return reader.fault(
      `${path}.unit`,
      `a unit in the expression of ${what} is one of ${UNITS.join(", ")}; here it is ${reader.shown(fields.unit)}.`,
    );
  return value === undefined ? undefined : { value, unit };
}

function readOperation(
  reader: Reader,
  fields: Fields,
  path: string,
  what: string,
  depth: number,
): Expression | undefined {
  const isCall = "call" in fields;
  reader.onlyKeys(fields, path, `a part of the expression of ${what}`, [isCall ? "call" : "op", "of"]);
  const call = FUNCTION_NAMES.find(name => name === fields.call);
  const one = UNARY.find(name => name === fields.op);
  const two = BINARY.find(name => name === fields.op);
  if (call === undefined && one === undefined && two === undefined)
    return isCall
      ? reader.fault(
          `${path}.call`,
          `the expression of ${what} calls ${reader.shown(fields.call)}; there are ${FUNCTION_NAMES.join(", ")}.`,
        )
      : reader.fault(
          "op" in fields ? `${path}.op` : path,
          "op" in fields
            ? `the expression of ${what} has the operator ${reader.shown(fields.op)}; there are ${[...UNARY, ...BINARY].join(" ")}.`
            : `a part of the expression of ${what} is ${FORMS}.`,
        );
  const list = reader.list(fields.of, `${path}.of`, `the parts of an expression of ${what}`);
  if (list === undefined) return undefined;
  const count = call !== undefined ? FUNCTIONS[call] : one !== undefined ? 1 : 2;
  if (list.length !== count)
    return reader.fault(
      `${path}.of`,
      `“${call ?? one ?? two}” in the expression of ${what} takes ${count} part${count === 1 ? "" : "s"}; here are ${list.length}.`,
    );
  const of = list.map((part, i) => readPart(reader, part, `${path}.of[${i}]`, what, depth + 1));
  if (of.includes(undefined)) return undefined;
  const parts = of as Expression[];
  if (call !== undefined) return { call, of: parts };
  return one !== undefined ? { op: one, of: [parts[0]!] } : { op: two!, of: [parts[0]!, parts[1]!] };
}

/** What a variable or a parameter may say of its type. */
export function readValueType(reader: Reader, fields: Fields, path: string, what: string): ValueType | undefined {
  const { type, unit } = fields;
  if (type !== "bool" && type !== "int" && type !== "num")
    return reader.fault(`${path}.type`, `${what} is of type bool, int or num; here it is ${reader.shown(type)}.`);
  if (unit === undefined) return { type };
  if (type !== "num") return reader.fault(`${path}.unit`, `${what} is of type ${type}; only a num has a unit.`);
  const known = UNITS.find(each => each === unit);
  return known === undefined
    ? reader.fault(
        `${path}.unit`,
        `the unit of ${what} is one of ${UNITS.join(", ")}; here it is ${reader.shown(unit)}.`,
      )
    : { type, unit: known };
}

export const VALUE_TYPE_KEYS = keys<{ type: unknown; unit: unknown }>()("type", "unit");
