import { encodeMesh } from "../mesh/codec.ts";
import type { LinkMass } from "../model/arm.ts";
import type { OwnLink } from "../model/form.ts";
import type { Robot } from "../model/robot.ts";
import { flangePose } from "../kinematics/forward.ts";
import { axesOfJoints, type VendorSection } from "../model/vendor.ts";
import { compose, inverse, type Pose } from "../spatial/pose.ts";
import { millimetres } from "../spatial/units.ts";
import { toEulerAngles } from "../spatial/turns.ts";
import { ROBOT_FORMAT } from "./parse-robot.ts";

/** A robot file as a value; `parseRobot` reads it. */
export type RobotFile = Readonly<Record<string, unknown>> & {
  readonly format: typeof ROBOT_FORMAT;
  readonly version: 1;
  readonly id: string;
};

/**
 * The robot as a robot file (docs/add-a-robot.md): metres, radians, joints base first, with its links and masses where
 * it has them. Read again it is the same arm to 1e-12, with the same facts.
 */
export function robotFileOf(robot: Robot): RobotFile {
  const { arm, vendorSection } = robot;
  return withoutNothing({
    format: ROBOT_FORMAT,
    version: 1,
    id: robot.id,
    name: robot.name,
    vendor: vendorSection === undefined ? robot.vendor || undefined : sectionFile(robot, vendorSection),
    joints: arm.joints.map(({ name, kind, parentFromJoint, axis, limits }) =>
      withoutNothing({
        name,
        kind,
        ...placeOf(parentFromJoint as Pose),
        axis: [...axis],
        lower_rad: limits.lower_rad,
        upper_rad: limits.upper_rad,
        speed_rad_s: limits.speed_rad_s,
        acceleration_rad_s2: limits.acceleration_rad_s2,
        torque_Nm: limits.torque_Nm,
      }),
    ),
    flange: placeOf(arm.lastJointFromFlange as Pose),
    vendor_world: isAtOrigin(robot.baseFromVendorWorld as Pose)
      ? undefined
      : placeOf(robot.baseFromVendorWorld as Pose),
    home_rad: [...robot.home_rad],
    payload_kg: robot.payload_kg,
    reach_m: robot.reach_m,
    repeatability_m: robot.repeatability_m,
    max_tcp_speed_mps: robot.maxTcpSpeed_mps,
    mass_kg: robot.mass_kg,
    shape_error_m: robot.shapeError_m,
    masses: robot.masses?.map(massFile),
    links: robot.links?.map(linkFile),
    sources: { ...robot.sources },
    assumptions: robot.assumptions.length > 0 ? [...robot.assumptions] : undefined,
  }) as RobotFile;
}

function placeOf({ position, quaternion }: Pose): { readonly xyz_m: number[]; readonly rpy_rad?: number[] } {
  const [yaw, pitch, roll] = toEulerAngles("zyx", quaternion);
  const rpy_rad = [roll, pitch, yaw];
  return { xyz_m: [...position], ...(rpy_rad.every(angle => angle === 0) ? {} : { rpy_rad }) };
}

const massFile = ({ mass_kg, linkFromCentre, inertia_kgm2 }: LinkMass): object =>
  withoutNothing({
    mass_kg,
    centre: linkFromCentre && placeOf(linkFromCentre as Pose),
    inertia_kgm2: inertia_kgm2 && [...inertia_kgm2],
  });

const linkFile = ({ parts, solids }: OwnLink): object =>
  withoutNothing({
    parts: parts.map(({ color, mesh }) => withoutNothing({ color, ...encodeMesh(mesh) })),
    solids: solids?.map(encodeMesh),
  });

/** The vendor section as robot files have it. One that is bound by no posture yet is bound by the arm's home. */
function sectionFile(robot: Robot, { pulses, postures, ...section }: VendorSection): object {
  return withoutNothing({
    name: robot.vendor,
    ...section,
    pulses: pulses && { per_rad: [...pulses.perRadian], source: pulses.source },
    postures: postures ?? [homePosture(robot, section)],
  });
}

function homePosture({ arm, home_rad, baseFromVendorWorld }: Robot, section: VendorSection): object {
  const flange = compose(inverse(baseFromVendorWorld), flangePose(arm, home_rad));
  return {
    axes_deg: axesOfJoints(section, home_rad, new Array<number>(home_rad.length).fill(0)),
    flange_mm: flange.position.map(millimetres),
  };
}

const isAtOrigin = ({ position, quaternion }: Pose): boolean =>
  position.every(value => value === 0) && quaternion.slice(0, 3).every(value => value === 0);

/** What is left out must be absent: a file says nothing rather than null. */
const withoutNothing = (fields: Readonly<Record<string, unknown>>): Record<string, unknown> =>
  Object.fromEntries(Object.entries(fields).filter(([, value]) => value !== undefined));
