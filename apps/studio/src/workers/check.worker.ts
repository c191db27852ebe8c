import "./know-robots.ts";
import { checkProgram, pathPieces, robotById, type CellGeometry } from "@twincell/core";
import type { FromChecker, ToChecker } from "./check-messages.ts";

let cell: CellGeometry | undefined;
const answer = (message: FromChecker): void => {
  postMessage(message);
};
/** Often enough for a bar, seldom enough to cost nothing. */
const TELL_EVERY_MS = 60;

addEventListener("message", ({ data }: MessageEvent<ToChecker>) => {
  const { id, program } = data;
  const began = performance.now();
  try {
    cell = data.cell ?? cell;
    const robot = robotById(data.robot);
    if (!robot || !cell) {
      answer({ kind: "trouble", id, sentence: `The library has no robot called “${data.robot}”.` });
      return;
    }
    let told = began;
    const checked = checkProgram(program, robot, {
      cell,
      margin_m: data.margin_m,
      onProgress: share => {
        if (performance.now() - told > TELL_EVERY_MS) {
          told = performance.now();
          answer({ kind: "progress", id, share });
        }
      },
    });
    answer({
      kind: "checked",
      id,
      verdict: checked.verdict,
      plan: checked.plan,
      carried: checked.carried,
      path: pathPieces(checked, program, robot, cell),
      took_ms: performance.now() - began,
    });
  } catch (problem) {
    answer({
      kind: "trouble",
      id,
      sentence: problem instanceof Error ? problem.message : String(problem),
    });
  }
});
