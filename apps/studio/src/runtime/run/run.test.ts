import { compose, flangePose, manualScheduler, robotById, withBranches, type Pose, type Program } from "@twincell/core";
import { vPlus } from "@twincell/languages";
import { tracedCartonCell } from "@twincell/project";
import { openRecording } from "@twincell/recording";
import { expect, test } from "vitest";
import { controlStore } from "../../stores/control.ts";
import { historyStore } from "../../stores/history.ts";
import { listRuns, runBlob, type RunStorage } from "../history/archive.ts";
import { showJoints, theLive } from "../live.ts";
import { controlCell, prepareRun } from "./run.ts";
import { writeProgram, type Written } from "./written-program.ts";

const robot = robotById("staubli_rx90l")!;
const cell = tracedCartonCell();
const program = cell.programs[0]!;
const worldFromBase = cell.robot.worldFromBase;
const flangeFromTcp = cell.tools[0]!.flangeFromTcp;

function memoryRunStorage(): RunStorage {
  const kept = new Map<string, unknown>();
  return {
    async set(key, value) {
      kept.set(key, structuredClone(value));
    },
    async get(key) {
      return kept.get(key);
    },
    async keys() {
      return [...kept.keys()];
    },
    async remove(keys) {
      for (const key of keys) kept.delete(key);
    },
  };
}
function bench(isSafe?: (q: Float64Array) => boolean) {
  const scheduler = manualScheduler();
  const runStorage = memoryRunStorage();
  showJoints(robot.home_rad);
  const control = controlCell(
    {
      dialect: () => vPlus,
      write: async wanted => writeProgram(vPlus, wanted, robot, worldFromBase),
      scheduler,
      shelf: runStorage,
      clock_ms: () => 1_700_000_000_000 + scheduler.now_s() * 1000,
    },
    { robot, worldFromBase, flangeFromTcp, ...(isSafe ? { isSafe } : {}) },
  );
  return { scheduler, shelf: runStorage, control };
}

test("T-23 T-25 the exported text runs to its end, the twin within 0.001°, and the run is recorded", async () => {
  const { scheduler, shelf: runStorage, control } = bench();
  const outcome = control.run(program, cell.name);
  expect(controlStore.getState().running).toBe(true);
  await scheduler.elapse(5);
  expect(controlStore.getState().line).toBeGreaterThan(0);
  expect([...theLive().q_rad]).toEqual([...control.twin.jointAngles()]);
  await scheduler.elapse(120);
  expect(await outcome).toEqual({ kind: "done" });
  expect(controlStore.getState()).toMatchObject({ running: false });
  expect((controlStore.getState().twinError_rad * 180) / Math.PI).toBeLessThan(0.001);
  const [run] = await listRuns(runStorage);
  expect(run).toMatchObject({ ending: "done", name: `${cell.name} · ${program.name}` });
  expect(historyStore.getState().runs.map(({ id }) => id)).toEqual([run!.id]);
  const opened = openRecording(new Uint8Array(await (await runBlob(runStorage, run!.id)).arrayBuffer()), { scheduler });
  expect(opened.kind).toBe("recording");
  if (opened.kind !== "recording") return;
  expect(opened.recording.duration_s).toBeGreaterThan(5);
  expect(opened.recording.events.map(({ kind }) => kind)).toEqual(["run", "done"]);
  control.close();
}, 60_000);

test("lines of the text keep the ids of the program's steps", () => {
  const lines = new Map<string, number>();
  const prepared = prepareRun(
    vPlus,
    writeProgram(vPlus, program, robot, worldFromBase),
    { robot, worldFromBase },
    (step, line) => lines.set(step, line),
  );
  if (prepared.kind !== "ready") throw new Error(prepared.sentence);
  expect([...prepared.steps()].map(step => step.id)).toEqual(program.steps.map(step => step.id));
  expect([...lines.keys()]).toEqual(program.steps.map(step => step.id));
});

test("stop ends the run on its path, says so, and nothing goes on by itself", async () => {
  const { scheduler, shelf: runStorage, control } = bench();
  const outcome = control.run(program, cell.name);
  await scheduler.elapse(3);
  control.stop();
  await scheduler.elapse(2);
  expect(await outcome).toMatchObject({ kind: "stopped" });
  const standing = [...theLive().q_rad];
  await scheduler.elapse(5);
  expect([...theLive().q_rad]).toEqual(standing);
  expect(await listRuns(runStorage)).toMatchObject([{ ending: "stopped" }]);
  control.close();
});

test("T-10 an emergency stop refuses runs until reset", async () => {
  const { scheduler, control } = bench();
  control.stop(true);
  await scheduler.elapse(1);
  expect(await control.run(program, cell.name)).toMatchObject({ kind: "refused" });
  expect(controlStore.getState().safety).toBe("emergency-stop");
  expect((await control.reset()).kind).toBe("done");
  await scheduler.elapse(0.02);
  const again = control.run(program, cell.name);
  await scheduler.elapse(3);
  expect(controlStore.getState()).toMatchObject({ running: true, safety: "normal" });
  control.stop();
  await scheduler.elapse(1);
  await again;
  control.close();
});

test("T-43 the guard stops before contact and leads back to where it was safe", async () => {
  const wall_rad = robot.home_rad[1]! + 0.4;
  let nearest_rad = -Infinity;
  const { scheduler, control } = bench(q => q[1]! < wall_rad);
  const outcome = control.run(program, cell.name);
  for (let t_s = 0; t_s < 10; t_s += 0.01) {
    await scheduler.elapse(0.01);
    nearest_rad = Math.max(nearest_rad, control.twin.jointAngle(2));
  }
  expect(await outcome).toMatchObject({ kind: "stopped" });
  // It never was at the wall, came near it, and stands further away now than where it was stopped.
  expect(nearest_rad).toBeLessThan(wall_rad);
  expect(nearest_rad).toBeGreaterThan(robot.home_rad[1]!);
  expect(control.twin.jointAngle(2)).toBeLessThan(nearest_rad - 1e-6);
  control.close();
});

test("override 0 holds the robot and more lets it go on", async () => {
  const { scheduler, control } = bench();
  const outcome = control.run(program, cell.name);
  await scheduler.elapse(2);
  control.setOverride(0);
  await scheduler.elapse(1);
  const held = [...theLive().q_rad];
  await scheduler.elapse(3);
  expect([...theLive().q_rad]).toEqual(held);
  control.setOverride(1);
  await scheduler.elapse(120);
  expect(await outcome).toEqual({ kind: "done" });
  control.close();
}, 60_000);

test("a robot that no language speaks for runs the steps themselves, to the same end", async () => {
  const scheduler = manualScheduler();
  const runStorage = memoryRunStorage();
  showJoints(robot.home_rad);
  const control = controlCell(
    {
      dialect: () => null,
      write: async wanted => writeProgram(null, wanted, robot, worldFromBase),
      scheduler,
      shelf: runStorage,
      clock_ms: () => 1_700_000_000_000,
    },
    { robot, worldFromBase, flangeFromTcp },
  );
  const outcome = control.run(program, cell.name);
  await scheduler.elapse(3);
  expect(controlStore.getState()).toMatchObject({ running: true, line: 0 });
  await scheduler.elapse(120);
  expect(await outcome).toEqual({ kind: "done" });
  control.close();
}, 60_000);

test("an input switched by hand lets a program go on; outputs are told as the controller says them", async () => {
  const { scheduler, control } = bench();
  const waiting: Program = {
    ...program,
    signals: { part: { kind: "digital-in", address: 1001 }, lamp: { kind: "digital-out", address: 1 } },
    steps: [
      { id: "i", type: "wait-for", when: { signal: "part", is: true } },
      { id: "o", type: "set", signal: "lamp", to: true },
      { id: "w", type: "wait", s: 0.5 },
    ],
  };
  const outcome = control.run(waiting, cell.name);
  await scheduler.elapse(2);
  expect(controlStore.getState().signals.get("lamp")).toBeUndefined();
  control.setInput("part", true);
  await scheduler.elapse(2);
  expect(await outcome).toEqual({ kind: "done" });
  expect(controlStore.getState().signals.get("part")).toBe(true);
  expect(controlStore.getState().signals.get("lamp")).toBe(true);
  control.close();
});

test("a straight move that the nearest posture does not lead to runs as it was checked", async () => {
  const { scheduler, control } = bench();
  const from = [-0.96, -1.27, 1.08, 0.92, 0.3, -0.24];
  const to = [-0.58, -1.58, 1.09, 0.39, 0.32, -0.75];
  const target = (q: readonly number[]) => ({
    pose: compose(worldFromBase, flangePose(robot.arm, q)) as Pose as Pose<"frame", "tcp">,
    frame: "world",
    tool: "flange",
  });
  const rescued: Program = {
    ...program,
    steps: [
      { id: "a", type: "move", path: "ptp", target: target(from), speed: { ratio: 1 }, blend_m: 0 },
      { id: "b", type: "move", path: "lin", target: target(to), speed: { mps: 0.3 }, blend_m: 0 },
    ],
  };
  expect(withBranches(rescued, robot, { where: "needed", worldFromBase })).not.toBe(rescued);
  const outcome = control.run(rescued, cell.name);
  await scheduler.elapse(30);
  expect(await outcome).toEqual({ kind: "done" });
  expect(flangePose(robot.arm, theLive().q_rad).position[0]).toBeCloseTo(flangePose(robot.arm, to).position[0], 4);
  control.close();
});

test("who presses stop while the text is being written has stopped the run, and a second one begins none beside it", async () => {
  const scheduler = manualScheduler();
  let answer: (written: Written) => void = () => undefined;
  showJoints(robot.home_rad);
  const control = controlCell(
    {
      dialect: () => vPlus,
      write: () =>
        new Promise(resolve => {
          answer = resolve;
        }),
      scheduler,
      shelf: memoryRunStorage(),
      clock_ms: () => 0,
    },
    { robot, worldFromBase, flangeFromTcp },
  );
  const outcome = control.run(program, cell.name);
  expect(controlStore.getState().running).toBe(true);
  expect(await control.run(program, cell.name)).toMatchObject({ kind: "refused", why: { code: "run.under-way" } });
  control.stop();
  answer(writeProgram(vPlus, program, robot, worldFromBase));
  await scheduler.elapse(1);
  expect(await outcome).toMatchObject({ kind: "stopped", why: { code: "run.stopped" } });
  expect(controlStore.getState().running).toBe(false);
  expect([...theLive().q_rad]).toEqual([...robot.home_rad]);
  control.close();
});
