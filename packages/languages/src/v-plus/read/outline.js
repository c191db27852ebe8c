/** Control words in shapes that have no counterpart among the steps of a program. */
const OTHER = /^(?:FOR|WHILE|DO|UNTIL|IF|ELSE|END|CASE|VALUE|ANY|EXIT|GOTO|RETURN|CALL)\b|^[0-9]+\s|^\./i;
const NUMBER = "(-?[0-9.]+)", FACTOR = "\\(?(-?[0-9.]+)\\)?";
/** The structure of a text whose loops, calls and decisions are those of a neutral program; undefined for any other. */
export function outlineOf(lines) {
    const flat = lines.map(() => ""), programs = new Map(), numbers = new Map(), main = [];
    let list = main, started = false, plain = true;
    const open = [];
    const enter = (node, inside, ends = 1) => { list.push(node); open.push({ ends, outer: list, left: ends, node }); list = inside; plain = false; };
    for (let i = 0; i < lines.length; i++) {
        const text = lines[i].trim(), line = i + 1;
        if (text.startsWith(";")) {
            list.push(remark(text.slice(1).trim(), line));
            continue;
        }
        const code = text.includes("\"") ? text : text.replace(/\s*;.*$/, "");
        const header = /^\.PROGRAM\s+([A-Z][A-Z0-9_.]*)\s*\(\s*\)$/i.exec(code);
        if (header !== null) {
            if (open.length > 0)
                return undefined;
            if (started) {
                const name = header[1].toLowerCase(), outline = [];
                programs.set(name, { title: /;(.*)$/.exec(text)?.[1]?.trim() || name, outline });
                list = outline;
                plain = false;
            }
            else
                flat[i] = code;
            started = true;
            continue;
        }
        if (/^\.END$/i.test(code)) {
            if (open.length > 0)
                return undefined;
            continue;
        }
        const found = patternAt(lines, i);
        if (found !== undefined) {
            const inside = [];
            enter({ kind: "pallet", line, pattern: found.pattern, inside }, inside, 3);
            flat[i] = `SET ${found.pattern.place} = NULL`;
            i += found.lines - 1;
            continue;
        }
        const loop = /^FOR\s+([A-Z][A-Z0-9_.]*)\s*=\s*1\s+TO\s+([0-9]+)$/i.exec(code);
        if (loop !== null || /^WHILE\s+TRUE\s+DO$/i.test(code)) {
            const inside = [];
            enter({ kind: "repeat", line, times: loop === null ? "forever" : Number(loop[2]), inside }, inside);
            continue;
        }
        const choice = /^IF\s+SIG\s*\(\s*(-?)\s*([A-Z][A-Z0-9_.]*|[0-9]+)\s*\)\s+THEN$/i.exec(code);
        if (choice !== null) {
            const inside = [];
            enter({ kind: "if", line, signal: choice[2].toLowerCase(), is: choice[1] === "", then: inside }, inside);
            continue;
        }
        const block = open.at(-1);
        if (/^ELSE$/i.test(code)) {
            if (block?.node.kind !== "if" || block.node.else !== undefined)
                return undefined;
            block.node.else = list = [];
            continue;
        }
        if (/^END$/i.test(code)) {
            if (block === undefined)
                return undefined;
            if (--block.left === 0) {
                open.pop();
                list = block.outer;
            }
            continue;
        }
        // The loops of a pallet end together.
        if (block !== undefined && block.left < block.ends && code !== "")
            return undefined;
        const call = /^CALL\s+([A-Z][A-Z0-9_.]*)\s*(?:\(\s*\))?$/i.exec(code);
        if (call !== null) {
            list.push({ kind: "call", line, program: call[1].toLowerCase() });
            plain = false;
            continue;
        }
        if (/^(?:HALT|STOP)$/i.test(code)) {
            list.push({ kind: "stop", line });
            plain = false;
            continue;
        }
        if (OTHER.test(code))
            return undefined;
        const given = /^([A-Z][A-Z0-9_.]*)\s*=\s*([0-9]+)$/i.exec(code);
        if (given !== null)
            numbers.set(given[1].toLowerCase(), Number(given[2]));
        flat[i] = lines[i];
        if (code !== "")
            list.push({ kind: "line", line });
    }
    return open.length > 0 || !started ? undefined : { main, programs, numbers, flat: `${flat.join("\n")}\n.END\n`, plain };
}
/** `;== title` begins a group, `;- text` is a comment of its own, `;* text` is for whoever reads the file, `;name` names the next step. */
function remark(text, line) {
    if (text.startsWith("=="))
        return { kind: "group", line, text: text.replace(/^=+\s*/, "") };
    if (text.startsWith("-"))
        return { kind: "comment", line, text: text.slice(1).trim() };
    return { kind: "name", line, text: text.startsWith("*") ? "" : text };
}
/** The lines with which a pallet begins, if they stand here. */
function patternAt(lines, at) {
    let next = at;
    const match = (pattern) => new RegExp(`^\\s*${pattern}\\s*$`, "i").exec(lines[next++] ?? "");
    const first = match(`SET (\\w+) = TRANS\\(${Array.from({ length: 6 }, () => NUMBER).join(",")}\\)`), layers = first && match("FOR (\\w+) = 0 TO (\\d+)"), outer = layers && match("FOR (\\w+) = 0 TO (\\d+)");
    const inner = outer && match(`FOR (\\w+) = 0 TO (\\d+)(-\\(${outer[1]} MOD 2\\))?`);
    if (!inner)
        return undefined;
    const shifted = inner[3] !== undefined, o = outer[1], n = inner[1], last = Number(inner[2]);
    const zigzag = match(`(\\w+) = ${n}\\+\\(${o} MOD 2\\)\\*\\(${last - (shifted ? 1 : 0)}-2\\*${n}\\)`);
    if (zigzag === null)
        next--;
    const plain = zigzag === null && shifted ? match(`(\\w+) = ${n}`) : null;
    const along = zigzag?.[1] ?? plain?.[1] ?? n;
    if (shifted && match(`${along} = ${along}\\+0\\.5\\*\\(${o} MOD 2\\)`) === null)
        return undefined;
    const sum = `(\\w+)\\*${FACTOR}\\+(\\w+)\\*${FACTOR}\\+${layers[1]}\\*${FACTOR}`, shift = match(`SET (\\w+) = SHIFT\\(${first[1]} BY ${sum}, ${sum}, ${sum}\\)`);
    if (shift === null)
        return undefined;
    const part = (k) => [0, 1, 2].map(i => Number(shift[2 + 5 * i + k])), byRows = shift[2] === along && shift[4] === o;
    if (!byRows && !(shift[2] === o && shift[4] === along))
        return undefined;
    const outerCount = Number(outer[2]) + 1, innerCount = last + 1;
    return {
        lines: next - at,
        pattern: {
            place: shift[1].toLowerCase(), origin: first.slice(2, 8).map(Number), layers: Number(layers[2]) + 1, byRows, zigzag: zigzag !== null, shifted,
            rows: byRows ? outerCount : innerCount, columns: byRows ? innerCount : outerCount, column_mm: part(1), row_mm: part(3), layer_mm: part(4),
        },
    };
}
