import { countsAsFile, sectionForDriver, type Robot } from "@twincell/core";

/** The number of an arm in the configuration part of the primary interface. */
const TYPES: Readonly<Record<string, number>> = { UR5: 1, UR10: 2, UR3: 3, UR16: 4, UR20: 7, UR30: 8, UR15: 9 };

/** What a controller answers to "get robot model" for that arm; one whose section does not say goes by its own name. */
export const modelOf = (robot: Robot): string => robot.vendorSection?.model ?? robot.name;
/** The controller says joints in radians as the robot's own file counts them: no sign, zero or coupling can be set. */
export function countsAsUr(robot: Robot): boolean {
  const section = sectionForDriver(robot, "ur");
  return section !== undefined && countsAsFile(section);
}
export const typeOf = (model: string): number => TYPES[model] ?? 0;
/** Robots of this brand have six joints, on every interface. */
export const JOINTS = 6;

/** Where a controller listens. The copies tell the same and take nothing. */
export interface UrPorts {
  readonly dashboard: number;
  readonly primary: number;
  readonly secondary: number;
  readonly realTime: number;
  readonly rtde: number;
  readonly primaryCopy: number;
  readonly secondaryCopy: number;
  readonly realTimeCopy: number;
}
export const UR_PORTS: UrPorts = {
  dashboard: 29_999,
  primary: 30_001,
  secondary: 30_002,
  realTime: 30_003,
  rtde: 30_004,
  primaryCopy: 30_011,
  secondaryCopy: 30_012,
  realTimeCopy: 30_013,
};

/** From a program's own words to blocks: a script that came over a stream is whole when as many blocks end as began. */
const OPENS = /^(?:def|sec|thread|while|if)\b/;
const CLOSES = /^end\b/;
export const blockChange = (line: string): number => {
  const text = line.trim();
  return OPENS.test(text) ? 1 : CLOSES.test(text) ? -1 : 0;
};

/**
 * The joint speed and acceleration that a script's `v` and `a` are shares of: those of the slowest joint, so that every
 * joint can have them.
 */
export const leadingJoint = (robot: Robot): { readonly speed_rad_s: number; readonly acceleration_rad_s2: number } => ({
  speed_rad_s: Math.min(...robot.arm.joints.map(({ limits }) => limits.speed_rad_s)),
  acceleration_rad_s2: Math.min(...robot.arm.joints.map(({ limits }) => limits.acceleration_rad_s2)),
});

/**
 * Lines of the control box by name: digital 0 … 7 standard, 8 … 15 configurable, 16 and 17 at the tool; analogue 0 and
 * 1.
 */
export interface UrLine {
  readonly kind: "digital-in" | "digital-out" | "analogue-in" | "analogue-out";
  readonly number: number;
}
const LINE = /^(digital|analog)_(in|out)_(\d{1,2})$/;
export function lineNumber(signal: string): UrLine | null {
  const [, sort, side, digits] = LINE.exec(signal) ?? [];
  const number = Number(digits);
  if (sort === undefined || number >= (sort === "digital" ? DIGITAL_LINES : ANALOGUE_LINES)) return null;
  return { kind: `${sort === "digital" ? "digital" : "analogue"}-${side === "in" ? "in" : "out"}`, number };
}
export const DIGITAL_LINES = 18;
export const ANALOGUE_LINES = 2;
