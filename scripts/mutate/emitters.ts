import { spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { Worker } from "node:worker_threads";
import { LIBRARY, seededRandom } from "@twincell/core";
import { DIALECTS, dialectsFor } from "@twincell/languages";
import { keptResults } from "../soak/kept.ts";
import { faultsIn, withFault, type Fault } from "./faults.ts";
import type { Verdict } from "./judge.ts";

/**
 * Puts faults into the emitters and asks the conformance suite whether it sees them: `node scripts/mutate/emitters.ts
 * [faults] [dialect]`. Every fault is judged by what the suite does with its texts, in one thread; those that survive
 * this are put into a copy of the package whose other tests of the dialect then run (vitest --bail 1). Faults that
 * change no text of any program are counted apart: they are none, or nobody asks for what they spoil. Kept in
 * emitters.json.
 */
const FAULTS = Number(process.argv[2] ?? 150);
const ONLY = process.argv[3];
const SEED = 7;
const PATIENCE_MS = 30_000;
const TESTS_MS = 240_000;
const ROOT = resolve(fileURLToPath(new URL("../..", import.meta.url)));
const SOURCES = join(ROOT, "packages/languages/src");
interface Mutated {
  faults: number;
  sameText: number;
  killed: number;
  killedBySuite: number;
  killedByTests: number;
  survived: number;
  rate: number;
  survivors: unknown[];
  unseen: unknown[];
  seconds: number;
}
const kept = keptResults<Mutated>(new URL("emitters.json", import.meta.url), {
  what: "faults put into the sources of emitters; rate: killed of those that change a text",
  seed: SEED,
});

/** The files that an emitter is made of: what its emit.ts imports, but for what the readers use too. */
function filesOf(dialect: string): string[] {
  const found = new Set<string>();
  const look = (file: string): void => {
    if (found.has(file)) return;
    found.add(file);
    for (const [, to] of readFileSync(file, "utf8").matchAll(/^(?:import|export)(?! type)[^;]*? from "(\.[^"]+)"/gm)) {
      const path = resolve(dirname(file), to!);
      const name = relative(SOURCES, path);
      if (name.startsWith(`${dialect}/write`) || name.startsWith("writing/")) look(path);
    }
  };
  look(join(SOURCES, dialect, "emit.ts"));
  return [...found];
}

class Judge {
  private worker: Worker | undefined;
  private readonly data: object;
  private readonly dialect: string;
  constructor(dialect: string, robot: string, files: readonly string[]) {
    this.dialect = dialect;
    this.data = { dialectId: dialect, robotId: robot, files: [...files, join(SOURCES, dialect, "index.ts")] };
  }

  async verdict(id: number, file: string, source: string): Promise<Verdict> {
    this.worker ??= await this.start();
    const { worker } = this;
    return new Promise(done => {
      const late = setTimeout(() => {
        worker.off("message", answer);
        void worker.terminate();
        this.worker = undefined;
        done({ kind: "killed", by: "does not come to an end" });
      }, PATIENCE_MS);
      const answer = (message: { readonly id: number; readonly verdict: Verdict }): void => {
        if (message.id !== id) return;
        clearTimeout(late);
        worker.off("message", answer);
        done(message.verdict);
      };
      worker.on("message", answer);
      worker.postMessage({ id, file, source });
    });
  }

  private async start(): Promise<Worker> {
    const worker = new Worker(new URL("judge.ts", import.meta.url), { workerData: this.data });
    await new Promise<void>((done, failed) => {
      worker.once("message", () => {
        done();
      });
      worker.once("error", failed);
    });
    worker.removeAllListeners("error");
    worker.on("error", cause => {
      process.stderr.write(`${this.dialect}: ${String(cause)}\n`);
    });
    return worker;
  }

  async end(): Promise<void> {
    await this.worker?.terminate();
  }
}

/** A copy of the package in which a file may be spoilt. */
function copy(): string {
  const folder = mkdtempSync(join(tmpdir(), "twincell-mutants-"));
  cpSync(join(ROOT, "packages/languages"), join(folder, "packages/languages"), {
    recursive: true,
    filter: path => !path.includes("node_modules"),
  });
  for (const name of [
    "node_modules",
    "fixtures",
    "examples",
    "package.json",
    "tsconfig.base.json",
    "tsconfig.tests.json",
  ])
    symlinkSync(join(ROOT, name), join(folder, name));
  writeFileSync(
    join(folder, "vitest.config.ts"),
    'export default { test: { include: ["packages/languages/src/**/*.test.ts"], testTimeout: 60_000 } };\n',
  );
  return folder;
}

/** Whether the dialect's own tests fail with the fault. */
function testsFail(folder: string, dialect: string, file: string, source: string): boolean {
  const place = join(folder, "packages/languages/src", relative(SOURCES, file));
  const was = readFileSync(place, "utf8");
  writeFileSync(place, source);
  try {
    const run = spawnSync(
      process.execPath,
      [
        join(ROOT, "node_modules/vitest/vitest.mjs"),
        "run",
        "--root",
        folder,
        "--bail",
        "1",
        "--config",
        join(folder, "vitest.config.ts"),
        "-t",
        "^(?!.*(?:dialect |structure in |faults put into ))",
        `packages/languages/src/${dialect}/`,
      ],
      { cwd: folder, timeout: TESTS_MS, encoding: "utf8" },
    );
    return run.status !== 0;
  } finally {
    writeFileSync(place, was);
  }
}

const short = (fault: Fault): object => ({
  file: relative(SOURCES, fault.file),
  line: fault.line,
  sort: fault.sort,
  from: fault.from,
  to: fault.to,
});
const folder = copy();
try {
  for (const dialect of DIALECTS) {
    if (ONLY !== undefined && dialect.id !== ONLY) continue;
    const robot = LIBRARY.find(each => dialectsFor(each).includes(dialect));
    if (robot === undefined) continue;
    const begun_ms = performance.now();
    const files = filesOf(dialect.id);
    const random = seededRandom(SEED);
    const judge = new Judge(dialect.id, robot.id, files);
    const all = files.flatMap(file => faultsIn(file, readFileSync(file, "utf8")));
    for (let i = all.length - 1; i > 0; i--) {
      const j = Math.floor(random() * (i + 1));
      [all[i], all[j]] = [all[j]!, all[i]!];
    }
    const unseen: object[] = [];
    const open: { readonly fault: Fault; readonly source: string; readonly text: string }[] = [];
    let bySuite = 0;
    let faults = 0;
    for (const fault of all.slice(0, FAULTS)) {
      const source = withFault(readFileSync(fault.file, "utf8"), fault);
      const verdict = await judge.verdict(faults++, fault.file, source);
      if (verdict.kind === "killed") bySuite++;
      else if (verdict.kind === "same text") unseen.push(short(fault));
      else open.push({ fault, source, text: verdict.text });
    }
    await judge.end();
    const survivors: object[] = [];
    for (const { fault, source, text } of open)
      if (!testsFail(folder, dialect.id, fault.file, source)) survivors.push({ ...short(fault), text });
    const seen = faults - unseen.length;
    const killed = seen - survivors.length;
    kept.keep(dialect.id, {
      faults,
      sameText: unseen.length,
      killed,
      killedBySuite: bySuite,
      killedByTests: killed - bySuite,
      survived: survivors.length,
      rate: Math.round((1000 * killed) / Math.max(1, seen)) / 1000,
      survivors,
      unseen,
      seconds: Math.round((performance.now() - begun_ms) / 1000),
    });
    process.stdout.write(
      `${dialect.id}: ${killed} of ${seen} killed (${unseen.length} change no text), ${survivors.length} survive\n`,
    );
  }
} finally {
  rmSync(folder, { recursive: true });
}
