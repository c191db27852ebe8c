import type { TextPlace } from "@twincell/core";

/**
 * An argument of a call: by place, by name (`r=0.01`, `\WObj:=box`), or a switch (`\On`) that has a name and no value.
 */
export interface Argument extends TextPlace {
  readonly name?: string;
  readonly value?: Expression;
  /** Only given on where the routine was itself given it: `\WObj?wobj`. */
  readonly ifPresent?: boolean;
}

/** What languages of blocks compute with. Names are as the language compares them. */
export type Expression = TextPlace &
  (
    | { readonly kind: "number"; readonly value: number }
    | { readonly kind: "text"; readonly value: string }
    | { readonly kind: "truth"; readonly value: boolean }
    | { readonly kind: "variable"; readonly name: string }
    /** `[a, b]`; with a tag what stands before the bracket, as in `p[…]`. */
    | { readonly kind: "list"; readonly tag: string; readonly items: readonly Expression[] }
    | { readonly kind: "index"; readonly of: Expression; readonly indices: readonly Expression[] }
    | { readonly kind: "component"; readonly of: Expression; readonly name: string }
    | { readonly kind: "call"; readonly name: string; readonly args: readonly Argument[] }
    | { readonly kind: "unary"; readonly sign: string; readonly of: Expression }
    | { readonly kind: "binary"; readonly sign: string; readonly left: Expression; readonly right: Expression }
  );

export type Statement = TextPlace &
  (
    | { readonly kind: "assign"; readonly to: Expression; readonly value: Expression; readonly global: boolean }
    | { readonly kind: "do"; readonly name: string; readonly args: readonly Argument[] }
    | {
        readonly kind: "if";
        readonly branches: readonly { readonly when: Expression; readonly body: Block }[];
        readonly otherwise?: Block;
      }
    | { readonly kind: "while"; readonly when: Expression; readonly body: Block }
    | {
        readonly kind: "for";
        readonly variable: string;
        readonly from: Expression;
        readonly to: Expression;
        readonly step?: Expression;
        readonly body: Block;
      }
    /** Rests until the condition is true. */
    | { readonly kind: "wait-until"; readonly when: Expression; readonly timeout?: Expression }
    | { readonly kind: "return"; readonly value?: Expression }
    | { readonly kind: "break" }
    | { readonly kind: "continue" }
    | { readonly kind: "halt" }
    /** A place that GOTO goes to; only in languages that have it, and never into a block from outside. */
    | { readonly kind: "label"; readonly name: string }
    | { readonly kind: "goto"; readonly label: string }
    /** What a person wrote between the statements. */
    | { readonly kind: "comment"; readonly text: string }
  );
export type Block = readonly Statement[];

export interface Parameter {
  readonly name: string;
  readonly type: string;
  readonly value?: Expression;
  readonly optional?: boolean;
  /** What the routine gives it is handed back to the variable that was given. */
  readonly isBack?: boolean;
}
export interface Routine extends TextPlace {
  readonly name: string;
  readonly parameters: readonly Parameter[];
  readonly body: Block;
}
