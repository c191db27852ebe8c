import type { z } from "zod";
import { askSchema, type Ask } from "./ask.ts";
import { tellSchema, type Tell } from "./tell.ts";

/** Counts up with every change that the other side would misunderstand. */
export const PROTOCOL = 2;
/** Hosts since this one say nothing that is misunderstood: plug-ins among them. */
export const OLDEST_HOST = 1;
/** A message longer than this is not looked at: a program of a hundred thousand steps is shorter. */
export const LONGEST_MESSAGE = 32 * 1024 * 1024;

export type Read<T> =
  | { readonly kind: "read"; readonly message: T }
  | { readonly kind: "fault"; readonly sentence: string };

export const readAsk = (text: string): Read<Ask> => read(text, askSchema, "request");
/** The request that a text is; what is none is answered with its fault, ends the connection, and gives null. */
export function askOrEnd(text: string, tell: (message: Tell) => void, end: () => void): Ask | null {
  const heard = readAsk(text);
  if (heard.kind === "read") return heard.message;
  tell({ type: "fault", sentence: heard.sentence });
  end();
  return null;
}
export const readTell = (text: string): Read<Tell> => read(text, tellSchema, "message");
export const write = (message: Ask | Tell): string => JSON.stringify(message);

function read<T>(text: string, schema: z.ZodType<T>, what: string): Read<T> {
  if (text.length > LONGEST_MESSAGE)
    return {
      kind: "fault",
      sentence: `A ${what} of ${text.length} characters is longer than ${LONGEST_MESSAGE} and was not read.`,
    };
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (trouble) {
    return { kind: "fault", sentence: `A ${what} is JSON; this one is not: ${(trouble as Error).message}.` };
  }
  const parsed = schema.safeParse(value);
  if (parsed.success) return { kind: "read", message: parsed.data };
  const [issue] = parsed.error.issues;
  return {
    kind: "fault",
    sentence: `A ${what} could not be understood${issue && issue.path.length > 0 ? ` at “${issue.path.join(".")}”` : ""}: ${issue?.message ?? "it has no type that is known"}.`,
  };
}
