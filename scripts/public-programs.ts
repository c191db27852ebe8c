// How many public vendor programs open as they are: npm run public-programs FOLDER [-- --write] [-- --faults krl]
//
// FOLDER holds one folder a repository, named owner+name, with its files at their paths. Nothing is downloaded; without
// the folder there is nothing to count. Files are split by hash: with --faults only those of the half to work on are
// named, the other half is only counted. --write keeps counts, paths and hashes in docs/public-programs.json; texts
// never.
import { createHash } from "node:crypto";
import { existsSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, extname, join, relative } from "node:path";
import { LIBRARY, type Dialect, type Robot } from "@twincell/core";
import { DIALECTS, EXAMPLE_PULSES, executeText, informDialect, joinFiles } from "@twincell/languages";
import { textFileOf, type TextFile } from "@twincell/project";

/** Which dialect the words of a file belong to, its ending being shared by several. */
const SIGNS: readonly (readonly [id: string, endings: RegExp, words: RegExp])[] = [
  ["krl", /\.(src|sub)$/i, /^\s*(?:GLOBAL\s+)?DEF(?:FCT)?\b/im],
  ["rapid", /\.(mod|modx|sys|prg)$/i, /^\s*(?:MODULE\s+\w+|%%%)/im],
  ["inform", /\.jbi$/i, /^\/JOB/m],
  ["urscript", /\.(script|urscript)$/i, /\b(?:move[jlpc]|set_digital_out|def)\b/],
  ["fanuc-ls", /\.ls$/i, /^\s*\/PROG\b/im],
  ["val3", /\.pgx$/i, /<Program/],
  ["kawasaki-as", /\.(as|pg)$/i, /^\s*\.PROGRAM\b/im],
  ["v-plus", /\.(v2|pg|v)$/i, /^\s*\.PROGRAM\b/im],
  ["spel", /\.prg$/i, /^\s*Function\s+\w+/im],
  ["melfa-basic", /\.(prg|mb4|mb5)$/i, /^\s*(?:\d+\s+)?(?:Mov|Mvs|Ovrd|Def Pos|Spd)\b/im],
  ["pacscript", /\.(pcs|pac)$/i, /^\s*(?:Sub|Program)\b/im],
];
/** A file without one of these asks no robot to move and is not counted. */
const MOTION: Readonly<Record<string, RegExp>> = {
  krl: /^\s*S?(?:PTP|LIN|CIRC)(?:_REL)?\b/im,
  rapid: /^\s*Move(?:AbsJ|J|L|C)\w*\s/im,
  inform: /^(?:MOV[JLCS]|SMOVL|IMOV)\b/m,
  urscript: /\bmove[jlpc]\s*\(/,
  "fanuc-ls": /^\s*\d*:\s*[JLCA]\s+P/m,
  val3: /\bmove[jlc]\s*\(/i,
  "kawasaki-as": /^\s*[JLC]\d?MOVE\b|^\s*[JL](?:APPRO|DEPART)\b/im,
  "v-plus": /^\s*(?:MOVE[ST]?|APPROS?|DEPARTS?)\b/im,
  spel: /^\s*(?:Go|Move|Jump3?|BGo|TGo|TMove|Arc3?)\b/im,
  "melfa-basic": /^\s*(?:\d+\s+)?(?:Mov|Mvs|Mvr)\b/im,
  pacscript: /^\s*(?:Move|Approach|Depart|Drive)\b/im,
};
/** A robot whose controller speaks the language: what opens does not hang on its dimensions. */
const ROBOTS: Readonly<Record<string, string>> = {
  krl: "kuka_kr6r900sixx",
  rapid: "abb_irb120",
  inform: "yaskawa_gp8",
  urscript: "ur10e",
  "fanuc-ls": "fanuc_lrmate200id",
  val3: "staubli_rx160",
  "kawasaki-as": "kawasaki_rs007l",
  "v-plus": "staubli_rx90l",
  spel: "epson_c4_a601s",
  "melfa-basic": "mitsubishi_rv7fl",
  pacscript: "denso_vs060",
};
/** Other files of the folder that are loaded with a program at most. */
const MOST_SIBLINGS = 60;
const MOST_BYTES = 2_000_000;
/** Files that hold data alone. */
const DATA = /\.(?:dat|sys|dtx|pts|va)$/i;
/** The files of a folder that a dialect reads: many programs lie in one. */
const folders = new Map<string, readonly TextFile[]>();

/** Files of a dialect that are counted of one repository at most. */
const MOST_OF_ONE = 100;

interface Candidate {
  readonly dialect: string;
  readonly repository: string;
  readonly path: string;
  readonly sha256: string;
  readonly file: TextFile;
}
interface Outcome {
  readonly dialect: string;
  readonly repository: string;
  readonly path: string;
  readonly sha256: string;
  readonly half: "work" | "count";
  readonly opens: boolean;
  readonly executes: boolean;
  readonly fault: string;
  readonly ms: number;
}

const [folder, ...rest] = process.argv.slice(2);
const faultsOf = rest.includes("--faults") ? (rest[rest.indexOf("--faults") + 1] ?? "") : undefined;
if (folder === undefined || !existsSync(folder)) {
  process.stdout.write(
    folder === undefined
      ? "Give the folder that holds the public programs: one folder a repository.\n"
      : `There is no folder ${folder}: nothing is downloaded, nothing is counted.\n`,
  );
  process.exit(folder === undefined ? 2 : 0);
}
const outcomes = countAll(folder);
print(outcomes);
if (rest.includes("--write")) write(outcomes);

function countAll(root: string): readonly Outcome[] {
  const seen = new Set<string>();
  const all: Outcome[] = [];
  const chosen: Candidate[] = [];
  for (const path of filesIn(root)) {
    const known = SIGNS.filter(([, endings]) => endings.test(path));
    if (known.length === 0 || statSync(path).size > MOST_BYTES) continue;
    const bytes = readFileSync(path);
    const sha256 = createHash("sha256").update(bytes).digest("hex");
    if (seen.has(sha256)) continue;
    const file = textFileOf(relative(dirname(path), path), bytes);
    const sign = known.find(([, , words]) => words.test(file.text));
    if (sign === undefined || !MOTION[sign[0]]!.test(file.text)) continue;
    seen.add(sha256);
    const [repository = "", ...parts] = relative(root, path).split("/");
    chosen.push({ dialect: sign[0], repository: repository.replace("+", "/"), path: parts.join("/"), sha256, file });
  }
  for (const { file, ...each } of evenly(chosen)) {
    const half = Number.parseInt(each.sha256.slice(0, 2), 16) % 2 === 0 ? "work" : "count";
    if (faultsOf !== undefined && half === "count" && !rest.includes("--write")) continue;
    const path = join(root, each.repository.replace("/", "+"), each.path);
    all.push({ ...each, half, ...opened(dialectFor(each.dialect), path, file) });
  }
  return all;
}

/**
 * At most so many files of a dialect from one repository, the first by hash: the backups of one plant hold thousands of
 * files that are alike.
 */
function evenly(candidates: readonly Candidate[]): readonly Candidate[] {
  const only = faultsOf === undefined || faultsOf === "" ? undefined : faultsOf;
  const taken = new Map<string, number>();
  const kept = new Set<Candidate>();
  for (const each of candidates.toSorted((a, b) => (a.sha256 < b.sha256 ? -1 : 1))) {
    const key = `${each.dialect} ${each.repository}`;
    const count = (taken.get(key) ?? 0) + 1;
    taken.set(key, count);
    if (count <= MOST_OF_ONE && (only === undefined || each.dialect === only)) kept.add(each);
  }
  return candidates.filter(each => kept.has(each));
}

function dialectFor(id: string): Dialect {
  // Pulses per degree come from the cell's own controller; the example's stand in for them here.
  if (id === "inform") return informDialect({ pulses: EXAMPLE_PULSES });
  return DIALECTS.find(dialect => dialect.id === id)!;
}

/** As it is with the file of its own name; with the folder's other files where the text alone names what is in them. */
function opened(dialect: Dialect, path: string, file: TextFile): Pick<Outcome, "opens" | "executes" | "fault" | "ms"> {
  const robot = LIBRARY.find(each => each.id === ROBOTS[dialect.id])!;
  const started = performance.now();
  const stem = stemOf(file.name);
  const siblings = siblingsOf(dialect, path, file);
  const own = siblings.filter(each => stemOf(each.name) === stem);
  let answer = tryOpen(dialect, [file, ...own], robot);
  if (!answer.opens && siblings.length > own.length) {
    const whole = tryOpen(dialect, [file, ...siblings], robot);
    if (whole.opens) answer = whole;
  }
  return { ...answer, ms: Math.round(performance.now() - started) };
}

function tryOpen(
  dialect: Dialect,
  files: readonly TextFile[],
  robot: Robot,
): Pick<Outcome, "opens" | "executes" | "fault"> {
  const { text } = joinFiles(dialect, files, files[0]!.name);
  const interpreted = dialect.interpret(text, robot);
  if (interpreted.kind === "not-understood") {
    const [first] = interpreted.faults;
    return { opens: false, executes: false, fault: `line ${first?.line}: ${first?.sentence}` };
  }
  const executed = executeText(dialect, text, "public", robot, undefined, { maxSteps: 2000 });
  return executed.kind === "executed"
    ? { opens: true, executes: executed.program.steps.some(({ type }) => type === "move"), fault: "" }
    : { opens: false, executes: false, fault: `line ${executed.faults[0]?.line}: ${executed.faults[0]?.sentence}` };
}

/** The files of the folder that a program names, those that they name, and the folder's files of data. */
function siblingsOf(dialect: Dialect, path: string, file: TextFile): readonly TextFile[] {
  const others = folderOf(dirname(path), dialect).filter(each => each.name !== file.name);
  const found: TextFile[] = others.filter(({ name }) => DATA.test(name));
  const waiting = [file];
  for (let next = waiting.pop(); next !== undefined && found.length < MOST_SIBLINGS; next = waiting.pop()) {
    const words = new Set(next.text.toLowerCase().match(/[\w-]+/g));
    for (const each of others)
      if (words.has(stemOf(each.name)) && !found.includes(each) && found.length < MOST_SIBLINGS) {
        found.push(each);
        waiting.push(each);
      }
  }
  return found;
}

function folderOf(path: string, dialect: Dialect): readonly TextFile[] {
  const key = `${dialect.id} ${path}`;
  const known = folders.get(key);
  if (known !== undefined) return known;
  const files = readdirSync(path)
    .filter(each => dialect.extensions.some(end => extname(each).toLowerCase() === end.toLowerCase()))
    .filter(each => statSync(join(path, each)).isFile() && statSync(join(path, each)).size <= MOST_BYTES)
    .map(each => textFileOf(each, readFileSync(join(path, each))));
  folders.set(key, files);
  return files;
}

function stemOf(name: string): string {
  return name.replace(/\.[^.]*$/, "").toLowerCase();
}

function* filesIn(path: string): Generator<string> {
  for (const entry of readdirSync(path, { withFileTypes: true }).sort((a, b) => (a.name < b.name ? -1 : 1))) {
    const inner = join(path, entry.name);
    if (entry.isDirectory()) yield* filesIn(inner);
    else if (entry.isFile()) yield inner;
  }
}

function print(all: readonly Outcome[]): void {
  process.stdout.write("dialect        files   work: open / of   count: open / of   slowest ms\n");
  for (const { id } of DIALECTS) {
    const own = all.filter(({ dialect }) => dialect === id);
    if (own.length === 0) continue;
    const share = (half: Outcome["half"]): string => {
      const of = own.filter(each => each.half === half);
      return `${of.filter(({ opens }) => opens).length} / ${of.length}`;
    };
    process.stdout.write(
      `${id.padEnd(14)} ${String(own.length).padStart(5)}   ${share("work").padStart(15)}   ${share("count").padStart(16)}   ${Math.max(...own.map(({ ms }) => ms))}\n`,
    );
  }
  if (faultsOf === undefined) return;
  for (const { repository, path, fault, dialect, half } of all)
    if (half === "work" && fault !== "" && (faultsOf === "" || dialect === faultsOf))
      process.stdout.write(`${dialect}  ${repository}/${path}  ${fault}\n`);
}

function write(all: readonly Outcome[]): void {
  const counts = Object.fromEntries(
    DIALECTS.filter(({ id }) => all.some(({ dialect }) => dialect === id)).map(({ id }) => {
      const own = all.filter(({ dialect }) => dialect === id);
      const half = (which: Outcome["half"]): { readonly files: number; readonly open: number } => {
        const of = own.filter(each => each.half === which);
        return { files: of.length, open: of.filter(({ opens }) => opens).length };
      };
      return [
        id,
        { files: own.length, open: own.filter(({ opens }) => opens).length, work: half("work"), count: half("count") },
      ];
    }),
  );
  const date = new Date().toISOString().slice(0, 10);
  const list = all.map(({ dialect, repository, path, sha256, half, opens }) => ({
    dialect,
    repository,
    path,
    sha256,
    half,
    opens,
  }));
  const lines = list.map(each => `    ${JSON.stringify(each)}`).join(",\n");
  const head = JSON.stringify({ date, counts }, undefined, 2).slice(0, -2);
  writeFileSync(new URL("../docs/public-programs.json", import.meta.url), `${head},\n  "files": [\n${lines}\n  ]\n}\n`);
}
