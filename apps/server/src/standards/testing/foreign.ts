import { spawn, spawnSync, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { serve, type Served } from "../../index.ts";
import type { StandardsOptions } from "../index.ts";

const python = process.env["TWINCELL_PYTHON"] ?? "python3";
const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");

/** Whether that Python package is there; in CI it must be. */
export const isMissing = (module: string): boolean =>
  process.env["CI"] === undefined && spawnSync(python, ["-c", `import ${module}`]).status !== 0;

/** What a script of a foreign client says: JSON, one object a line. */
export interface Script {
  readonly process: ChildProcess;
  /** The next object; rejects with what it wrote to stderr when it ended before. */
  next(): Promise<Record<string, unknown>>;
  say(value: unknown): void;
  ended(): Promise<number>;
}
/** Runs a script of this folder. */
export function foreignScript(name: string, ...args: readonly string[]): Script {
  const path = fileURLToPath(new URL(name, import.meta.url));
  const child = spawn(python, ["-u", path, ...args], { env: { ...process.env, PYTHONDONTWRITEBYTECODE: "1" } });
  let rest = "";
  let errors = "";
  const lines: Record<string, unknown>[] = [];
  const waiting: ((line: Record<string, unknown> | null) => void)[] = [];
  child.stderr.on("data", part => (errors += String(part)));
  child.stdout.on("data", part => {
    const parts = (rest + String(part)).split("\n");
    rest = parts.pop()!;
    for (const line of parts) {
      if (!line.startsWith("{")) continue;
      const value = JSON.parse(line) as Record<string, unknown>;
      const settle = waiting.shift();
      if (settle) settle(value);
      else lines.push(value);
    }
  });
  const closed = once(child, "close");
  void closed.then(() => {
    for (const settle of waiting.splice(0)) settle(null);
  });
  return {
    process: child,
    async next() {
      const line =
        lines.shift() ??
        (child.exitCode === null
          ? await new Promise<Record<string, unknown> | null>(resolve => {
              waiting.push(resolve);
            })
          : null);
      if (line === null) throw new Error(`${name} ended: ${errors}`);
      return line;
    },
    say(value) {
      child.stdin.write(`${JSON.stringify(value)}\n`);
    },
    async ended() {
      const [code] = (await closed) as [number];
      if (code !== 0) throw new Error(`${name} ended with ${code}: ${errors}`);
      return code;
    },
  };
}

export interface Plant {
  readonly served: Served;
  /** Port at the end of the address of a standard. */
  port(standard: string): string;
  ask(method: string, path: string, body?: unknown, lease?: string): Promise<Record<string, unknown>>;
  /** The lease of the arm, with a person's word that motion is wanted: a busy machine may have lost the link. */
  lease(): Promise<string>;
  close(): Promise<void>;
}
export const UR = { driver: "ur", model: "ur10e" } as const;
/** Without a watchdog of its own: a busy machine does not stop its motions. */
export const YASKAWA = { driver: "yaskawa", model: "yaskawa_gp8" } as const;

/** A server that speaks these standards, with a virtual robot `arm` that is connected. */
export async function plant(
  standards: StandardsOptions,
  { driver, model }: { readonly driver: string; readonly model: string } = UR,
): Promise<Plant> {
  const served = await serve({ studio, port: 0, version: "test", standards });
  const ask: Plant["ask"] = async (method, path, body, lease) => {
    const response = await fetch(new URL(`/api/v1${path}`, served.url), {
      method,
      headers: {
        ...(body === undefined ? {} : { "content-type": "application/json" }),
        ...(lease === undefined ? {} : { "twincell-lease": lease }),
      },
      ...(body === undefined ? {} : { body: JSON.stringify(body) }),
    });
    return (await response.json()) as Record<string, unknown>;
  };
  const lease = async (): Promise<string> => {
    const taken = await ask("POST", "/robots/arm/lease", {});
    for (;;) {
      const { link } = (await ask("GET", "/robots/arm/state")) as { readonly link: { readonly state: string } | null };
      if (link === null || link.state === "open" || link.state === "closed") break;
    }
    await ask("POST", "/robots/arm/confirm", undefined, String(taken["lease"]));
    return String(taken["lease"]);
  };
  await ask("POST", "/robots", { id: "arm", driver, model });
  const first = await lease();
  await ask("POST", "/robots/arm/connect", undefined, first);
  await ask("DELETE", "/robots/arm/lease", undefined, first);
  return {
    served,
    ask,
    lease,
    port(standard) {
      const address = served.standards.find(each => each.startsWith(standard))!;
      return /:(\d+)(\/\w+)?$/.exec(address)![1]!;
    },
    close: () => served.close(),
  };
}
