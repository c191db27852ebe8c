/**
 * A strict checker of URScript, written from the facts of the language alone: it has seen neither the writer nor the
 * reader. It knows far less than a controller takes, and nothing that a controller would refuse.
 */
const WORD = "[A-Za-z_][A-Za-z0-9_]*";
const NUMBER = "(?:[0-9]+(?:\\.[0-9]+)?|\\.[0-9]+)";
const TOKEN = new RegExp(
  `\\s*(?:(${NUMBER})(?![A-Za-z0-9_.])|(${WORD})|("[^"\\n]*")|(==|!=|<=|>=|[-+*/%()\\[\\],=<>:]))`,
  "y",
);
const KEYWORDS = new Set(
  "and or not xor if elif else while def thread end return break continue global local halt run kill join sec True False".split(
    " ",
  ),
);
/** Instructions with the names of their arguments, those that may be left out last. */
const INSTRUCTIONS: Readonly<Record<string, readonly [least: number, names: readonly string[]]>> = {
  movej: [1, ["q", "a", "v", "t", "r"]],
  movel: [1, ["pose", "a", "v", "t", "r"]],
  movep: [1, ["pose", "a", "v", "r"]],
  movec: [2, ["pose_via", "pose_to", "a", "v", "r", "mode"]],
  set_tcp: [1, ["pose"]],
  set_payload: [1, ["m", "cog"]],
  set_target_payload: [1, ["m", "cog", "inertia"]],
  sleep: [1, ["t"]],
  sync: [0, []],
  textmsg: [1, ["s1", "s2"]],
  halt: [0, []],
  set_standard_digital_out: [2, ["n", "b"]],
  set_configurable_digital_out: [2, ["n", "b"]],
  set_tool_digital_out: [2, ["n", "b"]],
  set_standard_analog_out: [2, ["n", "f"]],
};
const FUNCTIONS: Readonly<Record<string, number>> = {
  pose_trans: 2,
  get_inverse_kin: 2,
  get_standard_digital_in: 1,
  get_configurable_digital_in: 1,
  get_tool_digital_in: 1,
  get_standard_digital_out: 1,
  get_configurable_digital_out: 1,
  get_tool_digital_out: 1,
  get_standard_analog_in: 1,
  get_standard_analog_out: 1,
  get_tool_analog_in: 1,
};

/** What is wrong with a script, line by line; empty when nothing is. */
export function flawsOf(text: string): string[] {
  const flaws: string[] = [];
  const open: string[] = [];
  const routines = new Set<string>();
  const names = new Set<string>();
  const lines = text.split("\n");
  if (lines.at(-1) !== "") flaws.push("the last line does not end");
  for (const [i, raw] of lines.entries()) {
    const line = raw.replace(/#.*$/, "").trim();
    if (line === "") continue;
    const say = (what: string): void => {
      flaws.push(`line ${i + 1}: ${what}: ${line}`);
    };
    const definition = new RegExp(`^def (${WORD})\\(\\):$`).exec(line);
    if (definition !== null) {
      if (open.length > 1 || KEYWORDS.has(definition[1]!)) say("a definition stands inside a block or is a keyword");
      routines.add(definition[1]!);
      open.push("def");
    } else if (open.length === 0) say("a statement outside the program");
    else if (line === "end") open.pop();
    else if (line === "else:") {
      if (open.at(-1) !== "if") say("else without if");
    } else if (/^(if|while) .*:$/.test(line)) {
      open.push(line.startsWith("if") ? "if" : "while");
      if (!expression(line.replace(/^(if|while) /, "").slice(0, -1), names)) say("no condition");
    } else if (line === "halt") continue;
    else {
      const assignment = new RegExp(`^(?:global )?(${WORD}) = (.*)$`).exec(line);
      const call = new RegExp(`^(${WORD})\\((.*)\\)$`).exec(line);
      if (assignment !== null) {
        if (KEYWORDS.has(assignment[1]!) || !expression(assignment[2]!, names)) say("no assignment");
        names.add(assignment[1]!);
      } else if (
        call === null ||
        !(instruction(call[1]!, call[2]!, names) || (routines.has(call[1]!) && call[2] === ""))
      )
        say("no instruction");
    }
  }
  if (open.length > 0) flaws.push("a block is not closed");
  return flaws;
}

function instruction(name: string, args: string, names: ReadonlySet<string>): boolean {
  const known = INSTRUCTIONS[name];
  if (known === undefined) return false;
  const parts = split(args);
  const [least, allowed] = known;
  let free = 0;
  let isNamed = false;
  for (const part of parts) {
    const named = new RegExp(`^(${WORD})=(?!=)(.*)$`).exec(part);
    if (named !== null) {
      isNamed = true;
      if (!allowed.slice(free).includes(named[1]!) || !expression(named[2]!, names)) return false;
    } else if (
      isNamed ||
      ++free > allowed.length ||
      !(part.startsWith('"') ? /^"[^"]*"$/.test(part) : expression(part, names))
    )
      return false;
  }
  return free >= least;
}

/** Arguments, split at the commas outside brackets. */
function split(text: string): string[] {
  const parts: string[] = [];
  let depth = 0;
  let from = 0;
  for (const [i, letter] of [...text].entries()) {
    if ("([".includes(letter)) depth++;
    if (")]".includes(letter)) depth--;
    if (letter === "," && depth === 0) {
      parts.push(text.slice(from, i).trim());
      from = i + 1;
    }
  }
  if (text.trim() !== "") parts.push(text.slice(from).trim());
  return parts;
}

/**
 * Whether a text is one expression: operands and operators in turn, brackets closed, poses of six, names that exist.
 */
function expression(text: string, names: ReadonlySet<string>): boolean {
  const tokens: string[] = [];
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < text.trimEnd().length) {
    const match = TOKEN.exec(text);
    if (match === null) return false;
    tokens.push(match[1] ?? match[2] ?? match[3] ?? match[4]!);
  }
  let at = 0;
  const operand = (): boolean => {
    while (tokens[at] === "not" || tokens[at] === "-") at++;
    const token = tokens[at++];
    if (token === undefined) return false;
    if (token === "(") return sequence() && tokens[at++] === ")";
    if (token === "[") return list() !== undefined;
    if (token === "p" && tokens[at] === "[") {
      at++;
      return list() === 6;
    }
    if (/^[.0-9"]/.test(token) || token === "True" || token === "False") return true;
    if (tokens[at] === "(") {
      at++;
      if (FUNCTIONS[token] === undefined) return false;
      for (let i = 0; i < FUNCTIONS[token]; i++)
        if (!sequence() || tokens[at++] !== (i + 1 < FUNCTIONS[token] ? "," : ")")) return false;
      return true;
    }
    return !KEYWORDS.has(token) && names.has(token);
  };
  const list = (): number | undefined => {
    for (let count = 1; ; count++) {
      if (!sequence()) return undefined;
      const next = tokens[at++];
      if (next === "]") return count;
      if (next !== ",") return undefined;
    }
  };
  const sequence = (): boolean => {
    if (!operand()) return false;
    while (["+", "-", "*", "/", "%", "==", "!=", "<", ">", "<=", ">=", "and", "or"].includes(tokens[at] ?? "")) {
      at++;
      if (!operand()) return false;
    }
    return true;
  };
  return sequence() && at === tokens.length;
}
