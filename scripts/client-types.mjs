// Types of clients/typescript, made from the two documents of the API. node scripts/write-client.mjs writes the file.
import { asyncApiDocument, openApiDocument } from "@twincell/protocol";

const indented = (text, by) => text.replaceAll("\n", `\n${" ".repeat(by)}`);
const key = name => (/^[A-Za-z_$][\w$]*$/.test(name) ? name : JSON.stringify(name));
/** Lines of a comment are no longer than this with what stands before them. */
const WIDTH = 90;
function comment(description) {
  if (!description) return "";
  const lines = [""];
  for (const word of description.replaceAll("*/", "* /").split(" ")) {
    if (lines.at(-1).length + word.length > WIDTH) lines.push("");
    lines.push(`${lines.pop()} ${word}`);
  }
  return lines.length === 1 ? `/**${lines[0]} */\n` : `/**\n${lines.map(line => ` *${line}`).join("\n")}\n */\n`;
}

/**
 * A JSON Schema (draft 2020-12, as Zod writes it) as a type of TypeScript.
 *
 * @param {Record<string, any>} schema
 * @param {"input" | "output"} side  of an input, what has a default may be left out.
 * @returns {string}
 */
export function typeOf(schema, side) {
  if (schema.$ref) return schema.$ref.split("/").at(-1);
  if (schema.const !== undefined) return JSON.stringify(schema.const);
  if (schema.enum) return schema.enum.map(each => JSON.stringify(each)).join(" | ");
  const union = schema.anyOf ?? schema.oneOf;
  if (union) return [...new Set(union.map(each => typeOf(each, side)))].join(" | ");
  switch (schema.type) {
    case "string":
      return "string";
    case "number":
    case "integer":
      return "number";
    case "boolean":
      return "boolean";
    case "null":
      return "null";
    case "array":
      return arrayOf(schema, side);
    case "object":
      return objectOf(schema, side);
    default:
      return "unknown";
  }
}
function arrayOf({ prefixItems, items }, side) {
  if (prefixItems) return `readonly [${prefixItems.map(each => typeOf(each, side)).join(", ")}]`;
  const item = typeOf(items ?? {}, side);
  return `readonly ${/[ |]/.test(item) ? `(${item})` : item}[]`;
}
function objectOf({ properties = {}, required = [], additionalProperties }, side) {
  const names = Object.keys(properties);
  const open = additionalProperties && typeof additionalProperties === "object" ? additionalProperties : null;
  if (names.length === 0) return `Readonly<Record<string, ${open ? typeOf(open, side) : "unknown"}>>`;
  const lines = names.map(name => {
    const each = properties[name];
    const optional = !required.includes(name) || (side === "input" && each.default !== undefined);
    return `${comment(each.description)}readonly ${key(name)}${optional ? "?" : ""}: ${typeOf(each, side)};`;
  });
  if (open) lines.push("readonly [more: string]: unknown;");
  return `{\n  ${lines.map(line => indented(line, 2)).join("\n  ")}\n}`;
}

function answerOf(media, schema) {
  if (media === "application/json") return typeOf(schema, "output");
  if (media === "application/schema+json") return "Readonly<Record<string, unknown>>";
  return media.startsWith("text/") ? "string" : "Uint8Array";
}

/** The text of clients/typescript/src/api.ts. */
export function clientTypes() {
  const openapi = openApiDocument("");
  const asyncapi = asyncApiDocument("");
  const routes = [];
  for (const [path, methods] of Object.entries(openapi.paths))
    for (const [method, operation] of Object.entries(methods)) {
      const body = operation.requestBody?.content["application/json"].schema;
      const [[media, { schema }]] = Object.entries(operation.responses["200"].content);
      const answer = answerOf(media, schema);
      routes.push(
        `${comment(operation.summary)}readonly ${operation.operationId}: {\n  readonly method: ${JSON.stringify(method.toUpperCase())};\n  readonly path: ${JSON.stringify(path)};\n  readonly body: ${body ? indented(typeOf(body, "input"), 2) : "undefined"};\n  readonly answer: ${indented(answer, 2)};\n};`,
      );
    }
  const table = Object.entries(openapi.paths).flatMap(([path, methods]) =>
    Object.entries(methods).map(
      ([method, { operationId }]) =>
        `  ${operationId}: [${JSON.stringify(method.toUpperCase())}, ${JSON.stringify(path)}],`,
    ),
  );
  const told = asyncapi.channels.stream.messages;
  const events = Object.keys(told).map(name => {
    const message = asyncapi.components.messages[told[name].$ref.split("/").at(-1)];
    return typeOf(message.payload, "output");
  });
  return `// Written by \`node scripts/write-client.mjs\` from the schemas of the server. Do not edit.

/** What became of a command. */
export type Outcome = ${typeOf(openapi.components.schemas.Outcome, "output")};

/** What each address of the API is asked and answers. SI units and radians; joints count from 1. */
export interface Routes {
  ${routes.map(route => indented(route, 2)).join("\n  ")}
}
export type RouteId = keyof Routes;
export type Body<Id extends RouteId> = Routes[Id]["body"];
export type Answer<Id extends RouteId> = Routes[Id]["answer"];

export const ROUTES: { readonly [Id in RouteId]: readonly [Routes[Id]["method"], Routes[Id]["path"]] } = {
${table.join("\n")}
};

/** What the socket of the states tells. */
export type StreamEvent =
  | ${events.map(event => indented(event, 2)).join("\n  | ")};
export type StreamEventOf<Type extends StreamEvent["type"]> = Extract<StreamEvent, { readonly type: Type }>;
`;
}
