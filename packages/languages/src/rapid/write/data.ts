import { branchOf, type Pose, type Robot, type VendorSection, wristAboveZero } from "@twincell/core";
import { fixed, shownAxes } from "../../emitter/index.ts";

/** A tenth of a micrometre, and a hundred-thousandth of a degree. */
const DECIMALS = { mm: 4, deg: 5, part: 7 } as const;
export const mm = (value_m: number): string => fixed(value_m * 1000, DECIMALS.mm);
export const deg = (value_rad: number): string => fixed((value_rad / Math.PI) * 180, DECIMALS.deg);
export const part = (value: number): string => fixed(value, DECIMALS.part);

export const posText = (position_m: ArrayLike<number>): string => `[${Array.from(position_m, mm).join(",")}]`;

/**
 * q1 … q4 = w, x, y, z with the first that is not 0 positive. Cut digits shorten a quaternion and the controller makes
 * it whole again: the digits written are those that this leaves as they are.
 */
export function orientText([x, y, z, w]: Pose["quaternion"]): string {
  const first = [w, x, y, z].find(value => Math.abs(value) > 1e-7) ?? 1;
  const sign = first < 0 ? -1 : 1;
  let parts = [w, x, y, z].map(value => value * sign);
  let text = "";
  for (let i = 0; i < 8; i++) {
    const size = Math.hypot(...parts);
    const next = parts.map(value => part(value / size));
    if (next.join(",") === text) break;
    text = next.join(",");
    parts = next.map(Number);
  }
  return `[${text}]`;
}

export const poseText = ({ position, quaternion }: Pose): string => `[${posText(position)},${orientText(quaternion)}]`;

const degreesText = (value_deg: number): string => fixed(value_deg, DECIMALS.deg);

/** No axis outside the robot. */
export const NO_AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]";

/** Quarters of a turn of axes 1, 4 and 6 and, for a spherical wrist, which of the eight postures it is. */
export function confText(
  robot: Robot,
  section: VendorSection,
  q_rad: ArrayLike<number> | undefined,
  hasCfx: boolean,
): string {
  if (q_rad === undefined) return "[0,0,0,0]";
  const axes = shownAxes(section, q_rad);
  const quarter = (axis: number): number => Math.floor(Number(degreesText(axes[axis]!)) / 90);
  const branch = hasCfx ? branchOf(robot, q_rad) : undefined;
  const isBack = branch?.shoulder === "back";
  const isUnder = branch !== undefined && (branch.elbow === "up") === isBack;
  return `[${quarter(0)},${quarter(3)},${quarter(5)},${(isBack ? 4 : 0) + (isUnder ? 2 : 0) + (branch === undefined || branch.wrist === wristAboveZero(robot) ? 0 : 1)}]`;
}

export const targetText = (pose: Pose, conf: string): string =>
  `[${posText(pose.position)},${orientText(pose.quaternion)},${conf},${NO_AXES}]`;
/** Axis values [°] as the controller shows them. */
export const jointsText = (axes_deg: readonly number[]): string =>
  `[[${axes_deg.map(degreesText).join(",")}],${NO_AXES}]`;
/** A tool without a load of its own: what the flange carries is said by GripLoad. */
export const toolText = (tool: Pose): string => `[TRUE,${poseText(tool)},[0.001,[0,0,0.001],[1,0,0,0],0,0,0]]`;
export const objectText = (frame: Pose): string => `[FALSE,TRUE,"",${poseText(frame)},[[0,0,0],[1,0,0,0]]]`;
export const speedText = (v_mmps: string): string => `[${v_mmps},500,5000,1000]`;
/**
 * A zone as the predefined ones are made: half as much again for the orientation, a degree for every ten millimetres of
 * that.
 */
export function zoneText(zone_mm: string): string {
  const orient = fixed(1.5 * Number(zone_mm), 4);
  const turn = fixed(0.15 * Number(zone_mm), 4);
  return `[FALSE,${zone_mm},${orient},${orient},${turn},${orient},${turn}]`;
}
