export { linkName, linkDesigns, linkShapes, linkSolids } from "./shapes.ts";
export type { LinkPart, LinkShape } from "./link-shape.ts";
