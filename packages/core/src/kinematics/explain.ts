import { jointText } from "../model/slide.ts";
import { degrees } from "../spatial/units.ts";
import type { Reach } from "./reach.ts";

const deg = (angle_rad: number): string => `${degrees(angle_rad).toFixed(1)}°`;
const mm = (length_m: number): string => `${(length_m * 1000).toFixed(length_m < 0.01 ? 1 : 0)} mm`;
const slide = (length_m: number): string => jointText({ kind: "prismatic" }, length_m);

/** One sentence that says whether and why: subject, fact, number with unit. */
export function explainReach(reach: Reach): string {
  switch (reach.kind) {
    case "reached":
      return reach.solutions.length === 1
        ? "The pose can be reached in 1 way."
        : `The pose can be reached in ${reach.solutions.length} ways.`;
    case "too-far":
      return `The wrist would be ${mm(reach.reach_m + reach.beyond_m)} from the shoulder; the arm is ${mm(reach.reach_m)} long.`;
    case "too-near":
      return `The wrist would be ${mm(reach.nearest_m - reach.inside_m)} from the shoulder; it cannot come nearer than ${mm(reach.nearest_m)}.`;
    case "beyond-workspace":
      return `The wrist would be ${mm(reach.distance_m)} from axis 2; the maker declares a reach of ${mm(reach.declared_m)}.`;
    case "not-so-turned":
      return `The wrist can be brought there, but its axes 4 and 5 would have to stand ${deg(reach.short_rad)} off the angle they are built at.`;
    case "outside-limits":
      return reach.slides === true
        ? `Joint ${reach.joint} would slide to ${slide(reach.wanted_rad)}; its limit is ${slide(reach.limit_rad)}.`
        : `Joint ${reach.joint} would turn to ${deg(reach.wanted_rad)}; its limit is ${deg(reach.limit_rad)}.`;
    case "no-solver":
    case "not-a-pose":
      return reach.because;
  }
}
