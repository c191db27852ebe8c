// Contact sheet of drawn robots beside their published meshes: node scripts/shape-sheet.ts OUT.png ROBOT …
import { writeFileSync } from "node:fs";
import { identity, linkPoses, linkShapes, robotById, transformMesh, type Robot } from "@twincell/core";
import { sheet, view, type Painted } from "./shapes/picture.ts";
import { vendorLinks } from "./shapes/vendor.ts";

const SIZE = 520;
const [out, ...ids] = process.argv.slice(2);
const rgbOf = (hex: string): [number, number, number] =>
  [1, 3, 5].map(i => (parseInt(hex.slice(i, i + 2), 16) / 255) ** 2.2) as [number, number, number];
const plain = { casting: "#eaa50c", dark: "#272c30", cover: "#3c444a", metal: "#b9c0c5", mark: "#f7f9fa" };

const rows = ids.flatMap(id => {
  const robot: Robot = robotById(id)!;
  const n = robot.arm.joints.length;
  const at = Array.from({ length: n + 1 }, () => identity<"base", "link">());
  linkPoses(robot.arm, robot.home_rad, at);
  const colours = { ...plain, ...robot.paint };
  const ours: Painted[] = linkShapes(robot).flatMap(({ link, parts }) =>
    parts.map(({ material, mesh }) => ({ ...transformMesh(mesh, at[link]!), rgb: rgbOf(colours[material]) })),
  );
  const vendor: Painted[] | undefined = vendorLinks(id)?.map((mesh, link) => ({
    ...transformMesh(mesh, at[link]!),
    rgb: [0.5, 0.55, 0.6] as const,
  }));
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const { positions } of ours)
    positions.forEach((value, i) => {
      low[i % 3] = Math.min(low[i % 3]!, value);
      high[i % 3] = Math.max(high[i % 3]!, value);
    });
  const centre = [0, 1, 2].map(k => (low[k]! + high[k]!) / 2) as [number, number, number];
  const span = 1.15 * Math.max(...[0, 1, 2].map(k => high[k]! - low[k]!));
  const three = (meshes: readonly Painted[]): Uint8Array[] =>
    [
      [-0.9, 0.35],
      [-Math.PI / 2, 0],
      [2.4, 0.3],
    ].map(([azimuth, elevation]) => view(meshes, SIZE, azimuth!, elevation!, span, centre));
  return vendor === undefined ? [three(ours)] : [[...three(ours), ...three(vendor)]];
});
writeFileSync(out!, sheet(rows, SIZE));
