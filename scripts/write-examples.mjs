/** Writes the example cells from their functions: node scripts/write-examples.mjs. A test holds the files to them. */
import { mkdirSync, writeFileSync } from "node:fs";
import { edgeTraceCell, saveDocument, tracedCartonCell } from "@twincell/project";

const CELLS = { "01-edge-trace": edgeTraceCell(), "02-traced-carton": tracedCartonCell() };
for (const [name, cell] of Object.entries(CELLS)) {
  const folder = new URL(`../examples/${name}/`, import.meta.url);
  mkdirSync(folder, { recursive: true });
  writeFileSync(new URL("cell.json", folder), saveDocument(cell));
}
