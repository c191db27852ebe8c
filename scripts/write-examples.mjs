/** Writes the examples from their functions: node scripts/write-examples.mjs. A test holds the files to them. */
import { mkdirSync, writeFileSync } from "node:fs";
import { serializeProgram } from "@twincell/core";
import { conveyorPalletCell, edgeTraceCell, recordedAsJoints, saveDocument, tracedCartonCell } from "@twincell/project";

const traced = tracedCartonCell();
const FILES = {
  "01-edge-trace/cell.json": saveDocument(edgeTraceCell()),
  "01-edge-trace/program.json": serializeProgram(recordedAsJoints(traced, traced.programs[0])),
  "02-traced-carton/cell.json": saveDocument(traced),
  "03-conveyor-pallet/cell.json": saveDocument(conveyorPalletCell()),
  "03-conveyor-pallet/program.json": serializeProgram(conveyorPalletCell().programs[0]),
};
for (const [name, text] of Object.entries(FILES)) {
  const file = new URL(`../examples/${name}`, import.meta.url);
  mkdirSync(new URL(".", file), { recursive: true });
  writeFileSync(file, text);
}
