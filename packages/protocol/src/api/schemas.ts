import { z } from "zod";
import { eventSchema } from "../tell.ts";

const text = z.string().min(1).max(200);
const angles = z.array(z.number()).min(1).max(16);
const pose = z.object({
  position: z.tuple([z.number(), z.number(), z.number()]),
  quaternion: z.tuple([z.number(), z.number(), z.number(), z.number()]),
});
/** Robot ids and names of documents: letters, digits, "_", "-" and "."; the first is no dot. */
export const nameSchema = z.string().regex(/^[\w-][\w.-]{0,79}$/);
const program = z.unknown().describe("A program: docs/program.schema.json.");
const cell = z.unknown().describe("A saved cell: docs/cell.schema.json.");

export const openBody = z.object({
  id: nameSchema,
  driver: text.describe("Id of a driver: GET /api/v1/drivers."),
  model: text.describe("Id of a robot model: GET /api/v1/models."),
  name: z.exactOptional(text),
  worldFromBase: z.exactOptional(pose),
  address: z
    .exactOptional(
      z.object({
        host: text,
        ports: z.exactOptional(z.record(text, z.int().min(1).max(65_535))),
        data: z.exactOptional(z.record(text, z.array(z.number()).max(16))),
      }),
    )
    .describe("Where the controller is; left out, a virtual controller is started beside the server."),
  cell: z.exactOptional(cell),
  watch: z.exactOptional(z.boolean()).describe("true: opened to watch, nothing can be commanded."),
});
export const leaseBody = z.object({
  who: z.exactOptional(text).describe("Name that others see as the one who commands."),
  expires_s: z.number().min(1).max(3600).default(30).describe("Without a request that names it the lease ends then."),
});
export const moveBody = z.object({ q_rad: angles.describe("Target of each joint [rad]; metres for a sliding one.") });
export const speedBody = z.object({ percent: z.number().min(0).max(100) });
export const runBody = z.object({
  program,
  asText: z.boolean().default(false).describe("true: as a program of the controller's own language."),
  despite: z
    .exactOptional(z.array(text).max(100))
    .describe("Codes of red findings that you have seen and send it in spite of; any other keeps it from being sent."),
});
const order = {
  program: runBody.shape.program,
  asText: runBody.shape.asText,
  despite: runBody.shape.despite,
} as const;
const stepIds = z.array(text).max(1000);
export const produceBody = z.object({
  ...order,
  cycles: z.int().min(1).nullable().default(null).describe("null: until it is ended."),
  breakpoints: stepIds.default([]).describe("Ids of steps of the program's own list before which it is held."),
  stepping: z.boolean().default(false).describe("true: held before each step of that list."),
});
export const replaceBody = z.object(order);
export const resumeBody = z.object({
  from: z
    .enum(["step", "cycle"])
    .default("step")
    .describe("With the step it was in, from where the robot stands; or with a cycle from its beginning."),
});
export const breakpointsBody = z.object({ steps: stepIds });
export const stopBody = z.object({ emergency: z.boolean().default(false) });
export const cellBody = z.object({ cell });
const judged = {
  program,
  model: z.exactOptional(text).describe("Left out: the robot that the program names."),
  cell: z.exactOptional(cell),
} as const;
export const checkBody = z.object({ ...judged, margin_m: z.number().min(0).max(1).default(0) });
export const planBody = z.object({ ...judged, period_s: z.number().min(0.001).max(10).default(0.01) });
export const writeBody = z.object({ ...judged, language: text.describe("Id of a language: GET /api/v1/languages.") });
export const documentBody = z.unknown().describe("The document itself.");

const stationWords = z.object({
  id: z.string(),
  name: z.string(),
  driver: z.string(),
  model: z.string(),
  virtual: z.boolean(),
  watchdog: z.string().describe("What stops the robot when nobody commands it any more."),
});
const part = <Type extends "sample" | "link" | "guard" | "production">(type: Type) => {
  const found = eventSchema.options.find(({ shape }) => shape.type.value === type);
  if (!found) throw new Error(`There is no event “${type}”.`);
  return z.object({ ...found.shape });
};
/** What the server knows of one robot now; null where nothing was heard yet. */
export const stateSchema = z.object({
  robot: stationWords,
  sample: part("sample").nullable(),
  link: part("link").nullable(),
  guard: part("guard").nullable(),
  production: part("production").nullable(),
});
export const robotListSchema = z.object({ robots: z.array(stationWords) });
export const aboutSchema = z.object({
  name: z.literal("twincell"),
  version: z.string(),
  api: z.int(),
  protocol: z.int(),
  openapi: z.string(),
  asyncapi: z.string(),
});
export const leaseSchema = z.object({
  lease: z.string().describe("Secret; goes into the header Twincell-Lease."),
  robot: z.string(),
  who: z.string(),
  expires_s: z.number(),
});
export const modelsSchema = z.object({
  models: z.array(
    z.object({
      id: z.string(),
      name: z.string(),
      vendor: z.string(),
      joints: z.array(
        z.object({
          name: z.string(),
          slides: z.boolean(),
          lower_rad: z.number(),
          upper_rad: z.number(),
          speed_rad_s: z.number(),
        }),
      ),
      home_rad: z.array(z.number()),
      payload_kg: z.number().nullable().describe("null where no source states it"),
      reach_m: z.number(),
    }),
  ),
});
export const driversSchema = z.object({
  drivers: z.array(
    z.object({
      id: z.string(),
      name: z.string(),
      vendor: z.string(),
      dialect: z.string(),
      ports: z.record(z.string(), z.number()),
    }),
  ),
});
export const languagesSchema = z.object({
  languages: z.array(z.object({ id: z.string(), name: z.string(), vendor: z.string() })),
});
export const verdictSchema = z.looseObject({
  ok: z.boolean(),
  steps: z.array(
    z.looseObject({ id: z.string(), verdict: z.string(), findings: z.array(z.looseObject({ sentence: z.string() })) }),
  ),
});
export const planSchema = z.object({
  kind: z.enum(["planned", "stuck"]),
  duration_s: z.number(),
  time_s: z.array(z.number()),
  q_rad: z.array(z.array(z.number())),
  step: z.array(z.string()),
  stuck: z.looseObject({ step: z.string(), sentence: z.string(), hint: z.string() }).nullable(),
});
export const writtenSchema = z.object({
  files: z.array(z.object({ name: z.string(), text: z.string() })),
  warnings: z.array(z.unknown()),
  proof: z.array(z.object({ file: z.string(), worst_m: z.number(), worst_rad: z.number() })),
});
export const documentListSchema = z.object({ names: z.array(z.string()) });
export const recordingsSchema = z.object({
  recordings: z.array(z.object({ robot: z.string(), file: z.string(), bytes: z.int() })),
});
export const readinessSchema = z.object({ ready: z.boolean(), robots: z.int(), connected: z.int() });

const role = z.enum(["viewer", "programmer", "operator", "admin"]);
const rights = z.record(text, role).describe("Another role for single robots and cells, by id or name.");
export const sessionSchema = z.object({
  accounts: z.boolean().describe("Whether people sign in by name here."),
  name: z.string().nullable().describe("Who is signed in."),
  role: role.nullable(),
  rights,
  passkeys: z.int(),
  link: z.string().nullable().describe("Name of the cell that a read-only link lets in to; null without one."),
  training: z.boolean().describe("A server for training: it opens virtual controllers and reaches no real robot."),
});
export const cellLinkSchema = z.object({
  link: z.string().describe("Address that lets people look at this cell as it is edited, and at nothing else."),
  until: z.string().describe("ISO 8601, UTC: when it ends."),
});
export const signInBody = z.object({ name: text, password: z.string().min(1).max(200) });
export const invitationBody = z.object({
  link: z.string().min(1).max(100).describe("What the link carries."),
  name: z.exactOptional(text).describe("Asked for when the link is for nobody in particular."),
  password: z.string().min(1).max(200),
});
/** Objects of WebAuthn level 3 as JSON; what is in them is judged where they are used. */
export const webAuthnSchema = z.looseObject({ challenge: z.string() });
export const webAuthnBody = z.looseObject({ id: z.string().max(1024), response: z.looseObject({}) });
export const personBody = z.object({
  role,
  rights: rights.default({}),
  renew: z.boolean().default(false).describe("true: a new link to choose a password; the old password ends."),
});
export const peopleSchema = z.object({
  people: z.array(
    z.object({ name: z.string(), role, rights, password: z.boolean(), passkeys: z.int(), invited: z.boolean() }),
  ),
});
export const invitedSchema = z.object({ kind: z.literal("done"), link: z.string().nullable() });
export type SessionInfo = z.infer<typeof sessionSchema>;
export type Person = z.infer<typeof peopleSchema>["people"][number];

export const fleetSchema = z.object({
  robots: z.array(
    z.object({
      site: z.string(),
      id: z.string(),
      name: z.string(),
      model: z.string(),
      vendor: z.string(),
      virtual: z.boolean(),
      state: z.enum(["running", "idle", "attention", "stopped", "no-link"]),
      news: z.string(),
      holder: z.string().nullable(),
      use: z.number().describe("Share of the time since its server was started in which it moved, 0 … 1."),
      use_line: z.array(z.number()).describe("The same for each ten minutes of the last eight hours, the newest last."),
      since_ms: z.number().describe("Since when it has been in this state, milliseconds since 1970; 0 where unknown."),
      url: z.string().describe("Where its server is reached from other machines; empty where it is not."),
      roundTrip_s: z.number().nullable(),
      heard_ms: z.number().describe("When its last sample came, milliseconds since 1970."),
    }),
  ),
});
export const fleetCommandBody = z.object({
  id: z
    .string()
    .regex(/^[\w-]{8,100}$/)
    .describe("Makes it one command, however often it is sent."),
  token: z.string().max(200).describe("Of `twincell token add` at the server that has the robot."),
  robot: text,
  act: z.discriminatedUnion("type", [
    z.object({ type: z.literal("stop"), emergency: z.boolean() }),
    z.object({ type: z.literal("move"), q_rad: angles }),
    z.object({ type: z.literal("run"), program }),
  ]),
});
export type FleetEntry = z.infer<typeof fleetSchema>["robots"][number];
