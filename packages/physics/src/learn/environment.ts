import {
  fromAxisAngle,
  multiply,
  SignalTable,
  seededRandom,
  type PhysicalObject,
  type PhysicalScene,
  type Refusal,
  type Signals,
} from "@twincell/core";
import type { Engine } from "../engine.ts";
import { createWorld, type MujocoWorld } from "../world.ts";

/** What a learner sees. Plain lists: it goes into a file or over a socket as it is. */
export interface Observation {
  readonly t: number;
  readonly q: readonly number[];
  readonly qd: readonly number[];
  /** Between the fingers [m]. */
  readonly opening: number;
  /** Seven numbers of each part: x y z [m], quaternion x y z w. */
  readonly parts: readonly (readonly number[])[];
  readonly grasp: readonly string[];
  readonly signals: Readonly<Record<string, boolean | number>>;
}

/**
 * Joint targets for the next period [rad], and the gripper. Targets beyond limits or speeds are brought back within
 * them.
 */
export interface Action {
  readonly q: readonly number[];
  readonly gripper: boolean;
}

export interface Transition {
  readonly observation: Observation;
  readonly reward: number;
  /** The task is over: `reward` said so, or the cell was paused. */
  readonly terminated: boolean;
  /** Time is over. */
  readonly truncated: boolean;
  readonly why?: Refusal;
}

export interface EnvironmentOptions {
  /** From one action to the next [s]. */
  readonly period_s?: number;
  /** An episode is at most this long [s]. */
  readonly most_s?: number;
  /** Parts start up to this far from where the scene has them, and turned by up to `turn_rad`. */
  readonly jitter_m?: number;
  readonly turn_rad?: number;
  /** What is wanted. Left out, the reward is 0 and the episode ends with its time. */
  readonly task?: (observation: Observation) => { readonly reward: number; readonly done: boolean };
}

export type Started =
  | { readonly kind: "started"; readonly observation: Observation }
  | { readonly kind: "refused"; readonly why: Refusal };

/** The scene with its parts moved and turned at random: the same seed, the same start. */
export function shuffled(scene: PhysicalScene, seed: number, jitter_m: number, turn_rad: number): PhysicalScene {
  const random = seededRandom(seed);
  const some = (scale: number): number => (2 * random() - 1) * scale;
  const moved = (object: PhysicalObject): PhysicalObject => {
    if (object.role !== "part") return object;
    const {
      position: [x, y, z],
      quaternion,
    } = object.worldFromObject;
    const dx = some(jitter_m);
    const dy = some(jitter_m);
    return {
      ...object,
      worldFromObject: {
        position: [x + dx, y + dy, z],
        quaternion: multiply(fromAxisAngle([0, 0, 1], some(turn_rad)), quaternion),
      },
    };
  };
  return jitter_m === 0 && turn_rad === 0 ? scene : { ...scene, objects: scene.objects.map(moved) };
}

/** What there is to see now. */
export function observe({
  state,
  signals,
}: {
  readonly state: MujocoWorld["state"];
  readonly signals: Signals;
}): Observation {
  return {
    t: state.time_s,
    q: Array.from(state.q_rad),
    qd: Array.from(state.qd_rad_s),
    opening: state.opening_m,
    parts: Array.from({ length: state.parts.length / 7 }, (_, i) => Array.from(state.parts.subarray(7 * i, 7 * i + 7))),
    grasp: [...state.grasp],
    signals: signals instanceof SignalTable ? Object.fromEntries(signals.all) : {},
  };
}

/**
 * A cell to learn in (row X-44), without a screen and without a clock: `reset` with a seed, then `step` after `step`,
 * as reinforcement learning writes it. The same seed and actions give the same observations to the last bit.
 */
export class LearningEnvironment {
  readonly period_s: number;
  private readonly engine: Engine;
  private readonly scene: PhysicalScene;
  private readonly options: EnvironmentOptions;
  private readonly steps: number;
  private world: MujocoWorld | undefined;
  private readonly q: Float64Array;
  private readonly qd: Float64Array;
  private readonly qdd: Float64Array;

  constructor(engine: Engine, scene: PhysicalScene, options: EnvironmentOptions = {}) {
    const step_s = scene.step_s ?? 0.002;
    const n = scene.q_rad.length;
    this.engine = engine;
    this.scene = scene;
    this.options = options;
    this.steps = Math.max(1, Math.round((options.period_s ?? 0.04) / step_s));
    this.period_s = this.steps * step_s;
    this.q = new Float64Array(n);
    this.qd = new Float64Array(n);
    this.qdd = new Float64Array(n);
  }

  reset(seed: number): Started {
    this.close();
    const { jitter_m = 0, turn_rad = 0 } = this.options;
    const answer = createWorld(this.engine, shuffled(this.scene, seed, jitter_m, turn_rad));
    if (answer.kind === "refused") return answer;
    this.world = answer.world;
    this.q.set(this.scene.q_rad);
    this.qd.fill(0);
    return { kind: "started", observation: observe(answer.world) };
  }

  /** @returns undefined before the first `reset`. */
  step(action: Action): Transition | undefined {
    const { world, q, qd, qdd, steps } = this;
    if (world === undefined) return undefined;
    const { joints } = world.scene.robot.arm;
    const h = world.step_s;
    const command = { q_rad: q, qd_rad_s: qd, qdd_rad_s2: qdd, gripperClosed: action.gripper };
    for (let k = 0; k < steps; k++) {
      for (let j = 0; j < q.length; j++) {
        // Speed and acceleration stay within the limits of the joint, whatever is asked for.
        const { limits } = joints[j]!;
        const wanted = Math.max(limits.lower_rad, Math.min(limits.upper_rad, action.q[j] ?? q[j]!));
        const most = limits.speed_rad_s;
        const reach = limits.acceleration_rad_s2 * h;
        const left = wanted - q[j]!;
        const brake = Math.sqrt(2 * limits.acceleration_rad_s2 * Math.abs(left));
        const aim = Math.sign(left) * Math.min(most, brake, Math.abs(left) / h);
        const speed = qd[j]! + Math.max(-reach, Math.min(reach, aim - qd[j]!));
        qdd[j] = (speed - qd[j]!) / h;
        qd[j] = speed;
        q[j]! += speed * h;
      }
      const outcome = world.step(command);
      if (outcome.kind === "paused")
        return { observation: observe(world), reward: 0, terminated: true, truncated: false, why: outcome.why };
    }
    const observation = observe(world);
    const { reward, done } = this.options.task?.(observation) ?? { reward: 0, done: false };
    return { observation, reward, terminated: done, truncated: observation.t >= (this.options.most_s ?? 60) };
  }

  close(): void {
    this.world?.close();
    this.world = undefined;
  }
}
