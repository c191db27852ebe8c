import type { Condition, SignalLine, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Expression, Argument } from "../../parser/structured/index.ts";
import { NOTHING, inverted, times, toSix } from "./trsf.ts";
import { asNumber, binary, finite, kindOf, type Value } from "./values.ts";
import { KeptData } from "./kept-data.ts";

const MATHS: Readonly<Record<string, (x: number, y: number) => number>> = {
  abs: Math.abs,
  sqrt: Math.sqrt,
  min: Math.min,
  max: Math.max,
  round: x => Math.round(x),
  rounddown: x => Math.floor(x),
  roundup: x => Math.ceil(x),
  sin: x => Math.sin((x * Math.PI) / 180),
  cos: x => Math.cos((x * Math.PI) / 180),
  tan: x => Math.tan((x * Math.PI) / 180),
};

/** What expressions of VAL 3 are worth, and lines that are read in them. */
export abstract class Evaluation extends KeptData {
  evaluate(expression: Expression): Value {
    switch (expression.kind) {
      case "number":
      case "truth":
      case "text":
        return expression.value;
      case "variable":
      case "index": {
        const name = this.nameOf(expression);
        const value = name === undefined ? undefined : this.variable(name);
        if (name === "flange" && value === undefined) return { kind: "tool", trsf: NOTHING };
        if (name === "world" && value === undefined) return { kind: "frame", trsf: NOTHING, father: "" };
        if (name === undefined || value === undefined) return this.missing(name, expression);
        return kindOf(value) === "dio" ? this.read(name, "digital-in") : value;
      }
      case "list":
        return expression.items.map(item => this.numberOf(item));
      case "unary":
        return expression.sign === "!" ? !this.isTrue(expression.of) : -this.numberOf(expression.of);
      case "binary":
        return binary(expression.sign, this.evaluate(expression.left), this.evaluate(expression.right), expression);
      case "call":
        return this.function(expression);
      case "component":
        return this.component(expression.of, expression.name, expression);
    }
  }

  private function({ name, args, line, column }: Extract<Expression, { kind: "call" }>): Value {
    const at = { line, column };
    const given = (i: number): Expression => this.given(args, i, name, at);
    switch (name) {
      case "placed":
        return { ...this.of("frame", given(0)), trsf: this.trsf(given(1)) };
      case "appro": {
        const point = this.of("point", given(0));
        return { ...point, trsf: times(point.trsf, this.trsf(given(1))) };
      }
      case "compose": {
        // Moved along the axes of the frame, wherever the point counts from.
        const point = this.of("point", given(0));
        const along = this.chain(this.of("frame", given(1)));
        const father = this.father(point.father, at);
        const moved = times(times(times(along, this.trsf(given(2))), inverted(along)), times(father, point.trsf));
        return { ...point, trsf: times(inverted(father), moved) };
      }
      case "aioGet": {
        const line = this.nameOf(given(0));
        if (line === undefined || !this.isLine(line, "aio"))
          throw new TextError(at, "an analogue line", "aioGet reads an analogue line.");
        return this.read(line, "analogue-in");
      }
      case "dioGet":
        return this.evaluate(given(0));
      case "here": {
        const tool = this.of("tool", given(0));
        const frame = this.chain(this.of("frame", given(1)));
        const father = this.nameOf(given(1)) ?? "world";
        const flange = this.arm.flange();
        if (this.lost !== undefined || flange === undefined)
          throw new TextError(at, "a position that is known", this.lost ?? "Where the robot is is not known here.");
        const config = { shoulder: "ssame", elbow: "esame", wrist: "wsame" };
        return { kind: "point", trsf: times(inverted(frame), times(flange, tool.trsf)), father, config };
      }
      default:
        return this.measured(name, args, at);
    }
  }

  /** Where the robot is, how far places are apart, and what the controller answers. */
  private measured(name: string, args: readonly Argument[], at: TextPlace): Value {
    const given = (i: number): Expression => this.given(args, i, name, at);
    switch (name) {
      case "herej": {
        const { joints_rad } = this.arm;
        if (this.lost !== undefined || joints_rad === undefined)
          throw new TextError(at, "a position that is known", this.lost ?? "Where the robot is is not known here.");
        return { kind: "joint", deg: this.arm.axes.degrees(joints_rad) };
      }
      case "distance": {
        const [p, q] = [this.placeOf(given(0), at), this.placeOf(given(1), at)];
        return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      }
      case "position": {
        const point = this.of("point", given(0));
        const frame = this.chain(this.of("frame", given(1)));
        return toSix(times(inverted(frame), times(this.father(point.father, at), point.trsf)));
      }
      default:
        return this.answered(name, args, at);
    }
  }

  /** What the controller answers, and what is computed. */
  private answered(name: string, args: readonly Argument[], at: TextPlace): Value {
    const given = (i: number): Expression => this.given(args, i, name, at);
    switch (name) {
      case "toString": {
        const value = this.numberOf(given(args.length > 1 ? 1 : 0));
        return String(value);
      }
      case "size":
        return this.sizeOf(given(0));
      case "isEmpty":
      case "isSettled":
      case "isPowered":
      case "isCalibrated":
      case "workingMode":
      case "esStatus":
      case "clock":
      case "getMonitorSpeed":
      case "getKey":
      case "taskStatus":
      case "setMonitorSpeed":
        return this.ofController(name, at);
      default: {
        const maths = Object.hasOwn(MATHS, name) ? MATHS[name] : undefined;
        if (maths === undefined)
          throw new TextError(at, "a function of VAL 3", `"${name}" is no function that is understood here.`);
        return finite(maths(this.numberOf(given(0)), args.length > 1 ? this.numberOf(given(1)) : 0), at);
      }
    }
  }

  /** What only a controller knows: one that runs by itself, stands still and is asked by nobody. */
  private ofController(name: string, at: TextPlace): Value {
    this.remark(
      name,
      at,
      "a value in the text",
      `${name} is asked of the controller: it runs by itself here, and no time passes.`,
    );
    if (name.startsWith("is")) return true;
    return name === "workingMode"
      ? 4
      : name === "taskStatus"
        ? 1
        : name === "getKey"
          ? -1
          : name === "clock" || name === "esStatus"
            ? 0
            : 100;
  }

  isTrue(expression: Expression): boolean {
    const when = this.condition(expression);
    if (when !== undefined) {
      this.settled(expression);
      return this.holds(when);
    }
    const value = this.evaluate(expression);
    if (typeof value !== "boolean") throw new TextError(expression, "a condition", "This is neither true nor false.");
    return value;
  }

  numberOf(expression: Expression): number {
    return asNumber(this.evaluate(expression), expression);
  }

  fromNumber(value: number): Value {
    return value;
  }

  private read(name: string, kind: SignalLine["kind"]): boolean | number {
    this.declared.signals[name] ??= { kind };
    const value = this.outputs.get(name) ?? this.signals?.read(name);
    return kind.startsWith("digital")
      ? value === true || (typeof value === "number" && value !== 0)
      : Number(value ?? 0);
  }

  private holds(when: Condition): boolean {
    if ("is" in when) return (this.read(when.signal, "digital-in") === true) === when.is;
    const value = Number(this.read(when.signal, "analogue-in"));
    return "above" in when ? value > when.above : value < when.below;
  }

  condition(expression: Expression): Condition | undefined {
    switch (expression.kind) {
      case "variable":
      case "index": {
        const name = this.nameOf(expression);
        if (name === undefined || kindOf(this.variable(name)) !== "dio") return undefined;
        this.declared.signals[name] ??= { kind: "digital-in" };
        return { signal: name, is: true };
      }
      case "unary": {
        const inner = expression.sign === "!" ? this.condition(expression.of) : undefined;
        return inner !== undefined && "is" in inner ? { signal: inner.signal, is: !inner.is } : undefined;
      }
      case "binary":
        return this.comparison(expression);
      default:
        return undefined;
    }
  }

  /** A line that is compared with a value. */
  private comparison(expression: Extract<Expression, { kind: "binary" }>): Condition | undefined {
    const { sign, left, right } = expression;
    if (right.kind === "truth" && (sign === "==" || sign === "!=")) {
      const inner = this.condition(left);
      return inner !== undefined && "is" in inner
        ? { signal: inner.signal, is: inner.is === (right.value === (sign === "==")) }
        : undefined;
    }
    const line =
      left.kind === "call" && left.name === "aioGet" && left.args[0]?.value !== undefined
        ? this.nameOf(left.args[0].value)
        : undefined;
    if (
      line === undefined ||
      right.kind !== "number" ||
      kindOf(this.variable(line)) !== "aio" ||
      (sign !== "<" && sign !== ">")
    )
      return undefined;
    this.declared.signals[line] ??= { kind: "analogue-in" };
    return sign === ">" ? { signal: line, above: right.value } : { signal: line, below: right.value };
  }

  /** Lines are read and written when the program comes to them, not when the robot does. */
  protected settled(at: TextPlace): void {
    if (this.moving)
      this.remark(
        `overtakes ${at.line}`,
        at,
        "waitEndMove()",
        "This overtakes the motion before it on the controller: it is carried out when the robot is there here.",
      );
  }
}
