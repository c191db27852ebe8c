import type { Pose } from "@twincell/core";
import { z } from "zod";

const text = z.string().min(1).max(200);
const angles = z.array(z.number()).max(16);
const pose = z
  .object({
    position: z.tuple([z.number(), z.number(), z.number()]),
    quaternion: z.tuple([z.number(), z.number(), z.number(), z.number()]),
  })
  .transform((value): Pose<"world", "base"> => value);
const port = z.int().min(1).max(65_535);
const station = { station: text } as const;
/** Codes of red findings that a person has seen and sends a program in spite of; any other keeps it from being sent. */
const despite = z.array(text).max(100);
/** Answered by the `answer` of the same number. */
const asked = { id: z.int().nonnegative() } as const;

/** What a person does at the pendant and at the cabinet of a virtual controller. Joints count from 1. */
export const pendantSchema = z.discriminatedUnion("do", [
  z.object({ do: z.literal("mode"), mode: z.enum(["manual", "automatic", "remote"]) }),
  /** The mode key, by the id of one of the brand's own positions. */
  z.object({ do: z.literal("key"), position: text }),
  /** The enabling switch: counts as let go when whoever holds it is not heard of (`alive`). */
  z.object({ do: z.literal("enable"), pressed: z.boolean() }),
  /** A jog key goes down, or with 0 up. Answered when the jog has ended. */
  z.object({
    do: z.literal("jog"),
    joint: z.int().min(1).max(16),
    direction: z.union([z.literal(-1), z.literal(0), z.literal(1)]),
  }),
  z.object({ do: z.literal("servo"), on: z.boolean() }),
  z.object({ do: z.literal("override"), percent: z.number() }),
  z.object({ do: z.literal("reset") }),
  z.object({ do: z.literal("emergency-stop"), pressed: z.boolean() }),
  z.object({ do: z.literal("guard"), open: z.boolean() }),
  /** What the proximity sensor sees (row T-27). */
  z.object({ do: z.literal("near"), somebody: z.boolean() }),
  z.object({ do: z.literal("protective-stop"), because: text }),
  z.object({ do: z.literal("input"), signal: text, value: z.union([z.boolean(), z.number()]) }),
  z.object({
    do: z.literal("trouble"),
    delay_s: z.exactOptional(z.number().min(0).max(10)),
    loss: z.exactOptional(z.number().min(0).max(1)),
    hangs: z.exactOptional(z.boolean()),
    unplugged: z.exactOptional(z.boolean()),
  }),
  z.object({ do: z.literal("reboot") }),
]);

/**
 * What one who commands may say to a host of stations. Lengths and counts are bounded; a program has its own door in
 * core.
 */
export const requestSchema = z.discriminatedUnion("type", [
  z.object({
    type: z.literal("open"),
    ...asked,
    ...station,
    brand: text,
    robot: text,
    name: z.exactOptional(text),
    /**
     * Where its programs take it to stand; and where it does stand among the other robots of the cell, to which it is
     * an obstacle then.
     */
    worldFromBase: z.exactOptional(pose),
    stand: z.exactOptional(pose),
    /** Where the controller is; left out, a virtual one is started where the host is. */
    address: z.exactOptional(
      z.object({
        host: text,
        ports: z.exactOptional(z.record(text, port)),
        data: z.exactOptional(z.record(text, angles)),
      }),
    ),
    /** The document of the cell it works in: what its guard keeps it from. */
    cell: z.exactOptional(z.unknown()),
    /** Opened to watch: nothing is commanded until somebody takes it to command. */
    watch: z.exactOptional(z.boolean()),
  }),
  /** Only to watch it from now on, or to command it again. */
  z.object({ type: z.literal("watch"), ...asked, ...station, on: z.boolean() }),
  z.object({
    type: z.enum(["close", "connect", "disconnect", "take", "release", "confirm", "reset"]),
    ...asked,
    ...station,
  }),
  /**
   * The cell is another from now on, or its objects or its tool are: its guard keeps the robot from them, in motion
   * too.
   */
  z.object({ type: z.literal("cell"), ...asked, ...station, cell: z.unknown() }),
  z.object({ type: z.literal("hold"), ...asked, ...station, pressed: z.boolean() }),
  z.object({ type: z.literal("speed"), ...asked, ...station, percent: z.number() }),
  z.object({ type: z.literal("move"), ...asked, ...station, q_rad: angles }),
  z.object({ type: z.literal("zero"), ...asked, ...station }),
  z.object({
    type: z.literal("run"),
    ...asked,
    ...station,
    program: z.unknown(),
    asText: z.boolean(),
    despite: z.exactOptional(despite),
  }),
  /**
   * Runs a program cycle after cycle, `cycles` times or until it is ended; held before the steps named, and before each
   * one with `stepping`. Answered at its end.
   */
  z.object({
    type: z.literal("produce"),
    ...asked,
    ...station,
    program: z.unknown(),
    asText: z.boolean(),
    despite: z.exactOptional(despite),
    cycles: z.int().min(1).nullable(),
    breakpoints: z.array(text).max(1000),
    stepping: z.boolean(),
  }),
  /** Another program from the next cycle on; answered when it has taken over, or why it does not. */
  z.object({
    type: z.literal("replace"),
    ...asked,
    ...station,
    program: z.unknown(),
    asText: z.boolean(),
    despite: z.exactOptional(despite),
  }),
  /** Holds a production to take over by hand, and as a stop anyone may; `resume` hands back. */
  z.object({ type: z.enum(["intervene", "single-step"]), ...asked, ...station }),
  z.object({ type: z.literal("resume"), ...asked, ...station, from: z.enum(["step", "cycle"]) }),
  z.object({ type: z.literal("breakpoints"), ...asked, ...station, steps: z.array(text).max(1000) }),
  /** How far ahead of the robot is looked [s]. */
  z.object({ type: z.literal("look-ahead"), ...asked, ...station, seconds: z.number().min(0.5).max(10) }),
  /** Shows where a program would take the robot; nothing is sent to it. */
  z.object({ type: z.literal("preview"), ...asked, ...station, program: z.unknown() }),
  /** Whether its connection can be told every step of a program, one by one; nothing is sent to it. */
  z.object({ type: z.literal("takes"), ...asked, ...station, program: z.unknown() }),
  /** All or none: every one is made ready first, then all start on one clock, and whoever is stopped stops all. */
  z.object({
    type: z.literal("together"),
    ...asked,
    members: z
      .array(z.object({ station: text, program: z.unknown(), asText: z.boolean(), despite: z.exactOptional(despite) }))
      .min(2)
      .max(16),
  }),
  /** Anyone may. Without a station it is all of them. */
  z.object({ type: z.literal("stop"), station: z.exactOptional(text), emergency: z.boolean() }),
  z.object({ type: z.literal("pendant"), ...asked, ...station, act: pendantSchema }),
  /** To be told, or no longer told, what the pendant of a virtual controller shows. */
  z.object({ type: z.literal("visit"), ...asked, ...station, on: z.boolean() }),
  /** Pulls the plug of a virtual controller, or puts it back. */
  z.object({ type: z.literal("plug"), ...asked, ...station, pulled: z.boolean() }),
  z.object({ type: z.literal("alive"), ...station }),
  /** Comes back as it is, for the time it takes (row T-61). */
  z.object({ type: z.literal("ping"), sent_s: z.number() }),
]);

export type ConnectionRequest = z.infer<typeof requestSchema>;
export type RequestOf<Type extends ConnectionRequest["type"]> = Extract<ConnectionRequest, { readonly type: Type }>;
export type PendantAct = z.infer<typeof pendantSchema>;
