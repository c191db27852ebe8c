import { z } from "zod";

/** Counts up with every change that the other side would misunderstand. */
export const VIDEO_PROTOCOL = 1;
export const VIDEO_PATH = "/video";
/** A text longer than this is not looked at [characters]. */
export const LONGEST_VIDEO_TEXT = 2_000;
/** A picture longer than this is refused: 4K as a JPEG of good quality is shorter [bytes]. */
export const LARGEST_PICTURE = 2 * 1024 * 1024;
/** So many pictures may be under way to one viewer: one on the line, one being unpacked. */
export const MAX_PENDING = 2;

const camera = { camera: z.int().min(1).max(0xffff) } as const;
const sequence = { sequence: z.int().min(0).max(0xffff_ffff) } as const;

/** What cameras and viewers may say. */
const requestSchema = z.discriminatedUnion("type", [
  /**
   * From now on this connection is a camera; pictures come as binary messages. Who comes again with the same key takes
   * their own old place.
   */
  z.strictObject({ type: z.literal("camera"), name: z.string().min(1).max(60), key: z.string().min(8).max(60) }),
  /** From now on the list of cameras is told. */
  z.strictObject({ type: z.literal("viewer") }),
  z.strictObject({ type: z.enum(["watch", "unwatch"]), ...camera }),
  /** That picture was unpacked: the next may come. */
  z.strictObject({ type: z.literal("seen"), ...camera, ...sequence }),
  /** Comes back with the relay's clock. */
  z.strictObject({ type: z.literal("ping"), sent_s: z.number() }),
]);
const eventSchema = z.discriminatedUnion("type", [
  /** `links`: addresses by which other machines open the page of a camera, access code included. */
  z.strictObject({ type: z.literal("hello"), protocol: z.int(), links: z.array(z.string().max(300)).max(32) }),
  z.strictObject({ type: z.literal("cameras"), cameras: z.array(z.strictObject({ ...camera, name: z.string() })) }),
  /** To a camera: that picture has arrived, and so many look on. Without anybody one picture a second is enough. */
  z.strictObject({ type: z.literal("arrived"), ...sequence, watchers: z.int().nonnegative() }),
  z.strictObject({ type: z.literal("watchers"), watchers: z.int().nonnegative() }),
  z.strictObject({ type: z.literal("pong"), sent_s: z.number(), relay_s: z.number() }),
  z.strictObject({ type: z.literal("fault"), sentence: z.string() }),
]);
export type VideoRequest = z.infer<typeof requestSchema>;
export type VideoEvent = z.infer<typeof eventSchema>;
export type VideoEventOf<Type extends VideoEvent["type"]> = Extract<VideoEvent, { readonly type: Type }>;

export type VideoRead<T> =
  | { readonly kind: "read"; readonly message: T }
  | { readonly kind: "fault"; readonly sentence: string };
export const readVideoRequest = (text: string): VideoRead<VideoRequest> => read(text, requestSchema);
export const readVideoEvent = (text: string): VideoRead<VideoEvent> => read(text, eventSchema);
export const writeVideo = (message: VideoRequest | VideoEvent): string => JSON.stringify(message);

function read<T>(text: string, schema: z.ZodType<T>): VideoRead<T> {
  if (text.length > LONGEST_VIDEO_TEXT * 8)
    return { kind: "fault", sentence: `A message of ${text.length} characters is too long to be one about cameras.` };
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return { kind: "fault", sentence: "A message about cameras is JSON; this one is not." };
  }
  const parsed = schema.safeParse(value);
  return parsed.success
    ? { kind: "read", message: parsed.data }
    : {
        kind: "fault",
        sentence: `A message about cameras could not be understood: ${parsed.error.issues[0]?.message ?? "it has no type that is known"}.`,
      };
}

/** What stands before the bytes of a picture. All times are of the relay's clock [s]. */
export interface PictureHead {
  /** Given by the relay; a camera says 0. */
  readonly camera: number;
  readonly sequence: number;
  /** When light fell on the sensor, as well as the camera knows. */
  readonly captured_s: number;
  /** When the camera sent it. */
  readonly sent_s: number;
  /** When the relay had it; a camera says 0. */
  readonly relayed_s: number;
  /** How far the camera's clock may be off [s]. */
  readonly uncertain_s: number;
}
/**
 * Little-endian: u16 magic, u16 camera, u32 sequence, f64 captured, f64 sent, f64 relayed, f32 uncertain, u32 zero;
 * then the JPEG.
 */
export const PICTURE_HEAD_BYTES = 40;
const MAGIC = 0x5654; // "TV"

/** Writes the head into the first 40 bytes. */
export function writePictureHead(bytes: Uint8Array, head: PictureHead): void {
  const view = new DataView(bytes.buffer, bytes.byteOffset, PICTURE_HEAD_BYTES);
  view.setUint16(0, MAGIC, true);
  view.setUint16(2, head.camera, true);
  view.setUint32(4, head.sequence, true);
  view.setFloat64(8, head.captured_s, true);
  view.setFloat64(16, head.sent_s, true);
  view.setFloat64(24, head.relayed_s, true);
  view.setFloat32(32, head.uncertain_s, true);
  view.setUint32(36, 0, true);
}
/**
 * Null when it is no picture: too short or long, another magic, a time that is no number, or no JPEG behind the head.
 */
export function readPictureHead(bytes: Uint8Array): PictureHead | null {
  if (bytes.length < PICTURE_HEAD_BYTES + 4 || bytes.length > LARGEST_PICTURE) return null;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (view.getUint16(0, true) !== MAGIC || bytes[PICTURE_HEAD_BYTES] !== 0xff || bytes[PICTURE_HEAD_BYTES + 1] !== 0xd8)
    return null;
  const head: PictureHead = {
    camera: view.getUint16(2, true),
    sequence: view.getUint32(4, true),
    captured_s: view.getFloat64(8, true),
    sent_s: view.getFloat64(16, true),
    relayed_s: view.getFloat64(24, true),
    uncertain_s: view.getFloat32(32, true),
  };
  return [head.captured_s, head.sent_s, head.relayed_s, head.uncertain_s].every(Number.isFinite) &&
    head.uncertain_s >= 0
    ? head
    : null;
}
/** Writes into a picture on its way which camera it is of and when the relay had it. */
export function stampPicture(bytes: Uint8Array, camera: number, relayed_s: number): void {
  const view = new DataView(bytes.buffer, bytes.byteOffset, PICTURE_HEAD_BYTES);
  view.setUint16(2, camera, true);
  view.setFloat64(24, relayed_s, true);
}
