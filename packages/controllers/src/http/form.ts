/** `a=1&b=x%20y` of pairs, for bodies and queries. */
export const formText = (fields: Readonly<Record<string, string>>): string =>
  Object.entries(fields)
    .map(([name, value]) => `${encodeURIComponent(name)}=${encodeURIComponent(value)}`)
    .join("&");

const MOST_FIELDS = 1000;
/**
 * Pairs of a form or a query, last of a name first asked; null when an escape is broken or there are too many. Letters
 * beyond ASCII stay as they are escaped.
 */
export function readForm(text: string): ReadonlyMap<string, string> | null {
  const table = new Map<string, string>();
  if (text === "") return table;
  const parts = text.split("&");
  if (parts.length > MOST_FIELDS) return null;
  for (const part of parts) {
    const equals = part.indexOf("=");
    const name = unescaped(equals < 0 ? part : part.slice(0, equals), true);
    const value = equals < 0 ? "" : unescaped(part.slice(equals + 1), true);
    if (name === null || value === null) return null;
    table.set(name, value);
  }
  return table;
}

/** Path and query of a target, decoded; null when an escape is broken. */
export function readTarget(
  target: string,
): { readonly path: readonly string[]; readonly query: ReadonlyMap<string, string> } | null {
  const mark = target.indexOf("?");
  const query = readForm(mark < 0 ? "" : target.slice(mark + 1));
  const parts = (mark < 0 ? target : target.slice(0, mark)).split("/").filter(part => part !== "");
  const path = parts.map(part => unescaped(part, false));
  return query === null || path.includes(null) ? null : { path: path as string[], query };
}
/** A path out of parts: what has a meaning of its own in a target is escaped, `$` and `:` are not. */
export const pathText = (parts: readonly string[]): string =>
  `/${parts.map(part => encodeURIComponent(part).replace(/%24/g, "$").replace(/%3A/g, ":")).join("/")}`;

function unescaped(text: string, isForm: boolean): string | null {
  if (/%(?![0-9A-Fa-f]{2})/.test(text)) return null;
  // One byte a letter: what a device calls its files is told back as it came.
  return (isForm ? text.replace(/\+/g, " ") : text).replace(/%([0-9A-Fa-f]{2})/g, (_, hex: string) =>
    String.fromCharCode(parseInt(hex, 16)),
  );
}
