import { compose, explainPose, repairPose, robotById, seededRandom, type Pose } from "@twincell/core";
import { FLANGE_IN_TOOL, infeasiblePoses } from "../packages/core/src/checks/repair/testing/brute-force.ts";
import { figure, type Bench, type Figure } from "./figure.ts";

const POSES = 10_000;

/** Why a pose cannot be reached and the least spin, tilt and shift that change that, on 10,000 poses a robot. */
export const run: Bench = () => {
  const figures: Figure[] = [];
  for (const [name, id] of [
    ["kr6", "kuka_kr6r900sixx"],
    ["rx90l", "staubli_rx90l"],
    ["ur10e", "ur10e"],
  ] as const) {
    const robot = robotById(id)!;
    const source = infeasiblePoses(robot, seededRandom(15));
    const poses = Array.from({ length: POSES }, () => source.next().value);
    const once = (pose: Pose<"base", "tcp">): number => {
      const began = process.hrtime.bigint();
      explainPose(robot, compose(pose, FLANGE_IN_TOOL));
      repairPose(robot, pose, FLANGE_IN_TOOL);
      return Number(process.hrtime.bigint() - began) / 1e6;
    };
    for (const pose of poses.slice(0, 500)) once(pose);
    const times = poses.map(once).sort((a, b) => a - b);
    const over = times.filter(ms => ms > 5).length;
    const p99 = times[Math.floor(0.99 * times.length)]!;
    figures.push(figure(`explain/${name}`, "ms", times, `p99 ${p99.toFixed(2)} ms; ${over} of ${POSES} above 5 ms`));
  }
  return Promise.resolve(figures);
};
