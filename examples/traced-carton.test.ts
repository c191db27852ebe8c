/**
 * The whole path through every package: the example program is checked against its cell, exported, executed as text,
 * planned, and measured against the carton's edges.
 */
import {
  CellCollider,
  checkProgram,
  degrees,
  flangePose,
  compose,
  linkSolids,
  planProgram,
  robotById,
  rotate,
  samplePlan,
  type MoveStep,
  type Program,
  type Step,
  type Vector3,
} from "@twincell/core";
import { dialectsFor, proveText, vPlus } from "@twincell/languages";
import { cellGeometry, recordedAsJoints, tracedCartonCell } from "@twincell/project";
import { describe, expect, test } from "vitest";

const cell = tracedCartonCell();
const program = cell.programs[0]!;
const robot = robotById(cell.robot.id)!;
const recorded = recordedAsJoints(cell, program);
const { worldFromBase } = cell.robot;
const geometry = cellGeometry(cell, linkSolids(robot));

/** The text's own resolution at a target, and the planner's tolerance along the path. */
const TARGET_M = 1e-5;
const PATH_M = 5e-5;
const TILT_DEG = 0.1;

test.each([
  ["poses", program],
  ["joint angles", recorded],
])("taught as %s: the checker has nothing against it, with the cell around it", (_, taught) => {
  const { verdict } = checkProgram(taught, robot, { cell: geometry });
  expect(
    verdict.steps
      .filter(step => step.verdict !== "ok")
      .map(step => [step.id, step.verdict, step.findings.map(finding => finding.sentence)]),
  ).toEqual([]);
  expect(verdict.ok).toBe(true);
});

describe.each(dialectsFor(robot).map(dialect => [dialect.name, dialect] as const))("exported in %s", (_, dialect) => {
  test.each([
    ["poses", program],
    ["joint angles", recorded],
  ])("taught as %s: the text, executed, is the program", (_, taught) => {
    const emitted = dialect.emit(taught, robot, worldFromBase);
    expect(emitted.kind).toBe("emitted");
    if (emitted.kind !== "emitted") return;
    const proof = proveText(dialect, emitted.files[0]!, taught, robot, worldFromBase);
    expect(proof.kind, proof.sentence).toBe("proven");
  });
});

test("N-53 N-58 the motions of the executed V+ text stay on the four edges with the tool at 45°, and touch nothing", () => {
  const emitted = vPlus.emit(program, robot, worldFromBase);
  if (emitted.kind !== "emitted") throw new Error(emitted.sentence);
  const [file] = emitted.files;
  const interpreted = vPlus.interpret(file!.text, robot, worldFromBase);
  if (interpreted.kind !== "ready") throw new Error(JSON.stringify(interpreted.faults));
  const steps: Step[] = [];
  const run = interpreted.run();
  for (let next = run.next(); next.done !== true; next = run.next())
    if (next.value.step !== undefined) steps.push({ ...next.value.step, id: file!.lines[next.value.line - 1]! });
  const executed: Program = { ...program, ...interpreted.context, steps, groups: {} };
  const answer = planProgram(executed, robot, { worldFromBase });
  expect(answer.kind).toBe("planned");

  const corners: Vector3[] = [
    [0.45, -0.2, 0.5],
    [0.75, -0.2, 0.5],
    [0.75, 0.2, 0.5],
    [0.45, 0.2, 0.5],
  ];
  const collider = new CellCollider(geometry, robot.arm);
  const q = new Float64Array(6);
  const traced = program.steps.filter(
    (step): step is MoveStep => step.type === "move" && step.name?.endsWith("edge, end") === true,
  );
  expect(traced).toHaveLength(4);
  for (const [edge, { id }] of traced.entries()) {
    const segments = answer.plan.segments.filter(segment => segment.step === id);
    const begin_s = segments[0]!.start_s;
    const end_s = segments.at(-1)!.start_s + segments.at(-1)!.duration_s;
    for (let k = 0; k <= 200; k++) {
      samplePlan(answer.plan, begin_s + ((end_s - begin_s) * k) / 200, q);
      const worldFromTcp = compose(compose(worldFromBase, flangePose(robot.arm, q)), cell.tools[0]!.flangeFromTcp);
      const off = distanceToSegment(worldFromTcp.position, corners[edge]!, corners[(edge + 1) % 4]!);
      expect(off, `edge ${edge + 1}, sample ${k}`).toBeLessThan(k === 0 || k === 200 ? TARGET_M : PATH_M);
      const axis = rotate(worldFromTcp.quaternion, [0, 0, 1]);
      expect(Math.abs(degrees(Math.asin(-axis[2])) - 45)).toBeLessThan(TILT_DEG);
      expect(collider.collides(q)).toBe(false);
    }
  }
});

function distanceToSegment(p: Vector3, a: Vector3, b: Vector3): number {
  const along = [0, 1, 2].map(i => b[i]! - a[i]!);
  const to = [0, 1, 2].map(i => p[i]! - a[i]!);
  const dot = (u: number[], v: number[]): number => u[0]! * v[0]! + u[1]! * v[1]! + u[2]! * v[2]!;
  const t = Math.max(0, Math.min(1, dot(along, to) / dot(along, along)));
  return Math.hypot(...along.map((d, i) => to[i]! - d * t));
}
