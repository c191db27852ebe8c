import type { EmittedFile } from "@twincell/core";

/** V+ disk files end their lines with CR LF. */
const LINE_END = "\r\n";

/** Collects lines together with the step that each came from. */
export class TextWriter {
  private readonly lines: string[] = [];
  private readonly steps: string[] = [];

  add(line: string, step = ""): void {
    this.lines.push(line);
    this.steps.push(step);
  }

  file(name: string): EmittedFile {
    return { name, text: this.lines.map(line => line + LINE_END).join(""), lines: this.steps };
  }
}
