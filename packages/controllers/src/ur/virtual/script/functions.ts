import { ScriptError, type At } from "./fault.ts";
import { inverted, matrixOf, sixOf, times } from "./pose.ts";
import { asNumber, asNumbers, asPose, asText, isList, type Value } from "./values.ts";

/** What a function is called with: by place, or by name. */
export class Arguments {
  readonly at: At;
  private readonly placed: readonly Value[];
  private readonly named: ReadonlyMap<string, Value>;
  constructor(at: At, placed: readonly Value[], named: ReadonlyMap<string, Value>) {
    this.at = at;
    this.placed = placed;
    this.named = named;
  }
  get count(): number {
    return this.placed.length + this.named.size;
  }
  get all(): readonly Value[] {
    return this.placed;
  }
  maybe(i: number, name: string): Value | undefined {
    return this.placed[i] ?? this.named.get(name);
  }
  value(i: number, name: string): Value {
    const value = this.maybe(i, name);
    if (value === undefined) throw new ScriptError(this.at, `The argument "${name}" is missing.`);
    return value;
  }
  number(i: number, name: string, otherwise?: number): number {
    const value = this.maybe(i, name);
    return value === undefined && otherwise !== undefined ? otherwise : asNumber(this.value(i, name), this.at);
  }
  numbers(i: number, name: string, count: number): readonly number[] {
    return asNumbers(this.value(i, name), count, this.at);
  }
}

/** One that takes time goes on with the next cycle of the controller at every `yield`. */
export type ScriptFunction = (args: Arguments, thread: number) => Value | Generator<void, Value>;

const one =
  (f: (x: number) => number): ScriptFunction =>
  args => {
    const value = f(args.number(0, "f"));
    if (!Number.isFinite(value)) throw new ScriptError(args.at, "The result is no number.");
    return value;
  };
const length = (args: Arguments): number => {
  const value = args.value(0, "list");
  return typeof value === "string" ? value.length : asNumbers(value, undefined, args.at).length;
};
const pose = (six: readonly number[]): Value => ({ pose: six });

/** Functions that need no robot. */
export const PURE: Readonly<Record<string, ScriptFunction>> = {
  sin: one(Math.sin),
  cos: one(Math.cos),
  tan: one(Math.tan),
  asin: one(Math.asin),
  acos: one(Math.acos),
  atan: one(Math.atan),
  sqrt: one(Math.sqrt),
  floor: one(Math.floor),
  ceil: one(Math.ceil),
  d2r: one(x => (x / 180) * Math.PI),
  r2d: one(x => (x / Math.PI) * 180),
  integer: one(Math.trunc),
  abs: one(Math.abs),
  atan2: args => Math.atan2(args.number(0, "x"), args.number(1, "y")),
  pow: args => args.number(0, "base") ** args.number(1, "exponent"),
  norm: args => {
    const value = args.value(0, "a");
    return typeof value === "number" ? Math.abs(value) : Math.hypot(...asNumbers(value, undefined, args.at));
  },
  size: length,
  get_list_length: length,
  length,
  to_str: args => asText(args.value(0, "val")),
  str_cat: args => asText(args.value(0, "op1")) + asText(args.value(1, "op2")),
  make_list: args => {
    const count = args.number(0, "length");
    const value = args.value(1, "initial_value");
    if (!Number.isInteger(count) || count < 0 || count > 1000)
      throw new ScriptError(args.at, `A list of ${count} items cannot be made.`);
    return Array.from({ length: count }, () => value);
  },
  pose_trans: args =>
    pose(
      sixOf(
        times(
          matrixOf(asPose(args.value(0, "p_from"), args.at)),
          matrixOf(asPose(args.value(1, "p_from_to"), args.at)),
        ),
      ),
    ),
  pose_inv: args => pose(sixOf(inverted(matrixOf(asPose(args.value(0, "p_from"), args.at))))),
  pose_add: args => pose(sumOf(asPose(args.value(0, "p_1"), args.at), asPose(args.value(1, "p_2"), args.at), 1)),
  pose_sub: args => pose(sumOf(asPose(args.value(0, "p_to"), args.at), asPose(args.value(1, "p_from"), args.at), -1)),
  assert: args => {
    if (args.value(0, "expr") !== true) throw new ScriptError(args.at, "An assertion of the program does not hold.");
    return null;
  },
  is_list: args => isList(args.value(0, "value")),
};

/** Places add; turns follow each other:  R₁ R₂, or R₂ᵀ R₁ for a difference. */
function sumOf(a: readonly number[], b: readonly number[], sign: 1 | -1): readonly number[] {
  const p = matrixOf(a);
  const q = matrixOf(b);
  const turnP = { r: p.r, p: [0, 0, 0] };
  const turnQ = { r: q.r, p: [0, 0, 0] };
  const turned = sign === 1 ? times(turnP, turnQ) : times(inverted(turnQ), turnP);
  return sixOf({ r: turned.r, p: p.p.map((value, i) => value + sign * q.p[i]!) });
}
