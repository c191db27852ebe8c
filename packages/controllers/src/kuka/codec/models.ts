import type { Robot } from "@twincell/core";

const letters = (text: string): string => text.toUpperCase().replace(/[^A-Z0-9]/g, "");

/**
 * How controllers name an arm in $MODEL_NAME[]: by its vendor section, or by its name, "KUKA KR 6 R900 sixx" →
 * "#KR6R900SIXX", without the parts that differ from cell to cell.
 */
export const kukaModel = (robot: Robot): string =>
  robot.vendorSection?.model ?? `#${letters(robot.name.replace(/^KUKA\s*/i, ""))}`;
/**
 * Whether the name that a controller gives itself is that of the robot: the first word counts, letters and digits only.
 */
export const isKukaModel = (robot: Robot, said: string): boolean =>
  letters(said.trim().split(/\s+/)[0] ?? "") === letters(kukaModel(robot).split(/\s+/)[0]!);
