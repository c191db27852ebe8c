export { linkName, linkShapes, linkSolids } from "./shapes.ts";
export type { LinkPart, LinkShape, PartMaterial } from "./link-shape.ts";
