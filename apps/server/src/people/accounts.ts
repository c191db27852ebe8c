import { createHash, randomBytes } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, renameSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { z } from "zod";
import { ROLES, type Role } from "./tokens.ts";

const FORMAT = "twincell.accounts";
const VERSION = 1;
const role = z.enum(ROLES);
/** Names of people: what a log and a screen can show on one line. */
export const personName = z.string().regex(/^[\p{L}\p{N}][\p{L}\p{N} ._-]{0,79}$/u);
const passkey = z.object({
  id: z.string().max(1024),
  /** COSE key, base64url. */
  publicKey: z.string().max(4096),
  counter: z.number(),
  transports: z.array(z.string()).max(8),
});
const account = z.object({
  name: personName,
  role,
  /** Another role for single robots and cells, by id or name. */
  rights: z.record(z.string(), role),
  /** PHC string of Argon2id; null before one was chosen. */
  password: z.string().nullable(),
  passkeys: z.array(passkey).max(10),
});
/** A link by which somebody chooses a password; works once. */
const invitation = z.object({
  hash: z.string().regex(/^[0-9a-f]{64}$/),
  /** Null: whoever uses it says who they are. */
  name: personName.nullable(),
  role,
  until_ms: z.number(),
});
const file = z.object({
  format: z.literal(FORMAT),
  version: z.literal(VERSION),
  people: z.array(account).max(1000),
  invitations: z.array(invitation).max(1000),
});
export type Account = z.infer<typeof account>;
export type Passkey = z.infer<typeof passkey>;
type Kept = z.infer<typeof file>;
const EMPTY: Kept = { format: FORMAT, version: VERSION, people: [], invitations: [] };
const hashOf = (token: string): string => createHash("sha256").update(token).digest("hex");
export const accountsFile = (data: string): string => join(data, "accounts.json");
/** Whether people of that data folder sign in by name. */
export const hasAccounts = (data: string | undefined): boolean => data !== undefined && existsSync(accountsFile(data));
const INVITED_MS = 7 * 86_400_000;

/** People of a data folder; the file is read again when another program changed it. */
export interface Accounts {
  readonly all: readonly Account[];
  find(name: string): Account | undefined;
  /** Adds or replaces. */
  put(account: Account): void;
  remove(name: string): boolean;
  /** A token that works once, for seven days. */
  invite(name: string | null, role: Role): string;
  /** What an invitation is for; null for one that is unknown, used or old. */
  invited(token: string): { readonly name: string | null; readonly role: Role } | null;
  used(token: string): void;
}

/**
 * Opens the accounts of a data folder. Throws with one sentence when the file is there and cannot be understood: nobody
 * is let in by guess.
 */
export function openAccounts(data: string, now_ms: () => number): Accounts {
  const path = accountsFile(data);
  let kept = EMPTY;
  let stamp = "";
  const stampNow = (): string => {
    const found = statSync(path, { throwIfNoEntry: false });
    return found ? `${found.mtimeMs} ${found.size} ${found.ino}` : "";
  };
  const refresh = (): Kept => {
    const now = stampNow();
    if (now === stamp) return kept;
    kept = now === "" ? EMPTY : readAccounts(path);
    stamp = now;
    return kept;
  };
  const write = (next: Omit<Kept, "format" | "version">): void => {
    mkdirSync(data, { recursive: true });
    const half = `${path}.${process.pid}.new`;
    kept = { format: FORMAT, version: VERSION, ...next };
    writeFileSync(half, `${JSON.stringify(kept, null, 2)}\n`, { mode: 0o600, flush: true });
    renameSync(half, path);
    stamp = stampNow();
  };
  refresh();
  const standing = (invitations: Kept["invitations"]): Kept["invitations"] =>
    invitations.filter(({ until_ms }) => until_ms > now_ms());
  return {
    get all() {
      return refresh().people;
    },
    find: name => refresh().people.find(each => each.name === name),
    put(next) {
      const { people, invitations } = refresh();
      write({ people: [...people.filter(({ name }) => name !== next.name), next], invitations: standing(invitations) });
    },
    remove(name) {
      const { people, invitations } = refresh();
      const left = people.filter(each => each.name !== name);
      write({ people: left, invitations: standing(invitations).filter(each => each.name !== name) });
      return left.length < people.length;
    },
    invite(name, asRole) {
      const { people, invitations } = refresh();
      const token = randomBytes(24).toString("base64url");
      const added = { hash: hashOf(token), name, role: asRole, until_ms: now_ms() + INVITED_MS };
      // A new link makes an older one of the same person useless.
      write({ people, invitations: [...standing(invitations).filter(each => each.name !== name), added] });
      return token;
    },
    invited(token) {
      const hash = hashOf(token);
      return standing(refresh().invitations).find(each => each.hash === hash) ?? null;
    },
    used(token) {
      const { people, invitations } = refresh();
      const hash = hashOf(token);
      write({ people, invitations: standing(invitations).filter(each => each.hash !== hash) });
    },
  };
}

function readAccounts(path: string): Kept {
  const fault = (why: string): Error => new Error(`${path} is no list of accounts: ${why}.`);
  let value: unknown;
  try {
    value = JSON.parse(readFileSync(path, "utf8"));
  } catch (problem) {
    throw fault((problem as Error).message);
  }
  const parsed = file.safeParse(value);
  if (parsed.success) return parsed.data;
  const { version } = (value ?? {}) as { readonly version?: unknown };
  if (typeof version === "number" && version > VERSION)
    throw fault(`it is of version ${version}, this release reads version ${VERSION}`);
  throw fault(`${parsed.error.issues[0]?.path.join(".") ?? ""} ${parsed.error.issues[0]?.message ?? ""}`.trim());
}
