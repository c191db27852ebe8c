/** V+ disk files end their lines with CR LF. */
const LINE_END = "\r\n";
/** Collects lines together with the step that each came from. */
export class TextWriter {
    lines = [];
    steps = [];
    add(line, step = "") {
        this.lines.push(line);
        this.steps.push(step);
    }
    file(name) {
        return { name, text: this.lines.map(line => line + LINE_END).join(""), lines: this.steps };
    }
}
