import type { CellGeometry } from "../collision/cell.ts";

/** A solid of a contact as people call it: an object by its own name. */
export function nameOf(id: string, cell: CellGeometry): string {
  const object = cell.objects.find(candidate => candidate.id === id);
  if (object !== undefined) return `“${object.name}”`;
  return id === "tool" ? "the tool" : id;
}
