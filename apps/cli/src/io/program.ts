import { parseProgram, robotById, type Program, type Robot } from "@twincell/core";
import { openDocument, type CellDocument } from "@twincell/project";
import { readText } from "./files.ts";
import { UseFault } from "./usage.ts";

/** PROGRAM from a file; what is wrong with it is said with its place. */
export async function readProgram(path: string): Promise<{ readonly program: Program; readonly robot: Robot }> {
  const answer = parseProgram(await readText(path));
  if (answer.kind === "not-a-program") {
    const [first] = answer.faults, more = answer.faults.length - 1;
    throw new UseFault(`${path}: ${first!.path ? `${first!.path}: ` : ""}${first!.sentence}`, more > 0 ? `${more} more of the kind.` : "");
  }
  const robot = robotById(answer.program.robot);
  if (!robot) throw new UseFault(`${path}: there is no robot "${answer.program.robot}" in the library.`, "See twincell robots.");
  return { program: answer.program, robot };
}

/** The saved cell a program is looked at in. */
export async function readCell(path: string): Promise<CellDocument> {
  const answer = openDocument(await readText(path));
  switch (answer.kind) {
    case "opened": return answer.document;
    case "too-new": throw new UseFault(`${path} is of version ${answer.version}; this release reads versions up to ${answer.newest}.`, "Update Twincell.");
    case "not-a-cell": throw new UseFault(`${path}: ${answer.why[0] ?? "This is not a saved cell."}`);
  }
}
