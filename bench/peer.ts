import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** Interpreters are kept here between runs; `TWINCELL_PEERS` puts them elsewhere. */
const HOME = process.env.TWINCELL_PEERS ?? join(tmpdir(), "twincell-peers");

/**
 * Runs a Python script against a package that is installed into an environment of its own the first time.
 *
 * @param packages  with versions, so that a figure says what it was compared with.
 * @param input     handed over as JSON on stdin.
 * @returns what the script printed as JSON; undefined, said on stderr, where the package does not install.
 */
export function pythonPeer(name: string, packages: readonly string[], script: string, input: unknown): unknown {
  const place = join(HOME, name);
  const python = join(place, "bin", "python");
  if (!existsSync(join(place, "ready"))) {
    mkdirSync(HOME, { recursive: true });
    const steps: readonly (readonly [string, readonly string[]])[] = [
      ["python3", ["-m", "venv", place]],
      [python, ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", ...packages]],
      ["touch", [join(place, "ready")]],
    ];
    for (const [command, args] of steps) {
      const done = spawnSync(command, [...args], { encoding: "utf8", timeout: 300_000 });
      if (done.status !== 0) return skipped(name, done.error?.message ?? done.stderr);
    }
  }
  const ran = spawnSync(python, ["-c", script], {
    input: JSON.stringify(input),
    encoding: "utf8",
    maxBuffer: 1 << 28,
    timeout: 300_000,
  });
  if (ran.status !== 0) return skipped(name, ran.stderr);
  return JSON.parse(ran.stdout) as unknown;
}

function skipped(name: string, why: string): undefined {
  process.stderr.write(`The peer ${name} is left out: ${why.trim().split("\n").at(-1) ?? "it does not install"}\n`);
  return undefined;
}

/** The numbers of a field of a peer's answer. */
export function numbersOf(answer: unknown, field: string): number[] {
  const value: unknown = typeof answer === "object" && answer !== null ? Reflect.get(answer, field) : undefined;
  if (!Array.isArray(value) || !value.every(x => typeof x === "number"))
    throw new Error(`The peer's answer has no numbers "${field}".`);
  return value;
}
