import { spawn } from "node:child_process";
import { mkdirSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:net";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { beforeAll, describe, expect, test } from "vitest";

const root = fileURLToPath(new URL("..", import.meta.url));
const FOLDER = join(root, "docs/tutorials");
const OUT = join(root, "out/tutorials");
const PAGES = readdirSync(FOLDER).filter(name => name.endsWith(".md"));
/** Many commands, each a process of its own, on a busy machine. */
const PAGE_MS = 400_000;
/** The port that the pages name; a test takes a free one. */
const PORT = "7341";

/** The commands of a page, in their order. */
const commandsOf = (page: string): readonly string[] =>
  [...readFileSync(join(FOLDER, page), "utf8").matchAll(/```sh\n([^]*?)```/g)].flatMap(([, block]) =>
    block!.trim().split("\n"),
  );

const freePort = (): Promise<number> =>
  new Promise(resolve => {
    const server = createServer();
    server.listen(0, "127.0.0.1", () => {
      const address = server.address();
      server.close(() => {
        resolve(typeof address === "object" && address ? address.port : 0);
      });
    });
  });

/**
 * The page as a script for bash: `npx twincell` is the command line of this checkout; what goes on in the background
 * (`&`) has said where it is before the next command, as a reader would wait for it, and ends with the page.
 */
function scriptOf(commands: readonly string[], port: number): string {
  const lines = commands.map(command => {
    const line = command.replaceAll(PORT, String(port));
    if (!line.endsWith("&")) return `echo '$' ${JSON.stringify(line)} >&2\n${line}`;
    const said = "$(mktemp)";
    return [
      `said=${said}`,
      `${line.slice(0, -1)} > "$said" 2>&1 &`,
      "background=$!",
      `until grep -qE 'at http://|127\\.0\\.0\\.' "$said"; do kill -0 $background || { cat "$said" >&2; exit 9; }; sleep 0.2; done`,
    ].join("\n");
  });
  return [
    "set -euo pipefail",
    `npx() { shift; '${process.execPath}' apps/cli/src/main.ts "$@"; }`,
    "trap 'for job in $(jobs -p); do pkill -INT -P $job || kill -INT $job || true; done; wait' EXIT",
    ...lines,
  ].join("\n");
}

interface Ran {
  readonly code: number | null;
  readonly out: string;
  readonly err: string;
}
function bash(script: string): Promise<Ran> {
  return new Promise(resolve => {
    const child = spawn("bash", ["-c", script], { cwd: root, stdio: ["ignore", "pipe", "pipe"] });
    let out = "";
    let err = "";
    child.stdout.on("data", (text: Buffer) => {
      out += text.toString();
    });
    child.stderr.on("data", (text: Buffer) => {
      err += text.toString();
    });
    child.on("close", code => {
      resolve({ code, out, err });
    });
  });
}

beforeAll(() => {
  rmSync(OUT, { recursive: true, force: true });
  mkdirSync(OUT, { recursive: true });
});

describe("tutorials", () => {
  test("there is one for each kind of person", () => {
    expect(PAGES.toSorted()).toEqual(["integrator.md", "lecturer.md", "researcher.md", "technician.md"]);
  });

  test.each(PAGES)(
    "every command of %s does what the page says, one after the other",
    async page => {
      const commands = commandsOf(page);
      expect(commands.length).toBeGreaterThanOrEqual(5);
      const { code, out, err } = await bash(scriptOf(commands, await freePort()));
      expect(code, `${err.slice(-4000)}\n${out.slice(-1000)}`).toBe(0);
      if (page === "technician.md") {
        // Two jogs, the way home and the program: each says that it is done.
        expect(out.match(/^\{"kind":"done"\}$/gm)?.length).toBe(4);
        expect(out).toContain('"model":"ur10e"');
      }
      if (page === "integrator.md") expect(out).toContain('"kind":"done"');
      if (page === "lecturer.md") expect(out.match(/"quaternion"/g)?.length).toBeGreaterThanOrEqual(2);
      if (page === "researcher.md")
        expect(readdirSync(OUT)).toEqual(expect.arrayContaining(["plan.mcap", "proof.json", "episodes.jsonl"]));
    },
    PAGE_MS,
  );
});
