import { z } from "zod";

const text = z.string().max(2000);
const angles = z.array(z.number()).max(16);
/** JSON knows no NaN: what is not known is null. */
const maybe = z.number().nullable();
const value = z.union([z.boolean(), z.number()]);
const refusal = z.object({
  code: text,
  sentence: text,
  hint: text,
  joint: z.exactOptional(z.number()),
  value: z.exactOptional(z.number()),
  limit: z.exactOptional(z.number()),
});
export const outcomeSchema = z.discriminatedUnion("kind", [
  z.object({ kind: z.literal("done") }),
  z.object({ kind: z.literal("refused"), why: refusal }),
  z.object({ kind: z.literal("stopped"), why: refusal }),
]);
const station = { station: text } as const;
const stationWords = z.object({
  id: text,
  name: text,
  brand: text,
  robot: text,
  virtual: z.boolean(),
  watchdog: text,
  /** The robot file of a robot that is in no library, without its meshes. */
  robotFile: z.exactOptional(z.unknown()),
});

const names = z.array(text).max(64);
const place = z.tuple([z.number(), z.number(), z.number()]);
const mode = z.enum(["manual", "automatic", "remote"]);
/** What does not change about the pendant of a virtual controller while it is on. */
export const pendantWordsSchema = z.object({
  brand: text,
  brandName: text,
  robotName: text,
  host: text,
  ports: z.record(text, z.number()),
  keys: z.array(z.object({ id: text, name: text, mode })).max(8),
  labels: z.object({ servo: text, reset: text }),
  joints: z.array(z.object({ lower_rad: z.number(), upper_rad: z.number(), slides: z.boolean() })).max(16),
  inputs: names,
  outputs: names,
});
/**
 * What lamps, screen and read-out of the pendant say now; the truth of the controller itself, not what a driver knows
 * of it.
 */
export const pendantShownSchema = z.object({
  key: text,
  servo: z.enum(["on", "coming", "off"]),
  safety: z.enum(["normal", "guard-stop", "protective-stop", "emergency-stop"]),
  override: z.number(),
  program: text,
  running: z.boolean(),
  alarms: z.array(text).max(200),
  q_rad: angles,
  flange: z.object({ position: place, quaternion: z.tuple([z.number(), z.number(), z.number(), z.number()]) }),
  points: z.array(place).max(20),
  moving: z.boolean(),
  enabled: z.boolean(),
  jog: z.object({ joint: z.int(), direction: z.union([z.literal(-1), z.literal(1)]) }).nullable(),
  pressed: z.boolean(),
  gateOpen: z.boolean(),
  near: z.boolean(),
  on: z.array(text).max(128),
  trouble: z.object({ delay_s: z.number(), loss: z.number(), hangs: z.boolean(), unplugged: z.boolean() }),
  peers: z.array(text).max(256),
  says: text,
});

/** What a host of stations says. */
export const eventSchema = z.discriminatedUnion("type", [
  z.object({
    type: z.literal("hello"),
    protocol: z.int(),
    version: text,
    brands: z.array(z.object({ id: text, name: text, vendor: text, dialect: text, ports: z.record(text, z.number()) })),
    stations: z.array(stationWords),
  }),
  z.object({ type: z.literal("opened"), ...stationWords.shape }),
  z.object({ type: z.literal("closed"), ...station }),
  z.object({ type: z.literal("answer"), id: z.int(), outcome: outcomeSchema }),
  z.object({
    type: z.literal("sample"),
    ...station,
    sequence: z.number(),
    time_s: z.number(),
    /** When the host handed it on, on its own clock. */
    sent_s: z.number(),
    q_rad: angles,
    moving: z.boolean(),
    mode,
    safety: z.enum(["normal", "guard-stop", "protective-stop", "emergency-stop"]),
    override: z.number(),
    gripperClosed: z.boolean(),
    step: text,
    message: text,
    signals: z.exactOptional(z.record(text, value)),
    /** From the plan and from the controller's own command [rad]. */
    plan_rad: maybe,
    command_rad: maybe,
  }),
  z.object({
    type: z.literal("link"),
    ...station,
    state: z.enum(["closed", "connecting", "open", "lost"]),
    sentence: text,
    attempts: z.int(),
    rate_Hz: z.number(),
    late_s: z.number(),
    roundTrip_s: maybe,
    missing: z.number(),
  }),
  z.object({
    type: z.literal("guard"),
    ...station,
    holder: text.nullable(),
    pressed: z.boolean(),
    link: z.enum(["up", "lost", "unconfirmed"]),
    motion: z.enum(["at-rest", "moving", "stopping", "returning"]),
    trip: z.enum(["none", "return-due", "return-wanted"]),
    emergency: z.boolean(),
    watching: z.boolean(),
    /** Objects of a cell are known to it; false: the robot is kept from itself only. */
    cell: z.exactOptional(z.boolean()),
    /** Between links of the robot and objects at least this is kept, all errors in it [m]. */
    kept_m: z.exactOptional(z.number()),
  }),
  /**
   * Where the robot will be in so many seconds, and the first thing in its way; null when nothing is looked ahead any
   * more.
   */
  z.object({
    type: z.literal("ahead"),
    ...station,
    ahead: z
      .object({
        q_rad: angles,
        in_s: z.number(),
        problem: z.object({ code: text, sentence: text, in_s: z.number() }).nullable(),
      })
      .nullable(),
  }),
  /**
   * A group began: from the first to the last that was seen moving, on the host's clock [s]. Or it ended, each in its
   * way.
   */
  z.object({ type: z.literal("began"), stations: z.array(text), spread_s: z.number() }),
  z.object({
    type: z.literal("ended"),
    stations: z.array(z.object({ station: text, outcome: outcomeSchema })),
  }),
  /**
   * Somebody did something there; told when it was asked for, and once more with what became of it. Acts with the same
   * number are one.
   */
  z.object({
    type: z.literal("act"),
    ...station,
    number: z.int(),
    who: text,
    action: text,
    detail: text,
    command: z.boolean(),
    target: angles,
    outcome: outcomeSchema.nullable(),
  }),
  z.object({ type: z.literal("notice"), ...station, why: refusal }),
  /** A program that is run cycle after cycle: told at every change, and to whoever comes while it runs. */
  z.object({
    type: z.literal("production"),
    ...station,
    state: z.enum(["running", "held", "ended"]),
    /** Cycles begun, from 1; of how many, null for until it is ended. */
    cycle: z.int(),
    of: z.int().nullable(),
    program: text,
    /** The step it is in or goes on with; "" where that is not known. */
    step: text,
    /** Name of the program that takes over at the next cycle. */
    next: text.nullable(),
  }),
  /** To those who watch: `words` once, then only what is shown. */
  z.object({
    type: z.literal("pendant"),
    ...station,
    words: z.exactOptional(pendantWordsSchema),
    shown: pendantShownSchema,
  }),
  z.object({ type: z.literal("pong"), sent_s: z.number(), host_s: z.number() }),
  /** Something came that could not be read; the connection ends after it. */
  z.object({ type: z.literal("fault"), sentence: text }),
]);

export type ConnectionEvent = z.infer<typeof eventSchema>;
export type EventOf<Type extends ConnectionEvent["type"]> = Extract<ConnectionEvent, { readonly type: Type }>;
export type ConnectionInfo = z.infer<typeof stationWords>;
/** Read only, so that whoever makes them may keep them as they are. */
type Frozen<T> = T extends object ? { readonly [Name in keyof T]: Frozen<T[Name]> } : T;
export type PendantWords = Frozen<z.infer<typeof pendantWordsSchema>>;
export type PendantShown = Frozen<z.infer<typeof pendantShownSchema>>;
