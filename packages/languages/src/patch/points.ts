/*
 * The taught points of a vendor's text: where each stands, what its numbers are and which motions go there. Only what a
 * programmer touches up on the pendant is a point: a literal target, or a constant that is given a value in one place.
 */

/** A file of a project; `text` with its own line ends. */
export interface PatchFile {
  readonly name: string;
  readonly text: string;
}

/** A place in a file: offsets from `start` to before `end`, and the line of `start`, counted from 1. */
export interface TextSpan {
  /** Index into the list of files. */
  readonly file: number;
  readonly line: number;
  readonly start: number;
  readonly end: number;
}

/** One number of a point, or its configuration where that is a text. */
export interface PointField {
  /** "X", "A1", "Q1", "CF1", "CONFIG" … as the language calls it, upper case. */
  readonly key: string;
  readonly start: number;
  readonly end: number;
}

export interface PointUse extends TextSpan {
  /** Line where the motion begins: the one that is executed. */
  readonly motionLine: number;
  /** False where the motion computes its target from the point: a shift, a product of frames. */
  readonly whole: boolean;
}

export interface TextPoint {
  /** What the text calls it; "" for a literal in the motion itself. */
  readonly name: string;
  readonly kind: "joints" | "pose";
  /** The value as it stands, brackets included. */
  readonly value: TextSpan;
  readonly fields: readonly PointField[];
  /** Motions that go there, in the order of the text. */
  readonly uses: readonly PointUse[];
  /** Why it cannot be touched up; undefined when it can. */
  readonly fixed?: string;
}

export type FoundPoints =
  | { readonly kind: "found"; readonly points: readonly TextPoint[] }
  /** The language's points are not found yet, with the reason. */
  | { readonly kind: "not-yet"; readonly because: string };

/** A value found in a text before it is known what goes there. */
export interface Defined {
  readonly name: string;
  readonly kind: TextPoint["kind"];
  readonly value: TextSpan;
  readonly fields: readonly PointField[];
  /** Of a literal in a motion: where that begins. */
  readonly motionLine?: number;
  /** It is a point even where no motion of these files goes to it. */
  readonly taught: boolean;
}
export interface Used {
  readonly name: string;
  readonly use: PointUse;
}

/** Line numbers of a text by offset: a binary search over its line starts. LF, CR LF and CR end a line. */
export class LineIndex {
  private readonly starts: number[] = [0];
  constructor(text: string) {
    for (let i = 0; i < text.length; i++) {
      const code = text.charCodeAt(i);
      if (code === 10 || (code === 13 && text.charCodeAt(i + 1) !== 10)) this.starts.push(i + 1);
    }
  }
  lineAt(offset: number): number {
    let low = 0;
    let high = this.starts.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.starts[middle]! <= offset) low = middle;
      else high = middle - 1;
    }
    return low + 1;
  }
}

/** The same text with comments and strings blanked, so that every offset stays. */
export const masked = (text: string, hidden: RegExp): string =>
  text.replace(hidden, found => found.replace(/[^\r\n]/g, " "));

export const NUMBER = String.raw`[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?`;

/** Offsets of all numbers between two places of a text. */
export function numbersIn(
  text: string,
  start: number,
  end: number,
): { readonly start: number; readonly end: number }[] {
  const pattern = new RegExp(NUMBER, "g");
  const found: { start: number; end: number }[] = [];
  pattern.lastIndex = start;
  for (let match = pattern.exec(text); match !== null && match.index < end; match = pattern.exec(text))
    found.push({ start: match.index, end: match.index + match[0].length });
  return found;
}

/** The offset behind the bracket that closes the one at `open`; -1 when none does. */
export function closing(text: string, open: number): number {
  const pairs: Readonly<Record<string, string>> = { "(": ")", "[": "]", "{": "}" };
  const wanted: string[] = [];
  for (let i = open; i < text.length; i++) {
    const character = text[i]!;
    const close = pairs[character];
    if (close !== undefined) wanted.push(close);
    else if (character === wanted.at(-1)) {
      wanted.pop();
      if (wanted.length === 0) return i + 1;
    } else if (character === ")" || character === "]" || character === "}") return -1;
  }
  return -1;
}

/** The arguments between two offsets, split at commas outside brackets. */
export function argumentsIn(
  text: string,
  start: number,
  end: number,
): { readonly start: number; readonly end: number }[] {
  const parts: { start: number; end: number }[] = [];
  let depth = 0;
  let from = start;
  const add = (to: number): void => {
    let [a, b] = [from, to];
    while (a < b && /\s/.test(text[a]!)) a++;
    while (b > a && /\s/.test(text[b - 1]!)) b--;
    parts.push({ start: a, end: b });
    from = to + 1;
  };
  for (let i = start; i < end; i++) {
    const character = text[i]!;
    if (character === "(" || character === "[" || character === "{") depth++;
    else if (character === ")" || character === "]" || character === "}") depth--;
    else if (character === "," && depth === 0) add(i);
  }
  add(end);
  return parts;
}

/**
 * Brings values and motions together. A name means the value in the same file or in its sibling of the same base name
 * (a module's .src and .dat), else one of another file. A name that is given several values in one module cannot be
 * touched up.
 */
export function together(files: readonly PatchFile[], defined: readonly Defined[], used: readonly Used[]): TextPoint[] {
  const module = files.map(file =>
    file.name
      .replace(/^.*[/\\]/, "")
      .replace(/\.[^.]*$/, "")
      .toLowerCase(),
  );
  const key = (file: number, name: string): string => `${module[file]}\n${name}`;
  const own = new Map<string, Defined[]>();
  const anywhere = new Map<string, Defined[]>();
  const put = (map: Map<string, Defined[]>, at: string, value: Defined): void => {
    const list = map.get(at);
    if (list === undefined) map.set(at, [value]);
    else list.push(value);
  };
  for (const value of defined) {
    if (value.name === "") continue;
    put(own, key(value.value.file, value.name.toLowerCase()), value);
    put(anywhere, value.name.toLowerCase(), value);
  }
  const uses = new Map<Defined, PointUse[]>();
  for (const { name, use } of used) {
    const lower = name.toLowerCase();
    for (const value of own.get(key(use.file, lower)) ?? anywhere.get(lower) ?? []) {
      const list = uses.get(value);
      if (list === undefined) uses.set(value, [use]);
      else list.push(use);
    }
  }
  return defined.flatMap((value): TextPoint[] => {
    const { taught, motionLine, ...point } = value;
    if (value.name === "")
      return [{ ...point, uses: [{ ...value.value, motionLine: motionLine ?? value.value.line, whole: true }] }];
    const motions = uses.get(value) ?? [];
    if (motions.length === 0 && !taught) return [];
    const values = own.get(key(value.value.file, value.name.toLowerCase()))!;
    const fixed =
      values.length > 1
        ? `${value.name} gets a value in ${values.length} places (lines ${values.map(each => each.value.line).join(", ")}): which of them a motion means is decided while it runs.`
        : undefined;
    return [{ ...point, uses: motions, ...(fixed === undefined ? {} : { fixed }) }];
  });
}
