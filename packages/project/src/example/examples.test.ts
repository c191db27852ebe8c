import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { parseProgram, serializeProgram } from "@twincell/core";
import { EXAMPLES, openDocument, recordedAsJoints, saveDocument, tracedCartonCell } from "../index.ts";

const fileText = (path: string): string =>
  readFileSync(new URL(`../../../../examples/${path}`, import.meta.url), "utf8");

test.each(EXAMPLES.map(({ id, make }) => [id, make()] as const))(
  "example %s is what its function makes and opens; after a change run scripts/write-examples.mjs",
  (name, cell) => {
    const text = fileText(`${name}/cell.json`);
    expect(text).toBe(saveDocument(cell));
    expect(openDocument(text)).toEqual({ kind: "opened", document: cell, lifted: [] });
  },
);

test("the example program is the traced one, recorded as joint angles, and needs no cell", () => {
  const traced = tracedCartonCell();
  const program = recordedAsJoints(traced, traced.programs[0]!);
  const text = fileText("01-edge-trace/program.json");
  expect(text).toBe(serializeProgram(program));
  expect(parseProgram(text)).toEqual({ kind: "program", program });
});
