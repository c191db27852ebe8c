import { Refusal } from "../refusal.ts";
import { shorten } from "../xml.ts";
import { DEEPEST_NESTING, type Budget } from "./budget.ts";
import { evaluate, type Lookup } from "./expression/evaluate.ts";
import { parseExpression } from "./expression/parse.ts";
import type { Node } from "./expression/syntax.ts";
import { textOf, type Value } from "./expression/values.ts";

const PIECE = /\$\$+(?=[{(])|\$\{[^}]*\}|\$\([^)]*\)|[^$]+|\$/y;

/** Works out texts with `${expressions}` and `$(substitutions)` in them. */
export class Texts {
  private readonly budget: Budget;
  private readonly parsed = new Map<string, Node>();
  private depth = 0;
  constructor(budget: Budget) {
    this.budget = budget;
  }

  /**
   * The value of a text. A lone `${…}` keeps its kind; anything else becomes text. `$${` is a plain `${`.
   *
   * @param substitute  the value of what stands in `$(…)`.
   */
  valueOf(text: string, lookup: Lookup, substitute: (inside: string) => Value): Value {
    if (!text.includes("$")) return text;
    if (++this.depth > DEEPEST_NESTING)
      throw new Refusal(`Properties rest on each other more than ${DEEPEST_NESTING} deep.`);
    const pieces: Value[] = [];
    PIECE.lastIndex = 0;
    for (let at = 0; at < text.length; ) {
      PIECE.lastIndex = at;
      const piece = PIECE.exec(text)?.[0] ?? "";
      if (piece === "") throw new Refusal(`“${shorten(text.slice(at))}” is not closed.`);
      at += piece.length;
      if (piece.startsWith("${"))
        pieces.push(this.expression(textOf(this.valueOf(piece.slice(2, -1), lookup, substitute)), lookup));
      else if (piece.startsWith("$("))
        pieces.push(substitute(textOf(this.valueOf(piece.slice(2, -1), lookup, substitute))));
      else if (piece === "$" && /[{(]/.test(text.charAt(at)))
        throw new Refusal(`“${shorten(text.slice(at - 1))}” is not closed.`);
      else pieces.push(piece.startsWith("$$") ? piece.slice(1) : piece);
    }
    this.depth--;
    if (pieces.length === 1) return pieces[0]!;
    const whole = pieces.map(textOf).join("");
    this.budget.spend(whole.length);
    return whole;
  }

  expression(text: string, lookup: Lookup): Value {
    let node = this.parsed.get(text);
    if (!node) {
      this.budget.spend(text.length);
      node = parseExpression(text);
      this.parsed.set(text, node);
    }
    return evaluate(node, lookup, this.budget);
  }
}
