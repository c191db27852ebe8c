import type { PartMaterial } from "../../model/form.ts";
import type { TriangleMesh } from "../../mesh/mesh.ts";

/** One drawn part of a link. */
export interface LinkPart {
  readonly name: string;
  readonly material: PartMaterial;
  /** `#rrggbb` in place of the material's colour. */
  readonly color?: string;
  readonly mesh: TriangleMesh;
}

/** What is drawn of one link, in the frame of that link (link 0 is the base). */
export interface LinkShape {
  readonly link: number;
  readonly name: string;
  readonly parts: readonly LinkPart[];
}

/** A link as its author makes it: drawn parts, and convex shells that together enclose them. Both in one frame. */
export interface LinkDesign {
  readonly parts: readonly LinkPart[];
  readonly shells: readonly TriangleMesh[];
}
