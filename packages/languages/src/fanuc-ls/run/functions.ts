import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";

const DEG = 180 / Math.PI;
const FUNCTIONS: Readonly<Record<string, (value: number) => number>> = {
  sin: value => Math.sin(value / DEG),
  cos: value => Math.cos(value / DEG),
  tan: value => Math.tan(value / DEG),
  asin: value => Math.asin(value) * DEG,
  acos: value => Math.acos(value) * DEG,
  atan: value => Math.atan(value) * DEG,
  sqrt: Math.sqrt,
  abs: Math.abs,
  round: Math.round,
  trunc: Math.trunc,
  ln: Math.log,
  exp: Math.exp,
};

/** SIN[x], SQRT[x] and their like; angles in degrees. @throws {TextError} where the function has no value. */
export function applied(name: string, value: number, at: TextPlace): number {
  const result = FUNCTIONS[name]!(value);
  if (!Number.isFinite(result))
    throw new TextError(at, "a value that the function has", `${name.toUpperCase()}[${value}] has no value.`);
  return result;
}
