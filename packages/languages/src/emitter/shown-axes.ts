import { axesOfJoints, type VendorSection } from "@twincell/core";

/** Axis values as the controller shows them [°]. */
export const shownAxes = (section: VendorSection, q_rad: ArrayLike<number>): number[] =>
  axesOfJoints(section, q_rad, new Array<number>(section.axes.length).fill(0));
