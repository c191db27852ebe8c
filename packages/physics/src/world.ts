import {
  SignalTable,
  type Dynamics,
  type DynamicsCommand,
  type DynamicsOutcome,
  type PhysicalObject,
  type PhysicalScene,
  type Pose,
  type Refusal,
  type Signals,
} from "@twincell/core";
import { armMasses } from "./model/arm.ts";
import { assumptionsOf, judgeScene } from "./model/judge.ts";
import { partMass, sceneXml } from "./model/scene.ts";
import type { Engine, MjData, MjModel } from "./engine.ts";
import { armDriver, type ArmDriver } from "./arm-driver.ts";
import { Belts } from "./belts.ts";
import { deepestOverlap, OVERLAP_M } from "./contacts.ts";
import { Grasps } from "./grasps.ts";
import { People } from "./people.ts";
import { SensorBank } from "./sensors.ts";

export type WorldAnswer =
  | { readonly kind: "ready"; readonly world: MujocoWorld; readonly assumptions: readonly string[] }
  | { readonly kind: "refused"; readonly why: Refusal };

/** Faster than anything in a cell: a state that gets here is not one any more [m/s, rad/s]. */
const EXPLODED = 200;

/** How fast a finger comes to rest at its open end [1/s]. */
const OPENING_PER_S = 20;
/** A part pressed with more than this beside the grip itself is crushed, not gripped [N]. */
const CRUSHING_N = 1000;

/** Where the coordinates of a scene lie: arm, two fingers, belts, then seven (six for speeds) of each part. */
interface Layout {
  readonly joints: number;
  readonly fingers: number;
  readonly belts: number;
  readonly parts: number;
  readonly nq: number;
  readonly nv: number;
  readonly firstPartQ: number;
  readonly firstPartV: number;
}

function layoutOf({ robot, gripper, objects }: PhysicalScene): Layout {
  const joints = robot.arm.joints.length;
  const fingers = gripper === undefined ? 0 : 2;
  const belts = objects.filter(({ belt, role }) => belt !== undefined && role === "fixture").length;
  const parts = objects.filter(({ role }) => role === "part").length;
  const first = joints + fingers + belts;
  return {
    joints,
    fingers,
    belts,
    parts,
    nq: first + 7 * parts,
    nv: first + 6 * parts,
    firstPartQ: first,
    firstPartV: first,
  };
}

/**
 * A scene ready to be stepped, or the one sentence that says why it cannot be: a part without mass, solids inside one
 * another at the start, a number that is none (code "physics.…").
 */
export function createWorld(engine: Engine, scene: PhysicalScene, signals: Signals = new SignalTable()): WorldAnswer {
  const fault = judgeScene(scene);
  if (fault) return { kind: "refused", why: fault };
  const masses = scene.control.kind === "moved" ? undefined : armMasses(scene);
  if (masses?.kind === "unknown")
    return {
      kind: "refused",
      why: {
        code: "physics.masses",
        sentence: `${masses.sentence} Its drives cannot be simulated.`,
        hint: "Let the arm be moved as told instead of driven.",
      },
    };
  let model: MjModel;
  try {
    model = engine.MjModel.from_xml_string(sceneXml(scene, masses?.model));
  } catch (problem) {
    return {
      kind: "refused",
      why: {
        code: "physics.model",
        sentence:
          `The cell cannot be simulated: ${problem instanceof Error ? problem.message : String(problem)}.`.replace(
            /\n/g,
            " ",
          ),
        hint: "Look at the shapes and masses of the cell.",
      },
    };
  }
  const world = new MujocoWorld(engine, scene, signals, model, armDriver(scene, masses?.model));
  const overlap = deepestOverlap(engine, model, world.data, scene);
  if (overlap !== undefined && overlap.depth_m > OVERLAP_M) {
    world.close();
    return {
      kind: "refused",
      why: {
        code: "physics.overlap",
        value: overlap.depth_m,
        limit: OVERLAP_M,
        sentence: `“${overlap.a}” and “${overlap.b}” are ${(overlap.depth_m * 1000).toFixed(1)} mm inside one another at the start.`,
        hint: "Move one of them away; they may touch.",
      },
    };
  }
  return { kind: "ready", world, assumptions: assumptionsOf(scene, masses !== undefined) };
}

/** Core's `Dynamics` on MuJoCo. Not for sharing between threads; `close` gives its memory back. */
export class MujocoWorld implements Dynamics {
  readonly scene: PhysicalScene;
  readonly signals: Signals;
  readonly parts: readonly string[];
  readonly masses_kg: readonly number[];
  readonly partObjects: readonly PhysicalObject[];
  readonly step_s: number;
  readonly engine: Engine;
  readonly model: MjModel;
  readonly data: MjData;
  readonly state: {
    time_s: number;
    readonly q_rad: Float64Array;
    readonly qd_rad_s: Float64Array;
    readonly torque_Nm: Float64Array;
    opening_m: number;
    readonly parts: Float64Array;
    readonly grasp: Grasps["signals"];
  };
  readonly people: People;
  readonly grasps: Grasps;
  private readonly layout: Layout;
  private readonly driver: ArmDriver;
  private readonly belts: Belts;
  private readonly sensors: SensorBank;
  private readonly start: Float64Array;
  private readonly good: Float64Array;
  private outcome: DynamicsOutcome = { kind: "running" };
  private steps = 0;

  constructor(engine: Engine, scene: PhysicalScene, signals: Signals, model: MjModel, driver: ArmDriver) {
    const parts = scene.objects.filter(({ role }) => role === "part");
    const layout = layoutOf(scene);
    this.engine = engine;
    this.scene = scene;
    this.signals = signals;
    this.model = model;
    this.driver = driver;
    this.layout = layout;
    this.data = new engine.MjData(model);
    this.partObjects = parts;
    this.parts = parts.map(({ id }) => id);
    this.masses_kg = parts.map(partMass);
    this.step_s = model.opt.timestep;
    this.belts = new Belts(scene, signals);
    this.people = new People(scene);
    this.grasps = new Grasps(scene, parts.length);
    this.sensors = new SensorBank(engine, model, this.data, scene, signals);
    this.state = {
      time_s: 0,
      q_rad: new Float64Array(layout.joints),
      qd_rad_s: new Float64Array(layout.joints),
      torque_Nm: new Float64Array(layout.joints),
      opening_m: scene.gripper?.open_m ?? 0,
      parts: new Float64Array(7 * layout.parts),
      grasp: this.grasps.signals,
    };
    const qpos = this.data.qpos as Float64Array;
    for (let j = 0; j < layout.joints; j++) qpos[j] = scene.q_rad[j]!;
    this.start = qpos.slice();
    this.good = qpos.slice();
    this.settle();
  }

  /** One step of the integration. Once paused it stays so until `reset`. */
  step(command: DynamicsCommand): DynamicsOutcome {
    if (this.outcome.kind === "paused") return this.outcome;
    const { data, layout, state, driver, scene } = this;
    const { joints } = layout;
    const qpos = data.qpos as Float64Array;
    const qvel = data.qvel as Float64Array;
    for (let j = 0; j < joints; j++)
      if (!Number.isFinite(command.q_rad[j]! + command.qd_rad_s[j]! + command.qdd_rad_s2[j]!))
        return this.pause(
          "physics.number",
          `Joint ${j + 1} of ${scene.robot.name} is told to be at no number.`,
          "Look at the program.",
        );
    this.belts.drive(qpos, qvel, joints + layout.fingers, this.step_s);
    driver.drive(command, qpos, qvel, data.qfrc_applied as Float64Array, state.torque_Nm);
    if (layout.fingers > 0) {
      const { speed_mps } = scene.gripper!;
      const ctrl = data.ctrl as Float64Array;
      // Opening, a finger comes to rest before its stop; closing, it pushes on.
      for (let finger = 0; finger < 2; finger++)
        ctrl[finger] = command.gripperClosed
          ? speed_mps
          : -Math.min(speed_mps, OPENING_PER_S * Math.max(0, qpos[joints + finger]!));
    }
    this.people.place(state.time_s, data.mocap_pos as Float64Array, data.mocap_quat as Float64Array);
    this.engine.mj_step(this.model, data);
    this.steps++;
    if (driver.kind === "moved") driver.overwrite(command, data.qpos as Float64Array, data.qvel as Float64Array);
    const odd = this.odd();
    if (odd !== undefined) return this.explode(odd);
    this.read(command.gripperClosed);
    const crushed =
      scene.gripper === undefined ? -1 : this.grasps.pressedBeyond(CRUSHING_N + 2 * scene.gripper.force_N, this.step_s);
    if (crushed >= 0)
      return this.pause(
        "physics.crushed",
        `The fingers press on “${this.nameOf(crushed)}” with ${(this.grasps.hardest_N(crushed) / 1000).toFixed(1)} kN.`,
        "Move the point where the arm goes down, or open the gripper wider.",
      );
    return this.outcome;
  }

  place(part: string, worldFromPart: Pose<"world", "object">): void {
    const i = this.parts.indexOf(part);
    if (i < 0) return;
    const { data, layout } = this;
    const at = layout.firstPartQ + 7 * i;
    const [x, y, z, w] = worldFromPart.quaternion;
    (data.qpos as Float64Array).set([...worldFromPart.position, w, x, y, z], at);
    (data.qvel as Float64Array).fill(0, layout.firstPartV + 6 * i, layout.firstPartV + 6 * i + 6);
    this.settle();
  }

  reset(): void {
    this.engine.mj_resetData(this.model, this.data);
    (this.data.qpos as Float64Array).set(this.start);
    this.outcome = { kind: "running" };
    this.steps = 0;
    this.state.torque_Nm.fill(0);
    if (this.driver.kind === "driven") this.driver.carry(0);
    this.belts.reset();
    this.grasps.reset();
    this.sensors.reset();
    this.settle();
  }

  /** Poses and speeds of everything, lent until the next step: what a state log hashes. */
  get coordinates(): { readonly qpos: Float64Array; readonly qvel: Float64Array } {
    return { qpos: this.data.qpos as Float64Array, qvel: this.data.qvel as Float64Array };
  }

  close(): void {
    this.sensors.close();
    this.data.delete();
    this.model.delete();
  }

  /** Brings everything derived up to date without letting time pass. */
  private settle(): void {
    this.people.place(this.data.time, this.data.mocap_pos as Float64Array, this.data.mocap_quat as Float64Array);
    this.engine.mj_forward(this.model, this.data);
    this.read(false);
  }

  private read(closed: boolean): void {
    const { data, layout, state } = this;
    const { joints } = layout;
    const qpos = data.qpos as Float64Array;
    const qvel = data.qvel as Float64Array;
    state.time_s = this.steps * this.step_s;
    for (let j = 0; j < joints; j++) {
      state.q_rad[j] = qpos[j]!;
      state.qd_rad_s[j] = qvel[j]!;
    }
    if (layout.fingers > 0)
      state.opening_m = Math.max(0, this.scene.gripper!.open_m - qpos[joints]! - qpos[joints + 1]!);
    for (let i = 0; i < layout.parts; i++) {
      const from = layout.firstPartQ + 7 * i;
      const to = 7 * i;
      for (let k = 0; k < 3; k++) state.parts[to + k] = qpos[from + k]!;
      state.parts[to + 3] = qpos[from + 4]!;
      state.parts[to + 4] = qpos[from + 5]!;
      state.parts[to + 5] = qpos[from + 6]!;
      state.parts[to + 6] = qpos[from + 3]!;
    }
    const held = this.grasps.sense(data.sensordata as Float64Array, closed, this.step_s);
    if (held && this.driver.kind === "driven") this.driver.carry(this.heldLoad());
    this.sensors.look(this.steps);
    this.good.set(qpos);
  }

  /** What is between the fingers [kg]. */
  private heldLoad(): number {
    let load_kg = 0;
    for (let i = 0; i < this.parts.length; i++) if (this.grasps.signals[i] === "held") load_kg += this.masses_kg[i]!;
    return load_kg;
  }

  /** The first body whose speed is none, by name. */
  private odd(): string | undefined {
    const qvel = this.data.qvel as Float64Array;
    const qpos = this.data.qpos as Float64Array;
    const { layout, scene } = this;
    for (let v = 0; v < layout.nv; v++)
      if (!(Math.abs(qvel[v]!) < EXPLODED))
        return v < layout.firstPartV ? scene.robot.name : this.nameOf(Math.floor((v - layout.firstPartV) / 6));
    for (let q = 0; q < layout.nq; q++)
      if (!Number.isFinite(qpos[q]!))
        return q < layout.firstPartQ ? scene.robot.name : this.nameOf(Math.floor((q - layout.firstPartQ) / 7));
    return undefined;
  }

  private nameOf(part: number): string {
    return this.partObjects[part]!.name;
  }

  /** 1 where a sensor of the scene is tripped. Lent. */
  get tripped(): Uint8Array {
    return this.sensors.tripped;
  }

  private explode(name: string): DynamicsOutcome {
    (this.data.qpos as Float64Array).set(this.good);
    (this.data.qvel as Float64Array).fill(0);
    return this.pause(
      "physics.exploded",
      `“${name}” flew off: its speed passed ${EXPLODED} m/s at ${this.state.time_s.toFixed(3)} s.`,
      "Look for solids that are pressed into one another, or take a shorter step.",
    );
  }

  private pause(code: string, sentence: string, hint: string): DynamicsOutcome {
    this.outcome = { kind: "paused", why: { code, sentence, hint } };
    return this.outcome;
  }
}
