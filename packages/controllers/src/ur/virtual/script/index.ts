export { readScript, LONGEST_SCRIPT, type ScriptRead } from "./read.ts";
export { Machine, type MachineState } from "./machine.ts";
export { ScriptError, type ScriptFault } from "./fault.ts";
export type { Arguments, ScriptFunction } from "./functions.ts";
export type { Script } from "./tree.ts";
export * from "./values.ts";
export * from "./pose.ts";
