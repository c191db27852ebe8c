import { spawnSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("../../", import.meta.url));
const BLOCK = /^```(ts|diff) (\S+)\n([\s\S]*?)^```$/gm;

/** One labelled block of a guide: a new file, or lines that are added to one. */
export interface GuideBlock {
  readonly kind: "ts" | "diff";
  readonly path: string;
  readonly text: string;
}
export const blocksOf = (guide: string): readonly GuideBlock[] =>
  [...guide.matchAll(BLOCK)].map(([, kind, path, text]) => ({
    kind: kind as GuideBlock["kind"],
    path: path!,
    text: text!,
  }));

/** A copy of a package in which the blocks of a guide have been carried out. */
export interface Followed {
  /** What the compiler says with the package's own settings; empty when it compiles. */
  compile(): string;
  /** Runs the tests that the guide wrote; the output when one fails. */
  test(): string;
  remove(): void;
}

/** Carries a guide out in a copy of the package that it is about. */
export function followGuide(guideFile: string, packageFolder: string): Followed {
  const blocks = blocksOf(readFileSync(join(root, guideFile), "utf8"));
  mkdirSync(join(root, ".cache"), { recursive: true });
  const copy = mkdtempSync(join(root, ".cache/guide-"));
  for (const part of ["src", "tsconfig.json", "package.json"])
    cpSync(join(root, packageFolder, part), join(copy, packageFolder, part), {
      recursive: true,
      filter: path => !/\.test\.tsx?$/.test(path),
    });
  cpSync(join(root, "tsconfig.base.json"), join(copy, "tsconfig.base.json"));
  for (const block of blocks) carryOut(copy, block);
  const tests = blocks.filter(block => block.path.endsWith(".test.ts")).map(block => block.path);
  const run = (command: string, ...args: readonly string[]): string => {
    const done = spawnSync(process.execPath, [join(root, "node_modules", command), ...args], {
      cwd: copy,
      encoding: "utf8",
    });
    return done.status === 0 ? "" : `${done.stdout}${done.stderr}`;
  };
  return {
    compile: () => run("typescript7/bin/tsc", "-p", packageFolder, "--noEmit", "--incremental", "false"),
    test: () => run("vitest/vitest.mjs", "run", "--root", copy, ...tests),
    remove: () => {
      rmSync(copy, { recursive: true, force: true });
    },
  };
}

function carryOut(copy: string, { kind, path, text }: GuideBlock): void {
  const file = join(copy, path);
  if (kind === "ts") {
    mkdirSync(dirname(file), { recursive: true });
    writeFileSync(file, text);
    return;
  }
  const before = text
    .split("\n")
    .filter(line => line.startsWith(" "))
    .map(line => line.slice(1))
    .join("\n");
  const added = text
    .split("\n")
    .filter(line => line.startsWith("+"))
    .map(line => line.slice(1))
    .join("\n");
  const source = readFileSync(file, "utf8");
  const at = source.indexOf(`${before}\n`);
  if (before === "" || at < 0) throw new Error(`${path} has no line “${before}”.`);
  const end = at + before.length + 1;
  writeFileSync(file, `${source.slice(0, end)}${added}\n${source.slice(end)}`);
}
