import { readFileSync, readdirSync } from "node:fs";
import { expect, test } from "vitest";
import { publicApiReports, reportFolder } from "./report.mjs";

const kept = (file: string): string => readFileSync(new URL(file, reportFolder), "utf8");

test("docs/public-api tells what the packages export today: node scripts/write-api.mjs writes it anew", () => {
  const reports = publicApiReports();
  expect(readdirSync(reportFolder).sort()).toEqual([...reports.keys()].sort());
  for (const [file, text] of reports) expect(text === kept(file), `docs/public-api/${file} is stale`).toBe(true);
}, 120_000);

test("a report names functions with units and shapes, and what an interface holds", () => {
  const core = kept("core.md");
  expect(core).toContain("## @twincell/core/spatial");
  expect(core).toMatch(/function compose<A extends string, B extends string, C extends string>\(aFromB: Pose<A, B>/);
  expect(core).toMatch(/interface Pose<[^]*?readonly position: Vector3;/);
});
