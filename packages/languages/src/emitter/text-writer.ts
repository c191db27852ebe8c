import type { EmittedFile } from "@twincell/core";

/** Most controllers end lines with CR LF. */
const LINE_END = "\r\n";

/** Collects lines together with the step that each came from, indented by blocks. */
export class BlockWriter {
  private readonly lines: string[] = [];
  private readonly steps: string[] = [];
  /** Blocks that are open. */
  depth = 0;

  add(line: string, step = ""): void {
    this.lines.push(line === "" ? "" : "  ".repeat(this.depth) + line);
    this.steps.push(step);
  }

  /** A line that opens a block, what is inside, and the line that closes it. */
  block(open: string, close: string, step: string, inside: () => void): void {
    this.add(open, step);
    this.depth++;
    inside();
    this.depth--;
    this.add(close, step);
  }

  /** The lines of what is inside go one level down. */
  indented(inside: () => void): void {
    this.depth++;
    inside();
    this.depth--;
  }

  /** All lines of another writer, at this depth. */
  append(other: BlockWriter): void {
    for (const [i, line] of other.lines.entries()) this.add(line, other.steps[i] ?? "");
  }

  file(name: string, lineEnd = LINE_END): EmittedFile {
    return { name, text: this.lines.map(line => line + lineEnd).join(""), lines: this.steps };
  }

  get count(): number {
    return this.lines.length;
  }

  /** Number and length of the longest line, from 1. */
  longest(): { readonly line: number; readonly length: number; readonly step: string } {
    let at = 0;
    for (const [i, line] of this.lines.entries()) if (line.length > (this.lines[at]?.length ?? 0)) at = i;
    return { line: at + 1, length: this.lines[at]?.length ?? 0, step: this.steps[at] ?? "" };
  }
}
