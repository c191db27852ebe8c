import { fromBase64, toBase64 } from "@twincell/core/mesh";
import { z } from "zod";
import { LONGEST_MESSAGE, type Read } from "./read.ts";

/** Bytes of a shared document (Yjs, version 1 of its encoding) as base64. */
const bytes = z.string().transform((text, context) => {
  const decoded = fromBase64(text);
  if (decoded !== undefined) return decoded;
  context.addIssue({ code: "custom", message: "this is no base64" });
  return z.NEVER;
});
const shortText = z.string().max(200);
const number = z.int().nonnegative();

export const presenceSchema = z.object({
  program: shortText.describe("Name of the program they work on."),
  selected: z.object({ kind: shortText, id: shortText }).nullable(),
  pointer_m: z
    .tuple([z.number(), z.number(), z.number()])
    .readonly()
    .nullable()
    .describe("Where they point, in the world."),
});
const editorSchema = z.object({ connection: number, who: z.string(), presence: presenceSchema.nullable() });

/** What an editor of a shared cell says. */
export const editorMessageSchema = z.discriminatedUnion("type", [
  z.object({
    type: z.literal("join"),
    epoch: z.string().nullable().describe("Of the document that the editor has; null asks for everything."),
    vector: bytes.describe("State vector of the document that the editor has."),
  }),
  z.object({ type: z.literal("update"), number, update: bytes }),
  z.object({ type: z.literal("presence"), presence: presenceSchema }),
]);

/** What the server says to an editor of a shared cell. */
export const roomMessageSchema = z.discriminatedUnion("type", [
  z.object({
    type: z.literal("joined"),
    epoch: z.string().describe("Another one than before: the document was made anew."),
    connection: number,
    who: z.string(),
    right: z.enum(["write", "comment", "look"]),
    update: bytes.describe("What the editor has not."),
    vector: bytes,
    editors: z.array(editorSchema).readonly(),
  }),
  z.object({ type: z.literal("update"), update: bytes }),
  z.object({ type: z.literal("accepted"), number }),
  z.object({
    type: z.literal("refused"),
    number,
    why: z.object({ code: z.string(), sentence: z.string(), hint: z.string() }),
  }),
  z.object({ type: z.literal("editor"), editor: editorSchema }),
  z.object({ type: z.literal("left"), connection: number }),
]);
export type EditorRequest = z.infer<typeof editorMessageSchema>;
export type RoomEvent = z.infer<typeof roomMessageSchema>;

/** A message of a shared cell as text. */
export const writeEditing = (message: EditorRequest | RoomEvent): string =>
  JSON.stringify(message, (_, value: unknown) => (value instanceof Uint8Array ? toBase64(value) : value));
export const readEditorMessage = (text: string): Read<EditorRequest> => read(text, editorMessageSchema);
export const readRoomMessage = (text: string): Read<RoomEvent> => read(text, roomMessageSchema);

function read<T>(text: string, schema: z.ZodType<T>): Read<T> {
  if (text.length > LONGEST_MESSAGE)
    return { kind: "fault", sentence: `A message of ${text.length} characters is too long.` };
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (problem) {
    return { kind: "fault", sentence: `A message is JSON; this one is not: ${(problem as Error).message}.` };
  }
  const parsed = schema.safeParse(value);
  if (parsed.success) return { kind: "read", message: parsed.data };
  const [issue] = parsed.error.issues;
  return {
    kind: "fault",
    sentence: `A message could not be understood at “${issue?.path.join(".") ?? ""}”: ${issue?.message ?? ""}.`,
  };
}
