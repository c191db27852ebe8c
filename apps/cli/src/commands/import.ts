import { existsSync } from "node:fs";
import { resolve } from "node:path";
import { addOwnRobot, robotById, LIBRARY, type Vector3 } from "@twincell/core";
import { partsForCell, robotFromFiles } from "@twincell/formats";
import { emptyCell, placeParts, saveDocument, type CellDocument } from "@twincell/project";
import { given } from "../io/arguments.ts";
import { disk } from "../io/disk.ts";
import { writeOne } from "../io/output.ts";
import { readCell } from "../io/program.ts";
import { isRobotPath } from "../io/robot-file.ts";
import { readShapes, SHAPE_HELP, SHAPE_OPTIONS } from "../io/shapes.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const importCommand: Command = {
  name: "import",
  summary: "put files of shapes into a cell",
  usage: `twincell import PATH… -o CELL [--unit U] [--at X,Y,Z] [--robot R]

Puts the parts of the files into the cell, each with its name and colour, and prints one JSON line per file: {"file","unit":
{"metresPerUnit","certainty","sentence"},"report":{"format","triangles","parts","materials","openEdges","size_m","fixes",…},
"objects":[…ids]}. A cell that is already there gets the parts added; else a new one is made.

  -o CELL         the cell to write
  --at X,Y,Z      where the middle of the underside of each file's parts is put, in metres; in front of the robot when absent
  --robot R       robot of a new cell, an id of "twincell robots" (staubli_rx90l when absent), or the path of a URDF, xacro,
                  robot file or D-H table: the cell then brings that robot with it. PATH may be left out

${SHAPE_HELP}`,
  async run(args) {
    const options = given(args, {
      ...SHAPE_OPTIONS,
      output: { type: "string", short: "o" },
      at: { type: "string" },
      robot: { type: "string" },
      json: { type: "boolean" },
    });
    const output = options.text("output");
    const at = options.numbers("at");
    const robot = options.text("robot");
    if (options.positionals.length === 0 && robot === undefined)
      throw new UseFault("PATH is missing.", "Give a file, folder or ZIP.");
    if (output === undefined) throw new UseFault("-o CELL is missing.", "Say which cell to write.");
    if (at !== undefined && at.length !== 3) throw new UseFault(`--at wants three numbers, not ${at.length}.`);
    let cell = await startCell(output, robot);
    const lines: string[] = [];
    for (const path of options.positionals)
      for (const { name, parts, unit, report } of await readShapes(path, options)) {
        const placed = placeParts(
          partsForCell(parts, name),
          name,
          new Set(cell.objects.map(({ id }) => id)),
          at as Vector3 | undefined,
        );
        cell = { ...cell, objects: [...cell.objects, ...placed] };
        lines.push(JSON.stringify({ file: path, unit, report, objects: placed.map(({ id }) => id) }));
      }
    await writeOne(output, saveDocument(cell));
    process.stdout.write(`${lines.join("\n")}\n`);
    return 0;
  },
};

async function startCell(path: string, robot: string | undefined): Promise<CellDocument> {
  if (existsSync(path)) {
    if (robot !== undefined) throw new UseFault(`${path} has a robot already.`, "Leave --robot out.");
    return readCell(path);
  }
  if (robot !== undefined && isRobotPath(robot)) return ownCell(robot);
  if (robot !== undefined && !robotById(robot))
    throw new UseFault(
      `There is no robot "${robot}" in the library.`,
      `Library: ${LIBRARY.map(({ id }) => id).join(", ")}.`,
    );
  return emptyCell(robot);
}

/** A new cell that brings the robot of a file with it, meshes and all. */
async function ownCell(path: string): Promise<CellDocument> {
  const read = await robotFromFiles(resolve(path), disk);
  if (read.kind === "not-understood")
    throw new UseFault(`${path}${read.line === undefined ? "" : `, line ${read.line}`}: ${read.sentence}`);
  for (const note of read.notes) process.stderr.write(`twincell: ${note}\n`);
  addOwnRobot(read.robot);
  const cell = emptyCell(read.robot.id);
  return { ...cell, robot: { ...cell.robot, file: read.file } };
}
