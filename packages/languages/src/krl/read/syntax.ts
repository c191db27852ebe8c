import type { TextPlace } from "@twincell/core";
import type { JumpInstruction } from "../../parser/index.ts";

/** Names are upper case throughout: KRL knows no case. */
export type Expression = TextPlace &
  (
    | { readonly kind: "number"; readonly value: number; readonly whole: boolean }
    | { readonly kind: "bool"; readonly value: boolean }
    | { readonly kind: "text"; readonly value: string }
    | { readonly kind: "enum"; readonly value: string }
    /** `{E6POS: X 1,Y 2}`; the type is undefined when it is left out. */
    | {
        readonly kind: "aggregate";
        readonly type: string | undefined;
        readonly fields: readonly (readonly [name: string, value: Expression])[];
      }
    | Variable
    | { readonly kind: "call"; readonly name: string; readonly args: readonly (Expression | undefined)[] }
    | { readonly kind: "unary"; readonly sign: string; readonly of: Expression }
    | { readonly kind: "binary"; readonly sign: string; readonly left: Expression; readonly right: Expression }
  );
/**
 * `NAME[i].FIELD`; further parts are members of a structure. An empty index (`P[]`) means the whole array and is left
 * out.
 */
export type Variable = TextPlace & {
  readonly kind: "variable";
  readonly parts: readonly { readonly name: string; readonly indices: readonly Expression[] }[];
};

export type MotionKind = "PTP" | "LIN" | "CIRC" | "SPL";
export interface Motion {
  readonly motion: MotionKind;
  readonly relative: boolean;
  /** A relative motion that counts along the axes of the tool. */
  readonly inTool: boolean;
  /** A statement of its own that is planned as a spline: SPTP, SLIN, SCIRC. */
  readonly spline: boolean;
  readonly target: Expression;
  readonly via: Expression | undefined;
  /** C_PTP, C_DIS, … in the order written. */
  readonly approximation: readonly string[];
  /** `WITH $VEL.CP=0.2`: for this motion only. */
  readonly settings: readonly (readonly [to: Variable, value: Expression])[];
}

export type Statement = TextPlace &
  (
    | { readonly kind: "assign"; readonly to: Variable; readonly value: Expression }
    | ({ readonly kind: "motion" } & Motion)
    | { readonly kind: "spline"; readonly settings: Motion["settings"] }
    | { readonly kind: "end-spline"; readonly approximation: readonly string[] }
    | { readonly kind: "wait"; readonly time: Expression }
    | { readonly kind: "wait-for"; readonly condition: Expression }
    | { readonly kind: "pulse"; readonly output: Variable; readonly to: Expression; readonly time: Expression }
    | { readonly kind: "call"; readonly name: string; readonly args: readonly (Expression | undefined)[] }
    | {
        readonly kind: "interrupt";
        readonly number: Expression;
        readonly condition: Expression;
        readonly routine: string;
      }
    | { readonly kind: "interrupt-switch"; readonly on: boolean; readonly number: Expression | undefined }
    | { readonly kind: "return"; readonly value: Expression | undefined }
    | { readonly kind: "brake" | "resume" | "halt" }
    | ({ readonly kind: "trigger" } & Trigger)
    /** Read, and without effect on where the robot goes. */
    | { readonly kind: "nothing" }
    /** Stands in another file than the program, and is not understood: that matters when it is reached. */
    | { readonly kind: "fault"; readonly expected: string; readonly sentence: string }
  );

/** What is done at a point of the next motion while the robot goes on. */
export interface Trigger {
  /** At the start of the next motion (`DISTANCE=0`, `ONSTART`), or at its end. */
  readonly distance: Expression | undefined;
  readonly onStart: boolean;
  /** How far from that point, and how much later [ms]. */
  readonly path: Expression | undefined;
  readonly delay: Expression | undefined;
  readonly action: Extract<Statement, { kind: "assign" | "call" | "pulse" }>;
}

/** A program as a list of statements and jumps. */
export type Instruction = JumpInstruction<Expression, Variable, Statement>;

/** `DECL INT A, B[3]` or `DECL FRAME F={…}`. */
export interface Declaration extends TextPlace {
  /** Known to all modules, and not only to its own: `GLOBAL`, and everything in $CONFIG. */
  readonly isGlobal: boolean;
  readonly type: string;
  readonly name: string;
  readonly isArray: boolean;
  readonly value: Expression | undefined;
  readonly index: readonly Expression[];
}
/** `SIGNAL GRIPPER $OUT[1]`, or `SIGNAL NUMBER $IN[1] TO $IN[8]`, the lowest bit first. */
export interface SignalDeclaration extends TextPlace {
  readonly name: string;
  readonly wire: "in" | "out" | "analogue-in" | "analogue-out" | "variable";
  readonly address: number;
  readonly last?: number;
  /** What it is another name of, where it is no line. */
  readonly variable?: string;
}

export interface Parameter {
  readonly name: string;
  readonly out: boolean;
}
export interface Routine {
  readonly name: string;
  /** The module it stands in: the name of its file. */
  readonly module: string;
  readonly place: TextPlace;
  readonly isFunction: boolean;
  readonly parameters: readonly Parameter[];
  readonly declarations: readonly Declaration[];
  readonly instructions: readonly Instruction[];
  readonly slots: number;
}

/** A .src with its .dat: what it declares is its own, except what is called GLOBAL and its first routine. */
export interface Module {
  readonly name: string;
  readonly routines: ReadonlyMap<string, Routine>;
  readonly data: readonly Declaration[];
  /** Elements of its arrays, in their order: `POINT[3]={X 1,Y 2}`. */
  readonly elements: readonly Extract<Statement, { kind: "assign" }>[];
}

/** What was read: the modules, that of the main routine first, and the signals of all of them. */
export interface Source {
  readonly modules: ReadonlyMap<string, Module>;
  readonly main: Routine | undefined;
  /** Routines that every module can call. */
  readonly shared: ReadonlyMap<string, Routine>;
  readonly signals: readonly SignalDeclaration[];
}
