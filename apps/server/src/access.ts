import { randomBytes, randomInt, timingSafeEqual } from "node:crypto";

const COOKIE = "twincell_access";
/**
 * So many wrong codes of one client, then its codes are not looked at for a minute, and after each further wrong one
 * twice as long, up to an hour: 250 clients together try some 13,000 of a million codes a day. Nobody else is kept out.
 */
const TRIES = 20;
const PAUSE_S = 60;
const LONGEST_PAUSE_S = 3600;
/** Clients that are remembered; beyond it the one that was wrong longest ago is forgotten. */
const MOST_CLIENTS = 10_000;
/** A client is its address; of IPv6 the network, since one machine has all addresses of it. */
export const clientOf = (address = ""): string =>
  address.includes(":") && !address.startsWith("::ffff:")
    ? [...address.split("::")[0]!.split(":"), "0", "0", "0", "0"].slice(0, 4).join(":")
    : address;

export type Entry =
  | { readonly kind: "welcome" }
  | { readonly kind: "welcome-with-cookie"; readonly cookie: string }
  | { readonly kind: "ask" }
  | { readonly kind: "too-many-tries" };

/** Six digits stand between the local network and the studio: typed once, or carried by the QR code's address. */
export interface AccessCode {
  readonly code: string;
  /** @param client  whose wrong codes are counted together: `clientOf` its address. */
  enter(cookies: string | undefined, given: string | null, client: string): Entry;
}

/** @param now_s  seconds that never run backwards. */
export function accessCode(now_s: () => number): AccessCode {
  const code = String(randomInt(0, 1_000_000)).padStart(6, "0");
  const token = randomBytes(24).toString("base64url");
  const wrong = new Map<string, { count: number; closedUntil_s: number }>();
  const same = (a: string, b: string) => a.length === b.length && timingSafeEqual(Buffer.from(a), Buffer.from(b));
  return {
    code,
    enter(cookies, given, client) {
      const carried = cookies
        ?.split(";")
        .map(part => part.trim())
        .find(part => part.startsWith(`${COOKIE}=`))
        ?.slice(COOKIE.length + 1);
      if (carried !== undefined && same(carried, token)) return { kind: "welcome" };
      const tried = wrong.get(client) ?? { count: 0, closedUntil_s: -Infinity };
      if (now_s() < tried.closedUntil_s) return { kind: "too-many-tries" };
      if (given === null) return { kind: "ask" };
      if (same(given, code)) {
        wrong.delete(client);
        return { kind: "welcome-with-cookie", cookie: `${COOKIE}=${token}; Path=/; HttpOnly; Secure; SameSite=Strict` };
      }
      wrong.delete(client);
      wrong.set(client, tried);
      if (wrong.size > MOST_CLIENTS) wrong.delete(wrong.keys().next().value!);
      if (++tried.count < TRIES) return { kind: "ask" };
      tried.closedUntil_s = now_s() + Math.min(LONGEST_PAUSE_S, PAUSE_S * 2 ** (tried.count - TRIES));
      return { kind: "too-many-tries" };
    },
  };
}

/** The one page that stands before the studio and its catalogues: English first, a language a line. */
const ASKING = {
  en: { ask: "Type the six digits shown where Twincell was started.", open: "Open the studio" },
  de: { ask: "Die sechs Ziffern eingeben, die dort stehen, wo Twincell gestartet wurde.", open: "Studio öffnen" },
};
const isAsked = (language: string): language is keyof typeof ASKING => Object.hasOwn(ASKING, language);

/**
 * The page that asks for the code, in the first language of the browser that it is written in.
 *
 * @param accepted the Accept-Language header of the request: "de-AT,de;q=0.9,en;q=0.8"
 */
export function askForCode(accepted = ""): string {
  const wished = accepted.split(",").map(each => each.trim().slice(0, 2).toLowerCase());
  const language = wished.find(isAsked) ?? "en";
  const { ask, open } = ASKING[language];
  return `<!doctype html><html lang="${language}"><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1"><title>Twincell</title>
<style>body{font:16px system-ui;background:#101315;color:#e8edf0;display:grid;place-items:center;min-height:100vh;margin:0}form{display:grid;gap:12px;width:min(320px,86vw)}input,button{font:inherit;height:48px;border-radius:8px;border:1px solid #2b3338;background:#161a1d;color:inherit;padding:0 14px}input{letter-spacing:.3em;text-align:center}button{background:#3fb8b3;color:#04211f;border:0;font-weight:600}</style>
<form><label for="code">${ask}</label><input id="code" name="code" inputmode="numeric" autocomplete="one-time-code" maxlength="6" autofocus><button>${open}</button></form></html>`;
}
