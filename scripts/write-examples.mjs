/** Writes the example cells from their functions: node scripts/write-examples.mjs. A test holds the files to them. */
import { writeFileSync } from "node:fs";
import { edgeTraceCell, saveDocument } from "@twincell/project";

writeFileSync(new URL("../examples/01-edge-trace/cell.json", import.meta.url), saveDocument(edgeTraceCell()));
