export * from "./jogged.ts";
export * from "./jog.ts";
export * from "./clutch.ts";
export * from "./aids.ts";
export * from "./follow-target.ts";
export * from "./glove.ts";
export * from "./demonstration/index.ts";
export * from "./jog-targets.ts";
export { nearestTo, snapPoint, taughtAgain, type Snap, type SnapPoint } from "./edit-point.ts";
