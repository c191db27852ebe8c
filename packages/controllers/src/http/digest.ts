import { md5 } from "@noble/hashes/legacy";
import { latin1Bytes } from "./message.ts";

/** MD5 as 32 small hexadecimal digits. */
export function md5Hex(text: string): string {
  let hex = "";
  for (const byte of md5(latin1Bytes(text))) hex += byte.toString(16).padStart(2, "0");
  return hex;
}

export interface Challenge {
  readonly realm: string;
  readonly nonce: string;
  readonly opaque: string /** Whether the server wants requests counted (qop "auth"). */;
  readonly counted: boolean;
}
export interface Login {
  readonly user: string;
  readonly password: string;
}

/** `Digest a="b", c=d` as a table; null when it is nothing of the kind. */
export function readDigest(value: string): ReadonlyMap<string, string> | null {
  if (!/^digest /i.test(value) || value.length > 4096) return null;
  const table = new Map<string, string>();
  const part = /\s*([A-Za-z]+)=(?:"([^"\\]*)"|([^\s",]*))\s*(?:,|$)/y;
  part.lastIndex = 7;
  for (let got = part.exec(value); got; got = part.exec(value)) {
    table.set(got[1]!.toLowerCase(), got[2] ?? got[3] ?? "");
    if (part.lastIndex >= value.length) return table;
  }
  return null;
}

export const challengeText = ({ realm, nonce, opaque }: Challenge): string =>
  `Digest realm="${realm}", domain="/", qop="auth", nonce="${nonce}", opaque="${opaque}", algorithm="MD5", stale=FALSE`;

/** What a server asks for; null when it is no digest by MD5. */
export function readChallenge(value: string): Challenge | null {
  const table = readDigest(value);
  const realm = table?.get("realm");
  const nonce = table?.get("nonce");
  if (realm === undefined || nonce === undefined || !/^(|md5)$/i.test(table!.get("algorithm") ?? "")) return null;
  return {
    realm,
    nonce,
    opaque: table!.get("opaque") ?? "",
    counted: (table!.get("qop") ?? "").split(",").some(each => each.trim() === "auth"),
  };
}

/**
 * The answer to a challenge, of RFC 2617:
 *   MD5(MD5(user:realm:password) : nonce [: count : own nonce : auth] : MD5(method:target)).
 * @param count  eight hexadecimal digits, or "" where requests are not counted.
 */
export const digestOf = (
  { user, password }: Login,
  realm: string,
  nonce: string,
  method: string,
  target: string,
  count: string,
  own: string,
): string =>
  md5Hex(
    `${md5Hex(`${user}:${realm}:${password}`)}:${nonce}${count === "" ? "" : `:${count}:${own}:auth`}:${md5Hex(`${method}:${target}`)}`,
  );

/** The field of a request that answers the challenge. @param times  how often this nonce was answered, from 1. */
export function authorization(
  login: Login,
  { realm, nonce, opaque, counted }: Challenge,
  method: string,
  target: string,
  times: number,
  own: string,
): string {
  const count = counted ? times.toString(16).padStart(8, "0") : "";
  const response = digestOf(login, realm, nonce, method, target, count, own);
  return `Digest username="${login.user}", realm="${realm}", nonce="${nonce}", uri="${target}", response="${response}", opaque="${opaque}"${counted ? `, qop=auth, nc=${count}, cnonce="${own}"` : ""}, algorithm="MD5"`;
}

/** Whether a request's field answers that challenge, with that login. */
export function isAuthorized(
  value: string,
  login: Login,
  { realm, nonce }: Challenge,
  method: string,
  target: string,
): boolean {
  const table = readDigest(value);
  const get = (name: string): string => table?.get(name) ?? "";
  if (get("username") !== login.user || get("realm") !== realm || get("nonce") !== nonce || get("uri") !== target)
    return false;
  return (
    get("response") === digestOf(login, realm, nonce, method, target, get("qop") === "" ? "" : get("nc"), get("cnonce"))
  );
}
