import { pose } from "../spatial/pose.ts";
import { norm } from "../spatial/vector.ts";
import type { SerialArm } from "../model/arm.ts";
import { familyOf } from "./family.ts";
import { slideOf } from "../model/slide.ts";
import type { KinematicFamily, Robot } from "../model/robot.ts";

/** Speed of the tool tip at full speed where nobody says it [m/s]. */
const ASSUMED_TCP_SPEED_MPS = 2;

/** What is known of a robot beside its arm. What is left out is assumed, and said so in `Robot.assumptions`. */
export type KnownOfRobot = Partial<Omit<Robot, "arm" | "family" | "assumptions">> & {
  readonly assumptions?: readonly string[];
};

/**
 * A robot around an arm that came from a file: closed form where its axes allow, home at zero or as near as the limits
 * allow.
 */
export function robotFromArm(arm: SerialArm, known: KnownOfRobot = {}): Robot {
  const family = familyOf(arm);
  const assumptions = [...(known.assumptions ?? [])];
  const assume = <T>(value: T | undefined, assumed: T, sentence: string): T => {
    if (value === undefined) assumptions.push(sentence);
    return value ?? assumed;
  };
  if (known.payload_kg === undefined)
    assumptions.push("The payload is not stated: whether the robot carries a load is unknown.");
  const reach_m = reachOf(arm, family);
  const length = `${(reach_m * 1000).toFixed(0)} mm`;
  return {
    id: known.id ?? arm.name,
    name: known.name ?? arm.name,
    vendor: known.vendor ?? "",
    arm,
    family,
    frames: known.frames ?? { base: "base", tip: "flange" },
    baseFromVendorWorld: known.baseFromVendorWorld ?? pose(),
    home_rad:
      known.home_rad ?? arm.joints.map(({ limits }) => Math.min(limits.upper_rad, Math.max(limits.lower_rad, 0))),
    reach_m: assume(
      known.reach_m,
      reach_m,
      family.kind === "general"
        ? `The reach is not stated: ${length} is the sum of the links, which it does not exceed.`
        : `The reach is not stated: ${length} is computed from the lengths of the links.`,
    ),
    reachMeasuredFrom: known.reachMeasuredFrom ?? (family.kind === "ortho-parallel" ? "axis-1" : "axis-2"),
    reachMeasuredTo: known.reachMeasuredTo ?? (family.kind === "general" ? "flange" : "wrist"),
    maxTcpSpeed_mps: assume(
      known.maxTcpSpeed_mps,
      ASSUMED_TCP_SPEED_MPS,
      `The largest speed of the tool tip is not known: ${ASSUMED_TCP_SPEED_MPS} m/s is assumed.`,
    ),
    sources: known.sources ?? { arm: "The axes, limits and speeds of the robot file that was opened." },
    shapeError_m: known.shapeError_m ?? 0,
    ...optional(known),
    // A file that was written from a robot has its assumptions in it already.
    assumptions: [...new Set(assumptions)],
  };
}

/** What may be missing from a robot, where it is known. */
function optional(known: KnownOfRobot): Partial<Robot> {
  const { payload_kg, repeatability_m, mass_kg, masses, workspace, madeUpGeometry, unverified } = known;
  const { form, paint, links } = known;
  const { vendorSection } = known;
  const payloadMax_kg = known.payloadMax_kg ?? payload_kg;
  return {
    ...(vendorSection === undefined ? {} : { vendorSection }),
    ...(payload_kg === undefined ? {} : { payload_kg }),
    ...(payloadMax_kg === undefined ? {} : { payloadMax_kg }),
    ...(repeatability_m === undefined ? {} : { repeatability_m }),
    ...(unverified === undefined ? {} : { unverified }),
    ...(mass_kg === undefined ? {} : { mass_kg }),
    ...(masses === undefined ? {} : { masses }),
    ...(workspace === undefined ? {} : { workspace }),
    ...(madeUpGeometry === undefined ? {} : { madeUpGeometry }),
    ...(form === undefined ? {} : { form }),
    ...(paint === undefined ? {} : { paint }),
    ...(links === undefined ? {} : { links }),
  };
}

/**
 * From axis 1 to the wrist of the stretched arm, as makers count; for an arm of no family the sum of its links and
 * slides, which no reach exceeds.
 */
function reachOf(arm: SerialArm, family: KinematicFamily): number {
  switch (family.kind) {
    case "ortho-parallel":
      return Math.abs(family.a1_m) + family.c2_m + Math.hypot(family.a2_m, family.c3_m);
    case "three-parallel":
      return Math.abs(family.a1_m) + family.c2_m + family.c3_m + family.c5_m;
    case "spherical-seven":
      return family.c3_m + family.c5_m;
    case "general-6r":
      return Math.abs(family.a1_m) + family.c2_m + Math.hypot(...family.centre_m);
    case "general":
      return arm.joints
        .slice(1)
        .reduce(
          (sum, joint) => sum + norm(joint.parentFromJoint.position),
          norm(arm.lastJointFromFlange.position) + slideOf(arm.joints),
        );
  }
}
