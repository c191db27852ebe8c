import type { EmittedFile } from "@twincell/core";

/** The controller ends lines with CR LF. */
const LINE_END = "\r\n";

/** Collects lines together with the step that each came from. */
export class TextWriter {
  private readonly lines: string[] = [];
  private readonly steps: string[] = [];

  add(line: string, step = ""): void {
    this.lines.push(line);
    this.steps.push(step);
  }

  append({ lines, steps }: TextWriter): void {
    for (const [i, line] of lines.entries()) this.add(line, steps[i]!);
  }

  file(name: string): EmittedFile {
    return { name, text: this.lines.map(line => line + LINE_END).join(""), lines: this.steps };
  }
}
