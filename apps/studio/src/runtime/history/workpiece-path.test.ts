import {
  checkProgram,
  compose,
  distance,
  flangePose,
  linkSolids,
  robotById,
  samplePlan,
  type Pose,
  type Vector3,
} from "@twincell/core";
import { cellGeometry, pickAndPlaceCell, selectedProgram } from "@twincell/project";
import { expect, test } from "vitest";
import { carriedPose } from "./carried.ts";
import { pathLength, pathText, workPiecePath } from "./workpiece-path.ts";

const cell = pickAndPlaceCell();
const robot = robotById(cell.robot.id)!;
const program = selectedProgram(cell)!;

test("M-66 the complete path of a work piece is where the program has it, every 10 ms from its place to where it is put", () => {
  const { carried, plan } = checkProgram(program, robot, { cell: cellGeometry(cell, linkSolids(robot)) });
  const [first] = carried;
  if (!first) throw new Error("The example takes no part.");
  const moments = workPiecePath(carried, first.id, plan, robot, cell.robot.worldFromBase);
  const start = cell.objects.find(({ id }) => id === first.id)!.worldFromObject.position;
  expect(distance([...moments[0]!.at_m] as Vector3, [...start] as Vector3)).toBeLessThan(1e-9);
  const q = new Float64Array(robot.arm.joints.length);
  for (const { t_s, at_m } of moments.slice(1, -1)) {
    samplePlan(plan, t_s, q);
    const flange = compose(cell.robot.worldFromBase, flangePose(robot.arm, q));
    const at = carriedPose(carried, first.id, t_s, flange, { position: [0, 0, 0], quaternion: [0, 0, 0, 1] });
    expect(distance([...at!.position] as Vector3, [...at_m] as Vector3)).toBeLessThan(1e-12);
  }
  // No gap: the next moment is never farther than the flange goes in 10 ms.
  for (const [i, { at_m, t_s }] of moments.entries()) {
    if (i === 0) continue;
    expect(t_s - moments[i - 1]!.t_s).toBeLessThanOrEqual(0.01 + 1e-9);
    expect(distance([...at_m] as Vector3, [...moments[i - 1]!.at_m] as Vector3)).toBeLessThan(0.03);
  }
  const put = first.put!.worldFromObject as Pose;
  expect(moments.at(-1)!.at_m).toEqual([...put.position]);
  expect(pathLength(moments)).toBeGreaterThan(distance([...start] as Vector3, [...put.position] as Vector3));
  expect(pathText(moments).split("\n")).toHaveLength(moments.length + 1);
  expect(workPiecePath(carried, "nothing", plan, robot, cell.robot.worldFromBase)).toEqual([]);
});
