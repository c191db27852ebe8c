import { randomBytes, randomInt, timingSafeEqual } from "node:crypto";

const COOKIE = "twincell_access";
/** So many wrong codes, then nobody's code is looked at for a while: guessing a million takes weeks, and whoever mistyped waits a minute. */
const TRIES = 20;
const PAUSE_S = 60;

export type Entry =
  | { readonly kind: "welcome" }
  | { readonly kind: "welcome-with-cookie"; readonly cookie: string }
  | { readonly kind: "ask" }
  | { readonly kind: "too-many-tries" };

/** Six digits stand between the local network and the studio: typed once, or carried by the QR code's address. */
export interface AccessCode {
  readonly code: string;
  enter(cookies: string | undefined, given: string | null): Entry;
}

/** @param now_s  seconds that never run backwards. */
export function accessCode(now_s: () => number): AccessCode {
  const code = String(randomInt(0, 1_000_000)).padStart(6, "0");
  const token = randomBytes(24).toString("base64url");
  let wrong = 0;
  let closedUntil_s = -Infinity;
  const same = (a: string, b: string) => a.length === b.length && timingSafeEqual(Buffer.from(a), Buffer.from(b));
  return {
    code,
    enter(cookies, given) {
      const carried = cookies
        ?.split(";")
        .map(part => part.trim())
        .find(part => part.startsWith(`${COOKIE}=`))
        ?.slice(COOKIE.length + 1);
      if (carried !== undefined && same(carried, token)) return { kind: "welcome" };
      if (now_s() < closedUntil_s) return { kind: "too-many-tries" };
      if (given === null) return { kind: "ask" };
      if (same(given, code))
        return { kind: "welcome-with-cookie", cookie: `${COOKIE}=${token}; Path=/; HttpOnly; Secure; SameSite=Strict` };
      if (++wrong < TRIES) return { kind: "ask" };
      wrong = 0;
      closedUntil_s = now_s() + PAUSE_S;
      return { kind: "too-many-tries" };
    },
  };
}

export const askForCode = `<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1"><title>Twincell</title>
<style>body{font:16px system-ui;background:#101315;color:#e8edf0;display:grid;place-items:center;min-height:100vh;margin:0}form{display:grid;gap:12px;width:min(320px,86vw)}input,button{font:inherit;height:48px;border-radius:8px;border:1px solid #2b3338;background:#161a1d;color:inherit;padding:0 14px}input{letter-spacing:.3em;text-align:center}button{background:#3fb8b3;color:#04211f;border:0;font-weight:600}</style>
<form><label for="code">Type the six digits shown where Twincell was started.</label><input id="code" name="code" inputmode="numeric" autocomplete="one-time-code" maxlength="6" autofocus><button>Open the studio</button></form></html>`;
