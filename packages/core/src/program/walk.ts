import type { BlockStep, Program, Step } from "./program.ts";

/** The lists of steps directly inside a step. */
export function listsOf(step: Step): readonly (readonly Step[])[] {
  switch (step.type) {
    case "repeat":
    case "while":
    case "pallet":
      return [step.steps];
    case "wait-for":
      return step.late === undefined ? [] : [step.late];
    case "if":
      return step.else === undefined ? [step.then] : [step.then, step.else];
    default:
      return [];
  }
}

export const isBlock = (step: Step): step is BlockStep =>
  step.type === "repeat" || step.type === "while" || step.type === "if" || step.type === "pallet";

/** The same block with its lists put through `change`; the very same step when no list changed. */
export function withLists<S extends Step>(step: S, change: (steps: readonly Step[]) => readonly Step[]): S;
export function withLists(step: Step, change: (steps: readonly Step[]) => readonly Step[]): Step {
  switch (step.type) {
    case "wait-for": {
      const late = step.late === undefined ? undefined : change(step.late);
      return late === step.late || late === undefined ? step : { ...step, late };
    }
    case "repeat":
    case "while":
    case "pallet": {
      const steps = change(step.steps);
      return steps === step.steps ? step : { ...step, steps };
    }
    case "if": {
      const then = change(step.then);
      const otherwise = step.else === undefined ? undefined : change(step.else);
      if (then === step.then && otherwise === step.else) return step;
      return otherwise === undefined ? { ...step, then } : { ...step, then, else: otherwise };
    }
    default:
      return step;
  }
}

/** These steps and all that are inside them, as they are written: each before what is inside it. */
export function* everyIn(steps: readonly Step[]): Generator<Step, void> {
  for (const step of steps) {
    yield step;
    for (const list of listsOf(step)) yield* everyIn(list);
  }
}

/** Every step of a program once, as it is written: the main steps, then the routines. */
export function* everyStep(program: Pick<Program, "steps" | "routines">): Generator<Step, void> {
  yield* everyIn(program.steps);
  for (const steps of Object.values(program.routines)) yield* everyIn(steps);
}

export function stepById(program: Pick<Program, "steps" | "routines">, id: string): Step | undefined {
  for (const step of everyStep(program)) if (step.id === id) return step;
  return undefined;
}

/** Names of the routines that these steps call, directly or inside blocks. */
export function callsOf(steps: readonly Step[]): ReadonlySet<string> {
  const names = new Set<string>();
  for (const step of everyIn(steps)) if (step.type === "call") names.add(step.routine);
  return names;
}

/** Routines that come back to themselves, as the way round: ["a", "b", "a"]. Undefined when there are none. */
export function callCycle(routines: Program["routines"]): readonly string[] | undefined {
  const done = new Set<string>();
  const visit = (name: string, way: readonly string[]): readonly string[] | undefined => {
    if (way.includes(name)) return [...way.slice(way.indexOf(name)), name];
    if (done.has(name) || !Object.hasOwn(routines, name)) return undefined;
    for (const called of callsOf(routines[name]!)) {
      const cycle = visit(called, [...way, name]);
      if (cycle !== undefined) return cycle;
    }
    done.add(name);
    return undefined;
  };
  for (const name of Object.keys(routines)) {
    const cycle = visit(name, []);
    if (cycle !== undefined) return cycle;
  }
  return undefined;
}
