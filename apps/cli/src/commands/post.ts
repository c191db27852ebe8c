import { pose, withBranches, type Dialect } from "@twincell/core";
import { dialectInForm, proveText, runnableFile } from "@twincell/languages";
import { given } from "../io/arguments.ts";
import { dialectOf } from "../io/dialect.ts";
import { writeWhole } from "../io/output.ts";
import { readCell, readProgram } from "../io/program.ts";
import { programRobot, ROBOT_HELP, ROBOT_OPTIONS } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const postCommand: Command = {
  name: "post",
  summary: "a program in a controller's own language",
  usage: `twincell post PROGRAM --to DIALECT -o DIR [--form F] [--robot R] [--cell CELL]

Writes the files into DIR, all of them or none, and tells on standard output what they are. The program text is executed by the
dialect's own interpreter and compared with the plan first; text that does not say the same is not written (exit 1).

  --form F        another text that the controller takes: with --to krl, axis-list is the list PTP_AXIS of joint motions
  --robot R       the robot to write it for; the one the program names when absent
  --cell CELL     where the robot stands (default: in the origin)

${ROBOT_HELP}`,
  async run(args) {
    const options = given(args, {
      ...ROBOT_OPTIONS,
      to: { type: "string" },
      out: { type: "string", short: "o" },
      cell: { type: "string" },
      form: { type: "string" },
      json: { type: "boolean" },
    });
    const [path] = options.positionals;
    const folder = options.text("out");
    const cellPath = options.text("cell");
    if (path === undefined) throw new UseFault("PROGRAM is missing.", "Give the path of a program file.");
    if (folder === undefined) throw new UseFault("-o DIR is missing.", "Give the folder to write to.");
    const whole = dialectOf("to", options.text("to"));
    const wanted = options.text("form");
    const inForm = wanted === undefined ? undefined : dialectInForm(whole, wanted);
    if (wanted !== undefined && !inForm) throw noForm(whole, wanted);
    const dialect = inForm ?? whole;
    const { program: taught, robot } = await readProgram(path, await programRobot(options));
    const worldFromBase =
      cellPath === undefined ? pose<"world", "base">() : (await readCell(cellPath)).robot.worldFromBase;

    // A controller takes the nearest posture: where the checked plan takes another one, the text says so.
    const program = withBranches(taught, robot, { where: "needed", worldFromBase });
    const emitted = dialect.emit(program, robot, worldFromBase);
    if (emitted.kind === "cannot") {
      process.stderr.write(
        `twincell: ${emitted.step ? `Step ${emitted.step}: ` : ""}${emitted.sentence} ${emitted.hint}\n`,
      );
      return 1;
    }
    const runnable = runnableFile(dialect, emitted.files);
    const proofs =
      runnable === undefined
        ? []
        : [proveText(dialect, runnable, inForm?.form.said(program) ?? program, robot, worldFromBase)];
    const wrong = proofs.find(proof => proof.kind !== "proven");
    if (wrong) {
      process.stderr.write(`twincell: ${wrong.sentence} Nothing was written.\n`);
      return 1;
    }
    const paths = await writeWhole(folder, emitted.files);
    process.stdout.write(
      `${JSON.stringify({ dialect: dialect.id, files: paths, warnings: emitted.warnings, proof: proofs.flatMap(proof => (proof.kind === "proven" ? [{ file: proof.file, worst_m: proof.worst_m, worst_rad: proof.worst_rad }] : [])) })}\n`,
    );
    return 0;
  },
};

function noForm({ id, forms = [] }: Dialect, wanted: string): UseFault {
  const known = forms.map(form => form.id);
  return new UseFault(
    `${id} has no form "${wanted}".`,
    known.length > 0 ? `Forms: ${known.join(", ")}.` : "Leave --form out.",
  );
}
