/**
 * What must be known of a robot's controller before its program text can be written, executed or read and the robot be
 * driven: data of the robot, in its file. Nothing here is worked out from a name. Where a robot has no such section,
 * its languages and drivers are unknown and it is refused by all of them.
 */
export interface VendorSection {
  /** Ids of the languages that its controllers run, as `twincell dialects` lists them; the usual one first. */
  readonly languages: readonly string[];
  /** Ids of the drivers that move it, as `twincell virtual` names them; the usual one first. */
  readonly drivers: readonly string[];
  /**
   * How a controller names this arm in its own words, where its protocol tells it: "UR5", "#KR16R1610_2 C4SR FLR",
   * "GP12". Left out, drivers compare letters and digits of the robot's name.
   */
  readonly model?: string;
  /** How the controller counts each joint, base first. */
  readonly axes: readonly VendorAxis[];
  /** Axes that are shown together with another one. */
  readonly couplings?: readonly AxisCoupling[];
  readonly pulses?: AxisPulses;
  /**
   * What a pendant shows: axis values and where the flange is then. They bind the section to its arm: an arm whose
   * flange is elsewhere is refused with both sets of numbers.
   */
  readonly postures?: readonly ShownPosture[];
  /** quantity → where it comes from. */
  readonly sources: Readonly<Record<string, string>>;
}

/**
 * How a controller counts one joint:
 *
 *   shown_deg = sign · degrees(q) + zero_deg + Σ factor · shown_deg(with)
 *
 * with q [rad] as the robot's own file counts it.
 */
export interface VendorAxis {
  /** "A1", "S", "J1": what the maker calls it. */
  readonly name: string;
  readonly sign: 1 | -1;
  readonly zero_deg: number;
}

/**
 * Axis `axis` is shown with `factor` times what axis `with` shows added (both from 1). FANUC shows the forearm against
 * the horizon: { axis: 3, with: 2, factor: -1 }. An axis that others are coupled with is itself not coupled.
 */
export interface AxisCoupling {
  readonly axis: number;
  readonly with: number;
  readonly factor: number;
}

/**
 * Encoder pulses per radian of each axis as shown [1/rad]. They stand in the parameter file of one controller; nobody
 * can work them out from a name.
 */
export interface AxisPulses {
  readonly perRadian: readonly number[];
  /** The parameter file they come from, or "example": made up, for virtual controllers only. */
  readonly source: string;
}

/** Axis values as shown [°], and the flange in the world that the controller counts from [mm]. */
export interface ShownPosture {
  readonly axes_deg: readonly number[];
  readonly flange_mm: readonly [number, number, number];
}

/** How the axes of a controller are counted: what conversions need of a section. */
export type AxisCounting = Pick<VendorSection, "axes" | "couplings">;

const DEGREES = 180 / Math.PI;

/**
 * Joint angles [rad] as the controller shows them [°]. Allocates nothing when `out` is given.
 *
 * @param out  receives one value an axis; may be `q_rad` itself.
 */
export function axesOfJoints<Out extends { [index: number]: number }>(
  { axes, couplings }: AxisCounting,
  q_rad: ArrayLike<number>,
  out: Out,
): Out {
  for (let i = 0; i < axes.length; i++) out[i] = axes[i]!.sign * DEGREES * q_rad[i]! + axes[i]!.zero_deg;
  if (couplings !== undefined)
    for (let k = 0; k < couplings.length; k++) {
      const coupling = couplings[k]!;
      out[coupling.axis - 1]! += coupling.factor * out[coupling.with - 1]!;
    }
  return out;
}

/** Joint angles [rad] of what the controller shows [°]: the inverse of `axesOfJoints`. */
export function jointsOfAxes<Out extends { [index: number]: number }>(
  { axes, couplings }: AxisCounting,
  axes_deg: ArrayLike<number>,
  out: Out,
): Out {
  for (let i = 0; i < axes.length; i++) out[i] = axes_deg[i]!;
  if (couplings !== undefined)
    for (let k = 0; k < couplings.length; k++) {
      const coupling = couplings[k]!;
      out[coupling.axis - 1]! -= coupling.factor * out[coupling.with - 1]!;
    }
  for (let i = 0; i < axes.length; i++) out[i] = (axes[i]!.sign * (out[i]! - axes[i]!.zero_deg)) / DEGREES;
  return out;
}

/** Whether the controller counts its joints exactly as the robot's own file does. */
export const countsAsFile = ({ axes, couplings = [] }: AxisCounting): boolean =>
  couplings.length === 0 && axes.every(({ sign, zero_deg }) => sign === 1 && zero_deg === 0);

/** Names one axis each, counted as in the robot's own file. */
export const plainAxes = (names: readonly string[]): readonly VendorAxis[] =>
  names.map(name => ({ name, sign: 1, zero_deg: 0 }));

interface HasSection {
  readonly vendorSection?: VendorSection;
}
/** The section of a robot whose controllers run that language; undefined for others. */
export const sectionForLanguage = ({ vendorSection }: HasSection, language: string): VendorSection | undefined =>
  vendorSection?.languages.includes(language) === true ? vendorSection : undefined;

/** The section of a robot that one of those drivers moves; undefined for others. */
export const sectionForDriver = (
  { vendorSection }: HasSection,
  ...drivers: readonly string[]
): VendorSection | undefined =>
  drivers.some(driver => vendorSection?.drivers.includes(driver)) ? vendorSection : undefined;
