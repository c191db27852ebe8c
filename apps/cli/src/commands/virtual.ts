import { createInterface } from "node:readline";
import { BRANDS, brandById, robotsOf, type Brand, type Pendant } from "@twincell/controllers";
import { dialectById } from "@twincell/languages";
import { nodeNetwork, nodeScheduler } from "@twincell/server";
import { given, type Given } from "../io/arguments.ts";
import { robotOf, ROBOT_OPTIONS } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";

/** `realTime` is asked for as `--port-real-time`. */
const portOption = (name: string): string => `port-${name.replace(/[A-Z]/g, letter => `-${letter.toLowerCase()}`)}`;
const portsOf = (brand: Brand): string => Object.entries(brand.ports).map(([name, port]) => `--${portOption(name)} ${port}`).join(", ");

export const virtualCommand: Command = {
  name: "virtual",
  summary: "a virtual controller that speaks the vendor's wire protocol",
  usage: `twincell virtual BRAND [--robot R] [--host 127.0.0.1] [--port-NAME N]… [--json]

Ports are the vendor's own unless they are given; 0 takes a free one. Several controllers on one machine stand at 127.0.0.2, 127.0.0.3, …
${BRANDS.map(brand => `  ${brand.id.padEnd(10)} ${brand.name}: ${portsOf(brand)}`).join("\n")}

Lines on standard input are hands on the pendant: manual, remote, stop, release, open, close, protective, reboot.
Ctrl-C ends it.`,
  async run(args) {
    const options = given(args, {
      ...ROBOT_OPTIONS, host: { type: "string" }, json: { type: "boolean" },
      ...Object.fromEntries(BRANDS.flatMap(brand => Object.keys(brand.ports).map(name => [portOption(name), { type: "string" as const }]))),
    });
    const [id] = options.positionals, brand = brandById(id ?? "");
    if (!brand || options.positionals.length !== 1) {
      throw new UseFault(id === undefined ? "BRAND is missing." : options.positionals.length > 1 ? `virtual takes one brand, not "${options.positionals[1]}" as well.` : `There is no virtual controller of "${id}".`,
        `Brands: ${BRANDS.map(each => each.id).join(", ")}.`);
    }
    const wanted = options.text("robot") ?? robotsOf(brand)[0]?.id, { robot } = await robotOf(options, wanted);
    const dialect = dialectById(brand.dialect), host = options.text("host") ?? "127.0.0.1";
    const started = await brand.virtual({
      robot, scheduler: nodeScheduler, network: nodeNetwork(), host, ports: askedPorts(options, brand),
      interpret: text => dialect ? dialect.interpret(text, robot) : { kind: "not-understood", faults: [] },
    });
    if (started.kind === "taken") throw new UseFault(started.sentence, "Choose another address with --host, or other ports.");
    const { virtual } = started;
    process.stdout.write(options.flag("json") ? `${JSON.stringify({ brand: brand.id, robot: robot.id, host, ports: virtual.ports })}\n`
      : `${virtual.name} listens at ${host}: ${Object.entries(virtual.ports).map(([name, port]) => `${name} ${port}`).join(", ")}\nNot a certified safety device. Ctrl-C ends.\n`);
    const pendant = createInterface({ input: process.stdin });
    pendant.on("line", line => { process.stdout.write(act(line.trim(), virtual.pendant, () => { virtual.reboot(); })); });
    await new Promise<void>(resolve => { for (const signal of ["SIGINT", "SIGTERM"] as const) process.once(signal, () => { resolve(); }); });
    pendant.close();
    virtual.close();
    return 0;
  },
};

function askedPorts(options: Given, brand: Brand): Readonly<Record<string, number>> {
  const ports: Record<string, number> = {};
  for (const name of Object.keys(brand.ports)) {
    const option = portOption(name), port = options.number(option);
    if (port === undefined) continue;
    if (!Number.isInteger(port) || port < 0 || port > 65_535) throw new UseFault(`--${option} wants a whole number from 0 to 65535, not ${port}.`);
    ports[name] = port;
  }
  return ports;
}

/** What a word on standard input does; returns what is said about it. */
function act(word: string, pendant: Pendant, reboot: () => void): string {
  switch (word) {
    case "": return "";
    case "manual": pendant.setMode("manual"); break;
    case "remote": pendant.setMode("remote"); break;
    case "stop": pendant.emergencyStop(true); break;
    case "release": pendant.emergencyStop(false); break;
    case "open": pendant.setGuardOpen(true); break;
    case "close": pendant.setGuardOpen(false); break;
    case "protective": pendant.protectiveStop("Somebody asked for it at the pendant."); break;
    case "reboot": reboot(); break;
    default: return `There is no "${word}" at the pendant: manual, remote, stop, release, open, close, protective, reboot.\n`;
  }
  return `${word}\n`;
}
