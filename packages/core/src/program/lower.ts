import type { Capability } from "./capabilities.ts";
import { initialOf, withLeaves, type Expression, type Variable } from "./expression/expression.ts";
import { variableNameFault } from "./read/variables.ts";
import { expressionOf } from "./predicate.ts";
import type { CallStep, Predicate, Program, Step, WaitForStep } from "./program.ts";
import { everyStep, withLists } from "./walk.ts";

/** A wait that is written as a loop looks at its condition this often [s]. */
export const POLL_S = 0.02;

/** What programmers write where their language has no statement for it. */
export type Lowering = Extract<Capability, "arguments" | "late" | "timeout" | "wait-expression" | "truth-values">;

interface Lack {
  readonly what: Capability;
}

/**
 * The same program without what a language has no statement for: first values of variables and arguments become
 * assignments, a wait with a limit a loop that counts, a wait for an expression a loop that looks, and what is yes or
 * no is set on both sides of a decision. Steps made of one step keep its id. A program that uses none of it is
 * returned as it is.
 */
export function lowered(
  program: Program,
  { idioms = [], cannot = [] }: { readonly idioms?: readonly Capability[]; readonly cannot?: readonly Lack[] },
): Program {
  const passes = new Lowered(program, new Set(idioms), !cannot.some(({ what }) => what === "message"));
  return passes.whole();
}

class Lowered {
  private readonly program: Program;
  private readonly idioms: ReadonlySet<Capability>;
  /** Whether the language can say something to whoever stands at the robot. */
  private readonly speaks: boolean;
  private readonly variables: Record<string, Variable>;
  private readonly parameters = new Map<string, ReadonlyMap<string, string>>();

  constructor(program: Program, idioms: ReadonlySet<Capability>, speaks: boolean) {
    this.program = program;
    this.speaks = speaks;
    this.idioms = idioms;
    this.variables = { ...program.variables };
    if (!idioms.has("arguments")) return;
    for (const [routine, own] of Object.entries(program.parameters ?? {}))
      this.parameters.set(
        routine,
        new Map(Object.entries(own).map(([name, type]) => [name, this.fresh(`${routine}_${name}`, type)])),
      );
  }

  whole(): Program {
    const { program } = this;
    const isNew = Object.keys(this.variables).length > 0 || Array.from(everyStep(program)).some(s => this.changes(s));
    if (!isNew) return program;
    const steps = [...this.first(), ...this.list(program.steps, undefined)];
    const routines = Object.fromEntries(
      Object.entries(program.routines).map(([name, list]) => [name, this.list(list, this.parameters.get(name))]),
    );
    const parameters = this.parameters.size > 0 ? {} : program.parameters;
    return { ...program, variables: this.variables, parameters: parameters ?? {}, steps, routines };
  }

  /** A controller keeps its variables from run to run: the program says what they begin with. */
  private first(): readonly Step[] {
    return Object.entries(this.program.variables ?? {}).map(([variable, type]): Step => {
      const value = initialOf(type);
      const hasUnit = type.type === "num" && type.unit !== undefined && typeof value === "number";
      return { id: "", type: "assign", variable, to: hasUnit ? { value, unit: type.unit! } : value };
    });
  }

  private changes(step: Step): boolean {
    if (step.type === "assign")
      return (
        this.idioms.has("truth-values") &&
        this.variables[step.variable]?.type === "bool" &&
        typeof step.to !== "boolean"
      );
    if (step.type !== "wait-for") return false;
    return (
      ("expression" in step.when && this.idioms.has("wait-expression")) ||
      (step.timeout_s !== undefined && this.idioms.has("timeout")) ||
      (step.late !== undefined && this.idioms.has("late"))
    );
  }

  /** A name that no variable and no signal has. */
  private fresh(wanted: string, variable: Variable): string {
    const taken: Record<string, unknown> = { ...this.program.signals, ...this.variables };
    for (const own of Object.values(this.program.parameters ?? {})) Object.assign(taken, own);
    const plain = wanted.replace(/[^A-Za-z0-9_]+/g, "_").replace(/^[^A-Za-z]+/, "");
    for (let i = 1; ; i++) {
      const tail = i === 1 ? "" : `_${i}`;
      const name = `${(plain || "value").slice(0, 24 - tail.length)}${tail}`;
      if (variableNameFault(name, taken) !== undefined) continue;
      this.variables[name] = variable;
      return name;
    }
  }

  private list(steps: readonly Step[], names: ReadonlyMap<string, string> | undefined): readonly Step[] {
    return steps.flatMap(step => this.step(this.renamed(step, names), names));
  }

  /** A step with the parameters of its routine under their own names. */
  private renamed(step: Step, names: ReadonlyMap<string, string> | undefined): Step {
    if (names === undefined) return step;
    const inside = (expression: Expression): Expression =>
      withLeaves(expression, leaf =>
        typeof leaf === "object" && "variable" in leaf && names.has(leaf.variable)
          ? { variable: names.get(leaf.variable)! }
          : leaf,
      );
    const asked = (when: Predicate): Predicate =>
      "expression" in when ? { expression: inside(when.expression) } : when;
    switch (step.type) {
      case "assign":
        return { ...step, to: inside(step.to) };
      case "call":
        return step.arguments === undefined
          ? step
          : {
              ...step,
              arguments: Object.fromEntries(
                Object.entries(step.arguments).map(([name, value]) => [name, inside(value)]),
              ),
            };
      case "if":
      case "while":
      case "wait-for":
        return { ...step, when: asked(step.when) } as Step;
      default:
        return step;
    }
  }

  private step(step: Step, names: ReadonlyMap<string, string> | undefined): readonly Step[] {
    if (step.type === "call") return this.call(step);
    if (step.type === "wait-for" && this.changes(step)) return this.wait(step, names);
    if (step.type === "assign" && this.changes(step)) {
      const { id, variable, to } = step;
      const set = (value: boolean): readonly Step[] => [{ id, type: "assign", variable, to: value }];
      return [{ id, ...titleOf(step), type: "if", when: { expression: to }, then: set(true), else: set(false) }];
    }
    return [withLists(step, list => this.list(list, names))];
  }

  private call(step: CallStep): readonly Step[] {
    const names = this.parameters.get(step.routine);
    if (step.arguments === undefined || names === undefined) return [step];
    const { arguments: given, ...call } = step;
    const assigned = Object.entries(given).map(([name, to]): Step => {
      return { id: step.id, type: "assign", variable: names.get(name)!, to };
    });
    return [...assigned.flatMap(each => this.step(each, undefined)), call];
  }

  private wait(step: WaitForStep, names: ReadonlyMap<string, string> | undefined): readonly Step[] {
    const { id, timeout_s } = step;
    const named = titleOf(step);
    const missing: Expression = { op: "not", of: [expressionOf(step.when)] };
    const look: Step = { id, type: "wait", s: POLL_S };
    if (timeout_s === undefined) return [{ id, ...named, type: "while", when: { expression: missing }, steps: [look] }];
    const looks = this.fresh("looks", { type: "int" });
    const isEarly: Expression = {
      op: "<",
      of: [{ variable: looks }, Math.max(1, Math.ceil(timeout_s / POLL_S - 1e-9))],
    };
    const late: readonly Step[] =
      step.late === undefined
        ? [...(this.speaks ? [{ id, type: "message", text: "Waited too long" } as const] : []), { id, type: "stop" }]
        : this.list(step.late, names);
    return [
      { id, ...named, type: "assign", variable: looks, to: 0 },
      {
        id,
        type: "while",
        when: { expression: { op: "and", of: [missing, isEarly] } },
        steps: [look, { id, type: "assign", variable: looks, to: { op: "+", of: [{ variable: looks }, 1] } }],
      },
      { id, type: "if", when: { expression: missing }, then: late },
    ];
  }
}

const titleOf = ({ name, group }: Step): Pick<Step, "name" | "group"> => ({
  ...(name === undefined ? {} : { name }),
  ...(group === undefined ? {} : { group }),
});
