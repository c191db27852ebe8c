import { existsSync, readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { TOPICS } from "./index.ts";

test("T-54 the schemas in docs/recording are those in the file", () => {
  for (const { topic, schema } of TOPICS) {
    if (schema.encoding !== "jsonschema") continue;
    const file = new URL(`../../../docs/recording/${schema.name}.schema.json`, import.meta.url);
    expect(existsSync(file), `${topic}: run node scripts/write-schemas.mjs`).toBe(true);
    expect(JSON.parse(readFileSync(file, "utf8")), topic).toEqual(JSON.parse(schema.text));
  }
});
