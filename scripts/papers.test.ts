import { existsSync, readFileSync, readdirSync } from "node:fs";
import { describe, expect, test } from "vitest";

const root = new URL("../", import.meta.url);
const folder = new URL("docs/papers/", root);
const pages = readdirSync(folder).filter(file => file !== "README.md");
const read = (path: string, base: URL = root): string => readFileSync(new URL(path, base), "utf8");

describe.each(pages)("docs/papers/%s", page => {
  const text = read(page, folder);
  // | the paper | Twincell | `file`: title |
  const rows = [...text.matchAll(/^\|[^|]+\|[^|]+\| `([^`]+)`: ([^|]+) \|$/gm)].map(
    ([, file, title]) => [file!, title!.trim()] as const,
  );

  test("every number of ours names a test that exists under that title", () => {
    expect(rows.length).toBeGreaterThan(5);
    const missing = rows.filter(([file, title]) => !existsSync(new URL(file, root)) || !read(file).includes(title));
    expect(missing).toEqual([]);
  });

  test("every row of the table names its test", () => {
    const lines = text.split("\n").filter(line => line.startsWith("| ") && !/^\| The (paper|thesis) \|/.test(line));
    expect(lines).toHaveLength(rows.length);
  });

  test("the examples and pages that it speaks of are there", () => {
    const examples = [...text.matchAll(/examples\/\d[\w-]+/g)].map(([path]) => path);
    expect(examples.length).toBeGreaterThan(0);
    expect(examples.filter(path => !existsSync(new URL(path, root)))).toEqual([]);
    const links = [...text.matchAll(/\]\(([^)#]+)\)/g)].map(([, link]) => link!);
    expect(links.filter(link => !/^https?:/.test(link) && !existsSync(new URL(link, folder)))).toEqual([]);
  });
});
