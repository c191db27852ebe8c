import { createHash, randomBytes } from "node:crypto";
import { mkdirSync, readFileSync, renameSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { ApiRoute } from "@twincell/protocol";

/**
 * What somebody may do: everybody looks and stops; programmers change programs and cells; operators command robots;
 * admins do all.
 */
export const ROLES = ["viewer", "programmer", "operator", "admin"] as const;
export type Role = (typeof ROLES)[number];
export const mayUse = (role: Role, access: ApiRoute["access"]): boolean =>
  access === "open" ||
  access === "look" ||
  access === "stop" ||
  role === "admin" ||
  (access === "write" && role === "programmer") ||
  (access === "command" && role === "operator");

/** One token as it is kept: never the token itself. */
export interface TokenEntry {
  readonly name: string;
  readonly role: Role;
  /** SHA-256 of the token, as hex. */
  readonly hash: string;
  /** ISO 8601, UTC; null for one that does not end. */
  readonly until: string | null;
  /** Lets in to look at that cell alone: a read-only link. */
  readonly cell?: string;
}
const FORMAT = "twincell.tokens";
const hashOf = (token: string): string => createHash("sha256").update(token).digest("hex");
const fileOf = (data: string): string => join(data, "tokens.json");

/**
 * The tokens of a data folder. Throws with one sentence when the file is there and cannot be understood: nobody is let
 * in by guess.
 */
export function readTokens(data: string): readonly TokenEntry[] {
  let text: string;
  try {
    text = readFileSync(fileOf(data), "utf8");
  } catch (problem) {
    if ((problem as NodeJS.ErrnoException).code === "ENOENT") return [];
    throw problem;
  }
  const fault = (why: string): Error => new Error(`${fileOf(data)} is no list of tokens: ${why}.`);
  let value: { readonly format?: unknown; readonly version?: unknown; readonly tokens?: unknown };
  try {
    value = JSON.parse(text) as typeof value;
  } catch (problem) {
    throw fault((problem as Error).message);
  }
  if (value.format !== FORMAT || value.version !== 1 || !Array.isArray(value.tokens))
    throw fault("this release reads version 1");
  return (value.tokens as Partial<TokenEntry>[]).map(({ name, role, hash, until, cell }) => {
    if (typeof name !== "string" || !ROLES.includes(role as Role) || !/^[0-9a-f]{64}$/.test(hash ?? ""))
      throw fault("an entry has no name, role or hash");
    if (until !== null && !Number.isFinite(Date.parse(until ?? ""))) throw fault(`“${name}” has no end that is a date`);
    if (cell !== undefined && (typeof cell !== "string" || role !== "viewer"))
      throw fault(`“${name}” is a link with a role or cell that none has`);
    const entry = { name, role: role as Role, hash: hash!, until: until ?? null };
    return cell === undefined ? entry : { ...entry, cell };
  });
}
function writeTokens(data: string, tokens: readonly TokenEntry[]): void {
  mkdirSync(data, { recursive: true });
  const half = `${fileOf(data)}.${process.pid}.new`;
  writeFileSync(half, `${JSON.stringify({ format: FORMAT, version: 1, tokens }, null, 2)}\n`, {
    mode: 0o600,
    flush: true,
  });
  renameSync(half, fileOf(data));
}

/** Makes a token and keeps its hash; null when somebody has that name already. */
export function addToken(data: string, name: string, role: Role, until: Date | null): string | null {
  const tokens = readTokens(data);
  if (tokens.some(each => each.name === name)) return null;
  const token = `twincell_${randomBytes(32).toString("base64url")}`;
  writeTokens(data, [...tokens, { name, role, hash: hashOf(token), until: until?.toISOString() ?? null }]);
  return token;
}
/** Makes a read-only link to one cell: a token for looking at it and nothing else. */
export function addCellLink(data: string, cell: string, until: Date): string {
  const tokens = readTokens(data);
  const token = `twincell_${randomBytes(32).toString("base64url")}`;
  const name = `link to ${cell} (${hashOf(token).slice(0, 8)})`;
  writeTokens(data, [...tokens, { name, role: "viewer", hash: hashOf(token), until: until.toISOString(), cell }]);
  return token;
}
/** Takes back all read-only links to a cell. Whether there was one. */
export function removeCellLinks(data: string, cell: string): boolean {
  const tokens = readTokens(data);
  const kept = tokens.filter(each => each.cell !== cell);
  if (kept.length < tokens.length) writeTokens(data, kept);
  return kept.length < tokens.length;
}
/** Whether there was one of that name. */
export function removeToken(data: string, name: string): boolean {
  const tokens = readTokens(data);
  const kept = tokens.filter(each => each.name !== name);
  if (kept.length < tokens.length) writeTokens(data, kept);
  return kept.length < tokens.length;
}

export type TokenAnswer =
  /** `cell`: it lets in to look at that cell alone. */
  | { readonly kind: "known"; readonly name: string; readonly role: Role; readonly cell: string | null }
  | { readonly kind: "ended"; readonly name: string }
  | { readonly kind: "unknown" };

/** Looks tokens up; the file is read again when it has changed, so that a token taken back is refused at once. */
export function tokenReader(
  data: string | undefined,
  now_ms: () => number,
  onTrouble: (sentence: string) => void,
): (token: string) => TokenAnswer {
  let stamp = "";
  let known: ReadonlyMap<string, TokenEntry> = new Map();
  const refresh = (folder: string): void => {
    const found = statSync(fileOf(folder), { throwIfNoEntry: false });
    const now = found ? `${found.mtimeMs} ${found.size} ${found.ino}` : "";
    if (now === stamp) return;
    stamp = now;
    // What cannot be read lets nobody in.
    known = new Map();
    try {
      known = new Map(readTokens(folder).map(entry => [entry.hash, entry]));
    } catch (problem) {
      onTrouble(problem instanceof Error ? problem.message : String(problem));
    }
  };
  return token => {
    if (data === undefined) return { kind: "unknown" };
    refresh(data);
    const entry = known.get(hashOf(token));
    if (!entry) return { kind: "unknown" };
    return entry.until !== null && now_ms() > Date.parse(entry.until)
      ? { kind: "ended", name: entry.name }
      : { kind: "known", name: entry.name, role: entry.role, cell: entry.cell ?? null };
  };
}
