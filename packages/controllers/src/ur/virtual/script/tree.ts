import type { At } from "./fault.ts";

/** `calls` is true where a function is called somewhere inside: such an expression may take time. */
interface Node extends At {
  readonly calls: boolean;
}
export type Expression = Node &
  (
    | { readonly kind: "constant"; readonly value: number | boolean | string }
    | { readonly kind: "variable"; readonly name: string }
    | { readonly kind: "list"; readonly items: readonly Expression[]; readonly isPose: boolean }
    | { readonly kind: "item"; readonly of: Expression; readonly index: Expression }
    | { readonly kind: "unary"; readonly sign: "-" | "+" | "not"; readonly of: Expression }
    | { readonly kind: "binary"; readonly sign: string; readonly left: Expression; readonly right: Expression }
    | { readonly kind: "call"; readonly name: string; readonly args: readonly Argument[] }
    | { readonly kind: "run"; readonly name: string; readonly args: readonly Argument[] }
  );
export interface Argument {
  readonly name: string | undefined;
  readonly value: Expression;
}

export type Statement = At &
  (
    | {
        readonly kind: "assign";
        readonly scope: "global" | "local" | "nearest";
        readonly name: string;
        readonly index: Expression | undefined;
        readonly value: Expression;
      }
    | { readonly kind: "do"; readonly value: Expression }
    | {
        readonly kind: "if";
        readonly arms: readonly { readonly when: Expression; readonly body: readonly Statement[] }[];
        readonly otherwise: readonly Statement[];
      }
    | { readonly kind: "while"; readonly when: Expression; readonly body: readonly Statement[] }
    | { readonly kind: "return"; readonly value: Expression | undefined }
    | { readonly kind: "kill" | "join"; readonly thread: Expression }
    | { readonly kind: "break" | "continue" | "halt" | "pass" | "enter_critical" | "exit_critical" }
  );

export interface Routine extends At {
  readonly name: string;
  readonly isThread: boolean;
  readonly parameters: readonly string[];
  readonly body: readonly Statement[];
}
export interface Script {
  readonly name: string;
  /** A program that runs beside another and may not move the robot. */
  readonly isSecondary: boolean;
  readonly body: readonly Statement[];
  readonly routines: ReadonlyMap<string, Routine>;
}
