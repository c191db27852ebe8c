import { pose, type Pose } from "../../spatial/pose.ts";
import { fromEulerAngles } from "../../spatial/turns.ts";
import { radians } from "../../spatial/units.ts";
import type { Vector3 } from "../../spatial/vector.ts";
import type { Joint, JointDrive, JointLimits, LinkMass } from "../../model/arm.ts";
import type { OrthoParallelGeometry } from "../../model/robot.ts";
import type { FormLoft, PartMaterial, RobotForm } from "../../model/form.ts";

// What the data files of the library are written with, so that a file reads like its data sheet.

/** Seconds from standstill to full joint speed. Nobody publishes it. */
const RAMP_S = 0.25;

/** Largest speed of the tool tip where nobody says it [m/s]. */
export const TCP_SPEED_MPS = 2;

export const ACCELERATIONS_ASSUMED =
  "Joint accelerations are not published: full joint speed is assumed to be reached in 0.25 s.";
export const TCP_SPEED_ASSUMED = `The largest speed of the tool tip is not published: ${TCP_SPEED_MPS} m/s is assumed.`;
export const SHAPES_FITTED =
  "Link shapes are drawn from castings fitted to published meshes; how far they are off was measured and comes on top of every clearance margin.";
export const SHAPES_ESTIMATED =
  "Link shapes are drawn from the published dimensions, not from the vendor's CAD; how far they are off is an estimate.";
/** Source of numbers that everybody quotes and nobody here could look up in a document. */
export const FROM_MEMORY = "Commonly quoted from the vendor's data sheet; not checked against the document.";

type Six = readonly [number, number, number, number, number, number];

/** A placement as robot files write it: turned by roll, pitch, yaw about fixed axes, R = Rz(yaw) Ry(pitch) Rx(roll). */
export const turned = <Into extends string, From extends string>(
  position_m: Vector3,
  rollPitchYaw_rad: Vector3,
): Pose<Into, From> =>
  pose<Into, From>(position_m, fromEulerAngles("zyx", rollPitchYaw_rad[2], rollPitchYaw_rad[1], rollPitchYaw_rad[0]));

export const inRadians = (
  lower_rad: number,
  upper_rad: number,
  speed_rad_s: number,
  torque_Nm?: number,
): JointLimits => ({
  lower_rad,
  upper_rad,
  speed_rad_s,
  acceleration_rad_s2: speed_rad_s / RAMP_S,
  ...(torque_Nm === undefined ? {} : { torque_Nm }),
});

export const inDegrees = (lower_deg: number, upper_deg: number, speed_deg_s: number, torque_Nm?: number): JointLimits =>
  inRadians(radians(lower_deg), radians(upper_deg), radians(speed_deg_s), torque_Nm);

/** `placed` is where the joint sits on the link before it; a point when nothing is turned. */
export const joint = (
  name: string,
  placed: Vector3 | Pose<"parent", "joint">,
  axis: Vector3,
  limits: JointLimits,
): Joint => ({ name, axis, parentFromJoint: "position" in placed ? placed : pose(placed), limits });

/**
 * A joint whose speed and torque follow from its motor and gear: speed = motor speed / gear, torque = motor torque ·
 * gear.
 */
export const drivenJoint = (
  name: string,
  placed: Vector3,
  axis: Vector3,
  range_deg: readonly [number, number],
  drive: JointDrive,
): Joint => ({
  ...joint(
    name,
    placed,
    axis,
    inDegrees(range_deg[0], range_deg[1], (6 * drive.motorSpeed_rpm) / drive.gear, drive.motorTorque_Nm * drive.gear),
  ),
  drive,
});

/** a1, a2, b, c1, c2, c3, c4 [m]; zeros as multiples of 90°, which is what they are for these arms. */
export function orthoParallel(
  lengths_m: readonly [number, number, number, number, number, number, number],
  zeros_quarters: Six,
  signs: Six,
  formulaFromFlange: Pose<"formula", "flange"> = pose(),
): OrthoParallelGeometry {
  const [a1_m, a2_m, b_m, c1_m, c2_m, c3_m, c4_m] = lengths_m;
  const quarter = (n: number): number => (n * Math.PI) / 2;
  const [o1, o2, o3, o4, o5, o6] = zeros_quarters;
  return {
    kind: "ortho-parallel",
    a1_m,
    a2_m,
    b_m,
    c1_m,
    c2_m,
    c3_m,
    c4_m,
    offsets_rad: [quarter(o1), quarter(o2), quarter(o3), quarter(o4), quarter(o5), quarter(o6)],
    signs,
    formulaFromFlange,
  };
}

/** Castings link by link, and what each link is mostly made of. */
export const linkProfiles = (
  lofts: readonly (readonly FormLoft[])[],
  materials: readonly PartMaterial[],
): RobotForm => ({
  links: lofts.map((each, link) => ({ material: materials[link] ?? "casting", lofts: each })),
});

/** Mass, centre of mass, and Ixx, Iyy, Izz, Ixy, Ixz, Iyz about it, in directions turned by roll, pitch, yaw. */
export const solid = (
  mass_kg: number,
  centre_m: Vector3,
  inertia_kgm2: Six,
  rollPitchYaw_rad: Vector3 = [0, 0, 0],
): LinkMass => ({ mass_kg, linkFromCentre: turned(centre_m, rollPitchYaw_rad), inertia_kgm2 });
