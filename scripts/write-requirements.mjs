/** Writes docs/requirements.md from docs/requirements.json and the tests' titles. A test holds the file to it. */
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { requirementsPage, TEST_FOLDERS, testsByRow } from "./requirements/rows.ts";

const root = fileURLToPath(new URL("..", import.meta.url));
const rows = JSON.parse(readFileSync(`${root}docs/requirements.json`, "utf8"));
writeFileSync(`${root}docs/requirements.md`, requirementsPage(rows, testsByRow(root, TEST_FOLDERS)));
