import { mergeMeshes, type OwnLink, type Pose, type Robot } from "@twincell/core";
import { writeStl } from "../mesh/stl.ts";
import { writeUrdf, type MeshOfLink } from "../urdf/write.ts";
import { writeXml } from "../xml-write.ts";

/** One file of a folder, by its path in it. */
export interface FolderFile {
  readonly path: string;
  readonly content: string | Uint8Array;
}

/**
 * The robot as a package with its URDF: `NAME/package.xml`, `NAME/urdf/NAME.urdf`, and in `NAME/meshes` one STL for
 * each colour of a link [m, frame of the link] and one of its solids where they differ from what is drawn. Joints,
 * limits, masses and inertias are in it; what the robot does not have is left out. Read again it is the same arm to
 * 1e-12.
 *
 * @returns the files, and the name of the package.
 */
export function urdfFolder(robot: Robot): { readonly name: string; readonly files: readonly FolderFile[] } {
  const name = packageName(robot.name);
  const files: FolderFile[] = [];
  const drawn = new Map<string, MeshOfLink[]>();
  const add = (link: number, use: "visual" | "collision", stem: string, mesh: Uint8Array, color?: string): void => {
    const path = `meshes/${stem}.stl`;
    files.push({ path: `${name}/${path}`, content: mesh });
    const filename = `package://${name}/${path}`;
    const key = `${use} ${link}`;
    drawn.set(key, [...(drawn.get(key) ?? []), color === undefined ? { filename } : { filename, color }]);
  };
  for (const [link, own] of (robot.links ?? []).entries()) {
    for (const [i, { color, parts }] of byColor(own).entries())
      add(link, "visual", `link_${link}_${i + 1}`, writeStl(mergeMeshes(parts)), color);
    if (own.solids)
      add(link, "collision", `link_${link}_solid`, writeStl(mergeMeshes(own.solids.map(mesh => ({ mesh })))));
  }
  const { base, tip } = robot.frames;
  const hasWorld = base !== "base" && tip !== "base";
  const text = writeUrdf(robot.arm, {
    name,
    base,
    tip,
    masses: robot.masses,
    meshesOf: (link, use) => drawn.get(`${use} ${link}`) ?? drawn.get(`visual ${link}`) ?? [],
    ...(hasWorld ? { side: { name: "base", baseFromSide: robot.baseFromVendorWorld as Pose } } : {}),
  });
  return {
    name,
    files: [
      { path: `${name}/package.xml`, content: manifest(name, robot.name) },
      { path: `${name}/urdf/${name}.urdf`, content: text },
      ...files,
    ],
  };
}

/** What packages are called: small letters, digits and underscores, a letter first. */
function packageName(name: string): string {
  const plain = name
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "_")
    .replace(/^_+|_+$/g, "");
  return /^[a-z]/.test(plain) ? plain : `robot_${plain}`.replace(/_+$/, "");
}

function byColor({ parts }: OwnLink): { readonly color: string | undefined; readonly parts: OwnLink["parts"] }[] {
  const colors = new Map<string | undefined, OwnLink["parts"][number][]>();
  for (const part of parts) colors.set(part.color, [...(colors.get(part.color) ?? []), part]);
  return [...colors].map(([color, own]) => ({ color, parts: own }));
}

const manifest = (name: string, description: string): string =>
  writeXml({
    name: "package",
    attributes: { format: "3" },
    children: [
      { name: "name", attributes: {}, text: name },
      { name: "version", attributes: {}, text: "0.0.1" },
      { name: "description", attributes: {}, text: description },
    ],
  });
