import {
  checkProgram,
  compose,
  degrees,
  flangePose,
  linkSolids,
  planProgram,
  robotById,
  rotate,
  samplePlan,
  SHARP_RAD,
  type MoveStep,
  type Verdict,
  type Vector3,
} from "@twincell/core";
import { cellGeometry, edgeTraceCell, shapeMesh } from "@twincell/project";
import { featureEdges, edgeLoop, edgeNearPoint, curvesOfLoop, moveCurve, distanceToPolyline } from "@twincell/core";
import { beforeAll, expect, test } from "vitest";
import { cellStore } from "../../stores/cell.ts";
import { commit, showDocument, theProgram, withObject } from "../../stores/document.ts";
import { traceStore } from "../../stores/trace.ts";
import { addTrace } from "./trace-command.ts";
import { traceProgram, type TraceAnswer, type TracedPoint } from "./tracing.ts";

const cell = edgeTraceCell();
const robot = robotById(cell.robot.id)!;
const carton = cell.objects.find(object => object.id === "carton")!;
const { flangeFromTcp } = cell.tools[0]!;
const features = featureEdges(shapeMesh(carton.shape), SHARP_RAD);
const half: Vector3 = [
  carton.shape.kind === "box" ? carton.shape.size_m[0] / 2 : 0,
  0,
  carton.shape.kind === "box" ? carton.shape.size_m[2] / 2 : 0,
];
const loop = edgeLoop(features, edgeNearPoint(features, half, 0.001)!.chain, [0, 0, 1]);
const curves = curvesOfLoop(loop).map(curve => moveCurve(curve, carton.worldFromObject));
const chosen = loop.chains.map(({ chain }, i) => ({ object: carton.id, edge: chain.id, polyline: curves[i]!.points }));
const { options } = traceStore.getState();
let answer: TraceAnswer;
/** A point that was reached. */
function angles(point: TracedPoint): Extract<TracedPoint, { q: unknown }> {
  if (!("q" in point)) throw new Error("a point is out of reach");
  return point;
}

beforeAll(() => {
  answer = traceProgram({
    chosen,
    options,
    objects: cell.objects,
    robot: robot.id,
    cell: cellGeometry(cell, linkSolids(robot)),
    flangeFromTcp,
    start_rad: robot.home_rad,
  });
});

test("N-53 the four top edges of the carton are traced at 45° in the order they were chosen", () => {
  expect(answer).toMatchObject({ kind: "traced" });
  if (answer.kind !== "traced") return;
  expect(answer.edges).toHaveLength(4);
  for (const [i, edge] of answer.edges.entries())
    for (const point of edge.map(angles).filter(({ role }) => role === "edge")) {
      const tcp = compose(compose(cell.robot.worldFromBase, flangePose(robot.arm, point.q)), flangeFromTcp);
      expect(distanceToPolyline(curves[i]!.points, tcp.position)).toBeLessThan(1e-5);
      expect(degrees(Math.acos(-rotate(tcp.quaternion, [0, 0, 1])[2]))).toBeCloseTo(45, 1);
    }
});

test("N-58 the executed path of the whole program stays within the stated tolerance of the edges", () => {
  if (answer.kind !== "traced") throw new Error(answer.sentence);
  expect(answer.deviation_m).toBeLessThanOrEqual(options.pathTolerance_m);
  showDocument(cell);
  addTrace(answer.edges, options, robot, cell.tool, chosen);
  const program = theProgram()!;
  const planned = planProgram(program, robot, { worldFromBase: cell.robot.worldFromBase });
  if (planned.kind !== "planned") throw new Error(JSON.stringify(planned.stuck));
  const onEdge = new Map<string, number>();
  program.steps.forEach((step, i) => {
    const before = program.steps[i - 1];
    if (
      step.type === "move" &&
      step.group !== undefined &&
      before?.type === "move" &&
      before.group === step.group &&
      !step.name &&
      !before.name
    )
      onEdge.set(step.id, Object.keys(program.groups).indexOf(step.group));
  });
  const q = new Float64Array(6);
  let worst = 0;
  let looked = 0;
  for (const segment of planned.plan.segments) {
    const edge = onEdge.get(segment.step);
    if (edge === undefined) continue;
    for (let i = 0; i <= 20; i++) {
      samplePlan(planned.plan, segment.start_s + (segment.duration_s * Math.min(i, 19.999)) / 20, q);
      const tcp = compose(compose(cell.robot.worldFromBase, flangePose(robot.arm, q)), flangeFromTcp);
      worst = Math.max(worst, distanceToPolyline(curves[edge]!.points, tcp.position));
      looked++;
    }
  }
  expect(looked).toBeGreaterThan(100);
  expect(worst).toBeLessThanOrEqual(options.pathTolerance_m);
});

test("all of it is one undo step, with home before and after, and one group an edge", () => {
  const program = theProgram()!;
  const first = program.steps[0];
  const last = program.steps.at(-1);
  const q = (step: typeof first): readonly number[] =>
    step?.type === "move" && "q" in step.target ? step.target.q : [];
  expect(q(first)).toEqual(robot.home_rad);
  expect(q(last)).toEqual(robot.home_rad);
  expect(new Set(program.steps.map(step => step.group)).size).toBe(5);
  expect(
    program.steps.filter((step): step is MoveStep => step.type === "move" && step.blend_m > 0).length,
  ).toBeGreaterThan(0);
});

test.each(["staubli_rx160", "kuka_kr6_2", "ur10e"])(
  "N-66 the same four edges are traced by another robot in the place of the first: %s",
  id => {
    const other = robotById(id)!;
    const there = { ...cell, robot: { ...cell.robot, id } };
    const traced = traceProgram({
      chosen,
      options,
      objects: cell.objects,
      robot: id,
      cell: cellGeometry(there, linkSolids(other)),
      flangeFromTcp,
      start_rad: other.home_rad,
    });
    if (traced.kind !== "traced") throw new Error(traced.sentence);
    expect(traced.edges).toHaveLength(4);
    expect(traced.deviation_m).toBeLessThanOrEqual(options.pathTolerance_m);
    for (const [i, edge] of traced.edges.entries()) {
      expect(edge.filter(({ role }) => role === "edge").length).toBeGreaterThanOrEqual(2);
      for (const { role, q } of edge.map(angles)) {
        const tcp = compose(compose(cell.robot.worldFromBase, flangePose(other.arm, q)), flangeFromTcp);
        if (role === "edge") expect(distanceToPolyline(curves[i]!.points, tcp.position)).toBeLessThan(1e-5);
        expect(degrees(Math.acos(-rotate(tcp.quaternion, [0, 0, 1])[2]))).toBeCloseTo(45, 1);
        for (const [j, { limits }] of other.arm.joints.entries()) {
          expect(q[j]).toBeGreaterThanOrEqual(limits.lower_rad);
          expect(q[j]).toBeLessThanOrEqual(limits.upper_rad);
        }
      }
    }
  },
  60_000,
);

const checked = (): Verdict => {
  const { document } = cellStore.getState();
  return checkProgram(theProgram()!, robot, { cell: cellGeometry(document!, linkSolids(robot)) }).verdict;
};
const offEdge = (verdict: Verdict): readonly number[] =>
  verdict.steps.flatMap(({ findings }) => findings.flatMap(({ code, value }) => (code === "edge.off" ? [value] : [])));
const moveCarton = (x_m: number): boolean =>
  commit("Move", before =>
    withObject(before, carton.id, object => ({
      ...object,
      worldFromObject: {
        ...object.worldFromObject,
        position: [
          object.worldFromObject.position[0] + x_m,
          object.worldFromObject.position[1],
          object.worldFromObject.position[2],
        ],
      },
    })),
  );

test("traced points belong to the carton: moved by 20 mm it takes its path along, and no point is off its edge", () => {
  if (answer.kind !== "traced") throw new Error(answer.sentence);
  showDocument(cell);
  addTrace(answer.edges, options, robot, cell.tool, chosen);
  const at = (): Vector3[] =>
    theProgram()!.steps.flatMap(step =>
      step.type === "move" && "pose" in step.target
        ? [compose(theProgram()!.frames[step.target.frame]!, step.target.pose).position]
        : [],
    );
  const before = at();
  expect(before.length).toBe(answer.edges.flat().length);
  expect(offEdge(checked())).toEqual([]);
  expect(moveCarton(0.02)).toBe(true);
  at().forEach((point, i) => {
    expect(point[0] - before[i]![0]).toBeCloseTo(0.02, 9);
    expect(point[1]).toBeCloseTo(before[i]![1], 9);
  });
  expect(offEdge(checked())).toEqual([]);
});

test("a path that stays behind when the carton is moved by 100 mm is off its edge by 100 mm, and the check says so", () => {
  if (answer.kind !== "traced") throw new Error(answer.sentence);
  showDocument(cell);
  addTrace(answer.edges, options, robot, cell.tool, chosen);
  // Taken off the carton, the points stay where they are.
  commit("Detach", before => ({
    ...before,
    frames: before.frames.map(({ attachedTo: _, ...frame }) => frame),
  }));
  expect(offEdge(checked())).toEqual([]);
  moveCarton(-0.1);
  const values = offEdge(checked());
  // What the path was off before, within its tolerance, comes on top.
  expect(Math.max(...values)).toBeGreaterThan(0.1 - 1e-9);
  expect(Math.max(...values)).toBeLessThan(0.1 + options.pathTolerance_m);
  const sentences = checked().steps.flatMap(({ verdict, findings }) =>
    findings.flatMap(({ code, sentence }) => (code === "edge.off" ? [`${verdict}: ${sentence}`] : [])),
  );
  expect(sentences.find(each => /100\.\d mm off the edge of Carton/.test(each))).toMatch(/^bad: /);
});

test("an edge out of reach gets its points all the same: as poses that the check finds too far, with the reason", () => {
  const far = {
    ...cell,
    objects: cell.objects.map(object =>
      object.id === carton.id
        ? { ...object, worldFromObject: { ...object.worldFromObject, position: [2.5, 0, 0.4] as Vector3 } }
        : object,
    ),
  };
  const traced = traceProgram({
    chosen: chosen.slice(0, 1).map(each => ({ ...each, polyline: [] })),
    options,
    objects: far.objects,
    robot: robot.id,
    cell: cellGeometry(far, linkSolids(robot)),
    flangeFromTcp,
    start_rad: robot.home_rad,
  });
  if (traced.kind !== "traced") throw new Error(traced.sentence);
  expect(traced.unreached).toMatchObject([{ edge: 1 }]);
  expect(traced.unreached[0]!.sentence).toMatch(/the arm is 1100 mm long/);
  showDocument(far);
  addTrace(traced.edges, options, robot, cell.tool, chosen);
  const verdict = checked();
  const codes = verdict.steps.flatMap(({ id, findings }) => findings.map(finding => `${id} ${finding.code}`));
  expect(codes.filter(code => code.endsWith("reach.too-far")).length).toBe(traced.edges[0]!.length);
  expect(offEdge(verdict)).toEqual([]);
});
