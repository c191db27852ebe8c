import type { TriangleMesh } from "./mesh.ts";

/** The solid of one robot link, in that link's frame (link 0 is the base). */
export interface LinkSolid {
  readonly link: number;
  readonly name: string;
  readonly mesh: TriangleMesh;
}
