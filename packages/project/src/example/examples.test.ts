import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { edgeTraceCell, openDocument, saveDocument, tracedCartonCell } from "../index.ts";

test.each([["01-edge-trace", edgeTraceCell()], ["02-traced-carton", tracedCartonCell()]] as const)("example %s is what its function makes and opens; after a change run scripts/write-examples.mjs", (name, cell) => {
  const text = readFileSync(new URL(`../../../../examples/${name}/cell.json`, import.meta.url), "utf8");
  expect(text).toBe(saveDocument(cell));
  expect(openDocument(text)).toEqual({ kind: "opened", document: cell, lifted: [] });
});
