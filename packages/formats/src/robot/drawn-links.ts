import { seededRandom, transformMesh, type OwnLink, type Pose, type TriangleMesh } from "@twincell/core";
import type { FileSource } from "../files/source.ts";
import { finishImport } from "../import/finish.ts";
import { lightened } from "../import/lighten.ts";
import type { ImportedPart, RawPart, Rgb } from "../import/part.ts";
import { shapeParts } from "../import/robot-parts.ts";
import type { PlacedShape, UrdfChain } from "../urdf/chain.ts";
import { solidShapes } from "../urdf/solids.ts";

/** What a phone or headset draws of one robot without effort. */
const MOST_DRAWN = 60_000;
/** What every distance that is judged goes through; a link of a thousand triangles is a good casting. */
const MOST_SOLID = 12_000;
/** Links without a colour of their own are all alike. */
const PLAIN: Rgb = [0.78, 0.8, 0.82];
/** A small link keeps enough to be one. */
const FEWEST_OF_LINK = 60;
/** The samples of a deviation are the same every time. */
const SEED = 1;

export interface DrawnLinks {
  /** Missing where no shape could be loaded: then the arm is drawn from its dimensions. */
  readonly links?: readonly OwnLink[];
  /** How far the solids that count in collisions are from those of the files at most [m]. */
  readonly shapeError_m: number;
  readonly notes: readonly string[];
}

/**
 * The shapes of a description on the links of its arm: coloured parts to look at, and solids for collisions (its
 * collision shapes; where a link has none, what is drawn). Both are made light, and the deviation of the solids is
 * measured.
 */
export async function drawnLinks(chain: UrdfChain, path: string, files: FileSource): Promise<DrawnLinks> {
  const notes: string[] = [];
  const read = new Map<string, readonly RawPart[]>();
  const withVisual = new Set(chain.shapes.filter(({ use }) => use === "visual").map(({ name }) => name));
  const drawn = chain.shapes.filter(({ use, name }) => use === "visual" || !withVisual.has(name));
  const load = (shapes: readonly PlacedShape[]): ImportedPart[] => {
    const parts = shapes.flatMap(({ link, armLinkFromShape, shape }) =>
      shapeParts(shape, path, files, read, notes).map(
        ({ color, mesh }): RawPart => ({
          name: String(link),
          path: [],
          color: color ?? PLAIN,
          mesh: transformMesh(mesh, armLinkFromShape as Pose),
        }),
      ),
    );
    if (parts.length === 0) return [];
    return [...finishImport("", { format: "URDF", parts, statedUnit_m: 1, notes: [] }).parts];
  };
  return lightLinks(load(drawn), load(solidShapes(chain)), chain.arm.joints.length, notes);
}

/**
 * The links of an arm out of their parts, with no more triangles than are drawn and judged without effort.
 *
 * @param drawn   what is seen; every part bears the number of its link as its name and stands in that link's frame.
 * @param solids  what counts in collisions, likewise.
 * @param notes   what was said before; what came of this is added.
 */
export async function lightLinks(
  drawn: readonly ImportedPart[],
  solids: readonly ImportedPart[],
  joints: number,
  notes: readonly string[] = [],
): Promise<DrawnLinks> {
  const said = [...notes];
  const visible = await lightTo(drawn, MOST_DRAWN);
  const solid = await lightTo(solids, MOST_SOLID);
  if (visible.parts.length === 0) return { shapeError_m: 0, notes: [...new Set(said)] };
  if (visible.faces < visible.faces_before)
    said.push(
      `The robot is drawn with ${visible.faces} of its ${visible.faces_before} triangles, within ${millimetres(visible.deviation_m)} mm.`,
    );
  if (solid.faces < solid.faces_before)
    said.push(
      `Collisions are judged with ${solid.faces} of ${solid.faces_before} triangles; the ${millimetres(solid.deviation_m)} mm they are off at most are added to every margin.`,
    );
  const links = Array.from({ length: joints + 1 }, (_, link): OwnLink => {
    const parts = ofLink(visible.parts, link);
    const own = ofLink(solid.parts, link);
    return {
      parts: parts.map(({ color, mesh }) => ({ color, mesh })),
      ...(own.length === 0 || sameMeshes(parts, own) ? {} : { solids: own.map(({ mesh }) => mesh) }),
    };
  });
  return { links, shapeError_m: solid.deviation_m, notes: [...new Set(said)] };
}

interface Light {
  readonly parts: readonly ImportedPart[];
  readonly faces: number;
  readonly faces_before: number;
  readonly deviation_m: number;
}

/** Link by link: in their own frames links lie in one another, and the nearest surface would be that of a neighbour. */
async function lightTo(parts: readonly ImportedPart[], most: number): Promise<Light> {
  const faces_before = facesOf(parts);
  if (faces_before <= most) return { parts, faces: faces_before, faces_before, deviation_m: 0 };
  const fewer: ImportedPart[] = [];
  let deviation_m = 0;
  for (const name of new Set(parts.map(part => part.name))) {
    const own = parts.filter(part => part.name === name);
    const share = Math.max(FEWEST_OF_LINK, Math.floor((facesOf(own) * most) / faces_before));
    const { parts: light, report } = await lightened(own, share, seededRandom(SEED));
    fewer.push(...light);
    deviation_m = Math.max(deviation_m, report.max_deviation_m);
  }
  return { parts: fewer, faces: facesOf(fewer), faces_before, deviation_m };
}
const facesOf = (parts: readonly ImportedPart[]): number =>
  parts.reduce((sum, { mesh }) => sum + mesh.indices.length / 3, 0);

const ofLink = (parts: readonly ImportedPart[], link: number): readonly ImportedPart[] =>
  parts.filter(({ name }) => name === String(link));

const sameMeshes = (a: readonly ImportedPart[], b: readonly ImportedPart[]): boolean =>
  a.length === b.length && a.every(({ mesh }, i) => sameMesh(mesh, b[i]!.mesh));
const sameMesh = (a: TriangleMesh, b: TriangleMesh): boolean =>
  a.indices.length === b.indices.length &&
  a.positions.length === b.positions.length &&
  a.positions.every((value, i) => value === b.positions[i]);

const millimetres = (length_m: number): string => (length_m * 1000).toFixed(2);
