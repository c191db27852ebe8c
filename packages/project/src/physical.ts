import {
  PARALLEL_GRIPPER,
  everyStep,
  type Gripper,
  type PhysicalObject,
  type PhysicalScene,
  type Pose,
  type Program,
  type Robot,
  type SolidShape,
} from "@twincell/core";
import type { CellDocument, Shape } from "./document.ts";
import { shapeMesh } from "./mesh/shape.ts";

export interface PhysicalSceneOptions {
  /** Posture at the start; home when left out. */
  readonly q_rad?: readonly number[];
  /** "moved" when left out: it needs no masses. */
  readonly control?: PhysicalScene["control"];
  /** The program that is to run: one that grips gets a gripper even where its tool says nothing of fingers. */
  readonly program?: Program;
}

/**
 * What of a saved cell has mass and touches. Work pieces fall and are carried, everything else stands still. The tool's
 * own solid is left out beside its fingers: contact of tools is judged exactly by the collision check.
 */
export function physicalScene(
  document: CellDocument,
  robot: Robot,
  { q_rad = robot.home_rad, control = { kind: "moved" }, program }: PhysicalSceneOptions = {},
): PhysicalScene {
  const gripper = gripperOf(document, program);
  return {
    robot,
    worldFromBase: document.robot.worldFromBase,
    q_rad,
    control,
    ...(gripper === undefined ? {} : { gripper }),
    objects: document.objects.map(
      (object): PhysicalObject => ({
        id: object.id,
        name: object.name,
        worldFromObject: object.worldFromObject,
        shape: solid(object.shape),
        role: object.role === "workpiece" ? "part" : "fixture",
        ...(object.mass_kg === undefined ? {} : { mass_kg: object.mass_kg }),
        ...(object.friction === undefined ? {} : { friction: object.friction }),
        ...(object.softness_s === undefined ? {} : { softness_s: object.softness_s }),
        ...(object.belt === undefined ? {} : { belt: object.belt }),
      }),
    ),
    sensors: document.sensors ?? [],
    people: document.people ?? [],
    zones: document.zones ?? [],
    floor_m: 0,
  };
}

function gripperOf({ tools, tool }: CellDocument, program: Program | undefined): Gripper | undefined {
  const steps = program === undefined ? [] : [...everyStep(program)];
  const used = steps.find(step => step.type === "move" && step.target.tool !== undefined);
  const name = used?.type === "move" ? used.target.tool : tool;
  const record = tools.find(each => each.name === name);
  if (record?.gripper === undefined && !steps.some(step => step.type === "gripper")) return undefined;
  return {
    ...PARALLEL_GRIPPER,
    ...record?.gripper,
    name: record?.name ?? PARALLEL_GRIPPER.name,
    ...(record === undefined ? {} : { flangeFromGrip: record.flangeFromTcp as Pose as Gripper["flangeFromGrip"] }),
  };
}

const solid = (shape: Shape): SolidShape =>
  shape.kind === "mesh" || shape.kind === "part" ? { kind: "mesh", mesh: shapeMesh(shape) } : shape;
