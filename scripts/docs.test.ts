import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { describe, expect, test } from "vitest";
import { COMMANDS } from "../apps/cli/src/commands/index.ts";
import { cliReference } from "../apps/cli/src/io/reference.ts";

const root = fileURLToPath(new URL("..", import.meta.url));
const CLI = join(root, "apps/cli/src/main.ts");
/** Several commands, each a process of its own, on a busy machine. */
const COMMAND_MS = 120_000;
const MOST_OUTPUT_BYTES = 256e6;
const read = (path: string): string => readFileSync(join(root, path), "utf8");
const PAGES = [
  "README.md",
  ...readdirSync(join(root, "docs"), { recursive: true, encoding: "utf8" })
    .filter(path => path.endsWith(".md"))
    .map(path => `docs/${path.replaceAll("\\", "/")}`),
];

/** Headings as browsers and GitHub address them. */
const anchorsOf = (text: string): ReadonlySet<string> =>
  new Set(
    [...text.matchAll(/^#+ +(.*)$/gm)].map(([, heading]) =>
      heading!
        .toLowerCase()
        .replace(/[^\p{L}\p{N} _-]/gu, "")
        .replaceAll(" ", "-"),
    ),
  );

/** Links of a page that lead nowhere: files that are not there, headings that a page does not have. */
function deadLinks(page: string, text: string): readonly string[] {
  return [...text.matchAll(/\]\(([^)\s]+)\)/g)].flatMap(([, link]) => {
    if (/^[a-z]+:/.test(link!)) return [];
    const [path = "", anchor] = link!.split("#");
    const target = path === "" ? join(root, page) : resolve(root, dirname(page), path);
    if (!existsSync(target)) return [`${page}: ${link!}`];
    if (anchor === undefined || !target.endsWith(".md")) return [];
    return anchorsOf(readFileSync(target, "utf8")).has(anchor) ? [] : [`${page}: ${link!}`];
  });
}

describe("the documentation", () => {
  test("no page has a link to a file or a heading that is not there", () => {
    expect(PAGES.length).toBeGreaterThan(20);
    expect(PAGES.flatMap(page => deadLinks(page, read(page)))).toEqual([]);
    expect(deadLinks("docs/start.md", "[a](nowhere.md) [b](tour.md#nowhere) [c](cli.md#robots)")).toEqual([
      "docs/start.md: nowhere.md",
      "docs/start.md: tour.md#nowhere",
    ]);
  });

  test("docs/cli.md is what --help says; after a change run node scripts/write-cli.mjs", () => {
    expect(read("docs/cli.md")).toBe(cliReference(COMMANDS));
  });

  test(
    "every command of the first five minutes works as it is written",
    async () => {
      const blocks = [...read("docs/start.md").matchAll(/```sh\n([^]*?)```/g)];
      const lines = blocks.flatMap(([, block]) => block!.trim().split("\n"));
      expect(lines.length).toBeGreaterThanOrEqual(5);
      const out = join(root, "out/start");
      rmSync(out, { recursive: true, force: true });
      mkdirSync(join(root, "out"), { recursive: true });
      for (const line of lines) {
        const [npx, name, ...args] = line.split(" ");
        expect([npx, name]).toEqual(["npx", "twincell"]);
        if (args[0] === "serve") {
          if (existsSync(join(root, "apps/studio/dist/index.html"))) expect(await addressOf(args)).toMatch(/^http/);
          continue;
        }
        const done = spawnSync(process.execPath, [CLI, ...args], {
          cwd: root,
          encoding: "utf8",
          maxBuffer: MOST_OUTPUT_BYTES,
        });
        // A doctor that finds something bad on this machine has done its work.
        expect(done.status, `${line}: ${done.stderr}`).toBeLessThanOrEqual(args[0] === "doctor" ? 1 : 0);
        if (!args.includes("-o")) expect(done.stdout, line).not.toBe("");
        if (args[0] === "check") expect(JSON.parse(done.stdout)).toMatchObject({ ok: true });
      }
      expect(readdirSync(out).length).toBeGreaterThan(0);
    },
    COMMAND_MS,
  );
});

/** Starts the server on a free port and waits for the address it prints. */
async function addressOf(args: readonly string[]): Promise<string> {
  const server = spawn(process.execPath, [CLI, ...args, "--port", "0"], { cwd: root });
  try {
    return await new Promise<string>((said, failed) => {
      server.stdout.on("data", (text: Buffer) => {
        const found = /Twincell is at (\S+)/.exec(text.toString());
        if (found) said(found[1]!);
      });
      server.on("exit", code => {
        failed(new Error(`serve ended with ${code ?? "a signal"}`));
      });
    });
  } finally {
    server.kill();
  }
}
