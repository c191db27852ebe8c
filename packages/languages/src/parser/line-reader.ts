import type { TextFault } from "@twincell/core";
import { TextError } from "./faults.ts";
import { textLines } from "./lines.ts";

/** More faults than this help nobody. */
const MOST_FAULTS = 50;

/** Reads a text line by line. Goes on after a fault, so that all of them are told at once. */
export abstract class LineReader {
  readonly faults: TextFault[] = [];

  /** @param line  counted from 1. @throws {TextError} */
  protected abstract line(text: string, line: number): void;
  /** @param line  the one behind the last. @throws {TextError} for what is still open. */
  protected abstract end(line: number): void;

  /** What becomes of a fault. */
  protected fault(cause: TextError): void {
    this.faults.push(cause.fault);
  }

  /** The faults of the text, if there are any. */
  read(text: string): { readonly kind: "not-understood"; readonly faults: readonly TextFault[] } | undefined {
    const lines = textLines(text);
    for (const [i, line] of lines.entries()) {
      this.guarded(() => {
        this.line(line, i + 1);
      });
      if (this.faults.length >= MOST_FAULTS) break;
    }
    this.guarded(() => {
      this.end(lines.length + 1);
    });
    return this.faults.length > 0 ? { kind: "not-understood", faults: this.faults } : undefined;
  }

  private guarded(read: () => void): void {
    try {
      read();
    } catch (cause) {
      if (!(cause instanceof TextError)) throw cause;
      this.fault(cause);
    }
  }
}
