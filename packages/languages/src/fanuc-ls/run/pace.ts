import type { Speed, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Motion } from "../read/actions.ts";

/** What a number before its unit means. @throws {TextError} for a speed that is none. */
export function speedOf(value: number, { unit, path }: Pick<Motion, "unit" | "path">, at: TextPlace): Speed {
  if (!(value > 0)) throw new TextError(at, "a speed above 0", `The speed is ${value} ${unit}.`);
  switch (unit) {
    case "%":
      if (value > 100) throw new TextError(at, "1 % … 100 %", `The speed is ${value} %.`);
      return { ratio: value / 100 };
    case "mm/sec":
      return { mps: value / 1000 };
    case "cm/min":
      return { mps: value / 6000 };
    case "inch/min":
      return { mps: (value * 0.0254) / 60 };
    case "sec":
    case "msec":
      if (path === "C") throw new TextError(at, "a speed", "An arc with a duration is not executed here.");
      return { time_s: unit === "sec" ? value : value / 1000 };
  }
}
