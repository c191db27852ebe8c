import { withFreshIds } from "./edit.ts";
import { initialOf, withLeaves, type Expression, type Unit, type Variable } from "./expression/expression.ts";
import { variableNameFault } from "./read/variables.ts";
import type { AssignStep, Predicate, Program, Search, Step, Target } from "./program.ts";
import { everyStep, withLists } from "./walk.ts";

/** A program with everything that another one needs, and the steps of that other one under names that fit there. */
export interface JoinedProgram {
  readonly program: Program;
  readonly steps: readonly Step[];
}

type Table = Readonly<Record<string, unknown>>;
type NameOf = (name: string) => string;

/**
 * Brings another program of the same robot into a program (row N-70): tools, frames, lines and pallets that are the
 * same are shared, others of the same name get a number, and so do variables, groups and routines. Variables that the
 * other program gives values to begin with their first value every time its steps begin. A last step that ends the
 * other program is left out, because the work goes on.
 */
export function joinProgram(program: Program, other: Program): JoinedProgram {
  const numbered = (name: string, n: number): string => `${name} ${n}`;
  const lines = tableNames(program.signals, other.signals, numbered, { ...program.variables, ...parameters(program) });
  const places = { ...program.pallets, ...program.frames, world: undefined };
  const names: Names = {
    tool: builtIn("flange", tableNames(program.tools, other.tools, numbered)),
    frame: builtIn("world", tableNames(program.frames, other.frames, numbered, program.pallets)),
    pallet: name => name,
    signal: lines,
    variable: variableNames(program, other, lines),
    group: tableNames(program.groups, other.groups, numbered, program.groups),
    routine: tableNames(program.routines, other.routines, numbered, program.routines),
  };
  const pallets = Object.fromEntries(
    Object.entries(other.pallets).map(([name, pallet]) => [name, { ...pallet, frame: names.frame(pallet.frame) }]),
  );
  const frames = Object.fromEntries(Object.entries(other.frames).map(([name]) => [names.frame(name), undefined]));
  const all: Names = { ...names, pallet: tableNames(program.pallets, pallets, numbered, { ...places, ...frames }) };
  const renamed = (steps: readonly Step[]): readonly Step[] => steps.map(step => renamedStep(step, all, other.pallets));
  const put = <Entry>(own: Readonly<Record<string, Entry>>, more: Readonly<Record<string, Entry>>, name: NameOf) => ({
    ...own,
    ...Object.fromEntries(Object.entries(more).map(([key, entry]) => [name(key), entry])),
  });
  let so: Program = {
    ...program,
    tools: put(program.tools, other.tools, all.tool),
    frames: put(program.frames, other.frames, all.frame),
    groups: put(program.groups, other.groups, all.group),
    signals: put(program.signals, other.signals, all.signal),
    pallets: put(program.pallets, pallets, all.pallet),
  };
  const variables = put(program.variables ?? {}, other.variables ?? {}, all.variable);
  if (Object.keys(variables).length > 0) so = { ...so, variables };
  const own = Object.entries(other.parameters ?? {}).map(
    ([routine, types]) => [all.routine(routine), put({}, types, all.variable)] as const,
  );
  if (own.length > 0) so = { ...so, parameters: { ...program.parameters, ...Object.fromEntries(own) } };
  const main = other.steps.at(-1)?.type === "stop" ? other.steps.slice(0, -1) : other.steps;
  const steps = withFreshIds(so, [...firstValues(other, all.variable), ...renamed(main)]);
  for (const [name, list] of Object.entries(other.routines)) {
    const fresh = withFreshIds({ ...so, steps: [...so.steps, ...steps] }, renamed(list));
    so = { ...so, routines: { ...so.routines, [all.routine(name)]: fresh } };
  }
  return { program: so, steps };
}

/** A name that no routine of the program has. */
export function freeRoutineName({ routines }: Pick<Program, "routines">, wanted: string): string {
  for (let n = 1; ; n++) {
    const name = n === 1 ? wanted : `${wanted} ${n}`;
    if (!Object.hasOwn(routines, name)) return name;
  }
}

interface Names {
  readonly tool: NameOf;
  readonly frame: NameOf;
  readonly pallet: NameOf;
  readonly signal: NameOf;
  readonly variable: NameOf;
  readonly group: NameOf;
  readonly routine: NameOf;
}

const builtIn =
  (name: string, others: NameOf): NameOf =>
  wanted =>
    wanted === name ? name : others(wanted);
const parameters = (program: Program): Table => Object.assign({}, ...Object.values(program.parameters ?? {})) as Table;
const sameEntry = (a: unknown, b: unknown): boolean => JSON.stringify(a) === JSON.stringify(b);

/**
 * Where entries of `more` go in a program that has `own`: to the same name when it is free or means the same, else to
 * the next free number. `taken`: names that mean something else.
 */
function tableNames(own: Table, more: Table, numbered: (name: string, n: number) => string, taken: Table = {}): NameOf {
  const found = new Map<string, string>();
  const used = new Set<string>();
  for (const [name, entry] of Object.entries(more)) {
    const shared = Object.hasOwn(own, name) && !Object.hasOwn(taken, name) && sameEntry(own[name], entry);
    const isFree = (each: string): boolean =>
      !used.has(each) &&
      !Object.hasOwn(own, each) &&
      !Object.hasOwn(taken, each) &&
      (each === name || !Object.hasOwn(more, each));
    let free = name;
    for (let n = 2; !shared && !isFree(free); n++) free = numbered(name, n);
    used.add(free);
    found.set(name, free);
  }
  return name => found.get(name) ?? name;
}

/** Names for variables and parameters of the other program: none is that of a line, a variable or a parameter here. */
function variableNames(program: Program, other: Program, lines: NameOf): NameOf {
  const taken: Record<string, unknown> = {
    ...program.signals,
    ...program.variables,
    ...parameters(program),
    ...Object.fromEntries(Object.keys(other.signals).map(name => [lines(name), undefined])),
  };
  const wanted = new Set([...Object.keys(other.variables ?? {}), ...Object.keys(parameters(other))]);
  const found = new Map<string, string>();
  for (const name of wanted) {
    let free = name;
    for (let n = 2; variableNameFault(free, taken) !== undefined; n++) free = `${name.slice(0, 20)}_${n}`;
    taken[free] = undefined;
    found.set(name, free);
  }
  return name => found.get(name) ?? name;
}

/** What the other program counts on: each variable that it changes begins as it says. */
function firstValues(other: Program, nameOf: NameOf): readonly AssignStep[] {
  const assigned = new Set(
    Array.from(everyStep(other)).flatMap(step => (step.type === "assign" ? [step.variable] : [])),
  );
  return Object.entries(other.variables ?? {}).flatMap(([name, variable]) =>
    assigned.has(name) ? [{ id: `s-${name}`, type: "assign", variable: nameOf(name), to: first(variable) }] : [],
  );
}
function first(variable: Variable): Expression {
  const value = initialOf(variable);
  const unit: Unit | undefined = variable.type === "num" ? variable.unit : undefined;
  return typeof value === "number" && unit !== undefined ? { value, unit } : value;
}

function renamedStep(step: Step, names: Names, pallets: Table): Step {
  const { group } = step;
  const own = withNames(step, names, pallets);
  const grouped = group === undefined ? own : { ...own, group: names.group(group) };
  return withLists(grouped, list => list.map(each => renamedStep(each, names, pallets)));
}

function withNames(step: Step, names: Names, pallets: Table): Step {
  const expression = (of: Expression): Expression =>
    withLeaves(of, leaf => {
      if (typeof leaf !== "object") return leaf;
      if ("variable" in leaf) return { variable: names.variable(leaf.variable) };
      return "signal" in leaf ? { signal: names.signal(leaf.signal) } : leaf;
    });
  const predicate = (when: Predicate): Predicate =>
    "expression" in when ? { expression: expression(when.expression) } : { ...when, signal: names.signal(when.signal) };
  const target = (of: Target): Target => {
    if ("q" in of) return of.tool === undefined ? of : { ...of, tool: names.tool(of.tool) };
    const frame = Object.hasOwn(pallets, of.frame) ? names.pallet(of.frame) : names.frame(of.frame);
    return { ...of, frame, tool: names.tool(of.tool) };
  };
  switch (step.type) {
    case "move": {
      const until: { until?: Search } =
        step.until === undefined
          ? {}
          : { until: { ...step.until, when: { ...step.until.when, signal: names.signal(step.until.when.signal) } } };
      const via = step.via === undefined ? {} : { via: target(step.via) };
      return { ...step, target: target(step.target), ...via, ...until };
    }
    case "set":
      return { ...step, signal: names.signal(step.signal) };
    case "wait-for":
    case "if":
    case "while":
      return { ...step, when: predicate(step.when) };
    case "assign":
      return { ...step, variable: names.variable(step.variable), to: expression(step.to) };
    case "call":
      return {
        ...step,
        routine: names.routine(step.routine),
        ...(step.arguments === undefined
          ? {}
          : {
              arguments: Object.fromEntries(
                Object.entries(step.arguments).map(([name, value]) => [names.variable(name), expression(value)]),
              ),
            }),
      };
    case "pallet":
      return { ...step, pallet: names.pallet(step.pallet) };
    default:
      return step;
  }
}
