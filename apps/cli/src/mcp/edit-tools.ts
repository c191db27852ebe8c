import { checkProgram, parseProgram, robotById, type Program } from "@twincell/core";
import { emptyCell, isTextProgram, readDocument, repairCell, type CellDocument } from "@twincell/project";
import { z } from "zod";
import { repairSearch } from "../io/explained.ts";
import { UseFault } from "../io/usage.ts";
import type { CellFolder } from "./cell-folder.ts";
import { anyJson, cellFile, programName } from "./inputs.ts";
import { tool, type Tool } from "./tool.ts";

export const EDIT_TOOLS: readonly Tool[] = [
  tool({
    name: "new_cell",
    title: "Make a cell",
    description: "A cell with a robot alone on the floor and an empty program. A file that is there is not replaced.",
    input: z.object({ cell: cellFile, robot: z.string().max(120), name: z.string().min(1).max(200) }),
    readOnly: false,
    run: async (folder, { cell, robot, name }) => {
      if (!robotById(robot)) throw new UseFault(`The library has no robot called "${robot}".`, "See the tool robots.");
      if ((await folder.list()).some(({ file }) => file === cell))
        throw new UseFault(`${cell} is there already.`, "Take another name, or change it with write_cell.");
      await folder.write(cell, emptyCell(robot, name));
      return { written: cell };
    },
  }),
  tool({
    name: "write_cell",
    title: "Write a cell",
    description:
      "The whole cell as docs/cell.schema.json has it, as the tool cell gives it; objects, tools, frames and programs are added or changed so. A cell that is not whole is refused, and the file stays as it was.",
    input: z.object({ cell: cellFile, document: anyJson }),
    readOnly: false,
    run: async (folder, { cell, document }) => {
      const opened = openedOf(document);
      await folder.write(cell, opened);
      return { written: cell, objects: opened.objects.length, programs: opened.programs.map(({ name }) => name) };
    },
  }),
  tool({
    name: "write_program",
    title: "Write a program into a cell",
    description:
      "A program as docs/program.schema.json has it: it replaces the one of its name, or is added, and is selected. Answers with its verdict, without repairs: those come with check.",
    input: z.object({ cell: cellFile, program: anyJson }),
    readOnly: false,
    run: async (folder, { cell, program }) => {
      const parsed = parseProgram(JSON.stringify(program));
      if (parsed.kind === "not-a-program") {
        const [first] = parsed.faults;
        throw new UseFault(
          `${first!.path ? `${first!.path}: ` : ""}${first!.sentence}`,
          more(parsed.faults.length - 1),
        );
      }
      const document = await folder.read(cell);
      if (parsed.program.robot !== document.robot.id)
        throw new UseFault(
          `The program is for ${parsed.program.robot}; the cell has ${document.robot.id}.`,
          "Give the cell's robot in the program.",
        );
      await folder.write(cell, withProgram(document, parsed.program));
      return verdictOf(folder, cell, parsed.program.name);
    },
  }),
  tool({
    name: "apply_repair",
    title: "Carry out a repair",
    description:
      'Carries out one of the repairs that check gave for a bad step: steps are replaced or added, a part or the robot is moved. "repair" is its place in the list, from 0. Answers with the new verdict.',
    input: z.object({
      cell: cellFile,
      program: programName,
      step: z.string().min(1).max(200),
      repair: z.int().min(0).max(2),
    }),
    readOnly: false,
    run: async (folder, asked) => {
      const { document, program, robot, cell } = await folder.program(asked.cell, asked.program);
      const checked = checkProgram(program, robot, { cell });
      const explanation = repairSearch(program, robot, { cell }, checked, document).explain(asked.step);
      if (!explanation)
        throw new UseFault(`Step "${asked.step}" of ${program.name} is not bad.`, "Ask check which steps are.");
      const repair = explanation.repairs[asked.repair];
      if (!repair)
        throw new UseFault(
          `Step "${asked.step}" has ${explanation.repairs.length} repairs.`,
          "Count from 0; check lists them.",
        );
      await folder.write(asked.cell, repairCell(document, program.name, asked.step, repair));
      return { applied: repair.sentence, ...(await verdictOf(folder, asked.cell, program.name)) };
    },
  }),
];

const more = (count: number): string => (count > 0 ? `${count} more of the kind.` : "");

function openedOf(document: object): CellDocument {
  const answer = readDocument(document);
  if (answer.kind === "opened") return answer.document;
  if (answer.kind === "too-new")
    throw new UseFault(`The cell is of version ${answer.version}; this release reads up to ${answer.newest}.`);
  throw new UseFault(answer.why[0] ?? "This is not a cell.", more(answer.why.length - 1));
}

function withProgram(document: CellDocument, program: Program): CellDocument {
  const at = document.programs.findIndex(({ name }) => name === program.name);
  const before = document.programs[at];
  if (before && isTextProgram(before))
    throw new UseFault(`"${program.name}" is a vendor's text of the cell.`, "Take another name.");
  return {
    ...document,
    programs: at < 0 ? [...document.programs, program] : document.programs.with(at, program),
    program: program.name,
  };
}

/** What a program is worth after a change, in short. */
async function verdictOf(folder: CellFolder, file: string, name: string): Promise<object> {
  const { program, robot, cell } = await folder.program(file, name);
  const { verdict } = checkProgram(program, robot, { cell });
  return {
    program: name,
    ok: verdict.ok,
    duration_s: verdict.duration_s,
    clearance_m: verdict.clearance_m,
    bad: verdict.steps
      .filter(step => step.verdict === "bad")
      .map(({ id, findings }) => ({ step: id, sentence: findings[0]?.sentence })),
  };
}
