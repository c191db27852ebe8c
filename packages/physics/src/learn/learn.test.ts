import { describe, expect, test } from "vitest";
import { PARALLEL_GRIPPER, robotById, seededRandom } from "@twincell/core";
import {
  createWorld,
  datasetLines,
  LearningEnvironment,
  loadEngine,
  pickAndPlaceProgram,
  pickScene,
  PhysicsRun,
  StateLog,
  type DatasetEnd,
  type DatasetHeader,
  type DatasetSample,
  type Engine,
  type Observation,
} from "../index.ts";
import { engine } from "../testing/cells.ts";

const robot = robotById("ur10e")!;
const { scene, grip_m } = pickScene(
  { shape: "cylinder", width_m: 0.05, mass_kg: 1 },
  { robot, control: { kind: "computed-torque", bandwidth_rad_s: 60 } },
);
const program = pickAndPlaceProgram(robot, PARALLEL_GRIPPER, [0.65, -0.2, grip_m], [0.65, 0.25, grip_m], 0.6);

/** Hash of every state of the program, and the last of them. */
function logged(on: Engine, most_s = 20): { readonly hash: string; readonly last: readonly number[] } {
  const answer = createWorld(on, scene);
  const world = answer.kind === "ready" ? answer.world : expect.fail();
  const run = new PhysicsRun(world, program);
  const log = new StateLog();
  while (run.state.kind === "running" && world.state.time_s < most_s) {
    run.advance();
    log.add(world.coordinates.qpos);
    log.add(world.coordinates.qvel);
  }
  const last = [...world.coordinates.qpos];
  world.close();
  return { hash: log.hash, last };
}

describe("the same cell, program and engine", () => {
  test("give the same state log to the last bit, again and in a fresh engine", async () => {
    const first = logged(engine);
    expect(logged(engine)).toEqual(first);
    expect(logged(await loadEngine())).toEqual(first);
  });
  test("a world that was reset goes the same way as a fresh one", () => {
    const answer = createWorld(engine, scene);
    const world = answer.kind === "ready" ? answer.world : expect.fail();
    const hash = (): string => {
      const run = new PhysicsRun(world, program);
      const log = new StateLog();
      for (let i = 0; i < 1500; i++) {
        run.advance();
        log.add(world.coordinates.qpos);
      }
      return log.hash;
    };
    const first = hash();
    world.reset();
    expect(hash()).toBe(first);
    world.close();
  });
  test("one bit less in one number is another hash", () => {
    const one = new StateLog();
    const other = new StateLog();
    one.add([1, 2, 3]);
    other.add([1, 2, 3 - 4.5e-16]);
    expect(one.hash).not.toBe(other.hash);
    expect(one.hash).toMatch(/^[0-9a-f]{16}$/);
  });
});

describe("X-44 data and steps for learning", () => {
  const record = (seed: number): readonly object[] => [
    ...datasetLines(engine, scene, program, { episodes: 2, seed, jitter_m: 0.004, turn_rad: 0.1 }),
  ];
  test("X-44 a dataset says what it counts, then what was seen and done, then how each episode ended", () => {
    const lines = record(7);
    const [header] = lines as [DatasetHeader];
    expect(header).toMatchObject({
      format: "twincell.dataset",
      version: 1,
      robot: "ur10e",
      parts: [{ id: "part", mass_kg: 1 }],
      period_s: 0.04,
      seed: 7,
      engine: "mujoco 3.14.0",
    });
    const samples = lines.filter((line): line is DatasetSample => "action" in line);
    const ends = lines.filter((line): line is DatasetEnd => "end" in line);
    expect(ends.map(({ end, episode }) => [end, episode])).toEqual([
      ["done", 0],
      ["done", 1],
    ]);
    expect(ends[0]!.hash).not.toBe(ends[1]!.hash);
    for (const {
      observation: { q, qd, parts },
      action,
    } of samples) {
      expect([q.length, qd.length, action.q.length, parts[0]!.length]).toEqual([6, 6, 6, 7]);
      expect([...q, ...qd, ...parts[0]!, ...action.q].every(Number.isFinite)).toBe(true);
    }
    const held = samples.filter(({ observation }) => observation.grasp[0] === "held");
    const first = samples.filter(({ episode }) => episode === 0);
    expect(held.length).toBeGreaterThan(50);
    // What the arm was told is where it is one period later, as near as its drives follow.
    for (let i = 1; i < first.length; i++)
      for (let j = 0; j < 6; j++)
        expect(Math.abs(first[i]!.observation.q[j]! - first[i - 1]!.action.q[j]!)).toBeLessThan(0.05);
    expect(record(7)).toEqual(lines);
    expect(record(8)).not.toEqual(lines);
  });

  test("X-44 reset and step: the same seed and actions give the same observations, and no action breaks a limit", () => {
    const play = (seed: number): { readonly seen: readonly Observation[]; readonly reward: number } => {
      const environment = new LearningEnvironment(engine, scene, {
        jitter_m: 0.01,
        most_s: 2,
        task: ({ parts }) => ({ reward: parts[0]![2]!, done: false }),
      });
      const start = environment.reset(seed);
      const random = seededRandom(seed);
      const seen: Observation[] = start.kind === "started" ? [start.observation] : [];
      let reward = 0;
      for (let i = 0; i < 200; i++) {
        const said = environment.step({
          q: scene.q_rad.map(angle => angle + (2 * random() - 1) * (i % 10 === 0 ? 100 : 0.5)),
          gripper: random() < 0.5,
        });
        if (said === undefined) break;
        seen.push(said.observation);
        reward += said.reward;
        if (said.terminated || said.truncated) break;
      }
      environment.close();
      expect(environment.step({ q: [], gripper: false })).toBeUndefined();
      return { seen, reward };
    };
    const first = play(3);
    expect(play(3)).toEqual(first);
    expect(play(4).seen[0]!.parts).not.toEqual(first.seen[0]!.parts);
    expect(first.seen.length).toBeGreaterThan(10);
    expect(first.reward).toBeGreaterThan(0);
    for (const { qd } of first.seen)
      qd.forEach((speed, j) => {
        expect(Math.abs(speed)).toBeLessThan(1.25 * robot.arm.joints[j]!.limits.speed_rad_s);
      });
  });

  test("X-44 a start that cannot be simulated is said, not thrown", () => {
    const heavy = {
      ...scene,
      objects: scene.objects.map(object => (object.role === "part" ? { ...object, mass_kg: 0 } : object)),
    };
    expect(new LearningEnvironment(engine, heavy).reset(1)).toMatchObject({
      kind: "refused",
      why: { code: "physics.massless" },
    });
    expect([...datasetLines(engine, heavy, program, { episodes: 1, seed: 1 })]).toMatchObject([
      { end: "refused", why: expect.stringContaining("needs a mass") },
    ]);
  });
});
