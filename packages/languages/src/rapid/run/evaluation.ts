import type { Condition, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Expression } from "../../parser/structured/index.ts";
import { Arguments } from "./arguments.ts";
import { times } from "./frame.ts";
import { FUNCTIONS } from "./functions.ts";
import { KIND_OF_FUNCTION } from "./lines.ts";
import { jointsOf, toolFrameOf } from "./records.ts";
import { asNumber, asRecord, asTruth, binary, fromFrame, type Value } from "./values.ts";
import { KeptData } from "./kept-data.ts";
import type { DataDeclaration } from "../read/statements.ts";

/** What expressions of RAPID are worth, and where values go. */
export abstract class Evaluation extends KeptData {
  evaluate(expression: Expression): Value {
    switch (expression.kind) {
      case "number":
      case "truth":
      case "text":
        return expression.value;
      case "variable": {
        const value = this.variable(expression.name) ?? this.lines.level(expression.name);
        if (value === undefined)
          throw new TextError(
            expression,
            "a datum that has a value",
            this.foreign.has(expression.name)
              ? `"${this.spelt(expression.name)}" is what another machine answers: it is not known here.`
              : `"${this.spelt(expression.name)}" has no value here.`,
          );
        return value;
      }
      case "list":
        return expression.items.map(item => this.evaluate(item));
      case "index":
        return expression.indices.reduce<Value>((value, index) => {
          const i = this.numberOf(index);
          const item = typeof value === "object" && Number.isInteger(i) ? value[i - 1] : undefined;
          if (item === undefined) throw new TextError(index, "an item of the array", `The array has no item ${i}.`);
          return item;
        }, this.evaluate(expression.of));
      case "component": {
        const record = this.evaluate(expression.of);
        const place = typeof record === "object" ? this.componentOf(expression.of, record, expression.name) : undefined;
        const value = typeof record === "object" && place !== undefined ? record[place] : undefined;
        if (value === undefined)
          throw new TextError(
            expression,
            "a component of the record",
            `There is no component "${expression.name}" here.`,
          );
        return value;
      }
      case "unary":
        return expression.sign === "not" ? !this.isTrue(expression.of) : -this.numberOf(expression.of);
      case "binary":
        if (COMPARES.has(expression.sign)) this.takeForLine(expression.left);
        return binary(expression.sign, this.evaluate(expression.left), this.evaluate(expression.right), expression);
      case "call":
        return this.function(expression);
    }
  }

  /** A name that is no datum, compared with a value, is that of a line. */
  private takeForLine(expression: Expression): void {
    if (
      expression.kind === "variable" &&
      this.variable(expression.name) === undefined &&
      !this.isDatum(expression.name)
    )
      if (this.lines.level(expression.name) === undefined) this.lines.line(expression.name, "digital-in");
  }

  isTrue(expression: Expression): boolean {
    const when = this.condition(expression);
    return when === undefined ? asTruth(this.evaluate(expression), expression) : this.lines.holds(when);
  }

  numberOf(expression: Expression): number {
    return asNumber(this.evaluate(expression), expression);
  }

  fromNumber(value: number): Value {
    return value;
  }

  protected store(to: Expression, value: Value): void {
    if (to.kind === "variable") {
      const scope = this.scopes.at(-1);
      const declares = (data: readonly DataDeclaration[] | undefined): boolean =>
        data?.some(({ name }) => name === to.name) === true;
      if (scope !== undefined && (scope.names.has(to.name) || declares(this.source.local.get(scope.routine))))
        scope.names.set(to.name, value);
      else if (this.types.has(this.globalKey(to.name))) this.globals.set(this.globalKey(to.name), value);
      else throw new TextError(to, "a datum that is declared", `"${this.spelt(to.name)}" is not declared.`);
      return;
    }
    if (to.kind === "component") {
      const record = this.evaluate(to.of);
      const place = typeof record === "object" ? this.componentOf(to.of, record, to.name) : undefined;
      if (typeof record !== "object" || place === undefined || place >= record.length)
        throw new TextError(to, "a component of the record", `There is no component "${to.name}" here.`);
      return this.store(to.of, record.with(place, value));
    }
    if (to.kind === "index") {
      const [index, ...rest] = to.indices;
      const array = this.evaluate(to.of);
      const i = this.numberOf(index!);
      if (typeof array !== "object" || !Number.isInteger(i) || i < 1 || i > array.length)
        throw new TextError(index!, "an item of the array", `The array has no item ${i}.`);
      const inner: Expression = { kind: "index", of: to.of, indices: [index!], line: to.line, column: to.column };
      return rest.length > 0
        ? this.store({ kind: "index", of: inner, indices: rest, line: to.line, column: to.column }, value)
        : this.store(to.of, array.with(i - 1, value));
    }
    throw new TextError(to, "a datum", "Only a datum can be given a value.");
  }

  private function(expression: Extract<Expression, { kind: "call" }>): Value {
    const { name, args: given } = expression;
    const routine = this.routine(name);
    if (routine !== undefined) return this.answer(routine, given, expression);
    const args = new Arguments(name, given, expression, each => this.evaluate(each));
    switch (name) {
      case "crobt":
      case "cjointt":
      case "cpos":
        if (this.lost !== undefined)
          throw new TextError(expression, "a position that is known", `${this.lost} Where it is now is not known.`);
        break;
      default:
        break;
    }
    switch (name) {
      case "crobt": {
        const base = times(this.arm.flange, this.tool);
        return [...asRecord(fromFrame(base), expression, 2, "a pose"), [...this.arm.configuration()], NO_AXES];
      }
      case "cjointt":
        return [this.jointsNow(expression), NO_AXES];
      case "cpos":
        return [...times(this.arm.flange, this.tool).mm];
      case "calcrobt":
        return [
          ...asRecord(
            fromFrame(
              times(
                this.arm.flangeAt(jointsOf(args.value(0, "a jointtarget"), expression)),
                toolFrameOf(args.value(1, "a tool"), expression),
              ),
            ),
            expression,
            2,
            "a pose",
          ),
          [0, 0, 0, 0],
          NO_AXES,
        ];
      case "testdi":
      case "dinput":
      case "doutput":
      case "ainput":
      case "aoutput": {
        const value = this.lines.read(this.lines.line(args.nameOf(0, "a line"), KIND_OF_FUNCTION[name]!));
        return name === "testdi" ? value === true : Number(value);
      }
      default:
        return this.computed(expression, args);
    }
  }

  /** What is made of texts and arrays, what the controller answers, and what is computed. */
  private computed(expression: Extract<Expression, { kind: "call" }>, args: Arguments): Value {
    const { name, args: given } = expression;
    switch (name) {
      case "strtoval": {
        const to = given[1]?.value;
        const text = args.value(0, "a text");
        const value = typeof text === "string" ? readValue(text) : undefined;
        if (to === undefined || value === undefined) return false;
        this.store(to, value);
        return true;
      }
      case "dim":
        return this.sizeOf(expression, args);
      case "gettaskname":
        return "T_ROB1";
      case "opmode":
      case "clkread":
      case "runmode":
      case "robos":
        return this.ofController(name, expression);
      case "isfile":
      case "present": {
        const parameter = given[0]?.value;
        return parameter?.kind === "variable" && this.scopes.at(-1)?.names.has(parameter.name) === true;
      }
      default:
        break;
    }
    return this.byName(expression, args);
  }

  /** The size of an array in one of its dimensions. */
  private sizeOf(expression: Extract<Expression, { kind: "call" }>, args: Arguments): Value {
    const array = args.value(0, "an array");
    const depth = args.number(1, "the dimension");
    let part: Value | undefined = array;
    for (let i = 1; i < depth; i++) part = typeof part === "object" ? part[0] : undefined;
    if (typeof part !== "object") throw new TextError(expression, "an array", "Dim asks for the size of an array.");
    return part.length;
  }

  /** A function that computes with values. */
  private byName(expression: Extract<Expression, { kind: "call" }>, args: Arguments): Value {
    const { name } = expression;
    const known = Object.hasOwn(FUNCTIONS, name) ? FUNCTIONS[name] : undefined;
    if (known === undefined)
      throw new TextError(expression, "a function of RAPID", `"${name}" is no function that is understood here.`);
    const [count, run] = known;
    if (args.count !== count)
      throw new TextError(
        expression,
        `${count} argument${count === 1 ? "" : "s"}`,
        `${name} takes ${count} argument${count === 1 ? "" : "s"}; ${args.count} are given.`,
      );
    return run(args.values(), args.options(), expression);
  }

  /** What only a controller knows: taken as for one that runs in automatic, and no time passes. */
  private ofController(name: string, at: TextPlace): Value {
    this.remark(
      name,
      at,
      "a value in the text",
      name === "clkread"
        ? "ClkRead measures time, which does not pass here: it reads 0."
        : `${this.spelt(name)} is asked of the controller: it runs in automatic here.`,
    );
    return name === "robos" ? false : name === "clkread" ? 0 : 1;
  }

  private jointsNow(at: TextPlace): Value {
    const { joints_deg } = this.arm;
    if (joints_deg === undefined)
      throw new TextError(
        at,
        "a MoveAbsJ before it",
        "The joint angles are the controller's choice here, and are not known.",
      );
    return [...joints_deg];
  }

  condition(expression: Expression): Condition | undefined {
    return this.lines.condition(expression, of => this.evaluate(of));
  }
}

const COMPARES = new Set(["=", "<>", "<", ">", "<=", ">="]);

/** The value that a text spells: a number, TRUE or FALSE, or a record of them. */
function readValue(text: string): Value | undefined {
  const plain = text
    .trim()
    .replace(/\bTRUE\b/gi, "true")
    .replace(/\bFALSE\b/gi, "false");
  try {
    const value: unknown = JSON.parse(plain.replace(/(^|[[,\s-])\.(\d)/g, "$10.$2").replace(/(\d)\.(?!\d)/g, "$1"));
    return isValue(value) ? value : undefined;
  } catch (cause) {
    if (cause instanceof SyntaxError) return undefined;
    throw cause;
  }
}

const isValue = (value: unknown): value is Value =>
  typeof value === "number" ||
  typeof value === "boolean" ||
  typeof value === "string" ||
  (Array.isArray(value) && value.every(isValue));

const NO_AXES: Value = [9e9, 9e9, 9e9, 9e9, 9e9, 9e9];
