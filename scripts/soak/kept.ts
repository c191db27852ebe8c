import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";

/**
 * The results of a soak beside its script, kept one by one: what is not run again keeps its last result, and what has
 * been run counts when the rest is broken off.
 */
export function keptResults<R extends object>(
  file: URL,
  head: Readonly<Record<string, unknown>>,
): { of(name: string): Partial<R>; keep(name: string, result: R): void } {
  const read = (): Record<string, R & { date?: string }> =>
    existsSync(file) ? (JSON.parse(readFileSync(file, "utf8")) as { results: Record<string, R> }).results : {};
  const date = new Date().toISOString().slice(0, 10);
  return {
    of: name => read()[name] ?? {},
    keep(name, result) {
      const machine = `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`;
      writeFileSync(
        file,
        `${JSON.stringify({ ...head, date, machine, results: { ...read(), [name]: { ...result, date } } }, null, 2)}\n`,
      );
    },
  };
}
