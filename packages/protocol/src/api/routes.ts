import type { z } from "zod";
import { outcomeSchema } from "../tell.ts";
import * as s from "./schemas.ts";

/** Version in the addresses; docs/api.md says what may change without a new one. */
export const API_VERSION = 1;
/** Header that carries the lease of the one who commands. */
export const LEASE_HEADER = "twincell-lease";

export interface ApiRoute {
  readonly method: "get" | "put" | "post" | "delete";
  /** With `{name}` for what varies. */
  readonly path: string;
  readonly summary: string;
  readonly tag: "server" | "people" | "robots" | "commands" | "programs" | "documents" | "recordings";
  /**
   * "open": no account or code is asked for; "look": whoever may look; "write": whoever may change programs and cells;
   * "command": whoever may move robots; "stop": anyone, always; "people": whoever may say who may do what.
   */
  readonly access: "open" | "look" | "write" | "command" | "stop" | "people";
  /** Whether the header Twincell-Lease must name the lease of that robot. */
  readonly lease?: "needed" | "when-taken";
  readonly body?: z.ZodType;
  /** Schema of a JSON answer, or the media type of another one. */
  readonly answer: z.ZodType | "text/html" | "text/plain" | "application/octet-stream" | "application/schema+json";
}

const robots = "/api/v1/robots";
const robot = `${robots}/{id}`;
const commands = { tag: "commands", access: "command", answer: outcomeSchema } as const;

/**
 * Every address that the server answers beside the files of the studio: the documents at /api and the server are made
 * from this table.
 */
export const API_ROUTES = {
  apiPage: {
    method: "get",
    path: "/api",
    summary: "This API for people",
    tag: "server",
    access: "open",
    answer: "text/html",
  },
  openapi: {
    method: "get",
    path: "/api/openapi.json",
    summary: "OpenAPI 3.1 document of the HTTP part",
    tag: "server",
    access: "open",
    answer: "application/schema+json",
  },
  asyncapi: {
    method: "get",
    path: "/api/asyncapi.json",
    summary: "AsyncAPI 3.0 document of the sockets",
    tag: "server",
    access: "open",
    answer: "application/schema+json",
  },
  healthz: {
    method: "get",
    path: "/healthz",
    summary: "The process answers",
    tag: "server",
    access: "open",
    answer: "text/plain",
  },
  readyz: {
    method: "get",
    path: "/readyz",
    summary: "Whether requests are taken: 503 while the server closes",
    tag: "server",
    access: "open",
    answer: s.readinessSchema,
  },
  metrics: {
    method: "get",
    path: "/metrics",
    summary: "Figures for Prometheus",
    tag: "server",
    access: "look",
    answer: "text/plain",
  },
  about: {
    method: "get",
    path: "/api/v1",
    summary: "Versions and documents",
    tag: "server",
    access: "look",
    answer: s.aboutSchema,
  },
  session: {
    method: "get",
    path: "/api/v1/session",
    summary: "Who is signed in, and whether people sign in here",
    tag: "people",
    access: "open",
    answer: s.sessionSchema,
  },
  signIn: {
    method: "post",
    path: "/api/v1/session",
    summary: "Signs in by name and password; the session is a cookie",
    tag: "people",
    access: "open",
    body: s.signInBody,
    answer: s.sessionSchema,
  },
  signOut: {
    method: "delete",
    path: "/api/v1/session",
    summary: "Signs out",
    tag: "people",
    access: "open",
    answer: outcomeSchema,
  },
  acceptInvitation: {
    method: "post",
    path: "/api/v1/invitation",
    summary: "Chooses name and password with a link that works once, and signs in",
    tag: "people",
    access: "open",
    body: s.invitationBody,
    answer: s.sessionSchema,
  },
  beginPasskeySignIn: {
    method: "post",
    path: "/api/v1/session/passkey/begin",
    summary: "What a browser needs to sign in by passkey (WebAuthn)",
    tag: "people",
    access: "open",
    answer: s.webAuthnSchema,
  },
  passkeySignIn: {
    method: "post",
    path: "/api/v1/session/passkey",
    summary: "Signs in by passkey",
    tag: "people",
    access: "open",
    body: s.webAuthnBody,
    answer: s.sessionSchema,
  },
  beginPasskey: {
    method: "post",
    path: "/api/v1/passkeys/begin",
    summary: "What a browser needs to make a passkey for whoever is signed in",
    tag: "people",
    access: "look",
    answer: s.webAuthnSchema,
  },
  addPasskey: {
    method: "post",
    path: "/api/v1/passkeys",
    summary: "Adds a passkey to whoever is signed in",
    tag: "people",
    access: "look",
    body: s.webAuthnBody,
    answer: outcomeSchema,
  },
  listPeople: {
    method: "get",
    path: "/api/v1/people",
    summary: "People with their roles",
    tag: "people",
    access: "people",
    answer: s.peopleSchema,
  },
  putPerson: {
    method: "put",
    path: "/api/v1/people/{name}",
    summary:
      "Gives somebody a role, and roles for single robots and cells; a new one or `renew` gives a link to choose a password",
    tag: "people",
    access: "people",
    body: s.personBody,
    answer: s.invitedSchema,
  },
  deletePerson: {
    method: "delete",
    path: "/api/v1/people/{name}",
    summary: "Takes somebody's account away; their sessions and sockets end",
    tag: "people",
    access: "people",
    answer: outcomeSchema,
  },
  models: {
    method: "get",
    path: "/api/v1/models",
    summary: "Robot models of the library",
    tag: "server",
    access: "look",
    answer: s.modelsSchema,
  },
  drivers: {
    method: "get",
    path: "/api/v1/drivers",
    summary: "Drivers of controllers",
    tag: "server",
    access: "look",
    answer: s.driversSchema,
  },
  languages: {
    method: "get",
    path: "/api/v1/languages",
    summary: "Languages that programs are written in",
    tag: "server",
    access: "look",
    answer: s.languagesSchema,
  },
  listRobots: {
    method: "get",
    path: robots,
    summary: "Open robots",
    tag: "robots",
    access: "look",
    answer: s.robotListSchema,
  },
  openRobot: {
    ...commands,
    method: "post",
    path: robots,
    summary: "Opens a robot: a virtual controller, or a driver to one at an address",
    tag: "robots",
    body: s.openBody,
  },
  closeRobot: {
    ...commands,
    method: "delete",
    path: robot,
    summary: "Closes it; stops it first",
    tag: "robots",
    lease: "when-taken",
  },
  robotState: {
    method: "get",
    path: `${robot}/state`,
    summary: "Last sample, link and guard; no lease, no sign of life",
    tag: "robots",
    access: "look",
    answer: s.stateSchema,
  },
  fleet: {
    method: "get",
    path: "/api/v1/fleet",
    summary: "Robots of all servers of the cluster, or of this one when it is by itself",
    tag: "robots",
    access: "look",
    answer: s.fleetSchema,
  },
  fleetCommand: {
    ...commands,
    method: "post",
    path: "/api/v1/fleet/{site}/command",
    summary: "Asks the server that has a robot to do something, once for each id",
    access: "look",
    body: s.fleetCommandBody,
  },
  takeLease: {
    method: "post",
    path: `${robot}/lease`,
    summary: "Takes the lease: one commands, anyone may stop",
    tag: "commands",
    access: "command",
    body: s.leaseBody,
    answer: s.leaseSchema,
  },
  giveLease: {
    ...commands,
    method: "delete",
    path: `${robot}/lease`,
    summary: "Gives the lease back; a robot that moves is stopped",
    lease: "needed",
  },
  connect: {
    ...commands,
    method: "post",
    path: `${robot}/connect`,
    summary: "Connects its controller",
    lease: "needed",
  },
  disconnect: {
    ...commands,
    method: "post",
    path: `${robot}/disconnect`,
    summary: "Disconnects it; stops it first",
    lease: "needed",
  },
  confirm: {
    ...commands,
    method: "post",
    path: `${robot}/confirm`,
    summary: "A person's word that motion is wanted again after a lost link",
    lease: "needed",
  },
  reset: {
    ...commands,
    method: "post",
    path: `${robot}/reset`,
    summary: "Resets the controller after a fault",
    lease: "needed",
  },
  speed: {
    ...commands,
    method: "post",
    path: `${robot}/speed`,
    summary: "Sets the override",
    lease: "needed",
    body: s.speedBody,
  },
  move: {
    ...commands,
    method: "post",
    path: `${robot}/move`,
    summary: "Moves to joint angles; answered when it stands. Ending the request stops the robot",
    lease: "needed",
    body: s.moveBody,
  },
  run: {
    ...commands,
    method: "post",
    path: `${robot}/run`,
    summary: "Checks a program and runs it; answered at its end. Ending the request stops the robot",
    lease: "needed",
    body: s.runBody,
  },
  produce: {
    ...commands,
    method: "post",
    path: `${robot}/production`,
    summary: "Runs a program cycle after cycle; answered at its end. Ending the request stops the robot",
    lease: "needed",
    body: s.produceBody,
  },
  replaceProgram: {
    ...commands,
    method: "put",
    path: `${robot}/production/program`,
    summary: "Another program from the next cycle on, without a stop; answered when it has taken over",
    lease: "needed",
    body: s.replaceBody,
  },
  holdProduction: {
    ...commands,
    method: "post",
    path: `${robot}/production/hold`,
    summary: "Stops the robot and keeps the place, to take over by hand; anyone may",
    access: "stop",
  },
  resumeProduction: {
    ...commands,
    method: "post",
    path: `${robot}/production/resume`,
    summary: "Hands back to a held production, from where the robot stands",
    lease: "needed",
    body: s.resumeBody,
  },
  stepProduction: {
    ...commands,
    method: "post",
    path: `${robot}/production/step`,
    summary: "One step of a held production",
    lease: "needed",
  },
  setBreakpoints: {
    ...commands,
    method: "put",
    path: `${robot}/production/breakpoints`,
    summary: "Steps before which the production is held",
    lease: "needed",
    body: s.breakpointsBody,
  },
  setCell: {
    ...commands,
    method: "put",
    path: `${robot}/cell`,
    summary: "The cell that its guard keeps the robot clear of",
    lease: "when-taken",
    body: s.cellBody,
  },
  stop: {
    ...commands,
    method: "post",
    path: `${robot}/stop`,
    summary: "Stops it; anyone may",
    access: "stop",
    body: s.stopBody,
  },
  stopAll: {
    ...commands,
    method: "post",
    path: "/api/v1/stop",
    summary: "Stops every robot; anyone may",
    access: "stop",
    body: s.stopBody,
  },
  check: {
    method: "post",
    path: "/api/v1/check",
    summary: "Judges a program: reach, limits, speed, torque, branches, collision",
    tag: "programs",
    access: "look",
    body: s.checkBody,
    answer: s.verdictSchema,
  },
  plan: {
    method: "post",
    path: "/api/v1/plan",
    summary: "The motion of a program over time",
    tag: "programs",
    access: "look",
    body: s.planBody,
    answer: s.planSchema,
  },
  writeText: {
    method: "post",
    path: "/api/v1/write",
    summary: "A program in a controller's own language, executed and compared with the plan first",
    tag: "programs",
    access: "look",
    body: s.writeBody,
    answer: s.writtenSchema,
  },
  ...documentRoutes("program", "programs"),
  ...documentRoutes("cell", "cells"),
  linkCell: {
    method: "post",
    path: "/api/v1/cells/{name}/link",
    summary: "A link by which people look at a cell while it is edited, without an account, for 30 days",
    tag: "documents",
    access: "write",
    answer: s.cellLinkSchema,
  },
  unlinkCell: {
    method: "delete",
    path: "/api/v1/cells/{name}/link",
    summary: "Takes back all read-only links of a cell",
    tag: "documents",
    access: "write",
    answer: outcomeSchema,
  },
  listRecordings: {
    method: "get",
    path: "/api/v1/recordings",
    summary: "Recordings of the robots of this server",
    tag: "recordings",
    access: "look",
    answer: s.recordingsSchema,
  },
  getRecording: {
    method: "get",
    path: "/api/v1/recordings/{robot}/{file}",
    summary: "One recording as MCAP",
    tag: "recordings",
    access: "look",
    answer: "application/octet-stream",
  },
} as const satisfies Record<string, ApiRoute>;

export type ApiRouteId = keyof typeof API_ROUTES;
/** The body of a request as it was understood. */
export type ApiBody<Id extends ApiRouteId> = (typeof API_ROUTES)[Id] extends {
  readonly body: infer Body extends z.ZodType;
}
  ? z.output<Body>
  : undefined;

/** A folder of documents: list, read, keep, remove. */
function documentRoutes<One extends "program" | "cell">(one: One, many: "programs" | "cells") {
  const path = `/api/v1/${many}/{name}`;
  const tag = "documents" as const;
  const routes = {
    list: {
      method: "get",
      path: `/api/v1/${many}`,
      summary: `Names of the ${many} kept here`,
      tag,
      access: "look",
      answer: s.documentListSchema,
    },
    get: { method: "get", path, summary: `One ${one}`, tag, access: "look", answer: s.documentBody },
    put: {
      method: "put",
      path,
      summary: `Keeps a ${one} under a name`,
      tag,
      access: "write",
      body: s.documentBody,
      answer: outcomeSchema,
    },
    delete: { method: "delete", path, summary: `Removes a ${one}`, tag, access: "write", answer: outcomeSchema },
  } as const satisfies Record<string, ApiRoute>;
  return Object.fromEntries(Object.entries(routes).map(([act, route]) => [`${act}_${one}`, route])) as unknown as {
    readonly [Act in keyof typeof routes as `${Act}_${One}`]: (typeof routes)[Act];
  };
}
