import type { Signals } from "../signals.ts";
import { palletCount, palletIndices, palletPitch, palletSlot } from "./pallet.ts";
import { compose, type Pose } from "../spatial/pose.ts";
import type {
  Condition,
  IfStep,
  MoveStep,
  PalletStep,
  PrimitiveStep,
  Program,
  RepeatStep,
  Step,
  Target,
} from "./program.ts";
import { SignalTable, holds } from "./signals.ts";

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
   * `written` is the step as the program has it; in `step` places have become poses. `stands` marks what the program
   * does not say: a stop, or the time a loop takes to look again.
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
  /** Both sides of a decision follow: fork, the one side, other, the other side, join. */
  | { readonly kind: "fork" | "other" | "join"; readonly step: IfStep }
  /** What follows in this list, if anything, is never reached. */
  | { readonly kind: "end" };

export interface FlowOptions {
  /** Decides when a decision is reached; undefined looks at both sides. */
  readonly decide?: (when: Condition) => boolean;
  /** How often a loop "forever" goes round; for ever when left out. */
  readonly rounds?: number;
  /** Loops go round twice only once so many steps have been done. */
  readonly mostSteps?: number;
}

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
  for (const happening of flow(program, { decide: when => holds(when, signals) }))
    if (happening.kind === "step") yield happening.step;
}

/** Whether the robot may go into the next step without a stop. */
const passesOn = (step: MoveStep): boolean =>
  step.until === undefined && (step.blend_m > 0 || (step.blend_ratio ?? 0) > 0 || step.path === "spline");

class Flow {
  private readonly program: Program;
  private readonly options: FlowOptions;
  private visits: readonly PlaceVisit[] = [];
  private made = 0;
  private ended = false;

  constructor(program: Program, options: FlowOptions) {
    this.program = program;
    this.options = options;
  }

  /** @param inside  the list is not the main one: it ends with a stop. */
  *list(steps: readonly Step[], inside: boolean): Generator<FlowEvent, void> {
    let passing: MoveStep | undefined;
    for (const step of steps) {
      if (step.type === "comment") {
        yield { kind: "passed", step };
        continue;
      }
      if (
        passing !== undefined &&
        (step.type === "call" || step.type === "repeat" || step.type === "if" || step.type === "pallet")
      )
        yield this.stand(passing, 0);
      passing = undefined;
      switch (step.type) {
        case "repeat":
          yield* this.repeat(step);
          break;
        case "if":
          yield* this.decide(step);
          break;
        case "pallet":
          yield* this.pallet(step);
          break;
        case "call":
          yield { kind: "passed", step };
          yield* this.list(
            Object.hasOwn(this.program.routines, step.routine) ? this.program.routines[step.routine]! : [],
            true,
          );
          break;
        case "move": {
          if (passesOn(step)) passing = step;
          yield this.step(this.placed(step), step);
          break;
        }
        case "stop":
          yield this.step(step, step);
          yield { kind: "end" };
          // Where both sides are looked at, the other side still follows.
          if (this.options.decide !== undefined) {
            this.ended = true;
            return;
          }
          break;
        default:
          yield this.step(step, step);
      }
      if (this.ended) return;
    }
    if (passing !== undefined && inside) yield this.stand(passing, 0);
  }

  private step(step: PrimitiveStep, written: Step): FlowEvent {
    this.made++;
    return { kind: "step", step, written, stands: false, visits: this.visits };
  }

  private stand(at: Step, s: number): FlowEvent {
    return { kind: "step", step: { id: at.id, type: "wait", s }, written: at, stands: true, visits: this.visits };
  }

  private *repeat(step: RepeatStep): Generator<FlowEvent, void> {
    yield { kind: "passed", step };
    const { rounds = Number.POSITIVE_INFINITY, mostSteps = Number.POSITIVE_INFINITY } = this.options;
    const times = step.times === "forever" ? rounds : step.times;
    for (let i = 0; i < times && !(i >= 2 && this.made >= mostSteps); i++) {
      const before = this.made;
      yield* this.list(step.steps, true);
      if (this.ended) return;
      if (this.made > before) continue;
      // Nothing was done: looking at both sides would find nothing the next time either.
      if (this.options.decide === undefined) break;
      yield this.stand(step, LOOK_AGAIN_S);
    }
    if (step.times === "forever") yield { kind: "end" };
  }

  private *decide(step: IfStep): Generator<FlowEvent, void> {
    yield { kind: "passed", step };
    const { decide } = this.options;
    const otherwise = step.else ?? [];
    if (decide !== undefined) {
      yield* this.list(decide(step.when) ? step.then : otherwise, true);
      return;
    }
    yield { kind: "fork", step };
    yield* this.list(step.then, true);
    yield { kind: "other", step };
    yield* this.list(otherwise, true);
    yield { kind: "join", step };
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
