/** Writes the examples from their functions: node scripts/write-examples.mjs. A test holds the files to them. */
import { mkdirSync, writeFileSync } from "node:fs";
import { serializeProgram } from "@twincell/core";
import { EXAMPLES, recordedAsJoints, saveDocument, tracedCartonCell } from "@twincell/project";

const traced = tracedCartonCell();
const FILES = {
  ...Object.fromEntries(EXAMPLES.map(({ id, make }) => [`${id}/cell.json`, saveDocument(make())])),
  ...Object.fromEntries(
    EXAMPLES.filter(({ check, id }) => check !== "empty" && id !== "02-traced-carton").map(({ id, make }) => [
      `${id}/program.json`,
      serializeProgram(make().programs[0]),
    ]),
  ),
  "01-edge-trace/program.json": serializeProgram(recordedAsJoints(traced, traced.programs[0])),
};
for (const [name, text] of Object.entries(FILES)) {
  const file = new URL(`../examples/${name}`, import.meta.url);
  mkdirSync(new URL(".", file), { recursive: true });
  writeFileSync(file, text);
}
