import type { Person, SessionInfo } from "@twincell/protocol";
import { sessionStore } from "../stores/session.ts";
import { say, words } from "../messages/index.ts";

const INVITATION = "invitation";
/** What a server answers, or the sentence of why not. */
export type Asked<T> =
  | { readonly kind: "answer"; readonly value: T }
  | { readonly kind: "no"; readonly sentence: string };

export async function ask<T>(method: string, path: string, body?: unknown): Promise<Asked<T>> {
  try {
    const response = await fetch(`/api/v1/${path}`, {
      method,
      ...(body === undefined ? {} : { body: JSON.stringify(body), headers: { "content-type": "application/json" } }),
    });
    const value = (await response.json()) as T & {
      readonly why?: { readonly sentence: string; readonly hint: string };
    };
    if (response.ok) return { kind: "answer", value };
    return {
      kind: "no",
      sentence: value.why ? `${say(value.why.sentence)} ${say(value.why.hint)}` : words.people.unreachable,
    };
  } catch {
    return { kind: "no", sentence: words.people.unreachable };
  }
}
function took(asked: Asked<SessionInfo>): string | null {
  if (asked.kind === "no") return asked.sentence;
  const { accounts, name, link } = asked.value;
  // A read-only link lets in without a name.
  const open = !accounts || (name === null && link !== null);
  sessionStore.setState({
    state: open ? "none" : name === null ? "signed-out" : "signed-in",
    info: asked.value,
    ...(name === null ? {} : { invitation: null }),
  });
  return null;
}

/** Asks the server of this page, where it has one, who is signed in. A link's invitation leaves the address at once. */
export async function lookForSession(): Promise<void> {
  const here = new URL(location.href);
  const invitation = here.searchParams.get(INVITATION);
  if (invitation !== null) {
    here.searchParams.delete(INVITATION);
    history.replaceState(history.state, "", here);
    sessionStore.setState({ invitation });
  }
  if (took(await ask<SessionInfo>("GET", "session")) !== null) sessionStore.setState({ state: "none", info: null });
}
/** Each resolves with the sentence of why not, or null. */
export const signIn = async (name: string, password: string): Promise<string | null> =>
  entered(took(await ask<SessionInfo>("POST", "session", { name, password })));
export const acceptInvitation = async (link: string, name: string, password: string): Promise<string | null> =>
  entered(took(await ask<SessionInfo>("POST", "invitation", { link, password, ...(name === "" ? {} : { name }) })));
export async function signOut(): Promise<void> {
  await ask("DELETE", "session");
  location.reload();
}
/** What was refused before somebody signed in is asked for anew: the page begins again with the session. */
function entered(sentence: string | null): string | null {
  if (sentence === null) location.reload();
  return sentence;
}

export async function signInByPasskey(): Promise<string | null> {
  const begun = await ask<PublicKeyCredentialRequestOptionsJSON>("POST", "session/passkey/begin", {});
  if (begun.kind === "no") return begun.sentence;
  try {
    const publicKey = PublicKeyCredential.parseRequestOptionsFromJSON(begun.value);
    const made = (await navigator.credentials.get({ publicKey })) as PublicKeyCredential | null;
    if (made === null) return words.people.passkeyNot;
    return entered(took(await ask<SessionInfo>("POST", "session/passkey", made.toJSON())));
  } catch {
    return `${words.people.passkeyNot} ${words.people.passkeyNotHint}`;
  }
}
export async function addPasskey(): Promise<string | null> {
  const begun = await ask<PublicKeyCredentialCreationOptionsJSON>("POST", "passkeys/begin", {});
  if (begun.kind === "no") return begun.sentence;
  try {
    const publicKey = PublicKeyCredential.parseCreationOptionsFromJSON(begun.value);
    const made = (await navigator.credentials.create({ publicKey })) as PublicKeyCredential | null;
    if (made === null) return words.people.passkeyNot;
    const added = await ask("POST", "passkeys", made.toJSON());
    if (added.kind === "no") return added.sentence;
    took(await ask<SessionInfo>("GET", "session"));
    return null;
  } catch {
    return `${words.people.passkeyNot} ${words.people.passkeyNotHint}`;
  }
}

export const listPeople = (): Promise<Asked<{ readonly people: readonly Person[] }>> => ask("GET", "people");
export const putPerson = (
  name: string,
  person: Pick<Person, "role" | "rights"> & { readonly renew?: boolean },
): Promise<Asked<{ readonly link: string | null }>> => ask("PUT", `people/${encodeURIComponent(name)}`, person);
export const removePerson = (name: string): Promise<Asked<unknown>> =>
  ask("DELETE", `people/${encodeURIComponent(name)}`);
