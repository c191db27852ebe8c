import { serializeProgram, type TextFault } from "@twincell/core";
import { given } from "../io/arguments.ts";
import { dialectOf } from "../io/dialect.ts";
import { readText } from "../io/files.ts";
import { robotOf, ROBOT_OPTIONS } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const parseCommand: Command = {
  name: "parse",
  summary: "a vendor's program text as a neutral program",
  usage: `twincell parse FILE --robot R [--dialect D]

Writes PROGRAM. The dialect is taken from the file's ending when it is not named. What is not understood is said with line and column.`,
  async run(args) {
    const options = given(args, { ...ROBOT_OPTIONS, dialect: { type: "string" }, json: { type: "boolean" } });
    const [path] = options.positionals;
    if (path === undefined) throw new UseFault("FILE is missing.", "Give the path of a program text.");
    const { robot } = await robotOf(options), dialect = dialectOf("dialect", options.text("dialect"), path);
    const parsed = dialect.parse(await readText(path), robot);
    if (parsed.kind === "not-understood") throw notUnderstood(path, parsed.faults);
    for (const warning of parsed.warnings) process.stderr.write(`twincell: ${path}, line ${warning.line}: ${warning.sentence}\n`);
    process.stdout.write(`${serializeProgram(parsed.program)}\n`);
    return 0;
  },
};

export const notUnderstood = (path: string, faults: readonly TextFault[]): UseFault => {
  const [first] = faults;
  return new UseFault(`${path}, line ${first?.line ?? 0}, column ${first?.column ?? 0}: ${first?.sentence ?? "The text cannot be read."}`, faults.length > 1 ? `${faults.length - 1} more of the kind.` : "");
};
