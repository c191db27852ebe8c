import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";
import { requirementsPage, rowsIn, TEST_FOLDERS, testsByRow, titlesOf, type Requirement } from "./rows.ts";

const root = fileURLToPath(new URL("../../", import.meta.url));
const rows = JSON.parse(readFileSync(`${root}docs/requirements.json`, "utf8")) as Record<string, Requirement>;

test("docs/requirements.md is what the tests' titles say now (node scripts/write-requirements.mjs)", () => {
  const page = requirementsPage(rows, testsByRow(root, TEST_FOLDERS));
  expect(readFileSync(`${root}docs/requirements.md`, "utf8") === page).toBe(true);
});

test("every row that a test names is one of the 337", () => {
  expect(Object.keys(rows)).toHaveLength(337);
  expect([...testsByRow(root, TEST_FOLDERS).keys()].filter(id => rows[id] === undefined)).toEqual([]);
});

test("ranges are written out, and titles are found over line ends", () => {
  expect(rowsIn("T-01…T-03, L-50 … L-52 and X-13")).toEqual(["T-01", "T-02", "T-03", "L-50", "L-51", "L-52", "X-13"]);
  expect(titlesOf('test.each([1])(\n  "N-45 a title",\n  () => {});\ndescribe(`M-10 another`, () => {});')).toEqual([
    "N-45 a title",
    "M-10 another",
  ]);
});
