import type { PhysicalScene, Program } from "@twincell/core";
import { MUJOCO_VERSION, type Engine } from "../engine.ts";
import { PhysicsRun } from "../run/run.ts";
import { StateLog } from "../run/state-log.ts";
import { createWorld } from "../world.ts";
import { observe, shuffled, type Action, type Observation } from "./environment.ts";

/** First line of a dataset: what its lists count, in which units. docs/dataset.md says it to people. */
export interface DatasetHeader {
  readonly format: "twincell.dataset";
  readonly version: 1;
  readonly robot: string;
  readonly joints: readonly string[];
  readonly parts: readonly { readonly id: string; readonly name: string; readonly mass_kg: number }[];
  readonly program: string;
  readonly period_s: number;
  readonly episodes: number;
  readonly seed: number;
  readonly engine: string;
  readonly units: "m, rad, s, kg; quaternions x y z w; poses in the world";
}
/** What was seen at t, and what the arm was then told for the following period. */
export interface DatasetSample {
  readonly episode: number;
  readonly observation: Observation;
  readonly action: Action;
  readonly step: string;
}
/** Last line of an episode: how it ended, and the hash of all its states. */
export interface DatasetEnd {
  readonly episode: number;
  readonly end: "done" | "paused" | "time" | "refused";
  readonly seed: number;
  readonly t: number;
  readonly hash: string;
  readonly why?: string;
  readonly observation?: Observation;
}
export type DatasetLine = DatasetHeader | DatasetSample | DatasetEnd;

export interface DatasetOptions {
  readonly episodes: number;
  /** Episode i starts from seed + i. */
  readonly seed: number;
  readonly period_s?: number;
  readonly most_s?: number;
  readonly jitter_m?: number;
  readonly turn_rad?: number;
}

/**
 * Demonstrations for learning (row X-44): a program carried out again and again from starts that differ, line by line.
 */
export function* datasetLines(
  engine: Engine,
  scene: PhysicalScene,
  program: Program,
  { episodes, seed, period_s = 0.04, most_s = 300, jitter_m = 0, turn_rad = 0 }: DatasetOptions,
): Generator<DatasetLine, void> {
  const step_s = scene.step_s ?? 0.002;
  const every = Math.max(1, Math.round(period_s / step_s));
  let header = false;
  for (let episode = 0; episode < episodes; episode++) {
    const answer = createWorld(engine, shuffled(scene, seed + episode, jitter_m, turn_rad));
    if (answer.kind === "refused") {
      yield {
        episode,
        end: "refused",
        seed: seed + episode,
        t: 0,
        hash: new StateLog().hash,
        why: answer.why.sentence,
      };
      continue;
    }
    const { world } = answer;
    if (!header) {
      header = true;
      yield {
        format: "twincell.dataset",
        version: 1,
        robot: scene.robot.id,
        joints: scene.robot.arm.joints.map(({ name }) => name),
        parts: world.partObjects.map(({ id, name }, i) => ({ id, name, mass_kg: world.masses_kg[i]! })),
        program: program.name,
        period_s: every * step_s,
        episodes,
        seed,
        engine: `mujoco ${MUJOCO_VERSION}`,
        units: "m, rad, s, kg; quaternions x y z w; poses in the world",
      };
    }
    const run = new PhysicsRun(world, program);
    const log = new StateLog();
    try {
      while (run.state.kind === "running" && world.state.time_s < most_s) {
        const observation = observe(world);
        for (let k = 0; k < every && run.state.kind === "running"; k++) {
          run.advance();
          log.add(world.coordinates.qpos);
          log.add(world.coordinates.qvel);
        }
        yield {
          episode,
          observation,
          action: { q: Array.from(run.commanded_rad), gripper: run.state.gripperClosed },
          step: run.state.step,
        };
      }
      yield {
        episode,
        end: run.state.kind === "running" ? "time" : run.state.kind,
        seed: seed + episode,
        t: world.state.time_s,
        hash: log.hash,
        ...(run.state.why ? { why: run.state.why.sentence } : {}),
        observation: observe(world),
      };
    } finally {
      world.close();
    }
  }
}
