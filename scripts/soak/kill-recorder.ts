/**
 * Kills a recorder with SIGKILL at random moments and asks what is left: node scripts/soak/kill-recorder.ts [TIMES]
 * [SEED]. Lines go to the real command line at 100 Hz; what was handed over when the process died is held against what
 * its file says. The result is kept beside this file.
 */
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { seededRandom } from "@twincell/core";
import { openHistory } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import { recordingsFolder } from "@twincell/server";

const cli = fileURLToPath(new URL("../../apps/cli/src/main.ts", import.meta.url));
const HZ = 100;

/** One recorder, killed after that time. @returns how much of what it was given is lost [s]. */
export async function killOnce(
  after_s: number,
): Promise<{ readonly given_s: number; readonly lost_s: number; readonly whole: boolean }> {
  const folder = mkdtempSync(join(tmpdir(), "twincell-kill-"));
  const child = spawn(process.execPath, [cli, "record", "--to", `${folder}/`, "--robot", "ur10e"], {
    stdio: ["pipe", "ignore", "pipe"],
  });
  const ended = new Promise<void>(resolve => {
    child.once("close", () => {
      resolve();
    });
  });
  child.stdin.on("error", () => undefined);
  try {
    await new Promise<void>((resolve, reject) => {
      child.stderr.once("data", () => {
        resolve();
      });
      child.once("exit", code => {
        reject(new Error(`The recorder ended by itself with ${code}.`));
      });
    });
    const begun_ms = performance.now();
    let sent = 0;
    await new Promise<void>(resolve => {
      const timer = setInterval(() => {
        for (const due = Math.min(after_s, (performance.now() - begun_ms) / 1000) * HZ; sent < due; sent++)
          child.stdin.write(
            `${JSON.stringify({ t: sent / HZ, q: [0, 1, 2, 3, 4, 5].map(j => Math.sin(sent / 50 + j)), step: "a" })}\n`,
          );
        if (performance.now() - begun_ms >= after_s * 1000) {
          clearInterval(timer);
          child.kill("SIGKILL");
          resolve();
        }
      }, 1000 / HZ);
    });
    await ended;
    const opened = await openHistory(recordingsFolder(folder), { packing: await zstd() });
    const given_s = (sent - 1) / HZ;
    if (opened.kind !== "history") return { given_s, lost_s: given_s, whole: false };
    const { history } = opened;
    let next = 0;
    let whole = true;
    for await (const { sequences } of history.samples(0, Infinity))
      for (const sequence of sequences) whole &&= sequence === next++;
    return { given_s, lost_s: given_s - history.duration_s, whole };
  } finally {
    if (child.exitCode === null && child.signalCode === null) {
      child.kill("SIGKILL");
      await ended;
    }
    rmSync(folder, { recursive: true });
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const times = Number(process.argv[2] ?? 100);
  const seed = Number(process.argv[3] ?? 1);
  const random = seededRandom(seed);
  const results: Awaited<ReturnType<typeof killOnce>>[] = [];
  const moments = Array.from({ length: times }, () => 0.3 + 3.7 * random());
  const began_ms = performance.now();
  // A few at a time: they mostly wait.
  await Promise.all(
    Array.from({ length: 3 }, async () => {
      for (let after_s = moments.pop(); after_s !== undefined; after_s = moments.pop())
        results.push(await killOnce(after_s));
    }),
  );
  const lost = results.map(({ lost_s }) => lost_s).sort((a, b) => a - b);
  const report = {
    what: "twincell record killed with SIGKILL at a random moment between 0.3 and 4 s; lost is what had been handed to it and is not in the file",
    date: new Date().toISOString(),
    machine: `${cpus().length} × ${cpus()[0]?.model ?? "unknown"}`,
    seed,
    times,
    over1s: lost.filter(lost_s => lost_s > 1).length,
    notWhole: results.filter(({ whole, given_s }) => !whole && given_s > 1).length,
    lost_s: { median: lost[lost.length >> 1], worst: lost.at(-1) },
    took_s: Math.round((performance.now() - began_ms) / 1000),
  };
  writeFileSync(new URL("kill-recorder.json", import.meta.url), `${JSON.stringify(report, null, 2)}\n`);
  process.stdout.write(`${JSON.stringify(report)}\n`);
}
