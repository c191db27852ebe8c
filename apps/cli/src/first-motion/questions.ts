import { createInterface } from "node:readline";
import type { Readable, Writable } from "node:stream";
import type { Answer, EvidenceStep } from "./evidence.ts";

/** Asks a person, one question after the other, and keeps what was said. */
export interface Questions {
  readonly asked: readonly EvidenceStep[];
  /** Nobody answers any more: the input has ended, or the questions were closed. */
  readonly ended: boolean;
  ask(id: string, question: string, measured?: EvidenceStep["measured"]): Promise<Answer>;
  /** Waits for a line, whatever it says; false at the end of the input. */
  wait(sentence: string): Promise<boolean>;
  close(): void;
}

const ANSWERS: Readonly<Record<string, Answer>> = {
  y: "yes",
  yes: "yes",
  n: "no",
  no: "no",
  s: "skipped",
  skip: "skipped",
};

/**
 * Questions on a terminal or a pipe. At the end of the input everything that is still asked counts as skipped.
 *
 * @param now  the time of an answer, ISO 8601.
 */
export function questionsOn(input: Readable, output: Writable, now = () => new Date().toISOString()): Questions {
  const lines = createInterface({ input });
  const waiting = lines[Symbol.asyncIterator]();
  const asked: EvidenceStep[] = [];
  let ended = false;
  const line = async (): Promise<string | null> => {
    const next = await waiting.next();
    if (next.done !== true) return next.value.trim().toLowerCase();
    ended = true;
    return null;
  };
  return {
    asked,
    get ended() {
      return ended;
    },
    async ask(id, question, measured) {
      output.write(`\n${question}\n  yes, no or skip: `);
      let said = await line();
      while (said !== null && ANSWERS[said] === undefined) {
        output.write("  yes, no or skip: ");
        said = await line();
      }
      const answer = said === null ? "skipped" : ANSWERS[said]!;
      asked.push({ id, question, answer, answered: now(), ...(measured === undefined ? {} : { measured }) });
      return answer;
    },
    async wait(sentence) {
      output.write(`\n${sentence}\n  Enter: `);
      return (await line()) !== null;
    },
    close() {
      lines.close();
    },
  };
}
