import type { Vector3 } from "../../spatial/vector.ts";
import {
  STEP_TYPES,
  type AssignStep,
  type CallStep,
  type IfStep,
  type MessageStep,
  type PalletStep,
  type PayloadStep,
  type RepeatStep,
  type SetStep,
  type Step,
  type StopStep,
  type WaitForStep,
  type WhileStep,
} from "../program.ts";
import { readPredicate } from "./condition.ts";
import { readExpression } from "./expression.ts";
import { readMove } from "./move.ts";
import { keys, type Fields, type Reader } from "../../json/reader.ts";
import type { Expression } from "../expression/expression.ts";
import type { ProgramScope } from "./scope.ts";

const BASE = ["id", "type", "name", "group"] as const;
/** Blocks inside blocks deeper than this help nobody, and would overflow the stack of whoever walks them. */
const DEEPEST = 16;
/** Times that a loop may repeat: exact in every controller's numbers. */
const MAX_TIMES = 1_000_000_000;

/** What a step says beside its id, name and group. */
type Body<S> = S extends Step ? Omit<S, "id" | "name" | "group"> : never;
type BodyReader = (
  reader: Reader,
  fields: Fields,
  path: string,
  what: string,
  around: ProgramScope,
) => Body<Step> | undefined;

/** A list of steps, with all that is inside them. */
export function readSteps(
  reader: Reader,
  value: unknown,
  path: string,
  what: string,
  around: ProgramScope,
): readonly Step[] {
  const list = reader.list(value, path, what);
  const steps: Step[] = [];
  if (list === undefined) return steps;
  if (around.depth > DEEPEST) {
    reader.fault(path, `Blocks stand in blocks ${DEEPEST} deep at most.`);
    return steps;
  }
  for (let i = 0; i < list.length; i++) {
    const step = readStep(reader, list[i], `${path}[${i}]`, i, around);
    if (step !== undefined) steps.push(step);
  }
  return steps;
}

function readStep(reader: Reader, value: unknown, path: string, index: number, around: ProgramScope): Step | undefined {
  const { seen, depth } = around;
  const fields = reader.object(value, path, depth === 0 ? `step ${index + 1}` : `step ${index + 1} of its block`);
  if (fields === undefined) return undefined;
  const number = seen.size + 1;
  const id = reader.name(fields.id, `${path}.id`, `the id of step ${number}`) ?? "";
  const what = id === "" ? `step ${number}` : `step “${id}”`;
  const earlier = seen.get(id);
  if (id !== "" && earlier !== undefined)
    reader.fault(`${path}.id`, `${what} exists twice: as number ${earlier} and as number ${number}.`);
  // A step without an id counts as well.
  seen.set(id === "" || earlier !== undefined ? `\0${number}` : id, number);
  const type = STEP_TYPES.find(known => known === fields.type);
  if (type === undefined)
    return reader.fault(
      `${path}.type`,
      `${what} is of type ${reader.shown(fields.type)}; a step is one of ${STEP_TYPES.join(", ")}.`,
    );
  const body = READERS[type](reader, fields, path, what, around);
  return body === undefined
    ? undefined
    : {
        id,
        ...optionalText(reader, fields, "name", path, what),
        ...optionalText(reader, fields, "group", path, what),
        ...body,
      };
}

function optionalText<K extends "name" | "group">(
  reader: Reader,
  fields: Fields,
  key: K,
  path: string,
  what: string,
): { readonly [k in K]?: string } {
  if (fields[key] === undefined) return {};
  const text = reader.text(fields[key], `${path}.${key}`, `the ${key} of ${what}`);
  const found: { [k in K]?: string } = {};
  if (text !== undefined) found[key] = text;
  return found;
}

const inside = (around: ProgramScope, open: readonly string[] = around.open): ProgramScope => ({
  ...around,
  open,
  depth: around.depth + 1,
});

const READERS: Readonly<Record<Step["type"], BodyReader>> = {
  move: readMove,
  wait(reader, fields, path, what) {
    reader.onlyKeys(fields, path, what, [...BASE, "s"]);
    const s = reader.number(fields.s, `${path}.s`, `the wait of ${what}`, "s");
    if (s === undefined) return undefined;
    return s >= 0 ? { type: "wait", s } : reader.fault(`${path}.s`, `${what} waits ${s} s; a wait is 0 s or longer.`);
  },
  gripper(reader, fields, path, what) {
    reader.onlyKeys(fields, path, what, [...BASE, "closed"]);
    if (typeof fields.closed === "boolean") return { type: "gripper", closed: fields.closed };
    return reader.fault(
      `${path}.closed`,
      `“closed” of ${what} is true or false; here it is ${reader.shown(fields.closed)}.`,
    );
  },
  set(reader, fields, path, what) {
    reader.onlyKeys(fields, path, what, keys<SetStep>()(...BASE, "signal", "to", "pulse_s"));
    const signal = reader.name(fields.signal, `${path}.signal`, `the signal of ${what}`);
    const { to } = fields;
    if (typeof to !== "boolean" && !(typeof to === "number" && Number.isFinite(to)))
      return reader.fault(
        `${path}.to`,
        `${what} sets its signal to true, false or a finite number; here it is ${reader.shown(to)}.`,
      );
    if (signal === undefined) return undefined;
    if (fields.pulse_s === undefined) return { type: "set", signal, to };
    const pulse_s = reader.number(fields.pulse_s, `${path}.pulse_s`, `the pulse of ${what}`, "s");
    if (pulse_s === undefined) return undefined;
    if (!(pulse_s > 0))
      return reader.fault(`${path}.pulse_s`, `the pulse of ${what} is longer than 0 s; here it is ${pulse_s}.`);
    return typeof to === "boolean"
      ? { type: "set", signal, to, pulse_s }
      : reader.fault(`${path}.pulse_s`, `${what} sets a number; only true and false can be a pulse.`);
  },
  "wait-for"(reader, fields, path, what, around) {
    reader.onlyKeys(fields, path, what, keys<WaitForStep>()(...BASE, "when", "timeout_s", "late"));
    const when = readPredicate(reader, fields.when, `${path}.when`, what, around);
    const late =
      fields.late === undefined
        ? {}
        : { late: readSteps(reader, fields.late, `${path}.late`, `the list of steps of ${what}`, inside(around)) };
    if (fields.timeout_s === undefined) {
      if (fields.late !== undefined)
        reader.fault(`${path}.late`, `${what} has steps for being late and no longest wait; give it timeout_s.`);
      return when === undefined ? undefined : { type: "wait-for", when };
    }
    const timeout_s = reader.number(fields.timeout_s, `${path}.timeout_s`, `the longest wait of ${what}`, "s");
    if (timeout_s !== undefined && !(timeout_s > 0))
      reader.fault(`${path}.timeout_s`, `the longest wait of ${what} is more than 0 s; here it is ${timeout_s}.`);
    return when === undefined || timeout_s === undefined ? undefined : { type: "wait-for", when, timeout_s, ...late };
  },
  payload(reader, fields, path, what) {
    reader.onlyKeys(fields, path, what, keys<PayloadStep>()(...BASE, "mass_kg", "center_m", "inertia_kgm2"));
    const mass_kg = reader.number(fields.mass_kg, `${path}.mass_kg`, `the payload of ${what}`, "kg");
    const center_m = reader.numbers(fields.center_m, `${path}.center_m`, `the centre of mass of ${what}`, "m", 3);
    const inertia =
      fields.inertia_kgm2 === undefined
        ? undefined
        : reader.numbers(fields.inertia_kgm2, `${path}.inertia_kgm2`, `the inertia of ${what}`, "kg·m²", 6);
    if (mass_kg === undefined || center_m === undefined) return undefined;
    if (mass_kg < 0)
      return reader.fault(`${path}.mass_kg`, `the payload of ${what} is 0 kg or more; here it is ${mass_kg} kg.`);
    return {
      type: "payload",
      mass_kg,
      center_m: center_m as Vector3,
      ...(inertia === undefined ? {} : { inertia_kgm2: inertia as [number, number, number, number, number, number] }),
    };
  },
  message(reader, fields, path, what) {
    reader.onlyKeys(fields, path, what, keys<MessageStep>()(...BASE, "text"));
    const text = reader.text(fields.text, `${path}.text`, `the message of ${what}`);
    return text === undefined ? undefined : { type: "message", text };
  },
  stop(reader, fields, path, what) {
    reader.onlyKeys(fields, path, what, keys<StopStep>()(...BASE));
    return { type: "stop" };
  },
  comment(reader, fields, path, what) {
    reader.onlyKeys(fields, path, what, [...BASE, "text"]);
    const text = reader.text(fields.text, `${path}.text`, `the comment of ${what}`);
    return text === undefined ? undefined : { type: "comment", text };
  },
  assign(reader, fields, path, what, around) {
    reader.onlyKeys(fields, path, what, keys<AssignStep>()(...BASE, "variable", "to"));
    const variable = reader.name(fields.variable, `${path}.variable`, `the variable of ${what}`);
    if (variable === undefined) return undefined;
    const type = Object.hasOwn(around.variables, variable) ? around.variables[variable]! : undefined;
    if (type === undefined)
      return reader.fault(
        `${path}.variable`,
        `${what} gives the variable “${variable}” a value, which the program does not have; it has ${listed(Object.keys(around.variables))}.`,
      );
    const to = readExpression(reader, fields.to, `${path}.to`, what, type, around);
    return to === undefined ? undefined : { type: "assign", variable, to };
  },
  call(reader, fields, path, what, around) {
    reader.onlyKeys(fields, path, what, keys<CallStep>()(...BASE, "routine", "arguments"));
    const routine = reader.name(fields.routine, `${path}.routine`, `the routine of ${what}`);
    if (routine === undefined) return undefined;
    if (around.routines.has(routine)) {
      const given = readArguments(reader, fields.arguments, `${path}.arguments`, what, routine, around);
      return given === undefined ? { type: "call", routine } : { type: "call", routine, arguments: given };
    }
    return reader.fault(
      `${path}.routine`,
      `${what} calls the routine “${routine}”, which the program does not have; it has ${listed(around.routines)}.`,
    );
  },
  repeat(reader, fields, path, what, around) {
    reader.onlyKeys(fields, path, what, keys<RepeatStep>()(...BASE, "times", "steps"));
    const steps = readSteps(reader, fields.steps, `${path}.steps`, `the list of steps of ${what}`, inside(around));
    const { times } = fields;
    if (times === "forever") return { type: "repeat", times, steps };
    if (typeof times === "number" && Number.isInteger(times) && times >= 0 && times <= MAX_TIMES)
      return { type: "repeat", times, steps };
    return reader.fault(
      `${path}.times`,
      `${what} repeats a whole number of times from 0 to ${MAX_TIMES}, or "forever"; here it is ${reader.shown(times)}.`,
    );
  },
  while(reader, fields, path, what, around) {
    reader.onlyKeys(fields, path, what, keys<WhileStep>()(...BASE, "when", "steps"));
    const when = readPredicate(reader, fields.when, `${path}.when`, what, around);
    const steps = readSteps(reader, fields.steps, `${path}.steps`, `the list of steps of ${what}`, inside(around));
    return when === undefined ? undefined : { type: "while", when, steps };
  },
  if(reader, fields, path, what, around) {
    reader.onlyKeys(fields, path, what, keys<IfStep>()(...BASE, "when", "then", "else"));
    const when = readPredicate(reader, fields.when, `${path}.when`, what, around);
    const then = readSteps(reader, fields.then, `${path}.then`, `the list of steps of ${what}`, inside(around));
    const otherwise =
      fields.else === undefined
        ? {}
        : {
            else: readSteps(reader, fields.else, `${path}.else`, `the other list of steps of ${what}`, inside(around)),
          };
    return when === undefined ? undefined : { type: "if", when, then, ...otherwise };
  },
  pallet(reader, fields, path, what, around) {
    reader.onlyKeys(fields, path, what, keys<PalletStep>()(...BASE, "pallet", "steps"));
    const pallet = reader.name(fields.pallet, `${path}.pallet`, `the pallet of ${what}`) ?? "";
    if (pallet !== "" && !Object.hasOwn(around.pallets, pallet))
      reader.fault(
        `${path}.pallet`,
        `${what} names the pallet “${pallet}”, which the program does not have; it has ${listed(Object.keys(around.pallets))}.`,
      );
    if (around.open.includes(pallet))
      reader.fault(`${path}.pallet`, `${what} visits the pallet “${pallet}” inside itself.`);
    const steps = readSteps(
      reader,
      fields.steps,
      `${path}.steps`,
      `the list of steps of ${what}`,
      inside(around, [...around.open, pallet]),
    );
    return { type: "pallet", pallet, steps };
  },
};

/** A value for every parameter of the routine, no more and no less; undefined when it has none. */
function readArguments(
  reader: Reader,
  value: unknown,
  path: string,
  what: string,
  routine: string,
  around: ProgramScope,
): Readonly<Record<string, Expression>> | undefined {
  const wanted = Object.hasOwn(around.parameters, routine) ? around.parameters[routine]! : {};
  const names = Object.keys(wanted);
  if (value === undefined && names.length === 0) return undefined;
  const fields = value === undefined ? {} : reader.object(value, path, `the arguments of ${what}`);
  if (fields === undefined) return undefined;
  for (const name of Object.keys(fields))
    if (!Object.hasOwn(wanted, name))
      reader.fault(`${path}.${name}`, `${what} gives “${routine}” a “${name}”; it takes ${listed(names)}.`);
  const given = names.flatMap(name => {
    if (fields[name] === undefined)
      return reader.fault(path, `${what} calls “${routine}” without a value for “${name}”.`) ?? [];
    const read = readExpression(reader, fields[name], `${path}.${name}`, what, wanted[name]!, around);
    return read === undefined ? [] : [[name, read] as const];
  });
  return names.length === 0 ? undefined : Object.fromEntries(given);
}

const listed = (names: Iterable<string>): string => [...names].join(", ") || "none";
