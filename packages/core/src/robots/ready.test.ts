import { expect, test } from "vitest";
import { CATALOGUE } from "../catalogue/index.ts";
import {
  addCatalogue,
  catalogueRobots,
  flangePose,
  isSingularConfiguration,
  LIBRARY,
  readyPosture,
  rotate,
  type Robot,
} from "../index.ts";

addCatalogue(CATALOGUE);

const isHome = ({ home_rad }: Robot, q_rad: Float64Array): boolean => home_rad.every((q, i) => q === q_rad[i]);

test("every robot with a closed form stands bent over its work: flange down in front of the base, inside its limits, not singular", () => {
  const robots = [...LIBRARY, ...catalogueRobots()].filter(({ family }) => family.kind !== "general");
  expect(robots.length).toBeGreaterThan(100);
  const poles = robots.filter(robot => isHome(robot, readyPosture(robot))).map(({ id }) => id);
  expect(poles).toEqual([]);
  for (const robot of robots) {
    const q_rad = readyPosture(robot);
    const { position, quaternion } = flangePose(robot.arm, q_rad);
    expect(rotate(quaternion, [0, 0, 1])[2]).toBeCloseTo(-1, 6);
    expect(position[0]).toBeGreaterThan(0.4 * robot.reach_m);
    expect(Math.abs(position[1])).toBeLessThan(1e-6);
    expect(isSingularConfiguration(robot, q_rad)).toBe(false);
    robot.arm.joints.forEach(({ limits }, i) => {
      expect(q_rad[i]!).toBeGreaterThan(limits.lower_rad);
      expect(q_rad[i]!).toBeLessThan(limits.upper_rad);
    });
  }
});
