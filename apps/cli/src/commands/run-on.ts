import { runPaced, COMMAND_GAP_S } from "@twincell/controllers";
import { unrolled, type CommandOutcome, type Program, type RobotController } from "@twincell/core";
import { executeText } from "@twincell/languages";
import { nodeScheduler } from "@twincell/server";
import type { Given } from "../io/arguments.ts";
import { commandAt } from "../io/at.ts";
import { readProgram } from "../io/program.ts";
import { projectFault, textProject } from "../io/text-project.ts";
import { UseFault } from "../io/usage.ts";
import { codesOf } from "../io/one-step.ts";
import { cyclesOf, isProduction, produceOn } from "./produce-on.ts";

/** A taught program, or a vendor's text executed to its steps, run on a robot. */
export async function runOn(options: Given): Promise<number> {
  const gap_s = options.number("gap") ?? COMMAND_GAP_S;
  const isPaced = options.flag("paced") || options.number("gap") !== undefined;
  if (!(gap_s >= 0)) throw new UseFault(`--gap wants 0 s or more, not ${gap_s}.`);
  if (isPaced && options.flag("as-text")) throw new UseFault("--paced sends steps one by one.", "Leave --as-text out.");
  if (isPaced && isProduction(options))
    throw new UseFault(
      "--paced sends one program step by step.",
      "Leave --cycles, --step, --breakpoint and --reload out.",
    );
  cyclesOf(options);
  const [path] = options.positionals;
  if (path === undefined) throw new UseFault("FILE is missing.", "Give a program (.json) or a vendor's program text.");
  const taught = /\.json$/i.test(path) && options.positionals.length === 1;
  return commandAt(options, async (at, ask) => {
    const { info, robot, client } = at;
    const station = info.id;
    const taughtIn = async (file: string): Promise<Program> =>
      (await readProgram(file, { robot, solids: () => [] })).program;
    const program = taught ? await taughtIn(path) : await executed(options, robot);
    const despite = codesOf(options);
    if (isProduction(options)) {
      const again = taught ? taughtIn : (): Promise<Program> => executed(options, robot);
      return produceOn(
        options,
        at,
        ask,
        () => client.stop(station),
        program,
        file => (/\.json$/i.test(file) ? taughtIn(file) : again(file)),
      );
    }
    if (!isPaced) return ask({ type: "run", station, program, asText: options.flag("as-text"), despite });
    // Steps go out one by one: what the connection cannot be told is known before the first.
    const taken = await ask({ type: "takes", station, program });
    if (taken.kind !== "done") return taken;
    const paced = await runPaced(unrolled(program), program, {
      scheduler: nodeScheduler,
      gap_s,
      robot: stepwise(program, step => ask({ type: "run", station, program: step, asText: false, despite })),
    });
    const gaps = paced.sent_s.slice(1).map((sent_s, i) => sent_s - paced.ended_s[i]!);
    if (gaps.length > 0)
      process.stderr.write(
        `${paced.sent_s.length} commands, ${((1000 * gaps.reduce((sum, gap) => sum + gap, 0)) / gaps.length).toFixed(3)} ms from the end of one to the next on average.\n`,
      );
    return paced.outcome;
  });
}

async function executed(options: Given, robot: RobotController["robot"]): Promise<Program> {
  const project = await textProject(options.positionals, options.text("dialect"));
  const answer = executeText(project.dialect, project.joined.text, project.placeOf(1).path, robot);
  if (answer.kind === "not-understood") throw projectFault(project, answer.faults);
  if (answer.cut !== undefined)
    throw new UseFault(answer.cut, "A text that does not end is run by its own controller.");
  return answer.program;
}

/**
 * As much of a controller as a paced run needs: each step goes out as a program of its own, which is planned and
 * checked by itself.
 */
function stepwise(program: Program, send: (program: Program) => Promise<CommandOutcome>): Pick<RobotController, "run"> {
  return {
    run: steps => send({ ...program, steps: [...steps] }),
  };
}
