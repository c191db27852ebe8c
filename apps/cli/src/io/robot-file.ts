import { existsSync, readFileSync, statSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { ALL_DRIVER_KINDS } from "@twincell/controllers";
import {
  compose,
  inverse,
  libraryRobotOf,
  parseRobot,
  pose,
  robotFromArm,
  withVendorFile,
  type LinkSolid,
  type Pose,
  type Robot,
} from "@twincell/core";
import {
  armFromUrdf,
  endsOf,
  loadMeshes,
  readDhTable,
  readRobot,
  solidShapes,
  urdfSolids,
  type NotUnderstood,
  type UrdfChain,
  type UrdfRobot,
} from "@twincell/formats";
import { DIALECTS } from "@twincell/languages";
import { disk } from "./disk.ts";
import { readText } from "./files.ts";
import { UseFault } from "./usage.ts";

/** A robot that was opened from a file. */
export interface RobotFromFile {
  readonly robot: Robot;
  /** How the asked base lies to the root the arm is laid out from. */
  readonly baseFromRoot: Pose;
  /** Its shapes, meshes loaded, when the file has any. */
  solids(): { readonly solids: readonly LinkSolid[]; readonly notes: readonly string[] } | undefined;
}

const DESCRIPTION = /\.(urdf|xacro|xml)$/i;
const TABLE = /\.(json|csv|tsv|txt|dh)$/i;

/** Whether `--robot` is a path rather than an id of the library. */
export const isRobotPath = (wanted: string): boolean =>
  DESCRIPTION.test(wanted) || TABLE.test(wanted) || (/[/\\]/.test(wanted) && existsSync(wanted));

/** Opens a URDF, a xacro or a D-H table. */
export async function robotFromFile(
  path: string,
  base: string | undefined,
  tip: string | undefined,
  args: Readonly<Record<string, string>>,
): Promise<RobotFromFile> {
  if (TABLE.test(path)) return fromTable(path, base, tip);
  if (!existsSync(path)) throw new UseFault(`${path} cannot be read: there is no such file.`);
  if (statSync(path).isDirectory())
    throw new UseFault(`${path} is a folder, not a file.`, "Give the URDF or xacro in it.");
  return fromDescription(path, base, tip, args);
}

const idOf = (path: string): string =>
  basename(path).replace(/(\.urdf)?\.(urdf|xacro|xml)$|(\.dh)?\.(json|csv|tsv|txt|dh)$/i, "");

async function fromTable(path: string, base: string | undefined, tip: string | undefined): Promise<RobotFromFile> {
  const text = await readText(path);
  const data = robotData(path, text);
  if (data !== undefined) return fromData(path, data, base, tip);
  const answer = readDhTable(text, idOf(path));
  if (answer.kind !== "read") throw refused(path, answer);
  if (base !== undefined && base !== "base")
    throw new UseFault(`${path} has no frame "${base}".`, "A D-H table has the frames base and flange.");
  if (tip !== undefined && tip !== "flange")
    throw new UseFault(`${path} has no frame "${tip}".`, "A D-H table has the frames base and flange.");
  const robot = robotFromArm(answer.arm, {
    id: idOf(path),
    frames: { base: "base", tip: "flange" },
    assumptions: answer.assumptions,
  });
  return { robot: withSection(path, robot), baseFromRoot: pose(), solids: () => undefined };
}

/**
 * A file says nothing of what controls its arm, and its name is anybody's choice. An arm with the kinematics and limits
 * of a library robot is that robot: it gets its id, its home and its vendor's world; any other keeps the name of its
 * file.
 */
function identified(robot: Robot): Robot {
  const known = libraryRobotOf(robot);
  if (known === undefined) return robot;
  return {
    ...robot,
    id: known.id,
    name: known.name,
    vendor: known.vendor,
    ...(known.vendorSection === undefined ? {} : { vendorSection: known.vendorSection }),
    home_rad: known.home_rad,
    baseFromVendorWorld: known.baseFromVendorWorld,
    assumptions: [
      ...robot.assumptions,
      `The kinematics and limits of the file are those of the ${known.name}: its conventions are used.`,
    ],
  };
}

/**
 * The vendor section that stands beside a description, NAME.vendor.json; where there is none, that of the library robot
 * that the arm is.
 */
function withSection(path: string, robot: Robot): Robot {
  const beside = join(dirname(path), `${idOf(path)}.vendor.json`);
  if (!existsSync(beside)) return identified(robot);
  const answer = withVendorFile(robot, jsonOf(beside, readFileSync(beside, "utf8")));
  if (answer.kind === "not-of-this-robot") throw new UseFault(`${beside}: ${faultText(answer.faults)}`);
  return withKnownWays(beside, answer.robot);
}

/** Refuses languages and drivers that there are not: a misspelt one would be missing without a word. */
function withKnownWays(path: string, robot: Robot): Robot {
  const { languages = [], drivers = [] } = robot.vendorSection ?? {};
  const check = (what: string, ids: readonly string[], known: readonly string[]): void => {
    const strange = ids.find(id => !known.includes(id));
    if (strange !== undefined)
      throw new UseFault(`${path}: there is no ${what} "${strange}".`, `There are: ${known.join(", ")}.`);
  };
  check(
    "language",
    languages,
    DIALECTS.map(({ id }) => id),
  );
  check(
    "driver",
    drivers,
    ALL_DRIVER_KINDS.map(({ id }) => id),
  );
  return robot;
}

const faultText = (faults: readonly { readonly path: string; readonly sentence: string }[]): string =>
  faults.map(fault => `${fault.path === "" ? "" : `${fault.path}: `}${fault.sentence}`).join(" ");

function jsonOf(path: string, text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (cause) {
    throw new UseFault(`${path} is not JSON: ${cause instanceof Error ? cause.message : String(cause)}.`);
  }
}

/** The content of a robot file, docs/add-a-robot.md; undefined for a table, which states its convention. */
function robotData(path: string, text: string): unknown {
  if (!/\.json$/i.test(path) || /\.dh\.json$/i.test(path)) return undefined;
  const value = jsonOf(path, text);
  return typeof value === "object" && value !== null && "convention" in value ? undefined : value;
}

function fromData(path: string, data: unknown, base: string | undefined, tip: string | undefined): RobotFromFile {
  const answer = parseRobot(data);
  if (answer.kind === "not-a-robot") throw new UseFault(`${path}: ${faultText(answer.faults)}`);
  const robot = withKnownWays(path, answer.robot);
  const { frames } = robot;
  if (base !== undefined && base !== frames.base)
    throw new UseFault(`${robot.name} has no frame "${base}".`, `Its base is ${frames.base}.`);
  if (tip !== undefined && tip !== frames.tip && tip !== "flange")
    throw new UseFault(`${robot.name} has no frame "${tip}".`, `Tips: ${frames.tip}, flange.`);
  return { robot, baseFromRoot: pose(), solids: () => undefined };
}

/**
 * The arm is laid out from the file's root, where axis 1 stands as the closed form wants it; another base is a fixed
 * step from there. Another tip becomes the arm's own flange.
 */
function fromDescription(
  path: string,
  base: string | undefined,
  tip: string | undefined,
  args: Readonly<Record<string, string>>,
): RobotFromFile {
  const whole = resolve(path);
  const answer = readRobot(whole, disk, { args });
  if (answer.kind !== "read") throw refused(path, answer);
  const chain = chainOf(path, answer.robot, undefined, tip);
  const described = robotFromArm(chain.arm, {
    id: idOf(path),
    frames: { base: chain.base, tip: chain.tip },
    assumptions: [...answer.warnings, ...chain.assumptions],
    ...(chain.masses ? { masses: chain.masses } : {}),
  });
  const robot = withSection(path, described);
  const solids = (): ReturnType<RobotFromFile["solids"]> => {
    if (chain.shapes.length === 0) return undefined;
    const meshes = loadMeshes(solidShapes(chain), whole, disk);
    const found = urdfSolids(chain, meshes.meshOf);
    return { solids: found.solids, notes: meshes.notes };
  };
  if (base === undefined || base === chain.base) return { robot, baseFromRoot: pose(), solids };
  const baseFromJoint = chainOf(path, answer.robot, base, tip).arm.joints[0]!.parentFromJoint;
  const rootFromJoint = chain.arm.joints[0]!.parentFromJoint;
  return { robot, baseFromRoot: compose(baseFromJoint as Pose, inverse(rootFromJoint) as Pose), solids };
}

function chainOf(path: string, file: UrdfRobot, base: string | undefined, tip: string | undefined): UrdfChain {
  const chain = armFromUrdf(file, base, tip);
  if (chain.kind === "chain") return chain;
  const ends = endsOf(file);
  throw refused(
    path,
    chain,
    ends.length > 0
      ? `The file ends in ${ends.slice(0, 12).join(", ")}${ends.length > 12 ? ", …" : ""}: choose with --tip.`
      : "",
  );
}

function refused(path: string, { sentence, line, file }: NotUnderstood, hint = ""): UseFault {
  const place = file === undefined || file === resolve(path) ? path : file;
  return new UseFault(`${place}${line === undefined ? "" : `, line ${line}`}: ${sentence}`, hint);
}
