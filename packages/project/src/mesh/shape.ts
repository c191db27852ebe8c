import {
  PlainFault,
  boxMesh,
  decodeMesh,
  revolvedMesh,
  robotById,
  type CellGeometry,
  type LinkSolid,
  type Pose,
  type TriangleMesh,
} from "@twincell/core";
import type { CellDocument, Shape } from "../document.ts";
import { partSolid } from "../parts/index.ts";
import { toolMass } from "../parts/tool-mass.ts";

/** Flat faces of a round shape per turn: 48 stay within 0.22 % of the radius. */
const FACES_PER_TURN = 48;

/**
 * The solid in its own frame [m].
 *
 * @throws {PlainFault} for a mesh whose bytes are not a mesh: `openDocument` lets none in.
 */
export function shapeMesh(shape: Shape): TriangleMesh {
  switch (shape.kind) {
    case "box":
      return boxMesh(shape.size_m);
    case "cylinder":
      return revolvedMesh(
        [
          [shape.radius_m, 0],
          [shape.radius_m, shape.height_m],
        ],
        FACES_PER_TURN,
      );
    case "revolved":
      return revolvedMesh(shape.profile_m, FACES_PER_TURN);
    case "part":
      return partSolid(shape);
    case "mesh": {
      const decoded = decodeMesh(shape);
      if (decoded.kind === "not-a-mesh")
        throw new PlainFault("project.mesh", decoded.sentence, `Import ${shape.file} again.`);
      return decoded.mesh;
    }
  }
}

/**
 * What the collision check must know of a cell.
 *
 * @param links  solids of the robot's links, in their own frames; drawn elsewhere.
 */
export function cellGeometry(document: CellDocument, links: readonly LinkSolid[]): CellGeometry {
  const tool = document.tools.find(candidate => candidate.name === document.tool);
  const toolMass_kg = tool === undefined ? undefined : toolMass(tool);
  return {
    worldFromBase: document.robot.worldFromBase,
    links,
    ...(tool?.shape === undefined ? {} : { tool: { name: tool.name, mesh: shapeMesh(tool.shape) } }),
    ...(toolMass_kg === undefined ? {} : { toolMass_kg }),
    ...(tool === undefined ? {} : { flangeFromGrip: tool.flangeFromTcp as Pose as Pose<"flange", "grip"> }),
    objects: document.objects.map(object => ({
      id: object.id,
      name: object.name,
      worldFromObject: object.worldFromObject,
      mesh: shapeMesh(object.shape),
      ...(object.mass_kg === undefined ? {} : { mass_kg: object.mass_kg }),
      ...(object.carries_kg === undefined ? {} : { carries_kg: object.carries_kg }),
      ...(object.role === "workpiece" ? { graspable: true as const } : {}),
    })),
    allowedPairs: document.allowedPairs,
    ...pairsOf(document),
    shapeError_m: robotById(document.robot.id)?.shapeError_m ?? 0,
    ...placeErrorOf(document),
  };
}

/** Both errors may point the same way: they add up. */
function placeErrorOf({ errors }: CellDocument): Pick<CellGeometry, "placeError_m" | "placeErrors"> {
  const registration_m = errors?.registration_m ?? 0;
  const twin_m = errors?.twin_m ?? 0;
  const placeError_m = registration_m + twin_m;
  return placeError_m > 0 ? { placeError_m, placeErrors: { registration_m, twin_m } } : {};
}

/**
 * The matrix as far as it was learnt for what stands there now: of another robot it says nothing, and with another tool
 * nothing of that tool, because a pair that was left out for one shape may not be left out for the next.
 */
function pairsOf({ pairs, robot, tool }: CellDocument): Pick<CellGeometry, "pairs"> {
  if (pairs?.robot !== robot.id) return {};
  return {
    pairs: {
      seed: pairs.seed,
      entries: pairs.tool === tool ? pairs.entries : pairs.entries.filter(({ a, b }) => a !== "tool" && b !== "tool"),
    },
  };
}
