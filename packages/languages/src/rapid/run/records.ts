import type { PayloadStep, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import { times, turned, type Frame } from "./frame.ts";
import { NOTHING_KG } from "./predefined.ts";
import { asFrame, asNumber, asNumbers, asPosition, asRecord, type Value } from "./values.ts";

/** A load is given in the tool; the step counts from the flange. */
export function loadOf(
  load: Value,
  tool: Frame,
  at: TextPlace,
): Pick<PayloadStep, "mass_kg" | "center_m" | "inertia_kgm2"> {
  const [mass, cog, aom, ix, iy, iz] = asRecord(load, at, 6, "a load");
  const flange = times(tool, { mm: asPosition(cog, at), wxyz: [1, 0, 0, 0] }).mm;
  const inertia = [ix, iy, iz].map(each => asNumber(each!, at));
  const axes = times(tool, asFrame([[0, 0, 0], aom!], at)).wxyz;
  if (asNumber(mass!, at) <= NOTHING_KG) return { mass_kg: 0, center_m: [0, 0, 0] };
  const base = {
    mass_kg: asNumber(mass!, at),
    center_m: [flange[0] / 1000, flange[1] / 1000, flange[2] / 1000],
  } satisfies Partial<PayloadStep>;
  if (inertia.every(each => each === 0)) return base;
  // I = Σ I_k a_k a_kᵀ over the axes of moment.
  const columns = (
    [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ] as const
  ).map(axis => turned(axes, [...axis]));
  const entry = (i: number, j: number): number =>
    columns.reduce((sum, axis, k) => sum + inertia[k]! * axis[i]! * axis[j]!, 0);
  return { ...base, inertia_kgm2: [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)] };
}

/** How far before its end a move turns into the next one [m]; `own_mm` is what \\Z says instead. */
export function zoneOf(zone: Value, own_mm: number | undefined, at: TextPlace): number {
  const [isStop, radius] = asRecord(zone, at, 7, "a zone");
  const zone_mm = own_mm ?? asNumber(radius!, at);
  if (!(zone_mm >= 0)) throw new TextError(at, "a zone of 0 mm or more", `The zone is ${zone_mm} mm.`);
  return isStop === true ? 0 : zone_mm / 1000;
}

export function toolFrameOf(value: Value, at: TextPlace): Frame {
  const [holds, frame] = asRecord(value, at, 3, "a tool");
  if (holds !== true)
    throw new TextError(at, "a tool that the robot holds", "Tools that stand still are not executed here.");
  return asFrame(frame, at);
}

export function jointsOf(value: Value, at: TextPlace): readonly number[] {
  const [robax] = asRecord(value, at, 2, "a jointtarget [[…],[…]]");
  return asNumbers(robax, at, 6, "six joint angles");
}
