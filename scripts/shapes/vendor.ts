// Meshes that vendors and ros-industrial publish, link by link, where they lie beside the checkout.
import { existsSync, readFileSync } from "node:fs";
import { mergeMeshes, robotById, transformMesh, type TriangleMesh } from "@twincell/core";
import { daeMesh } from "./dae.ts";
import { armFromUrdf, readStl, readUrdf } from "@twincell/formats";

const FOLDER = new URL("../../../shared/robots/", import.meta.url);

/**
 * Surface of every link in the link's own frame, or null when the files are not at hand. Drawn meshes where they are
 * there, else those for collision.
 */
export function vendorLinks(id: string): TriangleMesh[] | null {
  const file = new URL(`${id}/robot.urdf`, FOLDER);
  const robot = robotById(id);
  if (robot === undefined || !existsSync(file) || !existsSync(new URL(`${id}/meshes`, FOLDER))) return null;
  const read = readUrdf(readFileSync(file, "utf8"));
  if (read.kind !== "read") throw new Error(read.sentence);
  const chain = armFromUrdf(read.robot, robot.frames.base, robot.frames.tip);
  if (chain.kind !== "chain") throw new Error(chain.sentence);
  return Array.from({ length: robot.arm.joints.length + 1 }, (_, link) => {
    const own = chain.shapes.filter(shape => shape.link === link && shape.shape.geometry.kind === "mesh");
    const drawn = own.filter(
      ({ use, shape }) =>
        use === "visual" &&
        shape.geometry.kind === "mesh" &&
        /\.(stl|dae)$/i.test(shape.geometry.reference) &&
        existsSync(new URL(`${id}/${shape.geometry.reference}`, FOLDER)),
    );
    const taken = drawn.length > 0 ? drawn : own.filter(({ use }) => use === "collision");
    return mergeMeshes(
      taken.map(({ armLinkFromShape, shape }) => {
        if (shape.geometry.kind !== "mesh") throw new Error("Only meshes are taken.");
        const { scale } = shape.geometry;
        const read = meshOf(new URL(`${id}/${shape.geometry.reference}`, FOLDER));
        const mesh = { positions: read.positions.map((value, i) => value * scale[i % 3]!), indices: read.indices };
        return { mesh: transformMesh(mesh, armLinkFromShape) };
      }),
    );
  });
}

function meshOf(file: URL): TriangleMesh {
  if (/\.dae$/i.test(file.pathname)) return daeMesh(readFileSync(file, "utf8"));
  const stl = readStl(readFileSync(file));
  if (!("mesh" in stl)) throw new Error(`${file.pathname} cannot be read.`);
  return stl.mesh;
}
