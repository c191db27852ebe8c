export * from "./runner.ts";
export { textSteps, type TextSteps } from "./text.ts";
export { TextRun } from "./text-run.ts";
export * from "./lines.ts";
