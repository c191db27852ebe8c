import type { TextPlace } from "@twincell/core";
import { TextError, finite } from "../../parser/index.ts";
import { eulerZyx, inverted, orientZyx, times, turned } from "./frame.ts";
import { asFrame, asNumber, asOrient, asPosition, asRecord, fromFrame, type Value } from "./values.ts";

/** Optional arguments by their names. */
export type Options = ReadonlyMap<string, Value | true>;
type Evaluate = (args: readonly Value[], options: Options, at: TextPlace) => Value;
type Entry = readonly [count: number, evaluate: Evaluate];

const rad = (angle: number): number => (angle / 180) * Math.PI;
const deg = (angle: number): number => (angle / Math.PI) * 180;
const ofNumber = (f: (x: number) => number): Entry => [1, ([x], _, at) => finite(f(asNumber(x!, at)), at)];
const ofNumbers = (f: (x: number, y: number) => number): Entry => [
  2,
  ([x, y], _, at) => finite(f(asNumber(x!, at), asNumber(y!, at)), at),
];
const option = (options: Options, name: string, at: TextPlace): number => {
  const value = options.get(name);
  return value === undefined || value === true ? 0 : asNumber(value, at);
};

function rounded(x: Value | undefined, options: Options, at: TextPlace, cut: (x: number) => number): number {
  const places = 10 ** option(options, "dec", at);
  return finite(cut(asNumber(x!, at) * places) / places, at);
}

function asText(value: Value | undefined, at: TextPlace): string {
  if (typeof value !== "string") throw new TextError(at, "a text", "Something else stands where a text is expected.");
  return value;
}

/** A robtarget with another pose. */
function moved(
  target: Value | undefined,
  at: TextPlace,
  change: (mm: readonly [number, number, number], wxyz: readonly [number, number, number, number]) => Value,
): Value {
  const record = asRecord(target, at, 4, "a robtarget");
  const [trans, rot] = asRecord(change(asPosition(record[0], at), asOrient(record[1], at)), at, 2, "a pose");
  return [trans!, rot!, record[2]!, record[3]!];
}

/** Functions that need nothing of the controller, with the number of arguments that each must have. */
export const FUNCTIONS: Readonly<Record<string, Entry>> = {
  abs: ofNumber(Math.abs),
  sqrt: ofNumber(Math.sqrt),
  sin: ofNumber(x => Math.sin(rad(x))),
  cos: ofNumber(x => Math.cos(rad(x))),
  tan: ofNumber(x => Math.tan(rad(x))),
  asin: ofNumber(x => deg(Math.asin(x))),
  acos: ofNumber(x => deg(Math.acos(x))),
  atan: ofNumber(x => deg(Math.atan(x))),
  atan2: ofNumbers((y, x) => deg(Math.atan2(y, x))),
  pow: ofNumbers((x, y) => x ** y),
  exp: ofNumber(Math.exp),
  round: [1, ([x], options, at) => rounded(x, options, at, Math.round)],
  trunc: [1, ([x], options, at) => rounded(x, options, at, Math.trunc)],
  numtostr: [
    2,
    ([x, places], _, at) => asNumber(x!, at).toFixed(Math.max(0, Math.min(15, Math.trunc(asNumber(places!, at))))),
  ],
  strlen: [1, ([x], _, at) => asText(x, at).length],
  strpart: [
    3,
    ([x, from, count], _, at) => {
      const text = asText(x, at);
      const first = asNumber(from!, at);
      const length = asNumber(count!, at);
      if (!(first >= 1 && length >= 0 && first - 1 + length <= text.length))
        throw new TextError(at, "a part of the text", `The text has no ${length} characters from ${first} on.`);
      return text.slice(first - 1, first - 1 + length);
    },
  ],
  strfind: [
    3,
    ([x, from, set], options, at) => {
      const text = asText(x, at);
      const signs = asText(set, at);
      const is = (sign: string): boolean => signs.includes(sign) !== options.has("notinset");
      const found = [...text].findIndex((sign, i) => i >= asNumber(from!, at) - 1 && is(sign));
      return found < 0 ? text.length + 1 : found + 1;
    },
  ],
  strmatch: [
    3,
    ([x, from, pattern], _, at) => {
      const text = asText(x, at);
      const found = text.indexOf(asText(pattern, at), Math.max(0, asNumber(from!, at) - 1));
      return found < 0 ? text.length + 1 : found + 1;
    },
  ],
  strmap: [
    3,
    ([x, from, to], _, at) => {
      const signs = asText(from, at);
      const others = asText(to, at);
      return [...asText(x, at)]
        .map(sign => (signs.includes(sign) ? (others[signs.indexOf(sign)] ?? sign) : sign))
        .join("");
    },
  ],
  numtodnum: [1, ([x], _, at) => asNumber(x!, at)],
  dnumtonum: [1, ([x], _, at) => asNumber(x!, at)],
  vectmagn: [1, ([x], _, at) => Math.hypot(...asPosition(x, at))],
  dotprod: [
    2,
    ([a, b], _, at) => {
      const q = asPosition(b, at);
      return asPosition(a, at).reduce((sum, x, i) => sum + x * q[i]!, 0);
    },
  ],
  valtostr: [1, ([x]) => (typeof x === "string" ? x : JSON.stringify(x))],
  distance: [
    2,
    ([a, b], _, at) => {
      const p = asPosition(a, at);
      const q = asPosition(b, at);
      return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    },
  ],
  orientzyx: [3, ([z, y, x], _, at) => [...orientZyx(asNumber(z!, at), asNumber(y!, at), asNumber(x!, at))]],
  eulerzyx: [
    1,
    ([rot], options, at) => {
      const [x, y, z] = eulerZyx(asOrient(rot, at));
      if (options.has("x")) return x;
      if (options.has("y")) return y;
      if (options.has("z")) return z;
      throw new TextError(at, "\\X, \\Y or \\Z", "EulerZYX is asked for no angle.");
    },
  ],
  posemult: [2, ([a, b], _, at) => fromFrame(times(asFrame(a, at), asFrame(b, at)))],
  poseinv: [1, ([a], _, at) => fromFrame(inverted(asFrame(a, at)))],
  posevect: [
    2,
    ([a, v], _, at) => {
      const p = asFrame(a, at);
      const t = turned(p.wxyz, asPosition(v, at));
      return [p.mm[0] + t[0], p.mm[1] + t[1], p.mm[2] + t[2]];
    },
  ],
  // Along the axes of the work object.
  offs: [
    4,
    ([target, dx, dy, dz], _, at) =>
      moved(target, at, (mm, wxyz) => [
        [mm[0] + asNumber(dx!, at), mm[1] + asNumber(dy!, at), mm[2] + asNumber(dz!, at)],
        [...wxyz],
      ]),
  ],
  // Along and about the axes of the tool: the shift first, then turns about x, y and z, each about the axes as turned
  // by then.
  reltool: [
    4,
    ([target, dx, dy, dz], options, at) =>
      moved(target, at, (mm, wxyz) => {
        const shift = turned(wxyz, [asNumber(dx!, at), asNumber(dy!, at), asNumber(dz!, at)]);
        const about = (x: number, y: number, z: number): ReturnType<typeof orientZyx> => orientZyx(z, y, x);
        const spin = [
          about(option(options, "rx", at), 0, 0),
          about(0, option(options, "ry", at), 0),
          about(0, 0, option(options, "rz", at)),
        ].reduce((a, b) => times({ mm: [0, 0, 0], wxyz: a }, { mm: [0, 0, 0], wxyz: b }).wxyz, wxyz);
        return [[mm[0] + shift[0], mm[1] + shift[1], mm[2] + shift[2]], [...spin]];
      }),
  ],
};
