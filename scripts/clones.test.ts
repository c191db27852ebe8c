import { describe, expect, test } from "vitest";
import { clonesIn, filesOf, LEAST_LINES, tokensOf } from "./clones.mjs";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { spawnSync } from "node:child_process";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const script = fileURLToPath(new URL("clones.mjs", import.meta.url));

/** A function of so many lines, of which no two are equal. */
const written = (lines: number, name = "reach") =>
  [
    `export function ${name}(q: number[]): number {`,
    ...Array.from({ length: lines - 3 }, (_, i) => `  const a${i} = Math.sin(q[${i}]!) / 2; // turn ${i}`),
    "  return a0;",
    "}",
    "",
  ].join("\n");
const file = (folder: string, path: string, text: string) => ({ folder, path, text });

describe("the clone detector", () => {
  test("finds what two folders hold word for word, with its lines", () => {
    const pairs = clonesIn([
      file("krl", "krl/emit.ts", `const x = 1;\nconst y = 2;\n${written(20)}const z = 3;\n`),
      file("inform", "inform/emit.ts", `${written(20)}`),
    ]);
    expect(pairs).toHaveLength(1);
    expect(pairs[0].lines).toBe(20);
    expect(pairs[0].sides).toMatchObject([
      { path: "krl/emit.ts", first: 3, last: 22 },
      { path: "inform/emit.ts", first: 1, last: 20 },
    ]);
  });

  test("finds a part of a function, whatever its comments and line breaks are", () => {
    const copied = written(30)
      .replaceAll(/ \/\/.*/g, "")
      .replaceAll(" / 2", " /\n 2");
    const [pair] = clonesIn([
      file("krl", "krl/run.ts", written(30).replace("a4 = Math.sin", "a4 = Math.cos")),
      file("v-plus", "v-plus/run.ts", copied),
    ]);
    expect(pair.sides).toMatchObject([{ first: 6, last: 30 }, { path: "v-plus/run.ts" }]);
  });

  test.each([
    ["is one line short", written(LEAST_LINES - 1), written(LEAST_LINES - 1)],
    ["has other names", written(40), written(40).replaceAll("a", "b")],
    ["has other numbers", written(40), written(40).replaceAll("2;", "3;")],
    [
      "is imports",
      `import {\n${Array.from({ length: 40 }, (_, i) => `  a${i},`).join("\n")}\n} from "x";\n`,
      `import {\n${Array.from({ length: 40 }, (_, i) => `  a${i},`).join("\n")}\n} from "x";\n`,
    ],
  ])("reports nothing that %s", (_, a, b) => {
    expect(clonesIn([file("krl", "krl/a.ts", a), file("inform", "inform/a.ts", b)])).toEqual([]);
  });

  test("reports nothing that one folder holds twice", () => {
    expect(clonesIn([file("krl", "krl/a.ts", written(40)), file("krl", "krl/b.ts", written(40))])).toEqual([]);
  });

  test("tells templates, regular expressions and divisions apart", () => {
    const words = (text: string) => tokensOf(text).map(({ word }) => word);
    expect(words("a = `x${{ b: 1 }.b}y`;")).toEqual(["a", "=", "`x${", "{", "b", ":", "1", "}", ".", "b", "}y`", ";"]);
    expect(words("a = /[/'\"]/g; b = c / d;")).toEqual(["a", "=", "/[/'\"]/g", ";", "b", "=", "c", "/", "d", ";"]);
    expect(words('import * as x from "y"; export * from "z"; export const { w } = x;')).toEqual(
      "export const { w } = x ;".split(" "),
    );
  });

  test("ends with 1 where folders have a pair in common, tests apart, and says where", () => {
    const folder = mkdtempSync(join(tmpdir(), "clones-"));
    const run = () => spawnSync(process.execPath, [script, folder], { encoding: "utf8" });
    try {
      for (const name of ["krl", "inform", "inform/testing"]) mkdirSync(join(folder, name));
      writeFileSync(join(folder, "krl/a.ts"), written(20));
      writeFileSync(join(folder, "inform/a.test.ts"), written(20));
      writeFileSync(join(folder, "inform/testing/a.ts"), written(20));
      expect(run()).toMatchObject({ status: 0, stdout: "clones: none between two folders.\n" });
      writeFileSync(join(folder, "inform/b.ts"), written(20));
      const { status, stdout } = run();
      expect(status).toBe(1);
      expect(stdout).toMatch(/^20 lines \(\d+ tokens\): .*inform\/b\.ts:1-20 and .*krl\/a\.ts:1-20\nclones: 1 /);
    } finally {
      rmSync(folder, { recursive: true });
    }
  });

  test("looks at every file of the languages", () => {
    const files = filesOf(fileURLToPath(new URL("../packages/languages/src", import.meta.url)));
    const folders = new Set(files.map(({ folder }: { folder: string }) => folder.split("/").at(-1)));
    for (const language of ["krl", "v-plus", "inform", "rapid", "emitter", "parser"])
      expect(folders).toContain(language);
    expect(files.every(({ path }: { path: string }) => !path.endsWith(".test.ts"))).toBe(true);
  });
});
