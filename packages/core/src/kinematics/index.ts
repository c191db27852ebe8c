export * from "./forward.ts";
export * from "./branch.ts";
export * from "./reach.ts";
export * from "./ortho-parallel.ts";
export * from "./inverse.ts";
export * from "./span.ts";
export * from "./singularity.ts";
export * from "./explain.ts";
