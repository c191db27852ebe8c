import type { TextPlace } from "@twincell/core";
import type { JumpInstruction } from "../../parser/index.ts";

/** The sorts of names: `a` a real or a transformation, `$a` a string, `#a` a precision point (joint values). */
export type Expression = TextPlace &
  (
    | { readonly kind: "number"; readonly value: number }
    | { readonly kind: "text"; readonly value: string }
    /** A variable, with indices when it is an element of an array. The name is lower case and carries its $ or #. */
    | { readonly kind: "variable"; readonly name: string; readonly indices: readonly Expression[] }
    /** A function, upper case. An argument left out is undefined. */
    | { readonly kind: "call"; readonly name: string; readonly args: readonly (Expression | undefined)[] }
    | { readonly kind: "unary"; readonly sign: "-" | "+" | "NOT"; readonly of: Expression }
    | { readonly kind: "binary"; readonly sign: string; readonly left: Expression; readonly right: Expression }
    /** a:b:c, multiplied from left to right. */
    | { readonly kind: "compound"; readonly parts: readonly Expression[] }
  );
export type Variable = Extract<Expression, { kind: "variable" }>;

export type ConfigWord = "LEFTY" | "RIGHTY" | "ABOVE" | "BELOW" | "FLIP" | "NOFLIP";

export type Statement = TextPlace &
  (
    | { readonly kind: "assign"; readonly to: Variable; readonly value: Expression }
    | { readonly kind: "set"; readonly to: Variable; readonly value: Expression }
    | { readonly kind: "here"; readonly to: Variable }
    | { readonly kind: "decompose"; readonly to: Variable; readonly location: Expression }
    | { readonly kind: "move"; readonly straight: boolean; readonly location: Expression; readonly hand?: Expression }
    | {
        readonly kind: "approach";
        readonly straight: boolean;
        readonly location: Expression;
        readonly distance: Expression;
      }
    | { readonly kind: "depart"; readonly straight: boolean; readonly distance: Expression }
    | { readonly kind: "drive"; readonly joint: Expression; readonly change: Expression; readonly speed: Expression }
    | {
        readonly kind: "speed";
        readonly value: Expression;
        readonly unit: "percent" | "mmps" | "ips";
        readonly always: boolean;
      }
    | { readonly kind: "duration"; readonly value: Expression; readonly always: boolean }
    | { readonly kind: "tool"; readonly location?: Expression }
    | { readonly kind: "base"; readonly values: readonly (Expression | undefined)[] }
    | { readonly kind: "config"; readonly word: ConfigWord; readonly always: boolean }
    | { readonly kind: "break" }
    | { readonly kind: "path"; readonly continuous: boolean }
    | { readonly kind: "delay"; readonly time: Expression }
    | { readonly kind: "wait"; readonly condition?: Expression }
    | { readonly kind: "gripper"; readonly closed: boolean; readonly immediate: boolean }
    | { readonly kind: "signal"; readonly signals: readonly Expression[] }
    | { readonly kind: "accel"; readonly percent: Expression }
    | { readonly kind: "type"; readonly text: string }
    | { readonly kind: "call"; readonly program: string; readonly args: readonly Expression[] }
    | { readonly kind: "return" }
    | { readonly kind: "stop" }
    /** AUTO and LOCAL: variables of this program alone; those of LOCAL keep their values from call to call. */
    | { readonly kind: "own"; readonly names: readonly string[]; readonly keeps: boolean }
    /** What is left out of a text that is executed, and the variables that it would have given values from outside. */
    | { readonly kind: "kept"; readonly word: string; readonly forgets: readonly Variable[] }
    /**
     * Statements that ask for accuracy or say something to the operator: read, and without effect on where the robot
     * goes.
     */
    | { readonly kind: "nothing" }
  );

/** A program as a list of statements and jumps. */
export type Instruction = JumpInstruction<Expression, Variable, Statement>;

export interface Routine {
  readonly name: string;
  readonly place: TextPlace;
  readonly parameters: readonly string[];
  readonly instructions: readonly Instruction[];
  readonly slots: number;
}

/** A text that was read: programs by name, first one first, and statements that a terminal runs at once (`DO …`). */
export interface Source {
  readonly routines: ReadonlyMap<string, Routine>;
  readonly immediate: readonly Statement[];
  /** `.LOCATIONS`, `.REALS` and `.STRINGS` as assignments. */
  readonly data: readonly Statement[];
}
