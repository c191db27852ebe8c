import { Reader, type Fields } from "../json/reader.ts";
import type { AxisCoupling, AxisPulses, ShownPosture, VendorAxis, VendorSection } from "../model/vendor.ts";
import type { Robot } from "../model/robot.ts";
import { falseSection } from "./identity.ts";
import { placed, textsOf } from "./parse-fields.ts";

/** What a file beside a URDF says of itself. */
export const VENDOR_FORMAT = "twincell.vendor";
const SECTION = [
  "name",
  "languages",
  "drivers",
  "model",
  "axes",
  "couplings",
  "pulses",
  "postures",
  "sources",
] as const;
const BESIDE = ["format", "version", "robot", "world", "home_rad", ...SECTION];
const AXIS = ["name", "sign", "zero_deg"];
const COUPLING = ["axis", "with", "factor"];
const POSTURE = ["axes_deg", "flange_mm"];
const MOST_FAULTS = 20;

/**
 * The vendor section in a robot file or beside a URDF, each fault with its place.
 *
 * @param joints  how many joints the arm has: so many axes are wanted.
 */
export function vendorSectionOf(reader: Reader, file: Fields, path: string, joints: number): VendorSection | undefined {
  const at = (key: string): string => (path === "" ? key : `${path}.${key}`);
  if (path !== "") reader.onlyKeys(file, path, "the vendor section", SECTION);
  const names = (key: "languages" | "drivers"): string[] =>
    (reader.list(file[key] ?? [], at(key), key) ?? []).flatMap(
      (each, i) => reader.name(each, `${at(key)}[${i}]`, `each of ${key}`) ?? [],
    );
  const list = reader.list(file.axes, at("axes"), "axes");
  if (list !== undefined && list.length !== joints)
    reader.fault(at("axes"), `the robot has ${joints} joints; the vendor section counts ${list.length} axes.`);
  const axes = (list ?? []).map((each, i) => axisOf(reader, each, `${at("axes")}[${i}]`, i + 1));
  const couplings = couplingsOf(reader, file.couplings, at("couplings"), joints);
  const postures = readPostures(reader, file.postures, at("postures"), joints);
  const pulses = file.pulses === undefined ? undefined : pulsesOf(reader, file.pulses, at("pulses"), joints);
  return {
    languages: names("languages"),
    drivers: names("drivers"),
    ...(file.model === undefined ? {} : { model: reader.name(file.model, at("model"), "the model") ?? "" }),
    axes: axes.filter(axis => axis !== undefined),
    ...(couplings.length === 0 ? {} : { couplings }),
    ...(pulses === undefined ? {} : { pulses }),
    postures,
    sources: textsOf(reader, file.sources ?? {}, at("sources")),
  };
}

function axisOf(reader: Reader, value: unknown, path: string, number: number): VendorAxis | undefined {
  const what = `axis ${number}`;
  const file = reader.object(value, path, what);
  if (file === undefined) return undefined;
  reader.onlyKeys(file, path, what, AXIS);
  const name = file.name === undefined ? `J${number}` : reader.name(file.name, `${path}.name`, `the name of ${what}`);
  const sign = file.sign ?? 1;
  if (sign !== 1 && sign !== -1)
    return reader.fault(`${path}.sign`, `the sign of ${what} is 1 or -1; here it is ${reader.shown(sign)}.`);
  const zero_deg = reader.number(file.zero_deg ?? 0, `${path}.zero_deg`, `the zero of ${what}`, "°");
  return name === undefined || zero_deg === undefined ? undefined : { name, sign, zero_deg };
}

function pulsesOf(reader: Reader, value: unknown, path: string, joints: number): AxisPulses | undefined {
  const file = reader.object(value, path, "pulses");
  if (file === undefined) return undefined;
  reader.onlyKeys(file, path, "pulses", ["per_rad", "source"]);
  const perRadian = reader.numbers(file.per_rad, `${path}.per_rad`, "pulses per radian", "1/rad", joints);
  if (perRadian?.includes(0) === true) reader.fault(`${path}.per_rad`, "no axis has 0 pulses per radian.");
  const source = reader.name(file.source, `${path}.source`, "the source of the pulses");
  return perRadian === undefined || source === undefined ? undefined : { perRadian, source };
}

function couplingsOf(reader: Reader, value: unknown, path: string, joints: number): AxisCoupling[] {
  if (value === undefined) return [];
  const all = (reader.list(value, path, "couplings") ?? []).flatMap((each, i): AxisCoupling[] => {
    const at = `${path}[${i}]`;
    const file = reader.object(each, at, "a coupling");
    if (file === undefined) return [];
    reader.onlyKeys(file, at, "a coupling", COUPLING);
    const axis = axisNumber(reader, file.axis, `${at}.axis`, joints);
    const other = axisNumber(reader, file.with, `${at}.with`, joints);
    const factor = reader.number(file.factor, `${at}.factor`, "the factor of a coupling", "");
    return axis === undefined || other === undefined || factor === undefined ? [] : [{ axis, with: other, factor }];
  });
  for (const [i, { axis, with: other }] of all.entries())
    if (axis === other || all.some(each => each.axis === other))
      reader.fault(`${path}[${i}]`, `axis ${other}, which axis ${axis} is coupled with, is itself coupled.`);
  return all;
}

const axisNumber = (reader: Reader, value: unknown, path: string, joints: number): number | undefined =>
  Number.isInteger(value) && (value as number) >= 1 && (value as number) <= joints
    ? (value as number)
    : reader.fault(path, `an axis is a number from 1 to ${joints}; here it is ${reader.shown(value)}.`);

/** At least one, so that the section is bound to its arm. */
function readPostures(reader: Reader, value: unknown, path: string, joints: number): ShownPosture[] {
  const list = reader.list(value ?? [], path, "postures") ?? [];
  if (list.length === 0)
    reader.fault(
      path,
      "a vendor section has at least one posture as the pendant shows it (axes_deg and flange_mm), with no axis at 0 where that can be.",
    );
  return list.flatMap((each, i): ShownPosture[] => {
    const at = `${path}[${i}]`;
    const file = reader.object(each, at, "a posture");
    if (file === undefined) return [];
    reader.onlyKeys(file, at, "a posture", POSTURE);
    const axes_deg = reader.numbers(file.axes_deg, `${at}.axes_deg`, "the axes of a posture", "°", joints);
    const flange_mm = reader.numbers(file.flange_mm, `${at}.flange_mm`, "the flange of a posture", "mm", 3);
    return axes_deg === undefined || flange_mm === undefined
      ? []
      : [{ axes_deg, flange_mm: flange_mm as [number, number, number] }];
  });
}

export type VendorAnswer =
  | { readonly kind: "robot"; readonly robot: Robot }
  | { readonly kind: "not-of-this-robot"; readonly faults: Reader["faults"] };

/**
 * A robot whose file says nothing of its controller, with the vendor section that stands beside it: format
 * `twincell.vendor`, version 1. Refused when the section is not that of the arm, with both sets of numbers.
 *
 * @param value  what stands in the file, as JSON.
 * @see docs/robot-files.md
 */
export function withVendorFile(robot: Robot, value: unknown): VendorAnswer {
  const reader = new Reader(MOST_FAULTS);
  const found = besideOf(reader, robot, value);
  const wrong = found === undefined || reader.faults.length > 0 ? undefined : falseSection(found);
  if (wrong !== undefined) reader.fault("postures", wrong);
  return found === undefined || reader.faults.length > 0
    ? { kind: "not-of-this-robot", faults: reader.faults }
    : { kind: "robot", robot: found };
}

function besideOf(reader: Reader, robot: Robot, value: unknown): Robot | undefined {
  const file = reader.object(value, "", "a vendor file");
  if (file === undefined) return undefined;
  if (file.format !== VENDOR_FORMAT)
    return reader.fault(
      "format",
      `the format of a vendor file is "${VENDOR_FORMAT}"; here it is ${reader.shown(file.format)}.`,
    );
  if (file.version !== 1)
    return reader.fault(
      "version",
      `vendor files of version 1 are read; this one is of version ${reader.shown(file.version)}.`,
    );
  reader.onlyKeys(file, "", "a vendor file", BESIDE);
  const { joints } = robot.arm;
  const vendor = reader.name(file.name, "name", "the name of the vendor");
  const vendorSection = vendorSectionOf(reader, file, "", joints.length);
  const name = file.robot === undefined ? robot.name : reader.name(file.robot, "robot", "the name of the robot");
  const world =
    file.world === undefined
      ? robot.baseFromVendorWorld
      : placed<"base", "vendor-world">(reader, file.world, "world", "the vendor's world");
  const home =
    file.home_rad === undefined
      ? robot.home_rad
      : reader.numbers(file.home_rad, "home_rad", "home", "rad", joints.length);
  if (vendor === undefined || vendorSection === undefined || name === undefined || world === undefined)
    return undefined;
  if (home === undefined) return undefined;
  return { ...robot, name, vendor, vendorSection, baseFromVendorWorld: world, home_rad: home };
}
