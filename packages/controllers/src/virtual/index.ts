export * from "./controller.ts";
export * from "./execution.ts";
export { executeSteps } from "./stepping.ts";
