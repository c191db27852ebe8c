import { readdir, realpath } from "node:fs/promises";
import { isAbsolute, join, relative, resolve, sep } from "node:path";
import { linkSolids, robotById, type CellGeometry, type Program, type Robot } from "@twincell/core";
import { cellGeometry, saveDocument, stepPrograms, type CellDocument } from "@twincell/project";
import { writeOne } from "../io/output.ts";
import { readCell } from "../io/program.ts";
import { UseFault } from "../io/usage.ts";

/** A program of a cell with everything that judging it needs. */
export interface ProgramInCell {
  readonly document: CellDocument;
  readonly program: Program;
  readonly robot: Robot;
  readonly cell: CellGeometry;
}

/** The saved cells of one folder. Nothing outside of it is read or written. */
export class CellFolder {
  readonly root: string;

  private constructor(root: string) {
    this.root = root;
  }

  static async open(folder: string): Promise<CellFolder> {
    try {
      return new CellFolder(await realpath(folder));
    } catch {
      throw new UseFault(`There is no folder ${folder}.`, "Name the folder with the cells with --folder.");
    }
  }

  /** Names of the files that are cells, and of those that end like one and are not, with why. */
  async list(): Promise<readonly { readonly file: string; readonly document?: CellDocument; readonly why?: string }[]> {
    const names = (await readdir(this.root)).filter(name => name.endsWith(".json")).toSorted();
    return Promise.all(
      names.map(async file => {
        try {
          return { file, document: await readCell(join(this.root, file)) };
        } catch (problem) {
          return { file, why: problem instanceof Error ? problem.message : String(problem) };
        }
      }),
    );
  }

  async read(file: string): Promise<CellDocument> {
    return readCell(await this.pathOf(file));
  }

  async write(file: string, document: CellDocument): Promise<void> {
    await writeOne(await this.pathOf(file), saveDocument(document));
  }

  /** A program of a cell; the selected one when no name is given. */
  async program(file: string, name?: string): Promise<ProgramInCell> {
    const document = await this.read(file);
    const wanted = name ?? document.program;
    const program = stepPrograms(document).find(each => each.name === wanted);
    if (!program) {
      const known = stepPrograms(document).map(each => `"${each.name}"`);
      throw new UseFault(
        `${file} has no program of steps called "${wanted}".`,
        known.length > 0 ? `It has ${known.join(", ")}.` : "Write one with write_program.",
      );
    }
    const robot = robotById(document.robot.id);
    if (!robot) throw new UseFault(`The library has no robot called "${document.robot.id}".`, "See the tool robots.");
    return { document, program, robot, cell: cellGeometry(document, linkSolids(robot)) };
  }

  /** A file of this folder itself: no path, no link to somewhere else. */
  private async pathOf(file: string): Promise<string> {
    const path = resolve(this.root, file);
    const inside = relative(this.root, path);
    if (
      !file.endsWith(".json") ||
      inside.startsWith("..") ||
      isAbsolute(inside) ||
      inside.includes(sep) ||
      inside === ""
    )
      throw new UseFault(`"${file}" is not a file of the folder.`, 'Give a name such as "cell.json".');
    const real = await realpath(path).catch(() => path);
    if (real !== path) throw new UseFault(`"${file}" leads out of the folder.`, "Copy the cell into the folder.");
    return path;
  }
}
