import { compose, identity, transformMesh, type Pose, type TriangleMesh } from "@twincell/core";
import { resolveFile } from "../files/resolve.ts";
import { folderOf, joinPath, nameOf, type FileSource } from "../files/source.ts";
import { Refusal } from "../refusal.ts";
import type { UrdfRobot, UrdfShape } from "../urdf/model.ts";
import { geometryMesh } from "../urdf/solids.ts";
import { readRobot } from "../xacro/index.ts";
import type { RawPart, RawParts, Rgb } from "./part.ts";
import { rawParts } from "./raw-parts.ts";

/**
 * A URDF or xacro as parts that stand where its links stand with every joint at 0; each link is one, with its own
 * colours. What cannot be loaded is said in the notes, and the rest comes all the same.
 *
 * @throws {Refusal} where the description is not understood or nothing of it has a shape.
 */
export function robotParts(path: string, files: FileSource): RawParts {
  const answer = readRobot(path, files);
  if (answer.kind !== "read") throw new Refusal(answer.sentence, answer.line, answer.file);
  const { robot, warnings } = answer;
  const poses = linkPosesAtZero(robot);
  const notes = [...warnings];
  const read = new Map<string, readonly RawPart[]>();
  const parts: RawPart[] = [];
  for (const link of robot.links) {
    const shapes = link.visuals.length > 0 ? link.visuals : link.collisions;
    for (const shape of shapes)
      for (const { color, mesh } of shapeParts(shape, path, files, read, notes))
        parts.push({
          name: link.name,
          path: [robot.name],
          color,
          mesh: transformMesh(mesh, compose(poses.get(link.name) ?? identity(), shape.linkFromShape as Pose)),
        });
  }
  if (parts.length === 0)
    throw new Refusal(`${robot.name} has no shape that could be loaded.${notes.length > 0 ? ` ${notes[0]}` : ""}`);
  notes.push("Every joint stands at 0.");
  return { format: "URDF", parts, statedUnit_m: 1, notes };
}

function linkPosesAtZero(robot: UrdfRobot): Map<string, Pose> {
  const poses = new Map<string, Pose>([[robot.root, identity()]]);
  for (let isNew = true; isNew; ) {
    isNew = false;
    for (const { parent, child, parentFromJoint } of robot.joints) {
      const above = poses.get(parent);
      if (!above || poses.has(child)) continue;
      poses.set(child, compose(above, parentFromJoint as Pose));
      isNew = true;
    }
  }
  return poses;
}

/** A drawn mesh in the frame of its shape. */
export interface ShownMesh {
  readonly color: Rgb | undefined;
  readonly mesh: TriangleMesh;
}

/**
 * The meshes of a shape with their colours; a mesh file is read once for all that name it.
 *
 * @param read   what was read already, by reference. Added to.
 * @param notes  what could not be loaded is added, one sentence each.
 */
export function shapeParts(
  { geometry, rgba }: UrdfShape,
  path: string,
  files: FileSource,
  read: Map<string, readonly RawPart[]>,
  notes: string[],
): readonly ShownMesh[] {
  const own: Rgb | undefined = rgba && [rgba[0] ?? 0.6, rgba[1] ?? 0.6, rgba[2] ?? 0.6];
  if (geometry.kind !== "mesh") {
    const mesh = geometryMesh(geometry, () => undefined);
    return mesh ? [{ color: own, mesh }] : [];
  }
  const { reference } = geometry;
  const known = read.get(reference) ?? meshFile(reference, path, files, notes);
  read.set(reference, known);
  return known.flatMap(part => {
    const mesh = geometryMesh(geometry, () => part.mesh);
    return mesh ? [{ color: own ?? part.color, mesh }] : [];
  });
}

function meshFile(reference: string, path: string, files: FileSource, notes: string[]): readonly RawPart[] {
  const found = resolveFile(reference, path, files);
  if (found.kind === "missing") {
    notes.push(found.sentence);
    return [];
  }
  if (found.note !== undefined) notes.push(found.note);
  const answer = rawParts(found.path, files.read(found.path) ?? new Uint8Array(), {
    other: address => files.read(joinPath(folderOf(found.path), address)),
    daeUp: "z",
  });
  if (answer.kind === "parts") return answer.parts;
  notes.push(`${nameOf(found.path)}${answer.line === undefined ? "" : `, line ${answer.line}`}: ${answer.sentence}`);
  return [];
}
