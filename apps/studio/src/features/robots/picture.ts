import { identity, linkPoses, type Robot, type Vector3 } from "@twincell/core";

/** A robot in its home position as a few strokes, seen from its right and a little from above. */
export interface RobotPicture {
  readonly viewBox: string;
  readonly bones: string;
  readonly joints: readonly (readonly [number, number])[];
  readonly width: number;
}

/** Seen along this direction: x to the right, height up, depth a little of both. */
const flat = ([x, y, z]: Vector3): [number, number] => [x - 0.35 * y, -z - 0.18 * y];
const ROOM = 0.14;

export function robotPicture(robot: Robot): RobotPicture {
  const links = Array.from({ length: robot.arm.joints.length + 1 }, () => identity<"base", "link">());
  linkPoses(robot.arm, robot.home_rad, links);
  const points = links.map(link => flat(link.position));
  const xs = points.map(([x]) => x);
  const ys = points.map(([, y]) => y);
  const left = Math.min(...xs);
  const top = Math.min(...ys);
  const width = Math.max(...xs) - left;
  const height = Math.max(...ys) - top;
  const size = Math.max(width, height);
  const room = ROOM * size;
  const round = (value: number): number => Math.round(value * 1000) / 1000;
  return {
    viewBox: [left - (size - width) / 2 - room, top - (size - height) / 2 - room, size + 2 * room, size + 2 * room]
      .map(round)
      .join(" "),
    bones: `M${points.map(([x, y]) => `${round(x)} ${round(y)}`).join("L")}`,
    joints: points.map(([x, y]) => [round(x), round(y)] as const),
    width: round(0.13 * size),
  };
}
