import { createHash, randomBytes } from "node:crypto";
import { clientOf } from "../access.ts";

const COOKIE = "twincell_session";
/** A session ends so long after it was last used [s], and in any case so long after it began. */
const IDLE_S = 12 * 3600;
const LONGEST_S = 7 * 86_400;
const MOST_SESSIONS = 1000;
/** So many wrong passwords of one client, then its passwords are not looked at for a minute, doubled up to an hour. */
const TRIES = 10;
const PAUSE_S = 60;
const LONGEST_PAUSE_S = 3600;
const MOST_CLIENTS = 10_000;
const hashOf = (token: string): string => createHash("sha256").update(token).digest("hex");

export interface Sessions {
  /** The name of the person whose cookie that is, or null. */
  nameOf(cookies: string | undefined): string | null;
  /** The cookie of a new session. @param secure  whether it only goes by HTTPS. */
  begin(name: string, secure: boolean): string;
  /** The cookie that takes the one away. */
  end(cookies: string | undefined): string;
  /** All sessions of one person end. */
  endAll(name: string): void;
  /** Seconds until passwords of that client are looked at again; 0: now. */
  pause_s(address: string | undefined): number;
  wrong(address: string | undefined): void;
  right(address: string | undefined): void;
}

/** Who is signed in. Nothing of it is kept on a disk: a server that starts again asks everybody anew. */
export function createSessions(now_s: () => number): Sessions {
  const open = new Map<string, { readonly name: string; readonly began_s: number; used_s: number }>();
  const tries = new Map<string, { count: number; until_s: number }>();
  const carried = (cookies: string | undefined): string | undefined =>
    cookies
      ?.split(";")
      .map(part => part.trim())
      .find(part => part.startsWith(`${COOKIE}=`))
      ?.slice(COOKIE.length + 1);
  return {
    nameOf(cookies) {
      const token = carried(cookies);
      if (token === undefined) return null;
      const hash = hashOf(token);
      const found = open.get(hash);
      if (!found) return null;
      if (now_s() - found.used_s > IDLE_S || now_s() - found.began_s > LONGEST_S) {
        open.delete(hash);
        return null;
      }
      found.used_s = now_s();
      return found.name;
    },
    begin(name, secure) {
      const token = randomBytes(32).toString("base64url");
      if (open.size >= MOST_SESSIONS) {
        const [oldest] = [...open].toSorted(([, a], [, b]) => a.used_s - b.used_s);
        open.delete(oldest![0]);
      }
      open.set(hashOf(token), { name, began_s: now_s(), used_s: now_s() });
      return `${COOKIE}=${token}; Path=/; HttpOnly; SameSite=Strict${secure ? "; Secure" : ""}`;
    },
    end(cookies) {
      const token = carried(cookies);
      if (token !== undefined) open.delete(hashOf(token));
      return `${COOKIE}=; Path=/; HttpOnly; SameSite=Strict; Max-Age=0`;
    },
    endAll(name) {
      for (const [hash, session] of open) if (session.name === name) open.delete(hash);
    },
    pause_s: address => Math.max(0, (tries.get(clientOf(address))?.until_s ?? 0) - now_s()),
    wrong(address) {
      const client = clientOf(address);
      const tried = tries.get(client) ?? { count: 0, until_s: -Infinity };
      tries.delete(client);
      tries.set(client, tried);
      if (tries.size > MOST_CLIENTS) tries.delete(tries.keys().next().value!);
      if (++tried.count >= TRIES)
        tried.until_s = now_s() + Math.min(LONGEST_PAUSE_S, PAUSE_S * 2 ** (tried.count - TRIES));
    },
    right(address) {
      tries.delete(clientOf(address));
    },
  };
}
