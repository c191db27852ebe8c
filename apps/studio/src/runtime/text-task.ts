import { robotById, type Step, type TextFault } from "@twincell/core";
import { dialectById, executeText, findPoints, joinFiles, NOT_GIVEN, touchUpPoint } from "@twincell/languages";
import type { FromTextWorker, ReadTextProgram, TextFinding, ToTextWorker } from "../workers/text-messages.ts";

/** The body of the text worker: a text is read and executed, or one of its points rewritten. Pure. */
export function textTask(task: ToTextWorker): FromTextWorker {
  const { id, language, files, main, worldFromBase } = task;
  const dialect = dialectById(language);
  const robot = robotById(task.robot);
  if (!dialect || !robot)
    return { kind: "trouble", id, sentence: `There is no language “${language}” for the robot “${task.robot}”.` };
  if (task.kind === "touch-up") {
    const { point, move, context, q_rad } = task;
    return {
      kind: "touched-up",
      id,
      touched: touchUpPoint(dialect, files, point, move, context, robot, q_rad, worldFromBase),
    };
  }
  const points = findPoints(language, files);
  const joined = joinFiles(dialect, files, main);
  const executed = executeText(dialect, joined.text, task.name, robot, worldFromBase, {
    // It is asked before such a text runs: see `assumed`.
    missingPrograms: "leave-out",
  });
  const at = (line: number) => joined.place(line);
  if (executed.kind === "not-understood") {
    const findings = executed.faults.map(
      ({ line, sentence }): TextFinding => ({ ...at(line), verdict: "bad", sentence }),
    );
    return { kind: "read", id, read: { points, program: null, places: [], findings, assumed: [] } };
  }
  const found = points.kind === "found" ? points.points : [];
  const named = executed.program.steps.map((step): Step => {
    const { file, line } = at(executed.lines.get(step.id)!);
    const point = found.find(each => each.uses.some(use => use.whole && use.file === file && use.motionLine === line));
    return { ...step, name: point === undefined || point.name === "" ? step.id : point.name };
  });
  const warned = ({ line, sentence }: TextFault): TextFinding => ({ ...at(line), verdict: "warn", sentence });
  const cut = /^Line (\d+)/.exec(executed.cut ?? "");
  const read: ReadTextProgram = {
    points,
    program: { ...executed.program, steps: named },
    places: [...executed.lines].map(([step, line]) => [step, at(line)] as const),
    findings: [
      ...executed.skipped.map(({ line, sentence }): TextFinding => ({ ...at(line), verdict: "warn", sentence })),
      ...executed.notExecuted.map(warned),
      ...(executed.cut === undefined || cut === null
        ? []
        : [{ ...at(Number(cut[1])), verdict: "warn" as const, sentence: executed.cut }]),
    ],
    assumed: executed.notExecuted.filter(({ expected }) => expected === NOT_GIVEN).map(warned),
  };
  return { kind: "read", id, read };
}
