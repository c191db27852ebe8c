import { z } from "zod";
import { requestSchema } from "../ask.ts";
import { editorMessageSchema, roomMessageSchema } from "../editing.ts";
import { eventSchema, outcomeSchema } from "../tell.ts";
import { PROTOCOL } from "../read.ts";
import { API_ROUTES, API_VERSION, LEASE_HEADER, type ApiRoute } from "./routes.ts";

type Json = Readonly<Record<string, unknown>>;
const INFO = (version: string, title: string, description: string): Json => ({
  title,
  version: `${API_VERSION}.0.0`,
  description: `${description} Served by Twincell ${version}. Not a certified safety device.`,
  license: { name: "Apache-2.0", identifier: "Apache-2.0" },
});
const draft = (schema: z.ZodType, io: "input" | "output"): Json => {
  const { $schema: _, ...rest } = z.toJSONSchema(schema, { target: "draft-2020-12", io, unrepresentable: "any" });
  return rest;
};
const parameters = (path: string): readonly string[] => [...path.matchAll(/\{(\w+)\}/g)].map(([, name]) => name!);
const failure = (description: string): Json => ({
  description,
  content: { "application/json": { schema: { $ref: "#/components/schemas/Outcome" } } },
});

function operation(id: string, route: ApiRoute): Json {
  const { answer } = route;
  const media =
    typeof answer === "string"
      ? { [answer]: { schema: answer === "application/schema+json" ? { type: "object" } : { type: "string" } } }
      : { "application/json": { schema: draft(answer, "input") } };
  return {
    operationId: id,
    summary: route.summary,
    tags: [route.tag],
    "x-access": route.access,
    parameters: [
      ...parameters(route.path).map(name => ({ name, in: "path", required: true, schema: { type: "string" } })),
      ...(route.lease === undefined
        ? []
        : [
            {
              name: LEASE_HEADER,
              in: "header",
              required: route.lease === "needed",
              schema: { type: "string" },
              description: "The lease of that robot.",
            },
          ]),
    ],
    ...(route.body === undefined
      ? {}
      : { requestBody: { required: true, content: { "application/json": { schema: draft(route.body, "input") } } } }),
    responses: {
      "200": { description: route.summary, content: media },
      ...(route.access === "open" ? {} : { "401": failure("Who asks is not known.") }),
      "400": failure("The request cannot be understood."),
      "404": failure("There is no such thing."),
      "409": failure("Refused or stopped, with the reason and the way out."),
      ...(route.access === "command" || route.access === "write" ? { "503": failure("The server closes.") } : {}),
      ...(route.access === "write" || route.access === "people"
        ? { "507": failure("The disk of the server takes nothing: nothing was kept.") }
        : {}),
    },
  };
}

/** OpenAPI 3.1 of the HTTP part, made from the table that the server answers from. */
export function openApiDocument(version: string): Json {
  const paths: Record<string, Record<string, Json>> = {};
  for (const [id, route] of Object.entries(API_ROUTES) as [string, ApiRoute][])
    (paths[route.path] ??= {})[route.method] = operation(id, route);
  return {
    openapi: "3.1.0",
    info: INFO(version, "Twincell HTTP API", "SI units and radians; joints count from 1."),
    servers: [{ url: "/" }],
    security: [{}, { token: [] }],
    paths,
    components: {
      schemas: { Outcome: draft(outcomeSchema, "input") },
      securitySchemes: { token: { type: "http", scheme: "bearer" } },
    },
  };
}

/** Addresses of the sockets. */
export const SOCKETS = { commands: "/stations", stream: "/api/v1/stream", editing: "/api/v1/editing" } as const;

/** AsyncAPI 3.0 of the sockets: one to look and command, one only to look. */
export function asyncApiDocument(version: string): Json {
  const messages: Record<string, Json> = {};
  const named = (kind: string, options: readonly { readonly shape: { readonly type: z.ZodType } }[]): string[] =>
    options.flatMap(option => {
      const schema = z.toJSONSchema(option as unknown as z.ZodType, {
        target: "draft-7",
        io: "input",
        unrepresentable: "any",
      });
      const { $schema: _, ...payload } = schema;
      const type = (payload.properties as Record<string, { const?: string; enum?: string[] }>)["type"]!;
      return (type.enum ?? [type.const!]).map(value => {
        const name = `${kind}-${value}`;
        messages[name] = {
          name: value,
          contentType: "application/json",
          payload: { ...payload, properties: { ...(payload.properties as object), type: { const: value } } },
        };
        return name;
      });
    });
  const requests = named("request", requestSchema.options);
  const events = named("event", eventSchema.options);
  const edits = named("edit", editorMessageSchema.options);
  const merged = named("merge", roomMessageSchema.options);
  const refs = (names: readonly string[]): Json =>
    Object.fromEntries(names.map(name => [name, { $ref: `#/components/messages/${name}` }]));
  const at = (channel: string, names: readonly string[]): readonly Json[] =>
    names.map(name => ({ $ref: `#/channels/${channel}/messages/${name}` }));
  const looked = events.filter(name => !["event-answer", "event-pendant", "event-pong"].includes(name));
  return {
    asyncapi: "3.0.0",
    info: {
      ...INFO(version, "Twincell sockets", `Messages are JSON texts, version ${PROTOCOL} of the protocol.`),
      license: { name: "Apache-2.0" },
    },
    defaultContentType: "application/json",
    channels: {
      commands: {
        address: SOCKETS.commands,
        description:
          "Looks and commands. Whoever has a lease says `alive` at least every 80 ms, or the robot is stopped.",
        messages: refs([...requests, ...events]),
      },
      stream: {
        address: SOCKETS.stream,
        description:
          "Only looks: no sign of life, nothing to say. `?robot=ID` for one robot, `?rate_Hz=N` for at most so many samples a second; with `?messages_per_s=N` each message is an array of what came since the last.",
        messages: refs(looked),
      },
      editing: {
        address: SOCKETS.editing,
        description:
          "Editing a cell together: `?cell=NAME`. Updates are those of a Yjs document, each accepted or refused by the role of its sender and by whether the cell can still be opened.",
        messages: refs([...edits, ...merged]),
      },
    },
    operations: {
      command: { action: "receive", channel: { $ref: "#/channels/commands" }, messages: at("commands", requests) },
      answer: { action: "send", channel: { $ref: "#/channels/commands" }, messages: at("commands", events) },
      stream: { action: "send", channel: { $ref: "#/channels/stream" }, messages: at("stream", looked) },
      edit: { action: "receive", channel: { $ref: "#/channels/editing" }, messages: at("editing", edits) },
      merge: { action: "send", channel: { $ref: "#/channels/editing" }, messages: at("editing", merged) },
    },
    components: { messages },
  };
}
