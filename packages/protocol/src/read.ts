import type { z } from "zod";
import { requestSchema, type ConnectionRequest } from "./ask.ts";
import { eventSchema, type ConnectionEvent } from "./tell.ts";

/** Counts up with every change that the other side would misunderstand. */
export const PROTOCOL = 3;
/** Hosts since this one say nothing that is misunderstood: plug-ins among them. */
export const OLDEST_HOST = 1;
/** A message longer than this is not looked at: a program of a hundred thousand steps is shorter. */
export const LONGEST_MESSAGE = 32 * 1024 * 1024;

export type Read<T> =
  | { readonly kind: "read"; readonly message: T }
  | { readonly kind: "fault"; readonly sentence: string };

export const readConnectionRequest = (text: string): Read<ConnectionRequest> => read(text, requestSchema, "request");
/** The request that a text is; what is none is answered with its fault, ends the connection, and gives null. */
export function requestOrEnd(
  text: string,
  tell: (message: ConnectionEvent) => void,
  end: () => void,
): ConnectionRequest | null {
  const heard = readConnectionRequest(text);
  if (heard.kind === "read") return heard.message;
  tell({ type: "fault", sentence: heard.sentence });
  end();
  return null;
}
export const readConnectionEvent = (text: string): Read<ConnectionEvent> => read(text, eventSchema, "message");
export const write = (message: ConnectionRequest | ConnectionEvent): string => JSON.stringify(message);

function read<T>(text: string, schema: z.ZodType<T>, what: string): Read<T> {
  if (text.length > LONGEST_MESSAGE)
    return {
      kind: "fault",
      sentence: `A ${what} of ${text.length} characters is longer than ${LONGEST_MESSAGE} and was not read.`,
    };
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (problem) {
    return { kind: "fault", sentence: `A ${what} is JSON; this one is not: ${(problem as Error).message}.` };
  }
  const parsed = schema.safeParse(value);
  if (parsed.success) return { kind: "read", message: parsed.data };
  const [issue] = parsed.error.issues;
  return {
    kind: "fault",
    sentence: `A ${what} could not be understood${issue && issue.path.length > 0 ? ` at “${issue.path.join(".")}”` : ""}: ${issue?.message ?? "it has no type that is known"}.`,
  };
}
