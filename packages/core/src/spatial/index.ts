export * from "./vector.ts";
export * from "./quaternion.ts";
export * from "./pose.ts";
export * from "./units.ts";
export * from "./sine-cosine.ts";
export * from "./turns.ts";
export * from "./conventions.ts";
export * from "./mirror.ts";
