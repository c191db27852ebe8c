import "./know-robots.ts";
import { inflateSync } from "fflate";
import { inverse, seededRandom, transformMesh, type Pose } from "@twincell/core";
import {
  endingOf,
  filesInMemory,
  filesToImport,
  importFile,
  LARGEST_IMPORT,
  lightened,
  mayBeRobot,
  partsForCell,
  readZip,
  robotFromFiles,
  robotFromRig,
  STEP_ENDINGS,
  type ImportedPart,
  type OcctResult,
  type Rig,
} from "@twincell/formats";
import { encodeMesh, placeParts, rescaledObjects, shapeMesh, type ObjectRecord } from "@twincell/project";
import type { ImportedFile, ShapeAnswer, ShapeRequest } from "./shape-messages.ts";

/** The samples of a deviation are the same every time. */
const SEED = 1;

addEventListener("message", ({ data }: MessageEvent<ShapeRequest>) => {
  void answerTo(data)
    .catch(
      (problem: unknown): ShapeAnswer => ({
        kind: "not-understood",
        sentence: problem instanceof Error ? problem.message : String(problem),
      }),
    )
    .then(answer => postMessage(answer));
});

async function answerTo(request: ShapeRequest): Promise<ShapeAnswer> {
  switch (request.kind) {
    case "import":
      return imported(request);
    case "scale":
      return { kind: "scaled", objects: rescaledObjects(request.objects, request.factor) };
    case "light":
      return light(request.objects, request.faces);
    case "rig":
      return rigged(request.rig);
  }
}

async function imported({ files, taken, robots }: Extract<ShapeRequest, { kind: "import" }>): Promise<ShapeAnswer> {
  const held = new Map<string, Uint8Array>();
  for (const { path, bytes } of files) {
    if (endingOf(path) !== "zip") {
      held.set(path, bytes);
      continue;
    }
    const archive = readZip(bytes, (packed, size) => inflateSync(packed, { out: new Uint8Array(size) }));
    if (archive.kind !== "read") return archive;
    for (const [inside, content] of archive.files) held.set(inside, content);
  }
  const robot = robots ? await robotAmong(held) : undefined;
  if (robot) return robot;
  const paths = filesToImport([...held.keys()]);
  if (paths.length === 0)
    return { kind: "not-understood", sentence: "There is no shape and no robot description in it." };
  const steps = new Map<Uint8Array, OcctResult>();
  for (const path of paths) {
    const bytes = held.get(path);
    if (bytes && looksLikeStep(path, bytes)) steps.set(bytes, await readStep(bytes));
  }
  const source = filesInMemory(held);
  const ids = new Set(taken);
  const done: ImportedFile[] = [];
  for (const path of paths) {
    const answer = importFile(path, source, { readStep: bytes => steps.get(bytes) ?? { success: false } });
    if (answer.kind !== "imported")
      return { kind: "not-understood", sentence: paths.length > 1 ? `${path}: ${answer.sentence}` : answer.sentence };
    const { name, parts, unit, report } = answer;
    const file = path.slice(path.lastIndexOf("/") + 1);
    const objects = placeParts(partsForCell(parts, name), file, ids);
    for (const { id } of objects) ids.add(id);
    done.push({ file, unit, report, objects });
  }
  return { kind: "imported", files: done };
}

/**
 * The robot that the files describe: a description where there is one, else a robot file or a table. Files that are no
 * robot by their content are none; a description that has no moving chain is a shape like others.
 */
async function robotAmong(held: ReadonlyMap<string, Uint8Array>): Promise<ShapeAnswer | undefined> {
  const source = filesInMemory(held);
  const [described] = filesToImport([...held.keys()]).filter(path => ["urdf", "xacro"].includes(endingOf(path)));
  const path = described ?? [...held].find(([name, bytes]) => mayBeRobot(name, bytes))?.[0];
  if (path === undefined) return undefined;
  const read = await robotFromFiles(path, source);
  if (read.kind === "robot")
    return {
      kind: "robot",
      name: path.slice(path.lastIndexOf("/") + 1),
      file: read.file,
      notes: read.notes,
      hasParts: described !== undefined,
    };
  if (described !== undefined) return undefined;
  return {
    kind: "not-understood",
    sentence: `${read.line === undefined ? "" : `Line ${read.line}: `}${read.sentence}`,
  };
}

async function rigged(rig: Rig): Promise<ShapeAnswer> {
  const read = await robotFromRig(rig);
  if (read.kind !== "robot") return read;
  return { kind: "rigged", file: read.file, notes: read.notes, worldFromBase: read.worldFromBase };
}

const looksLikeStep = (path: string, bytes: Uint8Array): boolean =>
  STEP_ENDINGS.includes(endingOf(path)) && bytes.length <= LARGEST_IMPORT;

/** The CAD kernel weighs 7.6 MB and is fetched when the first STEP file comes; it ends with this worker. */
async function readStep(bytes: Uint8Array): Promise<OcctResult> {
  const worker = new Worker(new URL("./step.worker.ts", import.meta.url), { type: "module" });
  try {
    return await new Promise<OcctResult>((resolve, reject) => {
      worker.addEventListener("message", ({ data }: MessageEvent<OcctResult | string>) => {
        if (typeof data === "string") reject(new Error(`The CAD kernel failed: ${data}`));
        else resolve(data);
      });
      worker.addEventListener("error", event => reject(new Error(`The CAD kernel failed: ${event.message}`)));
      worker.postMessage(bytes);
    });
  } finally {
    worker.terminate();
  }
}

async function light(objects: readonly ObjectRecord[], adapters: number): Promise<ShapeAnswer> {
  const parts = objects.map(
    ({ id, color, shape, worldFromObject }): ImportedPart => ({
      name: id,
      path: [],
      color,
      mesh: transformMesh(shapeMesh(shape), worldFromObject as Pose),
    }),
  );
  const { parts: fewer, report } = await lightened(parts, adapters, seededRandom(SEED));
  const byId = new Map(fewer.map(part => [part.name, part]));
  return {
    kind: "light",
    report,
    objects: objects.map(object => {
      const part = byId.get(object.id);
      if (!part || object.shape.kind !== "mesh") return object;
      const own = transformMesh(part.mesh, inverse(object.worldFromObject) as Pose);
      return {
        ...object,
        color: part.color,
        shape: { kind: "mesh", file: object.shape.file, ...encodeMesh(own) },
      };
    }),
  };
}
