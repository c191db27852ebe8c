import type { Condition, Executed, Group, Pallet, Pose, Step, TextFault, TextPlace } from "@twincell/core";
import { TextError, textFault } from "../faults.ts";
import type { BlockMachine, Flow } from "./machine.ts";
import { fitPallet } from "./pallet.ts";
import { isSteady } from "./steady.ts";
import type { Block, Expression, Statement } from "./tree.ts";

/** A machine whose program can be written down as steps instead of being carried out. */
export interface OutlineMachine<V> extends BlockMachine<V> {
  /** The condition of one line that an expression is, if it is one. */
  condition(when: Extract<Statement, { kind: "if" }>["branches"][number]["when"]): Condition | undefined;
  /** Variables that are frames although they change. */
  readonly places: Set<string>;
  /** The pose in a variable, with the frame it is given in; undefined when it holds none. */
  placeIn(variable: string): { readonly frame: string; readonly pose: Pose<"frame", "place"> } | undefined;
  /** What was said before holds here, but is said anew: a block begins or has ended. */
  edge(): void;
  /** Remembers how things stand; the answer brings that back. */
  remember(): () => void;
}

/** More steps than this are taken for a program that repeats itself for ever. */
const MOST_STEPS = 200_000;
/** Rounds of a loop that are compared one by one. */
const MOST_LOOKS = 50;

type Loop = Extract<Statement, { kind: "while" | "for" }>;
/** A loop that counts: its variable, how it runs, and its body without the counting. */
interface Counter {
  readonly name: string;
  readonly from: number;
  readonly step: number;
  readonly times: number;
  readonly body: Block;
}

/**
 * Writes a program down as steps that keep its loops, decisions and calls. Loops that do something else each time are
 * written out.
 */
export class Outline<V> {
  readonly groups: Record<string, Group> = {};
  readonly routines: Record<string, readonly Step[]> = {};
  readonly pallets: Record<string, Pallet> = {};
  readonly warnings: TextFault[] = [];
  private readonly machine: OutlineMachine<V>;
  private readonly spelt: (name: string) => string;
  /** Routines that end the whole program. */
  private readonly endsAll = new Set<string>();
  private name: string | undefined;
  private group: string | undefined;
  private groupCount = 0;
  private count = 0;

  /** @param spelt  a name as the text has it, where the language does not tell capital letters from small ones. */
  constructor(machine: OutlineMachine<V>, spelt: (name: string) => string = name => name) {
    this.machine = machine;
    this.spelt = spelt;
  }

  /** @throws {TextError} where the text cannot be executed, or leaves a block in a way that steps cannot. */
  steps(block: Block): Step[] {
    const steps: Step[] = [];
    this.block(block, steps);
    return steps;
  }

  private block(block: Block, out: Step[]): Flow {
    for (const statement of block) {
      const flow = this.statement(statement, out);
      if (flow !== "next") return flow;
    }
    return "next";
  }

  private statement(statement: Statement, out: Step[]): Flow {
    const { machine } = this;
    switch (statement.kind) {
      case "comment":
        this.comment(statement.text, out);
        return "next";
      case "if":
        return this.decision(statement, out);
      case "while":
      case "for":
        return this.loop(statement, out);
      case "do": {
        const routine = machine.routine(statement.name);
        if (routine === undefined || statement.args.length > 0 || routine.parameters.length > 0)
          return this.run(machine.statement(statement), out);
        const name = this.spelt(routine.name);
        const step = this.dress();
        if (!Object.hasOwn(this.routines, name)) {
          this.routines[name] = [];
          const inside: Step[] = [];
          if (
            this.fresh(() => {
              this.group = undefined;
              return machine.inside(routine, () => this.block(routine.body, inside));
            }) === "halt"
          )
            this.endsAll.add(name);
          this.routines[name] = inside;
        }
        machine.edge();
        this.add(out, { ...step, type: "call", routine: name }, statement);
        return this.endsAll.has(name) ? "halt" : "next";
      }
      case "goto":
        throw new TextError(statement, "blocks instead of GOTO", "Steps know no GOTO: run the text as it is.");
      default:
        return this.run(machine.statement(statement), out);
    }
  }

  private run(executed: Generator<Executed, Flow>, out: Step[]): Flow {
    for (;;) {
      const next = executed.next();
      if (next.done === true) return next.value;
      const { step, line } = next.value;
      if (step !== undefined) this.add(out, { ...step, ...this.dress() }, { line, column: 1 });
    }
  }

  private add(out: Step[], step: Step, at: TextPlace): void {
    if (out.length >= MOST_STEPS)
      throw new TextError(
        at,
        "a program that ends",
        `The program has more than ${MOST_STEPS} steps: it repeats itself for ever.`,
      );
    out.push(step);
  }

  /** Id, name and group of the next step. */
  private dress(): { readonly id: string; readonly name?: string; readonly group?: string } {
    const { name, group } = this;
    this.name = undefined;
    return {
      id: `s${++this.count}`,
      ...(name === undefined ? {} : { name }),
      ...(group === undefined ? {} : { group }),
    };
  }

  /** A name before a step, `== name` before a group of steps, `- text` for a remark, `*` for neither. */
  private comment(text: string, out: Step[]): void {
    if (text.startsWith("==")) {
      const title = text.replace(/^=+\s*/, "");
      this.group = title === "" ? undefined : `g${++this.groupCount}`;
      if (this.group !== undefined) this.groups[this.group] = { name: title };
    } else if (text.startsWith("-"))
      out.push({
        id: `s${++this.count}`,
        type: "comment",
        text: text.slice(1).trim(),
        ...(this.group === undefined ? {} : { group: this.group }),
      });
    else if (text !== "" && !text.startsWith("*")) this.name = text;
  }

  /** Inside a block names and groups begin anew. */
  private fresh<T>(read: () => T): T {
    const { group } = this;
    this.name = undefined;
    this.machine.edge();
    const answer = read();
    this.machine.edge();
    this.group = group;
    this.name = undefined;
    return answer;
  }

  private decision(statement: Extract<Statement, { kind: "if" }>, out: Step[]): Flow {
    const { machine } = this;
    const [first, ...others] = statement.branches;
    const when = machine.condition(first!.when);
    if (when === undefined) {
      for (const { when: each, body } of statement.branches) if (machine.isTrue(each)) return this.block(body, out);
      return statement.otherwise === undefined ? "next" : this.block(statement.otherwise, out);
    }
    const step = this.dress();
    const then: Step[] = [];
    const otherwise: Step[] = [];
    const back = machine.remember();
    const flows = [this.fresh(() => this.block(first!.body, then))];
    const rest: Block = others.length > 0 ? [{ ...statement, branches: others }] : (statement.otherwise ?? []);
    const after = machine.remember();
    back();
    flows.push(this.fresh(() => this.block(rest, otherwise)));
    after();
    if (flows.some(flow => flow !== "next" && flow !== "halt"))
      throw new TextError(
        statement,
        "a decision that goes on behind its end",
        "The decision leaves its block, which steps cannot.",
      );
    this.add(
      out,
      {
        ...step,
        type: "if",
        when,
        then,
        ...(otherwise.length === 0 && others.length === 0 && statement.otherwise === undefined
          ? {}
          : { else: otherwise }),
      },
      statement,
    );
    return "next";
  }

  private loop(statement: Loop, out: Step[]): Flow {
    const { machine } = this;
    if (statement.kind === "while" && isForever(statement))
      return this.repeat(statement, "forever", statement.body, out);
    const counter = this.counter(statement);
    if (counter !== undefined && counter.times > 0) {
      if (this.pallet(statement, counter, out)) return "next";
      const back = machine.remember();
      const { count, groupCount, name, group } = this;
      const isSame = this.isSame(counter);
      back();
      this.count = count;
      this.groupCount = groupCount;
      this.name = name;
      this.group = group;
      if (isSame) {
        machine.setCount(counter.name, counter.from);
        const flow = this.repeat(statement, counter.times, counter.body, out);
        machine.setCount(counter.name, counter.from + counter.step * counter.times);
        return flow;
      }
    }
    const before = out.length;
    const flow = this.run(machine.statement(statement), out);
    if (out.length > before)
      this.warnings.push(
        textFault(
          statement,
          "a loop that does the same each time",
          `The loop of line ${statement.line} was written out: it became ${out.length - before} steps.`,
        ),
      );
    return flow;
  }

  private repeat(statement: Loop, times: number | "forever", body: Block, out: Step[]): Flow {
    const step = this.dress();
    const steps: Step[] = [];
    const flow = this.fresh(() => this.block(body, steps));
    if (flow !== "next" && flow !== "halt")
      throw new TextError(
        statement,
        "a loop that runs to its end",
        "The loop is left from inside, which steps cannot.",
      );
    this.add(out, { ...step, type: "repeat", times, steps }, statement);
    return "next";
  }

  /**
   * Whether every round does the same. Where a variable tells the rounds apart all of them are looked at, as long as
   * they are few.
   */
  private isSame({ name, from, step, times, body }: Counter): boolean {
    const looks = Math.min(times, isSteady(body, name, routine => this.machine.routine(routine)) ? 2 : MOST_LOOKS + 1);
    if (looks > MOST_LOOKS) return false;
    let first: string | undefined;
    for (let i = 0; i < looks; i++) {
      this.machine.setCount(name, from + step * i);
      const round = this.trial(body);
      if (round === undefined || (i > 0 && round !== first)) return false;
      first = round;
    }
    return true;
  }

  /** The steps of a body as one text to compare; undefined when it leaves the loop. */
  private trial(body: Block): string | undefined {
    const steps: Step[] = [];
    const { warnings, count, groupCount } = this;
    const kept = warnings.length;
    const flow = this.fresh(() => this.block(body, steps));
    warnings.length = kept;
    this.count = count;
    this.groupCount = groupCount;
    return flow === "next" ? JSON.stringify(steps) : undefined;
  }

  /** `for i`, or `while i < n: … i = i + 1 end` where nothing else changes i. */
  private counter(statement: Loop): Counter | undefined {
    const { machine } = this;
    if (statement.kind === "for") {
      const [from, last, step] = machine.counting(statement);
      return step === 0
        ? undefined
        : {
            name: statement.variable,
            from,
            step,
            times: Math.max(0, Math.floor((last - from) / step + 1e-9) + 1),
            body: statement.body,
          };
    }
    const { when, body } = statement;
    const end = body.findLast(({ kind }) => kind !== "comment");
    if (
      when.kind !== "binary" ||
      when.left.kind !== "variable" ||
      (when.sign !== "<" && when.sign !== "<=") ||
      end?.kind !== "assign"
    )
      return undefined;
    const { name } = when.left;
    const { to, value } = end;
    if (
      to.kind !== "variable" ||
      to.name !== name ||
      value.kind !== "binary" ||
      value.sign !== "+" ||
      value.left.kind !== "variable" ||
      value.left.name !== name ||
      value.right.kind !== "number"
    )
      return undefined;
    const step = value.right.value;
    const rest = body.filter(each => each !== end);
    if (!(step > 0) || assigns(rest, name)) return undefined;
    const from = machine.numberOf(when.left);
    const limit = machine.numberOf(when.right);
    const times =
      when.sign === "<" ? Math.ceil((limit - from) / step - 1e-9) : Math.floor((limit - from) / step + 1e-9) + 1;
    return { name, from, step, times: Math.max(0, times), body: rest };
  }

  /** A nest of loops that puts place after place of a pattern into one variable, and does the same at each. */
  private pallet(statement: Loop, outer: Counter, out: Step[]): boolean {
    const found = this.nest(outer);
    if (found === undefined) return false;
    const { machine } = this;
    const { place, body, counts } = found;
    const variable = this.spelt(found.variable);
    const back = machine.remember();
    const wasPlace = machine.places.has(variable);
    const places: Pose<"frame", "place">[] = [];
    const visits: string[] = [];
    let frame: string | undefined;
    let same = true;
    let visit: Step[] = [];
    machine.places.add(variable);
    const close = (): void => {
      if (places.length > 0) visits.push(JSON.stringify(visit.map(step => ({ ...step, id: "" }))));
      visit = [];
    };
    try {
      for (const { line, step } of machine.statement(statement)) {
        if (step !== undefined) visit.push(step);
        else if (line === place.line) {
          close();
          const now = machine.placeIn(found.variable);
          same &&= now !== undefined && (frame === undefined || frame === now.frame);
          if (now !== undefined) {
            frame = now.frame;
            places.push(now.pose);
          }
          if (places.length > MOST_STEPS) same = false;
        }
        if (!same) break;
      }
    } finally {
      back();
    }
    close();
    const [layers, lines, inLine] = [1, 1, 1, ...counts].slice(-3);
    const pallet =
      same && counts.length <= 3 && visits.every(each => each === visits[0])
        ? fitPallet(places, frame ?? "world", layers!, lines!, inLine!)
        : undefined;
    if (pallet === undefined || this.isOtherPallet(variable, pallet)) {
      if (!wasPlace) machine.places.delete(variable);
      return false;
    }
    this.pallets[variable] = pallet;
    const step = this.dress();
    const steps: Step[] = [];
    for (const { name, from } of found.counters) machine.setCount(name, from);
    for (const each of found.before) this.silently(each);
    this.fresh(() => this.block(body, steps));
    this.add(out, { ...step, type: "pallet", pallet: variable, steps }, statement);
    return true;
  }

  private isOtherPallet(variable: string, pallet: Pallet): boolean {
    const known = Object.hasOwn(this.pallets, variable) ? this.pallets[variable] : undefined;
    return known !== undefined && JSON.stringify(known) !== JSON.stringify(pallet);
  }

  /** Executes a statement of which only the effect on variables counts. */
  private silently(statement: Statement): void {
    const doing = this.machine.statement(statement);
    while (doing.next().done !== true);
  }

  private nest(
    outer: Counter,
  ):
    | { variable: string; place: TextPlace; before: Block; body: Block; counts: number[]; counters: Counter[] }
    | undefined {
    const counts: number[] = [];
    const counters: Counter[] = [];
    const { machine } = this;
    const back = machine.remember();
    try {
      for (let counter: Counter | undefined = outer; counter !== undefined; ) {
        counts.push(counter.times);
        counters.push(counter);
        machine.setCount(counter.name, counter.from);
        const body: Block = counter.body.filter(({ kind }) => kind !== "comment");
        const loops = body.filter((each): each is Loop => each.kind === "while" || each.kind === "for");
        if (loops.length === 1 && !body.some(({ kind }) => kind === "do" || kind === "wait-until")) {
          for (const each of body) if (each.kind === "assign") this.silently(each); // the start of the inner counter
          counter = this.counter(loops[0]!);
          continue;
        }
        for (const [i, each] of counter.body.entries()) {
          if (each.kind === "comment") continue;
          if (each.kind !== "assign" && each.kind !== "if") return undefined;
          this.silently(each);
          const variable = each.kind === "assign" ? holder(each.to) : undefined;
          if (variable !== undefined && machine.placeIn(variable) !== undefined) {
            return {
              variable,
              place: each,
              before: counter.body.slice(0, i + 1),
              body: counter.body.slice(i + 1),
              counts,
              counters,
            };
          }
        }
        return undefined;
      }
      return undefined;
    } finally {
      back();
    }
  }
}

/** The variable that an assignment changes, as a whole or in part. */
function holder(to: Expression): string | undefined {
  let of = to;
  while (of.kind === "component" || of.kind === "index") of = of.of;
  return of.kind === "variable" ? of.name : undefined;
}

const isForever = ({ when }: Extract<Statement, { kind: "while" }>): boolean => when.kind === "truth" && when.value;

function assigns(block: Block, name: string): boolean {
  return block.some(statement => {
    switch (statement.kind) {
      case "assign":
        return holder(statement.to) === name;
      case "if":
        return (
          statement.branches.some(({ body }) => assigns(body, name)) ||
          (statement.otherwise !== undefined && assigns(statement.otherwise, name))
        );
      case "while":
      case "for":
        return assigns(statement.body, name);
      default:
        return false;
    }
  });
}
