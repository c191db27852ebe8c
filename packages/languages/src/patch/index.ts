export * from "./find.ts";
export * from "./execute.ts";
export * from "./project.ts";
export * from "./touch-up.ts";
export { applyEdits, type TextEdit } from "./rewrite.ts";
export type { FoundPoints, PatchFile, PointField, PointUse, TextPoint, TextSpan } from "./points.ts";
