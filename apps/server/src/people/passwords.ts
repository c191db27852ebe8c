import { argon2, randomBytes, timingSafeEqual } from "node:crypto";
import { promisify } from "node:util";

/** Argon2id as OWASP recommends at least: 19 MiB, two passes, one lane. */
const MEMORY_KiB = 19_456;
const PASSES = 2;
const LANES = 1;
const TAG_BYTES = 32;
const SALT_BYTES = 16;
/** So many are worked on at once, each with its memory; so many more wait. */
const AT_ONCE = 2;
const MOST_WAITING = 32;
export const SHORTEST_PASSWORD = 10;
const LONGEST_PASSWORD = 200;

const derive = promisify(argon2);
const plain = (bytes: Uint8Array): string => Buffer.from(bytes).toString("base64").replace(/=+$/, "");

export interface Passwords {
  /** The password as a PHC string, or null when too many are being worked on. */
  hash(password: string): Promise<string | null>;
  /** Whether it is that password; null when too many are being worked on. Takes as long when there is none. */
  check(password: string, phc: string | null): Promise<boolean | null>;
}
/** The sentence of what is wrong with a new password, or null. */
export const passwordFault = (password: string): string | null =>
  password.length < SHORTEST_PASSWORD
    ? `A password has at least ${SHORTEST_PASSWORD} characters.`
    : password.length > LONGEST_PASSWORD
      ? `A password has at most ${LONGEST_PASSWORD} characters.`
      : null;

/** Passwords by Argon2id (RFC 9106), a few at once, so that a flood of them takes neither memory nor robots' time. */
export function passwords(): Passwords {
  let busy = 0;
  const waiting: (() => void)[] = [];
  async function taken<T>(work: () => Promise<T>): Promise<T | null> {
    if (waiting.length >= MOST_WAITING) return null;
    if (busy >= AT_ONCE)
      await new Promise<void>(resolve => {
        waiting.push(resolve);
      });
    busy++;
    try {
      return await work();
    } finally {
      busy--;
      waiting.shift()?.();
    }
  }
  const tag = (
    message: string,
    nonce: Uint8Array,
    memory: number,
    passes: number,
    parallelism: number,
    tagLength: number,
  ) => derive("argon2id", { message, nonce, memory, passes, parallelism, tagLength });
  const nobody = `$argon2id$v=19$m=${MEMORY_KiB},t=${PASSES},p=${LANES}$${plain(randomBytes(SALT_BYTES))}$${plain(randomBytes(TAG_BYTES))}`;
  return {
    hash: password =>
      taken(async () => {
        const salt = randomBytes(SALT_BYTES);
        const made = await tag(password, salt, MEMORY_KiB, PASSES, LANES, TAG_BYTES);
        return `$argon2id$v=19$m=${MEMORY_KiB},t=${PASSES},p=${LANES}$${plain(salt)}$${plain(made)}`;
      }),
    check: (password, phc) =>
      taken(async () => {
        const match = /^\$argon2id\$v=19\$m=(\d{1,7}),t=(\d{1,2}),p=(\d{1,2})\$([\w+/]+)\$([\w+/]+)$/.exec(
          phc ?? nobody,
        );
        if (!match || password.length > LONGEST_PASSWORD) return false;
        const [, memory, passes, lanes, salt, kept] = match;
        const wanted = Buffer.from(kept!, "base64");
        const made = await tag(
          password,
          Buffer.from(salt!, "base64"),
          Number(memory),
          Number(passes),
          Number(lanes),
          wanted.length,
        );
        return timingSafeEqual(made, wanted) && phc !== null;
      }),
  };
}
