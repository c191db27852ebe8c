import type { Robot } from "@twincell/core";
import { words } from "../../messages/index.ts";

/** What a person asks of a robot. An empty maker is any maker; 0 is no wish. */
export interface RobotWish {
  readonly search: string;
  readonly maker: string;
  readonly reach_m: number;
  readonly payload_kg: number;
}
export const ANY_ROBOT: RobotWish = { search: "", maker: "", reach_m: 0, payload_kg: 0 };

/**
 * The robots that fit a wish, in the order they were given. With a wished payload, robots whose payload no source
 * states stand last: they may carry it.
 */
export function fittingRobots(robots: readonly Robot[], wish: RobotWish): readonly Robot[] {
  const { search, maker, reach_m, payload_kg } = wish;
  const found = robots.filter(
    robot =>
      (maker === "" || robot.vendor === maker) &&
      robot.reach_m >= reach_m &&
      (robot.payload_kg === undefined || robot.payload_kg >= payload_kg) &&
      matches(robot, search),
  );
  return payload_kg === 0
    ? found
    : found.toSorted((a, b) => Number(a.payload_kg === undefined) - Number(b.payload_kg === undefined));
}

/** Makers by name, each once. */
export const makersOf = (robots: readonly Robot[]): readonly string[] =>
  [...new Set(robots.map(({ vendor }) => vendor))].toSorted((a, b) => a.localeCompare(b, "en"));

const matches = (robot: Robot, search: string): boolean =>
  search
    .toLowerCase()
    .split(/\s+/)
    .every(part =>
      `${robot.name} ${robot.vendor} ${robot.id} ${words.tree.axes(robot.arm.joints.length)}`
        .toLowerCase()
        .includes(part),
    );
