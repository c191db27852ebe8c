/** A binary glTF file as its two chunks. */
interface Gltf {
  bufferViews: { byteOffset?: number; byteLength: number }[];
  buffers: { byteLength: number }[];
  accessors?: { bufferView?: number }[];
  materials?: { normalTexture?: unknown }[];
  textures?: { source?: number }[];
  images?: { bufferView?: number }[];
}

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;
const HEADER_BYTES = 12;
const CHUNK_BYTES = 8;
const WORD = 4;

const padded = (bytes: number): number => Math.ceil(bytes / WORD) * WORD;

/**
 * The model without the maps of its surface normals: at the size of a hand they are not seen, and they are most of the
 * weight. Colour and roughness stay. A file of another form comes back as it is.
 */
export function withoutNormalMaps(file: Buffer): Buffer {
  if (file.length < HEADER_BYTES + CHUNK_BYTES || file.readUInt32LE(0) !== MAGIC) return file;
  const jsonBytes = file.readUInt32LE(HEADER_BYTES);
  const binAt = HEADER_BYTES + CHUNK_BYTES + jsonBytes + CHUNK_BYTES;
  const gltf = JSON.parse(file.toString("utf8", HEADER_BYTES + CHUNK_BYTES, binAt - CHUNK_BYTES)) as Gltf;
  const unused = imagesOfNormals(gltf);
  if (unused.size === 0) return file;
  for (const material of gltf.materials ?? []) delete material.normalTexture;
  const views = new Set([...unused].map(image => gltf.images![image]!.bufferView));
  // Textures keep their numbers: an image that is not used any more becomes one pixel.
  const parts: Buffer[] = [];
  let length = 0;
  gltf.bufferViews.forEach((view, i) => {
    const bytes = views.has(i) ? ONE_PIXEL : file.subarray(binAt + (view.byteOffset ?? 0)).subarray(0, view.byteLength);
    view.byteOffset = length;
    view.byteLength = bytes.length;
    parts.push(bytes, Buffer.alloc(padded(bytes.length) - bytes.length));
    length += padded(bytes.length);
  });
  gltf.buffers[0]!.byteLength = length;
  for (const image of unused) Object.assign(gltf.images![image]!, { mimeType: "image/png" });
  return glb(gltf, Buffer.concat(parts));
}

/** A white pixel as PNG. */
const ONE_PIXEL = Buffer.from(
  "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEAsTj2FAAAAABJRU5ErkJggg==",
  "base64",
);

/** Images that only normal maps use. */
function imagesOfNormals(gltf: Gltf): ReadonlySet<number> {
  const sourcesOf = (value: unknown): number[] => {
    if (value === null || typeof value !== "object") return [];
    return Object.entries(value).flatMap(([key, each]) => {
      const index = (each as { index?: number } | null)?.index;
      if (key === "normalTexture") return [];
      const own = key.endsWith("Texture") && index !== undefined ? [gltf.textures?.[index]?.source ?? -1] : [];
      return [...own, ...sourcesOf(each)];
    });
  };
  const kept = new Set(sourcesOf(gltf.materials ?? []));
  const normals = (gltf.materials ?? []).flatMap(({ normalTexture }) => {
    const index = (normalTexture as { index?: number } | undefined)?.index;
    const source = index === undefined ? undefined : gltf.textures?.[index]?.source;
    return source === undefined ? [] : [source];
  });
  return new Set(normals.filter(image => !kept.has(image) && gltf.images?.[image]?.bufferView !== undefined));
}

function glb(gltf: Gltf, binary: Buffer): Buffer {
  const text = Buffer.from(JSON.stringify(gltf));
  const json = Buffer.concat([text, Buffer.alloc(padded(text.length) - text.length, " ")]);
  const header = Buffer.alloc(HEADER_BYTES + CHUNK_BYTES);
  header.writeUInt32LE(MAGIC, 0);
  header.writeUInt32LE(2, 4);
  header.writeUInt32LE(HEADER_BYTES + 2 * CHUNK_BYTES + json.length + binary.length, 8);
  header.writeUInt32LE(json.length, HEADER_BYTES);
  header.writeUInt32LE(JSON_CHUNK, HEADER_BYTES + 4);
  const second = Buffer.alloc(CHUNK_BYTES);
  second.writeUInt32LE(binary.length, 0);
  second.writeUInt32LE(BIN_CHUNK, 4);
  return Buffer.concat([header, json, second, binary]);
}
