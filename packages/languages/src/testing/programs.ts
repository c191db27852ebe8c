import {
  branchOf, compose, emptyProgram, flangePose, identity, inverse, seededRandom, span,
  type Capability, type MoveStep, type Pose, type Program, type Quaternion, type Random, type Robot, type Speed, type Step, type Target,
} from "@twincell/core";

export interface ProgramChoices {
  readonly seed: number;
  readonly steps: number;
  readonly worldFromBase: Pose<"world", "base">;
  readonly paths: readonly MoveStep["path"][];
  /** What the language lacks. */
  readonly cannot?: readonly Capability[];
}

/** A program whose every point the robot reaches: random postures, taught as joint angles or as poses of a tool in a frame. */
export function randomProgram(robot: Robot, { seed, steps, worldFromBase, paths, cannot = [] }: ProgramChoices): Program {
  const random = seededRandom(seed);
  const tools: Program["tools"] = { torch: randomPose(random, 0.2), "long tool (2)": randomPose(random, 0.4) };
  const frames: Program["frames"] = { carton: randomPose(random, 1), "Drehtisch ä": randomPose(random, 2) };
  const list: Step[] = [];
  for (let i = 0; i < steps; i++) {
    const base = { id: `k${i}`, ...(random() < 0.3 ? { name: `Point ${i}` } : {}), ...(random() < 0.4 ? { group: random() < 0.5 ? "g1" : "g2" } : {}) };
    const sort = random();
    if (sort < 0.08) { list.push({ ...base, type: "wait", s: Math.round(random() * 1000) / 100 }); continue; }
    if (sort < 0.16) { list.push({ ...base, type: "gripper", closed: random() < 0.5 }); continue; }
    const q = easyPosture(robot, random);
    const tool = pick(random, ["flange", ...Object.keys(tools)]), frame = pick(random, ["world", ...Object.keys(frames)]);
    const worldFromTcp = compose(worldFromBase, compose(flangePose(robot.arm, q), tools[tool] ?? identity<"flange", "tcp">()));
    const branch = random() < 0.5 ? branchOf(robot, q) : undefined;
    const path = pick(random, paths), drawn = randomSpeed(random);
    const speed = "time_s" in drawn && (path === "circ" || cannot.includes("duration")) ? { mps: 0.1 } : drawn;
    const passing = (by: string): Target =>
      ({ pose: compose(inverse(frames[frame] ?? identity()), compose(worldFromBase, compose(flangePose(robot.arm, beside(robot, q, random)), tools[by] ?? identity<"flange", "tcp">()))), frame, tool: by });
    const target: Target = random() < 0.4
      ? { q, ...(random() < 0.5 ? { tool } : {}) }
      : { pose: compose(inverse(frames[frame] ?? identity()), worldFromTcp), frame, tool, ...(branch === undefined ? {} : { branch }) };
    list.push({
      ...base, type: "move", path, target,
      ...(path === "circ" ? { via: passing(target.tool ?? "flange") } : {}),
      speed, blend_m: random() < 0.5 ? 0 : 0.01,
    });
  }
  return { ...emptyProgram(robot.id, `Prüfung No. ${seed}`), tools, frames, groups: { g1: { name: "Edge 1" }, g2: { name: "Edge 2" } }, steps: list };
}

/** Joint angles a little inside the limits, with the arm not stretched: the text's resolution must not push them out of reach. */
function easyPosture(robot: Robot, random: Random): number[] {
  for (;;) {
    const q = robot.arm.joints.map(({ limits: { lower_rad, upper_rad } }) => lower_rad + (upper_rad - lower_rad) * (0.01 + 0.98 * random()));
    // Other arms than these are not asked how far they are stretched.
    if (robot.family.kind !== "ortho-parallel") return q;
    const { distance_m, nearest_m, farthest_m } = span(robot, flangePose(robot.arm, q));
    if (farthest_m - distance_m > EASE_M && distance_m - nearest_m > EASE_M) return q;
  }
}
const EASE_M = 0.001;

/** A posture near by, inside the limits. */
const beside = (robot: Robot, q: readonly number[], random: Random): number[] =>
  robot.arm.joints.map(({ limits: { lower_rad, upper_rad } }, i) => Math.min(upper_rad, Math.max(lower_rad, q[i]! + 0.3 * (random() - 0.5))));

function randomSpeed(random: Random): Speed {
  const sort = random();
  if (sort < 0.45) return { ratio: 0.01 + 0.99 * random() };
  return sort < 0.9 ? { mps: 0.005 + random() } : { time_s: 0.5 + 5 * random() };
}

const pick = <T>(random: Random, list: readonly T[]): T => list[Math.floor(random() * list.length)]!;

/** Quarter and half turns, where angle conventions are singular. */
const SPECIAL: readonly Quaternion[] = [[0, 0, 0, 1], [1, 0, 0, 0], [0, 0, Math.SQRT1_2, Math.SQRT1_2], [0, Math.SQRT1_2, 0, Math.SQRT1_2]];

function randomPose<Into extends string, From extends string>(random: Random, size_m: number): Pose<Into, From> {
  const between = (): number => random() - 0.5;
  const q: Quaternion = random() < 0.3 ? pick(random, SPECIAL) : [between(), between(), between(), between()];
  const size = Math.hypot(...q);
  return { position: [between() * size_m, between() * size_m, between() * size_m], quaternion: [q[0] / size, q[1] / size, q[2] / size, q[3] / size] };
}
