import {
  compose,
  flangeOfTcp,
  flangePose,
  pose,
  robotById,
  solveAll,
  type Pose,
  type PhysicalObject,
  type PhysicalScene,
  type Vector3,
} from "@twincell/core";
import { createWorld, loadEngine, type MujocoWorld } from "../index.ts";

/** One engine for all tests of a file. */
export const engine = await loadEngine();

/** An arm that is out of the way and moved as told, with nothing around it. */
export const bareScene = (more: Partial<PhysicalScene> = {}): PhysicalScene => {
  const robot = more.robot ?? robotById("ur10e")!;
  return {
    robot,
    worldFromBase: pose(),
    q_rad: robot.home_rad,
    control: { kind: "moved" },
    objects: [],
    sensors: [],
    people: [],
    zones: [],
    ...more,
  };
};

export const box = (id: string, size_m: Vector3, at: Vector3, more: Partial<PhysicalObject> = {}): PhysicalObject => ({
  id,
  name: id,
  worldFromObject: pose(at),
  shape: { kind: "box", size_m },
  role: "part",
  ...more,
});

export function ready(scene: PhysicalScene): MujocoWorld {
  const answer = createWorld(engine, scene);
  if (answer.kind === "refused") throw new Error(answer.why.sentence);
  return answer.world;
}

/** Lets time pass with the arm held where it started. */
export function rest(world: MujocoWorld, seconds: number, gripperClosed = false): void {
  const { q_rad } = world.scene;
  const none = new Float64Array(q_rad.length);
  const command = { q_rad, qd_rad_s: none, qdd_rad_s2: none, gripperClosed };
  for (let i = Math.round(seconds / world.step_s); i > 0; i--) {
    const outcome = world.step(command);
    if (outcome.kind === "paused") throw new Error(outcome.why.sentence);
  }
}

/** Where the part is [m]. */
export const at = (world: MujocoWorld, part: number): Vector3 => [
  world.state.parts[7 * part]!,
  world.state.parts[7 * part + 1]!,
  world.state.parts[7 * part + 2]!,
];

/** Joint angles that bring the flange or a tool there, nearest to home. */
export function reaching(
  scene: PhysicalScene,
  worldFromTcp: Pose<"world", "tcp">,
  flangeFromTcp: Pose<"flange", "tcp"> = pose(),
): number[] {
  const reach = solveAll(scene.robot, flangeOfTcp(scene.worldFromBase, worldFromTcp, flangeFromTcp), {
    near: scene.q_rad,
  });
  if (reach.kind !== "reached") throw new Error(`Not reached: ${reach.kind}.`);
  return [...reach.solutions[0]!.q_rad];
}

export const tcpAt = (scene: PhysicalScene, q_rad: ArrayLike<number>): Pose =>
  compose(scene.worldFromBase as Pose, flangePose(scene.robot.arm, q_rad) as Pose);
