import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { nameOf } from "../files/source.ts";
import { daeParts, type DaeUp } from "../mesh/dae.ts";
import { readGltfSurfaces } from "../mesh/gltf-surfaces.ts";
import { plyContent } from "../mesh/ply.ts";
import { readStl } from "../mesh/stl.ts";
import { latin1 } from "../mesh/text.ts";
import { cloudSurface } from "./cloud.ts";
import { objParts } from "./obj-parts.ts";
import { fromLinear, type RawPart, type RawParts } from "./part.ts";
import { unitText } from "./unit.ts";

/** Files larger than this are refused before they are read [bytes]. */
export const LARGEST_IMPORT = 256_000_000;

/** Endings of the shape files that are read here; STEP goes through a CAD kernel first. */
export const SHAPE_ENDINGS: readonly string[] = ["stl", "obj", "ply", "dae", "glb", "gltf"];
export const STEP_ENDINGS: readonly string[] = ["step", "stp"];

/** The ending of a file's name in small letters, without its dot. */
export const endingOf = (name: string): string => /\.([a-z0-9]+)$/i.exec(nameOf(name))?.[1]?.toLowerCase() ?? "";
/** A file's name without its ending. */
export const stemOf = (name: string): string => nameOf(name).replace(/\.[^.]*$/, "") || nameOf(name);

/** What a reader of shapes may be told. */
export interface ShapeOptions {
  /** Bytes of a file that this one names, by the address written in it. */
  readonly other?: ((address: string) => Uint8Array | undefined) | undefined;
  /** Which way is up in a COLLADA file: as it says, or z as ROS takes it. */
  readonly daeUp?: DaeUp | undefined;
}

/** The parts of a shape file, with names, colours and places, in the file's units. */
export function rawParts(
  name: string,
  bytes: Uint8Array,
  { other = () => undefined, daeUp = "file" }: ShapeOptions = {},
): (RawParts & { readonly kind: "parts" }) | NotUnderstood {
  return answering(() => {
    if (bytes.length > LARGEST_IMPORT)
      throw new Refusal(`The file has ${bytes.length} bytes; at most ${LARGEST_IMPORT} are read.`);
    return { kind: "parts", ...read(name, bytes, other, daeUp) };
  });
}

function read(
  name: string,
  bytes: Uint8Array,
  other: (address: string) => Uint8Array | undefined,
  daeUp: DaeUp,
): RawParts {
  const stem = stemOf(name);
  switch (endingOf(name)) {
    case "stl":
      return stlParts(stem, bytes);
    case "obj":
      return objParts(bytes, other);
    case "ply":
      return plyParts(stem, bytes);
    case "dae":
      return colladaParts(stem, bytes, daeUp);
    case "glb":
    case "gltf":
      return gltfParts(stem, bytes, other);
    default:
      throw new Refusal(`${nameOf(name)} is no shape that is read: STL, OBJ, PLY, DAE, GLB, glTF and STEP are.`);
  }
}

/** A text STL may hold several named solids; each is a part. */
function stlParts(stem: string, bytes: Uint8Array): RawParts {
  const whole = readStl(bytes);
  if (whole.kind !== "read") throw new Refusal(whole.sentence, whole.line);
  const notes = whole.report.warnings.filter(warning => warning.includes("passed over"));
  if (whole.report.format === "STL (ASCII)") {
    const solids = latin1(bytes)
      .split(/^(?=\s*solid\b)/m)
      .filter(text => /^\s*solid\b/.test(text));
    if (solids.length > 1)
      return {
        format: "STL",
        notes,
        parts: solids.flatMap((text, i) => {
          const solid = readStl(Uint8Array.from(text, letter => letter.charCodeAt(0)));
          const named = /^\s*solid[ \t]+(\S[^\r\n]*)/.exec(text)?.[1]?.trim();
          return solid.kind === "read" && solid.report.triangles > 0
            ? [{ name: named ?? `${stem} ${i + 1}`, path: [], color: undefined, mesh: solid.mesh }]
            : [];
        }),
      };
  }
  const { withoutArea, notFinite } = whole.report;
  if (withoutArea > 0) notes.push(`${withoutArea} ${triangles(withoutArea)} without area left out.`);
  if (notFinite > 0) notes.push(`${notFinite} ${triangles(notFinite)} with coordinates that are not numbers left out.`);
  return { format: "STL", notes, parts: [{ name: stem, path: [], color: undefined, mesh: whole.mesh }] };
}
const triangles = (count: number): string => (count === 1 ? "triangle" : "triangles");

function plyParts(stem: string, bytes: Uint8Array): RawParts {
  const { positions, indices, meanColor } = plyContent(bytes);
  const notes = meanColor ? ["Each vertex has a colour; the part gets their mean."] : [];
  if (indices.length > 0)
    return { format: "PLY", notes, parts: [{ name: stem, path: [], color: meanColor, mesh: { positions, indices } }] };
  const { mesh, cube, points, notFinite } = cloudSurface(positions);
  if (notFinite > 0) notes.push(`${notFinite} points with coordinates that are not numbers left out.`);
  notes.push(
    `The ${points} points became the surface of cubes with a side of ${Number(cube.toPrecision(3))} units: it stands at most ${Number((cube * Math.sqrt(3)).toPrecision(3))} units off the points.`,
  );
  return { format: "PLY point cloud", notes, parts: [{ name: stem, path: [], color: meanColor, mesh }] };
}

function colladaParts(stem: string, bytes: Uint8Array, daeUp: DaeUp): RawParts {
  const { parts, statedUnit_m, up, notes } = daeParts(bytes, daeUp);
  const turned =
    up === "Z_UP"
      ? []
      : [daeUp === "z" ? `The file says ${up}; z was taken for up.` : `The file is ${up}: it was turned upright.`];
  const scaled =
    statedUnit_m !== undefined && statedUnit_m !== 1
      ? [`The file counts in ${unitText(statedUnit_m)}: lengths were turned into metres.`]
      : [];
  return {
    format: "COLLADA",
    notes: [...notes, ...turned, ...scaled],
    // The reader has already multiplied by the unit.
    statedUnit_m: statedUnit_m === undefined ? undefined : 1,
    parts: parts.map(({ path, color, positions, indices }) => ({
      name: path.at(-1) || stem,
      path: path.slice(0, -1).filter(each => each !== ""),
      color,
      mesh: { positions, indices },
    })),
  };
}

function gltfParts(stem: string, bytes: Uint8Array, other: (address: string) => Uint8Array | undefined): RawParts {
  const answer = readGltfSurfaces(bytes, other);
  if (answer.kind !== "read") throw new Refusal(answer.sentence, answer.line);
  if (answer.surfaces.length === 0) throw new Refusal("The file holds no faces.");
  const pictures = answer.surfaces.filter(({ picture }) => picture !== undefined).length;
  const parts = answer.surfaces.map(({ nodes, color, positions, indices }): RawPart => {
    const names = nodes.filter(each => each !== "");
    return {
      name: names[0] ?? stem,
      path: names.slice(1).reverse(),
      color: fromLinear(color),
      mesh: { positions, indices },
    };
  });
  return {
    format: bytes[0] === 0x67 && bytes[1] === 0x6c ? "GLB" : "glTF",
    parts,
    statedUnit_m: 1,
    notes:
      pictures > 0
        ? [`${pictures} surfaces wear a picture, which an object of a cell cannot: their base colour is kept.`]
        : [],
  };
}
