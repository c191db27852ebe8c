import { readFileSync, readdirSync, statSync } from "node:fs";
import { basename, extname, join, relative } from "node:path";
import { LIBRARY, identity, type LineShapes, type Skipped } from "@twincell/core";
import { DIALECTS, dialectById, dialectsFor, informDialect } from "@twincell/languages";
import { keptResults } from "../soak/kept.ts";

/**
 * How much of other people's programs is understood: `node scripts/coverage/programs.ts FOLDER [dialect]`, where FOLDER
 * has a folder for each dialect, and in it one for each repository the files are from. Statements are lines of code.
 * What is not understood is counted by its first word; what is declared in a file that is not there, or lies out of
 * reach of the robot that reads it, is counted apart. Only counts are kept, in programs.json.
 */
const [, , FOLDER, ONLY] = process.argv;
if (FOLDER === undefined) throw new Error("FOLDER is missing: one folder per dialect, in it one per repository.");
/** Longer texts say nothing that shorter ones do not, and each reading of them is long. */
const MOST_CHARACTERS = 200_000;
const MOST_FILES = 120;
const MOST_WORDS = 25;
interface Covered {
  files: number;
  statements: number;
  understood: number;
  share: number;
  motions: number;
  motionsUnderstood: number;
  elsewhere: number;
  notReached: number;
  refused: number;
  notUnderstood: Record<string, number>;
  repositories: Record<string, number>;
  robot: string;
}
const kept = keptResults<Covered>(new URL("programs.json", import.meta.url), {
  what: "statements of programs from public repositories: understood, not understood by their first word; none of the programs is kept",
});

/** What the fault is about when the statement itself is known. */
const ELSEWHERE =
  /not in this (?:text|file)|is not in the (?:text|file)|has no value|no value yet|no position of this job|is not known|not declared|does not have|is no (?:job|routine|program) of|are not taught|not in the list|was taught with|Position [CP]?\d+ is not|has not been given/i;
const REACH = /cannot be reached|within the axis limits|turns (?:axis|joint)|wrist would be|pulses per degree|outside/i;
const COMMENT: Readonly<Record<string, RegExp>> = {
  krl: /^\s*(?:;|&|$)/,
  rapid: /^\s*(?:!|%%%|$)/,
  inform: /^\s*(?:'|\/\/(?![A-Z])|\/+[A-Z]|$)/,
  "fanuc-ls": /^(?!\s*[0-9]*\s*:)|^\s*[0-9]*\s*:\s*(?:!|\/\/|--eg|;)/,
  urscript: /^\s*(?:#|$|[$@])/,
};
const ENDINGS: Readonly<Record<string, readonly string[]>> = {
  krl: [".src"],
  rapid: [".mod", ".prg", ".sys"],
  inform: [".jbi"],
  "fanuc-ls": [".ls"],
  urscript: [".script", ".urscript"],
};
const SIGNS: Readonly<Record<string, RegExp>> = {
  krl: /^\s*(?:GLOBAL\s+)?DEF(?:FCT)?\b/im,
  rapid: /^\s*(?:%%%|MODULE\b)/im,
  inform: /^\/JOB/m,
  "fanuc-ls": /^\/PROG/m,
  urscript: /\b(?:move[jlpc]\s*\(|set_\w+\(|def\s+\w+\s*\()/,
};

function filesBelow(folder: string): string[] {
  return readdirSync(folder)
    .toSorted()
    .flatMap(name => {
      const path = join(folder, name);
      return statSync(path).isDirectory() ? filesBelow(path) : [path];
    });
}

/** A module of KRL with the data list beside it. */
function textOf(path: string, dialect: string): string {
  const read = (from: string): string => new TextDecoder("latin1").decode(readFileSync(from)).replace(/\0/g, "");
  if (dialect !== "krl") return read(path);
  const stem = basename(path, extname(path)).toLowerCase();
  const data = readdirSync(join(path, "..")).find(name => name.toLowerCase() === `${stem}.dat`);
  return read(path).replace(/\r?\n?$/, "\n") + (data === undefined ? "" : read(join(path, "..", data)));
}

const wordOf = (line: string, dialect: string): string => {
  const code = dialect === "fanuc-ls" ? line.replace(/^\s*[0-9]*\s*:\s*/, "") : line.trim();
  return /^[A-Za-z_$][\w$]*(?:\s*:=|\s*=(?!=))?/.exec(code)?.[0].replace(/^.*=$/, "assignment") ?? code.slice(0, 8);
};

for (const id of readdirSync(FOLDER)) {
  if (ONLY !== undefined && id !== ONLY) continue;
  const robot = LIBRARY.find(each => dialectsFor(each).some(dialect => dialect.id === id));
  // Jobs in pulses are read with the example's pulses: where they end says nothing, what they say does.
  const dialect = id === "inform" ? informDialect({ examplePulses: true }) : dialectById(id);
  if (dialect === undefined || robot === undefined)
    throw new Error(`${id} is none of ${DIALECTS.map(each => each.id).join(", ")}.`);
  const shapes: LineShapes = dialect.lines!;
  const comment = COMMENT[id]!;
  const not: Record<string, number> = {};
  const repositories: Record<string, number> = {};
  const examples = new Map<string, string>();
  let files = 0;
  let statements = 0;
  let missed = 0;
  let motions = 0;
  let motionsMissed = 0;
  let elsewhere = 0;
  let notReached = 0;
  let refused = 0;
  for (const path of filesBelow(join(FOLDER, id))) {
    const repository = relative(join(FOLDER, id), path).split("/")[0]!.replace("+", "/");
    if (!ENDINGS[id]!.includes(extname(path).toLowerCase()) || (repositories[repository] ?? 0) >= MOST_FILES) continue;
    const text = textOf(path, id);
    if (text.length > MOST_CHARACTERS || !SIGNS[id]!.test(text)) continue;
    const lines = text.split(/\r\n|\n|\r/);
    const code = lines.flatMap((line, i) => (comment.test(line) ? [] : [i]));
    const isCode = new Set(code);
    files++;
    repositories[repository] = (repositories[repository] ?? 0) + 1;
    statements += code.length;
    motions += code.filter(i => shapes.motion.test(lines[i]!)).length;
    const answer = dialect.interpret(text, robot, identity(), { skipUnknown: true });
    const skipped: readonly Skipped[] = answer.kind === "ready" ? (answer.skipped ?? []) : [];
    if (answer.kind === "not-understood") {
      refused++;
      process.stderr.write(
        `${path}: ${answer.faults
          .map(({ line, sentence }) => `${line}: ${sentence}`)
          .slice(0, 2)
          .join(" | ")}\n`,
      );
      missed += code.length;
      motionsMissed += code.filter(i => shapes.motion.test(lines[i]!)).length;
      not["whole text"] = (not["whole text"] ?? 0) + code.length;
      continue;
    }
    for (const fault of skipped) {
      const said = fault.sentence;
      if (ELSEWHERE.test(said)) {
        elsewhere++;
        continue;
      }
      if (REACH.test(said)) {
        notReached++;
        continue;
      }
      // The block behind a condition is not read: only the line itself is not understood.
      if (!isCode.has(fault.line - 1)) continue;
      missed++;
      if (shapes.motion.test(fault.text)) motionsMissed++;
      const word = wordOf(fault.text, id);
      not[word] = (not[word] ?? 0) + 1;
      examples.set(word, `${fault.text.trim().slice(0, 70)} ← ${said.slice(-90)}`);
    }
  }
  const words = Object.entries(not).toSorted((a, b) => b[1] - a[1]);
  kept.keep(id, {
    files,
    statements,
    understood: statements - missed,
    share: Math.round((10_000 * (statements - missed)) / Math.max(1, statements)) / 10_000,
    motions,
    motionsUnderstood: motions - motionsMissed,
    elsewhere,
    notReached,
    refused,
    notUnderstood: Object.fromEntries(words.slice(0, MOST_WORDS)),
    repositories,
    robot: robot.id,
  });
  process.stdout.write(
    `${id}: ${files} files, ${statements} statements, ${((100 * (statements - missed)) / Math.max(1, statements)).toFixed(1)} % understood; ${motions - motionsMissed} of ${motions} motions; ${elsewhere} hang on another file, ${notReached} out of reach, ${refused} texts refused\n`,
  );
  for (const [word, count] of words.slice(0, 40))
    process.stdout.write(`  ${count} ${word}: ${examples.get(word) ?? ""}\n`);
}
