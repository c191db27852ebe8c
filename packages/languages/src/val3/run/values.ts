import type { TextPlace } from "@twincell/core";
import { TextError, compared, computed, finite as finiteOr } from "../../parser/index.ts";
import type { DataDeclaration } from "../read/application.ts";
import type { Config } from "./arm.ts";
import { NOTHING, fromSix, toSix, type Trsf } from "./trsf.ts";

export interface Joint {
  readonly kind: "joint";
  readonly deg: readonly number[];
}
export interface Point {
  readonly kind: "point";
  readonly trsf: Trsf;
  readonly father: string;
  readonly config: Config;
}
export interface Frame {
  readonly kind: "frame";
  readonly trsf: Trsf;
  readonly father: string;
}
export interface Tool {
  readonly kind: "tool";
  readonly trsf: Trsf;
}
/** How a motion is made: shares in percent, speeds in mm/s, lengths in mm. */
export interface Description {
  readonly kind: "mdesc";
  readonly accel: number;
  readonly vel: number;
  readonly tmax: number;
  readonly blend: string;
  readonly leave: number;
  readonly reach: number;
}
export interface Line {
  readonly kind: "dio" | "aio";
}
export type Value = number | boolean | string | readonly number[] | Joint | Point | Frame | Tool | Description | Line;
export type Kind = Exclude<Value, number | boolean | string | readonly number[]>["kind"];

export const isList = (value: Value): value is readonly number[] => Array.isArray(value);
export function kindOf(value: Value | undefined): Kind | "number" | "boolean" | "string" | "list" | "nothing" {
  if (value === undefined) return "nothing";
  if (isList(value)) return "list";
  return typeof value === "object"
    ? value.kind
    : typeof value === "number"
      ? "number"
      : typeof value === "boolean"
        ? "boolean"
        : "string";
}

export function asNumber(value: Value, at: TextPlace): number {
  if (typeof value === "number") return value;
  throw new TextError(at, "a number", `Something else (${kindOf(value)}) stands where a number is expected.`);
}

const SIX = ["x", "y", "z", "rx", "ry", "rz"];
const JOINTS = ["j1", "j2", "j3", "j4", "j5", "j6"];

/**
 * The values of a datum by their places; those that nothing is done with here come out as none. What is not written is
 * as the type begins.
 */
export function valuesOf(datum: DataDeclaration): ReadonlyMap<string, Value> {
  const { type, size, values } = datum;
  const all = new Map<string, Value>();
  const empty = type === "dio" || type === "aio" ? ({ kind: type } as const) : beginning(type);
  if (empty !== undefined) for (let i = 0; i < size; i++) all.set(String(i), empty);
  for (const [i, attributes] of values.entries()) {
    const place = (attributes.get("key") ?? attributes.get("index") ?? String(i)).replaceAll(" ", "");
    const [value] = written(datum, attributes);
    if (value !== undefined) all.set(place, value);
  }
  return all;
}

function written({ type, line, column }: DataDeclaration, given: ReadonlyMap<string, string>): readonly Value[] {
  return [given].flatMap((attributes): Value[] => {
    const number = (name: string, otherwise = 0): number => {
      const text = attributes.get(name);
      const value = text === undefined ? otherwise : Number(text);
      if (text?.trim() === "" || !Number.isFinite(value))
        throw new TextError({ line, column }, `a number for ${name}`, `The value "${text}" of ${name} is no number.`);
      return value;
    };
    const father = (attributes.get("fatherId") ?? "").replace(/\[0\]$/, "").replace(/^\w+:/, "");
    const trsf = (): Trsf => fromSix(SIX.map(name => number(name)));
    switch (type) {
      case "num":
        return [number("value")];
      case "bool":
        return [attributes.get("value") === "true"];
      case "string":
        return [attributes.get("value") ?? ""];
      case "dio":
      case "aio":
        return [{ kind: type }];
      case "jointRx":
        return [{ kind: "joint", deg: JOINTS.map(name => number(name)) }];
      case "pointRx":
        return [
          {
            kind: "point",
            trsf: trsf(),
            father: father === "" ? "world" : father,
            config: {
              shoulder: attributes.get("shoulder") ?? "ssame",
              elbow: attributes.get("elbow") ?? "esame",
              wrist: attributes.get("wrist") ?? "wsame",
            },
          },
        ];
      case "frame":
        return [{ kind: "frame", trsf: trsf(), father: father === "" ? "world" : father }];
      case "tool":
        return [{ kind: "tool", trsf: trsf() }];
      case "trsf":
        return [SIX.map(name => number(name))];
      case "mdesc":
        return [
          {
            kind: "mdesc",
            accel: number("accel", 100),
            vel: number("vel", 100),
            tmax: number("tmax", 99999),
            blend: (attributes.get("blend") ?? "off").toLowerCase(),
            leave: number("leave", 50),
            reach: number("reach", 50),
          },
        ];
      default:
        return [];
    }
  });
}

/** A component of a value: `trsf` and `config` of a point, numbers of a transformation, a joint or a descriptor. */
export function componentOf(value: Value, name: string): Value | undefined {
  if (isList(value)) return value[SIX.indexOf(name)];
  if (typeof value !== "object") return undefined;
  switch (value.kind) {
    case "point":
      if (name === "trsf") return toSix(value.trsf);
      return name === "shoulder" || name === "elbow" || name === "wrist" ? value.config[name] : undefined;
    case "frame":
    case "tool":
      return name === "trsf" ? toSix(value.trsf) : undefined;
    case "joint":
      return value.deg[JOINTS.indexOf(name)];
    case "mdesc":
      return partOf(value, name);
    default:
      return undefined;
  }
}

/** The same value with another component; undefined where it has none of that name, or not of that kind. */
export function withComponent(value: Value, name: string, to: Value): Value | undefined {
  if (isList(value)) {
    const place = SIX.indexOf(name);
    return place < 0 || typeof to !== "number" ? undefined : value.with(place, to);
  }
  if (typeof value !== "object") return undefined;
  if (name === "trsf" && isList(to) && (value.kind === "point" || value.kind === "frame" || value.kind === "tool"))
    return { ...value, trsf: fromSix(to) };
  if (value.kind === "joint" && typeof to === "number") {
    const place = JOINTS.indexOf(name);
    return place < 0 ? undefined : { ...value, deg: value.deg.with(place, to) };
  }
  return value.kind === "mdesc" ? withPart(value, name, to) : undefined;
}

/** A part of a motion descriptor. */
function partOf(descriptor: Description, name: string): Value | undefined {
  switch (name) {
    case "tvel":
      return descriptor.tmax;
    case "decel":
      return descriptor.accel;
    case "accel":
    case "vel":
    case "tmax":
    case "leave":
    case "reach":
    case "blend":
      return descriptor[name];
    default:
      return undefined;
  }
}

function withPart(descriptor: Description, name: string, to: Value): Value | undefined {
  if (typeof to !== "number")
    return name === "blend" && typeof to === "string" ? { ...descriptor, blend: to.toLowerCase() } : undefined;
  switch (name) {
    case "tvel":
    case "tmax":
      return { ...descriptor, tmax: to };
    case "decel":
    case "rvel":
    case "rmax":
      return descriptor;
    case "accel":
    case "vel":
    case "leave":
    case "reach":
      return { ...descriptor, [name]: to };
    default:
      return undefined;
  }
}

/** What a variable of a program begins with. */
export function beginning(type: string): Value | undefined {
  switch (type) {
    case "num":
      return 0;
    case "bool":
      return false;
    case "string":
      return "";
    case "trsf":
      return [0, 0, 0, 0, 0, 0];
    case "jointRx":
      return { kind: "joint", deg: [0, 0, 0, 0, 0, 0] };
    case "pointRx":
      return {
        kind: "point",
        trsf: NOTHING,
        father: "world",
        config: { shoulder: "ssame", elbow: "esame", wrist: "wsame" },
      };
    case "tool":
      return { kind: "tool", trsf: NOTHING };
    case "frame":
      return { kind: "frame", trsf: NOTHING, father: "world" };
    case "mdesc":
      return { kind: "mdesc", accel: 100, vel: 100, tmax: 99_999, blend: "off", leave: 50, reach: 50 };
    default:
      return undefined;
  }
}

export function binary(sign: string, left: Value, right: Value, at: TextPlace): Value {
  if (typeof left === "boolean" && typeof right === "boolean") return logic(sign, left, right, at);
  if (typeof left === "string" && typeof right === "string") {
    if (sign === "+") return left + right;
    if (sign === "==" || sign === "!=") return (left === right) === (sign === "==");
  }
  const a = asNumber(left, at);
  const b = asNumber(right, at);
  const value = compared(sign, a, b) ?? computed(sign, a, b, at);
  if (value === undefined) throw new TextError(at, "an operator", `"${sign}" does not join numbers.`);
  return typeof value === "boolean" || sign === "%" ? value : finite(value, at);
}

function logic(sign: string, left: boolean, right: boolean, at: TextPlace): boolean {
  switch (sign) {
    case "and":
      return left && right;
    case "or":
      return left || right;
    case "xor":
    case "!=":
      return left !== right;
    case "==":
      return left === right;
    default:
      throw new TextError(at, "and, or, xor, == or !=", `"${sign}" does not join truth values.`);
  }
}

export const finite = (value: number, at: TextPlace): number => finiteOr(value, at, "The result is no number.");
