import { existsSync } from "node:fs";
import {
  catalogueRobots,
  compose,
  inverse,
  LIBRARY,
  linkSolids,
  pose,
  robotById,
  robotFromArm,
  ROBOT_FORMAT,
  transformMesh,
  type LinkSolid,
  type Pose,
  type Robot,
  type SerialArm,
} from "@twincell/core";
import { openDocument } from "@twincell/project";
import type { Given } from "./arguments.ts";
import { readText } from "./files.ts";
import { isRobotPath, robotFromFile } from "./robot-file.ts";
import { UseFault } from "./usage.ts";

export const ROBOT_OPTIONS = {
  robot: { type: "string" },
  base: { type: "string" },
  tip: { type: "string" },
  arg: { type: "string", multiple: true },
} as const;

/** How `--robot` is explained in the help of a command. */
export const ROBOT_HELP = `R is an id of "twincell robots", a URDF, a xacro (its arguments: --arg name:=value, again for more), a D-H table
(.dh.json, .dh.csv, .dh.txt) or a robot file (.json); what its controllers need stands in its vendor section, or beside a
URDF as NAME.vendor.json (docs/robot-files.md). LINK: the base is the root link when absent, the tip tool0, else flange, else the end of the longest chain.`;

/** The robot that was asked for, and how the asked base and tip lie to its own. */
export interface ChosenRobot {
  readonly robot: Robot;
  readonly baseFromRoot: Pose;
  readonly flangeFromTip: Pose;
  /** Its solids for collisions; what could not be loaded is said in `notes`. */
  solids(): { readonly solids: readonly LinkSolid[]; readonly notes: readonly string[] };
}

/**
 * `--robot R [--base LINK] [--tip LINK] [--arg name:=value]…`: R is a library id or the path of a URDF, xacro, D-H
 * table or robot file.
 */
export async function robotOf(options: Given, wanted = options.text("robot")): Promise<ChosenRobot> {
  const base = options.text("base");
  const tip = options.text("tip");
  const args = xacroArguments(options.list("arg"));
  const more = catalogueRobots().length;
  const choices = `Library: ${LIBRARY.map(robot => robot.id).join(", ")}, and ${more} of the catalogue ("twincell robots" lists all); or the path of a URDF, xacro, D-H table or robot file.`;
  if (wanted === undefined) throw new UseFault("--robot is missing.", choices);
  const known = robotById(wanted);
  if (known) return libraryRobot(known, base, tip);
  if (!isRobotPath(wanted)) throw new UseFault(`There is no robot "${wanted}" in the library.`, choices);
  const opened = await robotFromFile(wanted, base, tip, args);
  return {
    robot: opened.robot,
    baseFromRoot: opened.baseFromRoot,
    flangeFromTip: pose(),
    solids: () => opened.solids() ?? { solids: linkSolids(opened.robot), notes: [] },
  };
}

/** A robot that a program is judged or played on, with its solids. */
export interface RobotToRun {
  readonly robot: Robot;
  solids(): readonly LinkSolid[];
}

/**
 * The robot of `--robot`, or undefined where none is given. A program counts its poses from the robot's base: with
 * `--base` the arm stands in that frame. What could not be loaded of its meshes is said on standard error.
 */
export async function programRobot(options: Given): Promise<RobotToRun | undefined> {
  if (options.text("robot") === undefined) {
    for (const name of ["base", "tip"])
      if (options.text(name) !== undefined) throw new UseFault(`--${name} is given without --robot.`);
    await knowRobotOfCell(options.text("cell"));
    return undefined;
  }
  const { robot, baseFromRoot, solids } = await robotOf(options);
  const asked = options.text("base");
  const said = (): readonly LinkSolid[] => {
    const found = solids();
    for (const note of found.notes) process.stderr.write(`twincell: ${note}\n`);
    return found.solids.map(solid =>
      solid.link === 0 && asked !== undefined ? { ...solid, mesh: transformMesh(solid.mesh, baseFromRoot) } : solid,
    );
  };
  if (asked === undefined || asked === robot.frames.base) return { robot, solids: said };
  return {
    robot: robotFromArm(movedBase(robot.arm, baseFromRoot), {
      ...robot,
      frames: { ...robot.frames, base: asked },
      baseFromVendorWorld: compose(baseFromRoot as Pose<"base", "base">, robot.baseFromVendorWorld),
    }),
    solids: said,
  };
}

/**
 * A cell may bring the robot that the program is for: it is known before the program is read.
 */
async function knowRobotOfCell(path: string | undefined): Promise<void> {
  if (path === undefined || !existsSync(path)) return;
  const text = await readText(path);
  if (!text.includes(ROBOT_FORMAT)) return;
  const answer = openDocument(text);
  if (answer.kind === "not-a-cell") throw new UseFault(`${path}: ${answer.why[0] ?? "This is not a saved cell."}`);
}

function movedBase(arm: SerialArm, baseFromRoot: Pose): SerialArm {
  const [first, ...rest] = arm.joints;
  return first
    ? {
        ...arm,
        joints: [
          {
            ...first,
            parentFromJoint: compose(baseFromRoot, first.parentFromJoint as Pose) as Pose<"parent", "joint">,
          },
          ...rest,
        ],
      }
    : arm;
}

function libraryRobot(robot: Robot, base: string | undefined, tip: string | undefined): ChosenRobot {
  const { frames } = robot;
  if (tip !== undefined && tip !== frames.tip && tip !== "flange")
    throw new UseFault(`${robot.name} has no frame "${tip}".`, `Tips: ${frames.tip}, flange.`);
  if (base !== undefined && base !== frames.base && base !== "base")
    throw new UseFault(`${robot.name} has no frame "${base}".`, `Bases: ${frames.base}, base (the vendor's world).`);
  return {
    robot,
    baseFromRoot: base === "base" ? (inverse(robot.baseFromVendorWorld) as Pose) : pose(),
    flangeFromTip: pose(),
    solids: () => ({ solids: linkSolids(robot), notes: [] }),
  };
}

function xacroArguments(given: readonly string[]): Readonly<Record<string, string>> {
  return Object.fromEntries(
    given.map(text => {
      const match = /^([^:=\s]+):=([\s\S]*)$/.exec(text);
      if (!match) throw new UseFault(`--arg wants name:=value, not "${text}".`);
      return [match[1]!, match[2]!];
    }),
  );
}
