import { flangePose, identity, linkPoses, type Pose, type Robot } from "@twincell/core";
import { writeUrdf } from "@twincell/formats";
import type { RobotState, RobotStates } from "./robot-states.ts";

/**
 * Names of a robot's topics, links and joints. The robot that was opened first has the plain names of a cell with one
 * robot; every robot has those behind its id as well.
 */
export const topicOf = (robot: RobotState, name: string): string => `/${robot.id.replace(/[^\w]/g, "_")}/${name}`;

/** Before the names of its links: "" for the robot that was opened first. */
export function framePrefix({ all }: RobotStates, robot: RobotState): string {
  const [first] = all.values();
  return first === robot ? "" : `${robot.id}/`;
}

/** Names of the links as the URDF of `robotDescription` has them, base first, flange last. */
export function linkNames({ arm, frames }: Robot): readonly string[] {
  const used = new Set([frames.base, frames.tip]);
  const names = arm.joints.map((_, i) => {
    let name = `link_${i + 1}`;
    while (used.has(name)) name += "_";
    return name;
  });
  return [frames.base, ...names, frames.tip];
}
export const robotDescription = ({ arm, frames, name, masses }: Robot): string =>
  writeUrdf(arm, { name, base: frames.base, tip: frames.tip, masses });

export interface NamedTransform {
  readonly parent: string;
  readonly child: string;
  readonly pose: Pose;
}
/** Where each link is in the base, for all who draw the arm. @param prefix  before the names of links, or "". */
export function transforms(robot: RobotState, prefix: string): readonly NamedTransform[] {
  const { model, q_rad } = robot;
  if (model === null) return [];
  const names = linkNames(model);
  const base = `${prefix}${names[0]!}`;
  const links = Array.from({ length: q_rad.length + 1 }, () => identity<"base", "link">());
  linkPoses(model.arm, q_rad, links);
  return [...links.slice(1), flangePose(model.arm, q_rad)].map((pose, i) => ({
    parent: base,
    child: `${prefix}${names[i + 1]!}`,
    pose,
  }));
}
