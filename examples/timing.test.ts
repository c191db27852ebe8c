/** What the plan promises and what the exported text does on the virtual controller: where it ends, and when. */
import { createVirtualController, textSteps } from "@twincell/controllers";
import {
  compose,
  distance,
  emptyProgram,
  flangePose,
  insertSteps,
  manualScheduler,
  planProgram,
  robotById,
  type CommandOutcome,
  type MoveStep,
  type Program,
} from "@twincell/core";
import { vPlus } from "@twincell/languages";
import { recordedAsJoints, tracedCartonCell } from "@twincell/project";
import { describe, expect, test } from "vitest";

const cell = tracedCartonCell();
const traced = cell.programs[0]!;
const robot = robotById(cell.robot.id)!;
const { worldFromBase } = cell.robot;
const { flangeFromTcp } = cell.tools[0]!;
const rad = (...angles_deg: number[]): number[] => angles_deg.map(angle => (angle * Math.PI) / 180);
const move = (
  id: string,
  path: MoveStep["path"],
  q: readonly number[],
  speed: MoveStep["speed"],
  blend_m = 0,
): MoveStep => ({ id, type: "move", path, target: { q }, speed, blend_m });
const pick: Program = {
  ...emptyProgram(robot.id, "Pick"),
  steps: [
    move("over", "ptp", rad(20, -70, 110, 0, 50, 0), { ratio: 0.5 }, 0.02),
    move("beside", "ptp", rad(0, -60, 110, 0, 40, 0), { ratio: 0.5 }, 0.01),
    move("down", "lin", rad(0, -50, 115, 0, 25, 0), { mps: 0.1 }),
    { id: "wait", type: "wait", s: 0.4 },
    { id: "close", type: "gripper", closed: true },
    move("up", "lin", rad(0, -60, 110, 0, 40, 0), { mps: 0.2 }),
    move("away", "ptp", rad(-40, -80, 100, 10, 60, 0), { ratio: 1 }),
  ],
};
const slow: Program = {
  ...emptyProgram(robot.id, "Slow"),
  steps: [
    move("a", "ptp", rad(30, -60, 100, 20, 40, 10), { ratio: 0.05 }),
    move("b", "ptp", rad(-30, -70, 90, -20, 50, -10), { ratio: 0.1 }),
  ],
};
const programs: readonly Program[] = [traced, recordedAsJoints(cell, traced), pick, slow];

interface Executed {
  readonly outcome: CommandOutcome | null;
  readonly took_s: number;
  readonly q_rad: Float64Array;
  readonly steps: number;
  readonly said: Program;
}
/**
 * Exports the program, interprets that text and lets the virtual controller carry it out from home; time is the
 * controller's. `said` is what the text says: V+ has no blend radius.
 */
async function execute(program: Program): Promise<Executed> {
  const emitted = vPlus.emit(program, robot, worldFromBase);
  if (emitted.kind !== "emitted") throw new Error(emitted.sentence);
  const interpreted = vPlus.interpret(emitted.files[0]!.text, robot, worldFromBase);
  if (interpreted.kind !== "ready") throw new Error(JSON.stringify(interpreted.faults));
  const scheduler = manualScheduler();
  const controller = createVirtualController({ robot, scheduler, worldFromBase, start_rad: robot.home_rad });
  const steps = [...textSteps(interpreted.run).steps];
  let outcome: CommandOutcome | null = null;
  let took_s = 0;
  void controller.run(steps, interpreted.context).then(done => {
    outcome = done;
    took_s = scheduler.now_s();
  });
  for (let i = 0; i < 4000 && outcome === null; i++) await scheduler.elapse(0.05);
  const q_rad = Float64Array.from(controller.jointAngles());
  controller.close();
  return {
    outcome,
    took_s,
    q_rad,
    steps: steps.length,
    said: { ...program, ...interpreted.context, routines: {}, steps },
  };
}
function predicted(program: Program): { readonly duration_s: number; readonly end_rad: Float64Array } {
  const answer = planProgram(program, robot, { worldFromBase });
  if (answer.kind !== "planned") throw new Error(answer.stuck.sentence);
  const last = answer.plan.segments.at(-1)!;
  return { duration_s: answer.plan.duration_s, end_rad: last.q_rad.subarray(last.q_rad.length - 6) };
}

describe.each(programs.map(program => [program.name, program] as const))("%s", (_, program) => {
  test("N-62 the exported V+ text, carried out on the virtual controller, ends where the plan ends", async () => {
    const { outcome, q_rad, steps } = await execute(program);
    const { end_rad } = predicted(program);
    expect(outcome).toEqual({ kind: "done" });
    expect(steps).toBe(program.steps.length);
    const tcp = (q: Float64Array) => compose(flangePose(robot.arm, q), flangeFromTcp).position;
    expect(distance(tcp(q_rad), tcp(end_rad))).toBeLessThan(1e-5);
    for (let i = 0; i < 6; i++) expect(Math.abs(q_rad[i]! - end_rad[i]!)).toBeLessThan((0.001 * Math.PI) / 180);
  }, 60_000);

  test("N-64 the plan's cycle time is within 5 % of what the virtual controller takes to carry out the exported text", async () => {
    const { outcome, took_s, said } = await execute(program);
    const { duration_s } = predicted(said);
    expect(outcome).toEqual({ kind: "done" });
    expect(took_s).toBeGreaterThan(1);
    expect(Math.abs(duration_s / took_s - 1)).toBeLessThan(0.05);
  }, 60_000);
});

test("N-70 two tasks one after the other take the sum of their predicted times, and the controller agrees", async () => {
  const home = move("home", "ptp", robot.home_rad, { ratio: 0.5 });
  const first: Program = insertSteps(pick, pick.steps.length, [home]);
  const second = recordedAsJoints(cell, traced);
  const both: Program = {
    ...second,
    name: "Both",
    steps: [
      ...first.steps.map(step => ({ ...step, group: "pick" })),
      ...second.steps.map(step => ({ ...step, id: `t-${step.id}`, group: "trace" })),
    ],
    groups: { pick: { name: "Pick" }, trace: { name: "Trace" } },
  };
  const sum_s = predicted(first).duration_s + predicted(second).duration_s;
  const { duration_s } = predicted(both);
  expect(Math.abs(duration_s - sum_s)).toBeLessThan(0.02 * sum_s);
  const { outcome, took_s, said } = await execute(both);
  expect(outcome).toEqual({ kind: "done" });
  expect(Math.abs(predicted(said).duration_s / took_s - 1)).toBeLessThan(0.05);
}, 60_000);
