import {
  compose,
  curvesOfLoop,
  degrees,
  distanceToPolyline,
  edgeLoop,
  edgeNearPoint,
  featureEdges,
  flangePose,
  linkSolids,
  moveCurve,
  planProgram,
  robotById,
  rotate,
  SHARP_RAD,
  type MoveStep,
  type Vector3,
} from "@twincell/core";
import { cellGeometry, edgeTraceCell, shapeMesh } from "@twincell/project";
import { expect, test } from "vitest";
import { addTrace } from "../runtime/planning/trace-command.ts";
import { traceProgram } from "../runtime/planning/tracing.ts";
import { words } from "../messages/index.ts";
import { showDocument, theProgram } from "./document.ts";
import { PROCESS_NAMES, PROCESSES, processOf } from "./processes.ts";
import { traceStore } from "./trace.ts";

const cell = edgeTraceCell();
const robot = robotById(cell.robot.id)!;
const carton = cell.objects.find(object => object.id === "carton")!;
const { flangeFromTcp } = cell.tools[0]!;
const { worldFromBase } = cell.robot;
const size = carton.shape.kind === "box" ? carton.shape.size_m : ([0, 0, 0] as Vector3);
const features = featureEdges(shapeMesh(carton.shape), SHARP_RAD);
const loop = edgeLoop(features, edgeNearPoint(features, [size[0] / 2, 0, size[2] / 2], 0.001)!.chain, [0, 0, 1]);
const curve = moveCurve(curvesOfLoop(loop)[0]!, carton.worldFromObject);
const chosen = [{ object: carton.id, edge: loop.chains[0]!.chain.id, polyline: curve.points }];

test("N-61 the seven processes of the paper have a preset each, and a name", () => {
  expect(PROCESS_NAMES.map(name => words.trace.processes[name])).toEqual([
    "Arc welding",
    "Deburring",
    "Soldering",
    "Chamfering",
    "Gluing",
    "Water jet",
    "Inspection",
  ]);
  expect(words.trace.processSays).toMatch(/starting values/i);
});

test.each(PROCESS_NAMES)(
  "N-61 with the values of %s an edge of the carton is traced at its angle, and the program runs",
  name => {
    const options = PROCESSES[name];
    traceStore.setState({ options });
    const answer = traceProgram({
      chosen,
      options: traceStore.getState().options,
      objects: cell.objects,
      robot: robot.id,
      cell: cellGeometry(cell, linkSolids(robot)),
      flangeFromTcp,
      start_rad: robot.home_rad,
    });
    if (answer.kind !== "traced") throw new Error(answer.sentence);
    expect(answer.deviation_m).toBeLessThanOrEqual(options.pathTolerance_m);
    for (const point of answer.edges[0]!.filter(({ role }) => role === "edge")) {
      if (!("q" in point)) throw new Error("a point is out of reach");
      const { q } = point;
      const tcp = compose(compose(worldFromBase, flangePose(robot.arm, q)), flangeFromTcp);
      expect(distanceToPolyline(curve.points, tcp.position)).toBeLessThan(1e-5);
      // Elevation of the tool above the top of the carton.
      expect(degrees(Math.asin(Math.min(1, -rotate(tcp.quaternion, [0, 0, 1])[2])))).toBeCloseTo(
        degrees(options.tilt_rad),
        1,
      );
    }
    showDocument(cell);
    addTrace(answer.edges, options, robot, cell.tool, chosen);
    const planned = planProgram(theProgram()!, robot, { worldFromBase });
    expect(planned.kind).toBe("planned");
    const on = theProgram()!.steps.filter(
      (step): step is MoveStep => step.type === "move" && step.group !== undefined && "mps" in step.speed,
    );
    expect(on.every(({ speed }) => "mps" in speed && speed.mps === options.speed_mps)).toBe(true);
    expect(on.some(({ path }) => path === "lin")).toBe(true);
  },
  60_000,
);

test("N-61 the panel names the process until one of its values is changed", () => {
  expect(processOf(PROCESSES.gluing)).toBe("gluing");
  expect(processOf({ ...PROCESSES.gluing, speed_mps: 0.09 })).toBeNull();
});
