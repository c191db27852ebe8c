import type { TextPlace } from "@twincell/core";
import { TextError, finite } from "../../parser/index.ts";
import { about, frameOf, shifted, sixOf, trans } from "./frame.ts";
import { asNumber, asPlace, kindOf, type Value } from "./values.ts";

type Entry = readonly [least: number, most: number, evaluate: (args: readonly Value[], at: TextPlace) => Value];
const DEG = Math.PI / 180;
const JOINTS = 6;

const ofNumber = (f: (x: number) => number): Entry => [1, 1, ([x], at) => finite(f(asNumber(x!, at)), at)];
const ofPlace = (i: 0 | 1 | 2): Entry => [1, 1, ([place], at) => asPlace(place!, at).at.p[i]];
const turn = (axis: "x" | "y" | "z"): Entry => [
  1,
  1,
  ([angle], at) => ({ kind: "place", at: about(axis, asNumber(angle!, at)) }),
];

/**
 * Functions that need nothing of the controller, with the number of arguments that each takes. Angles are in degrees.
 */
export const FUNCTIONS: Readonly<Record<string, Entry>> = {
  trans: [
    0,
    6,
    (args, at) => {
      const [x = 0, y = 0, z = 0, o = 0, a = 0, t = 0] = args.map(value => asNumber(value, at));
      return { kind: "place", at: trans([x, y, z, o, a, t]) };
    },
  ],
  // The numbers of a place that POINT/X and its like replace.
  "point/": [
    3,
    3,
    ([parts, old, given], at) => {
      const from = sixOf(asPlace(given!, at).at);
      const six = sixOf(asPlace(old!, at).at).map((value, i) =>
        String(parts).includes("xyzoat"[i]!) ? from[i]! : value,
      );
      const [x = 0, y = 0, z = 0, o = 0, a = 0, t = 0] = six;
      return { kind: "place", at: trans([x, y, z, o, a, t]) };
    },
  ],
  "#ppoint": [
    1,
    JOINTS,
    (args, at) => ({
      kind: "joints",
      deg: Array.from({ length: JOINTS }, (_, i) => (args[i] === undefined ? 0 : asNumber(args[i], at))),
    }),
  ],
  shift: [
    2,
    4,
    ([place, ...by], at) => {
      const [x = 0, y = 0, z = 0] = by.map(value => asNumber(value, at));
      return { kind: "place", at: shifted(asPlace(place!, at).at, x, y, z) };
    },
  ],
  frame: [
    4,
    4,
    ([a, b, c, origin], at) => {
      const made = frameOf(asPlace(a!, at).at, asPlace(b!, at).at, asPlace(c!, at).at, asPlace(origin!, at).at);
      if (made === undefined)
        throw new TextError(at, "three points that span a plane", "The points of FRAME lie on one line.");
      return { kind: "place", at: made };
    },
  ],
  rx: turn("x"),
  ry: turn("y"),
  rz: turn("z"),
  dx: ofPlace(0),
  dy: ofPlace(1),
  dz: ofPlace(2),
  dext: [
    2,
    2,
    ([value, index], at) => {
      const i = asNumber(index!, at);
      const numbers = numbersOf(value!, at);
      if (numbers[i - 1] === undefined)
        throw new TextError(
          at,
          `a number from 1 to ${numbers.length}`,
          `There is no component ${i} in ${numbers.length}.`,
        );
      return numbers[i - 1]!;
    },
  ],
  distance: [
    2,
    2,
    ([a, b], at) => {
      const p = asPlace(a!, at).at.p;
      const q = asPlace(b!, at).at.p;
      return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    },
  ],
  sin: ofNumber(x => Math.sin(x * DEG)),
  cos: ofNumber(x => Math.cos(x * DEG)),
  tan: ofNumber(x => Math.tan(x * DEG)),
  atan2: [2, 2, ([y, x], at) => Math.atan2(asNumber(y!, at), asNumber(x!, at)) / DEG],
  sqrt: ofNumber(Math.sqrt),
  abs: ofNumber(Math.abs),
  int: ofNumber(Math.trunc),
  minval: [1, 8, (args, at) => Math.min(...args.map(value => asNumber(value, at)))],
  maxval: [1, 8, (args, at) => Math.max(...args.map(value => asNumber(value, at)))],
};

/** Six numbers of a place or of joint angles. */
export function numbersOf(value: Value, at: TextPlace): readonly number[] {
  if (typeof value === "object" && value.kind === "place") return sixOf(value.at);
  if (typeof value === "object" && value.kind === "joints") return value.deg;
  throw new TextError(
    at,
    "a location",
    `${kindOf(value).replace(/^./, letter => letter.toUpperCase())} has no components.`,
  );
}
