import {
  emptyProgram,
  fromAxisAngle,
  PARALLEL_GRIPPER,
  pose,
  type MoveStep,
  type Pose,
  type Program,
  type Step,
} from "@twincell/core";
import type { StepsCell, ObjectRecord } from "../document.ts";

/** Boxes of 60 mm come one after the other; nine places of a table take them (row M-54). */
const BOX_M = 0.06;
const BOX_KG = 0.8;
const BOXES = 9;
const SPACING_M = 0.14;
const BELT_TOP_M = 0.3;
const BELT_Y_M = -0.55;
const BEAM_X_M = 0.36;
const BELT_MPS = 0.25;
/** From its running speed the belt comes to rest in v² / 2a = 31 mm; the sensor is read every 4 ms. */
const STOPS_AFTER_M = 0.032;
const TABLE_TOP_M = 0.2;
const GRIP_ABOVE_M = 0.03;
const OVER_M = 0.12;
const DOWN = fromAxisAngle([1, 0, 0], Math.PI);
const PLACES = "places";
const TOOL = "gripper";

const { flangeFromGrip, open_m, closed_m, force_N, finger_m, beyond_m, speed_mps, friction, mass_kg } =
  PARALLEL_GRIPPER;

const box = (number: number): ObjectRecord => ({
  id: `box-${number}`,
  name: `Box ${number}`,
  role: "workpiece",
  worldFromObject: pose([BEAM_X_M - 0.1 - number * SPACING_M, BELT_Y_M, BELT_TOP_M + BOX_M / 2]),
  shape: { kind: "box", size_m: [BOX_M, BOX_M, BOX_M] },
  color: "#b98a5a",
  mass_kg: BOX_KG,
  friction: 0.6,
});

/** A UR10e between a conveyor with a photo-cell and a table with nine places, and the program that fills them. */
export function conveyorPalletCell(): StepsCell {
  const first_m = BEAM_X_M - 0.1 - BOXES * SPACING_M - 0.2;
  const last_m = BEAM_X_M + 0.25;
  return {
    format: "twincell.cell",
    version: 2,
    name: "Conveyor and pallet",
    robot: { id: "ur10e", worldFromBase: pose([0, 0, 0.1]) },
    tools: [
      {
        name: TOOL,
        flangeFromTcp: flangeFromGrip as Pose as Pose<"flange", "tcp">,
        gripper: { open_m, closed_m, force_N, finger_m, beyond_m, speed_mps, friction, mass_kg },
      },
    ],
    tool: TOOL,
    objects: [
      {
        id: "stand",
        name: "Stand",
        role: "furniture",
        worldFromObject: pose([0, 0, 0.05]),
        shape: { kind: "box", size_m: [0.3, 0.3, 0.1] },
        color: "#5b6570",
      },
      {
        id: "conveyor",
        name: "Conveyor",
        role: "fixture",
        worldFromObject: pose([(first_m + last_m) / 2, BELT_Y_M, BELT_TOP_M - 0.04]),
        shape: { kind: "box", size_m: [last_m - first_m, 0.2, 0.08] },
        color: "#3d444b",
        friction: 0.8,
        belt: { direction: [1, 0, 0], speed_mps: BELT_MPS, runs: { signal: "box_there", is: false } },
      },
      {
        id: "table",
        name: "Table",
        role: "furniture",
        worldFromObject: pose([0.6, 0.35, TABLE_TOP_M / 2]),
        shape: { kind: "box", size_m: [0.5, 0.5, TABLE_TOP_M] },
        color: "#8a94a0",
      },
      ...Array.from({ length: BOXES }, (_, i) => box(i + 1)),
    ],
    frames: [{ name: "table", worldFromFrame: pose([0.47, 0.22, TABLE_TOP_M]) }],
    allowedPairs: [],
    sensors: [
      {
        id: "photo-cell",
        name: "Photo-cell",
        kind: "beam",
        from_m: [BEAM_X_M, BELT_Y_M - 0.15, BELT_TOP_M + 0.03],
        to_m: [BEAM_X_M, BELT_Y_M + 0.15, BELT_TOP_M + 0.03],
        signal: "box_there",
        sees: ["part"],
      },
    ],
    programs: [fillProgram()],
    program: "Fill the table",
  };
}

/** Waits for a box, fetches it and puts it down at the next place; the belt runs as soon as the photo-cell is free. */
function fillProgram(): Program {
  const pick_m = [BEAM_X_M - BOX_M / 2 + STOPS_AFTER_M, BELT_Y_M, BELT_TOP_M + GRIP_ABOVE_M] as const;
  const move = (
    id: string,
    name: string,
    path: MoveStep["path"],
    to: Pose<"frame", "tcp">,
    frame: string,
    speed: MoveStep["speed"],
  ): MoveStep => ({ id, name, type: "move", path, target: { pose: to, frame, tool: TOOL }, speed, blend_m: 0 });
  const at = (x: number, y: number, z: number): Pose<"frame", "tcp"> => pose([x, y, z], DOWN);
  const fast = { ratio: 0.6 } as const;
  const slow = { mps: 0.25 } as const;
  const steps: Step[] = [
    move("s1", "Over the belt", "ptp", at(pick_m[0], pick_m[1], pick_m[2] + OVER_M), "world", fast),
    { id: "s2", name: "A box is there", type: "wait-for", when: { signal: "box_there", is: true } },
    { id: "s3", name: "The belt comes to rest", type: "wait", s: 0.35 },
    move("s4", "At the box", "lin", at(...pick_m), "world", slow),
    { id: "s5", type: "gripper", closed: true },
    move("s6", "Lift", "lin", at(pick_m[0], pick_m[1], pick_m[2] + OVER_M), "world", slow),
    move("s7", "Over the place", "ptp", at(0, 0, GRIP_ABOVE_M + OVER_M), PLACES, fast),
    move("s8", "At the place", "lin", at(0, 0, GRIP_ABOVE_M), PLACES, slow),
    { id: "s9", type: "gripper", closed: false },
    move("s10", "Leave", "lin", at(0, 0, GRIP_ABOVE_M + OVER_M), PLACES, slow),
  ];
  return {
    ...emptyProgram("ur10e", "Fill the table"),
    tools: { [TOOL]: flangeFromGrip as Pose as Pose<"flange", "tcp"> },
    frames: { table: pose([0.47, 0.22, TABLE_TOP_M]) },
    signals: { box_there: { kind: "digital-in", address: 1 } },
    pallets: {
      [PLACES]: {
        frame: "table",
        origin: pose(),
        rowEnd: [0.26, 0, 0],
        columnEnd: [0, 0.26, 0],
        rows: 3,
        columns: 3,
        layers: 1,
        layer_m: BOX_M,
      },
    },
    steps: [{ id: "p", type: "pallet", pallet: PLACES, steps }],
  };
}
