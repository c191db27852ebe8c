import type { EmittedFile, Program } from "@twincell/core";
import type { Proof } from "@twincell/languages";

/** What was exported, from which steps, and how it was proven. */
export function manifestOf(
  program: Program,
  dialect: string,
  files: readonly EmittedFile[],
  proof: Proof | null,
): string {
  return `${JSON.stringify(
    {
      format: "twincell.export",
      version: 1,
      program: program.name,
      robot: program.robot,
      dialect,
      steps: program.steps.length,
      files: files.map(file => ({
        name: file.name,
        bytes: new TextEncoder().encode(file.text).length,
        lines: file.lines.length,
        stepOfLine: file.lines,
      })),
      proof: proof ? { kind: proof.kind, sentence: proof.sentence } : null,
    },
    null,
    2,
  )}\n`;
}
