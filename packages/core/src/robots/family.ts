import type { SerialArm } from "../model/arm.ts";
import { generalSixFromArm } from "./derive-general-six.ts";
import { sphericalSevenFromArm } from "./derive-spherical-seven.ts";
import { isSlide } from "../model/slide.ts";
import { threeParallelFromArm } from "./derive-three-parallel.ts";
import { orthoParallelFromArm } from "./derive.ts";
import type { KinematicFamily } from "../model/robot.ts";

/**
 * How the inverse of any arm is solved, read off its axes: the first of ortho-parallel, three-parallel, spherical-seven
 * and general-6r that meets its forward kinematics; else general, which only numeric methods solve; that of an arm with
 * a slide is always general.
 */
export const familyOf = (arm: SerialArm): KinematicFamily =>
  (arm.joints.some(isSlide)
    ? undefined
    : (orthoParallelFromArm(arm) ??
      threeParallelFromArm(arm) ??
      sphericalSevenFromArm(arm) ??
      generalSixFromArm(arm))) ?? { kind: "general" };
