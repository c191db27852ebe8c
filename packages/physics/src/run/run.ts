import {
  liftRefusal,
  Stepper,
  unrolled,
  withBranches,
  type DynamicsCommand,
  type GraspSignal,
  type Program,
  type Refusal,
} from "@twincell/core";
import type { MujocoWorld } from "../world.ts";
import type { PhysicsEvent } from "./events.ts";
import { SafetyWatch } from "./watch.ts";

export interface PhysicsRunOptions {
  /** Share of the programmed speed, 0 … 1; 1 when left out. */
  readonly override?: number;
  /** Called with everything that happens. */
  readonly onEvent?: (event: PhysicsEvent) => void;
  /** What the robot cannot carry is lifted all the same, to see what happens. */
  readonly liftAnything?: boolean;
}

/** How a run stands after a step. Lent. */
export interface PhysicsRunState {
  kind: "running" | "done" | "paused";
  /** Id of the step being executed, or "". */
  step: string;
  gripperClosed: boolean;
  /** What the program last said, or "". */
  message: string;
  why: Refusal | undefined;
}

/** Time the fingers have to come to rest on a part after their way [s]. */
const SETTLE_S = 0.15;

/**
 * Executes a program in a physical cell (row X-36): the stepper says where the arm is to be, the world what comes of
 * it. Sensors of the cell are the inputs of the program, its outputs run the belts.
 */
export class PhysicsRun {
  readonly world: MujocoWorld;
  readonly state: PhysicsRunState = { kind: "running", step: "", gripperClosed: false, message: "", why: undefined };
  readonly watch: SafetyWatch;
  /** Share of the programmed speed that is asked for; may be changed at any time. */
  override: number;
  private readonly stepper: Stepper;
  private readonly options: PhysicsRunOptions;
  private readonly q: Float64Array;
  private readonly qd: Float64Array;
  private readonly qdd: Float64Array;
  private readonly grasp: GraspSignal[];
  private readonly before: Float64Array;
  private readonly command: DynamicsCommand & { gripperClosed: boolean };
  private readonly h: number;

  constructor(world: MujocoWorld, program: Program, options: PhysicsRunOptions = {}) {
    const { scene, step_s } = world;
    const { robot, worldFromBase, gripper } = scene;
    this.world = world;
    this.options = options;
    this.override = options.override ?? 1;
    const settled = withBranches(program, robot, { where: "needed", worldFromBase, start_rad: world.state.q_rad });
    const n = scene.q_rad.length;
    this.stepper = new Stepper(
      robot,
      { tools: settled.tools, frames: settled.frames, worldFromBase },
      unrolled(settled, world.signals),
      world.state.q_rad,
      {
        signals: world.signals,
        ...(gripper === undefined
          ? {}
          : { gripper_s: (gripper.open_m - gripper.closed_m) / 2 / gripper.speed_mps + SETTLE_S }),
      },
    );
    this.watch = new SafetyWatch(scene);
    this.q = Float64Array.from(world.state.q_rad);
    this.qd = new Float64Array(n);
    this.qdd = new Float64Array(n);
    this.grasp = [...world.state.grasp];
    this.before = this.q.slice();
    this.command = { q_rad: this.q, qd_rad_s: this.qd, qdd_rad_s2: this.qdd, gripperClosed: false };
    this.h = step_s;
  }

  /** Where the arm was last told to be [rad]. Lent. */
  get commanded_rad(): Float64Array {
    return this.q;
  }

  /** One step of the world. */
  advance(): PhysicsRunState {
    const { state, world, stepper, q, qd, qdd, h } = this;
    if (state.kind === "paused") return state;
    const allowed = this.watch.look(world, event => {
      this.log(event);
    });
    const before = this.before;
    before.set(q);
    const said = stepper.advance(h, Math.min(this.override, allowed), q);
    for (let j = 0; j < q.length; j++) {
      const speed = (q[j]! - before[j]!) / h;
      qdd[j] = (speed - qd[j]!) / h;
      qd[j] = speed;
    }
    state.step = said.step;
    state.gripperClosed = said.gripperClosed;
    state.message = said.message;
    this.command.gripperClosed = said.gripperClosed;
    const outcome = world.step(this.command);
    if (outcome.kind === "paused") return this.pause(outcome.why);
    this.followGrasp(said.gripperClosed);
    if (said.kind === "fault" && said.fault)
      return this.pause({ code: said.fault.code, sentence: said.fault.sentence, hint: said.fault.hint });
    if (said.kind === "done" && state.kind === "running") {
      state.kind = "done";
      this.log({ at_s: world.state.time_s, kind: "done", sentence: "The program has come to its end." });
    }
    return state;
  }

  /** Runs until the program is done or paused, or for so long; returns how it stands. */
  runFor(most_s: number): PhysicsRunState {
    for (let i = Math.ceil(most_s / this.h); i > 0 && this.state.kind === "running"; i--) this.advance();
    return this.state;
  }

  private followGrasp(closed: boolean): void {
    const { world, grasp } = this;
    const at_s = world.state.time_s;
    for (let i = 0; i < grasp.length; i++) {
      const now = world.state.grasp[i]!;
      const was = grasp[i]!;
      if (now === was) continue;
      grasp[i] = now;
      const { id, name } = world.partObjects[i]!;
      this.log({
        at_s,
        kind: "grasp",
        part: id,
        signal: now,
        sentence:
          now === "free"
            ? `Nothing touches “${name}”.`
            : now === "ready"
              ? `The fingers touch “${name}”.`
              : `“${name}” is held.`,
      });
      if (now === "held") this.weigh(i);
      else if (was === "held" && closed)
        this.log({ at_s, kind: "dropped", part: id, sentence: `“${name}” slipped out of the fingers.` });
    }
  }

  /** Row X-55, then row X-07: weighed while it still stands on the table. */
  private weigh(i: number): void {
    const { world } = this;
    const { scene } = world;
    const { id, name } = world.partObjects[i]!;
    const mass_kg = world.masses_kg[i]!;
    this.log({
      at_s: world.state.time_s,
      kind: "weighed",
      part: id,
      mass_kg,
      sentence: `“${name}” weighs ${Number(mass_kg.toFixed(3))} kg.`,
    });
    const why = liftRefusal(
      scene.robot,
      { name, mass_kg },
      (scene.gripper?.mass_kg ?? 0) + (scene.payload?.mass_kg ?? 0),
    );
    if (why && this.options.liftAnything !== true) this.pause(why);
  }

  private pause(why: Refusal): PhysicsRunState {
    const { state } = this;
    state.kind = "paused";
    state.why = why;
    this.log({ at_s: this.world.state.time_s, kind: "paused", why, sentence: `${why.sentence} ${why.hint}` });
    return state;
  }

  private log(event: PhysicsEvent): void {
    this.options.onEvent?.(event);
  }
}
