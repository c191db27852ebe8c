import { saveDocument, type CellDocument } from "@twincell/project";

/**
 * A number that changes with every change of the cell, to tell a recording of this cell from one of another: FNV-1a
 * over its saved text, twice with different beginnings, 64 bits together.
 *
 * @see Fowler, Noll, Vo, draft-eastlake-fnv.
 */
export function cellVersion(document: CellDocument): string {
  const text = saveDocument(document);
  let a = 0x811c9dc5;
  let b = 0x9747b28c;
  for (let i = 0; i < text.length; i++) {
    const code = text.charCodeAt(i);
    a = Math.imul(a ^ code, 0x01000193);
    b = Math.imul(b ^ code, 0x01000193);
  }
  return [a, b].map(half => (half >>> 0).toString(16).padStart(8, "0")).join("");
}
