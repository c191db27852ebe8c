import { pose, SignalTable, Stepper, type Executed, type Step } from "@twincell/core";
import { COMMAND_GAP_S } from "@twincell/controllers";
import { given } from "../io/arguments.ts";
import { COMMANDER_HELP, COMMANDER_OPTIONS } from "../io/at.ts";
import { lineWriter } from "../io/json-lines.ts";
import { inputsFrom, ioOf, momentWriter } from "../io/moments.ts";
import { readCell } from "../io/program.ts";
import { robotOf } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";
import { projectFault, textProject, type TextProject } from "../io/text-project.ts";
import { reportSkipped } from "./parse.ts";
import { PRODUCTION_HELP, PRODUCTION_OPTIONS } from "./produce-on.ts";
import { runOn } from "./run-on.ts";

/** A text that never ends is cut here. */
const LONGEST_S = 24 * 3600;

export const runCommand: Command = {
  name: "run",
  summary: "interpret a vendor's program text, one line per period; with --on run a program on a robot",
  usage: `twincell run FILE… --robot R [--dialect D] [--cell CELL] [--period 0.01] [--inputs part=true] [--skip-unknown]
                [--leave-out-missing]
       twincell run FILE… --on HOST[:PORT] [--as-text] [--paced [--gap S]] [--despite CODES]
                [--cycles N|forever] [--breakpoint ID]… [--step] [--reload]

FILE is a program text, several of one program, a folder or ZIP of them, or a cell whose selected program is a text; a file's siblings
(program.src has its program.dat) are found beside it. Executes the text with the vendor's own conventions and writes the same lines as simulate, each with the text line under way. With --skip-unknown what is not understood is left out and named on stderr. A text that calls a program that is in none of the files is refused with file, line
and name; with --leave-out-missing such a call does nothing and is named on stderr.

With --on the program (a taught one, .json, or a text, executed to its steps) runs on a robot: planned from where it stands and checked
in its cell first. What makes the check red keeps it from being sent.

  --on HOST[:PORT]  the robot, as --at below
  --as-text         as a program of the controller's own language; its steps otherwise
  --paced           step by step: one command, its end, --gap S (default ${COMMAND_GAP_S}), the next
  --despite CODES   red findings that you have seen and send it in spite of; the guard stops it before contact all the same
${PRODUCTION_HELP}
${COMMANDER_HELP}`,
  async run(args) {
    const options = given(args, {
      ...COMMANDER_OPTIONS,
      ...PRODUCTION_OPTIONS,
      on: { type: "string" },
      "as-text": { type: "boolean" },
      paced: { type: "boolean" },
      gap: { type: "string" },
      despite: { type: "string" },
      dialect: { type: "string" },
      cell: { type: "string" },
      period: { type: "string" },
      inputs: { type: "string" },
      "skip-unknown": { type: "boolean" },
      "leave-out-missing": { type: "boolean" },
      json: { type: "boolean" },
    });
    if (options.text("on") !== undefined)
      return runOn({ ...options, text: name => options.text(name === "at" ? "on" : name) });
    const period_s = options.number("period") ?? 0.01;
    const cellPath = options.text("cell");
    if (!(period_s >= 1e-4)) throw new UseFault(`--period wants at least 0.0001 s, not ${period_s}.`);
    const { robot } = await robotOf(options);
    const project = await textProject(options.positionals, options.text("dialect"));
    const { dialect, joined } = project;
    const path = project.placeOf(1).path;
    const worldFromBase =
      cellPath === undefined
        ? (project.cell?.robot.worldFromBase ?? pose<"world", "base">())
        : (await readCell(cellPath)).robot.worldFromBase;
    const interpreted = dialect.interpret(joined.text, robot, worldFromBase, {
      skipUnknown: options.flag("skip-unknown"),
      ...(options.flag("leave-out-missing") ? { missingPrograms: "leave-out" as const } : {}),
    });
    if (interpreted.kind === "not-understood") throw projectFault(project, interpreted.faults);
    reportSkipped(
      path,
      (interpreted.skipped ?? []).map(each => ({ ...each, line: project.placeOf(each.line).line })),
    );
    for (const { line, sentence } of interpreted.notExecuted ?? [])
      process.stderr.write(`twincell: ${placeText(project, line)}: ${sentence}\n`);

    const seen = new Map<string, { readonly line: number; readonly tool: string }>();
    let tool = "flange";
    function* steps(run: Iterator<Executed, void>): Generator<Step> {
      for (let next = run.next(); !next.done; next = run.next()) {
        const { line, step } = next.value;
        if (!step) continue;
        if (step.type === "move") tool = step.target.tool ?? "flange";
        seen.set(step.id, { line, tool });
        yield step;
      }
    }
    const signals = new SignalTable(Object.entries(inputsFrom(options.text("inputs"))));
    const stepper = new Stepper(
      robot,
      { ...interpreted.context, worldFromBase },
      steps(interpreted.run(signals)),
      robot.home_rad,
      { signals },
    );
    const moment = momentWriter(robot, worldFromBase, interpreted.context.tools, step => seen.get(step)?.tool ?? tool);
    const writer = lineWriter();
    const q = Float64Array.from(robot.home_rad);
    writer.write({ ...moment(0, q, ioOf(false, {}, signals.all), ""), line: 0 });
    for (let i = 1; i * period_s < LONGEST_S; i++) {
      const now = stepper.advance(period_s, 1, q);
      writer.write({
        ...moment(i * period_s, q, ioOf(now.gripperClosed, {}, signals.all), now.step),
        line: seen.get(now.step)?.line ?? 0,
      });
      if (now.kind === "running") continue;
      await writer.end();
      if (now.kind !== "fault" || !now.fault) return 0;
      process.stderr.write(
        `twincell: ${placeText(project, seen.get(now.fault.step)?.line ?? 1)}: ${now.fault.sentence} ${now.fault.hint}\n`,
      );
      return 1;
    }
    await writer.end();
    process.stderr.write(`twincell: ${path} was still running after ${LONGEST_S / 3600} hours of its own time.\n`);
    return 1;
  },
};

function placeText(project: TextProject, at: number): string {
  const { path, line } = project.placeOf(at);
  return `${path}, line ${line}`;
}
