import {
  CellCollider,
  branchOf,
  compose,
  degrees,
  flangeOfTcp,
  fromAxisAngle,
  fromMatrix,
  linkSolids,
  multiply,
  nearestSolution,
  radians,
  sameBranch,
  solveAll,
  robotById,
  solverScratch,
  type Branch,
  type Pose,
  type Quaternion,
  type Vector3,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { cellGeometry, edgeTraceCell } from "../index.ts";

const cell = edgeTraceCell();
const robot = robotById(cell.robot.id)!;
const { worldFromBase } = cell.robot;
const { flangeFromTcp } = cell.tools[0]!;
const collider = new CellCollider(cellGeometry(cell, linkSolids(robot)), robot.arm);
const scratch = solverScratch();

const TILT_RAD = radians(45);
const LEAD_M = 0.05;
const SAMPLES = 41;
/** More than this from one sample to the next is a jump. */
const LARGEST_STEP_RAD = radians(15);
/** The robot's shape error and as much again. */
const CLEARANCE_M = 0.04;
const objects = new Set(cell.objects.map(object => object.id));

interface Edge {
  readonly name: string;
  readonly from: Vector3;
  readonly to: Vector3;
  readonly outward: Vector3;
}

/** The four top edges of the carton, each with the horizontal direction away from it. */
function topEdges(): Edge[] {
  const carton = cell.objects.find(object => object.id === "carton")!;
  if (carton.shape.kind !== "box") throw new Error("The carton is a box.");
  const [x, y, z] = carton.worldFromObject.position;
  const [sx, sy, sz] = carton.shape.size_m;
  const corners: Vector3[] = [
    [x - sx / 2, y - sy / 2, z + sz / 2],
    [x + sx / 2, y - sy / 2, z + sz / 2],
    [x + sx / 2, y + sy / 2, z + sz / 2],
    [x - sx / 2, y + sy / 2, z + sz / 2],
  ];
  const outwards: Vector3[] = [
    [0, -1, 0],
    [1, 0, 0],
    [0, 1, 0],
    [-1, 0, 0],
  ];
  return ["right", "far", "left", "near"].map((name, i) => ({
    name,
    from: corners[i]!,
    to: corners[(i + 1) % 4]!,
    outward: outwards[i]!,
  }));
}

/**
 * Tool axis 45° below the horizontal and into the carton; its x axis along the edge, turned by the spin about the tool
 * axis.
 */
function orientation(edge: Edge, spin_rad: number): Quaternion {
  const c = Math.cos(TILT_RAD);
  const s = Math.sin(TILT_RAD);
  const [ox, oy] = edge.outward;
  const z: Vector3 = [-ox * c, -oy * c, -s];
  const x: Vector3 = [-oy, ox, 0];
  const y: Vector3 = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]];
  return multiply(
    fromMatrix([x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]]),
    fromAxisAngle([0, 0, 1], spin_rad),
  );
}

/** Approach, trace and leave: tool poses in the world. */
function path(edge: Edge, spin_rad: number): Pose<"world", "tcp">[] {
  const quaternion = orientation(edge, spin_rad);
  const on = Array.from({ length: SAMPLES }, (_, i): Pose<"world", "tcp"> => {
    const t = i / (SAMPLES - 1);
    return { position: [0, 1, 2].map(k => edge.from[k]! + (edge.to[k]! - edge.from[k]!) * t) as Vector3, quaternion };
  });
  const back: Pose<"tcp", "tcp"> = { position: [0, 0, -LEAD_M], quaternion: [0, 0, 0, 1] };
  return [compose(on[0]!, back), ...on, compose(on.at(-1)!, back)];
}

interface Trace {
  readonly branch: Branch;
  readonly margin_rad: number;
  readonly sine5: number;
  readonly tight: readonly string[];
}

/**
 * The trace from one starting posture, each point nearest to the one before; undefined when it breaks off, jumps or
 * touches.
 */
function follow(poses: readonly Pose<"world", "tcp">[], start: Float64Array): Trace | undefined {
  const branch = branchOf(robot, start)!;
  const tight = new Set<string>();
  let now = start;
  let margin_rad = Infinity;
  let sine5 = Infinity;
  for (const [k, pose] of poses.entries()) {
    const next = new Float64Array(6);
    if (!nearestSolution(robot, flangeOfTcp(worldFromBase, pose, flangeFromTcp), now, next, scratch)) return undefined;
    if (k > 0 && next.some((angle, i) => Math.abs(angle - now[i]!) > LARGEST_STEP_RAD)) return undefined;
    if (!sameBranch(branchOf(robot, next)!, branch) || collider.collides(next)) return undefined;
    for (const [i, { limits }] of robot.arm.joints.entries())
      margin_rad = Math.min(margin_rad, next[i]! - limits.lower_rad, limits.upper_rad - next[i]!);
    sine5 = Math.min(sine5, Math.abs(Math.sin(next[4]!)));
    // The nozzle is near the carton by design; that it does not touch is checked above.
    for (const { a, b } of collider.near(next, CLEARANCE_M))
      if ((objects.has(a) || objects.has(b)) && !(a === "tool" && b === "carton")) tight.add(`${a} and ${b}`);
    now = next;
  }
  return { branch, margin_rad, sine5, tight: [...tight] };
}

/** Every way to trace the edge with that spin, the one farthest from the limits first. */
function traces(edge: Edge, spin_rad: number): Trace[] {
  const poses = path(edge, spin_rad);
  const reach = solveAll(robot, flangeOfTcp(worldFromBase, poses[0]!, flangeFromTcp));
  const found = reach.kind === "reached" ? reach.solutions.flatMap(({ q_rad }) => follow(poses, q_rad) ?? []) : [];
  return found.sort((a, b) => b.margin_rad - a.margin_rad);
}

describe("N-53 the example cell", () => {
  test("nothing touches anything at home", () => {
    expect(collider.check(robot.home_rad)).toEqual([]);
  });

  describe.each([0, 90, 180, 270])("with the tool turned by %d° about its axis", spin_deg => {
    test.each(topEdges().map(edge => [edge.name, edge] as const))(
      "the %s top edge can be traced at 45° on one branch, away from limits, singularity and solids",
      (_, edge) => {
        const [best] = traces(edge, radians(spin_deg));
        expect(best).toBeDefined();
        expect(best!.branch).toEqual({ shoulder: "front", elbow: "up", wrist: "positive" });
        expect(degrees(best!.margin_rad)).toBeGreaterThan(20);
        expect(best!.sine5).toBeGreaterThan(0.7);
        expect(best!.tight).toEqual([]);
      },
    );
  });
});
