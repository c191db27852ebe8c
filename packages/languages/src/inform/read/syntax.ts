import type { TextPlace } from "@twincell/core";

/** In which frame the numbers of a position count. */
export type PositionType = "PULSE" | "ANGLE" | "BASE" | "ROBOT" | "TOOL" | "USER";
/** A position of a job, with the settings in force where it is written. */
export interface Position extends TextPlace {
  readonly type: PositionType;
  readonly user: number;
  readonly tool: number;
  /** Pulses, or X, Y, Z [mm], Rx, Ry, Rz [deg]. */
  readonly values: readonly number[];
  readonly rconf: readonly number[];
}
/** A line of the controller, or a group of eight or four of them as a number. */
export type Wire = "IN" | "OT" | "SIN" | "SOUT" | "IG" | "OG" | "IGH" | "OGH" | "AI" | "RIN";

/** A constant, or a variable by its letter and number. */
export type Operand =
  | { readonly kind: "number"; readonly value: number }
  | { readonly kind: "variable"; readonly name: string }
  | { readonly kind: "line"; readonly wire: Wire; readonly number: number }
  /** EXPRESS: worked out from left to right, × and ÷ first. */
  | { readonly kind: "sum"; readonly sign: "+" | "-" | "*" | "/"; readonly left: Operand; readonly right: Operand };
export interface Condition {
  readonly left: Operand;
  readonly sign: "=" | "<>" | "<" | ">" | "<=" | ">=";
  readonly right: Operand | "ON" | "OFF";
  /** ANDEXP and OREXP, from left to right. */
  readonly more?: readonly { readonly join: "and" | "or"; readonly condition: Condition }[];
}

export interface Move {
  readonly motion: "MOVJ" | "MOVL" | "MOVC" | "MOVS";
  /** C00000 or P000. */
  readonly position: string;
  readonly vj: number | undefined;
  readonly v: number | undefined;
  readonly pl: number | undefined;
  readonly cr: number | undefined;
  readonly acc: number | undefined;
  readonly dec: number | undefined;
  readonly isLastOfArc: boolean;
  readonly until: Condition | undefined;
  /** Variables that say the speed: 0.1 mm/s and 0.01 %. */
  readonly speedIn?: { readonly v?: Operand; readonly vj?: Operand };
  /** EC00000, BC00000 and their like: where further axes go with it. */
  readonly others?: readonly string[];
  /** SMOVL, SMOVC: the robot follows what a station carries. */
  readonly follows?: boolean;
  /** IMOV: the position is how far the robot goes. */
  readonly by?: { readonly frame: "BASE" | "ROBOT" | "TOOL" | "USER"; readonly user: number };
}

export type Statement = TextPlace &
  (
    | ({ readonly kind: "move" } & Move)
    | { readonly kind: "timer"; readonly s: Operand; readonly isHundredths: boolean }
    | { readonly kind: "dout"; readonly number: number; readonly to: boolean; readonly wire?: "SOUT" }
    /** A group of lines takes a number. */
    | { readonly kind: "group"; readonly wire: "OG" | "OGH"; readonly number: number; readonly to: Operand }
    | { readonly kind: "pulse"; readonly number: number; readonly s: number }
    | { readonly kind: "aout"; readonly number: number; readonly to: number }
    | { readonly kind: "din"; readonly to: string; readonly from: Operand }
    | { readonly kind: "wait"; readonly when: Condition; readonly s?: Operand }
    | { readonly kind: "hand"; readonly to: boolean }
    | {
        readonly kind: "call";
        readonly job: string;
        readonly when: Condition | undefined;
        readonly args?: readonly Operand[];
      }
    /** GETARG: an argument of the call. */
    | { readonly kind: "argument"; readonly to: string; readonly number: number }
    /** Sets a variable, or all of a position, to what only the controller knows. */
    | { readonly kind: "unknown"; readonly to: string; readonly from: string }
    /** A position variable takes another one, or is moved by it. */
    | {
        readonly kind: "positions";
        readonly word: "SET" | "ADD" | "SUB";
        readonly to: string;
        readonly by: string;
      }
    /** MFRAME: a user frame through three positions: its origin, a point on x, and one on the side of y. */
    | { readonly kind: "frame"; readonly user: number; readonly through: readonly [string, string, string] }
    /** Something that could move the robot, which is not known here. */
    | { readonly kind: "away"; readonly what: string; readonly when?: Condition | undefined }
    /** Kept and named. */
    | { readonly kind: "shown"; readonly what: string }
    | { readonly kind: "return"; readonly when: Condition | undefined }
    | { readonly kind: "abort"; readonly when: Condition | undefined }
    | { readonly kind: "message"; readonly text: string }
    | {
        readonly kind: "arithmetic";
        readonly word: "SET" | "ADD" | "SUB" | "MUL" | "DIV";
        readonly to: string;
        readonly by: Operand;
      }
    | {
        readonly kind: "element";
        readonly get: boolean;
        readonly position: string;
        readonly element: number;
        readonly with: Operand;
      }
    /** Keeps the position of the robot in a variable. */
    | { readonly kind: "here"; readonly position: string }
    | { readonly kind: "clear"; readonly from: string; readonly count: number }
    | {
        readonly kind: "shift";
        readonly position: string;
        readonly frame: "BASE" | "ROBOT" | "USER";
        readonly user: number;
      }
    | { readonly kind: "shift-off" }
    | { readonly kind: "speed"; readonly vj: number | undefined; readonly v: number | undefined }
    /** Read, and without effect on where the robot goes. */
    | { readonly kind: "nothing" }
  );

/** A job as a list of statements and jumps; `to` is an index into the list, -1 only while the list is being made. */
export type Instruction =
  | { readonly kind: "statement"; readonly statement: Statement }
  | { readonly kind: "jump"; to: number; readonly at: TextPlace }
  /** JUMP LABEL:B000, to the label of that number. */
  | {
      readonly kind: "jump-to";
      readonly number: Operand;
      readonly labels: ReadonlyMap<string, number>;
      readonly at: TextPlace;
    }
  /** Goes on only when the condition holds. */
  | { readonly kind: "unless"; readonly when: Condition; to: number; readonly at: TextPlace }
  | {
      readonly kind: "for";
      readonly variable: string;
      readonly from: Operand;
      readonly last: Operand;
      readonly step: Operand;
      readonly slot: number;
      readonly at: TextPlace;
    }
  | { readonly kind: "for-check"; readonly variable: string; readonly slot: number; to: number }
  | { readonly kind: "for-next"; readonly variable: string; readonly slot: number; to: number; readonly at: TextPlace };

export interface Job {
  readonly name: string;
  readonly place: TextPlace;
  /** By C00000 or P000. */
  readonly positions: ReadonlyMap<string, Position>;
  /** Positions of further axes, by BC00000 or EC00000. */
  readonly others: ReadonlyMap<string, string>;
  readonly instructions: readonly Instruction[];
  readonly slots: number;
}
/** A tool or user frame of the controller. */
export interface Frame {
  readonly number: number;
  readonly name: string;
  readonly values: readonly number[];
}
export interface Source {
  readonly jobs: ReadonlyMap<string, Job>;
  readonly tools: ReadonlyMap<number, Frame>;
  readonly users: ReadonlyMap<number, Frame>;
}
