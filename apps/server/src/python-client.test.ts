/**
 * The Python client of clients/python against a server with virtual controllers: `npm run clients` installs what it
 * needs.
 */
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { emptyProgram } from "@twincell/core";
import { afterEach, expect, test } from "vitest";
import { serve, type Served } from "./index.ts";

const python = process.env["TWINCELL_PYTHON"] ?? "python3";
const client = fileURLToPath(new URL("../../../clients/python", import.meta.url));
const missing = spawnSync(python, ["-c", "import mcap, pandas, pytest, websockets"]).status !== 0;
let served: Served | undefined;
afterEach(async () => {
  await served?.close();
  served = undefined;
});

test.skipIf(missing)(
  "the Python client connects, moves, streams into pandas, plans, checks, writes, records and says what is refused, with and without asyncio; its notebook runs top to bottom",
  async () => {
    const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
    writeFileSync(join(studio, "index.html"), "<title>studio</title>");
    served = await serve({ studio, port: 0, version: "test", data: mkdtempSync(join(tmpdir(), "twincell-data-")) });
    const { version } = emptyProgram("ur10e");
    const run = spawn(python, ["-m", "pytest", "-q", "-p", "no:cacheprovider", "tests"], {
      cwd: client,
      env: {
        ...process.env,
        PYTHONPATH: client,
        PYTHONDONTWRITEBYTECODE: "1",
        TWINCELL_URL: served.url,
        TWINCELL_PROGRAM_VERSION: String(version),
      },
    });
    let out = "";
    run.stdout.on("data", part => (out += String(part)));
    run.stderr.on("data", part => (out += String(part)));
    const status = await new Promise(resolve => run.on("close", resolve));
    expect(status, out).toBe(0);
    expect(out).toMatch(/7 passed/);
  },
  120_000,
);
