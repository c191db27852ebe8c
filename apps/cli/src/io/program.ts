import { linkSolids, parseProgram, robotById, type Program } from "@twincell/core";
import { openDocument, type CellDocument } from "@twincell/project";
import { readText } from "./files.ts";
import type { RobotToRun } from "./robot.ts";
import { UseFault } from "./usage.ts";

/**
 * PROGRAM from a file; what is wrong with it is said with its place.
 *
 * @param chosen  the robot it is to run on; the one it names when absent.
 */
export async function readProgram(
  path: string,
  chosen?: RobotToRun,
): Promise<RobotToRun & { readonly program: Program }> {
  const answer = parseProgram(await readText(path));
  if (answer.kind === "not-a-program") {
    const [first] = answer.faults;
    const more = answer.faults.length - 1;
    throw new UseFault(
      `${path}: ${first!.path ? `${first!.path}: ` : ""}${first!.sentence}`,
      more > 0 ? `${more} more of the kind.` : "",
    );
  }
  const robot = chosen?.robot ?? robotById(answer.program.robot);
  if (!robot)
    throw new UseFault(
      `${path}: there is no robot "${answer.program.robot}" in the library.`,
      "See twincell robots, or name its file with --robot.",
    );
  for (const step of answer.program.steps) {
    const q = step.type === "move" && "q" in step.target ? step.target.q : undefined;
    if (q && q.length !== robot.arm.joints.length)
      throw new UseFault(
        `${path}: step ${step.id} gives ${q.length} angles; ${robot.name} has ${robot.arm.joints.length} joints.`,
      );
  }
  return { program: answer.program, robot, solids: chosen?.solids ?? (() => linkSolids(robot)) };
}

/** The saved cell a program is looked at in. */
export async function readCell(path: string): Promise<CellDocument> {
  const answer = openDocument(await readText(path));
  switch (answer.kind) {
    case "opened":
      return answer.document;
    case "too-new":
      throw new UseFault(
        `${path} is of version ${answer.version}; this release reads versions up to ${answer.newest}.`,
        "Update Twincell.",
      );
    case "not-a-cell":
      throw new UseFault(`${path}: ${answer.why[0] ?? "This is not a saved cell."}`);
  }
}
