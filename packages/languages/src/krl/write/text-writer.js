/** A KUKA controller ends lines with CR LF. */
const LINE_END = "\r\n";
/** Collects lines together with the step that each came from. */
export class TextWriter {
    depth = 0;
    lines = [];
    steps = [];
    add(line, step = "") {
        this.lines.push(line === "" ? "" : "  ".repeat(this.depth) + line);
        this.steps.push(step);
    }
    /** All lines of another writer, at this place. */
    append({ lines, steps }) {
        for (const [i, line] of lines.entries())
            this.add(line, steps[i]);
    }
    get collected() { return { lines: this.lines, steps: this.steps }; }
    file(name) {
        return { name, text: this.lines.map(line => line + LINE_END).join(""), lines: this.steps };
    }
}
