import type { Dialect, Robot, Step } from "@twincell/core";
import { executeText, joinFiles, type PatchFile } from "../patch/index.ts";

const round = (value: number): number => Math.round(value * 1000) / 1000 + 0;

/** What a project does, a line a step: motions with degrees or millimetres as its text has them, lines and waits. */
export function told(
  dialect: Dialect,
  robot: Robot,
  files: Readonly<Record<string, readonly string[]>>,
  inputs: Readonly<Record<string, boolean | number>> = {},
): { readonly does: readonly string[]; readonly notes: readonly string[]; readonly cut: string } {
  const project: PatchFile[] = Object.entries(files).map(([name, lines]) => ({ name, text: `${lines.join("\n")}\n` }));
  const main = project[0]!.name;
  const joined = joinFiles(dialect, project, main);
  const at = (line: number): string => {
    const place = joined.place(line);
    return `${project[place.file]!.name} ${place.line}`;
  };
  const answer = executeText(dialect, joined.text, main, robot, undefined, { inputs, maxSteps: 400 });
  if (answer.kind === "not-understood")
    return { does: answer.faults.map(({ line, sentence }) => `${at(line)}: ${sentence}`), notes: [], cut: "" };
  return {
    does: answer.program.steps.map(sentenceOf),
    notes: answer.notExecuted
      .filter(({ expected }) => expected !== "a value in the text")
      .map(({ line, sentence }) => `${at(line)}: ${sentence}`),
    cut: answer.cut ?? "",
  };
}

function sentenceOf(step: Step): string {
  switch (step.type) {
    case "move": {
      const { target, path, blend_m } = step;
      const place =
        "q" in target
          ? `q ${target.q.map(x => round((x / Math.PI) * 180)).join(" ")}`
          : `${target.pose.position.map(x => round(x * 1000)).join(" ")} in ${target.frame}`;
      return `${path} ${place}${blend_m > 0 ? ` within ${round(blend_m * 1000)}` : ""}${step.blend_ratio ? ` within ${round(step.blend_ratio * 100)} %` : ""}${step.until ? " until" : ""}`;
    }
    case "set":
      return `${step.signal} = ${step.to}${step.pulse_s === undefined ? "" : ` for ${step.pulse_s} s`}`;
    case "gripper":
      return step.closed ? "gripper closes" : "gripper opens";
    case "wait":
      return `wait ${round(step.s)} s`;
    case "wait-for":
      return `wait for ${JSON.stringify(step.when)}`;
    case "message":
      return `say ${step.text}`;
    default:
      return step.type;
  }
}
