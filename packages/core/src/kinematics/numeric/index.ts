export * from "./pose-error.ts";
export * from "./damped.ts";
export * from "./fabrik-points.ts";
export * from "./fabrik.ts";
export * from "./gradient-descent.ts";
export * from "./compare.ts";
