import { readFile } from "node:fs/promises";
import { basename, extname } from "node:path";
import { compose, inverse, LIBRARY, pose, readRobot, robotById, robotFromArm, type Pose, type Robot } from "@twincell/core";
import { armFromUrdf, readUrdf, type UrdfChain, type UrdfRobot } from "@twincell/formats";
import type { Given } from "./arguments.ts";
import { UseFault } from "./usage.ts";

export const ROBOT_OPTIONS = { robot: { type: "string" }, base: { type: "string" }, tip: { type: "string" } } as const;

/** The robot that was asked for, and how the asked base and tip lie to its own. */
export interface ChosenRobot { readonly robot: Robot; readonly baseFromRoot: Pose; readonly flangeFromTip: Pose }

/** `--robot R [--base LINK] [--tip LINK]`: R is a library id, or the path of a URDF or of a robot file (JSON). */
export async function robotOf(options: Given): Promise<ChosenRobot> {
  const wanted = options.text("robot");
  if (wanted === undefined) throw new UseFault("--robot is missing.", `Library: ${LIBRARY.map(robot => robot.id).join(", ")}; or the path of a URDF or of a robot file (JSON).`);
  const known = robotById(wanted);
  if (known) return libraryRobot(known, options.text("base"), options.text("tip"));
  if (extname(wanted) === ".urdf") return urdfRobot(wanted, options.text("base"), options.text("tip"));
  if (extname(wanted) === ".json") return libraryRobot(await robotFile(wanted), options.text("base"), options.text("tip"));
  throw new UseFault(`There is no robot "${wanted}" in the library.`, `Library: ${LIBRARY.map(robot => robot.id).join(", ")}; or the path of a URDF or of a robot file (JSON).`);
}

function libraryRobot(robot: Robot, base: string | undefined, tip: string | undefined): ChosenRobot {
  const { frames } = robot;
  if (tip !== undefined && tip !== frames.tip && tip !== "flange") throw new UseFault(`${robot.name} has no frame "${tip}".`, `Tips: ${frames.tip}, flange.`);
  if (base !== undefined && base !== frames.base && base !== "base") throw new UseFault(`${robot.name} has no frame "${base}".`, `Bases: ${frames.base}, base (the vendor's world).`);
  return { robot, baseFromRoot: base === "base" ? inverse(robot.baseFromVendorWorld) as Pose : pose(), flangeFromTip: pose() };
}

/**
 * The arm is laid out from the file's root, where axis 1 stands as the closed form wants it; another base is a fixed step from
 * there. Another tip becomes the arm's own flange.
 */
async function urdfRobot(path: string, base: string | undefined, tip: string | undefined): Promise<ChosenRobot> {
  const answer = readUrdf(await textOf(path));
  if (answer.kind !== "read") throw new UseFault(`${path}${answer.line === undefined ? "" : `, line ${answer.line}`}: ${answer.sentence}`);
  const chain = chainOf(path, answer.robot, undefined, tip);
  const robot = robotFromArm(chain.arm, { id: basename(path, ".urdf"), frames: { base: chain.base, tip: chain.tip }, assumptions: chain.assumptions });
  if (base === undefined || base === chain.base) return { robot, baseFromRoot: pose(), flangeFromTip: pose() };
  const baseFromJoint = chainOf(path, answer.robot, base, tip).arm.joints[0]!.parentFromJoint, rootFromJoint = chain.arm.joints[0]!.parentFromJoint;
  return { robot, baseFromRoot: compose(baseFromJoint as Pose, inverse(rootFromJoint) as Pose), flangeFromTip: pose() };
}

function chainOf(path: string, file: UrdfRobot, base: string | undefined, tip: string | undefined): UrdfChain {
  const chain = armFromUrdf(file, base, tip);
  if (chain.kind === "chain") return chain;
  throw new UseFault(`${path}${chain.line === undefined ? "" : `, line ${chain.line}`}: ${chain.sentence}`);
}

/** Docs: add-a-robot.md. */
async function robotFile(path: string): Promise<Robot> {
  const text = await textOf(path);
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (cause) {
    throw new UseFault(`${path} is not JSON: ${cause instanceof Error ? cause.message : String(cause)}.`);
  }
  const answer = readRobot(value);
  if (answer.kind === "robot") return answer.robot;
  throw new UseFault(`${path}: ${answer.faults.map(fault => `${fault.path === "" ? "" : `${fault.path}: `}${fault.sentence}`).join(" ")}`);
}

async function textOf(path: string): Promise<string> {
  try {
    return await readFile(path, "utf8");
  } catch (cause) {
    throw new UseFault(`${path} cannot be read: ${cause instanceof Error ? cause.message : String(cause)}.`);
  }
}
