import { pose } from "../spatial/pose.ts";
import { norm, scale, type Vector3 } from "../spatial/vector.ts";
import { Reader, type Fields } from "../json/reader.ts";
import type { Joint } from "../model/arm.ts";
import { robotFromArm, type KnownOfRobot } from "./foreign.ts";
import { falseSection } from "./identity.ts";
import { linksOf, massesIn } from "./parse-links.ts";
import { placed, textsOf } from "./parse-fields.ts";
import { vendorSectionOf } from "./parse-vendor.ts";
import type { Robot } from "../model/robot.ts";
import type { VendorSection } from "../model/vendor.ts";

/** A robot file that was read, or every fault in it with its place. */
/** What a robot file says of itself. */
export const ROBOT_FORMAT = "twincell.robot";

export type RobotAnswer =
  | { readonly kind: "robot"; readonly robot: Robot }
  | { readonly kind: "not-a-robot"; readonly faults: readonly { readonly path: string; readonly sentence: string }[] };

/** Longer chains are no robot anybody builds. */
const MOST_JOINTS = 32;
const MOST_FAULTS = 20;
/** Seconds from standstill to full speed of a joint whose acceleration the file does not give. */
const RAMP_S = 0.25;
const TOP = [
  "format",
  "version",
  "id",
  "name",
  "vendor",
  "joints",
  "flange",
  "vendor_world",
  "home_rad",
  "payload_kg",
  "reach_m",
  "repeatability_m",
  "max_tcp_speed_mps",
  "mass_kg",
  "shape_error_m",
  "masses",
  "links",
  "sources",
  "assumptions",
];
const JOINT = [
  "name",
  "kind",
  "xyz_m",
  "rpy_rad",
  "axis",
  "lower_rad",
  "upper_rad",
  "speed_rad_s",
  "acceleration_rad_s2",
  "torque_Nm",
];

/**
 * A robot from one data file (rows T-16, M-60), format `twincell.robot`, version 1: metres and radians, joints base
 * first, each placed on the one before by a point and roll, pitch, yaw. What the file leaves out is assumed, and said
 * in `assumptions`.
 *
 * @see docs/add-a-robot.md
 */
export function parseRobot(value: unknown): RobotAnswer {
  const reader = new Reader(MOST_FAULTS);
  const robot = robotOf(reader, value);
  if (robot !== undefined && reader.faults.length === 0) {
    const wrong = falseSection(robot);
    if (wrong === undefined) return { kind: "robot", robot };
    reader.fault("vendor.postures", wrong);
  }
  return { kind: "not-a-robot", faults: reader.faults };
}

function robotOf(reader: Reader, value: unknown): Robot | undefined {
  const file = reader.object(value, "", "a robot file");
  if (file === undefined) return undefined;
  if (file.format !== ROBOT_FORMAT)
    return reader.fault(
      "format",
      `the format of a robot file is "${ROBOT_FORMAT}"; here it is ${reader.shown(file.format)}.`,
    );
  if (file.version !== 1)
    return reader.fault(
      "version",
      `robot files of version 1 are read; this one is of version ${reader.shown(file.version)}.`,
    );
  reader.onlyKeys(file, "", "a robot file", TOP);
  const id = reader.name(file.id, "id", "the id");
  const name = file.name === undefined ? id : reader.name(file.name, "name", "the name");
  const list = reader.list(file.joints, "joints", "joints");
  if (list !== undefined && (list.length < 1 || list.length > MOST_JOINTS))
    reader.fault("joints", `a robot has 1 to ${MOST_JOINTS} joints; here it has ${list.length}.`);
  const joints = (list ?? []).slice(0, MOST_JOINTS).map((each, i) => jointOf(reader, each, i));
  const flange =
    file.flange === undefined
      ? pose<"joint", "flange">()
      : placed<"joint", "flange">(reader, file.flange, "flange", "the flange");
  const home =
    file.home_rad === undefined ? undefined : reader.numbers(file.home_rad, "home_rad", "home", "rad", joints.length);
  if (home !== undefined)
    joints.forEach((joint, j) => {
      if (joint !== undefined && !(home[j]! >= joint.limits.lower_rad && home[j]! <= joint.limits.upper_rad))
        reader.fault(`home_rad[${j}]`, `home of joint ${j + 1} is inside its limits; here it is ${home[j]}.`);
    });
  const maker = makerOf(reader, file.vendor, joints.length);
  const amount = (key: string, unit: string): number | undefined => amountOf(reader, file, key, unit);
  const known: KnownOfRobot = present<KnownOfRobot>({
    id,
    name,
    home_rad: home,
    vendor: maker.name,
    vendorSection: maker.section,
    baseFromVendorWorld:
      file.vendor_world === undefined
        ? undefined
        : placed<"base", "vendor-world">(reader, file.vendor_world, "vendor_world", "the vendor's world"),
    payload_kg: amount("payload_kg", "kg"),
    mass_kg: amount("mass_kg", "kg"),
    reach_m: amount("reach_m", "m"),
    repeatability_m: amount("repeatability_m", "m"),
    maxTcpSpeed_mps: amount("max_tcp_speed_mps", "m/s"),
    shapeError_m: amount("shape_error_m", "m"),
    masses: file.masses === undefined ? undefined : massesIn(reader, file.masses, joints.length),
    links: file.links === undefined ? undefined : linksOf(reader, file.links, joints.length),
    sources: file.sources === undefined ? undefined : textsOf(reader, file.sources, "sources"),
    assumptions: [...ramps(list), ...(file.assumptions === undefined ? [] : sentences(reader, file.assumptions))],
  });
  if (flange === undefined || reader.faults.length > 0) return undefined;
  return robotFromArm(
    { name: name ?? "", joints: joints.filter(joint => joint !== undefined), lastJointFromFlange: flange },
    known,
  );
}

/** `"vendor": "ABB"`, or the whole section with the maker as its `name`. */
function makerOf(
  reader: Reader,
  value: unknown,
  joints: number,
): { readonly name: string | undefined; readonly section: VendorSection | undefined } {
  if (value === undefined || typeof value === "string") return { name: value, section: undefined };
  const file = reader.object(value, "vendor", "the vendor");
  if (file === undefined) return { name: undefined, section: undefined };
  return {
    name: reader.name(file.name, "vendor.name", "the name of the vendor"),
    section: vendorSectionOf(reader, file, "vendor", joints),
  };
}

function jointOf(reader: Reader, value: unknown, index: number): Joint | undefined {
  const path = `joints[${index}]`;
  const what = `joint ${index + 1}`;
  const file = reader.object(value, path, what);
  if (file === undefined) return undefined;
  reader.onlyKeys(file, path, what, JOINT);
  const name =
    file.name === undefined ? `joint_${index + 1}` : reader.name(file.name, `${path}.name`, `the name of ${what}`);
  const at = placed<"parent", "joint">(reader, file, path, what);
  const axis = reader.numbers(file.axis, `${path}.axis`, `the axis of ${what}`, "", 3);
  if (axis !== undefined && !(norm(axis as Vector3) > 1e-6))
    reader.fault(`${path}.axis`, `the axis of ${what} has a direction; here it is 0, 0, 0.`);
  const limits = jointLimitsOf(reader, file, path, what);
  if (file.kind !== undefined && file.kind !== "revolute" && file.kind !== "prismatic")
    reader.fault(
      `${path}.kind`,
      `the kind of ${what} is "revolute" or "prismatic"; here it is ${reader.shown(file.kind)}.`,
    );
  if (name === undefined || at === undefined || axis === undefined || limits === undefined) return undefined;
  return {
    name,
    ...(file.kind === "prismatic" ? { kind: file.kind } : {}),
    parentFromJoint: at,
    axis: scale(axis as Vector3, 1 / (norm(axis as Vector3) || 1)),
    limits,
  };
}

/** Range, speed, acceleration and torque of one joint; without an acceleration, the one that ramps up in `RAMP_S`. */
function jointLimitsOf(reader: Reader, file: Fields, path: string, what: string): Joint["limits"] | undefined {
  const of = (key: string, unit: string): number | undefined =>
    reader.number(file[key], `${path}.${key}`, `the ${key} of ${what}`, unit);
  const lower_rad = of("lower_rad", "rad");
  const upper_rad = of("upper_rad", "rad");
  const speed_rad_s = of("speed_rad_s", "rad/s");
  const acceleration_rad_s2 =
    file.acceleration_rad_s2 === undefined ? (speed_rad_s ?? 0) / RAMP_S : of("acceleration_rad_s2", "rad/s²");
  const torque_Nm = file.torque_Nm === undefined ? undefined : of("torque_Nm", "N m");
  if (lower_rad !== undefined && upper_rad !== undefined && !(lower_rad < upper_rad))
    reader.fault(
      path,
      `the lower limit of ${what} is below its upper one; here they are ${lower_rad} and ${upper_rad}.`,
    );
  if (speed_rad_s !== undefined && !(speed_rad_s > 0))
    reader.fault(`${path}.speed_rad_s`, `the speed of ${what} is above 0; here it is ${speed_rad_s}.`);
  else if (acceleration_rad_s2 !== undefined && !(acceleration_rad_s2 > 0))
    reader.fault(
      `${path}.acceleration_rad_s2`,
      `the acceleration of ${what} is above 0; here it is ${acceleration_rad_s2}.`,
    );
  if (
    lower_rad === undefined ||
    upper_rad === undefined ||
    speed_rad_s === undefined ||
    acceleration_rad_s2 === undefined
  )
    return undefined;
  const limits = { lower_rad, upper_rad, speed_rad_s, acceleration_rad_s2 };
  return torque_Nm === undefined ? limits : { ...limits, torque_Nm };
}

/** A number that is not below 0, or nothing when the file leaves it out. */
function amountOf(reader: Reader, file: Fields, key: string, unit: string): number | undefined {
  if (file[key] === undefined) return undefined;
  const number = reader.number(file[key], key, `the ${key}`, unit);
  return number !== undefined && number < 0
    ? reader.fault(key, `the ${key} is not below 0; here it is ${number}.`)
    : number;
}

/** The fields that hold something: what is left out must be absent, not undefined. */
const present = <T extends object>(fields: { readonly [K in keyof T]: T[K] | undefined }): T =>
  Object.fromEntries(Object.entries(fields).filter(([, value]) => value !== undefined)) as T;

const sentences = (reader: Reader, value: unknown): string[] =>
  (reader.list(value, "assumptions", "assumptions") ?? []).flatMap(
    (text, i) => reader.text(text, `assumptions[${i}]`, `assumption ${i + 1}`) ?? [],
  );

const ramps = (joints: readonly unknown[] | undefined): string[] =>
  joints?.some(joint => joint !== null && typeof joint === "object" && !("acceleration_rad_s2" in joint)) === true
    ? [`Joint accelerations are not in the robot file: full joint speed is assumed to be reached in ${RAMP_S} s.`]
    : [];
