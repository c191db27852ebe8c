import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, expect, test } from "vitest";
import { siteFiles } from "./site-files.ts";

const folder = mkdtempSync(join(tmpdir(), "twincell-site-"));
const studio = join(folder, "studio");
const docs = join(folder, "docs");
for (const [each, text] of [
  [studio, "the studio"],
  [docs, "the documentation"],
] as const) {
  mkdirSync(join(each, "assets"), { recursive: true });
  writeFileSync(join(each, "index.html"), text);
  writeFileSync(join(each, "assets/a.js"), `// of ${text}`);
}
afterAll(() => {
  rmSync(folder, { recursive: true });
});

test("the documentation stands under /docs/, the studio everywhere else", async () => {
  const answer = siteFiles(studio, docs);
  const body = async (path: string): Promise<string> => (await answer(path, "", undefined)).body.toString();
  expect(await body("/")).toBe("the studio");
  for (const path of ["/docs", "/docs/", "/docs/index.html"]) expect(await body(path)).toBe("the documentation");
  expect(await body("/docs/assets/a.js")).toBe("// of the documentation");
  expect((await answer("/docs/assets/a.js", "", undefined)).headers["cache-control"]).toContain("immutable");
  expect((await answer("/docs/../studio/index.html", "", undefined)).status).toBe(404);
  expect((await answer("/documents", "", undefined)).status).toBe(404);
});

test("without a documentation that is built, /docs/ has nothing and the studio is as before", async () => {
  const answer = siteFiles(studio, undefined);
  expect((await answer("/docs/", "", undefined)).status).toBe(404);
  expect((await answer("/", "", undefined)).status).toBe(200);
});

test("a documentation that is still to be built says so in a sentence, and is there as soon as it is", async () => {
  const later = join(folder, "later");
  const answer = siteFiles(studio, later);
  const before = await answer("/docs/start.html", "", undefined);
  expect([before.status, before.body.toString()]).toEqual([404, expect.stringContaining("not built yet")]);
  mkdirSync(later);
  writeFileSync(join(later, "index.html"), "built");
  expect((await answer("/docs/", "", undefined)).body.toString()).toBe("built");
  expect((await answer("/docs/nothing.html", "", undefined)).body.toString()).not.toContain("not built yet");
});
