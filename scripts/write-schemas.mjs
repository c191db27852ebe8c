/**
 * Writes docs/recording/*.schema.json, the schemas that stand in every recording, and docs/cell.schema.json: node
 * scripts/write-schemas.mjs. A test holds the files to them.
 */
import { mkdirSync, writeFileSync } from "node:fs";
import { cellJsonSchema } from "@twincell/project";
import { TOPICS } from "@twincell/recording";

const folder = new URL("../docs/recording/", import.meta.url);
mkdirSync(folder, { recursive: true });
for (const { schema } of TOPICS) {
  if (schema.encoding === "jsonschema")
    writeFileSync(
      new URL(`${schema.name}.schema.json`, folder),
      `${JSON.stringify(JSON.parse(schema.text), null, 2)}\n`,
    );
}
writeFileSync(new URL("../docs/cell.schema.json", import.meta.url), `${JSON.stringify(cellJsonSchema(), null, 2)}\n`);
