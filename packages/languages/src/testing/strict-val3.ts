/**
 * A strict checker of VAL 3 applications, written from the facts of the language alone: it has seen neither the writer
 * nor the reader. It knows far less than a controller takes, and nothing that a controller would refuse.
 */
export interface AppFile {
  readonly name: string;
  readonly text: string;
}
interface Tag {
  readonly name: string;
  readonly attributes: Readonly<Record<string, string>>;
  readonly path: string;
  readonly text: string;
}

const NAMESPACES: Readonly<Record<string, string>> = {
  Programs: "http://www.staubli.com/robotics/VAL3/Program/2",
  Database: "http://www.staubli.com/robotics/VAL3/Data/2",
  Project: "http://www.staubli.com/robotics/VAL3/Project/3",
};
const NUMBERS = (...names: string[]): Readonly<Record<string, RegExp>> =>
  Object.fromEntries(names.map(name => [name, /^-?[0-9]+(\.[0-9]+)?$/]));
const PLACE = NUMBERS("x", "y", "z", "rx", "ry", "rz");
const WORDS = (...words: string[]): RegExp => new RegExp(`^(${words.join("|")})$`);
/** What the value of a datum of each sort may say. */
const VALUES: Readonly<Record<string, Readonly<Record<string, RegExp>>>> = {
  num: NUMBERS("value"),
  bool: { value: /^(true|false)$/ },
  string: { value: /^[^"<]*$/ },
  dio: { link: /^.*$/ },
  aio: { link: /^.*$/ },
  trsf: PLACE,
  frame: { ...PLACE, fatherId: /^\w+\[0\]$/ },
  tool: {
    ...PLACE,
    fatherId: /^\w+\[0\]$/,
    ioLink: /^.*$/,
    open: /^[0-9.]+$/,
    close: /^[0-9.]+$/,
    otime: /^[0-9.]+$/,
    ctime: /^[0-9.]+$/,
  },
  jointRx: NUMBERS("j1", "j2", "j3", "j4", "j5", "j6"),
  pointRx: {
    ...PLACE,
    fatherId: /^\w+\[0\]$/,
    shoulder: WORDS("righty", "lefty", "ssame", "sfree"),
    elbow: WORDS("epositive", "enegative", "esame", "efree"),
    wrist: WORDS("wpositive", "wnegative", "wsame", "wfree"),
  },
  configRx: {
    shoulder: WORDS("righty", "lefty", "ssame", "sfree"),
    elbow: WORDS("epositive", "enegative", "esame", "efree"),
    wrist: WORDS("wpositive", "wnegative", "wsame", "wfree"),
  },
  mdesc: {
    ...NUMBERS("accel", "vel", "decel", "tmax", "rmax", "leave", "reach"),
    blend: WORDS("off", "joint", "Cartesian", "cartesian"),
  },
};
/** Instructions with the number of their arguments. */
const INSTRUCTIONS: Readonly<Record<string, number>> = {
  movej: 3,
  movel: 3,
  movec: 4,
  waitEndMove: 0,
  open: 1,
  close: 1,
  delay: 1,
  wait: 1,
  put: 1,
  putln: 1,
  popUpMsg: 1,
  logMsg: 1,
  cls: 0,
  resetMotion: 0,
  autoConnectMove: 1,
  stopMove: 0,
  restartMove: 0,
  taskKill: 1,
  halt: 0,
};
const FUNCTIONS: Readonly<Record<string, number>> = {
  appro: 2,
  compose: 3,
  here: 2,
  herej: 0,
  jointToPoint: 3,
  pointToJoint: 4,
  watch: 2,
  abs: 1,
  sin: 1,
  cos: 1,
  tan: 1,
  sqrt: 1,
  min: 2,
  max: 2,
  roundDown: 1,
  roundUp: 1,
  round: 1,
  trunc: 1,
  setFrame: 4,
  config: 1,
  distance: 2,
  toString: 2,
  isEmpty: 0,
  getSpeed: 1,
  position: 2,
  dioGet: 1,
  aioGet: 1,
  dioSet: 2,
  aioSet: 2,
};
const KEYWORDS = new Set(
  "begin end if then elseIf else endIf while do endWhile for to step endFor until switch case break default endSwitch call return and or xor true false".split(
    " ",
  ),
);
const SCALARS = new Set(["num", "bool", "string"]);

/** What is wrong with an application, file by file; empty when nothing is. */
export function flawsOfApplication(files: readonly AppFile[]): string[] {
  const flaws: string[] = [];
  const names = new Map<string, string>();
  const programs = new Set<string>();
  const codes: { readonly file: string; readonly code: string; readonly locals: ReadonlyMap<string, string> }[] = [];
  const ending = (end: string): readonly AppFile[] => files.filter(({ name }) => name.endsWith(end));
  if (ending(".pjx").length !== 1 || ending(".dtx").length !== 1)
    flaws.push("an application has one .pjx and one .dtx");
  for (const entry of ["start.pgx", "stop.pgx"])
    if (!files.some(({ name }) => name.split("/").at(-1) === entry)) flaws.push(`there is no ${entry}`);
  for (const { name, text } of files) {
    const tags = tagsOf(text, sentence => {
      flaws.push(`${name}: ${sentence}`);
    });
    const root = tags[0];
    const wanted = name.endsWith(".pgx") ? "Programs" : name.endsWith(".dtx") ? "Database" : "Project";
    if (root?.name !== wanted || root.attributes["xmlns"] !== NAMESPACES[wanted])
      flaws.push(`${name}: the root is not ${wanted} in ${NAMESPACES[wanted]}`);
    if (name.endsWith(".pjx"))
      project(tags, files, sentence => {
        flaws.push(`${name}: ${sentence}`);
      });
    if (name.endsWith(".dtx"))
      data(tags, names, sentence => {
        flaws.push(`${name}: ${sentence}`);
      });
    if (name.endsWith(".pgx")) {
      const own = tags.filter(tag => tag.name === "Program");
      const locals = new Map(
        tags
          .filter(tag => tag.name === "Local" || tag.name === "Parameter")
          .map(tag => [tag.attributes["name"] ?? "", tag.attributes["type"] ?? ""]),
      );
      if (own.length !== 1 || own[0]!.attributes["name"] !== name.split("/").at(-1)!.replace(".pgx", ""))
        flaws.push(`${name}: the program has another name than its file`);
      programs.add(own[0]?.attributes["name"] ?? "");
      for (const { text: code } of tags.filter(tag => tag.name === "Code")) codes.push({ file: name, code, locals });
    }
  }
  for (const { file, code, locals } of codes)
    statements(code, new Map([...names, ...locals]), programs, sentence => {
      flaws.push(`${file}: ${sentence}`);
    });
  return flaws;
}

/** The elements of a document in order, with what stands in them. */
function tagsOf(text: string, say: (sentence: string) => void): Tag[] {
  const tags: { name: string; attributes: Record<string, string>; path: string; text: string }[] = [];
  const open: (typeof tags)[number][] = [];
  const body = text.replace(/^\uFEFF/, "");
  if (!/^<\?xml version="1\.0" encoding="utf-8"\s*\?>/i.test(body)) say("it does not begin as XML in UTF-8");
  const pattern =
    /<\?[^>]*\?>|<!\[CDATA\[([^]*?)\]\]>|<\/([\w:]+)\s*>|<([\w:]+)((?:\s+[\w:]+="[^"<]*")*)\s*(\/?)>|([^<]+)/y;
  let at = 0;
  while (at < body.length) {
    pattern.lastIndex = at;
    const match = pattern.exec(body);
    if (match === null) {
      say(`it is not well-formed at "${body.slice(at, at + 30)}"`);
      return tags;
    }
    at += match[0].length;
    const [, cdata, closing, opening, attributes = "", isClosed, plain] = match;
    const inside = open.at(-1);
    if (cdata !== undefined) {
      if (inside !== undefined) inside.text += cdata;
    } else if (plain !== undefined) {
      if (/&(?!(amp|lt|gt|quot|apos|#\d+);)/.test(plain)) say("an & stands alone");
      if (inside !== undefined) inside.text += plain;
      else if (plain.trim() !== "") say("text outside of the root");
    } else if (closing !== undefined) {
      if (open.pop()?.name !== closing) say(`</${closing}> closes another element`);
    } else if (opening !== undefined) {
      const tag = {
        name: opening,
        attributes: Object.fromEntries(
          Array.from(attributes.matchAll(/([\w:]+)="([^"]*)"/g), found => [found[1]!, found[2]!]),
        ),
        path: open.map(each => each.name).join("/"),
        text: "",
      };
      tags.push(tag);
      if (isClosed !== "/") open.push(tag);
    }
  }
  if (open.length > 0) say(`<${open.at(-1)!.name}> is not closed`);
  return tags;
}

/** A project has parameters, and lists each program, the data and the libraries once. */
function project(tags: readonly Tag[], files: readonly AppFile[], say: (sentence: string) => void): void {
  const listed = (name: string, path: string): string =>
    tags
      .filter(tag => tag.name === name && tag.path === path)
      .map(({ attributes }) => attributes["file"] ?? "")
      .sort()
      .join();
  const there = (end: string): string =>
    files
      .filter(({ name }) => name.endsWith(end))
      .map(({ name }) => name.split("/").at(-1)!)
      .sort()
      .join();
  for (const part of ["Parameters", "Programs", "Database", "Libraries"])
    if (tags.filter(({ name, path }) => name === part && path === "Project").length !== 1)
      say(`it has not one ${part}`);
  if (listed("Program", "Project/Programs") !== there(".pgx")) say("its programs are not the .pgx files");
  if (listed("Data", "Project/Database") !== there(".dtx")) say("its data are not the .dtx file");
}

function data(tags: readonly Tag[], names: Map<string, string>, say: (sentence: string) => void): void {
  let type = "";
  let left = 0;
  const fathers: string[] = [];
  for (const { name, path, attributes } of tags) {
    if (name === "Data") {
      if (path !== "Database/Datas") say("a datum stands outside of Datas");
      const { name: called = "", type: sort = "", size = "", access = "" } = attributes;
      if (!/^[A-Za-z]\w*$/.test(called) || KEYWORDS.has(called) || names.has(called))
        say(`"${called}" is no name, or there twice`);
      if (!Object.hasOwn(VALUES, sort)) say(`there is no type ${sort}`);
      if (!/^[1-9]\d*$/.test(size) || !/^(public|private)$/.test(access) || attributes["xsi:type"] !== "array")
        say(`${called} has no size, access or shape`);
      names.set(called, sort);
      type = sort;
      left = Number(size);
    }
    if (name !== "Value") continue;
    const { key = "", ...said } = attributes;
    if (!/^\d+$/.test(key) || --left < 0) say("a value has no place in its datum");
    for (const [attribute, value] of Object.entries(said))
      if (VALUES[type]?.[attribute]?.test(value) !== true) say(`a value of type ${type} says ${attribute}="${value}"`);
    for (const attribute of type === "frame" || type === "tool" || type === "pointRx" ? ["fatherId"] : [])
      if (said[attribute] === undefined) say(`a ${type} has no ${attribute}`);
    if (said["fatherId"] !== undefined) fathers.push(`${type} ${said["fatherId"].replace("[0]", "")}`);
  }
  for (const father of fathers) {
    const [sort, of] = father.split(" ") as [string, string];
    if (sort === "tool" ? of !== "flange" && names.get(of) !== "tool" : of !== "world" && names.get(of) !== "frame")
      say(`the father ${of} of a ${sort} is not there`);
  }
}

const NUMBER = "[0-9]+(?:\\.[0-9]+)?(?:[eE][-+]?[0-9]+)?";
const TOKEN = new RegExp(
  `\\s*(?:(${NUMBER})(?![\\w.])|("[^"]*")|([A-Za-z]\\w*)|(==|!=|<=|>=|[-+*/%!=<>()\\[\\]{},.]))`,
  "y",
);

function statements(
  code: string,
  names: ReadonlyMap<string, string>,
  programs: ReadonlySet<string>,
  say: (sentence: string) => void,
): void {
  const lines = code
    .split(/\r?\n/)
    .map(line =>
      line
        .replace(/^\s*\/\/.*$/, "")
        .replace(/\s\/\/.*$/, "")
        .trim(),
    )
    .filter(line => line !== "");
  const open: string[] = [];
  if (lines[0] !== "begin" || lines.at(-1) !== "end") say("the code does not begin with begin, or not end with end");
  for (const line of lines.slice(1, -1)) {
    const wrong = (): void => {
      say(`no statement: ${line}`);
    };
    const reader = new Reader(line, names);
    const [word = ""] = /^[A-Za-z]+/.exec(line) ?? [];
    const condition = (behind = ""): boolean =>
      reader.expression(0) && (behind === "" || reader.take() === behind) && reader.isDone;
    if (reader.isBroken) {
      wrong();
      continue;
    }
    switch (word) {
      case "begin":
      case "end":
        wrong();
        break;
      case "if":
        reader.take();
        open.push("if");
        if (!reader.expression(0) || !(reader.isDone || (reader.take() === "then" && reader.isDone))) wrong();
        break;
      case "elseIf":
        reader.take();
        if (open.at(-1) !== "if" || !condition()) wrong();
        break;
      case "else":
        if (open.at(-1) !== "if" || line !== word) wrong();
        break;
      case "endIf":
        if (open.pop() !== "if" || line !== word) wrong();
        break;
      case "while":
        reader.take();
        open.push("while");
        if (!condition()) wrong();
        break;
      case "endWhile":
        if (open.pop() !== "while" || line !== word) wrong();
        break;
      case "for": {
        reader.take();
        open.push("for");
        const isGood =
          reader.assignable() &&
          reader.take() === "=" &&
          reader.expression(0) &&
          reader.take() === "to" &&
          reader.expression(0) &&
          (reader.isDone || (reader.take() === "step" && reader.expression(0) && reader.isDone));
        if (!isGood) wrong();
        break;
      }
      case "endFor":
        if (open.pop() !== "for" || line !== word) wrong();
        break;
      case "do":
        open.push("do");
        if (line !== word) wrong();
        break;
      case "until":
        reader.take();
        if (open.pop() !== "do" || !condition()) wrong();
        break;
      case "return":
        if (line !== word) wrong();
        break;
      case "call":
        reader.take();
        if (!programs.has(reader.take()) || !reader.args(undefined) || !reader.isDone) wrong();
        break;
      default:
        if (!reader.statement()) wrong();
    }
  }
  if (open.length > 0) say(`${open.at(-1)} is not closed`);
}

/** Strength of signs between two values. */
const BINARY: Readonly<Record<string, number>> = {
  or: 1,
  xor: 1,
  and: 2,
  "==": 3,
  "!=": 3,
  "<": 3,
  ">": 3,
  "<=": 3,
  ">=": 3,
  "+": 4,
  "-": 4,
  "*": 5,
  "/": 5,
  "%": 5,
};

class Reader {
  readonly isBroken: boolean;
  private readonly tokens: string[] = [];
  private readonly names: ReadonlyMap<string, string>;
  private at = 0;

  constructor(line: string, names: ReadonlyMap<string, string>) {
    this.names = names;
    let from = 0;
    while (from < line.length) {
      TOKEN.lastIndex = from;
      const match = TOKEN.exec(line);
      if (match === null) break;
      from += match[0].length;
      this.tokens.push(match[0].trim());
    }
    this.isBroken = from < line.length;
  }

  get isDone(): boolean {
    return this.at >= this.tokens.length;
  }
  take(): string {
    return this.tokens[this.at++] ?? "";
  }
  private get next(): string {
    return this.tokens[this.at] ?? "";
  }

  /** An assignment, or an instruction. */
  statement(): boolean {
    if (this.tokens[1] === "(") {
      const name = this.take();
      const count = Object.hasOwn(INSTRUCTIONS, name)
        ? INSTRUCTIONS[name]
        : Object.hasOwn(FUNCTIONS, name)
          ? FUNCTIONS[name]
          : undefined;
      return count !== undefined && this.args(count) && this.isDone;
    }
    return this.assignable() && this.take() === "=" && this.expression(0) && this.isDone;
  }

  /** A datum, with an index and components behind it. */
  assignable(): boolean {
    const name = this.take();
    const type = this.names.get(name);
    if (type === undefined || KEYWORDS.has(name)) return false;
    if (this.next === "[" && !(this.take() === "[" && this.expression(0) && this.take() === "]")) return false;
    if (this.next === "." && SCALARS.has(type)) return false;
    while (this.next === ".") {
      this.take();
      if (!/^[A-Za-z]\w*$/.test(this.take())) return false;
    }
    return true;
  }

  args(count: number | undefined): boolean {
    if (this.take() !== "(") return false;
    let found = 0;
    if (this.next !== ")") {
      do {
        if (!this.expression(0)) return false;
        found++;
      } while (this.next === "," && this.take() === ",");
    }
    return this.take() === ")" && (count === undefined || found === count);
  }

  expression(least: number): boolean {
    if (!this.value()) return false;
    for (let strength = BINARY[this.next]; strength !== undefined && strength > least; strength = BINARY[this.next]) {
      this.take();
      if (!this.expression(strength)) return false;
    }
    return true;
  }

  private value(): boolean {
    const { next } = this;
    if (next === "-" || next === "!") {
      this.take();
      return this.value();
    }
    if (next === "(") {
      this.take();
      return this.expression(0) && this.take() === ")";
    }
    if (next === "{") {
      this.take();
      do {
        if (!this.expression(0)) return false;
      } while (this.next === "," && this.take() === ",");
      return this.take() === "}";
    }
    if (/^[0-9"]/.test(next) || next === "true" || next === "false") {
      this.take();
      return true;
    }
    if (this.tokens[this.at + 1] === "(") {
      if (!Object.hasOwn(FUNCTIONS, next)) return false;
      this.take();
      return this.args(FUNCTIONS[next]);
    }
    if (next === "world" || next === "flange") {
      this.take();
      return true;
    }
    return this.assignable();
  }
}
