// Fits the castings of robots to meshes that lie beside the checkout: node scripts/fit-shapes.ts ROBOT …
// Writes packages/core/src/robots/library/forms/ROBOT.ts: rounded rectangles every few centimetres. Meshes themselves
// are never copied.
import { mkdirSync, writeFileSync } from "node:fs";
import { meshBounds, robotById, type FormLoft, type TriangleMesh } from "@twincell/core";
import { addCovers, addMark } from "./shapes/decorate.ts";
import { fitLofts } from "./shapes/fit.ts";
import { vendorLinks } from "./shapes/vendor.ts";
import { voxelsOf, type Voxels } from "./shapes/voxels.ts";

const FORMS = new URL("../packages/core/src/robots/library/forms/", import.meta.url);
/** Enough castings when none stands out more than this. */
const ENOUGH_M = 0.007;
const TOLERANCE_M = 0.003;
/** Castings a link at most, coarse cells along a link, and the joints whose bearings have covers. */
const LOOK: Readonly<
  Record<
    string,
    {
      readonly most?: number;
      readonly coarse?: number;
      readonly covers: readonly number[];
      readonly material?: "dark" | "cover";
    }
  >
> = {
  ur10e: { covers: [1, 2, 3, 4, 5], material: "cover" },
  kuka_lbr_iiwa_14_r820: { covers: [2, 4, 6], material: "cover" },
  abb_crb15000_5_95: { covers: [2, 3, 5], material: "cover" },
  staubli_rx160: { most: 18, coarse: 84, covers: [2, 3, 5] },
};

const sizeOf = (mesh: TriangleMesh): number => {
  const { lower, upper } = meshBounds(mesh);
  return Math.max(...[0, 1, 2].map(k => upper[k]! - lower[k]!));
};
const fineOf = (mesh: TriangleMesh): Voxels => voxelsOf(mesh, Math.max(0.002, sizeOf(mesh) / 180));
const textOf = ({ along, ends, rings, material, bolts }: FormLoft): string =>
  `    { along: "${along}", ends: [${ends.join(", ")}], rings: [${rings.map(ring => `[${ring.join(", ")}]`).join(", ")}]${material === undefined ? "" : `, material: "${material}"`}${bolts === undefined ? "" : `, bolts: ${bolts}`} },`;

for (const id of process.argv.slice(2)) {
  const links = vendorLinks(id);
  const robot = robotById(id);
  if (links === null || robot === undefined) {
    process.stderr.write(`${id}: no meshes at hand.\n`);
    continue;
  }
  const { most = 10, coarse = 48, covers, material = "dark" } = LOOK[id] ?? { covers: [2, 3, 5] };
  const fine = links.map(fineOf);
  const n = robot.arm.joints.length;
  const lofts: FormLoft[][] = links.map((mesh, link) =>
    fitLofts(voxelsOf(mesh, Math.max(0.004, sizeOf(mesh) / coarse)), fine[link]!, most, ENOUGH_M, TOLERANCE_M).map(
      ({ along, rings, free }) => ({
        along,
        ends: [free[0] ? 5 : 0, free[1] ? 5 : 0],
        rings: rings as unknown as FormLoft["rings"],
      }),
    ),
  );
  addCovers(robot, fine, covers, lofts, material);
  addMark(robot, fine, n, 6, lofts);
  addMark(robot, fine, n - 2, 24, lofts);
  mkdirSync(FORMS, { recursive: true });
  writeFileSync(
    new URL(`${id}.ts`, FORMS),
    `import type { FormLoft } from "../../shapes/form.ts";

/** Shapes of the links of ${id} [mm]: fitted by scripts/fit-shapes.ts to the outer sizes of the robot's published meshes. */
// biome-ignore format: table of numbers
export const CASTINGS: readonly (readonly FormLoft[])[] = [
${lofts.map(each => `  [\n${each.map(textOf).join("\n")}\n  ],`).join("\n")}
];
`,
  );
}
