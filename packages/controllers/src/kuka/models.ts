import type { Robot } from "@twincell/core";

/** How controllers name the arms of the library in $MODEL_NAME[], without the parts that differ from cell to cell. */
const MODELS: Readonly<Record<string, string>> = {
  kuka_kr6r900sixx: "#KR6R900SIXX C2 FLR ZH100",
  kuka_kr6_2: "#KR6_2 H C4 FLR ZH02",
};
const letters = (text: string): string => text.toUpperCase().replace(/[^A-Z0-9]/g, "");
/** "KUKA KR 6 R900 sixx" → "KR6R900SIXX" */
const modelOf = (robot: Robot): string => letters(robot.name.replace(/^KUKA\s*/i, ""));

export const kukaModel = (robot: Robot): string => MODELS[robot.id] ?? `#${modelOf(robot)}`;
/**
 * Whether the name that a controller gives itself is that of the robot: the first word counts, letters and digits only.
 */
export const isKukaModel = (robot: Robot, said: string): boolean =>
  letters(said.trim().split(/\s+/)[0] ?? "") === letters(kukaModel(robot).split(/\s+/)[0]!);
