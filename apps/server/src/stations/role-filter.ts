import { LONGEST_MESSAGE, write } from "@twincell/protocol";
import type { RoleAt } from "../people/gate.ts";
import { mayUse } from "../people/tokens.ts";

/** What everybody may say on the socket of the studio: looking, signs of life, and stops. */
const LOOKS: ReadonlySet<unknown> = new Set([
  "ping",
  "alive",
  "visit",
  "look-ahead",
  "preview",
  "takes",
  "stop",
  "intervene",
]);

/**
 * Messages of somebody with roles: what their role at that robot does not allow is answered as refused and never
 * reaches the host, whatever a page of theirs shows or hides.
 */
export function roleFilter(
  role: RoleAt,
  who: string,
  hear: (text: string) => void,
  send: (text: string) => void,
): (text: string) => void {
  return text => {
    const ask = text.length > LONGEST_MESSAGE ? null : parsed(text);
    // What is no request is the host's to answer.
    if (ask === null || LOOKS.has(ask["type"])) {
      hear(text);
      return;
    }
    const members = Array.isArray(ask["members"]) ? (ask["members"] as unknown[]) : [ask];
    const stations = members.map(each => (each as { readonly station?: unknown } | null)?.station);
    if (stations.every(station => mayUse(role(typeof station === "string" ? station : undefined), "command"))) {
      hear(text);
      return;
    }
    const { id } = ask;
    if (typeof id !== "number" || !Number.isInteger(id)) return;
    const sentence = `${who} may look and stop, and not command.`;
    const why = { code: "people.role", sentence, hint: "It needs the role operator or admin." };
    send(write({ type: "answer", id, outcome: { kind: "refused", why } }));
  };
}
function parsed(text: string): Readonly<Record<string, unknown>> | null {
  try {
    const value: unknown = JSON.parse(text);
    return typeof value === "object" && value !== null && !Array.isArray(value)
      ? (value as Readonly<Record<string, unknown>>)
      : null;
  } catch {
    return null;
  }
}
