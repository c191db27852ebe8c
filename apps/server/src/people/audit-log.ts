import { createHash } from "node:crypto";
import {
  closeSync,
  fsync,
  fsyncSync,
  ftruncateSync,
  mkdirSync,
  openSync,
  readFileSync,
  rmSync,
  writeFileSync,
  writeSync,
} from "node:fs";
import { join } from "node:path";
import { Fault } from "@twincell/core";

/** A log that must not be written on. */
export class AuditFault extends Fault {
  readonly code = "audit.log";
  readonly hint: string;
  constructor(sentence: string, hint: string) {
    super(sentence);
    this.hint = hint;
  }
}

/** Who did what, and what became of it. */
export interface AuditAct {
  readonly who: string;
  readonly action: string;
  readonly robot: string;
  readonly detail: string;
  /** "asked", "done", "refused" or "stopped". */
  readonly outcome: string;
}
export interface AuditLine extends AuditAct {
  readonly number: number;
  /** ISO 8601, UTC. */
  readonly time: string;
  /** Hash of the line before; 64 zeros before the first. */
  readonly previous: string;
  /** SHA-256 of the JSON text of this line without `hash`, as hex. */
  readonly hash: string;
}
const FIRST = "0".repeat(64);
const hashOf = (line: Omit<AuditLine, "hash">): string =>
  createHash("sha256").update(JSON.stringify(line)).digest("hex");
export const auditFile = (data: string): string => join(data, "audit.jsonl");

export type AuditVerdict =
  | { readonly kind: "whole"; readonly lines: number; readonly last: string }
  | { readonly kind: "broken"; readonly line: number; readonly sentence: string };

/** The lines of a log as text. An unfinished last line counts as none. */
export function readAudit(text: string): { readonly lines: readonly AuditLine[]; readonly verdict: AuditVerdict } {
  const lines: AuditLine[] = [];
  let previous = FIRST;
  const broken = (sentence: string): AuditVerdict => ({ kind: "broken", line: lines.length + 1, sentence });
  for (const each of text
    .slice(0, text.lastIndexOf("\n") + 1)
    .split("\n")
    .slice(0, -1)) {
    let line: AuditLine;
    try {
      line = JSON.parse(each) as AuditLine;
    } catch (problem) {
      return { lines, verdict: broken(`it is no JSON: ${(problem as Error).message}`) };
    }
    const { hash, ...rest } = line;
    if (rest.previous !== previous) return { lines, verdict: broken("it does not follow the line before it") };
    if (hash !== hashOf(rest)) return { lines, verdict: broken("its hash is another: it was changed") };
    if (rest.number !== lines.length + 1) return { lines, verdict: broken(`its number is ${rest.number}`) };
    lines.push(line);
    previous = hash;
  }
  return { lines, verdict: { kind: "whole", lines: lines.length, last: previous } };
}

export interface AuditLog {
  /** With the operating system when it returns, and on the disk soon after: no robot's link waits for a disk. */
  write(act: AuditAct): void;
  close(): void;
}

/**
 * Opens the log of a data folder to write at its end. What a crash left unfinished is taken away and said in the next
 * line; a log that was changed is not written on: throws with one sentence.
 */
export function openAuditLog(
  data: string,
  now_ms: () => number,
  onTrouble: (sentence: string) => void = sentence => {
    console.error(sentence);
  },
): AuditLog {
  mkdirSync(data, { recursive: true });
  const path = auditFile(data);
  const free = lock(data);
  const file = openSync(path, "a+", 0o600);
  const bytes = readFileSync(path);
  const whole = bytes.lastIndexOf(10) + 1;
  const { verdict } = readAudit(bytes.subarray(0, whole).toString("utf8"));
  if (verdict.kind === "broken") {
    closeSync(file);
    free();
    throw new AuditFault(
      `${path} was changed: line ${verdict.line}: ${verdict.sentence}.`,
      "Move the file away to begin a new one.",
    );
  }
  let { lines: number, last: previous } = verdict;
  let flushing = false;
  let unflushed = false;
  let closed = false;
  const flush = (): void => {
    unflushed = true;
    if (flushing) return;
    flushing = true;
    unflushed = false;
    fsync(file, problem => {
      flushing = false;
      if (closed) closeSync(file);
      else if (problem) onTrouble(`The audit log may not be on the disk: ${problem.message}.`);
      else if (unflushed) flush();
    });
  };
  const write = (act: AuditAct): void => {
    const rest = { number: number + 1, time: new Date(now_ms()).toISOString(), ...act, previous };
    const hash = hashOf(rest);
    writeSync(file, `${JSON.stringify({ ...rest, hash })}\n`);
    flush();
    number++;
    previous = hash;
  };
  if (whole < bytes.length) {
    ftruncateSync(file, whole);
    write({
      who: "server",
      action: "takes an unfinished line away",
      robot: "",
      detail: `${bytes.length - whole} bytes at the end of the log`,
      outcome: "done",
    });
  }
  return {
    write,
    close() {
      // A file number that was given back may be another file's by now.
      if (closed) return;
      fsyncSync(file);
      closed = true;
      // A flush that is under way keeps its file until it has ended.
      if (!flushing) closeSync(file);
      free();
    },
  };
}

/** Locks of this process. */
const held = new Set<string>();
/** Two servers that write one log would tear its chain. The lock of a process that is gone counts for nothing. */
function lock(data: string): () => void {
  const path = join(data, "audit.lock");
  const free = (): void => {
    held.delete(path);
    rmSync(path, { force: true });
  };
  for (;;) {
    try {
      writeFileSync(path, String(process.pid), { flag: "wx" });
      held.add(path);
      return free;
    } catch (problem) {
      if ((problem as NodeJS.ErrnoException).code !== "EEXIST") throw problem;
    }
    const owner = Number(readFileSync(path, "utf8"));
    // In a container every server has the same number: one of ours that we do not hold was left behind.
    if (owner === process.pid ? held.has(path) : runs(owner))
      throw new AuditFault(
        `Another server (process ${owner}) uses the data folder ${data}.`,
        "Give this one another with --data.",
      );
    free();
  }
}
function runs(process_id: number): boolean {
  if (!(process_id > 0)) return false;
  try {
    process.kill(process_id, 0);
    return true;
  } catch (problem) {
    return (problem as NodeJS.ErrnoException).code === "EPERM";
  }
}
