import {
  compose,
  explainPose,
  flangePose,
  inverse,
  repairPose,
  robotById,
  seededRandom,
  solveAll,
  type Pose,
  type Robot,
} from "@twincell/core";
import { figure, type Bench, type Figure } from "./figure.ts";

const POSES = 10_000;
const TOOL: Pose<"flange", "tcp"> = { position: [0.05, 0, 0.15], quaternion: [0, 0, 0, 1] };

/** Poses out of reach: postures beyond their limits, and 2 of 5 of them moved outwards. */
function infeasible(robot: Robot, seed: number): readonly Pose<"base", "tcp">[] {
  const random = seededRandom(seed);
  const tcpFromFlange = inverse(TOOL);
  const poses: Pose<"base", "tcp">[] = [];
  while (poses.length < POSES) {
    const q = robot.arm.joints.map(({ limits: { lower_rad, upper_rad } }) => {
      const half = Math.min(1.3 * ((upper_rad - lower_rad) / 2), 6);
      return (lower_rad + upper_rad) / 2 + (2 * random() - 1) * half;
    });
    const pose = compose(flangePose(robot.arm, q), TOOL);
    const outwards = random() < 0.4 ? 1 + random() * 0.5 : 1;
    for (let i = 0; i < 3; i++) pose.position[i]! *= outwards;
    if (solveAll(robot, compose(pose, tcpFromFlange)).kind !== "reached") poses.push(pose);
  }
  return poses;
}

/** Why a pose cannot be reached and the least spin, tilt and shift that change that, on 10,000 poses a robot. */
export const run: Bench = () => {
  const tcpFromFlange = inverse(TOOL);
  const figures: Figure[] = [];
  for (const [name, id] of [
    ["kr6", "kuka_kr6r900sixx"],
    ["rx90l", "staubli_rx90l"],
    ["ur10e", "ur10e"],
  ] as const) {
    const robot = robotById(id)!;
    const poses = infeasible(robot, 15);
    const once = (pose: Pose<"base", "tcp">): number => {
      const began = process.hrtime.bigint();
      explainPose(robot, compose(pose, tcpFromFlange));
      repairPose(robot, pose, tcpFromFlange);
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
