import {
  armDriveGains,
  computedTorque,
  computedTorqueScratch,
  driveTorque,
  dynamicsModel,
  dynamicsScratch,
  inverseDynamics,
  massMatrix,
  carriedTogether,
  type DriveGains,
  type DynamicsCommand,
  type DynamicsModel,
  type Payload,
  type PhysicalScene,
} from "@twincell/core";
import { MOVED_INERTIA } from "./model/arm.ts";

/** Moves the joints: writes what is applied to them before a step. */
export type ArmDriver = MovedArm | DrivenArm;

export function armDriver(scene: PhysicalScene, masses: DynamicsModel | undefined): ArmDriver {
  const { control } = scene;
  return masses === undefined || control.kind === "moved"
    ? new MovedArm(scene.robot.arm.joints.length)
    : new DrivenArm(scene, control);
}

/** Goes where it is told: the solver is given the acceleration, so that what is carried feels it. */
export class MovedArm {
  readonly kind = "moved";
  private readonly joints: number;
  constructor(joints: number) {
    this.joints = joints;
  }

  drive(command: DynamicsCommand, _qpos: Float64Array, _qvel: Float64Array, applied: Float64Array): void {
    for (let j = 0; j < this.joints; j++) applied[j] = MOVED_INERTIA * command.qdd_rad_s2[j]!;
  }
  /** Puts the joints where they were told to be, after the step. */
  overwrite(command: DynamicsCommand, qpos: Float64Array, qvel: Float64Array): void {
    for (let j = 0; j < this.joints; j++) {
      qpos[j] = command.q_rad[j]!;
      qvel[j] = command.qd_rad_s[j]!;
    }
  }
}

/** Drives with the gains of the cell's control, saturated at the published torques (rows L-12 … L-17, L-68, L-70). */
export class DrivenArm {
  readonly kind = "driven";
  private readonly scene: PhysicalScene;
  private readonly control: Exclude<PhysicalScene["control"], { kind: "moved" }>;
  private readonly limits_Nm: Float64Array;
  private readonly q: Float64Array;
  private readonly qd: Float64Array;
  private readonly none: Float64Array;
  private readonly weight: Float64Array;
  private readonly scratch: ReturnType<typeof dynamicsScratch>;
  private readonly working: ReturnType<typeof computedTorqueScratch>;
  private model: DynamicsModel;
  private gains: readonly DriveGains[];

  constructor(scene: PhysicalScene, control: Exclude<PhysicalScene["control"], { kind: "moved" }>) {
    const { joints } = scene.robot.arm;
    this.scene = scene;
    this.control = control;
    this.limits_Nm = Float64Array.from(joints, ({ limits }) => limits.torque_Nm ?? Number.POSITIVE_INFINITY);
    this.q = new Float64Array(joints.length);
    this.qd = new Float64Array(joints.length);
    this.none = new Float64Array(joints.length);
    this.weight = new Float64Array(joints.length);
    this.model = this.carrying(0);
    this.scratch = dynamicsScratch(this.model);
    this.working = computedTorqueScratch(this.model);
    this.gains = this.gainsFor(this.model);
  }

  drive(
    { q_rad, qd_rad_s, qdd_rad_s2 }: DynamicsCommand,
    qpos: Float64Array,
    qvel: Float64Array,
    applied: Float64Array,
    torque_Nm: Float64Array,
  ): void {
    const { control, limits_Nm, q, qd } = this;
    const n = limits_Nm.length;
    // The engine's lists go on with fingers, belts and parts.
    for (let j = 0; j < n; j++) {
      q[j] = qpos[j]!;
      qd[j] = qvel[j]!;
    }
    if (control.kind === "computed-torque")
      computedTorque(
        this.model,
        { q: q_rad, qd: qd_rad_s, qdd: qdd_rad_s2 },
        q,
        qd,
        control.bandwidth_rad_s,
        limits_Nm,
        torque_Nm,
        this.working,
      );
    else {
      inverseDynamics(this.model, q, this.none, this.none, this.weight, this.scratch);
      for (let j = 0; j < n; j++) {
        const wanted = driveTorque(this.gains[j]!, q_rad[j]!, q[j]!, qd_rad_s[j]!, qd[j]!) + this.weight[j]!;
        torque_Nm[j] = Math.max(-limits_Nm[j]!, Math.min(limits_Nm[j]!, wanted));
      }
    }
    for (let j = 0; j < n; j++) applied[j] = torque_Nm[j]!;
  }
  /** The controller is told what the gripper holds (row X-55) [kg]. */
  carry(load_kg: number): void {
    this.model = this.carrying(load_kg);
  }

  /** Gripper and load as masses in the grip point; the arm's own masses are known, or this class would not be here. */
  private carrying(load_kg: number): DynamicsModel {
    const { robot, worldFromBase, gripper, payload } = this.scene;
    const held: Payload | undefined =
      gripper === undefined
        ? undefined
        : { mass_kg: load_kg + gripper.mass_kg, center_m: gripper.flangeFromGrip.position };
    const all = payload !== undefined && held !== undefined ? carriedTogether(payload, held) : (payload ?? held);
    const answer = dynamicsModel(robot, { worldFromBase, ...(all === undefined ? {} : { payload: all }) });
    return answer.kind === "known" ? answer.model : this.model;
  }

  private gainsFor(model: DynamicsModel): readonly DriveGains[] {
    const n = this.limits_Nm.length;
    const mass = massMatrix(model, this.scene.q_rad);
    const { bandwidth_rad_s } = this.control;
    return Array.from({ length: n }, (_, j) =>
      armDriveGains(mass[j * n + j]! * bandwidth_rad_s ** 2, mass[j * n + j]!, this.limits_Nm[j]!),
    );
  }
}
