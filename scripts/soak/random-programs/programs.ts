import type { CellDefinition } from "@twincell/controllers";
import {
  boxMesh,
  CellCollider,
  emptyProgram,
  fromAxisAngle,
  identity,
  linkPoses,
  linkSolids,
  pose,
  type CellObject,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  type Vector3,
} from "@twincell/core";

type Random = () => number;
const between = (random: Random, from: number, to: number): number => from + (to - from) * random();

/** A cell of one robot without objects, with a tool of a random length or without one [m]. */
export function emptyCell(robot: Robot, random: Random): CellDefinition {
  const length_m = random() < 0.5 ? between(random, 0.08, 0.25) : 0;
  return {
    worldFromBase: pose(),
    objects: [],
    allowedPairs: [],
    shapeError_m: robot.shapeError_m,
    ...(length_m > 0
      ? { tool: { name: "Tool", mesh: shifted(boxMesh([0.05, 0.05, length_m]), [0, 0, length_m / 2]) } }
      : {}),
  };
}
const shifted = (mesh: ReturnType<typeof boxMesh>, by: Vector3): ReturnType<typeof boxMesh> => ({
  ...mesh,
  positions: mesh.positions.map((value, i) => value + by[i % 3]!),
});

/** A box of a random size and turn, at most `about_m` from that place. */
function box(id: string, at: Vector3, about_m: number, random: Random): CellObject {
  const side = (): number => between(random, 0.03, 0.4);
  const off = (): number => between(random, -about_m, about_m);
  const axis: Vector3 = [off(), off(), off() + 1e-6];
  const turn = fromAxisAngle(axis, between(random, 0, Math.PI));
  const worldFromObject = pose([at[0] + off(), at[1] + off(), at[2] + off()], turn) as Pose as Pose<"world", "object">;
  return { id, name: id, worldFromObject, mesh: boxMesh([side(), side(), side()]) };
}

/** One to three moves to random joint angles: by joints, by a line or along an arc, at a random speed, some rounded. */
export function randomProgram(robot: Robot, from_rad: ArrayLike<number>, onlyJoints: boolean, random: Random): Program {
  const steps: MoveStep[] = [];
  let at = Array.from(from_rad);
  const near = (q: readonly number[], most_rad: number): number[] =>
    q.map((angle, i) => {
      const { lower_rad, upper_rad } = robot.arm.joints[i]!.limits;
      const by = (i < 3 ? 1 : 1.5) * most_rad * between(random, -1, 1);
      return Math.min(upper_rad - 0.02, Math.max(lower_rad + 0.02, angle + by));
    });
  const count = 1 + Math.floor(3 * random());
  for (let i = 0; i < count; i++) {
    const how = onlyJoints ? 0 : random();
    const path = how < 0.65 ? "ptp" : how < 0.9 ? "lin" : "circ";
    const q = near(at, path === "ptp" ? 1.2 : 0.35);
    steps.push({
      id: `move-${i + 1}`,
      type: "move",
      path,
      target: { q },
      ...(path === "circ" ? { via: { q: near(at, 0.2) } } : {}),
      speed: path === "ptp" ? { ratio: between(random, 0.2, 1) } : { mps: between(random, 0.1, 1) },
      blend_m: i < count - 1 && random() < 0.4 ? between(random, 0.005, 0.05) : 0,
    });
    at = q;
  }
  return { ...emptyProgram(robot.id, "Random"), steps };
}

/** Where an object is put: somewhere on the way of a link, or anywhere the arm may reach. */
export function randomObjects(
  robot: Robot,
  from_rad: ArrayLike<number>,
  program: Program,
  onTheWay: boolean,
  random: Random,
): CellObject[] {
  const reach_m = Math.max(...program.steps.map(step => farthest_m(robot, step as MoveStep)), 0.3);
  const somewhere = (): Vector3 => [
    between(random, -reach_m, reach_m),
    between(random, -reach_m, reach_m),
    between(random, 0, reach_m),
  ];
  const objects = Array.from({ length: 1 + Math.floor(3 * random()) }, (_, i) =>
    box(`box-${i + 1}`, somewhere(), 0.1, random),
  );
  if (!onTheWay) return objects;
  const moves = program.steps as readonly MoveStep[];
  const k = Math.floor(random() * moves.length);
  const part = between(random, 0.2, 1);
  const to = joints(moves[k]!);
  const from = k === 0 ? from_rad : joints(moves[k - 1]!);
  const q = to.map((angle, i) => from[i]! + part * (angle - from[i]!));
  const frames = Array.from({ length: q.length + 1 }, () => identity<"base", "link">());
  linkPoses(robot.arm, q, frames);
  const link = frames[3 + Math.floor(random() * (frames.length - 3))]!;
  return [box("in-the-way", link.position, 0.08, random), ...objects.slice(1)];
}
const joints = (step: MoveStep): readonly number[] => ("q" in step.target ? step.target.q : []);
function farthest_m(robot: Robot, step: MoveStep): number {
  const frames = Array.from({ length: robot.arm.joints.length + 1 }, () => identity<"base", "link">());
  linkPoses(robot.arm, joints(step), frames);
  return Math.hypot(...frames.at(-1)!.position);
}

/** Says whether anything touches at some joint angles: no margin, no error, and what touches at home by design not. */
export function touching(cell: CellDefinition, robot: Robot): CellCollider {
  const collider = new CellCollider({ ...cell, links: linkSolids(robot) }, robot.arm);
  collider.allowContactsAt(robot.home_rad);
  return collider;
}
