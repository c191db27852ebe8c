/** An expression taken apart. */
export type Node =
  | { readonly kind: "value"; readonly value: null | boolean | bigint | number | string }
  | { readonly kind: "name"; readonly name: string }
  | { readonly kind: "list"; readonly items: readonly Node[]; readonly isTuple: boolean }
  | { readonly kind: "dict"; readonly entries: readonly (readonly [Node, Node])[] }
  | {
      readonly kind: "each";
      readonly result: Node;
      readonly names: readonly string[];
      readonly over: Node;
      readonly only: readonly Node[];
    }
  | { readonly kind: "choice"; readonly condition: Node; readonly yes: Node; readonly no: Node }
  | { readonly kind: "both" | "either"; readonly left: Node; readonly right: Node }
  | { readonly kind: "unary"; readonly operator: string; readonly operand: Node }
  | { readonly kind: "binary"; readonly operator: string; readonly left: Node; readonly right: Node }
  | {
      readonly kind: "comparison";
      readonly first: Node;
      readonly rest: readonly { readonly operator: string; readonly with: Node }[];
    }
  | { readonly kind: "member"; readonly of: Node; readonly name: string }
  | { readonly kind: "item"; readonly of: Node; readonly at: Node }
  | {
      readonly kind: "slice";
      readonly of: Node;
      readonly from: Node | undefined;
      readonly to: Node | undefined;
      readonly step: Node | undefined;
    }
  | {
      readonly kind: "call";
      readonly of: Node;
      readonly values: readonly Node[];
      readonly named: readonly (readonly [string, Node])[];
    };
