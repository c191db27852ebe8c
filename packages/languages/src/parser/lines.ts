/**
 * The lines of a text, whichever of CR LF, LF and CR ends them. A line end at the end of the text starts no new line.
 */
export function textLines(text: string): string[] {
  const lines = text.split(/\r\n|\n|\r/);
  if (lines.at(-1) === "") lines.pop();
  return lines;
}

const DASHES = /[\u2010-\u2015\u2212\uFE63\uFF0D]/g;
const BLANKS = /[\u00A0\u1680\u2000-\u200A\u202F\u205F\u3000\uFEFF\t]/g;

/**
 * Typographic dashes as ASCII minus and typographic blanks as ASCII blanks: what a PDF or a word processor makes of
 * program text. One character for one, so that columns stay true.
 */
export const plainText = (line: string): string => line.replace(DASHES, "-").replace(BLANKS, " ");

/** ASCII for a comment or a name: accents are dropped, ligatures written out, other letters become `?`. */
export function asciiText(text: string): string {
  return text
    .replace(/ß/g, "ss")
    .replace(/[æÆ]/g, "ae")
    .replace(/[øØ]/g, "o")
    .replace(DASHES, "-")
    .replace(/[“”]/g, '"')
    .replace(/[‘’]/g, "'")
    .normalize("NFKD")
    .replace(/[\u0300-\u036f]/g, "")
    .replace(/\s+/g, " ")
    .replace(/[^ -~]/g, "?")
    .trim();
}
