import type { EmittedFile } from "@twincell/core";

/** A KUKA controller ends lines with CR LF. */
const LINE_END = "\r\n";

/** Collects lines together with the step that each came from. */
export class TextWriter {
  depth = 0;
  private readonly lines: string[] = [];
  private readonly steps: string[] = [];

  add(line: string, step = ""): void {
    this.lines.push(line === "" ? "" : "  ".repeat(this.depth) + line);
    this.steps.push(step);
  }

  /** All lines of another writer, at this place. */
  append({ lines, steps }: { readonly lines: readonly string[]; readonly steps: readonly string[] }): void {
    for (const [i, line] of lines.entries()) this.add(line, steps[i]!);
  }

  get collected(): { readonly lines: readonly string[]; readonly steps: readonly string[] } {
    return { lines: this.lines, steps: this.steps };
  }

  file(name: string): EmittedFile {
    return { name, text: this.lines.map(line => line + LINE_END).join(""), lines: this.steps };
  }
}
