import { randomBytes } from "node:crypto";
import type { CommandOutcome } from "@twincell/core";
import type { SessionInfo } from "@twincell/protocol";
import { json, outcomeAnswer, refusal, type Answer, type Call, type Handlers } from "../api/calls.ts";
import { personName, type Account, type Accounts } from "./accounts.ts";
import { passwordFault, passwords } from "./passwords.ts";
import type { Sessions } from "./sessions.ts";

/** A challenge of a passkey is answered within this time [s]. */
const CHALLENGE_S = 120;
const MOST_CHALLENGES = 200;

type Routes =
  | "session"
  | "signIn"
  | "signOut"
  | "acceptInvitation"
  | "beginPasskeySignIn"
  | "passkeySignIn"
  | "beginPasskey"
  | "addPasskey"
  | "listPeople"
  | "putPerson"
  | "deletePerson";
export interface PeopleParts {
  /** The server reaches no real robot. */
  readonly training: boolean;
  /** Name of the cell that the read-only link of a page lets in to. */
  readonly linkOf: (cookies: string | undefined) => string | null;
  readonly accounts: Accounts;
  readonly sessions: Sessions;
  readonly now_s: () => number;
  /** Told of each time that somebody signs in or is refused. */
  readonly audit: (who: string, action: string, detail: string, done: boolean) => void;
}
const DONE: CommandOutcome = { kind: "done" };
const busy = json(refusal("people.busy", "Many people sign in at once.", "Try again in a moment."), 429);
type WebAuthn = typeof import("@simplewebauthn/server");
/** What checks passkeys, loaded when somebody uses one; a package of Twincell leaves it out until it is added. */
async function webAuthn(): Promise<WebAuthn | Answer> {
  try {
    return await import("@simplewebauthn/server");
  } catch (problem) {
    if ((problem as NodeJS.ErrnoException).code !== "ERR_MODULE_NOT_FOUND") throw problem;
    const hint = "On the server run npm install @simplewebauthn/server@14.0.3, or use a password.";
    return refused("people.no-part", "Passkeys need a part that is not installed.", hint, 409);
  }
}
const refused = (code: string, sentence: string, hint: string, status = 401): Answer =>
  json(refusal(code, sentence, hint), status);

/** A server on which nobody signs in by name. */
export function withoutPeople(
  training: boolean,
  linkOf: (cookies: string | undefined) => string | null,
): Pick<Handlers, Routes> {
  const none = (): Answer =>
    refused("people.none", "Nobody signs in by name here.", "Start the server with --accounts and --data DIR.", 409);
  const nobody: SessionInfo = {
    accounts: false,
    name: null,
    role: null,
    rights: {},
    passkeys: 0,
    training,
    link: null,
  };
  return {
    session: ({ cookies }) => json({ ...nobody, link: linkOf(cookies) }),
    signIn: none,
    signOut: none,
    acceptInvitation: none,
    beginPasskeySignIn: none,
    passkeySignIn: none,
    beginPasskey: none,
    addPasskey: none,
    listPeople: none,
    putPerson: none,
    deletePerson: none,
  };
}

/** What people sign in with, and who may do what. */
export function peopleHandlers({
  training,
  linkOf,
  accounts,
  sessions,
  now_s,
  audit,
}: PeopleParts): Pick<Handlers, Routes> {
  const secrets = passwords();
  const challenges = new Map<string, number>();
  const remember = (challenge: string): void => {
    for (const [each, until_s] of challenges) if (until_s < now_s()) challenges.delete(each);
    if (challenges.size >= MOST_CHALLENGES) challenges.delete(challenges.keys().next().value!);
    challenges.set(challenge, now_s() + CHALLENGE_S);
  };
  /** Each challenge is good for one answer. */
  const isMine = (challenge: string): boolean => {
    const until_s = challenges.get(challenge);
    challenges.delete(challenge);
    return until_s !== undefined && until_s >= now_s();
  };
  const infoOf = (account: Account | undefined): SessionInfo => ({
    accounts: true,
    name: account?.name ?? null,
    role: account?.role ?? null,
    rights: account?.rights ?? {},
    passkeys: account?.passkeys.length ?? 0,
    training,
    link: null,
  });
  const me = (call: Pick<Call<never>, "cookies">): Account | undefined => {
    const name = sessions.nameOf(call.cookies);
    return name === null ? undefined : accounts.find(name);
  };
  const begin = (account: Account, call: Pick<Call<never>, "origin" | "address">): Answer => {
    sessions.right(call.address);
    audit(account.name, "signs in", "", true);
    const cookie = sessions.begin(account.name, call.origin.startsWith("https:"));
    return { kind: "json", value: infoOf(account), headers: { "set-cookie": cookie } };
  };
  const paused = (call: Pick<Call<never>, "address">): Answer | null => {
    const pause_s = sessions.pause_s(call.address);
    return pause_s > 0
      ? refused(
          "people.too-many-tries",
          "Too many wrong passwords came from this address.",
          `Wait ${Math.ceil(pause_s)} s; others are not kept out.`,
          429,
        )
      : null;
  };
  const wrong = (call: Pick<Call<never>, "address">, who: string, detail: string): Answer => {
    sessions.wrong(call.address);
    audit(who, "is not signed in", detail, false);
    return refused("people.wrong", "Name and password do not belong together.", "Ask an admin for a new link.");
  };
  const hostOf = (origin: string): string => new URL(origin).hostname;

  return {
    session: call => {
      const account = me(call);
      return json({ ...infoOf(account), link: account ? null : linkOf(call.cookies) });
    },
    async signIn(call) {
      const pause = paused(call);
      if (pause) return pause;
      const account = accounts.find(call.body.name);
      const isRight = await secrets.check(call.body.password, account?.password ?? null);
      if (isRight === null) return busy;
      return isRight && account ? begin(account, call) : wrong(call, "somebody", "by password");
    },
    signOut(call) {
      const name = sessions.nameOf(call.cookies);
      const cookie = sessions.end(call.cookies);
      if (name !== null) audit(name, "signs out", "", true);
      return { kind: "json", value: DONE, headers: { "set-cookie": cookie } };
    },
    async acceptInvitation(call) {
      const pause = paused(call);
      if (pause) return pause;
      const invited = accounts.invited(call.body.link);
      if (!invited) {
        sessions.wrong(call.address);
        return refused("people.link", "This link was used already, or has ended.", "Ask an admin for another one.");
      }
      const name = invited.name ?? call.body.name ?? "";
      const fault = personName.safeParse(name).success
        ? passwordFault(call.body.password)
        : "A name begins with a letter or digit and has at most 80 characters.";
      if (fault !== null) return refused("people.unfit", fault, "Choose another one.", 400);
      if (invited.name === null && accounts.find(name))
        return refused("people.taken", `There is somebody called ${name} already.`, "Choose another name.", 409);
      const password = await secrets.hash(call.body.password);
      if (password === null) return busy;
      // Somebody may have used it while the password was worked on.
      if (!accounts.invited(call.body.link))
        return refused("people.link", "This link was used already, or has ended.", "Ask an admin for another one.");
      accounts.used(call.body.link);
      const known = accounts.find(name);
      const account = { name, role: invited.role, rights: {}, passkeys: [], ...known, password };
      accounts.put(account);
      return begin(account, call);
    },
    async beginPasskeySignIn(call) {
      const library = await webAuthn();
      if ("kind" in library) return library;
      const options = await library.generateAuthenticationOptions({
        rpID: hostOf(call.origin),
        userVerification: "required",
      });
      remember(options.challenge);
      return json(options);
    },
    async passkeySignIn(call) {
      const library = await webAuthn();
      if ("kind" in library) return library;
      const pause = paused(call);
      if (pause) return pause;
      const account = accounts.all.find(({ passkeys }) => passkeys.some(({ id }) => id === call.body.id));
      const key = account?.passkeys.find(({ id }) => id === call.body.id);
      if (!account || !key) return wrong(call, "somebody", "by an unknown passkey");
      try {
        const { verified, authenticationInfo } = await library.verifyAuthenticationResponse({
          response: call.body as never,
          expectedChallenge: isMine,
          expectedOrigin: call.origin,
          expectedRPID: hostOf(call.origin),
          credential: {
            id: key.id,
            publicKey: Uint8Array.from(Buffer.from(key.publicKey, "base64url")),
            counter: key.counter,
          },
        });
        if (!verified) return wrong(call, account.name, "by passkey");
        const passkeys = account.passkeys.map(each =>
          each === key ? { ...key, counter: authenticationInfo.newCounter } : each,
        );
        accounts.put({ ...account, passkeys });
        return begin(account, call);
      } catch (problem) {
        return wrong(call, account.name, `by passkey: ${problem instanceof Error ? problem.message : String(problem)}`);
      }
    },
    async beginPasskey(call) {
      const library = await webAuthn();
      if ("kind" in library) return library;
      const account = me(call);
      if (!account)
        return refused("people.session", "Only people who are signed in have passkeys.", "Sign in first.", 409);
      const options = await library.generateRegistrationOptions({
        rpName: "Twincell",
        rpID: hostOf(call.origin),
        userName: account.name,
        userID: Uint8Array.from(randomBytes(16)),
        authenticatorSelection: { residentKey: "required", userVerification: "required" },
        excludeCredentials: account.passkeys.map(({ id }) => ({ id })),
      });
      remember(options.challenge);
      return json(options);
    },
    async addPasskey(call) {
      const library = await webAuthn();
      if ("kind" in library) return library;
      const account = me(call);
      if (!account)
        return refused("people.session", "Only people who are signed in have passkeys.", "Sign in first.", 409);
      try {
        const { verified, registrationInfo } = await library.verifyRegistrationResponse({
          response: call.body as never,
          expectedChallenge: isMine,
          expectedOrigin: call.origin,
          expectedRPID: hostOf(call.origin),
        });
        if (!verified) return refused("people.passkey", "This passkey could not be verified.", "Make it again.", 400);
        const { id, publicKey, counter, transports = [] } = registrationInfo.credential;
        const added = { id, publicKey: Buffer.from(publicKey).toString("base64url"), counter, transports };
        accounts.put({ ...account, passkeys: [...account.passkeys, added] });
        audit(account.name, "adds a passkey", "", true);
        return outcomeAnswer(DONE);
      } catch (problem) {
        const why = problem instanceof Error ? problem.message : String(problem);
        return refused("people.passkey", `This passkey could not be verified: ${why}.`, "Make it again.", 400);
      }
    },
    listPeople: () =>
      json({
        people: accounts.all.map(({ name, role, rights, password, passkeys }) => ({
          name,
          role,
          rights,
          password: password !== null,
          passkeys: passkeys.length,
          invited: password === null,
        })),
      }),
    putPerson(call) {
      const name = decodeURIComponent(call.params["name"]!);
      if (!personName.safeParse(name).success)
        return refused("people.unfit", `“${name}” is no name of a person.`, "Begin it with a letter or digit.", 400);
      const { role, rights, renew } = call.body;
      const known = accounts.find(name);
      if (known?.role === "admin" && role !== "admin" && isLastAdmin(accounts, name)) return lastAdmin(name);
      accounts.put({ passkeys: [], ...known, name, role, rights, password: renew ? null : (known?.password ?? null) });
      const link = known && !renew ? null : `${call.origin}/?invitation=${accounts.invite(name, role)}`;
      if (renew) sessions.endAll(name);
      return json({ kind: "done", link });
    },
    deletePerson(call) {
      const name = decodeURIComponent(call.params["name"]!);
      if (!accounts.find(name))
        return refused("people.nobody", `There is nobody called ${name}.`, "GET /api/v1/people lists them.", 404);
      if (isLastAdmin(accounts, name)) return lastAdmin(name);
      accounts.remove(name);
      sessions.endAll(name);
      return outcomeAnswer(DONE);
    },
  };
}
const isLastAdmin = ({ all }: Accounts, name: string): boolean =>
  all.every(each => each.role !== "admin" || each.name === name);
const lastAdmin = (name: string): Answer =>
  refused("people.last-admin", `${name} is the only admin.`, "Make somebody else an admin first.", 409);
