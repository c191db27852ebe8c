import type { Expression, ValueType } from "./expression/expression.ts";
import { variablesOf } from "./expression/expression.ts";
import { expressionsOf } from "./predicate.ts";
import type { Program, Step } from "./program.ts";
import { callCycle, callsOf, everyIn, everyStep, withLists } from "./walk.ts";

/** No, or 0 in its unit: what a variable or a parameter of that type holds before anybody says more. */
export function nothingOf(type: ValueType): Expression {
  if (type.type === "bool") return false;
  return type.type === "num" && type.unit !== undefined ? { value: 0, unit: type.unit } : 0;
}

/** Adds a routine; one of that name stays as it is. */
export const withRoutine = (program: Program, name: string, steps: readonly Step[] = []): Program =>
  name === "" || Object.hasOwn(program.routines, name)
    ? program
    : { ...program, routines: { ...program.routines, [name]: steps } };

/** Whether the main steps or other routines call it. */
export const isCalled = (program: Pick<Program, "steps" | "routines">, name: string): boolean =>
  [program.steps, ...Object.values(program.routines)].some(steps => callsOf(steps).has(name));

/** Gives a routine another name, in every call too. A name that is taken or empty changes nothing. */
export function renameRoutine(program: Program, name: string, wanted: string): Program {
  if (!Object.hasOwn(program.routines, name) || wanted === "" || Object.hasOwn(program.routines, wanted))
    return program;
  const moved = <Entry>(table: Readonly<Record<string, Entry>>): Readonly<Record<string, Entry>> =>
    Object.fromEntries(Object.entries(table).map(([key, entry]) => [key === name ? wanted : key, entry]));
  const renamed = everyStepPut(program, step =>
    step.type === "call" && step.routine === name ? { ...step, routine: wanted } : step,
  );
  return {
    ...renamed,
    routines: moved(renamed.routines),
    ...(program.parameters === undefined ? {} : { parameters: moved(program.parameters) }),
  };
}

/** Takes a routine away, with its parameters. One that is called stays. */
export function removeRoutine(program: Program, name: string): Program {
  if (!Object.hasOwn(program.routines, name) || isCalled(program, name)) return program;
  return {
    ...program,
    routines: without(program.routines, name),
    ...(program.parameters === undefined ? {} : { parameters: without(program.parameters, name) }),
  };
}

/** Routines that may be called from where a step stands, so that none comes back to itself. */
export function callableFrom(program: Pick<Program, "routines">, routine: string | undefined): readonly string[] {
  return Object.keys(program.routines).filter(name => {
    if (routine === undefined) return true;
    const list = [...(program.routines[routine] ?? []), { id: "", type: "call", routine: name } as const];
    return callCycle({ ...program.routines, [routine]: list }) === undefined;
  });
}

/** The routine in which a step stands; undefined for one of the main steps. */
export const routineOf = (program: Pick<Program, "routines">, id: string): string | undefined =>
  Object.entries(program.routines).find(([, steps]) => Array.from(everyIn(steps)).some(step => step.id === id))?.[0];

/** Gives a routine a parameter, or another type to one it has. Every call then has a value for it: none, at first. */
export function withParameter(program: Program, routine: string, name: string, type: ValueType): Program {
  if (!Object.hasOwn(program.routines, routine)) return program;
  const own = { ...program.parameters?.[routine], [name]: type };
  const given = everyStepPut(program, step =>
    step.type === "call" && step.routine === routine
      ? { ...step, arguments: { ...step.arguments, [name]: nothingOf(type) } }
      : step,
  );
  return { ...given, parameters: { ...program.parameters, [routine]: own } };
}

/** Takes a parameter away, from every call too. One that the routine reads stays. */
export function withoutParameter(program: Program, routine: string, name: string): Program {
  const own = program.parameters?.[routine];
  if (own === undefined || !Object.hasOwn(own, name) || readsVariable(program.routines[routine] ?? [], name))
    return program;
  const left = without(own, name);
  const given = everyStepPut(program, step => {
    if (step.type !== "call" || step.routine !== routine || step.arguments === undefined) return step;
    const { arguments: before, ...rest } = step;
    const after = without(before, name);
    return Object.keys(after).length === 0 ? rest : { ...rest, arguments: after };
  });
  const others = without(program.parameters ?? {}, routine);
  return { ...given, parameters: Object.keys(left).length === 0 ? others : { ...others, [routine]: left } };
}

/** Whether one of these steps reads a variable or a parameter of that name. */
export const readsVariable = (steps: readonly Step[], name: string): boolean =>
  Array.from(everyIn(steps)).some(step => Array.from(expressionsOf(step)).some(each => variablesOf(each).has(name)));

/** Whether any step of the program gives the variable a value or reads it. */
export const usesVariable = (program: Program, name: string): boolean =>
  Array.from(everyStep(program)).some(
    step =>
      (step.type === "assign" && step.variable === name) ||
      Array.from(expressionsOf(step)).some(each => variablesOf(each).has(name)),
  );

function without<Entry>(table: Readonly<Record<string, Entry>>, name: string): Readonly<Record<string, Entry>> {
  return Object.fromEntries(Object.entries(table).filter(([key]) => key !== name));
}
function everyStepPut(program: Program, change: (step: Step) => Step): Program {
  const list = (steps: readonly Step[]): readonly Step[] => steps.map(step => withLists(change(step), list));
  return {
    ...program,
    steps: list(program.steps),
    routines: Object.fromEntries(Object.entries(program.routines).map(([name, steps]) => [name, list(steps)])),
  };
}
