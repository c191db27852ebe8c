import { readFileSync } from "node:fs";
import { UseFault } from "./usage.ts";

/** One setting of a server: the same name on the command line, in a file and, in capitals, in the environment. */
export interface ServeOption {
  readonly name: string;
  /** "flag": on or off; "number": a number; "text": anything else, lists with commas between them. */
  readonly kind: "flag" | "number" | "text";
  /** What holds where it is not given. */
  readonly otherwise: string;
  readonly meaning: string;
}
const option = (name: string, kind: ServeOption["kind"], otherwise: string, meaning: string): ServeOption => ({
  name,
  kind,
  otherwise,
  meaning,
});

/** Every setting of `twincell serve`: command line, file, environment and docs/operations.md are made from it. */
export const SERVE_OPTIONS: readonly ServeOption[] = [
  option("port", "number", "7341, or the next free one", "port to listen on; 0 takes any free one"),
  option("data", "text", "nothing is kept", "folder of what must survive the server"),
  option("lan", "flag", "this machine alone", "also serve other machines: HTTPS and an access code"),
  option("host", "text", "127.0.0.1, with lan 0.0.0.0", "address to listen on"),
  option("robots", "text", "all, with lan this machine alone", "the only addresses of real controllers"),
  option("connections", "text", "connections.json of the data folder", "robots to open and connect at the start"),
  option("accounts", "flag", "as the data folder says", "people sign in by name"),
  option("training", "flag", "off", "virtual controllers only: no real robot is reached"),
  option("log", "text", "text", "what the server says: text, or json (one object a line, no secrets)"),
  option("studio", "text", "the one of this release", "folder of another built studio to serve"),
  option("open", "flag", "off", "open the address in a browser"),
  option("opcua", "number", "off", "port of OPC UA"),
  option("rosbridge", "number", "off", "port of rosbridge"),
  option("foxglove", "number", "off", "port of Foxglove WebSocket"),
  option("modbus", "number", "off", "port of Modbus TCP"),
  option("modbus-lines", "text", "in the order first told", "file: which lines are at which Modbus address"),
  option("sparkplug", "text", "off", "address of an MQTT broker"),
  option("sparkplug-node", "text", "plant/twincell", "GROUP/NODE of Sparkplug B"),
  option("webhooks", "text", "off", "file of addresses that are told what happens"),
  option("plc", "text", "off", "file: which nodes of a PLC's OPC UA server belong to which lines"),
  option("otlp", "text", "off", "address of an OpenTelemetry collector"),
  option("nats", "text", "by itself", "servers of a NATS cluster"),
  option("site", "text", "needed with nats", "name of this line or plant in the cluster"),
  option("nats-replicas", "number", "1", "copies of what the cluster keeps"),
  option("nats-hours", "number", "168", "how long the cluster keeps states"),
];
export const PREFIX = "TWINCELL_SERVE_";
/** Name of a setting in the environment. */
export const environmentName = (name: string): string => `${PREFIX}${name.toUpperCase().replaceAll("-", "_")}`;

type Settings = ReadonlyMap<string, string | boolean>;
const known = (): string => SERVE_OPTIONS.map(({ name }) => name).join(", ");
const FLAGS: Readonly<Record<string, boolean>> = { true: true, "1": true, false: false, "0": false };

function fromFile(path: string): Settings {
  const fault = (sentence: string): UseFault =>
    new UseFault(`${path}: ${sentence}`, "docs/operations.md has the table of settings.");
  let value: unknown;
  try {
    value = JSON.parse(readFileSync(path, "utf8"));
  } catch (problem) {
    throw fault(`it cannot be read: ${problem instanceof Error ? problem.message : String(problem)}.`);
  }
  if (typeof value !== "object" || value === null || Array.isArray(value))
    throw fault(`a file of settings is an object such as {"port":7341,"data":"/var/lib/twincell"}.`);
  const settings = new Map<string, string | boolean>();
  for (const [key, given] of Object.entries(value)) {
    const found = SERVE_OPTIONS.find(({ name }) => name === key);
    if (!found) throw fault(`there is no setting “${key}”; there are: ${known()}.`);
    const wants = { flag: "true or false", number: "a number", text: "a text" }[found.kind];
    const list = Array.isArray(given) && given.every(each => typeof each === "string") ? given.join(",") : given;
    const type = { flag: "boolean", number: "number", text: "string" }[found.kind];
    if (typeof list !== type) throw fault(`“${key}” wants ${wants}, not ${JSON.stringify(given)}.`);
    settings.set(key, typeof list === "boolean" ? list : String(list));
  }
  return settings;
}

function fromEnvironment(env: Readonly<Record<string, string | undefined>>): Settings {
  const settings = new Map<string, string | boolean>();
  for (const [key, text] of Object.entries(env)) {
    if (!key.startsWith(PREFIX) || text === undefined || key === `${PREFIX}CONFIG`) continue;
    const found = SERVE_OPTIONS.find(({ name }) => environmentName(name) === key);
    if (!found)
      throw new UseFault(
        `The environment sets ${key}, which is no setting of a server.`,
        `There are: ${SERVE_OPTIONS.map(({ name }) => environmentName(name)).join(", ")}.`,
      );
    if (found.kind !== "flag") {
      if (found.kind === "number" && (text.trim() === "" || !Number.isFinite(Number(text))))
        throw new UseFault(`The environment: ${key} wants a number, not “${text}”.`);
      settings.set(found.name, text);
      continue;
    }
    if (!Object.hasOwn(FLAGS, text)) throw new UseFault(`The environment: ${key} wants true or false, not “${text}”.`);
    settings.set(found.name, FLAGS[text]!);
  }
  return settings;
}

/**
 * The arguments of a server with what a file and the environment say put before them: the command line wins over the
 * environment, the environment over the file.
 */
export function serveArguments(
  args: readonly string[],
  env: Readonly<Record<string, string | undefined>>,
): readonly string[] {
  const at = args.findIndex(arg => arg === "--config" || arg.startsWith("--config="));
  const inline = at >= 0 && args[at]!.includes("=");
  const path = at < 0 ? env[`${PREFIX}CONFIG`] : inline ? args[at]!.slice("--config=".length) : args[at + 1];
  if (at >= 0 && (path === undefined || path === "")) throw new UseFault("--config wants a file.");
  const rest = at < 0 ? args : args.filter((_, i) => i !== at && (inline || i !== at + 1));
  const settings = new Map([...(path === undefined ? [] : fromFile(path)), ...fromEnvironment(env)]);
  const before = [...settings].flatMap(([name, value]) =>
    value === true ? [`--${name}`] : value === false ? [] : [`--${name}=${value}`],
  );
  return [...before, ...rest];
}

/** The table of docs/operations.md. */
export const settingsTable = (): string =>
  [
    "| command line and file | environment | value | otherwise | what it says |",
    "|---|---|---|---|---|",
    ...SERVE_OPTIONS.map(
      ({ name, kind, otherwise, meaning }) =>
        `| \`${name}\` | \`${environmentName(name)}\` | ${kind} | ${otherwise} | ${meaning} |`,
    ),
  ].join("\n");
