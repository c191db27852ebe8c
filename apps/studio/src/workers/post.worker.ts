import "./know-robots.ts";
import { robotById } from "@twincell/core";
import { dialectById, dialectInForm, proveText, runnableFile } from "@twincell/languages";
import { writeProgram } from "../runtime/run/written-program.ts";
import type { FromPoster, ToPoster } from "./post-messages.ts";

const answer = (message: FromPoster): void => {
  postMessage(message);
};

addEventListener(
  "message",
  ({ data: { id, dialect: name, form, program, robot: robotId, worldFromBase, prove } }: MessageEvent<ToPoster>) => {
    try {
      const whole = name === null ? null : dialectById(name);
      const inForm = whole && form !== null ? dialectInForm(whole, form) : undefined;
      const dialect = inForm ?? whole;
      const robot = robotById(robotId);
      if (dialect === undefined || !robot) {
        answer({ kind: "trouble", id, sentence: `There is no language “${name}” for the robot “${robotId}”.` });
        return;
      }
      const written = writeProgram(dialect, program, robot, worldFromBase);
      const { emitted } = written;
      answer({ kind: "written", id, written });
      if (!prove) return;
      const runnable = dialect && emitted?.kind === "emitted" ? runnableFile(dialect, emitted.files) : undefined;
      answer({
        kind: "proven",
        id,
        proof:
          dialect && runnable
            ? proveText(dialect, runnable, inForm?.form.said(written.program) ?? written.program, robot, worldFromBase)
            : null,
      });
    } catch (problem) {
      answer({
        kind: "trouble",
        id,
        sentence: problem instanceof Error ? problem.message : String(problem),
      });
    }
  },
);
