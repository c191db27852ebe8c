import { Refusal } from "../../refusal.ts";
import { shorten } from "../../xml.ts";
import type { Budget } from "../budget.ts";
import { fixed } from "./rounding.ts";
import { Dict, integerOf, numberOf, textOf, wholeOf, type Value } from "./values.ts";

const WIDEST = 1000;

/** `"%s_%02d" % (name, n)` with s, r, d, i, f, e, g and their widths. */
export function formatPercent(pattern: string, values: readonly Value[], budget: Budget): string {
  let used = 0;
  const text = pattern.replace(
    /%(?:%|([-+0 ]*)(\d*)(?:\.(\d+))?([A-Za-z]))/g,
    (whole, flags?: string, width?: string, places?: string, type?: string) => {
      if (whole === "%%") return "%";
      const value = values[used++];
      if (value === undefined) throw new Refusal(`“${shorten(pattern)}” asks for more values than it is given.`);
      return laidOut(value, flags ?? "", width ?? "", places, type ?? "s");
    },
  );
  if (used < values.length && !(values.length === 1 && values[0] instanceof Dict))
    throw new Refusal(`“${shorten(pattern)}” asks for ${used} values and is given ${values.length}.`);
  budget.spend(text.length);
  return text;
}

/** `"{}_{1}_{name:.3f}".format(…)`. */
export function formatBraces(
  pattern: string,
  values: readonly Value[],
  named: ReadonlyMap<string, Value>,
  budget: Budget,
): string {
  let next = 0;
  const text = pattern.replace(
    /\{\{|\}\}|\{(\w*)(?::([-+0 <>]*)(\d*)(?:\.(\d+))?([a-z]?))?\}/g,
    (whole, name?: string, flags?: string, width?: string, places?: string, type?: string) => {
      if (whole === "{{" || whole === "}}") return whole.charAt(0);
      const index = name === "" ? BigInt(next++) : wholeOf(name ?? "");
      const value = index === undefined ? named.get(name ?? "") : values[Number(index)];
      if (value === undefined) throw new Refusal(`“${shorten(pattern)}” asks for a value it is not given.`);
      return flags === undefined
        ? textOf(value)
        : laidOut(
            value,
            flags.replace("<", "-").replace(">", ""),
            width ?? "",
            places,
            type === undefined || type === "" ? (places === undefined ? "" : "g") : type,
          );
    },
  );
  budget.spend(text.length);
  return text;
}

function laidOut(value: Value, flags: string, width: string, places: string | undefined, type: string): string {
  if (Number(width) > WIDEST || Number(places ?? 0) > 60)
    throw new Refusal(`A number is to be written ${width || places} characters wide.`);
  let text: string;
  if (type === "s" || type === "r" || type === "") text = textOf(value);
  else {
    const number = numberOf(value);
    if (number === undefined) throw new Refusal(`“${shorten(textOf(value))}” is to be written as a number.`);
    if (type === "d" || type === "i") text = String(integerOf(value) ?? BigInt(Math.trunc(number)));
    else if (type === "f" || type === "F") text = fixed(number, Number(places ?? 6));
    else if (type === "e") text = number.toExponential(Number(places ?? 6)).replace(/e([+-])(\d)$/, "e$10$2");
    else if (type === "g") text = String(Number(number.toPrecision(Math.max(1, Number(places ?? 6)))));
    else throw new Refusal(`The way “${type}” of writing a value is not known.`);
    if (flags.includes("+") && number >= 0) text = `+${text}`;
  }
  const wide = Number(width);
  if (flags.includes("-")) return text.padEnd(wide);
  if (!flags.includes("0")) return text.padStart(wide);
  const sign = /^[-+]/.exec(text)?.[0] ?? "";
  return sign + text.slice(sign.length).padStart(wide - sign.length, "0");
}
