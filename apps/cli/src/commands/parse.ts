import { serializeProgram, type Skipped, type TextFault } from "@twincell/core";
import { given } from "../io/arguments.ts";
import { dialectOf } from "../io/dialect.ts";
import { readText } from "../io/files.ts";
import { robotOf, ROBOT_OPTIONS } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const parseCommand: Command = {
  name: "parse",
  summary: "a vendor's program text as a neutral program",
  usage: `twincell parse FILE --robot R [--dialect D] [--skip-unknown]

Writes PROGRAM. The dialect is taken from the file's ending when it is not named. What is not understood is said with line and column; with --skip-unknown it is left out, and every place is named on stderr, motions and branches too.`,
  async run(args) {
    const options = given(args, {
      ...ROBOT_OPTIONS,
      dialect: { type: "string" },
      "skip-unknown": { type: "boolean" },
      json: { type: "boolean" },
    });
    const [path] = options.positionals;
    if (path === undefined) throw new UseFault("FILE is missing.", "Give the path of a program text.");
    const { robot } = await robotOf(options);
    const dialect = dialectOf("dialect", options.text("dialect"), path);
    const parsed = dialect.parse(await readText(path), robot, undefined, { skipUnknown: options.flag("skip-unknown") });
    if (parsed.kind === "not-understood") throw notUnderstood(path, parsed.faults);
    reportSkipped(path, parsed.skipped ?? []);
    for (const warning of parsed.warnings)
      process.stderr.write(`twincell: ${path}, line ${warning.line}: ${warning.sentence}\n`);
    process.stdout.write(`${serializeProgram(parsed.program)}\n`);
    return 0;
  },
};

/** Every place that was left out, and whether a motion or a branch is missing. */
export function reportSkipped(path: string, skipped: readonly Skipped[]): void {
  for (const { line, column, sentence } of skipped)
    process.stderr.write(`twincell: ${path}, line ${line}, column ${column}: ${sentence}\n`);
  const missing = skipped.filter(({ what }) => what !== "statement").length;
  if (missing > 0)
    process.stderr.write(
      `twincell: ${path}: ${missing} of ${skipped.length} places left out ${missing === 1 ? "is a motion or a branch" : "are motions or branches"}: the robot does not do what the text says.\n`,
    );
}

export const notUnderstood = (path: string, faults: readonly TextFault[]): UseFault => {
  const [first] = faults;
  return new UseFault(
    `${path}, line ${first?.line ?? 0}, column ${first?.column ?? 0}: ${first?.sentence ?? "The text cannot be read."}`,
    faults.length > 1 ? `${faults.length - 1} more of the kind.` : "",
  );
};
