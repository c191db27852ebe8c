import { afterAll, describe, expect, test } from "vitest";
import { blocksOf, followGuide } from "./follow.ts";

describe.each([
  ["docs/add-a-check.md", "packages/core"],
  ["docs/add-a-file-format.md", "packages/formats"],
  ["docs/add-a-controller.md", "packages/controllers"],
])("%s, followed in a copy of %s", (guide, folder) => {
  const followed = followGuide(guide, folder);
  afterAll(() => {
    followed.remove();
  });
  test("what it writes compiles with the package's own settings", { timeout: 120_000 }, () => {
    expect(followed.compile()).toBe("");
  });
  test("the test that it writes passes", { timeout: 120_000 }, () => {
    expect(followed.test()).toBe("");
  });
});

describe("docs/add-a-language.md, followed in a copy of apps/studio", () => {
  const followed = followGuide("docs/add-a-language.md", "apps/studio");
  afterAll(() => {
    followed.remove();
  });
  test("the test that it writes passes", { timeout: 120_000 }, () => {
    expect(followed.test()).toBe("");
  });
});

describe("docs/add-a-panel.md, followed in a copy of apps/studio", () => {
  const followed = followGuide("docs/add-a-panel.md", "apps/studio");
  afterAll(() => {
    followed.remove();
  });
  test("what it writes compiles with the studio's own settings", { timeout: 120_000 }, () => {
    expect(followed.compile()).toBe("");
  });
  test("the test that it writes passes", { timeout: 120_000 }, () => {
    expect(followed.test()).toBe("");
  });
});

test("only labelled blocks are carried out", () => {
  expect(blocksOf("```ts a.ts\nx\n```\n```ts\ny\n```\n")).toEqual([{ kind: "ts", path: "a.ts", text: "x\n" }]);
});
