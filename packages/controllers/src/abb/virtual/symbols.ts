export interface DataDeclaration {
  readonly kind: "con" | "var" | "per";
  readonly type: string;
  readonly name: string;
  readonly value: string /** Where the value stands in the text; both the same where it has none. */;
  readonly from: number;
  readonly to: number;
}

const KIND = { CONST: "con", VAR: "var", PERS: "per" } as const;
const DECLARED =
  /^[ \t]*(?:(?:LOCAL|TASK)[ \t]+)?(CONST|VAR|PERS)[ \t]+([A-Za-z][A-Za-z0-9_]{0,31})[ \t]+([A-Za-z][A-Za-z0-9_]{0,31})(?:[ \t]*\{[0-9, ]{1,20}\})?[ \t]*(?::=[ \t]*([^;\r\n]{0,4000}))?;/gim;

/** The data that a module declares, in front of its routines. */
export function dataOf(text: string): DataDeclaration[] {
  const end = text.search(/^[ \t]*(?:LOCAL[ \t]+)?(?:PROC|FUNC|TRAP)\b/im);
  const head = end < 0 ? text : text.slice(0, end);
  return [...head.matchAll(DECLARED)].map(match => {
    const [whole, kind, type, name, value] = match;
    const to = match.index + whole.length - 1;
    return {
      kind: KIND[kind!.toUpperCase() as keyof typeof KIND],
      type: type!,
      name: name!,
      value: (value ?? "").trim(),
      from: value === undefined ? to : to - value.length,
      to,
    };
  });
}

/** A literal of RAPID: numbers, truths, texts, and lists of them. */
const LITERAL = /^(?:[-+0-9.eE,[\]\s]|TRUE|FALSE|"[^"\r\n]{0,80}")+$/;

/** The module with another value of that datum; null when it is no literal. */
export function withValue(text: string, datum: DataDeclaration, value: string): string | null {
  if (value.length > 4000 || !LITERAL.test(value)) return null;
  return `${text.slice(0, datum.from)}${datum.from === datum.to ? ":=" : ""}${value}${text.slice(datum.to)}`;
}
