import { Refusal } from "../../refusal.ts";
import { shorten } from "../../xml.ts";
import type { Node } from "./syntax.ts";
import { tokensOf, type Token } from "./tokens.ts";

const LONGEST = 10_000;
const DEEPEST = 60;
/** Binary operators, those that bind less first. */
const LEVELS: readonly (readonly string[])[] = [["|"], ["^"], ["&"], ["<<", ">>"], ["+", "-"], ["*", "/", "//", "%"]];
const WORDS = new Set(["and", "or", "not", "if", "else", "in", "is", "for", "lambda"]);
const CONSTANTS = new Map<string, null | boolean>([
  ["True", true],
  ["False", false],
  ["None", null],
]);

/** Takes an expression apart. @throws {Refusal} that quotes the expression. */
export function parseExpression(text: string): Node {
  if (text.length > LONGEST)
    throw new Refusal(`An expression has ${text.length} characters; at most ${LONGEST} are read.`);
  return new Parser(text).whole();
}

class Parser {
  private readonly text: string;
  private readonly tokens: readonly Token[];
  private at = 0;
  private depth = 0;
  constructor(text: string) {
    this.text = text;
    this.tokens = tokensOf(text);
  }

  whole(): Node {
    const first = this.expression();
    if (!this.is(",")) return this.closed(first);
    const items = [first];
    while (this.take(",")) if (this.token.kind !== "end") items.push(this.expression());
    return this.closed({ kind: "list", items, isTuple: true });
  }
  private closed(node: Node): Node {
    if (this.token.kind !== "end") throw this.stuck();
    return node;
  }

  private get token(): Token {
    return this.tokens[this.at]!;
  }
  private is(value: string): boolean {
    return (this.token.kind === "sign" || this.token.kind === "name") && this.token.value === value;
  }
  private take(value: string): boolean {
    const taken = this.is(value);
    if (taken) this.at++;
    return taken;
  }
  private expect(value: string): void {
    if (!this.take(value)) throw this.stuck(`“${value}” is missing`);
  }
  private stuck(why = ""): Refusal {
    const found = this.token.kind === "end" ? "its end" : `“${String(this.token.value)}”`;
    return new Refusal(
      `The expression “${shorten(this.text.trim())}” is not understood: ${why === "" ? `${found} is not expected there` : why}.`,
    );
  }

  /** `a if b else c`, and all below. */
  private expression(): Node {
    if (++this.depth > DEEPEST) throw new Refusal(`An expression is nested more than ${DEEPEST} deep.`);
    const yes = this.either();
    let node = yes;
    if (this.take("if")) {
      const condition = this.either();
      this.expect("else");
      node = { kind: "choice", condition, yes, no: this.expression() };
    }
    this.depth--;
    return node;
  }
  private either(): Node {
    let left = this.both();
    while (this.take("or")) left = { kind: "either", left, right: this.both() };
    return left;
  }
  private both(): Node {
    let left = this.not();
    while (this.take("and")) left = { kind: "both", left, right: this.not() };
    return left;
  }
  private not(): Node {
    let nots = 0;
    while (this.take("not")) nots++;
    const inner = this.comparison();
    return nots === 0
      ? inner
      : nots % 2 === 1
        ? { kind: "unary", operator: "not", operand: inner }
        : { kind: "unary", operator: "not", operand: { kind: "unary", operator: "not", operand: inner } };
  }
  private comparison(): Node {
    const first = this.binary(0);
    const rest: { operator: string; with: Node }[] = [];
    for (let operator = this.comparator(); operator !== undefined; operator = this.comparator())
      rest.push({ operator, with: this.binary(0) });
    return rest.length === 0 ? first : { kind: "comparison", first, rest };
  }
  private comparator(): string | undefined {
    for (const sign of ["==", "!=", "<=", ">=", "<", ">", "in"]) if (this.take(sign)) return sign;
    if (this.take("is")) return this.take("not") ? "is not" : "is";
    if (this.is("not") && this.tokens[this.at + 1]?.value === "in") {
      this.at += 2;
      return "not in";
    }
    return undefined;
  }
  private binary(level: number): Node {
    const operators = LEVELS[level];
    if (!operators) return this.signed();
    let left = this.binary(level + 1);
    for (
      let operator = operators.find(sign => this.take(sign));
      operator !== undefined;
      operator = operators.find(sign => this.take(sign))
    ) {
      left = { kind: "binary", operator, left, right: this.binary(level + 1) };
    }
    return left;
  }
  /** −a, and a ** b, which binds more on its left and less on its right. */
  private signed(): Node {
    for (const operator of ["-", "+", "~"]) {
      if (!this.take(operator)) continue;
      if (++this.depth > DEEPEST) throw new Refusal(`An expression is nested more than ${DEEPEST} deep.`);
      const operand = this.signed();
      this.depth--;
      return { kind: "unary", operator, operand };
    }
    const base = this.postfix();
    if (!this.take("**")) return base;
    if (++this.depth > DEEPEST) throw new Refusal(`An expression is nested more than ${DEEPEST} deep.`);
    const right = this.signed();
    this.depth--;
    return { kind: "binary", operator: "**", left: base, right };
  }
  private postfix(): Node {
    let node = this.atom();
    for (;;) {
      if (this.take(".")) {
        const name = this.token;
        if (name.kind !== "name") throw this.stuck();
        this.at++;
        node = { kind: "member", of: node, name: name.value };
      } else if (this.take("(")) node = this.call(node);
      else if (this.take("[")) node = this.subscript(node);
      else return node;
    }
  }
  private call(of: Node): Node {
    const values: Node[] = [];
    const named: [string, Node][] = [];
    while (!this.take(")")) {
      const name = this.token;
      const next = this.tokens[this.at + 1];
      if (name.kind === "name" && next?.kind === "sign" && next.value === "=") {
        this.at += 2;
        named.push([name.value, this.expression()]);
      } else {
        const value = this.expression();
        values.push(this.is("for") ? this.each(value) : value);
      }
      if (!this.is(")")) this.expect(",");
    }
    return { kind: "call", of, values, named };
  }
  private subscript(of: Node): Node {
    const part = (): Node | undefined => (this.is(":") || this.is("]") ? undefined : this.expression());
    const from = part();
    if (from && this.take("]")) return { kind: "item", of, at: from };
    this.expect(":");
    const to = part();
    const step = this.take(":") ? part() : undefined;
    this.expect("]");
    return { kind: "slice", of, from, to, step };
  }
  private each(result: Node): Node {
    this.expect("for");
    const names: string[] = [];
    do {
      const name = this.token;
      if (name.kind !== "name") throw this.stuck();
      this.at++;
      names.push(name.value);
    } while (this.take(","));
    this.expect("in");
    const over = this.either();
    const only: Node[] = [];
    while (this.take("if")) only.push(this.either());
    return { kind: "each", result, names, over, only };
  }
  private atom(): Node {
    const token = this.token;
    this.at++;
    switch (token.kind) {
      case "number":
        return { kind: "value", value: token.value };
      case "text": {
        let text = token.value;
        for (let next = this.token; next.kind === "text"; next = this.token) {
          text += next.value;
          this.at++;
        }
        return { kind: "value", value: text };
      }
      case "name": {
        const constant = CONSTANTS.get(token.value);
        if (constant !== undefined) return { kind: "value", value: constant };
        if (!WORDS.has(token.value)) return { kind: "name", name: token.value };
        break;
      }
      case "sign": {
        if (token.value === "(") return this.inParentheses();
        if (token.value === "[") return this.inBrackets();
        if (token.value === "{") return this.inBraces();
        break;
      }
      case "end":
        break;
    }
    this.at--;
    throw this.stuck();
  }
  private inParentheses(): Node {
    if (this.take(")")) return { kind: "list", items: [], isTuple: true };
    const first = this.expression();
    const items = [first];
    if (this.is("for")) {
      const each = this.each(first);
      this.expect(")");
      return each;
    }
    if (this.take(")")) return first;
    while (this.take(",")) if (!this.is(")")) items.push(this.expression());
    this.expect(")");
    return { kind: "list", items, isTuple: true };
  }
  private inBrackets(): Node {
    const items: Node[] = [];
    while (!this.take("]")) {
      const item = this.expression();
      if (this.is("for") && items.length === 0) {
        const each = this.each(item);
        this.expect("]");
        return each;
      }
      items.push(item);
      if (!this.is("]")) this.expect(",");
    }
    return { kind: "list", items, isTuple: false };
  }
  private inBraces(): Node {
    const entries: [Node, Node][] = [];
    while (!this.take("}")) {
      const key = this.expression();
      this.expect(":");
      entries.push([key, this.expression()]);
      if (!this.is("}")) this.expect(",");
    }
    return { kind: "dict", entries };
  }
}
