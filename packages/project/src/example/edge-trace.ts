import { emptyProgram, pose, type Pose, type Vector3 } from "@twincell/core";
import type { StepsCell, ObjectRecord, ToolRecord } from "../document.ts";

/*
 * Where things stand decides whether all four top edges can be traced with the tool at 45°: at the far edge the tool
 * points back at the robot, and joint 5 (−105 … 120°) asks for a forearm that comes down steeply; at the near edge the
 * wrist must still clear the column. A search over carton place and height, column height and tool length found a strip
 * around 0.45 m below the robot's foot and 0.6 m in front of it, where every joint keeps 20° to its limits.
 */
const COLUMN_HEIGHT_M = 0.75;
const CARTON_SIZE_M: Vector3 = [0.3, 0.4, 0.2];
const CARTON_AT_M: Vector3 = [0.6, 0, 0.4];
const TOOL_LENGTH_M = 0.14;
const TABLE_TOP_M: Vector3 = [0.5, 0.8, 0.04];
const TABLE_TOP_AT_M: Vector3 = [0.6, 0, 0.28];
const WALL_HEIGHT_M = 2.4;

const ROBOT = "staubli_rx90l";

/** Wire between nozzle and TCP. It is no solid: it may touch the work piece, the nozzle may not. */
const STICK_OUT_M = 0.012;

/** A slim torch: mounting disc, grip, nozzle. */
const TORCH: ToolRecord = {
  name: "torch",
  flangeFromTcp: pose([0, 0, TOOL_LENGTH_M]),
  shape: {
    kind: "revolved",
    profile_m: [
      [0.032, 0],
      [0.032, 0.012],
      [0.016, 0.018],
      [0.016, 0.075],
      [0.011, 0.085],
      [0.011, 0.108],
      [0.005, TOOL_LENGTH_M - STICK_OUT_M],
    ],
  },
};

const at = (x: number, y: number, z: number): Pose<"world", "object"> => pose([x, y, z]);

function wall(id: string, name: string, size_m: Vector3, x: number, y: number): ObjectRecord {
  return {
    id,
    name,
    role: "wall",
    worldFromObject: at(x, y, size_m[2] / 2),
    shape: { kind: "box", size_m },
    color: "#c9cdd2",
  };
}

/**
 * The RX90L on its column in a walled cell, with a carton of 400 × 300 × 200 mm on a low table: ready to trace the
 * carton's top edges.
 */
export function edgeTraceCell(): StepsCell {
  const stand_m = TABLE_TOP_AT_M[2] - TABLE_TOP_M[2] / 2;
  return {
    format: "twincell.cell",
    version: 2,
    name: "Edge trace",
    robot: { id: ROBOT, worldFromBase: pose([0, 0, COLUMN_HEIGHT_M]) },
    tools: [TORCH],
    tool: TORCH.name,
    objects: [
      {
        id: "column",
        name: "Column",
        role: "furniture",
        worldFromObject: at(0, 0, 0),
        shape: {
          kind: "revolved",
          profile_m: [
            [0.24, 0],
            [0.24, 0.02],
            [0.15, 0.03],
            [0.15, COLUMN_HEIGHT_M - 0.02],
            [0.17, COLUMN_HEIGHT_M - 0.015],
            [0.17, COLUMN_HEIGHT_M],
          ],
        },
        color: "#5b6570",
      },
      {
        id: "table-stand",
        name: "Table stand",
        role: "furniture",
        worldFromObject: at(TABLE_TOP_AT_M[0], 0, 0),
        shape: {
          kind: "revolved",
          profile_m: [
            [0.2, 0],
            [0.2, 0.015],
            [0.06, 0.03],
            [0.06, stand_m],
          ],
        },
        color: "#5b6570",
      },
      {
        id: "table",
        name: "Table",
        role: "furniture",
        worldFromObject: at(...TABLE_TOP_AT_M),
        shape: { kind: "box", size_m: TABLE_TOP_M },
        color: "#8a94a0",
      },
      {
        id: "carton",
        name: "Carton",
        role: "workpiece",
        worldFromObject: at(...CARTON_AT_M),
        shape: { kind: "box", size_m: CARTON_SIZE_M },
        color: "#b98a5a",
      },
      wall("wall-back", "Back wall", [0.1, 2.7, WALL_HEIGHT_M], -1.15, 0),
      wall("wall-left", "Left wall", [2.6, 0.1, WALL_HEIGHT_M], 0.1, 1.3),
      wall("wall-right", "Right wall", [2.6, 0.1, WALL_HEIGHT_M], 0.1, -1.3),
    ],
    frames: [
      {
        name: "Carton corner",
        worldFromFrame: pose([0.45, -0.2, 0.5]),
        attachedTo: {
          object: "carton",
          objectFromFrame: pose([-CARTON_SIZE_M[0] / 2, -CARTON_SIZE_M[1] / 2, CARTON_SIZE_M[2] / 2]),
        },
      },
    ],
    allowedPairs: [],
    programs: [emptyProgram(ROBOT, "Edge trace")],
    program: "Edge trace",
  };
}
