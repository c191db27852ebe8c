import { existsSync } from "node:fs";
import { expect, test } from "vitest";
import { PAGE_OF } from "./docs.ts";

test("every mode's page of the documentation has its text in docs/", () => {
  const source = (page: string): URL =>
    new URL(
      `../../../../docs/${page.endsWith("/") ? `${page}README.md` : page.replace(/\.html$/, ".md")}`,
      import.meta.url,
    );
  expect(Object.keys(PAGE_OF).sort()).toEqual(["cell", "check", "history", "run", "teach"]);
  expect(Object.values(PAGE_OF).filter(page => !existsSync(source(page)))).toEqual([]);
});
