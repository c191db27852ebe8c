import type { ServeOptions } from "@twincell/server";
import type { Given } from "./arguments.ts";
import { UseFault } from "./usage.ts";

/** Options by which a server speaks standards of plants. */
export const STANDARD_OPTIONS = {
  opcua: { type: "string" },
  rosbridge: { type: "string" },
  foxglove: { type: "string" },
  modbus: { type: "string" },
  "modbus-lines": { type: "string" },
  sparkplug: { type: "string" },
  "sparkplug-node": { type: "string" },
  webhooks: { type: "string" },
  otlp: { type: "string" },
} as const;

export function checkPort(name: string, port: number | undefined): number | undefined {
  if (port !== undefined && !(Number.isInteger(port) && port >= 0 && port <= 65535))
    throw new UseFault(`--${name} wants a whole number from 0 to 65535, not ${port}.`);
  return port;
}
function address(options: Given, name: string, schemes: readonly string[]): string | undefined {
  const url = options.text(name);
  if (url === undefined || schemes.includes(URL.parse(url)?.protocol.slice(0, -1) ?? "")) return url;
  throw new UseFault(`--${name} wants an address that begins with ${schemes.join("://, ")}://, not ${url}.`);
}

export function standardsOf(options: Given): NonNullable<ServeOptions["standards"]> {
  const port = (name: "opcua" | "rosbridge" | "foxglove" | "modbus"): number | undefined =>
    checkPort(name, options.number(name));
  const sparkplug = address(options, "sparkplug", ["mqtt", "mqtts", "ws", "wss"]);
  const names = (options.text("sparkplug-node") ?? "plant/twincell").split("/");
  const [group = "", node = ""] = names;
  if (names.length !== 2 || group === "" || node === "")
    throw new UseFault(`--sparkplug-node wants GROUP/NODE, not ${options.text("sparkplug-node")}.`);
  if (options.text("modbus-lines") !== undefined && options.text("modbus") === undefined)
    throw new UseFault("--modbus-lines says where lines are by Modbus.", "Give --modbus PORT too.");
  return {
    opcua: port("opcua"),
    rosbridge: port("rosbridge"),
    foxglove: port("foxglove"),
    modbus: port("modbus"),
    modbusLines: options.text("modbus-lines"),
    sparkplug: sparkplug === undefined ? undefined : { url: sparkplug, group, node },
    webhooks: options.text("webhooks"),
    otlp: address(options, "otlp", ["http", "https"]),
  };
}
