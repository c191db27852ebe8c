export type { NotUnderstood } from "./refusal.ts";
export * from "./mesh/stl.ts";
export * from "./mesh/obj.ts";
export * from "./mesh/ply.ts";
export type { MeshRead, MeshReport } from "./mesh/report.ts";
export * from "./urdf/model.ts";
export { readUrdf } from "./urdf/read.ts";
export { armFromUrdf, defaultTip, type PlacedShape, type UrdfChain } from "./urdf/chain.ts";
export * from "./urdf/solids.ts";
