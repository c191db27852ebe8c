import type { Pose, TriangleMesh } from "@twincell/core";
import type { ObjectRecord, Shape } from "../document.ts";
import { BELT_CONVEYOR } from "./belt-conveyor.ts";
import { BIN } from "./bin.ts";
import { CABINET } from "./cabinet.ts";
import { CARTON } from "./carton.ts";
import { DOOR } from "./door.ts";
import { FENCE } from "./fence.ts";
import { FIXTURE } from "./fixture.ts";
import type { PartKind, PartNumbers } from "./kind.ts";
import { LIGHT_CURTAIN } from "./light-curtain.ts";
import { PALLET } from "./pallet.ts";
import { PERSON } from "./person.ts";
import { solidOf, type PartPiece } from "./piece.ts";
import { ROBOT_STAND } from "./robot-stand.ts";
import { ROLLER_CONVEYOR } from "./roller-conveyor.ts";
import { TABLE } from "./table.ts";
import { STEEL_TABLE } from "./steel-table.ts";
import { TOOLS } from "./tools.ts";

export type { PartKind, PartNumbers, PartParameter } from "./kind.ts";
export type { PartMaterial, PartPiece } from "./piece.ts";

/** The library of parts. */
export const PARTS: readonly PartKind[] = [
  TABLE,
  STEEL_TABLE,
  FIXTURE,
  ROLLER_CONVEYOR,
  BELT_CONVEYOR,
  PALLET,
  CARTON,
  BIN,
  ROBOT_STAND,
  CABINET,
  FENCE,
  DOOR,
  LIGHT_CURTAIN,
  PERSON,
  ...TOOLS,
];
export const partById = (id: string): PartKind | undefined => PARTS.find(part => part.id === id);

type PartShape = Extract<Shape, { kind: "part" }>;

/** All parameters of a part: those that are not given are those of the library. */
export const partNumbers = (kind: PartKind, given: PartNumbers): PartNumbers =>
  Object.fromEntries(
    kind.parameters.map(({ id, value, min, max }) => [id, Math.min(max, Math.max(min, given[id] ?? value))]),
  );

/** What a part is drawn of; nothing for a part that this release does not know. */
export function partPieces(shape: PartShape): readonly PartPiece[] {
  const kind = partById(shape.part);
  return kind === undefined ? [] : kind.pieces(partNumbers(kind, shape.parameters));
}
/** The solid of a part, in its own frame [m]. */
export const partSolid = (shape: PartShape): TriangleMesh => solidOf(partPieces(shape));

/** What of an object follows from its part: mass, friction, the belt. */
function properties(kind: PartKind, numbers: PartNumbers): Partial<ObjectRecord> {
  const mass_kg = kind.mass_kg(numbers);
  return {
    mass_kg: Math.round(mass_kg * 100) / 100,
    friction: kind.friction,
    ...(kind.carries_kg === undefined ? {} : { carries_kg: kind.carries_kg }),
    ...(kind.conveys ? { belt: { direction: [1, 0, 0], speed_mps: numbers.speed ?? 0 } } : {}),
  };
}

/** A part of the library as an object of a cell. */
export function partObject(
  kind: PartKind,
  names: { readonly id: string; readonly name: string },
  worldFromObject: Pose<"world", "object">,
  given: PartNumbers = {},
): ObjectRecord {
  const numbers = partNumbers(kind, given);
  return {
    ...names,
    role: kind.role,
    worldFromObject,
    shape: { kind: "part", part: kind.id, parameters: numbers },
    color: kind.color,
    ...properties(kind, numbers),
  };
}

/** A part with other numbers; its mass follows unless a person typed one, its belt keeps what it is run by. */
export function changedPart(object: ObjectRecord, given: PartNumbers): ObjectRecord {
  if (object.shape.kind !== "part") return object;
  const kind = partById(object.shape.part);
  if (kind === undefined) return object;
  const before = properties(kind, partNumbers(kind, object.shape.parameters));
  const numbers = partNumbers(kind, { ...object.shape.parameters, ...given });
  const after = properties(kind, numbers);
  return {
    ...object,
    shape: { ...object.shape, parameters: numbers },
    ...(object.mass_kg === before.mass_kg && after.mass_kg !== undefined ? { mass_kg: after.mass_kg } : {}),
    ...(after.belt === undefined ? {} : { belt: { ...after.belt, ...object.belt, speed_mps: after.belt.speed_mps } }),
  };
}
