import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { edgeTraceCell, saveDocument } from "../index.ts";

test("the example file is what its function makes; after a change run scripts/write-examples.mjs", () => {
  expect(readFileSync(new URL("../../../../examples/01-edge-trace/cell.json", import.meta.url), "utf8")).toBe(saveDocument(edgeTraceCell()));
});
