// How many public vendor programs open as they are, and how many of them then move the robot with every input off:
// npm run public-programs FOLDER [-- --write] [-- --faults krl] [-- --only krl,rapid] [-- --slow]
// [-- --work]: only the half to work on.
//
// FOLDER holds one folder a repository, named owner+name, with its files at their paths. Nothing is downloaded; without
// the folder there is nothing to count. Files are split by hash: with --faults only those of the half to work on are
// named, the other half is only counted. --write keeps counts, paths and hashes in docs/public-programs.json; texts
// never. With --only the languages named are counted and written, what was counted of the others stays.
//
// A file opens in its project: with the other files of its repository that it needs, as the studio and the command line
// load them.
import { createHash } from "node:crypto";
import { existsSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, extname, join, relative } from "node:path";
import { LIBRARY, type Dialect, type Robot, type TextFault } from "@twincell/core";
import { DIALECTS, NOT_GIVEN, executeText, informDialect, joinFiles } from "@twincell/languages";
import { textFileOf, type TextFile } from "@twincell/project";

/** Which dialect the words of a file belong to, its ending being shared by several. */
const SIGNS: readonly (readonly [id: string, endings: RegExp, words: RegExp])[] = [
  ["krl", /\.(src|sub)$/i, /^\s*(?:GLOBAL\s+)?DEF(?:FCT)?\b/im],
  ["rapid", /\.(mod|modx|sys|prg)$/i, /^\s*(?:MODULE\s+\w+|%%%)/im],
  ["inform", /\.jbi$/i, /^\/JOB/m],
  ["urscript", /\.(script|urscript)$/i, /\b(?:move[jlpc]|set_digital_out|def)\b/],
  ["fanuc-ls", /\.ls$/i, /^\s*\/PROG\b/im],
  ["val3", /\.pgx$/i, /<program/i],
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
/** What a generator still has to fill in is no program: `%XCoord%` in RAPID, a lone `{}`, `{{ tcp }}`. */
const TEMPLATE = /^[ \t]*\{\}[ \t]*$|^(?!\s*[;!#]).*%[A-Za-z]\w*%|\{\{.*\}\}/m;
const FILLED: ReadonlySet<string> = new Set(["krl", "rapid", "urscript", "val3"]);
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
/**
 * At most so many files of a language are counted of one repository, the first by hash: the backups of one plant hold
 * thousands that are alike.
 */
const MOST_OF_ONE = 100;
/** Larger files are no program. */
const MOST_BYTES = 2_000_000;

/** What a fault expects where a program is called that is in none of the files. */
const MISSING = "a program among the files";

const PROJECTS = new Map<string, readonly TextFile[]>();

interface Outcome {
  readonly dialect: string;
  readonly repository: string;
  readonly path: string;
  readonly sha256: string;
  readonly half: "work" | "count";
  readonly opens: boolean;
  /** It opens when calls of programs that its repository does not have do nothing. */
  readonly opensWithout: boolean;
  readonly executes: boolean;
  /** Nothing is left out or taken for granted that only the controller knows. */
  readonly whole: boolean;
  readonly fault: string;
  readonly ms: number;
}

const [folder, ...rest] = process.argv.slice(2);
const option = (name: string): string | undefined =>
  rest.includes(name) ? (rest[rest.indexOf(name) + 1] ?? "") : undefined;
const faultsOf = option("--faults");
const only = option("--only")?.split(",");
const isCounted = (id: string): boolean => only === undefined || only.includes(id);
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

interface Candidate {
  readonly dialect: string;
  readonly repository: string;
  readonly path: string;
  readonly sha256: string;
}

function countAll(root: string): readonly Outcome[] {
  const seen = new Set<string>();
  const found: Candidate[] = [];
  for (const path of filesIn(root)) {
    const known = SIGNS.filter(([, endings]) => endings.test(path));
    if (known.length === 0 || statSync(path).size > MOST_BYTES) continue;
    const bytes = readFileSync(path);
    const sha256 = createHash("sha256").update(bytes).digest("hex");
    if (seen.has(sha256)) continue;
    const file = textFileOf(relative(dirname(path), path), bytes);
    const sign = known.find(([, , words]) => words.test(file.text));
    if (sign === undefined || !isCounted(sign[0]) || !MOTION[sign[0]]!.test(file.text)) continue;
    if (FILLED.has(sign[0]) && TEMPLATE.test(file.text)) continue;
    seen.add(sha256);
    const [repository = "", ...parts] = relative(root, path).split("/");
    found.push({ dialect: sign[0], repository: repository.replace("+", "/"), path: parts.join("/"), sha256 });
  }
  return evenly(found)
    .map(
      each => ({ ...each, half: Number.parseInt(each.sha256.slice(0, 2), 16) % 2 === 0 ? "work" : "count" }) as const,
    )
    .filter(({ half }) => half === "work" || !rest.includes("--work"))
    .map(each => ({
      ...each,
      ...opened(dialectFor(each.dialect), root, join(root, each.repository.replace("/", "+"), each.path)),
    }));
}

function evenly(candidates: readonly Candidate[]): readonly Candidate[] {
  const taken = new Map<string, number>();
  const kept = candidates
    .toSorted((a, b) => (a.sha256 < b.sha256 ? -1 : 1))
    .filter(({ dialect, repository }) => {
      const count = (taken.get(`${dialect} ${repository}`) ?? 0) + 1;
      taken.set(`${dialect} ${repository}`, count);
      return count <= MOST_OF_ONE;
    });
  const chosen = new Set(kept);
  return candidates.filter(each => chosen.has(each));
}

function dialectFor(id: string): Dialect {
  // Pulses per degree come from the cell's own controller; the example's stand in for them here.
  if (id === "inform") return informDialect({ examplePulses: true });
  return DIALECTS.find(dialect => dialect.id === id)!;
}

type Opened = Pick<Outcome, "opens" | "opensWithout" | "executes" | "whole" | "fault">;

/** As it is, with the files of its repository that it needs. */
function opened(dialect: Dialect, root: string, path: string): Opened & Pick<Outcome, "ms"> {
  const robot = LIBRARY.find(each => each.id === ROBOTS[dialect.id])!;
  const [repository = ""] = relative(root, path).split("/");
  const files = projectOf(dialect, join(root, repository));
  const name = relative(join(root, repository), path);
  // Of the processor: other work on the machine is no part of it.
  const started = process.cpuUsage();
  const answer = tryOpen(dialect, files, name, robot);
  const { user, system } = process.cpuUsage(started);
  return { ...answer, ms: Math.round((user + system) / 1000) };
}

function tryOpen(dialect: Dialect, files: readonly TextFile[], main: string, robot: Robot): Opened {
  const { text, place } = joinFiles(dialect, files, main);
  const faultOf = (faults: readonly TextFault[]): string => {
    const [first] = faults;
    const at = place(first?.line ?? 1);
    const file = files[at.file]?.name ?? "";
    return `${file === main ? "" : `${file} `}line ${at.line}: ${first?.sentence}`;
  };
  const executed = executeText(dialect, text, "public", robot, undefined, { maxSteps: 2000 });
  return executed.kind === "executed"
    ? {
        opens: true,
        opensWithout: true,
        executes: executed.program.steps.some(({ type }) => type === "move"),
        whole: !executed.notExecuted.some(({ expected }) => expected === NOT_GIVEN),
        fault: "",
      }
    : {
        opens: false,
        opensWithout:
          executed.faults.every(({ expected }) => expected === MISSING) &&
          executeText(dialect, text, "public", robot, undefined, { maxSteps: 2000, missingPrograms: "leave-out" })
            .kind === "executed",
        executes: false,
        whole: false,
        fault: faultOf(executed.faults),
      };
}

/** The files of a language in a repository, named by their paths in it. */
function projectOf(dialect: Dialect, repository: string): readonly TextFile[] {
  const key = `${dialect.id} ${repository}`;
  const known = PROJECTS.get(key);
  if (known !== undefined) return known;
  const endings = dialect.extensions.map(end => end.toLowerCase());
  const files = [...filesIn(repository)]
    .filter(path => endings.includes(extname(path).toLowerCase()) && statSync(path).size <= MOST_BYTES)
    .map(path => textFileOf(relative(repository, path), readFileSync(path)));
  PROJECTS.set(key, files);
  return files;
}

function* filesIn(path: string): Generator<string> {
  for (const entry of readdirSync(path, { withFileTypes: true }).sort((a, b) => (a.name < b.name ? -1 : 1))) {
    const inner = join(path, entry.name);
    if (entry.isDirectory()) yield* filesIn(inner);
    else if (entry.isFile()) yield inner;
  }
}

function print(all: readonly Outcome[]): void {
  process.stdout.write(
    "dialect        files   work: open, without missing calls, move, whole / of   count: the same   slowest ms\n",
  );
  for (const { id } of DIALECTS) {
    const own = all.filter(({ dialect }) => dialect === id);
    if (own.length === 0) continue;
    const share = (half: Outcome["half"]): string => {
      const of = own.filter(each => each.half === half);
      const count = (which: "opens" | "opensWithout" | "executes" | "whole"): number =>
        of.filter(each => each[which]).length;
      return `${count("opens")}, ${count("opensWithout")}, ${count("executes")}, ${count("whole")} / ${of.length}`;
    };
    process.stdout.write(
      `${id.padEnd(14)} ${String(own.length).padStart(5)}   ${share("work").padStart(28)}   ${share("count").padStart(29)}   ${Math.max(...own.map(({ ms }) => ms))}\n`,
    );
  }
  if (rest.includes("--slow"))
    for (const { repository, path, ms } of all.toSorted((a, b) => b.ms - a.ms).slice(0, 5))
      process.stdout.write(`${ms} ms  ${repository}/${path}\n`);
  if (faultsOf === undefined) return;
  for (const { repository, path, fault, dialect, half } of all)
    if (half === "work" && fault !== "" && (faultsOf === "" || dialect === faultsOf))
      process.stdout.write(`${dialect}  ${repository}/${path}  ${fault}\n`);
}

interface Counted {
  readonly files: number;
  readonly open: number;
  readonly withoutMissingCalls: number;
}

interface Listed {
  readonly dialect: string;
  readonly repository: string;
  readonly path: string;
  readonly sha256: string;
  readonly half: "work" | "count";
  readonly opens: boolean;
  /** Whether it opens when calls of programs that its repository does not have do nothing. */
  readonly opensWithout?: boolean;
  /** Whether it then moves the robot: a file of routines that nobody calls does not. */
  readonly executes?: boolean;
  /** Whether nothing was left out or taken for granted that only the controller knows. */
  readonly whole?: boolean;
}

function write(all: readonly Outcome[]): void {
  const url = new URL("../docs/public-programs.json", import.meta.url);
  const before = JSON.parse(readFileSync(url, "utf8")) as { readonly files: readonly Listed[] };
  const list: readonly Listed[] = [
    ...before.files.filter(({ dialect }) => !isCounted(dialect)),
    ...all.map(({ dialect, repository, path, sha256, half, opens, opensWithout, executes, whole }) => ({
      dialect,
      repository,
      path,
      sha256,
      half,
      opens,
      opensWithout,
      executes,
      whole,
    })),
  ].toSorted((a, b) => (keyOf(a) < keyOf(b) ? -1 : 1));
  const counts = Object.fromEntries(
    DIALECTS.filter(({ id }) => list.some(({ dialect }) => dialect === id)).map(({ id }) => {
      const own = list.filter(({ dialect }) => dialect === id);
      const half = (which: Listed["half"]): Counted => {
        const of = own.filter(each => each.half === which);
        return {
          files: of.length,
          open: of.filter(({ opens }) => opens).length,
          withoutMissingCalls: of.filter(each => each.opensWithout ?? each.opens).length,
        };
      };
      return [
        id,
        { files: own.length, open: own.filter(({ opens }) => opens).length, work: half("work"), count: half("count") },
      ];
    }),
  );
  const date = new Date().toISOString().slice(0, 10);
  const lines = list.map(each => `    ${JSON.stringify(each)}`).join(",\n");
  const head = JSON.stringify({ date, counts }, undefined, 2).slice(0, -2);
  writeFileSync(url, `${head},\n  "files": [\n${lines}\n  ]\n}\n`);
}

function keyOf({ dialect, repository, path }: Listed): string {
  return `${dialect} ${repository} ${path}`;
}
