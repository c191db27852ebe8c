import type { Expression, Statement } from "../../parser/structured/index.ts";

/** Where a motion goes: P[n], or PR[n]. */
export interface Point {
  readonly register: "p" | "pr";
  readonly number: Expression;
}
/** What happens behind a jump that is not taken by itself: the program goes on, is aborted, or goes elsewhere. */
export type Fate = "on" | "abort" | "elsewhere";
export interface Motion {
  readonly kind: "motion";
  readonly path: "J" | "L" | "C";
  readonly via?: Point;
  readonly goal: Point;
  /** Undefined is the speed that the controller holds for it: as fast as it can, or that of the weld. */
  readonly speed: Expression | undefined;
  readonly unit: "%" | "mm/sec" | "cm/min" | "inch/min" | "deg/sec" | "sec" | "msec" | "max_speed" | "weld_speed";
  /** Share of the deceleration that is passed, 0 … 100; undefined stands. */
  readonly cnt?: Expression;
  readonly acceleration?: Expression;
  readonly offset?: { readonly register: Expression | undefined };
  /** Shifts the point along the axes of the tool. */
  readonly toolOffset?: { readonly register: Expression | undefined };
  /** The robot keeps its place on what a second group carries while that moves. */
  readonly coordinated: boolean;
  /** A label of the search that it is: taken when the condition does not come, or when it does (SkipJump). */
  readonly skip?: number;
  readonly jumpsWhenMet?: boolean;
  /** INC: the position is how far the robot goes from where it stands. */
  readonly incremental?: boolean;
}

/** What an instruction does, apart from loops, decisions, calls and assignments to registers. */
export type Action =
  | Motion
  | {
      readonly kind: "set";
      readonly word: string;
      readonly number: Expression;
      readonly value: Expression;
      readonly pulse?: Expression;
    }
  | { readonly kind: "wait"; readonly s: Expression }
  | { readonly kind: "wait-for"; readonly when: Expression; readonly label?: number }
  | { readonly kind: "skip-condition"; readonly when: Expression }
  | { readonly kind: "offset-condition"; readonly register: Expression }
  | { readonly kind: "tool-offset-condition"; readonly register: Expression }
  | { readonly kind: "message"; readonly text: string }
  | { readonly kind: "select"; readonly what: "uframe" | "utool"; readonly number: Expression }
  | {
      readonly kind: "define";
      readonly what: "uframe" | "utool";
      readonly number: Expression;
      readonly value: Expression;
      readonly spelling: string;
    }
  | { readonly kind: "timeout"; readonly value: Expression }
  | { readonly kind: "flag"; readonly word: string; readonly number: Expression; readonly value: Expression }
  | { readonly kind: "move-register"; readonly number: Expression; readonly value: Expression }
  | { readonly kind: "jump"; readonly label: number }
  /** A jump to a label whose number is worked out. */
  | { readonly kind: "jump-to"; readonly label: Expression }
  | { readonly kind: "label"; readonly label: number }
  /** Waits for a person to go on. */
  | { readonly kind: "pause" }
  | { readonly kind: "nothing" };

export type Actions = ReadonlyMap<Statement, Action>;
