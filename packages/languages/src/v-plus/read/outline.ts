/** What the lines of a text are to its structure, in their order. Lines count from 1. */
export type Outline = readonly Node[];
export type Node =
  /** A line that the controller carries out by itself: a motion, a setting, a wait. */
  | { readonly kind: "line"; readonly line: number }
  | { readonly kind: "name" | "group" | "comment"; readonly line: number; readonly text: string }
  | { readonly kind: "call"; readonly line: number; readonly program: string }
  | { readonly kind: "stop"; readonly line: number }
  | { readonly kind: "repeat"; readonly line: number; readonly times: number | "forever"; readonly inside: Node[] }
  | {
      readonly kind: "if";
      readonly line: number;
      readonly signal: string;
      readonly is: boolean;
      readonly then: Node[];
      else?: Node[];
    }
  | { readonly kind: "pallet"; readonly line: number; readonly pattern: Pattern; readonly inside: Node[] };

/** A pallet as its loops say it: the first place as six components, pitches in mm along the axes of the controller. */
export interface Pattern {
  readonly place: string;
  readonly origin: readonly number[];
  readonly rows: number;
  readonly columns: number;
  readonly layers: number;
  readonly byRows: boolean;
  readonly zigzag: boolean;
  readonly shifted: boolean;
  readonly column_mm: readonly number[];
  readonly row_mm: readonly number[];
  readonly layer_mm: readonly number[];
}

export interface Structure {
  /** The first program of the text. */
  readonly main: Outline;
  /** The others, by their names in the text. */
  readonly programs: ReadonlyMap<string, { readonly title: string; readonly outline: Outline }>;
  /** Numbers given to variables by a line of their own. */
  readonly numbers: ReadonlyMap<string, number>;
  /** The text without its structure: every line in its place, to be executed once from top to bottom. */
  readonly flat: string;
  /** Nothing but lines. */
  readonly plain: boolean;
}

/** Control words in shapes that have no counterpart among the steps of a program. */
const OTHER = /^(?:FOR|WHILE|DO|UNTIL|IF|ELSE|END|CASE|VALUE|ANY|EXIT|GOTO|RETURN|CALL)\b|^[0-9]+\s|^\./i;
const NUMBER = "(-?[0-9.]+)";
const FACTOR = "\\(?(-?[0-9.]+)\\)?";

/** The structure of a text whose loops, calls and decisions are those of a neutral program; undefined for any other. */
export function outlineOf(lines: readonly string[]): Structure | undefined {
  const reader = new OutlineReader(lines);
  for (let i = 0; i < lines.length; ) {
    const read = reader.line(i);
    if (read === "other") return undefined;
    i += read;
  }
  return reader.structure();
}

class OutlineReader {
  private readonly lines: readonly string[];
  private readonly flat: string[];
  private readonly programs = new Map<string, { title: string; outline: Node[] }>();
  private readonly numbers = new Map<string, number>();
  private readonly main: Node[] = [];
  private list = this.main;
  private started = false;
  private plain = true;
  private readonly open: { readonly ends: number; readonly outer: Node[]; left: number; readonly node: Node }[] = [];

  constructor(lines: readonly string[]) {
    this.lines = lines;
    this.flat = lines.map(() => "");
  }

  structure(): Structure | undefined {
    const { main, programs, numbers, plain } = this;
    return this.open.length > 0 || !this.started
      ? undefined
      : { main, programs, numbers, flat: `${this.flat.join("\n")}\n.END\n`, plain };
  }

  private enter(node: Node, inside: Node[], ends = 1): void {
    this.list.push(node);
    this.open.push({ ends, outer: this.list, left: ends, node });
    this.list = inside;
    this.plain = false;
  }

  /** @returns how many lines were read; "other" for what has no counterpart among the steps of a program. */
  line(i: number): number | "other" {
    const text = this.lines[i]!.trim();
    const line = i + 1;
    if (text.startsWith(";")) {
      this.list.push(remark(text.slice(1).trim(), line));
      return 1;
    }
    const code = text.includes('"') ? text : text.replace(/\s*;.*$/, "");
    const header = /^\.PROGRAM\s+([A-Z][A-Z0-9_.]*)\s*\(\s*\)$/i.exec(code);
    if (header !== null) return this.header(header[1]!.toLowerCase(), text, code, i);
    if (/^\.END$/i.test(code)) return this.open.length > 0 ? "other" : 1;
    const found = patternAt(this.lines, i);
    if (found !== undefined) {
      const inside: Node[] = [];
      this.enter({ kind: "pallet", line, pattern: found.pattern, inside }, inside, 3);
      this.flat[i] = `SET ${found.pattern.place} = NULL`;
      return found.lines;
    }
    if (this.opens(code, line)) return 1;
    const block = this.open.at(-1);
    if (/^ELSE$/i.test(code)) {
      if (block?.node.kind !== "if" || block.node.else !== undefined) return "other";
      block.node.else = this.list = [];
      return 1;
    }
    if (/^END$/i.test(code)) return this.closes() ? 1 : "other";
    // The loops of a pallet end together.
    if (block !== undefined && block.left < block.ends && code !== "") return "other";
    return this.statement(code, line) ? 1 : "other";
  }

  private header(name: string, text: string, code: string, i: number): 1 | "other" {
    if (this.open.length > 0) return "other";
    if (this.started) {
      const outline: Node[] = [];
      this.programs.set(name, { title: /;(.*)$/.exec(text)?.[1]?.trim() || name, outline });
      this.list = outline;
      this.plain = false;
    } else this.flat[i] = code;
    this.started = true;
    return 1;
  }

  /** Whether the line opens a loop or a decision. */
  private opens(code: string, line: number): boolean {
    const inside: Node[] = [];
    const loop = /^FOR\s+([A-Z][A-Z0-9_.]*)\s*=\s*1\s+TO\s+([0-9]+)$/i.exec(code);
    if (loop !== null || /^WHILE\s+TRUE\s+DO$/i.test(code)) {
      this.enter({ kind: "repeat", line, times: loop === null ? "forever" : Number(loop[2]), inside }, inside);
      return true;
    }
    const choice = /^IF\s+SIG\s*\(\s*(-?)\s*([A-Z][A-Z0-9_.]*|[0-9]+)\s*\)\s+THEN$/i.exec(code);
    if (choice === null) return false;
    this.enter({ kind: "if", line, signal: choice[2]!.toLowerCase(), is: choice[1] === "", then: inside }, inside);
    return true;
  }

  private closes(): boolean {
    const block = this.open.at(-1);
    if (block === undefined) return false;
    if (--block.left === 0) {
      this.open.pop();
      this.list = block.outer;
    }
    return true;
  }

  private statement(code: string, line: number): boolean {
    const call = /^CALL\s+([A-Z][A-Z0-9_.]*)\s*(?:\(\s*\))?$/i.exec(code);
    if (call !== null) {
      this.list.push({ kind: "call", line, program: call[1]!.toLowerCase() });
      this.plain = false;
      return true;
    }
    if (/^(?:HALT|STOP)$/i.test(code)) {
      this.list.push({ kind: "stop", line });
      this.plain = false;
      return true;
    }
    if (OTHER.test(code)) return false;
    const given = /^([A-Z][A-Z0-9_.]*)\s*=\s*([0-9]+)$/i.exec(code);
    if (given !== null) this.numbers.set(given[1]!.toLowerCase(), Number(given[2]));
    this.flat[line - 1] = this.lines[line - 1]!;
    if (code !== "") this.list.push({ kind: "line", line });
    return true;
  }
}

/**
 * `;== title` begins a group, `;- text` is a comment of its own, `;* text` is for whoever reads the file, `;name` names
 * the next step.
 */
function remark(text: string, line: number): Node {
  if (text.startsWith("==")) return { kind: "group", line, text: text.replace(/^=+\s*/, "") };
  if (text.startsWith("-")) return { kind: "comment", line, text: text.slice(1).trim() };
  return { kind: "name", line, text: text.startsWith("*") ? "" : text };
}

/** The lines with which a pallet begins, if they stand here. */
function patternAt(
  lines: readonly string[],
  at: number,
): { readonly pattern: Pattern; readonly lines: number } | undefined {
  let next = at;
  const match = (pattern: string): RegExpExecArray | null =>
    new RegExp(`^\\s*${pattern}\\s*$`, "i").exec(lines[next++] ?? "");
  const nest = nestOf(match);
  if (nest === undefined) return undefined;
  const { first, layers, outer, inner } = nest;
  const shifted = inner[3] !== undefined;
  const o = outer[1]!;
  const n = inner[1]!;
  const last = Number(inner[2]);
  const zigzag = match(`(\\w+) = ${n}\\+\\(${o} MOD 2\\)\\*\\(${last - (shifted ? 1 : 0)}-2\\*${n}\\)`);
  if (zigzag === null) next--;
  const plain = zigzag === null && shifted ? match(`(\\w+) = ${n}`) : null;
  const along = zigzag?.[1] ?? plain?.[1] ?? n;
  if (shifted && match(`${along} = ${along}\\+0\\.5\\*\\(${o} MOD 2\\)`) === null) return undefined;
  const sum = `(\\w+)\\*${FACTOR}\\+(\\w+)\\*${FACTOR}\\+${layers[1]!}\\*${FACTOR}`;
  const shift = match(`SET (\\w+) = SHIFT\\(${first[1]!} BY ${sum}, ${sum}, ${sum}\\)`);
  if (shift === null) return undefined;
  const part = (k: number): number[] => [0, 1, 2].map(i => Number(shift[2 + 5 * i + k]));
  const byRows = shift[2] === along && shift[4] === o;
  if (!byRows && !(shift[2] === o && shift[4] === along)) return undefined;
  const outerCount = Number(outer[2]) + 1;
  const innerCount = last + 1;
  return {
    lines: next - at,
    pattern: {
      place: shift[1]!.toLowerCase(),
      origin: first.slice(2, 8).map(Number),
      layers: Number(layers[2]) + 1,
      byRows,
      zigzag: zigzag !== null,
      shifted,
      rows: byRows ? outerCount : innerCount,
      columns: byRows ? innerCount : outerCount,
      column_mm: part(1),
      row_mm: part(3),
      layer_mm: part(4),
    },
  };
}

/** The first place and the three loops that a pattern begins with. */
function nestOf(
  match: (pattern: string) => RegExpExecArray | null,
): Readonly<Record<"first" | "layers" | "outer" | "inner", RegExpExecArray>> | undefined {
  const first = match(`SET (\\w+) = TRANS\\(${Array.from({ length: 6 }, () => NUMBER).join(",")}\\)`);
  const layers = first && match("FOR (\\w+) = 0 TO (\\d+)");
  const outer = layers && match("FOR (\\w+) = 0 TO (\\d+)");
  const inner = outer && match(`FOR (\\w+) = 0 TO (\\d+)(-\\(${outer[1]!} MOD 2\\))?`);
  return inner ? { first, layers, outer, inner } : undefined;
}
