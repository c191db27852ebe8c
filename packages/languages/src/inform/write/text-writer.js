/** The controller ends lines with CR LF. */
const LINE_END = "\r\n";
/** Collects lines together with the step that each came from. */
export class TextWriter {
    lines = [];
    steps = [];
    add(line, step = "") {
        this.lines.push(line);
        this.steps.push(step);
    }
    append({ lines, steps }) {
        for (const [i, line] of lines.entries())
            this.add(line, steps[i]);
    }
    file(name) {
        return { name, text: this.lines.map(line => line + LINE_END).join(""), lines: this.steps };
    }
}
