import type { Speed, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Motion } from "../read/actions.ts";

/** max_speed: as fast as the controller moves a tool. */
export const FASTEST: Speed = { mps: 2 };

/** What a motion is planned at whose speed only the controller knows. */
export function planned(
  unit: Motion["unit"],
  path: Motion["path"],
): { readonly said: string; readonly assumed: Speed } {
  if (path === "J") return { said: "10 %", assumed: { ratio: 0.1 } };
  return unit === "weld_speed"
    ? { said: "10 mm/s", assumed: { mps: 0.01 } }
    : { said: "100 mm/s", assumed: { mps: 0.1 } };
}

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
    case "deg/sec":
    case "max_speed":
    case "weld_speed":
      throw new TextError(at, "a speed along the path", `A speed in ${unit} is not executed here.`);
  }
}
