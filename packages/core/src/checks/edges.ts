import type { CellGeometry } from "../collision/cell.ts";
import type { TriangleMesh } from "../mesh/mesh.ts";
import { flangePose } from "../kinematics/forward.ts";
import { distanceToPolyline, nearestOnPolyline } from "../paths/curve.ts";
import { featureEdges, type FeatureEdges } from "../paths/features.ts";
import { compose, identity, inverse, transformPoint, type Pose } from "../spatial/pose.ts";
import { distance, type Vector3 } from "../spatial/vector.ts";
import { poseTarget, targetInBase, toolOf } from "../trajectory/moves.ts";
import type { Group, MoveStep } from "../program/program.ts";
import { everyStep } from "../program/walk.ts";
import type { Repair } from "./verdict.ts";
import { motions, startOf, type CheckScene } from "./scene.ts";

/** Faces that bend by more than this meet in an edge that is traced [rad]. */
export const SHARP_RAD = 0.5;

/** Which edge a group of steps was traced on, kept in the recipe of the group. */
export interface TracedEdgeRecord {
  /** Id of the object of the cell, and number of the edge among the edges of its shape. */
  readonly object: string;
  readonly edge: number;
  /** Ids of the steps that lie on the edge: lead-in, lead-out and points put in by hand are not among them. */
  readonly edgeSteps: readonly string[];
  /** How far the path may leave the edge [m]. */
  readonly tolerance_m: number;
}

/** What of a group's recipe says which edge it was traced on; undefined for a group that was made otherwise. */
export function tracedEdgeOf(group: Group): TracedEdgeRecord | undefined {
  const { object, edge, edgeSteps, pathTolerance_m, chordTolerance_m } = group.recipe ?? {};
  if (typeof object !== "string" || typeof edge !== "number" || !Array.isArray(edgeSteps)) return undefined;
  const ids = edgeSteps.filter((id): id is string => typeof id === "string");
  const share = (value: unknown): number => (typeof value === "number" && value > 0 ? value : 0);
  return { object, edge, edgeSteps: ids, tolerance_m: share(pathTolerance_m) + share(chordTolerance_m) || DEFAULT_M };
}
/** Of a recipe without tolerances [m]. */
const DEFAULT_M = 0.0005;
/** Ends of an edge that are nearer to each other than this are one: it is closed [m]. */
const SAME_PLACE_M = 1e-6;

const known = new WeakMap<TriangleMesh, FeatureEdges>();
function edgesOf(mesh: TriangleMesh): FeatureEdges {
  const features = known.get(mesh) ?? featureEdges(mesh, SHARP_RAD);
  known.set(mesh, features);
  return features;
}

/**
 * Whether traced paths still lie on their edges: the distance of every taught point, and of the tool on its way between
 * two of them, from the edge where its object stands now. A path that was not moved along with its object, or whose
 * object has another shape now, is off by that distance [m].
 */
export function checkEdges(scene: CheckScene, cell: CellGeometry): void {
  const groups = Object.entries(scene.program.groups).flatMap(([id, group]) => {
    const record = tracedEdgeOf(group);
    return record === undefined ? [] : [{ id, name: group.name, record }];
  });
  if (groups.length === 0) return;
  const written = new Map(Array.from(everyStep(scene.program), step => [step.id, step]));
  const stuck = new Set(scene.layout.obstacles.map(({ move }) => writtenOf(scene, move.step.id)));
  const off = new Map<string, { value: number; at_s: number }>();
  const note = (step: string, value: number, at_s: number): void => {
    if (value > (off.get(step)?.value ?? -1)) off.set(step, { value, at_s });
  };
  for (const { id, name, record } of groups) {
    const steps = record.edgeSteps.flatMap(each => {
      const step = written.get(each);
      return step?.type === "move" && step.group === id ? [step] : [];
    });
    const [first] = steps;
    if (first === undefined) continue;
    const object = cell.objects.find(each => each.id === record.object);
    const chain = object && edgesOf(object.mesh).chains[record.edge];
    if (!object || !chain) {
      scene.add(first.id, "warn", {
        code: "edge.gone",
        value: 0,
        limit: record.tolerance_m,
        unit: "m",
        at_s: startOf(scene, first.id),
        repairs: [],
        sentence: object
          ? `${object.name} no longer has the edge that ${name} was traced on. Trace it again.`
          : `The object that ${name} was traced on is no longer in the cell. Trace the edge of another, or delete these points.`,
      });
      continue;
    }
    const line = chain.points.map(point => transformPoint(object.worldFromObject as Pose, point));
    for (const step of steps) note(step.id, distanceToPolyline(line, placeOf(scene, step)), startOf(scene, step.id));
    measureMotions(scene, steps, stuck, line, note);
    const back = backOntoEdge(scene, steps, line, record.tolerance_m);
    const ends = backToItsEnds(scene, back, steps, line);
    for (const step of steps) {
      const worst = off.get(step.id);
      if (worst === undefined || worst.value <= record.tolerance_m) continue;
      scene.add(step.id, "bad", {
        code: "edge.off",
        value: worst.value,
        limit: record.tolerance_m,
        unit: "m",
        at_s: worst.at_s,
        repairs: [...edgeRepairs(step, back, object.name), ...edgeRepairs(step, ends, object.name)],
        sentence: `${mm(worst.value)} mm off the edge of ${object.name} it was traced on; ${mm(record.tolerance_m)} mm are allowed. Trace the edge again, or attach the points to ${object.name} before you move it.`,
      });
    }
  }
}

/** The steps whose own points are off the edge, each with its point put on the nearest spot of it. */
function backOntoEdge(
  scene: CheckScene,
  steps: readonly MoveStep[],
  line: readonly Vector3[],
  tolerance_m: number,
): readonly MoveStep[] {
  return steps.flatMap(step => {
    const place = placeOf(scene, step);
    if (!("pose" in step.target) || distanceToPolyline(line, place) <= tolerance_m) return [];
    return [movedTo(scene, step, nearestOnPolyline(line, place))];
  });
}

/**
 * The same steps, the first and the last of the edge at its two ends: a point that was moved far has its nearest spot
 * anywhere on the edge. Empty for an edge that is closed, or where neither of the two is among them.
 */
function backToItsEnds(
  scene: CheckScene,
  back: readonly MoveStep[],
  steps: readonly MoveStep[],
  line: readonly Vector3[],
): readonly MoveStep[] {
  const [first, last] = [steps[0]!, steps.at(-1)!];
  const [a, b] = [line[0]!, line.at(-1)!];
  const isOff = ({ id }: MoveStep): boolean => back.some(step => step.id === id);
  if (first === last || distance(a, b) < SAME_PLACE_M || !(isOff(first) || isOff(last))) return [];
  // The one that is still there says which end is whose.
  const [known, of] = isOff(first) ? [placeOf(scene, last), "last"] : [placeOf(scene, first), "first"];
  const near = distance(known, a) <= distance(known, b) ? [a, b] : [b, a];
  const [start, end] = of === "first" ? near : [near[1]!, near[0]!];
  return back.map(step =>
    step.id === first.id ? movedTo(scene, step, start!) : step.id === last.id ? movedTo(scene, step, end!) : step,
  );
}

/** A step with its point at a place of the world, its orientation kept. */
function movedTo(scene: CheckScene, step: MoveStep, place: Vector3): MoveStep {
  const { target } = step;
  if (!("pose" in target)) return step;
  const { quaternion } = targetInBase(target, scene.robot, scene.context);
  const baseFromWorld = inverse(scene.context.worldFromBase ?? identity<"world", "base">());
  const position = transformPoint(baseFromWorld, place);
  return { ...step, target: poseTarget({ position, quaternion }, target, scene.context) };
}

/** All of them at once: a point that stays off leaves the way to its neighbours off too. */
function edgeRepairs(step: MoveStep, back: readonly MoveStep[], object: string): readonly Repair[] {
  if (back.length === 0) return [];
  const own = back.find(({ id }) => id === step.id);
  const count = back.length;
  return [
    {
      kind: "edge",
      sentence: `Put ${count === 1 ? "the point" : `${count} points`} back onto the edge of ${object}.`,
      ...(own === undefined ? {} : { replace: own }),
      alsoReplace: back.filter(each => each !== own),
    },
  ];
}

/** The tool on its way between neighbouring points of the edge, at every instant of the plan. */
function measureMotions(
  scene: CheckScene,
  steps: readonly MoveStep[],
  stuck: ReadonlySet<string>,
  line: readonly Vector3[],
  note: (step: string, value: number, at_s: number) => void,
): void {
  const inner = new Map(steps.slice(1).map((step, i) => [step.id, { step, before: steps[i]!.id }]));
  const worldFromBase = scene.context.worldFromBase ?? identity<"world", "base">();
  const n = scene.robot.arm.joints.length;
  for (const segment of motions(scene)) {
    const found = inner.get(writtenOf(scene, segment.step));
    // Where a point is not reached, that is what is said; the distance of the way there says nothing.
    if (!found || stuck.has(found.step.id) || stuck.has(found.before)) continue;
    const flangeFromTcp = toolOf(scene.context, found.step.target.tool);
    for (let i = 0; i < segment.times_s.length; i++) {
      const q = segment.q_rad.subarray(i * n, (i + 1) * n);
      const tcp = compose(compose(worldFromBase, flangePose(scene.robot.arm, q)), flangeFromTcp);
      note(found.step.id, distanceToPolyline(line, tcp.position), segment.start_s + segment.times_s[i]!);
    }
  }
}

const writtenOf = (scene: CheckScene, id: string): string => scene.layout.turns.get(id)?.written.id ?? id;

function placeOf(scene: CheckScene, step: MoveStep): Vector3 {
  const baseFromTcp = targetInBase(step.target, scene.robot, scene.context);
  return compose(scene.context.worldFromBase ?? identity<"world", "base">(), baseFromTcp).position;
}

/** As many digits as the number needs. */
const mm = (value_m: number): string => (value_m * 1000).toFixed(value_m < 0.01 ? 2 : 1);
