import type { TextFault } from "@twincell/core";
import { TextError, textFault } from "../../parser/index.ts";
import type { Block, Expression, Routine, Statement } from "../../parser/structured/index.ts";
import type { Action, Fate } from "./actions.ts";
import { readListings, type PositionRecord } from "./listing.ts";
import type { RegisterValues } from "./register-files.ts";
import { readStatements } from "./statements.ts";

export interface Source {
  readonly title: string;
  readonly main: Routine;
  /** All programs by name, lower case, the first among them. */
  readonly routines: ReadonlyMap<string, Routine>;
  readonly positions: ReadonlyMap<string, ReadonlyMap<number, PositionRecord>>;
  readonly actions: ReadonlyMap<Statement, Action>;
  /** What becomes of a search or a wait whose label is taken. */
  readonly fates: ReadonlyMap<Statement, Fate>;
  /** What people call lines and registers, by "do5" and the like. */
  readonly labels: ReadonlyMap<string, string>;
  readonly spelling: ReadonlyMap<string, string>;
  /** Values of registers that files beside the listings hold. */
  readonly registers: RegisterValues;
  /** What is kept and shown but not executed; nothing of it moves the robot. */
  readonly kept: readonly TextFault[];
  /** Jumps that are neither a loop without end nor a decision. */
  readonly hasJumps: boolean;
}
export type SourceAnswer =
  | { readonly kind: "source"; readonly source: Source }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/** Reads one listing or several, one behind the other; the first is the one that is started. */
export function readSource(text: string): SourceAnswer {
  const labels = new Map<string, string>();
  try {
    const { programs, registers } = readListings(text, (word, number, name) => {
      const key = `${word.toLowerCase()}${number}`;
      if (name !== "" && !labels.has(key)) labels.set(key, name);
    });
    const routines = new Map<string, Routine>();
    const positions = new Map<string, ReadonlyMap<number, PositionRecord>>();
    const spelling = new Map<string, string>();
    const faults: TextFault[] = [];
    const actions = new Map<Statement, Action>();
    const fates = new Map<Statement, Fate>();
    const kept: TextFault[] = [];
    let hasJumps = false;
    let title = "";
    for (const { name, comment, code, positions: own, line, column } of programs) {
      const key = name.toLowerCase();
      if (routines.has(key))
        throw new TextError({ line, column }, "a name used once", `The program ${name} is there twice.`);
      const reading = readStatements(code);
      faults.push(...reading.faults);
      kept.push(...reading.kept, ...otherAxes(own));
      for (const [statement, action] of reading.actions) actions.set(statement, action);
      const body = new Jumps(reading.block, actions, fates);
      const made = body.structured();
      hasJumps ||= jumps(made, actions);
      if (routines.size === 0) title = titleOf(reading.block) ?? (comment === "" ? name : comment);
      routines.set(key, { name: key, parameters: [], body: made, line, column });
      positions.set(key, own);
      spelling.set(key, isSpelling(comment, name) ? comment : name);
    }
    if (faults.length > 0) return { kind: "not-understood", faults };
    return {
      kind: "source",
      source: {
        title,
        main: [...routines.values()][0]!,
        routines,
        positions,
        actions,
        fates,
        labels,
        spelling,
        registers,
        kept: kept.toSorted((a, b) => a.line - b.line),
        hasJumps,
      },
    };
  } catch (cause) {
    if (!(cause instanceof TextError)) throw cause;
    return { kind: "not-understood", faults: [cause.fault] };
  }
}

/** Further groups and axes of the positions, told once: they are kept and not moved. */
function otherAxes(positions: ReadonlyMap<number, PositionRecord>): readonly TextFault[] {
  const having = [...positions].filter(([, { others }]) => others !== "");
  const [first] = having;
  if (first === undefined) return [];
  const [number, { others, line, column }] = first;
  const more = having.length > 1 ? ` and ${having.length - 1} more positions` : "";
  return [
    textFault(
      { line, column },
      "the axes of one arm",
      `Further axes are kept and not moved: P[${number}] has ${others}${more === "" ? "" : `;${more} name theirs`}.`,
    ),
  ];
}

/** Whether a comment is the name with the signs that a name of a program cannot have. */
const isSpelling = (comment: string, name: string): boolean =>
  comment.replace(/[^A-Za-z0-9]+/g, "_").toLowerCase() === name.toLowerCase();

/** What the first remark `!* …` calls the program. */
function titleOf(block: Block): string | undefined {
  const first = block.find(statement => statement.kind === "comment");
  return first?.kind === "comment" && first.text.startsWith("*") ? first.text.slice(1).trim() : undefined;
}

/** Makes loops and decisions of the jumps that are written for them. */
class Jumps {
  private readonly block: Block;
  private readonly actions: Map<Statement, Action>;
  private readonly fates: Map<Statement, Fate>;
  /** How often a label is jumped to. */
  private readonly uses = new Map<number, number>();
  /** A jump goes to a label that is worked out: every label may be the one. */
  private anywhere = false;

  constructor(block: Block, actions: Map<Statement, Action>, fates: Map<Statement, Fate>) {
    this.block = block;
    this.actions = actions;
    this.fates = fates;
    this.count(block);
    this.judge(block);
  }

  structured(): Block {
    return this.anywhere ? this.block : this.shape(this.block);
  }

  private actionOf(statement: Statement | undefined): Action | undefined {
    return statement === undefined ? undefined : this.actions.get(statement);
  }

  private use(label: number): void {
    this.uses.set(label, (this.uses.get(label) ?? 0) + 1);
  }

  private count(block: Block): void {
    for (const statement of block) {
      const action = this.actionOf(statement);
      const label = leadsTo(action);
      if (label !== undefined) this.use(label);
      if (action?.kind === "jump-to") this.anywhere = true;
      for (const inner of inside(statement)) this.count(inner);
    }
  }

  /** Where the labels of searches and waits lead. */
  private judge(block: Block): void {
    for (const [i, statement] of block.entries()) {
      const action = this.actionOf(statement);
      const label = action?.kind === "motion" ? action.skip : action?.kind === "wait-for" ? action.label : undefined;
      if (label !== undefined) this.fates.set(statement, this.fate(label, block, i));
      for (const inner of inside(statement)) this.judge(inner);
    }
  }

  private fate(label: number, block: Block, from: number): Fate {
    const is = (statement: Statement | undefined): boolean => {
      const action = this.actionOf(statement);
      return action?.kind === "label" && action.label === label;
    };
    const next = block.slice(from + 1).find(({ kind }) => kind !== "comment");
    if (is(next)) return "on";
    const at = this.block.findIndex(is);
    const then =
      at < 0
        ? undefined
        : this.block
            .slice(at + 1)
            .find(
              each =>
                each.kind !== "comment" &&
                this.actionOf(each)?.kind !== "label" &&
                this.actionOf(each)?.kind !== "message",
            );
    return then?.kind === "halt" || this.actionOf(then)?.kind === "pause" ? "abort" : "elsewhere";
  }

  private shape(block: Block): Block {
    const out: Statement[] = [];
    for (const statement of block) {
      const action = this.actionOf(statement);
      if (action?.kind === "jump" && this.uses.get(action.label) === 1) {
        const from = this.labelIn(out, action.label);
        if (from >= 0 && this.isClosed(out.slice(from + 1))) {
          const { line, column } = out[from]!;
          const body = out.splice(from).slice(1);
          out.push({ kind: "while", when: { kind: "truth", value: true, line, column }, body, line, column });
          continue;
        }
      }
      if (action?.kind === "label" && this.uses.get(action.label) === 1) {
        const from = out.findIndex(each => this.skips(each, action.label));
        const start = out[from];
        if (start?.kind === "if" && this.isClosed(out.slice(from + 1))) {
          const body = out.splice(from).slice(1);
          const when: Expression = {
            kind: "unary",
            sign: "!",
            of: start.branches[0]!.when,
            line: start.line,
            column: start.column,
          };
          out.push({ kind: "if", branches: [{ when, body }], line: start.line, column: start.column });
          continue;
        }
      }
      out.push(this.inner(statement));
    }
    return out;
  }

  /** Whether no jump from outside leads to a label among these statements, which then can be the body of a block. */
  private isClosed(body: Block): boolean {
    const labels = new Set<number>();
    const within = new Map<number, number>();
    const look = (block: Block): void => {
      for (const statement of block) {
        const action = this.actionOf(statement);
        if (action?.kind === "label") labels.add(action.label);
        const to = leadsTo(action);
        if (to !== undefined) within.set(to, (within.get(to) ?? 0) + 1);
        for (const inner of inside(statement)) look(inner);
      }
    };
    look(body);
    return [...labels].every(label => (within.get(label) ?? 0) === (this.uses.get(label) ?? 0));
  }

  private labelIn(block: Block, label: number): number {
    return block.findIndex(each => {
      const action = this.actionOf(each);
      return action?.kind === "label" && action.label === label;
    });
  }

  /** `IF …,JMP LBL[n]` */
  private skips(statement: Statement, label: number): boolean {
    if (statement.kind !== "if" || statement.otherwise !== undefined || statement.branches[0]!.body.length !== 1)
      return false;
    const action = this.actionOf(statement.branches[0]!.body[0]);
    return action?.kind === "jump" && action.label === label;
  }

  private inner(statement: Statement): Statement {
    switch (statement.kind) {
      case "if": {
        const { otherwise } = statement;
        const branches = statement.branches.map(({ when, body }) => ({ when, body: this.shape(body) }));
        return otherwise === undefined
          ? { ...statement, branches }
          : { ...statement, branches, otherwise: this.shape(otherwise) };
      }
      case "for":
      case "while":
        return { ...statement, body: this.shape(statement.body) };
      default:
        return statement;
    }
  }
}

/** The label that a jump goes to; a search or a wait may go on at its label too. */
function leadsTo(action: Action | undefined): number | undefined {
  switch (action?.kind) {
    case "jump":
      return action.label;
    case "motion":
      return action.skip;
    case "wait-for":
      return action.label;
    default:
      return undefined;
  }
}

const jumps = (block: Block, actions: ReadonlyMap<Statement, Action>): boolean =>
  block.some(
    statement =>
      actions.get(statement)?.kind === "jump" ||
      actions.get(statement)?.kind === "jump-to" ||
      inside(statement).some(each => jumps(each, actions)),
  );

function inside(statement: Statement): readonly Block[] {
  switch (statement.kind) {
    case "if":
      return [
        ...statement.branches.map(({ body }) => body),
        ...(statement.otherwise === undefined ? [] : [statement.otherwise]),
      ];
    case "for":
    case "while":
      return [statement.body];
    default:
      return [];
  }
}
