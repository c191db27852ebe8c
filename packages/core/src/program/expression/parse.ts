import {
  BINARY,
  DEEPEST_EXPRESSION,
  FUNCTIONS,
  FUNCTION_NAMES,
  MOST_PARTS,
  type BinaryOperator,
  type Expression,
  type ValueType,
} from "./expression.ts";
import { checkType, type ExpressionScope } from "./typing.ts";
import { WRITTEN_UNITS } from "./words.ts";

/** `at` and `length` say which characters are meant, counted from 0. */
export type ExpressionAnswer =
  | { readonly kind: "expression"; readonly expression: Expression }
  | { readonly kind: "fault"; readonly at: number; readonly length: number; readonly sentence: string };

/** Names, numbers, and signs; a name in quotes keeps its spaces. */
const TOKEN =
  /\s*(?:(?<number>\d+(?:\.\d*)?(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?)|(?<name>[\p{L}_][\p{L}\p{N}_]*)|"(?<quoted>(?:[^"\\]|\\.)*)"|(?<sign><>|!=|<=|>=|==|[-+*/()<>=,°]))/uy;
const UNIT = /\s*(mm\/s|m\/s|deg\/s|rad\/s|mm|ms|m|deg|rad|°|s|kg)(?![\p{L}\p{N}_])/uy;
const LONGEST = 2000;

interface Token {
  readonly kind: "number" | "name" | "quoted" | "sign" | "end";
  readonly text: string;
  readonly at: number;
  readonly length: number;
}
/** A part with the characters it stands for. */
interface Parsed {
  readonly expression: Expression;
  readonly at: number;
  readonly end: number;
  readonly of: readonly Parsed[];
}

class TextFault extends Error {
  readonly at: number;
  readonly length: number;
  constructor(at: number, length: number, sentence: string) {
    super(sentence);
    this.at = at;
    this.length = length;
  }
}

/**
 * Reads an expression as a person types it, such as `count + 1 < 9 and not part_there` or `3 * 40 mm`, and holds its
 * names and units to the scope. Never throws; a fault says which characters are wrong.
 */
export function parseExpression(text: string, wanted: ValueType, scope: ExpressionScope): ExpressionAnswer {
  if (text.length > LONGEST)
    return { kind: "fault", at: LONGEST, length: text.length - LONGEST, sentence: "The expression is too long." };
  try {
    const reader = new TextReader(text, scope);
    const parsed = reader.whole();
    const typed = checkType(parsed.expression, wanted, scope);
    if (typed.kind === "typed") return { kind: "expression", expression: parsed.expression };
    const part = typed.at.reduce((each, i) => each.of[i] ?? each, parsed);
    return { kind: "fault", at: part.at, length: part.end - part.at, sentence: typed.sentence };
  } catch (cause) {
    if (!(cause instanceof TextFault)) throw cause;
    return { kind: "fault", at: cause.at, length: cause.length, sentence: cause.message };
  }
}

class TextReader {
  private readonly text: string;
  private readonly scope: ExpressionScope;
  private at = 0;
  private token: Token;
  private end = 0;
  private parts = 0;
  private depth = 0;

  constructor(text: string, scope: ExpressionScope) {
    this.text = text;
    this.scope = scope;
    this.token = this.next();
  }

  whole(): Parsed {
    const parsed = this.either();
    if (this.token.kind !== "end") this.fail(`“${this.token.text}” does not belong here.`);
    return parsed;
  }

  private next(): Token {
    TOKEN.lastIndex = this.at;
    const match = TOKEN.exec(this.text);
    if (match === null) {
      const rest = this.text.slice(this.at);
      const from = this.at + rest.length - rest.trimStart().length;
      if (from === this.text.length) return { kind: "end", text: "the end", at: from, length: 0 };
      throw new TextFault(from, 1, `“${this.text[from]!}” means nothing in an expression.`);
    }
    const groups = match.groups!;
    const kind = (["number", "name", "quoted", "sign"] as const).find(each => groups[each] !== undefined)!;
    const from = this.at + match[0].length - match[0].trimStart().length;
    this.at = TOKEN.lastIndex;
    return { kind, text: groups[kind]!, at: from, length: this.at - from };
  }

  /** Whether the next thing is that sign. */
  private isSign(sign: string): boolean {
    return this.token.kind === "sign" && this.token.text === sign;
  }

  private take(): Token {
    const { token } = this;
    this.end = token.at + token.length;
    this.token = this.next();
    return token;
  }

  private fail(sentence: string, token = this.token): never {
    throw new TextFault(token.at, Math.max(1, token.length), sentence);
  }

  private isWord(word: string): boolean {
    return this.token.kind === "name" && this.token.text.toLowerCase() === word;
  }

  private node(expression: Expression, at: number, of: readonly Parsed[] = []): Parsed {
    if (++this.parts > MOST_PARTS)
      throw new TextFault(at, this.end - at, `An expression has ${MOST_PARTS} parts at most.`);
    return { expression, at, end: this.end, of };
  }

  private joined(op: BinaryOperator, a: Parsed, b: Parsed): Parsed {
    return this.node({ op, of: [a.expression, b.expression] }, a.at, [a, b]);
  }

  private either(): Parsed {
    if (++this.depth > 4 * DEEPEST_EXPRESSION) this.fail(`An expression is ${DEEPEST_EXPRESSION} deep at most.`);
    let left = this.both();
    while (this.isWord("or")) {
      this.take();
      left = this.joined("or", left, this.both());
    }
    this.depth--;
    return this.shallow(left);
  }

  private both(): Parsed {
    let left = this.negated();
    while (this.isWord("and")) {
      this.take();
      left = this.joined("and", left, this.negated());
    }
    return left;
  }

  private negated(): Parsed {
    if (!this.isWord("not")) return this.compared();
    if (++this.depth > 4 * DEEPEST_EXPRESSION) this.fail(`An expression is ${DEEPEST_EXPRESSION} deep at most.`);
    const { at } = this.take();
    const inner = this.negated();
    this.depth--;
    return this.node({ op: "not", of: [inner.expression] }, at, [inner]);
  }

  private compared(): Parsed {
    const left = this.sum();
    const op = this.comparison();
    if (op === undefined) return left;
    this.take();
    const both = this.joined(op, left, this.sum());
    if (this.comparison() !== undefined) this.fail("Two comparisons in a row: join them by “and”.");
    return both;
  }

  private comparison(): BinaryOperator | undefined {
    if (this.token.kind !== "sign") return undefined;
    const sign = { "==": "=", "!=": "<>" }[this.token.text] ?? this.token.text;
    return ["=", "<>", "<", "<=", ">", ">="].includes(sign) ? BINARY.find(op => op === sign) : undefined;
  }

  private sum(): Parsed {
    let left = this.product();
    while (this.isSign("+") || this.isSign("-")) {
      const op = this.take().text as "+" | "-";
      left = this.joined(op, left, this.product());
    }
    return left;
  }

  private product(): Parsed {
    let left = this.signed();
    for (;;) {
      const op = (["*", "/"] as const).find(sign => this.isSign(sign));
      const word = (["div", "mod"] as const).find(each => this.isWord(each));
      const found = op ?? word;
      if (found === undefined) return left;
      this.take();
      left = this.joined(found, left, this.signed());
    }
  }

  private signed(): Parsed {
    if (!this.isSign("-")) return this.leaf();
    if (++this.depth > 4 * DEEPEST_EXPRESSION) this.fail(`An expression is ${DEEPEST_EXPRESSION} deep at most.`);
    const { at } = this.take();
    // -3 is a number; -x and -(3) are a sign before something.
    const isNumber = (this.token as Token).kind === "number";
    const inner = this.signed();
    this.depth--;
    if (isNumber) {
      const { expression } = inner;
      if (typeof expression === "number") return this.node(0 - expression, at);
      if (typeof expression === "object" && "value" in expression)
        return this.node({ ...expression, value: 0 - expression.value }, at);
    }
    return this.node({ op: "neg", of: [inner.expression] }, at, [inner]);
  }

  private leaf(): Parsed {
    const { token } = this;
    switch (token.kind) {
      case "number":
        return this.number();
      case "quoted":
        this.take();
        return this.node({ signal: token.text.replaceAll(/\\(.)/g, "$1") }, token.at);
      case "name":
        return this.named();
      case "sign":
        if (token.text === "(") {
          this.take();
          const inner = this.either();
          this.close();
          return { ...inner, at: token.at, end: this.end };
        }
    }
    return this.fail(
      token.kind === "end" ? "Here the expression breaks off: a value is missing." : `“${token.text}” is not a value.`,
    );
  }

  private close(): void {
    if (!this.isSign(")")) this.fail("A closing bracket is missing here.");
    this.take();
  }

  private number(): Parsed {
    const { text, at } = this.token;
    UNIT.lastIndex = at + text.length;
    const unit = UNIT.exec(this.text);
    const value = Number(text);
    if (!Number.isFinite(value)) this.fail("The number is too large.");
    if (unit === null) {
      this.take();
      return this.node(value, at);
    }
    this.at = UNIT.lastIndex;
    this.end = this.at;
    this.token = this.next();
    const written = WRITTEN_UNITS[unit[1]!]!;
    return this.node({ value: written.into(value), unit: written.unit }, at);
  }

  private named(): Parsed {
    const token = this.take();
    const word = token.text.toLowerCase();
    if (word === "true" || word === "false") return this.node(word === "true", token.at);
    const call = FUNCTION_NAMES.find(name => name === word);
    if (call !== undefined) return this.call(call, token);
    if (["and", "or", "not", "div", "mod"].includes(word)) this.fail(`“${token.text}” is not a value.`, token);
    if (this.isSign("("))
      this.fail(`There is no function “${token.text}”; there are ${FUNCTION_NAMES.join(", ")}.`, token);
    if (this.scope.variable(token.text) !== undefined) return this.node({ variable: token.text }, token.at);
    const line = this.scope.signal(token.text);
    if (line === undefined || line === "unknown")
      this.fail(`There is no variable and no signal “${token.text}”.`, token);
    return this.node({ signal: token.text }, token.at);
  }

  private call(call: keyof typeof FUNCTIONS, token: Token): Parsed {
    if (!this.isSign("(")) this.fail(`“${call}” is a function: ${call}( … ).`, token);
    this.take();
    const parts = [this.either()];
    while (this.isSign(",")) {
      this.take();
      parts.push(this.either());
    }
    this.close();
    if (parts.length !== FUNCTIONS[call])
      this.fail(
        `“${call}” takes ${FUNCTIONS[call] === 1 ? "one value" : "two values"}; here are ${parts.length}.`,
        token,
      );
    return this.node({ call, of: parts.map(part => part.expression) }, token.at, parts);
  }

  /** Deep trees are refused where they were typed. */
  private shallow(parsed: Parsed): Parsed {
    if (depthOf(parsed) > DEEPEST_EXPRESSION)
      throw new TextFault(parsed.at, parsed.end - parsed.at, `An expression is ${DEEPEST_EXPRESSION} deep at most.`);
    return parsed;
  }
}

const depthOf = (parsed: Parsed): number => 1 + parsed.of.reduce((most, part) => Math.max(most, depthOf(part)), 0);
