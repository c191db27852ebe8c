import { inverse, LIBRARY, pose, robotById, type Pose, type Robot } from "@twincell/core";
import type { Given } from "./arguments.ts";
import { UseFault } from "./usage.ts";

export const ROBOT_OPTIONS = { robot: { type: "string" }, base: { type: "string" }, tip: { type: "string" } } as const;

/** The robot that was asked for, and how the asked base and tip lie to its own. */
export interface ChosenRobot { readonly robot: Robot; readonly baseFromRoot: Pose; readonly flangeFromTip: Pose }

/** `--robot R [--base LINK] [--tip LINK]`: R is a library id or the path of a URDF. */
export async function robotOf(options: Given): Promise<ChosenRobot> {
  const wanted = options.text("robot");
  if (wanted === undefined) throw new UseFault("--robot is missing.", `Library: ${LIBRARY.map(robot => robot.id).join(", ")}; or the path of a URDF.`);
  const known = robotById(wanted);
  if (known) return libraryRobot(known, options.text("base"), options.text("tip"));
  throw new UseFault(`There is no robot "${wanted}" in the library.`, `Library: ${LIBRARY.map(robot => robot.id).join(", ")}.`);
}

function libraryRobot(robot: Robot, base: string | undefined, tip: string | undefined): ChosenRobot {
  const { frames } = robot;
  if (tip !== undefined && tip !== frames.tip && tip !== "flange") throw new UseFault(`${robot.name} has no frame "${tip}".`, `Tips: ${frames.tip}, flange.`);
  if (base !== undefined && base !== frames.base && base !== "base") throw new UseFault(`${robot.name} has no frame "${base}".`, `Bases: ${frames.base}, base (the vendor's world).`);
  return { robot, baseFromRoot: base === "base" ? inverse(robot.baseFromVendorWorld) as Pose : pose(), flangeFromTip: pose() };
}
