import {
  compose,
  identity,
  isSlide,
  type Branch,
  type MoveStep,
  type Pose,
  type Robot,
  type Speed,
  type Target,
} from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import { poseOf, type Header } from "./header.ts";
import type { PoseList } from "./pose-list.ts";

const PATHS = { PTP: "ptp", LIN: "lin", CIRCLE: "circ", SPLINE: "spline" } as const satisfies Record<
  string,
  MoveStep["path"]
>;

/** What a motion refers to. */
export interface MoveReferences extends Pick<PoseList, "tools" | "frames" | "poses"> {
  readonly robot: Robot | undefined;
  /** Six numbers that count from what the header says. */
  fromOrigin<From extends string>(numbers: readonly number[], header: Header): Pose<"world", From>;
}

/** What stands behind MOVE, up to the labels. */
export function readMove(cursor: Cursor, around: MoveReferences, header: Header, id: string): MoveStep {
  const path = PATHS[cursor.oneOf(["PTP", "LIN", "CIRCLE", "SPLINE"])];
  const via = path === "circ" ? readVia(cursor, around, header) : {};
  const target = readTarget(cursor, around, header);
  const speed = readSpeed(cursor);
  const acceleration = cursor.accept("ACC") ? { acceleration: { ratio: readShare(cursor) } } : {};
  return { id, type: "move", path, target, ...via, speed, ...acceleration, ...readBlend(cursor) };
}

function readVia(cursor: Cursor, around: MoveReferences, header: Header): { readonly via: Target } {
  cursor.expect("VIA");
  const via = readTarget(cursor, around, header);
  cursor.expect("TO");
  return { via };
}

function readTarget(cursor: Cursor, around: MoveReferences, header: Header): Target {
  const sort = cursor.oneOf(["JOINTS", "POSE", "AT"]);
  if (sort === "JOINTS") {
    const q = readJoints(cursor, around.robot, header);
    const tool = readTool(cursor, around);
    return tool === undefined ? { q } : { q, tool };
  }
  const { frame, pose } = sort === "AT" ? readNamed(cursor, around) : readPlace(cursor, around, header);
  const tool = readTool(cursor, around) ?? "flange";
  return { pose, frame, tool, ...(cursor.accept("BRANCH") ? { branch: readBranch(cursor, header) } : {}) };
}

function readJoints(cursor: Cursor, robot: Robot | undefined, { unit_m, unit_rad }: Header): number[] {
  if (robot === undefined) throw cursor.unexpected("a pose, since no robot is known whose joints these are");
  return cursor
    .numbers(robot.arm.joints.length, "joint value")
    .map((value, i) => value * (isSlide(robot.arm.joints[i]!) ? unit_m : unit_rad));
}

type Placed = Pick<Extract<Target, { readonly pose: unknown }>, "frame" | "pose">;
const inWorld = (worldFromTcp: Pose<"world", "tcp">): Placed => ({
  frame: "world",
  pose: compose(identity<"frame", "world">(), worldFromTcp),
});

/** A frame stands behind the numbers that count from it. */
function readPlace(cursor: Cursor, around: MoveReferences, header: Header): Placed {
  const numbers = cursor.numbers(6, "number");
  if (!cursor.accept("IN")) return inWorld(around.fromOrigin(numbers, header));
  const { here } = cursor;
  const frame = cursor.name("the name of a frame");
  if (!around.frames.has(frame))
    throw new TextError(here, "a FRAME of the list", `The list has no line FRAME ${frame} above this one.`);
  return { frame, pose: poseOf(numbers, header) };
}

function readNamed(cursor: Cursor, { poses }: MoveReferences): Placed {
  const { here } = cursor;
  const name = cursor.name("the name of a pose");
  const named = poses.get(name);
  if (named === undefined)
    throw new TextError(here, "a POSE of the list", `The list has no line POSE ${name} above this one.`);
  return inWorld(named.worldFromTcp);
}

function readTool(cursor: Cursor, { tools }: MoveReferences): string | undefined {
  if (!cursor.accept("TOOL")) return undefined;
  const { here } = cursor;
  const tool = cursor.name("the name of a tool");
  if (tool !== "flange" && !tools.has(tool))
    throw new TextError(here, "a TOOL of the list", `The list has no line TOOL ${tool} above this one.`);
  return tool;
}

function readBranch(cursor: Cursor, { unit_rad }: Header): Branch {
  const shoulder = cursor.oneOf(["FRONT", "BACK"]) === "FRONT" ? "front" : "back";
  const elbow = cursor.oneOf(["UP", "DOWN"]) === "UP" ? "up" : "down";
  const wrist = readSign(cursor);
  const determinant = cursor.accept("DET") ? { determinant: readSign(cursor) } : {};
  return {
    shoulder,
    elbow,
    wrist,
    ...determinant,
    ...(cursor.accept("ELBOW") ? { elbow_rad: cursor.number("an angle") * unit_rad } : {}),
  };
}

const readSign = (cursor: Cursor): "positive" | "negative" =>
  cursor.oneOf(["POSITIVE", "NEGATIVE"]) === "POSITIVE" ? "positive" : "negative";

function readSpeed(cursor: Cursor): Speed {
  if (cursor.accept("TIME")) return { time_s: readPositive(cursor, "a time in seconds") };
  if (!cursor.accept("SPEED")) throw cursor.unexpected("SPEED or TIME");
  const { here } = cursor;
  const value = readPositive(cursor, "a speed");
  if (!cursor.percent()) {
    cursor.expect("MMPS");
    return { mps: value / 1000 };
  }
  if (value > 100) throw new TextError(here, "a speed of at most 100 %", `${value} % is more than the full speed.`);
  return { ratio: value / 100 };
}

function readBlend(cursor: Cursor): Pick<MoveStep, "blend_m" | "blend_ratio"> {
  if (!cursor.accept("BLEND")) return { blend_m: 0 };
  const { here } = cursor;
  const value = readPositive(cursor, "a blend");
  if (!cursor.percent()) {
    cursor.expect("MM");
    return { blend_m: value / 1000 };
  }
  if (value > 100)
    throw new TextError(here, "a blend of at most 100 %", `${value} % is more than half of the shorter path.`);
  return { blend_m: 0, blend_ratio: value / 100 };
}

function readShare(cursor: Cursor): number {
  const { here } = cursor;
  const value = readPositive(cursor, "a share in per cent");
  if (!cursor.percent()) throw cursor.unexpected("%");
  if (value > 100) throw new TextError(here, "a share of at most 100 %", `${value} % is more than all of it.`);
  return value / 100;
}

function readPositive(cursor: Cursor, what: string): number {
  const { here } = cursor;
  const value = cursor.number(what);
  if (!(value > 0)) throw new TextError(here, `${what}, more than 0`, `${value} is not more than 0.`);
  return value;
}
