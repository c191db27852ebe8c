import { identity, reachReport, reachTable } from "@twincell/core";
import { given } from "../io/arguments.ts";
import { writeOne } from "../io/output.ts";
import { readCell, readProgram } from "../io/program.ts";
import { programRobot, ROBOT_HELP, ROBOT_OPTIONS } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const reachCommand: Command = {
  name: "reach",
  summary: "which taught points a robot reaches, in how many postures, with how much room",
  usage: `twincell reach PROGRAM [--cell CELL] [--robot R] [--table FILE]

Writes {"robot","points":[{"step","name","position_m","postures","room":{"joint","value"},"sentence"}],"reached","leastRoom"}: for
every taught point the postures that bring the tool there inside the limits, and the joint that is nearest to a limit in the
best of them [rad; m of a slide]; or why there is none. The points alone: the way between them and what stands there are
judged by check. Ends with 1 when a point is not reached.

  --cell CELL     the saved cell that says where the robot stands
  --table FILE    the same as CSV, in mm and degrees

${ROBOT_HELP}`,
  async run(args) {
    const options = given(args, { ...ROBOT_OPTIONS, cell: { type: "string" }, table: { type: "string" } });
    const [path] = options.positionals;
    if (path === undefined) throw new UseFault("PROGRAM is missing.", "Give the path of a program file.");
    const cellPath = options.text("cell");
    const table = options.text("table");
    const { program, robot } = await readProgram(path, await programRobot(options));
    const stand = cellPath === undefined ? identity<"world", "base">() : (await readCell(cellPath)).robot.worldFromBase;
    const report = reachReport(program, robot, stand);
    if (table !== undefined) await writeOne(table, reachTable(report));
    process.stdout.write(`${JSON.stringify(report)}\n`);
    process.stderr.write(`${report.reached} of ${report.points.length} points are reached.\n`);
    return report.reached === report.points.length ? 0 : 1;
  },
};
