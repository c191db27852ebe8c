import type { CallStep, Program, Step } from "@twincell/core";

/**
 * The same program in routines of at most so many steps that are called one after the other, for controllers that hold
 * no longer ones. A list is cut only where the robot stands: behind a motion that is not passed, or behind what is
 * none. Calls carry the id of the first step that they lead to.
 *
 * @param most  steps of a list, without those inside its blocks. A list that cannot be cut stays longer.
 */
export function inParts(program: Program, most: number): Program {
  const routines: Record<string, readonly Step[]> = {};
  const taken = new Set(Object.keys(program.routines));
  const cut = (name: string, steps: readonly Step[]): readonly Step[] => {
    if (steps.length <= most) return steps;
    return parts(steps, most).map((part, i): CallStep => {
      let own = `${name} ${i + 1}`;
      for (let k = 2; taken.has(own); k++) own = `${name} ${i + 1} ${k}`;
      taken.add(own);
      routines[own] = part;
      return { id: part[0]!.id, type: "call", routine: own };
    });
  };
  const steps = cut(program.name, program.steps);
  for (const [name, list] of Object.entries(program.routines)) routines[name] = cut(name, list);
  return { ...program, steps, routines };
}

function parts(steps: readonly Step[], most: number): (readonly Step[])[] {
  const found: (readonly Step[])[] = [];
  for (let from = 0; from < steps.length; ) {
    let to = Math.min(from + most, steps.length);
    if (to < steps.length) {
      while (to > from && !stands(steps, to)) to--;
      if (to === from) {
        to = from + most;
        while (to < steps.length && !stands(steps, to)) to++;
      }
    }
    found.push(steps.slice(from, to));
    from = to;
  }
  return found;
}

/** Whether the robot stands before the step. */
function stands(steps: readonly Step[], at: number): boolean {
  const before = lastBefore(steps, at);
  return (
    before?.type !== "move" || (before.path !== "spline" && before.blend_m === 0 && (before.blend_ratio ?? 0) === 0)
  );
}

function lastBefore(steps: readonly Step[], at: number): Step | undefined {
  for (let i = at - 1; i >= 0; i--) if (steps[i]!.type !== "comment") return steps[i];
  return undefined;
}
