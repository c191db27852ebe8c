import type { EmittedFile, MoveStep, VendorSection } from "@twincell/core";
import { ppointText } from "./location.ts";
import type { ConfigurationMap } from "./postures.ts";
import { BlockWriter } from "../../emitter/index.ts";

/** Components of a precision point of six joints in the array of the point list. */
const STRIDE = 6;
/** V+ arrays end here. */
export const MAX_POINTS = Math.floor(32768 / STRIDE);

/** One taught point as the point list has it (row N-55). `at` counts points from 0. */
export const pointLine = (at: number, q_rad: ArrayLike<number>, convention: VendorSection): string =>
  `DO DECOMPOSE J_V[${at * STRIDE}]=${ppointText(q_rad, convention)}`;

/**
 * The point list: one line per taught point, to be sent through a terminal. It fills an array and moves nothing (E-08).
 */
export function pointList(moves: readonly MoveStep[], q_rad: ConfigurationMap, convention: VendorSection): EmittedFile {
  const writer = new BlockWriter();
  for (const [i, { id }] of moves.entries()) writer.add(pointLine(i, q_rad.get(id)!, convention), id);
  return writer.file("ppPoints.txt");
}
