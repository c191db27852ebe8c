import { robotById } from "@twincell/core";
import { dialectById, proveText, runnableFile } from "@twincell/languages";
import type { FromPoster, ToPoster } from "./post-messages.ts";

const answer = (message: FromPoster): void => { postMessage(message); };

addEventListener("message", ({ data: { id, dialect: name, program, robot: robotId, worldFromBase } }: MessageEvent<ToPoster>) => {
  try {
    const dialect = dialectById(name), robot = robotById(robotId);
    if (!dialect || !robot) { answer({ kind: "trouble", id, sentence: `There is no language “${name}” for the robot “${robotId}”.` }); return; }
    const emitted = dialect.emit(program, robot, worldFromBase);
    const runnable = emitted.kind === "emitted" ? runnableFile(dialect, emitted.files) : undefined;
    answer({ kind: "posted", id, emitted, proof: runnable ? proveText(dialect, runnable, program, robot, worldFromBase) : null });
  } catch (trouble) {
    answer({ kind: "trouble", id, sentence: trouble instanceof Error ? trouble.message : String(trouble) });
  }
});
