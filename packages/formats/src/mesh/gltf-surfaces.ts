import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import type { GltfBuffers } from "./gltf-buffers.ts";
import { GltfEntry } from "./gltf-json.ts";
import { openGltf, placeOf, rootNodes, triangleCorners, UPRIGHT } from "./gltf-open.ts";
import { Soup, times, type Matrix4 } from "./placed.ts";

/** A picture as it stands in the file. */
export interface Picture {
  readonly mime: string;
  readonly bytes: Uint8Array;
}

/** A surface with what it wears, where the file puts it: metres, z up. */
export interface FittedSurface {
  /** Names of the nodes it hangs on, the nearest first. */
  readonly nodes: readonly string[];
  readonly positions: Float64Array;
  readonly indices: Uint32Array;
  /** Two numbers per corner, from the picture's upper left; absent without a picture. */
  readonly uv?: Float64Array;
  /** Linear red, green, blue, opacity; times the picture where there is one. */
  readonly color: readonly [number, number, number, number];
  readonly picture?: Picture;
}
export interface SurfacesRead {
  readonly kind: "read";
  readonly surfaces: readonly FittedSurface[];
}

const DEEPEST = 256;
const MOST_VISITS = 200_000;

/**
 * Reads the surfaces of a glTF 2 one by one, with colour and picture of their material.
 *
 * @param other  bytes of a file that a JSON glTF names, by its address.
 */
export function readGltfSurfaces(
  bytes: Uint8Array,
  other: (address: string) => Uint8Array | undefined = () => undefined,
): SurfacesRead | NotUnderstood {
  return answering(() => {
    const { root, buffers } = openGltf(bytes, other);
    const surfaces: FittedSurface[] = [];
    let visits = 0;
    const visit = (index: unknown, outer: Matrix4, names: readonly string[]): void => {
      if (typeof index !== "number") throw new Refusal("A node of the glTF is not named by its number.");
      if (names.length > DEEPEST || ++visits > MOST_VISITS)
        throw new Refusal(
          `The nodes of the glTF hold each other ${names.length > DEEPEST ? `more than ${DEEPEST} deep` : `more than ${MOST_VISITS} times`}.`,
        );
      const node = root.entry("nodes", index);
      const matrix = times(outer, placeOf(node));
      const nodes = [node.text("name") ?? "", ...names];
      if (node.has("mesh")) {
        const mesh = root.entry("meshes", node.whole("mesh"));
        mesh.list("primitives").forEach((value, i) => {
          const surface = surfaceOf(
            root,
            buffers,
            new GltfEntry(value, `${mesh.place}.primitives[${i}]`),
            matrix,
            nodes,
          );
          if (surface) surfaces.push(surface);
        });
      }
      for (const child of node.list("children")) visit(child, matrix, nodes);
    };
    for (const index of rootNodes(root)) visit(index, UPRIGHT, []);
    return { kind: "read", surfaces };
  });
}

function surfaceOf(
  root: GltfEntry,
  buffers: GltfBuffers,
  primitive: GltfEntry,
  matrix: Matrix4,
  nodes: readonly string[],
): FittedSurface | undefined {
  const attributes = primitive.child("attributes");
  const mode = primitive.whole("mode", 4);
  if (mode < 4 || mode > 6 || !attributes.has("POSITION")) return undefined;
  const points = buffers.numbers(attributes.whole("POSITION"), 3);
  const soup = new Soup();
  soup.add(points, triangleCorners(primitive, buffers, points.length / 3), matrix);
  const base = { nodes, ...soup.mesh() };
  if (!primitive.has("material")) return { ...base, color: [1, 1, 1, 1] };
  const material = root.entry("materials", primitive.whole("material"));
  if (!material.has("pbrMetallicRoughness")) return { ...base, color: [1, 1, 1, 1] };
  const look = material.child("pbrMetallicRoughness");
  const [r = 1, g = 1, b = 1, a = 1] = look.numbers("baseColorFactor", 4) ?? [];
  const color = [r, g, b, a] as const;
  if (!look.has("baseColorTexture")) return { ...base, color };
  const use = look.child("baseColorTexture");
  const set = `TEXCOORD_${use.whole("texCoord", 0)}`;
  if (!attributes.has(set)) return { ...base, color };
  const uv = buffers.numbers(attributes.whole(set), 2);
  if (uv.length / 2 !== points.length / 3)
    throw new Refusal(
      `${primitive.place} of the glTF has ${uv.length / 2} places on its picture for ${points.length / 3} corners.`,
    );
  const image = root.entry("images", root.entry("textures", use.whole("index")).whole("source"));
  const mime =
    image.text("mimeType") ??
    /^data:([^;,]+)/.exec(image.text("uri") ?? "")?.[1] ??
    (/\.jpe?g$/i.test(image.text("uri") ?? "") ? "image/jpeg" : "image/png");
  return { ...base, color, uv, picture: { mime, bytes: buffers.image(image) } };
}
