import type { Signals } from "../signals.ts";
import { palletCount, palletIndices, palletPitch, palletSlot } from "./pallet.ts";
import { compose, type Pose } from "../spatial/pose.ts";
import { PlainFault } from "../fault.ts";
import { evaluate, withValues, type Evaluated, type ExpressionValues } from "./expression/evaluate.ts";
import { initialOf, type Expression, type Value } from "./expression/expression.ts";
import { expressionOf, isPassedOver, predicateLines } from "./predicate.ts";
import type {
  AssignStep,
  CallStep,
  IfStep,
  MoveStep,
  PalletStep,
  Predicate,
  PrimitiveStep,
  Program,
  RepeatStep,
  Step,
  Target,
  WaitForStep,
  WhileStep,
} from "./program.ts";
import { SignalTable, holds } from "./signals.ts";
import { everyIn, isBlock } from "./walk.ts";

/** A place of a pallet that is being visited; `number` counts from 1. */
export interface PlaceVisit {
  readonly pallet: string;
  readonly number: number;
  readonly of: number;
  readonly frameFromPlace: Pose<"frame", "place">;
}

/** What a program does, in the order in which it does it. */
export type FlowEvent =
  /**
   * `written` is the step as the program has it; in `step` places have become poses, and variables values. `stands`
   * marks what the program does not say: a stop, or the time a loop takes to look again.
   */
  | {
      readonly kind: "step";
      readonly step: PrimitiveStep;
      readonly written: Step;
      readonly stands: boolean;
      readonly visits: readonly PlaceVisit[];
    }
  /** A comment, a call or a block is come to. */
  | { readonly kind: "passed"; readonly step: Step }
  /** A variable has a new value; undefined where inputs that are not known decide it. */
  | { readonly kind: "assigned"; readonly step: AssignStep; readonly value: Value | undefined }
  /** Both sides of a decision follow: fork, the one side, other, the other side, join. */
  | { readonly kind: "fork" | "other" | "join"; readonly step: IfStep | WhileStep | WaitForStep }
  /** What follows in this list, if anything, is never reached. */
  | { readonly kind: "end" }
  /** The program cannot go on. */
  | { readonly kind: "failed"; readonly step: Step; readonly why: FlowFailure };

/** Why a program cannot go on. */
export interface FlowFailure {
  readonly code: "program.expression" | "program.idle-loop";
  readonly sentence: string;
  readonly hint: string;
}

export interface FlowOptions {
  /** Decides when a decision is reached; undefined looks at both sides, unless variables alone decide. */
  readonly decide?: (when: Predicate, variable: ExpressionValues["variable"]) => boolean;
  /** What a line reads when a variable is given its value; needed with `decide` where programs assign lines. */
  readonly read?: (signal: string) => Value;
  /** Whether a wait that has steps for being late met its condition; looks at the condition again when left out. */
  readonly met?: (step: WaitForStep) => boolean;
  /** How often a loop "forever" goes round; for ever when left out. */
  readonly rounds?: number;
  /** How often a loop goes round that looks at lines; for ever when left out. */
  readonly lineRounds?: number;
  /** Loops go round twice only once so many steps have been done. */
  readonly mostSteps?: number;
}

/** Rounds of loops, one after the other, in which nothing happens and no line is looked at. More never end. */
export const MOST_IDLE_ROUNDS = 100_000;

/** What a loop that did nothing is given before it looks again, as the interpreter of a controller takes [s]. */
export const LOOK_AGAIN_S = 0.004;

/**
 * Carries out a program step by step: loops, calls, decisions and pallets become the primitive steps they amount to.
 * A step is made when it is asked for, so a decision is taken when the robot is there: a move that would be passed
 * stops before a block, before a call and at the end of a list.
 */
export function* flow(program: Program, options: FlowOptions = {}): Generator<FlowEvent, void> {
  yield* new Flow(program, options).list(program.steps, false);
}

/**
 * The primitive steps of a program as a robot executes them, in frames that the program has. It goes on for ever where
 * the program does. Without `signals` the lines only remember what the program writes.
 */
export function* unrolled(program: Program, signals: Signals = new SignalTable()): Generator<PrimitiveStep, void> {
  const deciding: FlowOptions = {
    decide: (when, variable) => holds(when, signals, variable),
    read: signal => signals.read(signal),
  };
  for (const happening of flow(program, deciding)) {
    if (happening.kind === "step") yield happening.step;
    if (happening.kind === "failed") {
      const { code, sentence, hint } = happening.why;
      throw new PlainFault(code, sentence, hint);
    }
  }
}

/** Whether the robot may go into the next step without a stop. */
const passesOn = (step: MoveStep): boolean =>
  step.until === undefined && (step.blend_m > 0 || (step.blend_ratio ?? 0) > 0 || step.path === "spline");

type Store = Map<string, Value | undefined>;

class Flow {
  private readonly program: Program;
  private readonly options: FlowOptions;
  private visits: readonly PlaceVisit[] = [];
  private made = 0;
  private ended = false;
  /** Rounds without a step and without a look at a line, one after the other. */
  private idle = 0;
  /** How often lines were looked at. */
  private looks = 0;
  /** What variables are worth; undefined where inputs decide. */
  private variables: Store = new Map();
  /** The same of the parameters of the routine being done. */
  private parameters: Store = new Map();

  constructor(program: Program, options: FlowOptions) {
    this.program = program;
    this.options = options;
    for (const [name, variable] of Object.entries(program.variables ?? {}))
      this.variables.set(name, initialOf(variable));
  }

  /** @param inside  the list is not the main one: it ends with a stop. */
  *list(steps: readonly Step[], inside: boolean): Generator<FlowEvent, void> {
    let passing: MoveStep | undefined;
    for (const step of steps) {
      if (isPassedOver(step)) {
        if (step.type === "assign") yield* this.assign(step);
        else yield { kind: "passed", step };
        if (this.ended) return;
        continue;
      }
      if (passing !== undefined && (isBlock(step) || step.type === "call" || step.type === "assign"))
        yield this.stand(passing, 0);
      passing = undefined;
      if (step.type === "move" && passesOn(step)) passing = step;
      yield* this.one(step);
      if (this.ended) return;
    }
    if (passing !== undefined && inside) yield this.stand(passing, 0);
  }

  /** One step of a list with everything inside it. */
  private *one(step: Step): Generator<FlowEvent, void> {
    switch (step.type) {
      case "comment":
        return;
      case "assign":
        yield { kind: "passed", step };
        return yield* this.assign(step);
      case "repeat":
        return yield* this.repeat(step);
      case "while":
        return yield* this.while(step);
      case "if":
        return yield* this.if(step);
      case "pallet":
        return yield* this.pallet(step);
      case "call":
        return yield* this.call(step);
      case "wait-for":
        return yield* this.waitFor(step);
      case "move":
        yield this.step(this.placed(step), step);
        return;
      case "stop":
        yield this.step(step, step);
        yield { kind: "end" };
        // Where both sides are looked at, the other side still follows.
        this.ended ||= this.options.decide !== undefined;
        return;
      default:
        yield this.step(step, step);
    }
  }

  private step(step: PrimitiveStep, written: Step): FlowEvent {
    this.made++;
    this.idle = 0;
    return { kind: "step", step, written, stands: false, visits: this.visits };
  }

  private stand(at: Step, s: number): FlowEvent {
    return { kind: "step", step: { id: at.id, type: "wait", s }, written: at, stands: true, visits: this.visits };
  }

  private readonly variable = (name: string): Value | undefined =>
    this.parameters.has(name) ? this.parameters.get(name) : this.variables.get(name);

  /** Where both sides are looked at, the other side still follows. */
  private *fail(step: Step, code: FlowFailure["code"], sentence: string, hint: string): Generator<FlowEvent, void> {
    this.ended = this.options.decide !== undefined;
    yield { kind: "failed", step, why: { code, sentence: `Step “${step.name ?? step.id}”: ${sentence}`, hint } };
    yield { kind: "end" };
  }

  private computed(expression: Expression): Evaluated {
    const { read } = this.options;
    const signal = (name: string): Value | undefined => {
      this.looks++;
      return read?.(name);
    };
    return evaluate(expression, { variable: this.variable, signal });
  }

  private *assign(step: AssignStep): Generator<FlowEvent, void> {
    const answer = this.computed(step.to);
    if (answer.kind === "failed")
      yield* this.fail(step, "program.expression", answer.sentence, "Look at the expression of the step.");
    const value = answer.kind === "value" ? this.fitted(step.variable, answer.value) : undefined;
    this.variables.set(step.variable, value);
    if (answer.kind !== "failed") yield { kind: "assigned", step, value };
  }

  /** A line that says 1 for yes is yes where yes or no is wanted. */
  private fitted(name: string, value: Value): Value {
    const type = this.program.variables?.[name]?.type;
    if (type === "bool") return value === true || (typeof value === "number" && value !== 0);
    return typeof value === "number" || type === undefined ? value : value ? 1 : 0;
  }

  private *call(step: CallStep): Generator<FlowEvent, void> {
    yield { kind: "passed", step };
    const given: Store = new Map();
    for (const [name, expression] of Object.entries(step.arguments ?? {})) {
      const answer = this.computed(expression);
      if (answer.kind === "failed") {
        yield* this.fail(step, "program.expression", answer.sentence, `Look at the value of “${name}”.`);
        return;
      }
      given.set(name, answer.kind === "value" ? answer.value : undefined);
    }
    const before = this.parameters;
    this.parameters = given;
    const { routines } = this.program;
    yield* this.list(Object.hasOwn(routines, step.routine) ? routines[step.routine]! : [], true);
    this.parameters = before;
  }

  /**
   * A round has ended. One in which nothing was done lets time pass, unless it only computes: that takes no time, and
   * one that does so without end is refused. Returns whether the loop may go on.
   */
  private *round(step: RepeatStep | WhileStep, made: number, looks: number): Generator<FlowEvent, boolean> {
    if (this.made > made) return true;
    const isComputing = this.looks === looks && (step.type === "while" || this.computes(step.steps));
    if (!isComputing) {
      if (this.options.decide !== undefined) yield this.stand(step, LOOK_AGAIN_S);
      return true;
    }
    if (++this.idle <= MOST_IDLE_ROUNDS) return true;
    yield* this.fail(
      step,
      "program.idle-loop",
      `its loop went round ${MOST_IDLE_ROUNDS} times without a motion or a wait.`,
      "Put a wait into the loop, or let its condition become false.",
    );
    return false;
  }

  private *repeat(step: RepeatStep): Generator<FlowEvent, void> {
    yield { kind: "passed", step };
    const { rounds = Number.POSITIVE_INFINITY, mostSteps = Number.POSITIVE_INFINITY, decide } = this.options;
    const times = step.times === "forever" ? rounds : step.times;
    // Where both sides are looked at, a loop without end is looked at in any of its rounds.
    if (decide === undefined && step.times === "forever") this.forget(step.steps);
    for (let i = 0; i < times; i++) {
      if (i >= 2 && this.made >= mostSteps) {
        if (decide === undefined) this.forget(step.steps);
        break;
      }
      const { made, looks } = this;
      yield* this.list(step.steps, true);
      if (this.ended) return;
      // Nothing was done: looking at both sides would find nothing the next time either, unless it computes.
      if (decide === undefined && this.made === made && !this.computes(step.steps)) break;
      if (!(yield* this.round(step, made, looks))) return;
    }
    if (step.times === "forever") yield { kind: "end" };
  }

  private *while(step: WhileStep): Generator<FlowEvent, void> {
    const { mostSteps = Number.POSITIVE_INFINITY, lineRounds = Number.POSITIVE_INFINITY, decide } = this.options;
    const looksAtLines = predicateLines(step.when).length > 0;
    for (let i = 0; ; i++) {
      // It is come to before every round: what was done before is done when the condition is looked at.
      yield { kind: "passed", step };
      if (decide !== undefined && looksAtLines && i >= lineRounds) return;
      const { made, looks } = this;
      const goesRound = this.asked(step);
      if (goesRound === "failed") return yield* this.notDecided(step);
      if (goesRound === false) return;
      if (goesRound === undefined) return yield* this.unknownRounds(step);
      if (i >= 2 && this.made >= mostSteps) {
        if (decide === undefined) this.forget(step.steps);
        return;
      }
      yield* this.list(step.steps, true);
      if (this.ended) return;
      if (!(yield* this.round(step, made, looks))) return;
    }
  }

  /** Rounds that may happen or not: none and two are looked at, with what variables may be in any of them. */
  private *unknownRounds(step: WhileStep): Generator<FlowEvent, void> {
    this.forget(step.steps);
    const before = new Map(this.variables);
    yield { kind: "fork", step };
    yield* this.list(step.steps, true);
    yield* this.list(step.steps, true);
    yield { kind: "other", step };
    yield { kind: "join", step };
    this.merge(before);
  }

  /** Undefined where what is not known decides. */
  private asked(step: IfStep | WhileStep): boolean | undefined | "failed" {
    const { decide } = this.options;
    if (!("expression" in step.when)) {
      this.looks++;
      return decide?.(step.when, this.variable);
    }
    const answer = this.decided(step.when);
    if (answer.kind === "failed") return "failed";
    return answer.kind === "value"
      ? answer.value === true || (answer.value !== false && answer.value !== 0)
      : undefined;
  }

  /** An expression is computed here, so that a failure has its step; lines are read as `decide` reads them. */
  private decided(when: Predicate): Evaluated {
    const { decide, read } = this.options;
    const signal = (name: string): Value | undefined => {
      this.looks++;
      return read?.(name) ?? decide?.({ signal: name, is: true }, this.variable);
    };
    return evaluate(expressionOf(when), { variable: this.variable, signal });
  }

  private *notDecided(step: IfStep | WhileStep): Generator<FlowEvent, void> {
    const answer = this.decided(step.when);
    const sentence = answer.kind === "failed" ? answer.sentence : "its condition has no value.";
    yield* this.fail(step, "program.expression", sentence, "Look at the condition of the step.");
  }

  private *if(step: IfStep): Generator<FlowEvent, void> {
    yield { kind: "passed", step };
    const answer = this.asked(step);
    const otherwise = step.else ?? [];
    if (answer === "failed") return yield* this.notDecided(step);
    if (answer !== undefined) return yield* this.list(answer ? step.then : otherwise, true);
    yield* this.both(step, step.then, otherwise);
  }

  private *both(step: IfStep | WaitForStep, one: readonly Step[], other: readonly Step[]): Generator<FlowEvent, void> {
    const before = new Map(this.variables);
    yield { kind: "fork", step };
    yield* this.list(one, true);
    const after = this.variables;
    this.variables = before;
    yield { kind: "other", step };
    yield* this.list(other, true);
    this.merge(after);
    yield { kind: "join", step };
  }

  private *waitFor(step: WaitForStep): Generator<FlowEvent, void> {
    const { late, ...rest } = step;
    const when =
      "expression" in step.when ? { expression: withValues(step.when.expression, this.variable) } : step.when;
    const closed: WaitForStep = late === undefined ? { ...rest, when } : { ...rest, when, late: [] };
    yield this.step(closed.when === step.when && late === undefined ? step : closed, step);
    if (late === undefined || step.timeout_s === undefined) return;
    yield { kind: "passed", step };
    const { decide, met } = this.options;
    if (decide === undefined) return yield* this.both(step, [], late);
    if (!(met?.(closed) ?? decide(closed.when, this.variable))) yield* this.list(late, true);
  }

  /** Variables that these steps may change are not known from here on. */
  private forget(steps: readonly Step[]): void {
    for (const name of this.changed(steps)) this.variables.set(name, undefined);
  }

  private computes(steps: readonly Step[]): boolean {
    return this.changed(steps).size > 0;
  }

  private changed(steps: readonly Step[], names = new Set<string>()): ReadonlySet<string> {
    for (const step of everyIn(steps)) {
      if (step.type === "assign") names.add(step.variable);
      if (step.type === "call") this.changed(this.program.routines[step.routine] ?? [], names);
    }
    return names;
  }

  /** What is worth the same on both sides stays known. */
  private merge(other: Store): void {
    for (const [name, value] of other) if (this.variables.get(name) !== value) this.variables.set(name, undefined);
  }

  private *pallet(step: PalletStep): Generator<FlowEvent, void> {
    yield { kind: "passed", step };
    const pallet = Object.hasOwn(this.program.pallets, step.pallet) ? this.program.pallets[step.pallet] : undefined;
    if (pallet === undefined) return;
    const before = this.visits;
    const pitch = palletPitch(pallet);
    const of = palletCount(pallet);
    let number = 0;
    for (const index of palletIndices(pallet)) {
      this.visits = [
        ...before,
        { pallet: step.pallet, number: ++number, of, frameFromPlace: palletSlot(pallet, index, pitch) },
      ];
      yield* this.list(step.steps, true);
      if (this.ended) return;
    }
    this.visits = before;
  }

  /** The move with places of pallets as poses in the frames that the pallets stand in. */
  private placed(step: MoveStep): MoveStep {
    if (this.visits.length === 0) return step;
    const target = this.target(step.target);
    const via = step.via === undefined ? undefined : this.target(step.via);
    if (target === step.target && via === step.via) return step;
    return via === undefined ? { ...step, target } : { ...step, target, via };
  }

  private target(target: Target): Target {
    if ("q" in target) return target;
    const visit = this.visits.findLast(({ pallet }) => pallet === target.frame);
    if (visit === undefined) return target;
    const frameFromTcp = compose(visit.frameFromPlace, target.pose as Pose as Pose<"place", "tcp">);
    return { ...target, frame: this.program.pallets[visit.pallet]!.frame, pose: frameFromTcp };
  }
}
