import { createInterface } from "node:readline";
import { UseFault } from "./usage.ts";

/**
 * Standard input line by line as JSON values; blank lines are passed over. A line that is no JSON is a `UseFault` that
 * names it.
 */
export async function* jsonLines(): AsyncGenerator<{ readonly line: number; readonly value: unknown }> {
  let line = 0;
  for await (const text of createInterface({ input: process.stdin, crlfDelay: Infinity })) {
    line++;
    if (text.trim() === "") continue;
    let value: unknown;
    try {
      value = JSON.parse(text);
    } catch (problem) {
      throw new UseFault(`Line ${line} is not JSON: ${(problem as Error).message}.`);
    }
    yield { line, value };
  }
}

/** Writes to standard output in large pieces; a reader that went away (head, less) ends the program quietly. */
export function lineWriter(): { write(value: unknown): void; flush(): void; end(): Promise<void> } {
  let pending: string[] = [];
  let size = 0;
  process.stdout.on("error", (problem: NodeJS.ErrnoException) => {
    process.exit(problem.code === "EPIPE" ? 0 : 1);
  });
  const flush = () => {
    if (size) {
      process.stdout.write(pending.join(""));
      pending = [];
      size = 0;
    }
  };
  return {
    write(value) {
      const text = `${JSON.stringify(value)}\n`;
      pending.push(text);
      size += text.length;
      if (size > 65536) flush();
    },
    flush,
    end: () =>
      new Promise(resolve => {
        flush();
        process.stdout.write("", () => {
          resolve();
        });
      }),
  };
}
