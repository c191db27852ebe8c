import type { TextPlace } from "@twincell/core";
import { TextError, inverted, times, finite } from "../../parser/index.ts";
import { fromRollPitchYaw, matrixOf, sixOf, toRollPitchYaw, type Six } from "./frame.ts";
import { asNumber, asNumbers, asPose, kindOf, poseOf, type ListValue, type PoseValue, type Value } from "./values.ts";

type Evaluate = (args: readonly Value[], at: TextPlace) => Value;
type Entry = readonly [least: number, most: number, evaluate: Evaluate];

const list = (items: readonly Value[]): ListValue => ({ kind: "list", items: [...items] });
const pose = (six: Six): PoseValue => ({ kind: "pose", six });
const ofNumber = (f: (x: number) => number): Entry => [1, 1, ([x], at) => finite(f(asNumber(x!, at)), at)];
const ofNumbers = (f: (x: number, y: number) => number): Entry => [
  2,
  2,
  ([x, y], at) => finite(f(asNumber(x!, at), asNumber(y!, at)), at),
];

/** The numbers of a pose or a list. */
export function numbersOf(value: Value, at: TextPlace): readonly number[] {
  if (typeof value === "object") return value.kind === "pose" ? value.six : value.items.map(item => asNumber(item, at));
  throw new TextError(
    at,
    "a pose or a list",
    `${kindOf(value)} has no components.`.replace(/^./, letter => letter.toUpperCase()),
  );
}

const norm: Entry = [
  1,
  1,
  ([value], at) => (typeof value === "number" ? Math.abs(value) : Math.hypot(...numbersOf(value!, at))),
];
const isText = (value: Value): string =>
  typeof value === "string"
    ? value
    : typeof value === "boolean"
      ? value
        ? "True"
        : "False"
      : typeof value === "number"
        ? String(value)
        : value.kind === "pose"
          ? `p[${value.six.join(", ")}]`
          : `[${value.items.map(isText).join(", ")}]`;

/** Functions that need nothing of the controller, with the number of arguments that each takes. */
export const FUNCTIONS: Readonly<Record<string, Entry>> = {
  sin: ofNumber(Math.sin),
  cos: ofNumber(Math.cos),
  tan: ofNumber(Math.tan),
  asin: ofNumber(Math.asin),
  acos: ofNumber(Math.acos),
  atan: ofNumber(Math.atan),
  atan2: ofNumbers(Math.atan2),
  pow: ofNumbers((x, y) => x ** y),
  sqrt: ofNumber(Math.sqrt),
  floor: ofNumber(Math.floor),
  ceil: ofNumber(Math.ceil),
  log: [2, 2, ([base, x], at) => finite(Math.log(asNumber(x!, at)) / Math.log(asNumber(base!, at)), at)],
  d2r: ofNumber(x => (x / 180) * Math.PI),
  r2d: ofNumber(x => (x / Math.PI) * 180),
  norm,
  abs: [1, 1, ([x], at) => Math.abs(asNumber(x!, at))],
  integer: ofNumber(Math.trunc),
  size: [1, 1, ([value], at) => (typeof value === "string" ? value.length : numbersOf(value!, at).length)],
  length: [1, 1, ([value], at) => (typeof value === "string" ? value.length : numbersOf(value!, at).length)],
  to_str: [1, 1, ([value]) => isText(value!)],
  str_cat: [2, 2, ([a, b]) => isText(a!) + isText(b!)],
  str_concat: [2, 2, ([a, b]) => isText(a!) + isText(b!)],
  pose_trans: [2, 2, ([a, b], at) => pose(sixOf(times(matrixOf(asPose(a!, at).six), matrixOf(asPose(b!, at).six))))],
  pose_inv: [1, 1, ([a], at) => pose(sixOf(inverted(matrixOf(asPose(a!, at).six))))],
  pose_add: [
    2,
    2,
    ([a, b], at) => {
      const p = matrixOf(asPose(a!, at).six);
      const q = matrixOf(asPose(b!, at).six);
      const turned = times({ ...p, p: [0, 0, 0] }, { ...q, p: [0, 0, 0] });
      return pose(sixOf({ r: turned.r, p: [p.p[0] + q.p[0], p.p[1] + q.p[1], p.p[2] + q.p[2]] }));
    },
  ],
  pose_sub: [
    2,
    2,
    ([a, b], at) => {
      const p = matrixOf(asPose(a!, at).six);
      const q = matrixOf(asPose(b!, at).six);
      const turned = times(inverted({ ...q, p: [0, 0, 0] }), { ...p, p: [0, 0, 0] });
      return pose(sixOf({ r: turned.r, p: [p.p[0] - q.p[0], p.p[1] - q.p[1], p.p[2] - q.p[2]] }));
    },
  ],
  pose_dist: [2, 2, ([a, b], at) => distance(asPose(a!, at), asPose(b!, at)) + angle(asPose(a!, at), asPose(b!, at))],
  point_dist: [2, 2, ([a, b], at) => distance(asPose(a!, at), asPose(b!, at))],
  interpolate_pose: [3, 3, ([a, b, alpha], at) => between(asPose(a!, at), asPose(b!, at), asNumber(alpha!, at))],
  rpy2rotvec: [
    1,
    1,
    ([value], at) => {
      const [r, p, y] = asNumbers(value!, 3, at);
      return list(sixOf(fromRollPitchYaw(r!, p!, y!)).slice(3));
    },
  ],
  rotvec2rpy: [
    1,
    1,
    ([value], at) => {
      const [x, y, z] = asNumbers(value!, 3, at);
      return list(toRollPitchYaw(matrixOf([0, 0, 0, x!, y!, z!])));
    },
  ],
  make_list: [
    2,
    3,
    ([count, value], at) => {
      const length = asNumber(count!, at);
      if (!Number.isInteger(length) || length < 0 || length > MOST_ITEMS)
        throw new TextError(at, `a length from 0 to ${MOST_ITEMS}`, `A list of ${length} items cannot be made.`);
      return list(Array.from({ length }, () => value!));
    },
  ],
};
const MOST_ITEMS = 10_000;

const distance = (a: PoseValue, b: PoseValue): number =>
  Math.hypot(a.six[0] - b.six[0], a.six[1] - b.six[1], a.six[2] - b.six[2]);
const angle = (a: PoseValue, b: PoseValue): number =>
  Math.hypot(...sixOf(times(inverted(matrixOf(a.six)), matrixOf(b.six))).slice(3));

/** On the straight way from a to b, turning about one axis. */
function between(a: PoseValue, b: PoseValue, share: number): PoseValue {
  const [, , , x, y, z] = sixOf(times(inverted(matrixOf(a.six)), matrixOf(b.six)));
  const turned = times(matrixOf(a.six), matrixOf([0, 0, 0, x * share, y * share, z * share]));
  const along = (i: 0 | 1 | 2): number => a.six[i] + share * (b.six[i] - a.six[i]);
  return pose(sixOf({ r: turned.r, p: [along(0), along(1), along(2)] }));
}

/** A list or a pose with one number changed. */
export function withItem(value: Value, index: number, item: Value, at: TextPlace): Value {
  if (typeof value === "object" && value.kind === "pose")
    return poseOf(
      value.six.map((old, i) => (i === checked(index, 6, at) ? asNumber(item, at) : old)),
      at,
    );
  if (typeof value === "object") {
    const copy = [...value.items];
    copy[checked(index, copy.length, at)] = item;
    return list(copy);
  }
  throw new TextError(
    at,
    "a list or a pose",
    `${kindOf(value)} has no items.`.replace(/^./, letter => letter.toUpperCase()),
  );
}

export function itemOf(value: Value, index: number, at: TextPlace): Value {
  if (typeof value === "object")
    return value.kind === "pose"
      ? value.six[checked(index, 6, at)]!
      : value.items[checked(index, value.items.length, at)]!;
  throw new TextError(
    at,
    "a list or a pose",
    `${kindOf(value)} has no items.`.replace(/^./, letter => letter.toUpperCase()),
  );
}

function checked(index: number, length: number, at: TextPlace): number {
  if (Number.isInteger(index) && index >= 0 && index < length) return index;
  throw new TextError(at, `an index from 0 to ${length - 1}`, `There is no item ${index} in ${length}.`);
}
