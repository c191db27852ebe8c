import { existsSync } from "node:fs";
import { createInterface } from "node:readline";
import {
  ALL_DRIVER_KINDS,
  driverKindById,
  openVirtualPendant,
  robotsOf,
  type DriverKind,
  type VirtualPendantAction,
} from "@twincell/controllers";
import { dialectById } from "@twincell/languages";
import { nodeNetwork, nodeScheduler, servePendant } from "@twincell/server";
import { given, type Given } from "../io/arguments.ts";
import { portOption } from "../io/at.ts";
import { robotOf, ROBOT_OPTIONS } from "../io/robot.ts";
import { studioFolder } from "../io/studio-folder.ts";
import { UseFault, type Command } from "../io/usage.ts";

const portsOf = (brand: DriverKind): string =>
  Object.entries(brand.ports)
    .map(([name, port]) => `--${portOption(name)} ${port}`)
    .join(", ");

const studio = studioFolder();

/** What a word on standard input does. */
const WORDS: ReadonlyMap<string, VirtualPendantAction> = new Map<string, VirtualPendantAction>([
  ["manual", { do: "mode", mode: "manual" }],
  ["remote", { do: "mode", mode: "remote" }],
  ["stop", { do: "emergency-stop", pressed: true }],
  ["release", { do: "emergency-stop", pressed: false }],
  ["open", { do: "guard", open: true }],
  ["close", { do: "guard", open: false }],
  ["near", { do: "near", somebody: true }],
  ["away", { do: "near", somebody: false }],
  ["protective", { do: "protective-stop", because: "Somebody asked for it at the pendant." }],
  ["reset", { do: "reset" }],
  ["reboot", { do: "reboot" }],
]);

export const virtualCommand: Command = {
  name: "virtual",
  summary: "a virtual controller that speaks the vendor's wire protocol",
  usage: `twincell virtual BRAND [--robot R] [--host 127.0.0.1] [--port-NAME N]… [--port-pendant N] [--json]

Ports are the vendor's own unless they are given; 0 takes a free one. Several controllers on one machine stand at 127.0.0.2, 127.0.0.3, …
${ALL_DRIVER_KINDS.map(brand => `  ${brand.id.padEnd(10)} ${brand.name}: ${portsOf(brand)}`).join("\n")}

Its pendant is a page in the browser, at the address that is printed: mode key, enabling switch, jog keys, red button, signals, faults.
Lines on standard input are hands on it too: ${[...WORDS.keys()].join(", ")}.
Ctrl-C ends it.`,
  async run(args) {
    const options = given(args, {
      ...ROBOT_OPTIONS,
      host: { type: "string" },
      [portOption("pendant")]: { type: "string" },
      json: { type: "boolean" },
      ...Object.fromEntries(
        ALL_DRIVER_KINDS.flatMap(brand =>
          Object.keys(brand.ports).map(name => [portOption(name), { type: "string" as const }]),
        ),
      ),
    });
    const [id] = options.positionals;
    const brand = driverKindById(id ?? "");
    if (!brand || options.positionals.length !== 1) {
      throw new UseFault(
        id === undefined
          ? "BRAND is missing."
          : options.positionals.length > 1
            ? `virtual takes one brand, not "${options.positionals[1]}" as well.`
            : `There is no virtual controller of "${id}".`,
        `Brands: ${ALL_DRIVER_KINDS.map(each => each.id).join(", ")}.`,
      );
    }
    const wanted = options.text("robot") ?? robotsOf(brand)[0]?.id;
    const { robot } = await robotOf(options, wanted);
    const dialect = dialectById(brand.dialect);
    const host = options.text("host") ?? "127.0.0.1";
    const opened = await openVirtualPendant({
      brand,
      robot,
      scheduler: nodeScheduler,
      network: nodeNetwork(),
      host,
      ports: askedPorts(options, Object.keys(brand.ports)),
      interpret: text => (dialect ? dialect.interpret(text, robot) : { kind: "not-understood", faults: [] }),
    });
    if (opened.kind === "taken")
      throw new UseFault(opened.sentence, "Choose another address with --host, or other ports.");
    const { virtual, cabinet: virtualPendant } = opened;
    const page = existsSync(`${studio}/pendant/index.html`)
      ? await servePendant({
          // A page that moves the robot is for who sits at this machine, wherever the controller itself can be reached
          // from.
          studio,
          host: host.startsWith("127.") ? host : "127.0.0.1",
          port: askedPorts(options, ["pendant"])["pendant"] ?? 0,
          version: "",
          scheduler: nodeScheduler,
          pendant: virtualPendant,
          words: { id: "pendant", name: virtual.name, brand: brand.id, robot: robot.id, virtual: true, watchdog: "" },
        })
      : null;
    if (page?.kind === "taken") {
      opened.close();
      throw new UseFault(page.sentence, "Choose another with --port-pendant.");
    }
    process.stdout.write(
      options.flag("json")
        ? `${JSON.stringify({ brand: brand.id, robot: robot.id, host, ports: virtual.ports, pendant: page?.url ?? null })}\n`
        : `${virtual.name} listens at ${host}: ${Object.entries(virtual.ports)
            .map(([name, port]) => `${name} ${port}`)
            .join(
              ", ",
            )}\n${page ? `Its pendant is at ${page.url}` : "Its pendant is not built yet: run npm run build."}\nNot a certified safety device. Ctrl-C ends.\n`,
    );
    const hands = createInterface({ input: process.stdin });
    const carryOut = async (word: string): Promise<void> => {
      const act = WORDS.get(word);
      const outcome = act && (await virtualPendant.act("console", act));
      if (word === "") return;
      process.stdout.write(
        `${!outcome ? `There is no "${word}" at the pendant: ${[...WORDS.keys()].join(", ")}.` : outcome.kind === "done" ? word : outcome.why.sentence}\n`,
      );
    };
    let before = Promise.resolve();
    hands.on("line", line => {
      before = before.then(() => carryOut(line.trim()));
    });
    await new Promise<void>(resolve => {
      for (const signal of ["SIGINT", "SIGTERM"] as const)
        process.once(signal, () => {
          resolve();
        });
    });
    hands.close();
    page?.close();
    opened.close();
    return 0;
  },
};

function askedPorts(options: Given, names: readonly string[]): Readonly<Record<string, number>> {
  const ports: Record<string, number> = {};
  for (const name of names) {
    const option = portOption(name);
    const port = options.number(option);
    if (port === undefined) continue;
    if (!Number.isInteger(port) || port < 0 || port > 65_535)
      throw new UseFault(`--${option} wants a whole number from 0 to 65535, not ${port}.`);
    ports[name] = port;
  }
  return ports;
}
