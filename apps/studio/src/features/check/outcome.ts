import type { BindingCause, RepairOutcome } from "@twincell/core";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";

/** A change of the cycle below this is none [s]. */
const SAME_S = 0.005;

/** What the check says with a repair, in a few numbers: the joint at fault, the cycle, the room, what stays bad. */
export function outcomeWords({ joint, change_s, clearance_m, bad }: RepairOutcome, cause: BindingCause): string {
  const says: string[] = [];
  if (joint !== undefined) says.push(words.check.reaches(joint.joint, inUnits(joint.value, joint.unit)));
  if (change_s !== null && Math.abs(change_s) >= SAME_S)
    says.push(words.check.cycleChange(`${change_s > 0 ? "+" : "−"}${fixed(Math.abs(change_s), 2)}`));
  if (clearance_m !== null && cause === "collision") says.push(words.check.room(fixed(clearance_m * 1000, 0)));
  says.push(bad > 0 ? words.check.stillBad(bad) : words.check.allGood);
  return says.join(" · ");
}

const inUnits = (value: number, unit: "rad" | "m"): string =>
  unit === "m" ? `${fixed(value * 1000, 1)} mm` : `${fixed((value * 180) / Math.PI, 1)}°`;
