import { existsSync, readdirSync, statSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { inflateRawSync } from "node:zlib";
import {
  endingOf,
  filesInMemory,
  filesToImport,
  IMPORT_ENDINGS,
  importFile,
  LARGEST_IMPORT,
  readZip,
  STEP_ENDINGS,
  STEP_PARAMETERS,
  type FileSource,
  type Imported,
  type ImportOptions,
} from "@twincell/formats";
import type { Given } from "./arguments.ts";
import { disk } from "./disk.ts";
import { UseFault } from "./usage.ts";

export const SHAPE_OPTIONS = { unit: { type: "string" }, up: { type: "string" } } as const;

/** How files of shapes are explained in the help of a command. */
export const SHAPE_HELP = `PATH is an STL, OBJ (with its MTL beside it), PLY (also a cloud of points), DAE, GLB, glTF, STEP, URDF or xacro; a folder or a
ZIP of them: the robot description in it, or every shape.

  --unit U        what the file counts in: mm, cm, m, inch, foot, or metres per unit; asked of the file when absent. The report says
                  how sure that is: stated, likely or doubtful
  --up z          takes z for up in a COLLADA file whatever it says, as ROS does for robots`;

const UNITS: Readonly<Record<string, number>> = { mm: 0.001, cm: 0.01, m: 1, inch: 0.0254, foot: 0.3048 };
/** Folders are looked through to this depth, and for so many files. */
const DEEPEST = 12;
const MOST_FILES = 5000;

/** `--unit` and `--up`. */
export function shapeOptions(options: Given): Pick<ImportOptions, "metresPerUnit" | "daeUp"> {
  const unit = options.text("unit");
  const up = options.text("up");
  const metresPerUnit = unit === undefined ? undefined : (UNITS[unit] ?? Number(unit));
  if (metresPerUnit !== undefined && !(metresPerUnit > 0 && metresPerUnit <= 1e6))
    throw new UseFault(`--unit wants ${Object.keys(UNITS).join(", ")} or metres per unit, not "${unit}".`);
  if (up !== undefined && up !== "z" && up !== "file") throw new UseFault(`--up wants z or file, not "${up}".`);
  return { metresPerUnit, daeUp: up };
}

/**
 * What is at a path as imported parts, one answer for every file. What is not understood is a `UseFault` with the
 * file's name.
 */
export async function readShapes(path: string, options: Given): Promise<readonly Imported[]> {
  const { files, paths } = sourceOf(path);
  if (paths.length === 0)
    throw new UseFault(`${path} holds nothing that can be imported.`, `Read are ${IMPORT_ENDINGS.join(", ")}.`);
  const chosen = shapeOptions(options);
  const readStep = paths.some(each => STEP_ENDINGS.includes(endingOf(each))) ? await stepReader() : undefined;
  return paths.map(each => {
    const answer = importFile(each, files, { ...chosen, readStep });
    if (answer.kind === "imported") return answer;
    throw new UseFault(
      `${paths.length === 1 ? path : each}${answer.line === undefined ? "" : `, line ${answer.line}`}: ${answer.sentence}`,
    );
  });
}

async function stepReader(): Promise<NonNullable<ImportOptions["readStep"]>> {
  const { default: load } = await import("occt-import-js");
  const kernel = await load();
  return bytes => kernel.ReadStepFile(bytes, STEP_PARAMETERS);
}

function sourceOf(path: string): { readonly files: FileSource; readonly paths: readonly string[] } {
  if (!existsSync(path)) throw new UseFault(`There is no file ${path}.`);
  const found = statSync(path);
  if (found.isDirectory()) {
    const whole = resolve(path);
    return { files: disk, paths: filesToImport(filesUnder(whole, 0)) };
  }
  if (!found.isFile()) throw new UseFault(`${path} is no file.`);
  if (found.size > LARGEST_IMPORT)
    throw new UseFault(`${path} has ${found.size} bytes; at most ${LARGEST_IMPORT} are read.`);
  if (endingOf(path) === "zip") {
    const bytes = disk.read(path) ?? new Uint8Array();
    const archive = readZip(bytes, (packed, size) => inflateRawSync(packed, { maxOutputLength: size + 1 }));
    if (archive.kind !== "read") throw new UseFault(`${path}: ${archive.sentence}`);
    return { files: filesInMemory(archive.files), paths: filesToImport([...archive.files.keys()]) };
  }
  if (!IMPORT_ENDINGS.includes(endingOf(path)))
    throw new UseFault(
      `${basename(path)} cannot be imported.`,
      `Read are ${IMPORT_ENDINGS.join(", ")}, zip and folders of them.`,
    );
  return { files: disk, paths: [resolve(path)] };
}

function filesUnder(folder: string, depth: number): string[] {
  if (depth > DEEPEST) return [];
  const files: string[] = [];
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) files.push(...filesUnder(path, depth + 1));
    else if (entry.isFile()) files.push(path);
    if (files.length > MOST_FILES)
      throw new UseFault(`${folder} holds more than ${MOST_FILES} files.`, "Name a folder further down.");
  }
  return files;
}
