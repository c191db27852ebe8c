import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { DIALECTS, vendorTables } from "./index.ts";

test("docs/vendors.md says what the dialects declare; after a change run scripts/write-vendors.mjs", () => {
  expect(readFileSync(new URL("../../../docs/vendors.md", import.meta.url), "utf8")).toContain(
    `<!-- tables -->\n\n${vendorTables(DIALECTS)}\n\n<!-- end of tables -->`,
  );
});

test("ids are unique, and every refusal has its reason", () => {
  expect(new Set(DIALECTS.map(dialect => dialect.id)).size).toBe(DIALECTS.length);
  for (const { what, because } of DIALECTS.flatMap(dialect => dialect.cannot)) {
    expect(what).not.toBe("");
    expect(because).toMatch(/\.$/);
  }
});
