// Finds code that two languages, or two controllers, hold word for word: what is common belongs into a shared folder.
//   node scripts/clones.mjs [folder…]   prints the pairs; exit 1 when there is one
import { readdirSync, readFileSync } from "node:fs";
import { join, relative, sep } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import ts from "typescript";

const root = fileURLToPath(new URL("..", import.meta.url));
/** Folders whose own folders are compared with each other. */
const LOOKED_AT = ["packages/languages/src", "packages/controllers/src"];

/** A pair is reported from this many lines that hold code, and this many tokens, on. */
export const LEAST_LINES = 15;
export const LEAST_TOKENS = 50;

const { SyntaxKind: Kind } = ts;
/** Behind these a slash divides; elsewhere it begins a regular expression. */
const ENDS_A_VALUE = new Set([
  Kind.Identifier,
  Kind.NumericLiteral,
  Kind.BigIntLiteral,
  Kind.StringLiteral,
  Kind.NoSubstitutionTemplateLiteral,
  Kind.TemplateTail,
  Kind.CloseParenToken,
  Kind.CloseBracketToken,
  Kind.CloseBraceToken,
  Kind.ThisKeyword,
  Kind.SuperKeyword,
  Kind.TrueKeyword,
  Kind.FalseKeyword,
  Kind.NullKeyword,
]);

/** The tokens of a text with the lines they begin in; comments, imports and what is passed on from files are left out. */
export function tokensOf(text) {
  const tokens = withoutImports(scanned(text));
  const starts = lineStarts(text);
  let line = 0;
  return tokens.map(({ at, word }) => {
    while (line + 1 < starts.length && starts[line + 1] <= at) line++;
    return { word, line: line + 1 };
  });
}

function scanned(text) {
  const scanner = ts.createScanner(ts.ScriptTarget.Latest, true, ts.LanguageVariant.Standard, text);
  const tokens = [];
  // How many braces are open inside each template that is open.
  const templates = [];
  let previous = Kind.Unknown;
  for (;;) {
    let kind = scanner.scan();
    if (kind === Kind.EndOfFileToken) return tokens;
    if ((kind === Kind.SlashToken || kind === Kind.SlashEqualsToken) && !ENDS_A_VALUE.has(previous))
      kind = scanner.reScanSlashToken();
    if (kind === Kind.CloseBraceToken && templates.at(-1) === 0) {
      kind = scanner.reScanTemplateToken(false);
      if (kind === Kind.TemplateTail) templates.pop();
    } else if (templates.length > 0 && kind === Kind.OpenBraceToken) templates[templates.length - 1]++;
    else if (templates.length > 0 && kind === Kind.CloseBraceToken) templates[templates.length - 1]--;
    if (kind === Kind.TemplateHead) templates.push(0);
    tokens.push({ kind, at: scanner.getTokenStart(), word: scanner.getTokenText() });
    previous = kind;
  }
}

function withoutImports(tokens) {
  const kept = [];
  for (let i = 0; i < tokens.length; ) {
    const end = endOfImport(tokens, i);
    if (end > i) i = end;
    else kept.push(tokens[i++]);
  }
  return kept;
}

/** Behind the import, or the export from a file, that begins at a token; the token itself where none does. */
function endOfImport(tokens, from) {
  const isImport = tokens[from].kind === Kind.ImportKeyword;
  if (!isImport && tokens[from].kind !== Kind.ExportKeyword) return from;
  let i = from + 1;
  if (tokens[i]?.word === "type") i++;
  if (isImport && tokens[i]?.kind === Kind.StringLiteral) return pastSemicolon(tokens, i + 1);
  if (isImport ? ["(", "."].includes(tokens[i]?.word) : !["{", "*"].includes(tokens[i]?.word)) return from;
  while (i < tokens.length && tokens[i].kind !== Kind.FromKeyword && tokens[i].kind !== Kind.SemicolonToken) i++;
  return tokens[i]?.kind === Kind.FromKeyword ? pastSemicolon(tokens, i + 2) : from;
}

const pastSemicolon = (tokens, i) => (tokens[i]?.kind === Kind.SemicolonToken ? i + 1 : i);

function lineStarts(text) {
  const starts = [0];
  for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", at + 1)) starts.push(at + 1);
  return starts;
}

/**
 * The pairs of equal code between files of different folders, longest first.
 *
 * @param files  each with the `folder` it counts to, its `path` and its `text`.
 * @returns pairs `{ lines, tokens, sides: [{ path, first, last }, …] }`, lines counted from 1.
 */
export function clonesIn(files) {
  const scannedFiles = files.map(({ folder, path, text }) => ({ folder, path, tokens: tokensOf(text) }));
  const places = placesByWindow(scannedFiles);
  const found = [];
  for (const same of places.values()) {
    for (const [n, a] of same.entries()) {
      for (const b of same.slice(n + 1)) {
        const pair = a.file.folder === b.file.folder ? undefined : pairAt(a, b);
        if (pair !== undefined && !found.some(other => holds(other, pair))) found.push(pair);
      }
    }
  }
  return found.sort((a, b) => b.lines - a.lines || (a.sides[0].path < b.sides[0].path ? -1 : 1));
}

/** Where each run of `LEAST_TOKENS` tokens stands; runs that stand at one place alone are left out. */
function placesByWindow(files) {
  const BASE = 1_000_003;
  const MODULUS = 2 ** 31 - 1;
  const times = (a, b) => Number((BigInt(a) * BigInt(b)) % BigInt(MODULUS));
  const numbers = new Map();
  let highest = 1;
  for (let i = 1; i < LEAST_TOKENS; i++) highest = times(highest, BASE);
  const places = new Map();
  for (const file of files) {
    let hash = 0;
    const words = file.tokens.map(({ word }) => {
      if (!numbers.has(word)) numbers.set(word, numbers.size + 1);
      return numbers.get(word);
    });
    for (let i = 0; i < words.length; i++) {
      if (i >= LEAST_TOKENS) hash = (hash - times(words[i - LEAST_TOKENS], highest) + MODULUS) % MODULUS;
      hash = (times(hash, BASE) + words[i]) % MODULUS;
      if (i < LEAST_TOKENS - 1) continue;
      const place = { file, at: i - LEAST_TOKENS + 1 };
      const same = places.get(hash);
      if (same === undefined) places.set(hash, [place]);
      else same.push(place);
    }
  }
  for (const [hash, same] of places) if (same.length < 2) places.delete(hash);
  return places;
}

/** The whole of what is equal from two places on; undefined where it began earlier, or is short. */
function pairAt(a, b) {
  const [left, right] = [a.file.tokens, b.file.tokens];
  if (a.at > 0 && b.at > 0 && left[a.at - 1].word === right[b.at - 1].word) return undefined;
  let tokens = 0;
  while (
    a.at + tokens < left.length &&
    b.at + tokens < right.length &&
    left[a.at + tokens].word === right[b.at + tokens].word
  )
    tokens++;
  if (tokens < LEAST_TOKENS) return undefined;
  const sides = [side(a, tokens), side(b, tokens)];
  const lines = Math.min(...sides.map(each => each.lines));
  return lines < LEAST_LINES ? undefined : { lines, tokens, sides };
}

function side({ file, at }, count) {
  const lines = file.tokens.slice(at, at + count).map(({ line }) => line);
  return { path: file.path, first: lines[0], last: lines.at(-1), lines: new Set(lines).size };
}

/** Whether one pair holds another, shifted: tables that repeat themselves. */
const holds = (outer, inner) =>
  outer.sides.every(
    ({ path, first, last }, i) =>
      path === inner.sides[i].path && first <= inner.sides[i].first && last >= inner.sides[i].last,
  );

/** The files of a folder, each counting to the folder at the top that it stands in; tests apart. */
export function filesOf(folder) {
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter(entry => entry.isFile() && entry.name.endsWith(".ts") && !entry.name.endsWith(".test.ts"))
    .map(entry => join(entry.parentPath, entry.name))
    .filter(path => !path.split(sep).includes("testing"))
    .sort()
    .map(path => {
      const [top, ...below] = relative(folder, path).split(sep);
      return {
        folder: join(folder, below.length > 0 ? top : "."),
        path: relative(root, path),
        text: readFileSync(path, "utf8"),
      };
    });
}

export const sentence = ({ lines, tokens, sides: [a, b] }) =>
  `${lines} lines (${tokens} tokens): ${a.path}:${a.first}-${a.last} and ${b.path}:${b.first}-${b.last}`;

if (process.argv[1] !== undefined && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const folders = process.argv.length > 2 ? process.argv.slice(2) : LOOKED_AT.map(folder => join(root, folder));
  const pairs = folders.flatMap(folder => clonesIn(filesOf(folder)));
  for (const pair of pairs) console.log(sentence(pair));
  console.log(
    pairs.length === 0
      ? "clones: none between two folders."
      : `clones: ${pairs.length} between two folders; move what is common into a shared folder.`,
  );
  process.exit(pairs.length === 0 ? 0 : 1);
}
