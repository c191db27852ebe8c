import { readFile } from "node:fs/promises";
import { UseFault } from "./usage.ts";

/** Text of a file; "-" is standard input. */
export async function readText(path: string): Promise<string> {
  try {
    return path === "-" ? await readStdin() : await readFile(path, "utf8");
  } catch (problem) {
    const code = (problem as NodeJS.ErrnoException).code;
    throw new UseFault(
      code === "ENOENT"
        ? `There is no file ${path}.`
        : code === "EISDIR"
          ? `${path} is a folder, not a file.`
          : `${path} cannot be read: ${(problem as Error).message}.`,
    );
  }
}

async function readStdin(): Promise<string> {
  const parts: Buffer[] = [];
  for await (const part of process.stdin) parts.push(part as Buffer);
  return Buffer.concat(parts).toString("utf8");
}
