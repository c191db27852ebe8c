import type { PatchFile } from "./points.ts";

/** More files or letters than this are no program that one person runs. */
const MOST_FILES = 300;
const MOST_LETTERS = 8_000_000;

/** What a file gives to the others of its project, and which words it uses; all in small letters. */
interface Look {
  readonly offers: ReadonlySet<string>;
  readonly words: ReadonlySet<string>;
}

/** Routines of the controller that the interpreter itself carries out or passes over: their files are not loaded. */
const OF_THE_CONTROLLER: ReadonlySet<string> = new Set(["bas", "ir_stopm", "p00", "msglib", "h50"]);

const baseOf = (name: string): string =>
  name
    .replace(/^.*[/\\]/, "")
    .replace(/\.[^.]*$/, "")
    .toLowerCase();
const folderOf = (name: string): string => /^(.*[/\\])?/.exec(name)![0];
const endingOf = (name: string): string => (/\.[^./\\]*$/.exec(name)?.[0] ?? "").toLowerCase();
const all = (text: string, pattern: RegExp): string[] =>
  Array.from(text.matchAll(pattern), match => match[1]!.toLowerCase());

/** Comments hold names of other programs too: what follows the sign is not looked at. */
const withoutRemarks = (text: string, sign: string): string => text.replace(new RegExp(`${sign}.*`, "g"), "");

function krlOffers(file: PatchFile, code: string): string[] {
  if (OF_THE_CONTROLLER.has(baseOf(file.name))) return [];
  if (endingOf(file.name) !== ".dat")
    return [baseOf(file.name), ...all(code, /^[ \t]*GLOBAL[ \t]+DEF(?:FCT[ \t]+\w+(?:\[\d*\])?)?[ \t]+([\w$]+)/gim)];
  const isConfig = /^[ \t]*DEFDAT[ \t]+\$/im.test(code);
  // The type of a list, and the names in it: `DECL GLOBAL INT A, B[3]`; everything in $CONFIG is global.
  const lists = Array.from(code.matchAll(DECLARED), ([, words, names]) => ({
    isGlobal: isConfig || /\bGLOBAL\b/i.test(words!),
    names: names!,
  }));
  return [
    ...lists.flatMap(({ isGlobal, names }) => (isGlobal ? all(`,${names}`, /,[ \t]*([A-Za-z_]\w*)/g) : [])),
    ...all(code, /^[ \t]*(?:GLOBAL[ \t]+)?SIGNAL[ \t]+(\w+)/gim),
  ];
}

/** `DECL GLOBAL CONST INT ` and the rest of the line. */
const DECLARED = /^[ \t]*((?:(?:DECL|GLOBAL|CONST)[ \t]+)*[A-Za-z_]\w*)[ \t]+([A-Za-z_].*)$/gim;

function rapidOffers(_file: PatchFile, code: string): string[] {
  return [
    ...all(code, /^[ \t]*(?:TASK[ \t]+)?(?:PROC|TRAP|FUNC[ \t]+\w+)[ \t]+(\w+)/gim),
    ...all(code, /^[ \t]*(?:TASK[ \t]+)?(?:PERS|CONST|VAR)[ \t]+\w+[ \t]+(\w+)/gim),
    ...all(code, /^[ \t]*(?:RECORD|ALIAS[ \t]+\w+)[ \t]+(\w+)/gim),
  ];
}

/** `.PROGRAM name(…)`, and the programs that others are called by. */
const programOffers = (_: PatchFile, code: string): string[] => all(code, /^[ \t]*\.PROGRAM[ \t]+([\w.]+)/gim);
const CALLED = /\bCALL[ \t]+([A-Za-z_][\w.]*)/gi;

const LANGUAGES: Readonly<
  Record<
    string,
    {
      readonly remark: string;
      readonly offers: (file: PatchFile, code: string) => string[];
      /** Which words of a text may name another file; all of them where nothing is said. */
      readonly words?: RegExp;
    }
  >
> = {
  "fanuc-ls": {
    remark: "!",
    offers: ({ name }) => (endingOf(name) === ".ls" ? [baseOf(name)] : []),
    words: /\b(?:CALL|AUFRUF)[ \t]+([A-Za-z_][\w-]*)/gi,
  },
  inform: {
    remark: "(?:^|[ \\t])'",
    offers: ({ name }) => [baseOf(name)],
    words: /\bJOB:([^\s'"=,()]+)/gi,
  },
  spel: {
    remark: "'",
    offers: (_, code) => all(code, /^[ \t]*Function[ \t]+(\w+)/gim),
  },
  "kawasaki-as": { remark: ";", offers: programOffers, words: CALLED },
  "v-plus": { remark: ";", offers: programOffers, words: CALLED },
  "melfa-basic": {
    remark: "(?:'|^[ \\t]*(?:\\d+[ \\t]+)?REM\\b)",
    offers: ({ name }) => [baseOf(name)],
    words: /\bCallP[ \t]*"([^"]+)"/gi,
  },
  pacscript: {
    remark: "'",
    offers: (file, code) => [
      baseOf(file.name),
      ...all(code, /^[ \t]*(?:(?:Public|Private)[ \t]+)?(?:Sub|Function|Program)[ \t]+(\w+)/gim),
    ],
    words: /\b(?:Call|Run|GoSub)[ \t]+([A-Za-z_]\w*)/gi,
  },
  krl: { remark: ";", offers: krlOffers },
  rapid: { remark: "!", offers: rapidOffers },
  urscript: { remark: "#", offers: (_, code) => all(code, /^(?:def|thread)[ \t]+(\w+)[ \t]*\(/gm) },
  val3: {
    remark: "//",
    offers: ({ name }, code) => (endingOf(name) === ".pgx" ? [baseOf(name)] : all(code, /<Data[ \t]+name="(\w+)"/gi)),
  },
};

const LOOKS = new WeakMap<PatchFile, Look>();

function lookAt(language: string, file: PatchFile): Look {
  const before = LOOKS.get(file);
  if (before !== undefined) return before;
  const { remark, offers, words = /([A-Za-z_$][\w$]*)/g } = LANGUAGES[language]!;
  const code = withoutRemarks(file.text, remark);
  const look: Look = { offers: new Set(offers(file, code)), words: new Set(all(code, words)) };
  LOOKS.set(file, look);
  return look;
}

/** How many folders two files share, from the root on; those of one folder are nearest. */
function nearness(a: string, b: string): number {
  const one = folderOf(a).split(/[/\\]/);
  const other = folderOf(b).split(/[/\\]/);
  let shared = 0;
  while (shared < one.length && shared < other.length && one[shared] === other[shared]) shared++;
  return shared * 2 - one.length - other.length;
}

/**
 * The files of a project that are loaded with a main file: those whose routines and data it names, and what these name
 * in turn. Of several files that offer the same name the nearest in its folders is taken. All files in languages whose
 * programs do not say where their names come from.
 */
export function neededFiles(
  language: string | undefined,
  files: readonly PatchFile[],
  main: string,
): readonly PatchFile[] {
  const first = files.find(({ name }) => name === main);
  if (language === undefined || first === undefined || !Object.hasOwn(LANGUAGES, language) || files.length < 2)
    return files;
  const by = filesByOffer(language, files);
  const kept = new Set<PatchFile>();
  const offered = new Set<string>();
  const queue: PatchFile[] = [];
  let letters = 0;
  const keep = (file: PatchFile): void => {
    if (kept.has(file) || kept.size >= MOST_FILES || letters + file.text.length > MOST_LETTERS) return;
    kept.add(file);
    letters += file.text.length;
    queue.push(file);
    for (const word of lookAt(language, file).offers) offered.add(word);
    for (const own of files)
      if (own !== file && isPartOf(language, own, file)) {
        keep(own);
      }
  };
  keep(first);
  if (language === "rapid" && !offered.has("main")) {
    // All modules of a task are loaded together, and main is what is started.
    const beside = (by.get("main") ?? []).find(({ name }) => nearness(name, first.name) === 0);
    if (beside !== undefined) keep(beside);
  }
  if (language === "val3" && baseOf(main) !== "start") {
    // An application begins with its program "start".
    const beside = (by.get("start") ?? []).find(({ name }) => nearness(name, first.name) === 0);
    if (beside !== undefined) keep(beside);
  }
  for (let file = queue.shift(); file !== undefined; file = queue.shift()) {
    const from = file;
    for (const word of lookAt(language, file).words) {
      if (offered.has(word)) continue;
      // A copy of a file that is loaded already is not loaded too.
      const choice = by.get(word)?.filter(each => ![...kept].some(other => baseOf(other.name) === baseOf(each.name)));
      if (choice === undefined || choice.length === 0) continue;
      keep(
        choice.reduce((best, each) => (nearness(each.name, from.name) > nearness(best.name, from.name) ? each : best)),
      );
    }
  }
  return files.filter(file => kept.has(file));
}

/** Files that belong to another without being named: the data list of a module, the data of an application. */
function isPartOf(language: string, part: PatchFile, file: PatchFile): boolean {
  if (folderOf(part.name) !== folderOf(file.name)) return false;
  if (language === "krl") return baseOf(part.name) === baseOf(file.name) && endingOf(part.name) === ".dat";
  // Registers and points of the controller that a backup keeps beside its programs.
  if (language === "fanuc-ls") return endingOf(part.name) === ".va";
  if (language === "spel") return endingOf(part.name) === ".pts";
  if (language === "val3") return endingOf(part.name) === ".dtx";
  return false;
}

function filesByOffer(language: string, files: readonly PatchFile[]): ReadonlyMap<string, readonly PatchFile[]> {
  const by = new Map<string, PatchFile[]>();
  for (const file of files)
    for (const word of lookAt(language, file).offers) {
      const known = by.get(word);
      if (known === undefined) by.set(word, [file]);
      else known.push(file);
    }
  return by;
}
