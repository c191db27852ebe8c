import type { ServeOptions } from "@twincell/server";
import type { Given } from "./arguments.ts";
import { UseFault } from "./usage.ts";

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
    plc: options.text("plc"),
    otlp: address(options, "otlp", ["http", "https"]),
  };
}

export function natsOf(options: Given): Pick<ServeOptions, "nats"> {
  const servers = options
    .text("nats")
    ?.split(",")
    .map(each => each.trim().replace(/^nats:\/\//, ""))
    .filter(each => each !== "");
  if (!servers) return {};
  const site = options.text("site");
  if (site === undefined) throw new UseFault("--site is missing.", "Name this line or plant: --site line1.");
  if (!/^[\w-]{1,60}$/.test(site)) throw new UseFault(`--site wants letters, digits, “_” and “-”, not ${site}.`);
  const replicas = options.number("nats-replicas") ?? 1;
  if (![1, 3, 5].includes(replicas)) throw new UseFault(`--nats-replicas wants 1, 3 or 5, not ${replicas}.`);
  const kept_h = options.number("nats-hours") ?? 168;
  if (!(kept_h > 0)) throw new UseFault(`--nats-hours wants more than 0, not ${kept_h}.`);
  return { nats: { servers, site, replicas, kept_h } };
}
