import {
  CellCollider,
  compose,
  curveOfChain,
  distance,
  explainReach,
  featureEdges,
  flangeOfTcp,
  flangePose,
  moveCurve,
  nearestSolution,
  refineJointPath,
  robotById,
  rotate,
  conjugate,
  solveAll,
  SHARP_RAD,
  solverScratch,
  traceEdges,
  travel,
  type CellGeometry,
  type EdgeCurve,
  type JointWaypoint,
  type Pose,
  type RefineArm,
  type Robot,
  type TracedEdge,
  type Vector3,
} from "@twincell/core";
import { shapeMesh, type ObjectRecord } from "@twincell/project";
import type { TraceOptions, TraceState } from "../../stores/trace.ts";

export interface TraceTask {
  readonly chosen: TraceState["chosen"];
  readonly objects: readonly ObjectRecord[];
  readonly options: TraceOptions;
  readonly robot: string;
  readonly cell: CellGeometry;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
  /** Posture the trace is approached from. */
  readonly start_rad: readonly number[];
}
interface PointOfEdge {
  readonly role: "lead-in" | "edge" | "lead-out";
  readonly inserted: boolean;
}
/**
 * A point of a followed edge has the joint angles found for it; one of an edge that the robot cannot follow is where
 * the tool would have to be.
 */
export type TracedPoint =
  | (PointOfEdge & { readonly q: readonly number[] })
  | (PointOfEdge & { readonly worldFromTcp: Pose<"world", "tcp"> });
export type TraceAnswer =
  | {
      readonly kind: "traced";
      readonly edges: readonly (readonly TracedPoint[])[];
      readonly inserted: number;
      readonly deviation_m: number;
      /**
       * Edges, from 1, that cannot be followed, and why; their points are there all the same, for the checker to judge.
       */
      readonly unreached: readonly { readonly edge: number; readonly sentence: string }[];
    }
  | { readonly kind: "cannot"; readonly edge: number; readonly sentence: string };

/** A round tool leaves the turn about its axis open: these are tried [rad]. */
const SPINS = Array.from({ length: 12 }, (_, i) => (i * Math.PI) / 6);
/** Nearer to a joint limit than this costs as much as a detour. */
const ROOM_RAD = (15 * Math.PI) / 180;
/**
 * An arm whose joints turn twice round has hundreds of postures for a point, most of them others by whole turns: the
 * nearest are tried.
 */
const MOST_WAYS = 16;
const TURN_TOLERANCE_RAD = (0.1 * Math.PI) / 180;
/** The rest of the tolerance is for passing the points without a stop. */
const SHARE = 0.8;

/**
 * The chosen edges as joint angles: each edge with the turn about the tool axis and the arm posture that keep clear of
 * solids and limits and are nearest to where the edge before ended; with points added until joint motion between them
 * stays on the edge (rows N-52, N-53, N-58). An edge that cannot be followed gets its points as poses, and the reason.
 */
export function traceProgram(task: TraceTask): TraceAnswer {
  const robot = robotById(task.robot);
  if (!robot) return { kind: "cannot", edge: 0, sentence: `The library has no robot called “${task.robot}”.` };
  const curves = curvesOf(task);
  if (typeof curves === "string") return { kind: "cannot", edge: 0, sentence: curves };
  const collider = new CellCollider(task.cell, robot.arm);
  const edges: TracedPoint[][] = [];
  const unreached: { edge: number; sentence: string }[] = [];
  let near: Float64Array = Float64Array.from(task.start_rad);
  let inserted = 0;
  let deviation_m = 0;
  for (const [i, curve] of curves.entries()) {
    const best = bestWay(task, robot, collider, curve, near);
    if (typeof best === "string") {
      const points = asPoses(task, curve);
      if (points.length === 0) return { kind: "cannot", edge: i + 1, sentence: best };
      unreached.push({ edge: i + 1, sentence: best });
      edges.push(points);
      continue;
    }
    edges.push(best.points);
    inserted += best.points.filter(point => point.inserted).length;
    deviation_m = Math.max(deviation_m, best.deviation_m);
    near = Float64Array.from(best.points.at(-1)!.q);
  }
  return { kind: "traced", edges, inserted, deviation_m, unreached };
}

/** The points of an edge as poses of the tool, whether the robot gets there or not. */
function asPoses({ options }: TraceTask, curve: EdgeCurve): TracedPoint[] {
  const [edge] = traceEdges([curve], {
    tilt_rad: options.tilt_rad,
    chord_m: options.chordTolerance_m,
    leadIn_m: options.leadIn_m,
    leadOut_m: options.leadOut_m,
  });
  return (edge?.points ?? []).map(({ pose, role }) => ({ role, worldFromTcp: inWorld(pose), inserted: false }));
}

type ReachedPoint = Extract<TracedPoint, { q: unknown }>;
interface Way {
  readonly points: ReachedPoint[];
  readonly deviation_m: number;
  readonly cost: number;
}

function bestWay(
  task: TraceTask,
  robot: Robot,
  collider: CellCollider,
  curve: EdgeCurve,
  near: Float64Array,
): Way | string {
  let best: Way | undefined;
  let why = "";
  for (const spin_rad of SPINS) {
    const [edge] = traceEdges([curve], {
      tilt_rad: task.options.tilt_rad,
      chord_m: task.options.chordTolerance_m,
      spin_rad,
      leadIn_m: task.options.leadIn_m,
      leadOut_m: task.options.leadOut_m,
    });
    if (!edge) continue;
    const first = flangeOfTcp(task.cell.worldFromBase, inWorld(edge.points[0]!.pose), task.flangeFromTcp);
    const reach = solveAll(robot, first, { near });
    if (reach.kind !== "reached") {
      why ||= explainReach(reach);
      continue;
    }
    for (const { q_rad } of reach.solutions.slice(0, MOST_WAYS)) {
      const way = follow(task, robot, collider, edge, q_rad, near);
      if (typeof way === "string") why ||= way;
      else if (!best || way.cost < best.cost) best = way;
    }
  }
  return best ?? (why || "The edge is shorter than its tolerance.");
}

/** The edge from one posture on; a sentence when it breaks off or something is touched. */
function follow(
  task: TraceTask,
  robot: Robot,
  collider: CellCollider,
  edge: TracedEdge,
  start: Float64Array,
  near: Float64Array,
): Way | string {
  const scratch = solverScratch();
  const arm: RefineArm = {
    solve(pose, from) {
      const out = new Float64Array(from.length);
      const flange = flangeOfTcp(task.cell.worldFromBase, inWorld(pose), task.flangeFromTcp);
      return nearestSolution(robot, flange, from, out, scratch)
        ? out
        : explainReach(solveAll(robot, flange, { near: from }));
    },
    forward(q, out) {
      const tcp = compose(compose(task.cell.worldFromBase, flangePose(robot.arm, q)), task.flangeFromTcp);
      out.position[0] = tcp.position[0];
      out.position[1] = tcp.position[1];
      out.position[2] = tcp.position[2];
      for (let i = 0; i < 4; i++) out.quaternion[i] = tcp.quaternion[i]!;
    },
  };
  const on = edge.points.filter(point => point.onEdge);
  const into = edge.points.find(point => point.role === "lead-in");
  const out = edge.points.find(point => point.role === "lead-out");
  const begin = into ? arm.solve(on[0]!.pose, start) : start;
  if (typeof begin === "string") return begin;
  const refined = refineJointPath(
    on.map(point => point.pose),
    begin,
    arm,
    {
      tolerance_m: task.options.motion === "joint" ? task.options.pathTolerance_m * SHARE : Infinity,
      tolerance_rad: task.options.motion === "joint" ? TURN_TOLERANCE_RAD : Infinity,
    },
  );
  switch (refined.kind) {
    case "unreachable":
      return refined.sentence;
    case "posture-change":
      return `Joint ${refined.joint} would jump by ${((refined.jump_rad * 180) / Math.PI).toFixed(0)}° on the edge.`;
    case "too-many-points":
      return `More than ${refined.limit} points would be needed to stay within the tolerance.`;
    case "refined":
      break;
  }
  const last = refined.points.at(-1)!;
  const end = out ? arm.solve(out.pose, last.q) : null;
  if (typeof end === "string") return end;
  const points: ReachedPoint[] = [
    ...(into ? [pointOf("lead-in", start, false)] : []),
    ...refined.points.map((point: JointWaypoint) => pointOf("edge", point.q, point.inserted)),
    ...(end ? [pointOf("lead-out", end, false)] : []),
  ];
  let margin_rad = Infinity;
  for (const { q } of points) {
    const configuration = Float64Array.from(q);
    if (collider.collides(configuration)) {
      const [contact] = collider.check(configuration);
      return contact ? `${contact.a} would touch ${contact.b}.` : "Something would be touched.";
    }
    for (const [i, { limits }] of robot.arm.joints.entries())
      margin_rad = Math.min(margin_rad, q[i]! - limits.lower_rad, limits.upper_rad - q[i]!);
  }
  const deviation_m = Math.max(
    0,
    ...(task.options.motion === "joint" ? refined.after.map(segment => segment.position_m) : [0]),
  );
  return {
    points,
    deviation_m,
    cost: travel(near, start) + (0.2 * points.length) / 10 + 20 * Math.max(0, ROOM_RAD - margin_rad),
  };
}
const pointOf = (role: TracedPoint["role"], q: Float64Array, inserted: boolean): ReachedPoint => ({
  role,
  q: Array.from(q),
  inserted,
});
const inWorld = (pose: Pose): Pose<"world", "tcp"> => ({ position: pose.position, quaternion: pose.quaternion });

/** Curves in the world, each run the way it was chosen; or a sentence. */
function curvesOf({ chosen, objects }: TraceTask): EdgeCurve[] | string {
  const known = new Map<string, ReturnType<typeof featureEdges>>();
  const curves: EdgeCurve[] = [];
  for (const { object: id, edge, polyline } of chosen) {
    const object = objects.find(each => each.id === id);
    if (!object) return `The object “${id}” is no longer in the cell.`;
    const features = known.get(id) ?? featureEdges(shapeMesh(object.shape), SHARP_RAD);
    known.set(id, features);
    const chain = features.chains.find(each => each.id === edge);
    if (!chain) return `Edge ${edge + 1} of ${object.name} is no longer there.`;
    const up: Vector3 = rotate(conjugate(object.worldFromObject.quaternion), [0, 0, 1]);
    const curve = moveCurve(curveOfChain(chain, up), object.worldFromObject);
    const begin = polyline[0];
    const there = curve.points[0]!;
    const backwards =
      begin !== undefined && !curve.closed && distance(there, begin) > distance(curve.points.at(-1)!, begin);
    curves.push(
      backwards
        ? {
            points: curve.points.toReversed(),
            first: curve.first.toReversed(),
            second: curve.second.toReversed(),
            closed: curve.closed,
          }
        : curve,
    );
  }
  return curves;
}
