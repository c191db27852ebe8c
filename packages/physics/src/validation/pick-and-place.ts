import {
  emptyProgram,
  fromAxisAngle,
  meshBounds,
  PARALLEL_GRIPPER,
  pose,
  torusMesh,
  type Gripper,
  type MoveStep,
  type PhysicalObject,
  type PhysicalScene,
  type Pose,
  type Program,
  type Robot,
  type SolidShape,
  type Step,
  type Vector3,
} from "@twincell/core";
import type { Engine } from "../engine.ts";
import { solidMesh } from "../model/solid-geoms.ts";
import { PhysicsRun } from "../run/run.ts";
import { createWorld } from "../world.ts";

/** Shapes of the matrix by name; each is as broad between the fingers as it is told [m]. */
export const MATRIX_SHAPES = {
  box: (w: number): SolidShape => ({ kind: "box", size_m: [w, 1.5 * w, w] }),
  "flat plate": w => ({ kind: "box", size_m: [w, 2 * w, 0.4 * w] }),
  cylinder: w => ({ kind: "cylinder", radius_m: w / 2, height_m: 1.2 * w }),
  ball: w => ({ kind: "sphere", radius_m: w / 2 }),
  cup: w => ({
    kind: "revolved",
    profile_m: [
      [0.5 * w, 0],
      [0.5 * w, w],
      [0.38 * w, w],
      [0.38 * w, 0.15 * w],
      [0, 0.15 * w],
    ],
  }),
  torus: w => ({ kind: "mesh", mesh: torusMesh(0.36 * w, 0.14 * w, 32, 12) }),
} as const satisfies Record<string, (width_m: number) => SolidShape>;
export type MatrixShape = keyof typeof MATRIX_SHAPES;

export interface PickCase {
  readonly shape: MatrixShape;
  readonly width_m: number;
  readonly mass_kg: number;
}

/** How one pick and place went (row X-34). */
export interface PickRow extends PickCase {
  readonly verdict: "placed" | "refused" | "dropped" | "off";
  /** Of the part from where it should be, at rest [m]. */
  readonly off_m: number;
  readonly highest_m: number;
  readonly seconds: number;
  /** Why, where it was not placed. */
  readonly sentence: string;
}

/** A placed part may be this far off: what the fingers push it while they close, and a ball rolls when let go [m]. */
export const PLACED_WITHIN_M = 0.01;
const LIFT_M = 0.15;
/** The fingers stay this far above the table [m]. */
const CLEAR_M = 0.003;
const DOWN = fromAxisAngle([1, 0, 0], Math.PI);

/** A program that fetches a part at one place and puts it down at another, gripping `grip_m` above its lowest point. */
export function pickAndPlaceProgram(
  robot: Robot,
  gripper: Gripper,
  from: Vector3,
  to: Vector3,
  ratio: number,
): Program {
  const steps: Step[] = [];
  const over = ([x, y, z]: Vector3): Vector3 => [x, y, z + LIFT_M];
  const move = (id: string, path: MoveStep["path"], at: Vector3): void => {
    steps.push({
      id,
      type: "move",
      path,
      target: { pose: pose<"frame", "tcp">(at, DOWN), frame: "world", tool: "gripper" },
      speed: path === "lin" ? { mps: 0.25 } : { ratio },
      blend_m: 0,
    });
  };
  move("over-pick", "ptp", over(from));
  move("at-pick", "lin", from);
  steps.push({ id: "close", type: "gripper", closed: true });
  move("lift", "lin", over(from));
  move("over-place", "ptp", over(to));
  move("at-place", "lin", to);
  steps.push({ id: "open", type: "gripper", closed: false });
  move("leave", "lin", over(to));
  steps.push({ id: "rest", type: "wait", s: 0.4 });
  return {
    ...emptyProgram(robot.id, "Pick and place"),
    tools: { gripper: gripper.flangeFromGrip as Pose as Pose<"flange", "tcp"> },
    steps,
  };
}

export interface PickOptions {
  readonly robot: Robot;
  readonly control: PhysicalScene["control"];
  readonly gripper?: Gripper;
  readonly ratio?: number;
  /** Places of the part's middle on the table, in the robot's base [m]; the table stands 0.1 m above the base. */
  readonly from_m?: readonly [number, number];
  readonly to_m?: readonly [number, number];
}

/** The cell of one case: a table, and the part on it with its lowest point on the table. */
export function pickScene(
  { shape, width_m, mass_kg }: PickCase,
  { robot, control, gripper = PARALLEL_GRIPPER, from_m = [0.65, -0.2] }: PickOptions,
): { readonly scene: PhysicalScene; readonly rest_m: number; readonly grip_m: number } {
  const solid = MATRIX_SHAPES[shape](width_m);
  const { lower, upper } = meshBounds(solidMesh(solid));
  const top_m = 0.1;
  const rest_m = top_m - lower[2];
  const part: PhysicalObject = {
    id: "part",
    name: `${shape} of ${Math.round(width_m * 1000)} mm`,
    role: "part",
    worldFromObject: pose([from_m[0], from_m[1], rest_m]),
    shape: solid,
    mass_kg,
  };
  const table: PhysicalObject = {
    id: "table",
    name: "Table",
    role: "fixture",
    worldFromObject: pose([0.65, 0, top_m - 0.02]),
    shape: { kind: "box", size_m: [0.6, 1, 0.04] },
  };
  const grip_m = top_m + Math.max((upper[2] - lower[2]) / 2, gripper.beyond_m + CLEAR_M);
  return {
    scene: {
      robot,
      worldFromBase: pose(),
      q_rad: robot.home_rad,
      control,
      gripper,
      objects: [table, part],
      sensors: [],
      people: [],
      zones: [],
    },
    rest_m,
    grip_m,
  };
}

/** Carries out one case and says how it went. */
export function pickAndPlace(engine: Engine, which: PickCase, options: PickOptions): PickRow {
  const { robot, gripper = PARALLEL_GRIPPER, ratio = 0.5, from_m = [0.65, -0.2], to_m = [0.65, 0.25] } = options;
  const { scene, rest_m, grip_m } = pickScene(which, options);
  const answer = createWorld(engine, scene);
  const none = { ...which, off_m: 0, highest_m: 0, seconds: 0 };
  if (answer.kind === "refused") return { ...none, verdict: "refused", sentence: answer.why.sentence };
  const { world } = answer;
  let dropped = "";
  const run = new PhysicsRun(
    world,
    pickAndPlaceProgram(robot, gripper, [from_m[0], from_m[1], grip_m], [to_m[0], to_m[1], grip_m], ratio),
    {
      onEvent: event => {
        if (event.kind === "dropped") dropped = event.sentence;
      },
    },
  );
  let highest_m = 0;
  while (run.state.kind === "running" && world.state.time_s < 60) {
    run.advance();
    highest_m = Math.max(highest_m, world.state.parts[2]! - rest_m);
  }
  const off_m = Math.hypot(
    world.state.parts[0]! - to_m[0],
    world.state.parts[1]! - to_m[1],
    world.state.parts[2]! - rest_m,
  );
  const seconds = world.state.time_s;
  world.close();
  const row = { ...which, off_m, highest_m, seconds };
  if (run.state.why) return { ...row, verdict: "refused", sentence: run.state.why.sentence };
  if (off_m <= PLACED_WITHIN_M) return { ...row, verdict: "placed", sentence: "" };
  return dropped !== ""
    ? { ...row, verdict: "dropped", sentence: dropped }
    : { ...row, verdict: "off", sentence: `The part is ${(off_m * 1000).toFixed(1)} mm from where it should be.` };
}

/** Every shape with every size and weight (rows X-34 … X-36). */
export const pickMatrix = (
  shapes: readonly MatrixShape[],
  widths_m: readonly number[],
  masses_kg: readonly number[],
): PickCase[] =>
  shapes.flatMap(shape => widths_m.flatMap(width_m => masses_kg.map(mass_kg => ({ shape, width_m, mass_kg }))));
