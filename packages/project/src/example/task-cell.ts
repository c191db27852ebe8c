import {
  emptyProgram,
  fromAxisAngle,
  PARALLEL_GRIPPER,
  pose,
  type MoveStep,
  type Pallet,
  type Pose,
  type Program,
  type Speed,
  type Step,
  type Vector3,
} from "@twincell/core";
import type { ObjectRecord, StepsCell, ToolRecord } from "../document.ts";

/** Tool axis straight down in the world. */
export const DOWN = fromAxisAngle([1, 0, 0], Math.PI);
export const FAST: Speed = { ratio: 0.4 };
export const SLOW: Speed = { mps: 0.1 };

const { flangeFromGrip, open_m, closed_m, force_N, finger_m, beyond_m, speed_mps, friction, mass_kg } =
  PARALLEL_GRIPPER;

/** The parallel gripper of the library as a tool of a cell. */
export const GRIPPER: ToolRecord = {
  name: "gripper",
  flangeFromTcp: flangeFromGrip as Pose as Pose<"flange", "tcp">,
  gripper: { open_m, closed_m, force_N, finger_m, beyond_m, speed_mps, friction, mass_kg },
};

/** A slim pointed tool of that length; its last 12 mm are no solid: they may touch the part. */
export const pointed = (name: string, length_m: number): ToolRecord => ({
  name,
  flangeFromTcp: pose([0, 0, length_m]),
  shape: {
    kind: "revolved",
    profile_m: [
      [0.025, 0],
      [0.025, 0.012],
      [0.014, 0.02],
      [0.012, length_m - 0.04],
      [0.004, length_m - 0.012],
    ],
  },
});

/** A box that stands with its underside at `bottom_m`. */
export const box = (
  id: string,
  name: string,
  role: ObjectRecord["role"],
  size_m: Vector3,
  [x, y, bottom_m]: Vector3,
  color: string,
): ObjectRecord => ({
  id,
  name,
  role,
  worldFromObject: pose([x, y, bottom_m + size_m[2] / 2]),
  shape: { kind: "box", size_m },
  color,
});

/** Steps in the order they are added; ids are counted. */
export class StepList {
  readonly steps: Step[] = [];
  readonly #tool: string;
  readonly #acceleration: MoveStep["acceleration"];

  /** `acceleration`: of every move; that of the robot when left out. */
  constructor(tool: string, acceleration?: MoveStep["acceleration"]) {
    this.#tool = tool;
    this.#acceleration = acceleration;
  }

  get #id(): string {
    return `s${this.steps.length + 1}`;
  }

  /** A move to a place in a frame, tool axis down. */
  to(
    name: string,
    path: "ptp" | "lin",
    at_m: Vector3,
    speed: Speed = path === "ptp" ? FAST : SLOW,
    frame = "world",
  ): this {
    const target: MoveStep["target"] = { pose: pose(at_m, DOWN), frame, tool: this.#tool };
    const acceleration = this.#acceleration;
    this.steps.push({
      ...{ id: this.#id, name, type: "move", path, target, speed, blend_m: 0 },
      ...(acceleration && { acceleration }),
    });
    return this;
  }

  grip(closed: boolean): this {
    this.steps.push({ id: this.#id, type: "gripper", closed });
    return this;
  }

  set(signal: string, to: boolean): this {
    this.steps.push({ id: this.#id, type: "set", signal, to });
    return this;
  }

  waitFor(signal: string): this {
    this.steps.push({ id: this.#id, type: "wait-for", when: { signal, is: true } });
    return this;
  }
}

/** A cell around one program of steps. */
export function taskCell(task: {
  readonly name: string;
  readonly robot: string;
  readonly foot_m: number;
  readonly tool: ToolRecord;
  readonly objects: readonly ObjectRecord[];
  readonly steps: readonly Step[];
  readonly signals?: Program["signals"];
  readonly frames?: Program["frames"];
  readonly pallets?: Readonly<Record<string, Pallet>>;
}): StepsCell {
  const { name, robot, foot_m, tool, frames = {} } = task;
  const stand = box("stand", "Stand", "furniture", [0.3, 0.3, foot_m], [0, 0, 0], "#5b6570");
  return {
    format: "twincell.cell",
    version: 2,
    name,
    robot: { id: robot, worldFromBase: pose([0, 0, foot_m]) },
    tools: [tool],
    tool: tool.name,
    objects: [stand, ...task.objects],
    frames: Object.entries(frames).map(([frame, worldFromFrame]) => ({ name: frame, worldFromFrame })),
    allowedPairs: [],
    programs: [
      {
        ...emptyProgram(robot, name),
        tools: { [tool.name]: tool.flangeFromTcp },
        frames,
        signals: task.signals ?? {},
        pallets: task.pallets ?? {},
        steps: task.steps,
      },
    ],
    program: name,
  };
}
