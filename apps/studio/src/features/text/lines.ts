import type { PointField, TextPoint } from "@twincell/languages";
import type { TextFile } from "@twincell/project";

let japanese: TextDecoder | undefined;

/** A stretch of a file as a person reads it: Shift-JIS is kept as bytes and decoded here. */
export function shownText(text: string, encoding: TextFile["encoding"]): string {
  if (encoding !== "shift-jis" || !/[\u0080-\u00ff]/.test(text)) return text;
  japanese ??= new TextDecoder("shift-jis");
  return japanese.decode(Uint8Array.from(text, character => character.charCodeAt(0)));
}

export interface LineSpan {
  readonly start: number;
  readonly end: number;
}

/** Where each line of a text begins and ends, its line end left out. */
export function lineSpans(text: string): readonly LineSpan[] {
  const spans: LineSpan[] = [];
  const ends = /\r\n|\n|\r/g;
  let start = 0;
  for (let match = ends.exec(text); match !== null; match = ends.exec(text)) {
    spans.push({ start, end: match.index });
    start = match.index + match[0].length;
  }
  if (start < text.length || spans.length === 0) spans.push({ start, end: text.length });
  return spans;
}

/** The places in one line where the name of a point stands. */
export function boxesIn(
  point: TextPoint | undefined,
  file: number,
  text: string,
  { start, end }: LineSpan,
): readonly LineSpan[] {
  if (point === undefined) return [];
  const boxes = point.uses
    .filter(use => use.file === file && use.start >= start && use.end <= end)
    .map(use => ({ start: use.start, end: use.end }));
  const { value } = point;
  if (point.name !== "" && value.file === file && value.start >= start && value.start <= end) {
    const before = text.slice(start, value.start).toLowerCase().lastIndexOf(point.name.toLowerCase());
    if (before >= 0) boxes.push({ start: start + before, end: start + before + point.name.length });
  }
  return boxes.sort((a, b) => a.start - b.start);
}

/** What of a line's numbers changed: "Z 802.3 → 752.3", two at most; "" when other things changed as well. */
export function changeOf(before: string | undefined, now: string): string {
  if (before === undefined || before === now) return "";
  const numbers = /[-+]?(?:\d+\.?\d*|\.\d+)/g;
  const old = before.match(numbers) ?? [];
  const matches = [...now.matchAll(numbers)];
  if (old.length !== matches.length) return "";
  const said = matches.flatMap((match, i) => {
    if (match[0] === old[i]) return [];
    const key = /([A-Za-z]\w*)[ \t:=]*$/.exec(now.slice(0, match.index))?.[1] ?? "";
    return [`${key} ${old[i]!} → ${match[0]}`.trim()];
  });
  return said.slice(0, 2).join(", ") + (said.length > 2 ? ` +${said.length - 2}` : "");
}

/** The numbers of a point as the text has them. */
export const numbersOf = (
  text: string,
  fields: readonly PointField[],
): readonly { readonly key: string; readonly value: string }[] =>
  fields.map(({ key, start, end }) => ({ key, value: text.slice(start, end).trim().replace(/^-/, "−") }));
