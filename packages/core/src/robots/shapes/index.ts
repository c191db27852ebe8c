export * from "./form.ts";
export { linkName, linkDesigns, linkShapes, linkSolids } from "./shapes.ts";
export type { LinkPart, LinkShape, PartMaterial } from "./link-shape.ts";
